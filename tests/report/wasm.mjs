// The checker in reports and the program must agree about every certificate of the corpus. Arguments: the program knotproof, folders.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, readdirSync, statSync } from "node:fs";
import { join } from "node:path";
import { gunzipSync } from "node:zlib";

const [knotproof, ...folders] = process.argv.slice(2);
const wasm = gunzipSync(readFileSync(new URL("../../src/show/html/checker.wasm.gz", import.meta.url)));
const fresh = async () => (await WebAssembly.instantiate(wasm, {})).instance.exports;
const files = [];
const walk = (path) => {
  if (statSync(path).isDirectory()) for (const name of readdirSync(path).sort()) walk(join(path, name));
  else files.push(path);
};
folders.forEach(walk);
const verdicts = new Map();
for (let i = 0; i < files.length; i += 200) {
  const part = files.slice(i, i + 200);
  let output;
  try {
    output = execFileSync(knotproof, ["check", "--json", ...part], { encoding: "utf8", maxBuffer: 1 << 28, stdio: ["ignore", "pipe", "ignore"] });
  } catch (error) {
    output = error.stdout;
  }
  for (const line of output.trim().split("\n")) {
    const { file, verdict } = JSON.parse(line);
    verdicts.set(file, verdict);
  }
}
let checker = await fresh();
let accepted = 0;
for (const file of files) {
  const bytes = readFileSync(file);
  let verdict;
  try {
    const place = checker.input(bytes.length);
    new Uint8Array(checker.memory.buffer, place, bytes.length).set(bytes);
    verdict = checker.check() ? "accepted" : "rejected";
  } catch (error) {
    verdict = String(error);
    checker = await fresh();
  }
  assert.equal(verdict, verdicts.get(file), file);
  if (verdict === "accepted") accepted++;
}
assert.ok(accepted > 0 && accepted < files.length, "both verdicts occur");
console.log(`checker.wasm.gz: ${files.length} certificates, ${accepted} accepted, as the program says`);
