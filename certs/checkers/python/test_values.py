"""Tests of the claim `values`, on curves whose values are known: y = x² for x from −1 to 1, a quarter of the unit circle, a twisted cubic."""

import hashlib
import unittest
from fractions import Fraction

import document
import values
import values_distance
from test_check import Checks, curve_block, piece


def spline(degree, knots, points):
    return {"bspline": {"degree": degree, "knots": [str(k) for k in knots],
                        "points": [[str(x) for x in p] for p in points]}}


HALF = Fraction(1, 2)
PARABOLA = {"bezier": {"pieces": [piece([(-1, 1), (0, -1), (1, 1)])]}}
INSERTED = spline(2, [0, 0, 0, HALF, 1, 1, 1], [(-1, 1), (-HALF, 0), (HALF, 0), (1, 1)])
QUARTER = {"bezier": {"pieces": [{**piece([(1, 0), (1, 1), (0, 1)]), "weights": ["1", "1", "2"]}]}}
TWISTED = {"bezier": {"pieces": [piece([(0, 0, 0), (Fraction(1, 3), 0, 0), (Fraction(2, 3), Fraction(1, 3), 0), (1, 1, 1)])]}}
SEGMENT = {"bezier": {"pieces": [piece([(-1, -1), (1, -1)])]}}


def located(curve):
    return values.Located(values.curve(curve, "curve"))


def certificate(curve, entries, witnesses=()):
    return {"knotproof": "certificate/1", "tool": "hand", "curve": curve,
            "curve_sha256": hashlib.sha256(curve_block(curve)).hexdigest(),
            "statement": {"claim": "values", "entries": entries}, "evidence": {"witnesses": list(witnesses)}}


class Geometry(unittest.TestCase):
    def test_point(self):
        self.assertEqual(located(PARABOLA).point(Fraction(1, 4), ""), [-HALF, Fraction(1, 4)])
        self.assertEqual(located(QUARTER).point(HALF, ""), [Fraction(3, 5), Fraction(4, 5)])

    def test_derivatives(self):
        found = located(INSERTED).derivatives(HALF, "left", 3, "")
        self.assertEqual([v[:2] for v in found], [[0, 0], [2, 0], [0, 8], [0, 0]])
        # by differences of the circle's points at rational parameters: x² + y² = 1, so c·c' = 0 and c·c'' = −c'·c'
        for u in (Fraction(0), Fraction(1, 3), Fraction(1)):
            c, first, second = located(QUARTER).derivatives(u, "left" if u == 1 else "right", 2, "")
            self.assertEqual(values.dot(c, first), 0)
            self.assertEqual(values.dot(c, second), -values.dot(first, first))

    def test_knots(self):
        unclamped = located(spline(2, range(7), [(0, 0), (2, 0), (2, 2), (0, 2)]))
        self.assertEqual(unclamped.ends, [2, 3, 4])
        self.assertEqual(unclamped.point(Fraction(3), ""), [2, 1])

    def test_same(self):
        values.require_same(located(PARABOLA), located(INSERTED), "")
        with self.assertRaises(document.Reject):
            values.require_same(located(PARABOLA), located(QUARTER), "")

    def test_boxes(self):
        run = values_distance.node_of([[(0, 0, 0, 1), (1, 1, 0, 1)], [(1, 1, 0, 1), (4, 0, 0, 2)]])
        self.assertEqual(run.box, [(0, 2), (0, 1), (0, 0)])
        self.assertEqual(run.along([1, -1]), [-1, 2])


class Certificates(Checks):
    def test_accepted(self):
        for curve, entry in [
            (PARABOLA, {"operation": "point", "parameter": "1/4", "point": ["-1/2", "1/4"]}),
            (PARABOLA, {"operation": "derivative", "parameter": "1/4", "order": 1, "side": "left", "vector": ["2", "-2"]}),
            (PARABOLA, {"operation": "curvature", "parameter": "1/4", "side": "left", "value_squared": "1/2"}),
            (QUARTER, {"operation": "curvature", "parameter": "1/3", "side": "left", "value_squared": "1"}),
            (TWISTED, {"operation": "torsion", "parameter": "1", "side": "left", "value": "3/19"}),
            (PARABOLA, {"operation": "insert_knot", "parameter": "1/2", "times": 1, "curve": INSERTED}),
            (INSERTED, {"operation": "remove_knot", "parameter": "1/2", "times": 1,
                        "curve": spline(2, [0, 0, 0, 1, 1, 1], [(-1, 1), (0, -1), (1, 1)])}),
        ]:
            self.accept(certificate(curve, [entry]))
        self.accept(certificate(PARABOLA, []))

    def test_rejected(self):
        for entry, reason in [
            ({"operation": "point", "parameter": "1/4", "point": ["-1/2", "1/5"]}, "expected -1/2, 1/4"),
            ({"operation": "point", "parameter": "5/4", "point": ["-1/2", "1/5"]}, "a piece on the side"),
            ({"operation": "point", "parameter": "1/4", "point": ["-1/2", "1/4", "0"]}, "2 coordinates"),
            ({"operation": "derivative", "parameter": "0", "order": 2, "side": "left", "vector": ["0", "8"]}, "the side 'left'"),
            ({"operation": "derivative", "parameter": "0", "order": 65, "side": "right", "vector": ["0", "0"]}, "from 1 to 64"),
            ({"operation": "torsion", "parameter": "0", "side": "right", "value": "0"}, "in space"),
            ({"operation": "insert_knot", "parameter": "1/3", "times": 1, "curve": INSERTED}, "other knots"),
            ({"operation": "elevate_degree", "times": 1, "curve": INSERTED}, "degree 3"),
            ({"operation": "decompose", "curve": INSERTED}, "Bézier pieces"),
            ({"operation": "points"}, "'point'"),
        ]:
            self.reject(certificate(PARABOLA, [entry]), reason)

    def test_distances(self):
        near = {"operation": "nearest_point", "target": ["0", "-1"], "lower_squared": "1", "upper_squared": "1"}
        far = {"operation": "curve_distance", "other": SEGMENT, "lower_squared": "1", "upper_squared": "1"}
        witnesses = [{"parameter": "1/2"}, {"parameters": ["1/2", "1/2"], "tree": ["first", "far 0 1", "far 0 1"]}]
        self.accept(certificate(PARABOLA, [near, far], witnesses))
        self.reject(certificate(PARABOLA, [near, far], witnesses[::-1]), "unknown field")
        self.reject(certificate(PARABOLA, [near, far], witnesses[:1]), "a list of 2")
        self.reject(certificate(PARABOLA, [{**near, "lower_squared": "101/100", "upper_squared": "2"}], witnesses[:1]),
                    "not non-negative")
        self.reject(certificate(PARABOLA, [{**far, "lower_squared": "101/100", "upper_squared": "2"}], witnesses[1:]),
                    "far along")
        self.reject(certificate(PARABOLA, [{**far, "lower_squared": "0"}], witnesses[1:]), "a tree when and only when")
        for tree, reason in [([], "end before the tree"), (["far 0 1"], "far along"), (["split"], "first, second or far"),
                             (["first", "far 0 1", "far 0 1", "far 0 1"], "the tree is complete")]:
            self.reject(certificate(PARABOLA, [far], [{"parameters": ["1/2", "1/2"], "tree": tree}]), reason)


if __name__ == "__main__":
    unittest.main()
