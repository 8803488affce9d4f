// JavaScript engines on the curves of curves.json, as peers.py. Their packages are those of tests/engines/javascript.

import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

const packages = new URL("../../tests/engines/javascript/node_modules/", import.meta.url);
const require = createRequire(packages);
const curves = JSON.parse(readFileSync(new URL("curves.json", import.meta.url)));
const GOLDEN = 0.6180339887498949;
const SINGLE = 1000;

function parameters({ knots, degree }, count) {
  const [start, end] = [knots[degree], knots[knots.length - 1 - degree]];
  return Array.from({ length: count }, (_, i) => start + (end - start) * ((i * GOLDEN) % 1));
}

let sink = 0;
function seconds(work, per = 1) {
  let best = Infinity;
  for (let round = 0; round < 5; round++) {
    const start = process.hrtime.bigint();
    let calls = 0;
    let spent = 0;
    while (spent < 0.1) {
      sink += work();
      calls++;
      spent = Number(process.hrtime.bigint() - start) / 1e9;
    }
    best = Math.min(best, spent / calls);
  }
  return best / per;
}

const columns = {};
const put = (column, engine, time) => ((columns[column] ??= {})[engine] = time);
const single = (point, at) =>
  seconds(() => {
    let sum = 0;
    for (const t of at) sum += point(t);
    return sum;
  }, at.length);

const three = await import(new URL("three/build/three.module.js", packages));
const { calcBSplinePoint } = await import(new URL("three/examples/jsm/curves/NURBSUtils.js", packages));
globalThis.window = globalThis;
const verb = require("verb-nurbs");
const { Eval, Modify } = verb.eval;

for (const [name, asked] of Object.entries(curves)) {
  const at = parameters(asked, SINGLE);
  if (asked.points.length === 4 && asked.degree === 3) {
    const curve = new three.CubicBezierCurve(...asked.points.map(([x, y]) => new three.Vector2(x, y)));
    const target = new three.Vector2();
    put(`point ${name}`, "three", single((t) => curve.getPoint(t, target).x, at));
  } else {
    const control = asked.points.map(([x, y, z = 0], i) => new three.Vector4(x, y, z, asked.weights?.[i] ?? 1));
    put(`point ${name}`, "three", single((t) => calcBSplinePoint(asked.degree, asked.knots, control, t).x, at));
  }
  const weights = asked.weights ?? asked.points.map(() => 1);
  const data = new verb.core.NurbsCurveData(asked.degree, asked.knots.slice(), Eval.homogenize1d(asked.points, weights));
  put(`point ${name}`, "verb", single((t) => Eval.rationalCurvePoint(data, t)[0], at));
  if (name === "mp06" || name === "long") {
    const knot = name === "mp06" ? 0.5 : 41.5;
    put(`insertion ${name}`, "verb", seconds(() => Modify.curveKnotInsert(data, knot, 1).knots.length));
  }
}
console.log(JSON.stringify(columns));
if (sink === 1) console.error(sink);
