// What the adapters share: reads cases.json, lets an engine answer them in a worker, writes results.json.
// An endless loop in the worker costs one case: it counts as refused.

import { readFileSync, writeFileSync } from "node:fs";
import { Worker, isMainThread, parentPort, workerData } from "node:worker_threads";

const SECONDS = 5;

export class NotOffered extends Error {}

export const number = (x) => (Number.isFinite(x) ? x : Number.isNaN(x) || typeof x !== "number" ? "NaN" : x > 0 ? "Infinity" : "-Infinity");
export const numbers = (list) => Array.from(list, number);

export function curve(degree, knots, points, weights) {
  const made = { degree, knots: numbers(knots), points: points.map(numbers) };
  return weights ? { ...made, weights: numbers(weights) } : made;
}

export const domain = (asked) => [asked.knots[asked.degree], asked.knots.at(-asked.degree - 1)];

export const isBezier = (asked) => {
  const order = asked.degree + 1;
  return asked.points.length === order && asked.knots.every((knot, i) => knot === (i < order ? 0 : 1));
};

function answer(engine, asked) {
  try {
    if (!engine[asked.operation]) throw new NotOffered();
    return { id: asked.id, status: "ok", ...engine[asked.operation](asked.curve, asked) };
  } catch (error) {
    if (error instanceof NotOffered) return { id: asked.id, status: "not_offered" };
    return { id: asked.id, status: "refused", message: String(error).slice(0, 200) };
  }
}

// The answers of one worker, up to the first case that it does not come back from.
function work(file, cases) {
  return new Promise((done) => {
    const worker = new Worker(file, { workerData: cases });
    const results = [];
    const give = (why) => {
      clearTimeout(timer);
      worker.terminate();
      if (why && results.length < cases.length) results.push({ id: cases[results.length].id, status: "refused", message: why });
      done(results);
    };
    const late = () => give(`no answer within ${SECONDS} s`);
    let timer = setTimeout(late, SECONDS * 1000);
    worker.on("message", (result) => {
      results.push(result);
      clearTimeout(timer);
      timer = setTimeout(late, SECONDS * 1000);
      if (results.length === cases.length) give();
    });
    worker.on("error", (error) => give(String(error).slice(0, 200)));
  });
}

// The adapter's file is at once the program and the worker.
export async function main(name, engine, url) {
  if (!isMainThread) {
    for (const asked of workerData) parentPort.postMessage(answer(engine, asked));
    return;
  }
  const [from, to] = process.argv.slice(2);
  const { cases } = JSON.parse(readFileSync(from, "utf8"));
  const results = [];
  while (results.length < cases.length) results.push(...(await work(new URL(url), cases.slice(results.length))));
  writeFileSync(to, JSON.stringify({ knotproof: "results/1", engine: name, results }));
}
