// verb-nurbs.

import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { curve, main, number, numbers } from "./adapter.mjs";

// Its build expects a browser.
globalThis.window = globalThis;
const require = createRequire(import.meta.url);
const verb = require("verb-nurbs");
const version = JSON.parse(readFileSync(new URL("./node_modules/verb-nurbs/package.json", import.meta.url))).version;
const { Eval, Modify, Divide, Analyze } = verb.eval;

// Control points are held homogeneous, in as many coordinates as the curve has.
function data(asked) {
  const weights = asked.weights ?? asked.points.map(() => 1);
  return new verb.core.NurbsCurveData(asked.degree, asked.knots.slice(), Eval.homogenize1d(asked.points, weights));
}

function returned(made) {
  const weights = Eval.weight1d(made.controlPoints);
  return curve(made.degree, made.knots, Eval.dehomogenize1d(made.controlPoints), weights.every((w) => w === 1) ? undefined : weights);
}

const engine = {
  point: (asked, { parameter }) => ({ point: numbers(Eval.rationalCurvePoint(data(asked), parameter)) }),
  derivative: (asked, { parameter, order }) => ({ vector: numbers(Eval.rationalCurveDerivatives(data(asked), parameter, order)[order]) }),
  insert_knot: (asked, { parameter, times }) => ({ curve: returned(Modify.curveKnotInsert(data(asked), parameter, times)) }),
  elevate_degree: (asked, { times }) => ({ curve: returned(Modify.curveElevateDegree(data(asked), asked.degree + times)) }),
  split: (asked, { parameter }) => ({ curves: Divide.curveSplit(data(asked), parameter).map(returned) }),
  decompose: (asked) => ({ curves: Modify.decomposeCurveIntoBeziers(data(asked)).map(returned) }),
  nearest_point(asked, { target }) {
    const parameter = Analyze.rationalCurveClosestParam(data(asked), target);
    const found = Eval.rationalCurvePoint(data(asked), parameter);
    return { distance: number(Math.hypot(...found.map((x, i) => x - target[i]))), parameter: number(parameter) };
  },
};

await main(`verb-nurbs ${version}`, engine, import.meta.url);
