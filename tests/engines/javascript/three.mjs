// three.js: NURBSUtils for any curve.

import { readFileSync } from "node:fs";
import { Vector4 } from "three";
import { calcBSplinePoint, calcNURBSDerivatives } from "three/addons/curves/NURBSUtils.js";
import { main, numbers } from "./adapter.mjs";

const version = JSON.parse(readFileSync(new URL("./node_modules/three/package.json", import.meta.url))).version;
const control = (asked) => asked.points.map(([x, y, z = 0], i) => new Vector4(x, y, z, asked.weights?.[i] ?? 1));
const coordinates = (vector, asked) => numbers([vector.x, vector.y, vector.z].slice(0, asked.points[0].length));

const engine = {
  point(asked, { parameter }) {
    // As NURBSCurve.getPoint does, with the parameter itself in place of its share of the domain.
    const found = calcBSplinePoint(asked.degree, asked.knots, control(asked), parameter);
    if (found.w !== 1.0) found.divideScalar(found.w);
    return { point: coordinates(found, asked) };
  },
  derivative(asked, { parameter, order }) {
    const found = calcNURBSDerivatives(asked.degree, asked.knots, control(asked), parameter, order);
    return { vector: coordinates(found[order], asked) };
  },
};

await main(`three ${version}`, engine, import.meta.url);
