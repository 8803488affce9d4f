"""Python engines on the curves of curves.json: seconds per point, per inserted knot, per shortest double normal.

    peers.py            writes one JSON object {column: {engine: seconds}}

Times include what the binding costs; the least of five rounds counts. An engine that does not import is left out.
"""

import importlib
import json
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "peers"))
CURVES = json.loads((HERE / "curves.json").read_text())
GOLDEN = 0.6180339887498949
SINGLE, BATCH = 1000, 100_000
ROUNDS = 5
SHORTEST = 0.05


def parameters(asked, count):
    """Multiples of the golden ratio modulo 1, on the domain."""
    start, end = asked["knots"][asked["degree"]], asked["knots"][-asked["degree"] - 1]
    return [start + (end - start) * (i * GOLDEN % 1.0) for i in range(count)]


def seconds(work, per=1):
    """The least time of a call, for each of `per` things."""
    best = float("inf")
    for _ in range(ROUNDS):
        calls, spent = 0, 0.0
        start = time.perf_counter()
        while spent < SHORTEST:
            work()
            calls += 1
            spent = time.perf_counter() - start
        best = min(best, spent / calls)
    return best / per


def single(point, at):
    def work():
        for t in at:
            point(t)

    return seconds(work, len(at))


def scipy(name, asked):
    import numpy
    from scipy.interpolate import BSpline, insert

    if "weights" in asked:
        return
    spline = BSpline(numpy.array(asked["knots"], float), numpy.array(asked["points"], float), asked["degree"])
    yield f"point {name}", single(spline, parameters(asked, SINGLE))
    if name in ("cubic", "mp06"):
        many = numpy.sort(parameters(asked, BATCH))
        yield f"batch {name}", seconds(lambda: spline(many), BATCH)
    if name in ("mp06", "long"):
        at = 0.5 if name == "mp06" else 41.5
        yield f"insertion {name}", seconds(lambda: insert(at, spline))


def geomdl(name, asked):
    from geomdl import NURBS, BSpline, operations

    made = (NURBS if "weights" in asked else BSpline).Curve(normalize_kv=False)
    made.degree, made.ctrlpts = asked["degree"], [list(map(float, p)) for p in asked["points"]]
    if "weights" in asked:
        made.weights = list(map(float, asked["weights"]))
    made.knotvector = list(map(float, asked["knots"]))
    yield f"point {name}", single(made.evaluate_single, parameters(asked, SINGLE))
    if name in ("mp06", "long"):
        import copy

        at = 0.5 if name == "mp06" else 41.5
        yield f"insertion {name}", seconds(lambda: operations.insert_knot(copy.deepcopy(made), [at], [1]))


def splipy(name, asked):
    import numpy
    from splipy import BSplineBasis, Curve

    control, weights = numpy.array(asked["points"], float), asked.get("weights")
    if weights is not None:
        weights = numpy.array(weights, float)[:, None]
        control = numpy.hstack([control * weights, weights])
    basis = BSplineBasis(asked["degree"] + 1, numpy.array(asked["knots"], float))
    made = Curve(basis, control, rational=weights is not None)
    yield f"point {name}", single(made, parameters(asked, SINGLE))
    if name in ("cubic", "mp06"):
        many = numpy.sort(parameters(asked, BATCH))
        yield f"batch {name}", seconds(lambda: made(many), BATCH)
    if name in ("mp06", "long"):
        at = 0.5 if name == "mp06" else 41.5
        yield f"insertion {name}", seconds(lambda: made.clone().insert_knot([at]))


def tinyspline(name, asked):
    import tinyspline

    if "weights" in asked:
        return
    points = asked["points"]
    made = tinyspline.BSpline(len(points), len(points[0]), asked["degree"])
    made.control_points = [float(x) for point in points for x in point]
    made.knots = list(map(float, asked["knots"]))
    yield f"point {name}", single(lambda t: made.eval(t).result, parameters(asked, SINGLE))
    if name in ("cubic", "mp06"):
        many = sorted(parameters(asked, BATCH))
        yield f"batch {name}", seconds(lambda: made.eval_all(many), BATCH)
    if name in ("mp06", "long"):
        at = 0.5 if name == "mp06" else 41.5
        yield f"insertion {name}", seconds(lambda: made.insert_knot(at, 1))


def bezier(name, asked):
    import bezier
    import numpy

    if len(asked["points"]) != asked["degree"] + 1:
        return
    made = bezier.Curve.from_nodes(numpy.asfortranarray(numpy.array(asked["points"], float).T))
    yield f"point {name}", single(made.evaluate, parameters(asked, SINGLE))
    if name == "cubic":
        many = numpy.sort(parameters(asked, BATCH))
        yield f"batch {name}", seconds(lambda: made.evaluate_multi(many), BATCH)


def occt(name, asked):
    from OCP.collections import Array1_double, Array1_gp_Pnt, Array1_int
    from OCP.Geom import Geom_BSplineCurve
    from OCP.gp import gp_Pnt

    def array(kind, values):
        made = kind(1, len(values))
        for i, value in enumerate(values, 1):
            made.SetValue(i, value)
        return made

    knots = sorted(set(asked["knots"]))
    made = Geom_BSplineCurve(
        array(Array1_gp_Pnt, [gp_Pnt(*(float(x) for x in [*p, 0.0][:3])) for p in asked["points"]]),
        array(Array1_double, [float(w) for w in asked.get("weights", [1] * len(asked["points"]))]),
        array(Array1_double, [float(knot) for knot in knots]),
        array(Array1_int, [asked["knots"].count(knot) for knot in knots]),
        asked["degree"],
    )
    yield f"point {name}", single(made.Value, parameters(asked, SINGLE))
    if name in ("mp06", "long"):
        at = 0.5 if name == "mp06" else 41.5

        def insert():
            copy = Geom_BSplineCurve.DownCast(made.Copy()) if hasattr(Geom_BSplineCurve, "DownCast") else made.Copy()
            copy.InsertKnot(at, 1, 0.0, True)

        yield f"insertion {name}", seconds(insert)


def separation():
    """The shortest double normal of MP06's curve, by the peers of benches/peers."""
    import curve

    chain = curve.load(HERE.parent.parent / "certs/curves/mp06-figure-1.json")
    for engine, module in (("numpy, vectorised Newton, 9×9 seeds", "peer_numpy"), ("OCCT", "peer_occt")):
        try:
            peer = importlib.import_module(module)
        except ImportError as error:
            print(f"{module}: {error}", file=sys.stderr)
            continue
        prepared = peer.prepare(chain)
        yield engine, seconds(lambda: peer.find(chain, prepared))


def main():
    engines = {"scipy": scipy, "geomdl": geomdl, "splipy": splipy, "tinyspline": tinyspline, "bezier": bezier, "OCCT": occt}
    columns = {}
    for engine, measure in engines.items():
        try:
            for name, asked in CURVES.items():
                for column, time_of in measure(name, asked):
                    columns.setdefault(column, {})[engine] = time_of
        except ImportError as error:
            print(f"{engine}: {error}", file=sys.stderr)
    for engine, time_of in separation():
        columns.setdefault("msd mp06", {})[engine] = time_of
    print(json.dumps(columns))


main()
