#!/usr/bin/env python3
"""Tests of the claims `curvature` and `thickness` on cases whose truth is known by hand.  Run: python3 test_curvature.py"""

import copy
import hashlib
import unittest
from fractions import Fraction as F

import curvature
from test_check import Checks, chain_of, curve_block
from test_domain import bezier, bspline

ARCH = bezier([(0, 0), (1, 1), (2, 0)])  # y = x − x²/2, curvature 1 in the middle
QUARTER = bezier([(1, 0), (1, 1), (0, 1)], [1, 1, 2])  # of the unit circle
SQUARE = {"bezier": {"pieces": [bezier(ends)["bezier"]["pieces"][0] for ends in
                                ([(0, 0), (1, 0)], [(1, 0), (1, 1)], [(1, 1), (0, 1)], [(0, 1), (0, 0)])]}}
# (u², u⁴): D vanishes at the start, where the curvature tends to 2
SLOW = bezier([(0, 0), (0, 0), (F(1, 6), 0), (F(1, 2), 0), (1, 1)])


def document(curve, statement, evidence):
    return {"knotproof": "certificate/1", "tool": "hand", "curve": copy.deepcopy(curve),
            "curve_sha256": hashlib.sha256(curve_block(curve)).hexdigest(), "statement": statement,
            "evidence": evidence}


def bent(curve, lower, upper, piece=0, u="1/2"):
    return document(curve, {"claim": "curvature", "lower_squared": lower, "upper_squared": upper},
                    {"piece": piece, "u": u})


def thick(curve, lower, upper, evidence, convention="critical"):
    return document(curve, {"claim": "thickness", "convention": convention, "lower_squared": lower,
                            "upper_squared": upper}, evidence)


def part(certificate):
    return {"statement": certificate["statement"], "evidence": certificate["evidence"]}


class Curvature(Checks):
    def test_exact(self):
        for c in (bent(ARCH, "1", "1"), bent(QUARTER, "1", "1", u="2/7"), bent(SQUARE, "0", "0", 3, "1"),
                  bent(SLOW, "256/125", "4"), bent(bspline(2, [0, 0, 0, 1, 1, 1], [(0, 0), (1, 1), (2, 0)]), "1", "1")):
            self.accept(c)

    def test_bounds(self):
        self.reject(bent(ARCH, "0", "999999/1000000"), "not non-negative")
        self.reject(bent(QUARTER, "0", "999999/1000000"), "not non-negative")
        self.reject(bent(ARCH, "1", "1", u="1/3"), "a squared curvature ≥ 1")
        self.reject(bent(ARCH, "2", "1"), "lower_squared ≤ upper_squared")
        self.reject(bent(ARCH, "-1", "1"), "≥ 0")
        self.reject(bent(SLOW, "0", "399/100"), "non-negative")

    def test_places(self):
        self.reject(bent(ARCH, "0", "1", 1), "a piece below 1")
        for u in ("-1/2", "3/2"):
            self.reject(bent(ARCH, "0", "1", u=u), "a parameter from 0 to 1")
        self.reject(bent(SLOW, "0", "4", u="0"), "D vanishes")

    def test_regular(self):
        cusp = bezier([(1, -1), (F(-1, 3), 1), (F(-1, 3), -1), (1, 1)])
        self.reject(bent(cusp, "0", "1000", u="0"), "D: the polynomial is not positive")
        self.reject(bent(bezier([(0, 0), (0, 0), (F(1, 3), 0), (1, 1)]), "0", "1000"), "not non-negative")

    def test_quotient_by_differences(self):
        """κ² against a difference quotient of the angle of the tangent, on a rational piece."""
        piece = chain_of(bezier([(0, 0), (1, 2), (3, 1), (4, -1)], [1, 2, 1, 3])).pieces[0]
        found, h = curvature.Quotient(piece, 2).at(F(1, 3)), F(1, 10 ** 6)
        (x0, y0), (x1, y1), (x2, y2) = ((p[0] / F(p[3]), p[1] / F(p[3])) for p in
                                        (piece.point(F(1, 3) + k * h) for k in (-1, 0, 1)))
        vx, vy, ax, ay = (x2 - x0) / (2 * h), (y2 - y0) / (2 * h), (x2 - 2 * x1 + x0) / h ** 2, (y2 - 2 * y1 + y0) / h ** 2
        near = (vx * ay - vy * ax) ** 2 / (vx ** 2 + vy ** 2) ** 3
        self.assertLess(abs(near - found), found / 10 ** 9)


class Thickness(Checks):
    LINE = bezier([(0, 0), (3, 4)])
    CHORDS = {"statement": {"claim": "msd", "convention": "critical", "lower_squared": "inf", "upper_squared": None},
              "evidence": {"grid": 0, "upper": None,
                           "tree": ["split", "second", "bend 1 0", "not_normal -1 0", "split", "cone 3 4", "bend 0 1"]}}

    def line(self, lower, upper=None, most="0"):
        return thick(self.LINE, lower, upper, {"msd": copy.deepcopy(self.CHORDS),
                                               "curvature": part(bent(self.LINE, "0", most))})

    def test_line(self):
        self.accept(self.line("inf"))
        self.accept(self.line("100"))
        self.accept(self.line("4", most="1/4"))
        self.reject(self.line("5", most="1/4"), "at most 1/κ² and σ²/4")
        self.reject(self.line("inf", most="1/4"), "at most 1/κ² and σ²/4")
        self.reject(self.line("0", "5"), "at least 1/κ² or σ²/4")

    def test_parts(self):
        c = self.line("inf")
        c["evidence"]["msd"]["evidence"]["tree"][3] = "not_normal 1 0"
        self.reject(c, "token 3")
        c = self.line("inf")
        c["statement"]["convention"] = "smooth"
        self.reject(c, "'critical' for an open curve")
        c = self.line("inf")
        c["evidence"]["msd"]["statement"]["convention"] = "smooth"
        self.reject(c, "convention")

    def test_corner(self):
        self.accept(thick(SQUARE, "0", "0", {"corner": 0}, "smooth"))
        self.reject(thick(SQUARE, "0", "0", {"corner": 4}, "smooth"), "a joint that is a corner")
        self.reject(thick(SQUARE, "1/4", "1", {"corner": 0}, "smooth"), "0, because of the corner")
        chords = {"statement": {"claim": "msd", "convention": "smooth", "lower_squared": "0", "upper_squared": None},
                  "evidence": {"grid": 0, "tree": None, "upper": None}}
        bounds = {"msd": chords, "curvature": part(bent(SQUARE, "0", "0", 0, "0"))}
        self.reject(thick(SQUARE, "0", None, bounds, "smooth"), "joint 0 is a corner")


if __name__ == "__main__":
    unittest.main()
