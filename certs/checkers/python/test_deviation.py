"""Tests of the claim `deviation`, on a parabola whose distances are known: (−1,1), (0,−1), (1,1) is 1 from its polygon, at (0,0)."""

import hashlib
import unittest
from fractions import Fraction

import deviation
import document
from test_check import Checks, curve_block, piece

PARABOLA = {"bezier": {"pieces": [piece([(-1, 1), (0, -1), (1, 1)])]}}
POINTS = [(-1, 1, 0, 1), (0, -1, 0, 1), (1, 1, 0, 1)]


def certificate(m=0, lower="1", upper="1", i=0, j=0, u="1/2"):
    return {"knotproof": "certificate/1", "tool": "hand", "curve": PARABOLA,
            "curve_sha256": hashlib.sha256(curve_block(PARABOLA)).hexdigest(),
            "statement": {"claim": "deviation", "subdivisions": m, "lower_squared": lower, "upper_squared": upper},
            "evidence": {"piece": i, "part": j, "u": u}}


class Geometry(unittest.TestCase):
    def test_squared_distance(self):
        columns, = deviation.parts(POINTS, 2, 0)
        for u, expected in [("0", "0"), ("1", "0"), ("1/2", "1"), ("1/4", "1/16"), ("3/4", "1/16")]:
            self.assertEqual(deviation.squared_at(columns, Fraction(u)), Fraction(expected), u)

    def test_edges(self):
        columns, = deviation.parts(POINTS, 2, 0)
        for k in (0, 1):
            deviation.halve(deviation.bounded(columns, k, Fraction(1)), "")
            with self.assertRaises(document.Reject):
                deviation.halve(deviation.bounded(columns, k, Fraction(99, 100)), "")

    def test_halving_divides_by_four(self):
        for columns in deviation.parts(POINTS, 2, 1):
            self.assertEqual(deviation.squared_at(columns, Fraction(1, 2)), Fraction(1, 16))

    def test_section_is_the_curve(self):
        column = [3, -1, 4, 1]
        for k in range(3):
            scaled = deviation.section(column, k)
            for v in (Fraction(0), Fraction(1, 3), Fraction(1)):
                found = sum(x * v ** r * (1 - v) ** (3 - r) for r, x in enumerate(scaled))
                self.assertEqual(found, 27 * deviation.bernstein(column, (k + v) / 3))


class Certificates(Checks):
    def test_accepted(self):
        for made in (certificate(), certificate(lower="0", upper="2"), certificate(1, "1/16", "1/16", j=1)):
            self.accept(made)

    def test_rejected(self):
        for made, reason in [
            (certificate(u="1/3"), "a squared distance ≥ 1"),
            (certificate(lower="0", upper="99/100"), "less the squared distance"),
            (certificate(lower="2"), "lower_squared ≤ upper_squared"),
            (certificate(i=1), "a piece below 1"),
            (certificate(j=1), "a part below 1"),
            (certificate(u="3/2"), "from 0 to 1"),
            (certificate(m=17), "at most 16"),
            (certificate(lower="-1"), "≥ 0"),
        ]:
            self.reject(made, reason)


if __name__ == "__main__":
    unittest.main()
