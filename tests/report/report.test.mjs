// Opens reports in a headless browser: they render, turn and zoom, the checker in the page accepts the certificate and rejects a changed one, and
// nothing is asked of a network. Arguments: the browser, the program knotproof, the folder of certificates.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const [executablePath, knotproof, certificates] = process.argv.slice(2);
const folder = mkdtempSync(join(tmpdir(), "report-"));
const browser = await chromium.launch({
  executablePath,
  args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--disable-background-networking", "--disable-component-update", "--disable-sync"],
});

const report = (certificate) => {
  const file = join(folder, certificate.replaceAll("/", "-") + ".html");
  execFileSync(knotproof, ["show", join(certificates, certificate), "-o", file], { stdio: ["ignore", "ignore", "inherit"] });
  return file;
};

// Opens a report; every message on the console and every request beyond the file itself is an error.
const open = async (file, colorScheme = "light") => {
  const page = await browser.newPage({ viewport: { width: 1200, height: 900 }, colorScheme });
  const troubles = [];
  page.on("console", (message) => troubles.push(message.text()));
  page.on("pageerror", (error) => troubles.push(String(error)));
  page.on("request", (request) => {
    if (!/^(file|blob|data):/.test(request.url())) troubles.push(request.url());
  });
  await page.goto(pathToFileURL(file).href);
  return { page, troubles };
};
const verdict = async (page, name) => {
  await page.locator("#verdict." + name).waitFor({ timeout: 60_000 });
  return page.locator("#verdict").textContent();
};
// How many pixels of the canvas have (nearly) a colour, and a hash of all.
const content = (page, [r, g, b]) =>
  page.evaluate(async ([r, g, b]) => {
    await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
    const canvas = document.getElementById("view");
    const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext("2d", { willReadFrequently: true });
    copy.drawImage(canvas, 0, 0);
    const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
    let count = 0, hash = 0;
    for (let i = 0; i < data.length; i += 4) {
      hash = (Math.imul(hash, 31) + data[i] + 7 * data[i + 1] + 13 * data[i + 2] + 29 * data[i + 3]) | 0;
      if (data[i + 3] > 200 && Math.abs(data[i] - r) + Math.abs(data[i + 1] - g) + Math.abs(data[i + 2] - b) < 40) count++;
    }
    return { count, hash };
  }, [r, g, b]);
const curve = { light: [0x12, 0x35, 0x5b], dark: [0x8e, 0xc5, 0xff] };

try {
  // A knot in space, with a tree.
  const file = report("proved/mp06-figure-1-smooth.json");
  assert.ok(statSync(file).size < 1_500_000, `${statSync(file).size} bytes`);
  const { page, troubles } = await open(file);
  assert.match(await verdict(page, "accepted"), /^accepted: \d+ leaves replayed/);
  const first = await content(page, curve.light);
  assert.ok(first.count > 500, `the curve is drawn: ${first.count} pixels`);
  assert.deepEqual(await content(page, curve.light), first, "nothing moves by itself");
  const box = await page.locator("#view").boundingBox();
  await page.mouse.move(box.x + 200, box.y + 200);
  await page.mouse.down();
  await page.mouse.move(box.x + 320, box.y + 230, { steps: 5 });
  await page.mouse.up();
  const turned = await content(page, curve.light);
  assert.notEqual(turned.hash, first.hash, "the mouse turns");
  assert.ok(turned.count > 500);
  await page.locator("#view").focus();
  await page.keyboard.press("ArrowLeft");
  assert.notEqual((await content(page, curve.light)).hash, turned.hash, "the keyboard turns");
  await page.keyboard.press("0");
  assert.deepEqual(await content(page, curve.light), first, "0 begins again");
  await page.mouse.wheel(0, -300);
  assert.notEqual((await content(page, curve.light)).hash, first.hash, "the wheel zooms");
  await page.keyboard.press("0");
  if (process.env.SCREENSHOT) await page.screenshot({ path: process.env.SCREENSHOT, fullPage: true });
  // A box of the legend hides the curve.
  await page.getByLabel(/^curve, 5 pieces/).uncheck();
  assert.ok((await content(page, curve.light)).count < first.count / 4, "the legend hides the curve");
  await page.getByLabel(/^curve, 5 pieces/).check();
  // Leaves.
  await page.getByLabel("show the leaves").check();
  const leaves = await page.locator("#leaves li").count();
  assert.ok(leaves > 50, `${leaves} leaves`);
  await page.locator("#leaves li").nth(3).click();
  assert.notEqual((await content(page, curve.light)).hash, first.hash, "a leaf is shown on the curve");
  await page.selectOption("#rule", "cone");
  assert.ok((await page.locator("#leaves li").count()) < leaves);
  // The certificate as it is, changed, and restored.
  await page.locator("#edit summary").click();
  const text = await page.locator("#certificate").inputValue();
  assert.equal(text, readFileSync(join(certificates, "proved/mp06-figure-1-smooth.json"), "utf8"));
  await page.locator("#certificate").fill(text.replace(/("lower_squared":\s*")/, "$19"));
  await page.click("#check-text");
  assert.match(await verdict(page, "rejected"), /^rejected: /);
  await page.locator("#certificate").fill(text.slice(0, 1000));
  await page.click("#check-text");
  assert.match(await verdict(page, "rejected"), /^rejected: /);
  await page.click("#restore");
  await page.click("#check-text");
  assert.match(await verdict(page, "accepted"), /^accepted/);
  assert.deepEqual(troubles, []);
  await page.close();

  // Dark, in the plane, other claims, the binary form.
  for (const certificate of ["proved/cpij14-experiment-1-embedding.json", "proved/domain-cubic.json", "proved/domain-quintic-spatial.cert", "curvature/circle.json", "thickness/circle.json", "deviation/parabola.json"]) {
    const { page, troubles } = await open(report(certificate), "dark");
    assert.match(await verdict(page, "accepted"), /^accepted/);
    assert.ok((await content(page, curve.dark)).count > 100, certificate);
    assert.deepEqual(troubles, [], certificate);
    await page.close();
  }
  console.log("reports: all held");
} finally {
  await browser.close();
  rmSync(folder, { recursive: true, force: true });
}
