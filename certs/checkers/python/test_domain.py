#!/usr/bin/env python3
"""Tests of the claim `domain` on small cases whose truth is known by hand.  Run: python3 test_domain.py"""

import copy
import hashlib
import itertools
import math
import random
import unittest
from fractions import Fraction as F
from unittest import mock

import document
import domain
import domain_sign
from test_check import Checks, binary, chain_of, curve_block, piece


def bezier(points, weights=None):
    return {"bezier": {"pieces": [piece(points, weights)]}}


def bspline(degree, knots, points, weights=None):
    return {"bspline": {"degree": degree, "knots": [str(F(t)) for t in knots], **piece(points, weights)}}


def certificate(curve, points, box, outcome, evidence, sign="+", interval=("0", "1"), open_ends=(False, False)):
    return {"knotproof": "certificate/1", "tool": "hand", "curve": copy.deepcopy(curve),
            "curve_sha256": hashlib.sha256(curve_block(curve)).hexdigest(),
            "statement": {"claim": "domain", "points": list(points), "sign": sign, "interval": list(interval),
                          "open": list(open_ends), "box": [[str(F(x)) for x in p] for p in box], "outcome": outcome},
            "evidence": evidence}


def at_piece(i, u):
    return {"piece": i, "u": u}


def side(axis, which):
    return {"axis": axis, "side": which}


def domain_of(curve, points, sign="+", interval=("0", "1"), open_ends=(False, False), size=100):
    chain = chain_of(curve)
    box = [[F(s * size)] * chain.dimension for s in (-1, 1)]
    return domain_sign.Domain(chain, {"points": points, "sign": sign, "open": open_ends, "box": box,
                                      "interval": [F(t) for t in interval]})


def place(*x):
    return domain_sign.at([F(c) for c in x])


# With (0,0), x, (2,0) the two differences have the determinant −2·x₂: for the sign "-" K is the half-plane x₂ > 0.
ARCH = bezier([(0, 0), (1, 1), (2, 0)])
ARCH_BOX = [(-1, -1), (3, 1)]

RECTANGLE = [[0, 1], [1, 2], [2, 3], [3, 0]]
CORNERS_OF_ARCH = [["-2", "0"], ["6", "0"], ["6", "2"], ["-2", "2"]]  # over the denominator 2


def arch(outcome, evidence, **others):
    return certificate(ARCH, [1], others.pop("box", ARCH_BOX), outcome, evidence, **{"sign": "-", **others})


def sandwich():
    inner, outer = copy.deepcopy(CORNERS_OF_ARCH), copy.deepcopy(CORNERS_OF_ARCH)
    return arch({"kind": "sandwich", "inner_measure": "4", "outer_measure": "4"},
                {"denominator": "2", "center": ["2", "1"],
                 "inner": {"points": inner, "cells": RECTANGLE},
                 "outer": {"points": outer, "cells": [[*cell, i] for i, cell in enumerate(RECTANGLE)]},
                 "rows": [at_piece(0, "1/3"), side(0, "high"), side(1, "high"), side(0, "low")]})


# With 0, x, (1,0,0), (1,1,0) the determinant of the three differences is x₃: K is the half-space x₃ > 0.
SPACE = bezier([(0, 0, 0), (1, 1, 1), (1, 0, 0), (1, 1, 0)])
CORNERS = list(itertools.product((-1, 1), (-1, 1), (0, 1)))  # in the order of their bits
FACES = [((0, 2, 6, 4), 0), ((1, 5, 7, 3), 1), ((0, 1, 3, 2), 2), ((4, 6, 7, 5), 3), ((0, 4, 5, 1), 4),
         ((2, 3, 7, 6), 5)]
TRIANGLES = [[*corners, row] for (a, b, c, d), row in FACES for corners in ((a, b, c), (a, c, d))]


def space():
    points = [[str(2 * x) for x in p] for p in CORNERS]
    return certificate(SPACE, [1], [(-1, -1, -1), (1, 1, 1)],
                       {"kind": "sandwich", "inner_measure": "4", "outer_measure": "4"},
                       {"denominator": "2", "center": ["0", "0", "1"],
                        "inner": {"points": points, "cells": [t[:3] for t in TRIANGLES]},
                        "outer": {"points": points, "cells": TRIANGLES},
                        "rows": [at_piece(0, "0"), side(2, "high"), side(0, "low"), side(0, "high"),
                                 side(1, "low"), side(1, "high")]})


def empty():
    return arch({"kind": "empty"}, {"rows": [at_piece(0, "1/2"), side(1, "high")], "multipliers": ["1", "2"]},
                box=[(-1, -2), (3, 0)])


def nearest():
    return arch({"kind": "nearest", "to": ["1", "-3"], "lower_squared": "9", "upper_squared": "9"},
                {"center": ["1", "1/2"], "point": ["1", "0"], "base": ["1", "0"], "rows": [at_piece(0, "1/2")],
                 "multipliers": ["3/2"]})


def change():
    return arch({"kind": "change", "from": ["1", "1/2"], "lower_squared": "1/4", "upper_squared": "1/4"},
                {"row": at_piece(0, "1/2")})


def ball():
    return arch({"kind": "ball", "lower": "1/2", "upper": "1/2"},
                {"center": ["1", "1/2"], "rows": [at_piece(0, "1/2"), side(1, "high")], "multipliers": ["1", "2"],
                 "lengths": ["2", "1"]})


GOOD = {"sandwich": sandwich, "space": space, "empty": empty, "nearest": nearest, "change": change, "ball": ball}


class Accepted(Checks):
    def test_both_forms(self):
        for name, make in GOOD.items():
            with self.subTest(name):
                statement = self.accept(make())
                self.assertEqual(statement, self.accept(binary(make())))
                self.assertIn("curve " + make()["curve_sha256"], domain.sentence(statement))
                self.reject(binary(make()) + b"\0", "no bytes left over")


class SignFunction(unittest.TestCase):
    def check_against_derivatives(self, curve, listed, sign, rng, exact=True):
        """h(u; x) against the Taylor series of the curve with x put in, piece by piece; return the comparisons."""
        d, compared = chain_of(curve).dimension, 0
        made = domain_of(curve, listed, sign, ("0", str(chain_of(curve).size)))
        x = [F(rng.randint(-9, 9), rng.randint(1, 4)) for _ in range(d)]
        moved, flat = copy.deepcopy(curve), 0
        for part in moved["bezier"]["pieces"] if "bezier" in moved else [moved["bspline"]]:
            for k in range(len(part["points"])):
                if flat + k in listed:
                    part["points"][k] = [str(c) for c in x]
            flat += len(part["points"])
        for i, arc in enumerate(chain_of(moved).pieces):
            n, u = len(arc.points) - 1, F(rng.randint(0, 7), 7)
            # the polynomials in v = (parameter − u), as sums of products (1−u−v)^(n−k) (u+v)^k
            series = [[F(0)] * (n + 1) for _ in range(d + 1)]
            for k, p in enumerate(arc.points):
                basis = [F(math.comb(n, k))]
                for factor in [(u, 1)] * k + [(1 - u, -1)] * (n - k):
                    basis = [factor[0] * a + factor[1] * b for a, b in zip([*basis, 0], [0, *basis])]
                for total, c in zip(series, (p[3], *p[:d])):
                    for j, b in enumerate(basis):
                        total[j] += c * b
            series = [(s + [F(0)] * 4)[:d + 1] for s in series]
            taylor = [[] for _ in range(d)]  # of c = X/w, by long division
            for axis in range(d):
                for j in range(d + 1):
                    known = sum(taylor[axis][m] * series[0][j - m] for m in range(j))
                    taylor[axis].append((series[axis + 1][j] - known) / series[0][0])
            derivatives = [[taylor[a][j] * math.factorial(j) for a in range(d)] for j in range(1, d + 1)]
            wanted = domain.determinant(derivatives) * (1 if sign == "+" else -1)
            found = made.sections[i].row_at(u).value(domain_sign.at(x))
            if exact and n >= d:
                w = series[0][0] / arc.points[0][3] * F(self.weight)
                power = d if len({p[3] for p in arc.points}) == 1 else d + 1
                wanted *= w ** power / math.prod(math.perm(n, k) for k in range(1, d + 1))
                self.assertEqual(found, wanted)
            else:
                self.assertEqual(found > 0, wanted > 0)
                self.assertEqual(found < 0, wanted < 0)
            compared += wanted != 0
        return compared

    def test_against_the_derivatives_of_the_curve(self):
        rng, compared = random.Random(11), 0
        for d, n, rational in itertools.product((2, 3), (1, 2, 3, 4, 6), (False, True)):
            points = [tuple(F(rng.randint(-9, 9), rng.randint(1, 4)) for _ in range(d)) for _ in range(n + 1)]
            weights = [F(rng.randint(1, 9), rng.randint(1, 4)) if rational else F(3, 2) for _ in points]
            self.weight = weights[0]
            for listed in ([0], [n], [n // 2, n // 2 + 1] if n > 1 else [1]):
                compared += self.check_against_derivatives(bezier(points, weights), listed, rng.choice("+-"), rng)
        self.assertGreater(compared, 30)

    def test_splines(self):
        rng, compared = random.Random(12), 0
        for d, p, weights in itertools.product((2, 3), (2, 3, 4), (None, [1, 3, F(1, 2), 2, 1, 1, F(5, 3), 1])):
            knots = [0] * p + [-1, 0][1:] + sorted(rng.randint(1, 9) for _ in range(7 - p)) + [10] * (p + 1)
            knots = [k + i if 0 < k < 10 else k for i, k in enumerate(knots)]
            knots = knots[:8] + [knots[7] + 10] * (p + 1)
            points = [tuple(F(rng.randint(-9, 9)) for _ in range(d)) for _ in range(8)]
            self.weight = 1
            for listed in ([0], [3], [2, 5]):
                compared += self.check_against_derivatives(bspline(p, knots, points, weights), listed, "-", rng,
                                                           exact=weights is None)
        self.assertGreater(compared, 60)

    def test_hand_cases(self):
        def values(curve, listed, x, **others):
            made = domain_of(curve, listed, **others)
            return [[F(y, s.scale * x.denominator) for y in s.values(x)] for s in made.sections.values()]

        x = place(5, F(7, 3))
        self.assertEqual(values(ARCH, [1], x), [[F(-14, 3)]])
        self.assertEqual(values(ARCH, [1], x, sign="-"), [[F(14, 3)]])
        # a quarter circle: det((1,1,0), (w, w·x), (2,0,2)) = 2w (x₁ + x₂ − 1)
        self.assertEqual(values(bezier([(1, 0), (1, 1), (0, 1)], [1, 3, 2]), [1], x), [[6 * (5 + F(7, 3) - 1)]])
        # a spline of two pieces with h = −2x₂ and 8 − 2x₁
        self.assertEqual(values(WEDGE, [1], x, interval=("0", "2")), [[F(-14, 3)], [-2]])
        self.assertEqual(values(SPACE, [1], place(7, 8, 9)), [[9]])
        self.assertEqual(values(CUBIC, [1], place(1, -1)), [[4, F(-1, 2), 7]])
        self.assertEqual(values(bezier([(0, 0), (1, 1)]), [1], x), [[0]])  # n < d

    def test_sections_are_restrictions(self):
        a, b = F(2, 7), F(25, 9)
        points = [(0, 0, 1), (1, 3, 4), (4, 1, -2), (5, 5, 0), (7, 2, 3), (9, 3, 9)]
        for d, weights in itertools.product((2, 3), (None, [1, 2, 1, 3, 1, 1])):
            curve = bspline(3, [0, 0, 0, 0, 1, 3, 4, 4, 4, 4], [p[:d] for p in points], weights)
            made = domain_of(curve, [2], interval=(a, b))
            self.assertEqual([(s.u0, s.u1) for s in made.sections.values()], [(a, 1), (0, 1), (0, F(7, 9))])
            x = place(3, F(1, 3), F(-5, 2)) if d == 3 else place(3, F(1, 3))
            for section in made.sections.values():
                n = len(section.g) - 1
                for v in (F(0), F(1, 3), F(1)):
                    g = sum(F(y, section.scale * x.denominator) * math.comb(n, k) * v ** k * (1 - v) ** (n - k)
                            for k, y in enumerate(section.values(x)))
                    self.assertEqual(g, section.row_at(section.u0 + v * (section.u1 - section.u0)).value(x))

    def test_open_ends_lose_a_factor(self):
        # straight at both ends; also where only a part of the piece is looked at
        points = [(0, 0), (1, 0), (2, 0), (5, 3), (4, 4), (3, 5), (2, 6)]
        rng = random.Random(3)
        for a, b, open_ends, zeros in ((F(0), F(1), (True, True), (1, 1)), (F(0), F(1), (True, False), (1, 0)),
                                       (F(0), F(2, 3), (True, True), (1, 0)), (F(1, 3), F(1), (True, True), (0, 1)),
                                       (F(0), F(1), (False, False), (0, 0))):
            whole, = domain_of(bezier(points), [3]).sections.values()
            part, = domain_of(bezier(points), [3], interval=(a, b), open_ends=open_ends).sections.values()
            self.assertEqual(len(whole.g) - len(part.g), sum(zeros))
            x, n = place(rng.randint(-9, 9), rng.randint(-9, 9)), len(part.g) - 1
            for v in (F(1, 5), F(1, 2), F(3, 4)):
                g = sum(F(y, part.scale * x.denominator) * math.comb(n, k) * v ** k * (1 - v) ** (n - k)
                        for k, y in enumerate(part.values(x)))
                self.assertNotEqual(g, 0)
                self.assertEqual(g * v ** zeros[0] * (1 - v) ** zeros[1], whole.row_at(a + v * (b - a)).value(x))
            for u, is_open, c in ((a, open_ends[0], part.g[0]), (b, open_ends[1], part.g[-1])):
                row = part.row_at(u)
                self.assertEqual(row.strict, not is_open)
                if is_open:
                    self.assertEqual(row.gradient(), [F(y, part.scale) for y in c[:-1]])

    def test_a_section_that_vanishes_stays(self):
        straight = bezier([(0, 0), (1, 0), (2, 0), (3, 0), (9, 9)])
        section, = domain_of(straight, [4], open_ends=(True, True)).sections.values()
        self.assertEqual(len(section.g), 5 - 2)  # h is a multiple of u² here
        section, = domain_of(bezier([(0, 0), (1, 1)]), [1], open_ends=(True, True)).sections.values()
        self.assertEqual(section.g, [(0, 0, 0)])
        self.assertEqual(len(domain_of(SPACE, [0], open_ends=(True, True)).sections[0].g), 1)


# With (0,0), x, (2,2), (0,3): h has the coefficients 2x₁−2x₂, x₁/2+x₂, 6−x₁−2x₂.
CUBIC = bezier([(0, 0), (1, 0), (2, 2), (0, 3)])
WEDGE = bspline(2, [0, 0, 0, 1, 2, 2, 2], [(0, 0), (3, -1), (4, 0), (4, 4)])


class Halving(Checks):
    def shown(self, x, closure=False, **others):
        made = domain_of(CUBIC, [1], **others)
        (made.require_in_closure if closure else made.require_in_k)(x, "x")

    def refused(self, reason, *values, **others):
        with self.assertRaisesRegex(document.Reject, reason):
            self.shown(*values, **others)

    def test_coefficients_of_both_signs(self):
        self.shown(place(1, 0))
        self.shown(place(1, -1))  # 4, −1/2, 7
        self.refused("not positive", place(1, 1))
        self.shown(place(1, 1), True)  # 0, 3/2, 3

    def test_double_roots(self):
        quarter, seventh = place(F(-10, 3), F(-13, 3)), place(F(-11, 12), F(-25, 24))
        self.shown(quarter, True)  # 2, −6, 18: the root 1/4
        self.refused("not positive", quarter)
        self.refused("60 halvings", seventh, True)  # 1/4, −3/2, 9: the root 1/7 is never hit
        self.shown(seventh, True, interval=("1/7", "1"))
        self.shown(seventh, True, interval=("0", "1/7"))
        self.shown(seventh, interval=("1/6", "1"))
        self.refused("not positive", seventh, interval=("1/7", "1"))

    def test_limits(self):
        def square(k):
            """The coefficients of (2^k u − 1)²; parts from 0 need halving until they end at the root."""
            return [1, 1 - 2 ** k, (2 ** k - 1) ** 2]

        domain_sign.require_by_halving(square(60), False, "")
        with self.assertRaisesRegex(document.Reject, "60 halvings"):
            domain_sign.require_by_halving(square(61), False, "")
        with mock.patch.object(domain_sign, "MAX_PARTS", 11):
            domain_sign.require_by_halving(square(5), False, "")  # the whole and two parts of each depth
        with mock.patch.object(domain_sign, "MAX_PARTS", 10), self.assertRaisesRegex(document.Reject, "in 10 parts"):
            domain_sign.require_by_halving(square(5), False, "")
        domain_sign.require_by_halving([1, -3, 10], True, "")  # a positive minimum
        with self.assertRaisesRegex(document.Reject, "not non-negative"):
            domain_sign.require_by_halving([1, -3, 8], False, "")  # 9 > 8


class Damage(Checks):
    def damage(self, make, table):
        """Each change of one field is rejected for its reason, or accepted where the reason is None."""
        self.accept(make())
        for path, value, reason in table:
            path = tuple(int(key) if key.isdigit() else key for key in path.split("."))
            with self.subTest(make=make.__name__, path=path, value=value):
                bad = self.changed(make(), path, value)
                self.accept(bad) if reason is None else self.reject(bad, reason)


class Sandwich(Damage):
    def test_obligations(self):
        shifted = [["-2", "-1"], ["6", "0"], ["6", "2"], ["-2", "2"]]
        small = [["-2", "1"], ["6", "1"], ["6", "2"], ["-2", "2"]]
        self.damage(sandwich, [
            ("statement.outcome.inner_measure", "3", None),
            ("statement.outcome.inner_measure", "4000001/1000000", "inner: expected a measure ≥ 4000001"),
            ("statement.outcome.inner_measure", "0", "number > 0"),
            ("statement.outcome.inner_measure", "-1", "number > 0"),
            ("statement.outcome.outer_measure", "5", None),
            ("statement.outcome.outer_measure", "3999999/1000000", "outer: expected a measure ≤ 3999999"),
            ("evidence.center", ["2", "0"], "center: not shown in K"),
            ("evidence.center", ["8", "1"], "center: expected a point of the box"),
            ("evidence.center", ["0", "1"], None),
            ("evidence.denominator", "4", "inner: expected a measure"),
            ("evidence.denominator", "0", "number ≥ 1"),
            ("evidence.denominator", "1/2", "integer"),
            ("evidence.inner.points", shifted, "inner point 0: not shown in cl K"),
            ("evidence.inner.points", [*CORNERS_OF_ARCH, ["0", "-1"]], "inner point 4: not shown"),
            ("evidence.inner.points", [*CORNERS_OF_ARCH, ["0", "3"]], "inner point 4: .* box"),
            ("evidence.outer.points", [*CORNERS_OF_ARCH, ["0", "-9"]], None),
            ("evidence.outer.points", small, "outer cell 0: expected a positive determinant"),
            ("evidence.outer.points.2", ["6", "1"], "outer cell 2: expected a row ≤ 0"),
            ("evidence.outer.cells.0.2", 1, "outer cell 0: expected a row ≤ 0"),
            ("evidence.outer.cells.0.2", 4, "a row below 4"),
            ("evidence.outer.cells.0.2", -1, "no place here|integer from"),
            ("evidence.outer.cells.0.2", True, "integer"),
            ("evidence.outer.cells.0", [0, 1], "list of 3"),
            ("evidence.inner.cells.0", [0, 1, 2], "list of 2"),
            ("evidence.inner.cells.0.1", 4, "points below 4"),
            ("evidence.rows.0.u", "1", None),
            ("evidence.rows.0.u", "2", "a parameter of a section"),
            ("evidence.rows.0.u", "-1/2", "a parameter of a section"),
            ("evidence.rows.0.u", "2/6", "lowest terms"),
            ("evidence.rows.0.piece", 1, "a parameter of a section"),
            ("evidence.rows.1.axis", 2, "an axis below 2"),
            ("evidence.rows.1.side", "up", "'low' or 'high'"),
            ("evidence.rows.1.side", "low", "row ≤ 0 at the points"),
            ("evidence.rows.1.extra", "0", "unknown"),
            ("evidence.rows.1.u", "0", "unknown"),
            ("evidence.rows.0.axis", 0, "unknown"),
            ("evidence.rows.1.side", ..., "missing"),
            ("evidence.rows.1", "high", "an object"),
            ("evidence.rows", sandwich()["evidence"]["rows"][:3], "a row below 3"),
            ("statement.sign", "+", "center: not shown in K"),
        ])

    def test_counts(self):
        # points, cells and rows of both stars together: 4 + 4, 4 + 4 and 4
        for most, reason in ((20, None), (19, "at most 19 points, cells and rows, found 20")):
            with mock.patch.object(domain, "MAX_COUNT", most):
                self.accept(sandwich()) if reason is None else self.reject(sandwich(), reason)

    def test_center_on_a_side_of_the_box(self):
        # then no row of this side is positive there, but no inner star is around it either
        c = sandwich()
        c["statement"]["box"] = [["-1", "-1"], ["3", "1/2"]]
        self.reject(c, "inner point 2: expected a point of the box")
        c["evidence"]["inner"]["points"] = [["-2", "0"], ["6", "0"], ["6", "1"], ["-2", "1"]]
        self.reject(c, "inner cell 2: expected a positive determinant")
        triangle = {"points": [["0", "0"], ["4", "0"], ["2", "2"]], "cells": [[0, 1], [1, 2], [2, 0]]}
        self.reject(self.changed(c, ("evidence", "inner"), triangle), "inner point 2: .* box")

    def test_star_in_the_plane(self):
        inner = ("evidence", "inner", "cells")
        for cells, reason in (([[0, 1], [1, 2], [2, 3]], "a boundary that cancels"),
                              ([[1, 0], [2, 1], [3, 2], [0, 3]], "inner cell 0: expected a positive determinant"),
                              (RECTANGLE * 2, "inner cell 4: it overlaps cell 0"),
                              ([[1, 2], [2, 3], [3, 0], [0, 1]], None),
                              ([*RECTANGLE, [0, 1]], "overlaps|cancels"),
                              ([[0, 1], [1, 3], [3, 0]], None),
                              ([[0, 2], [2, 0]], "positive determinant"),
                              ([[0, 0]], "positive determinant"), ([], "at least one cell")):
            c = self.changed(sandwich(), inner, cells)
            c["statement"]["outcome"]["inner_measure"] = "1/100"
            if cells and [1, 3] in cells:  # the center is on the segment from point 1 to point 3
                c["evidence"]["center"] = ["1", "1"]
            with self.subTest(cells=cells):
                self.accept(c) if reason is None else self.reject(c, reason)

    def test_twice_around(self):
        # two turns over points of their own: every number is once first and once second
        c = sandwich()
        points = c["evidence"]["outer"]["points"]
        turns = points + points
        cells = [[k, (k + 1) % 8, k % 4] for k in range(8)]
        c["evidence"]["outer"].update(points=turns, cells=cells)
        c["statement"]["outcome"]["outer_measure"] = "100"
        self.reject(c, "outer cell 4: it overlaps cell 0")
        c["evidence"]["inner"].update(points=turns, cells=[cell[:2] for cell in cells])
        self.reject(c, "inner cell 4: it overlaps cell 0")
        # six sectors, twice around, so that no cell is the same as another
        star = [[6, 0], [-2, 4], [-2, -2], [5, 3], [-4, 1], [1, -4]]
        with self.assertRaisesRegex(document.Reject, "overlaps cell 0"):
            domain.star([0, 0], star, [[k, (k + 1) % 6] for k in range(6)], "star")
        self.assertEqual(domain.star([0, 0], star[:3], [[0, 1], [1, 2], [2, 0]], "star"), 24 + 12 + 12)
        # the sum (2, 2) of the first cell is on the common side of two others only
        star = [[2, 0], [0, 2], [-9, -3], [5, -9], [1, 1], [-9, 8], [-5, -9]]
        with self.assertRaisesRegex(document.Reject, "cell 3: it overlaps cell 0"):
            domain.star([0, 0], star, [[k, (k + 1) % 7] for k in range(7)], "star")
        self.assertEqual(domain.star([0, 0], [[1, 0], [0, 1], [-1, -1]], [[0, 1], [1, 2], [2, 0]], "star"), 3)

    def test_star_in_space(self):
        self.accept(space())
        inner = ("evidence", "inner", "cells")
        cells = space()["evidence"]["inner"]["cells"]
        turned = [cells[0][1:] + cells[0][:1], *cells[1:]]
        flipped = [[cells[0][1], cells[0][0], cells[0][2]], *cells[1:]]
        other_diagonal = [[0, 2, 4], [2, 6, 4], *cells[2:]]
        for made, reason in ((turned, None), (flipped, "inner cell 0: expected a positive determinant"),
                             (cells[1:], "a boundary that cancels"), (cells * 2, "overlaps cell 0"),
                             (other_diagonal, None), ([[0, 2, 4], *cells[1:]], "cancels|overlaps"),
                             (cells[::-1], None), ([*cells, cells[5]], "cancels|overlaps")):
            with self.subTest(cells=made):
                c = self.changed(space(), inner, made)
                self.accept(c) if reason is None else self.reject(c, reason)
        self.damage(space, [("statement.outcome.inner_measure", "401/100", "inner: expected a measure"),
                            ("statement.outcome.outer_measure", "399/100", "outer: expected a measure"),
                            ("evidence.outer.cells.3.3", 0, "outer cell 3: expected a row ≤ 0"),
                            ("evidence.center", ["0", "0", "0"], "center: not shown in K"),
                            ("evidence.center", ["0", "0"], "list of 3"),
                            ("statement.sign", "-", "center: not shown in K")])

    def test_spline_and_partial_interval(self):
        def wedge(interval, x_most):
            points = [["0", "-4"], [str(2 * x_most), "-4"], [str(2 * x_most), "0"], ["0", "0"]]
            area = str(2 * x_most)
            return certificate(WEDGE, [1], [(0, -2), (6, 2)],
                               {"kind": "sandwich", "inner_measure": area, "outer_measure": area},
                               {"denominator": "2", "center": ["2", "-2"],
                                "inner": {"points": points, "cells": RECTANGLE},
                                "outer": {"points": points, "cells": [[*c, i] for i, c in enumerate(RECTANGLE)]},
                                "rows": [side(1, "low"), at_piece(1, "1/2") if x_most == 4 else side(0, "high"),
                                         at_piece(0, "1/2"), side(0, "low")]}, interval=interval)

        self.accept(wedge(("0", "2"), 4))
        self.accept(wedge(("1/2", "3/2"), 4))
        self.accept(wedge(("0", "1"), 6))
        self.reject(wedge(("0", "2"), 6), "inner point 1: not shown in cl K, piece 1")
        self.reject(wedge(("0", "1"), 4), "row 1: expected a parameter of a section")
        for u, reason in (("0", None), ("1/2", None), ("2/3", "parameter of a section")):
            c = self.changed(wedge(("1/2", "3/2"), 4), ("evidence", "rows", 1, "u"), u)
            self.accept(c) if reason is None else self.reject(c, reason)


class Empty(Damage):
    def test_obligations(self):
        self.damage(empty, [
            ("evidence.multipliers", ["2", "4"], None),
            ("evidence.multipliers", ["2", "1"], "a sum of rows that is constant"),
            ("evidence.multipliers", ["0", "0"], "one that is not 0"),
            ("evidence.multipliers", ["-1", "-2"], "number ≥ 0"),
            ("evidence.multipliers", ["1/2", "1"], "integer"),
            ("evidence.multipliers", ["1", "2", "0"], "as many as rows"),
            ("evidence.multipliers", [1, 2], "integer"),
            ("statement.box.1.1", "-1", None),
            ("statement.box.1.1", "1/2", "a sum < 0, or 0 with a strict row"),
            ("evidence.rows.0", side(1, "low"), "a sum of rows that is constant"),
            ("evidence.denominator", "1", "unknown"),
            ("statement.outcome.measure", "0", "unknown"),
        ])

    def test_an_open_end_is_not_strict(self):
        for u, open_ends, holds in (("0", (True, False), False), ("0", (False, True), True),
                                    ("1", (True, False), True), ("1", (False, True), False),
                                    ("1/2", (True, True), True)):
            c = empty()
            c["statement"]["open"] = list(open_ends)
            c["evidence"]["rows"][0]["u"] = u
            self.accept(c) if holds else self.reject(c, "a sum < 0, or 0 with a strict row, found 0")
            c["statement"]["box"][1][1] = "-1"
            self.accept(c)

    def test_sides_alone_prove_nothing(self):
        c = empty()
        c["evidence"].update(rows=[side(0, "low"), side(0, "high")], multipliers=["1", "1"])
        self.reject(c, "a sum < 0, or 0 with a strict row, found 4")
        c["evidence"].update(rows=[side(0, "low"), side(0, "high"), at_piece(0, "1/2")], multipliers=["1", "1", "0"])
        self.reject(c, "found 4")

    def test_degree_below_the_dimension(self):
        line = bezier([(0, 0), (1, 0)])
        c = certificate(line, [1], ARCH_BOX, {"kind": "empty"}, {"rows": [at_piece(0, "1/2")], "multipliers": ["1"]})
        self.accept(c)
        c["statement"]["open"] = [True, True]
        self.accept(c)
        self.reject(self.changed(c, ("evidence", "rows", 0, "u"), "0"), "a strict row, found 0")


class Nearest(Damage):
    def test_obligations(self):
        self.damage(nearest, [
            ("statement.outcome.upper_squared", "10", None),
            ("statement.outcome.upper_squared", "899/100", "p−y"),
            ("statement.outcome.lower_squared", "8", None),
            ("statement.outcome.lower_squared", "901/100", "a bound ≥ 901/100, found 9"),
            ("statement.outcome.lower_squared", "-1", "number ≥ 0"),
            ("statement.outcome.to", ["1", "-3", "0"], "2 coordinates"),
            ("statement.outcome.to", ["1", "-4"], "p−y|z − y"),
            ("statement.outcome.to", None, "list"),
            ("statement.outcome.to", "Fair", "list"),
            ("evidence.center", ["1", "0"], "center: not shown in K"),
            ("evidence.center", ["1", "2"], "center: .* box"),
            ("evidence.point", ["1", "-1/8"], "point: not shown in cl K"),
            ("evidence.point", ["1", "2"], "point: .* box"),
            ("evidence.point", ["1", "1/8"], "p−y"),
            ("evidence.base", ["1", "1/8"], "z − y"),
            ("evidence.base", ["9/8", "0"], "z − y"),
            ("evidence.multipliers", ["1"], "z − y"),
            ("evidence.multipliers", ["-3/2"], "number ≥ 0"),
            ("evidence.multipliers", [], "as many as rows"),
            ("evidence.rows.0", side(1, "low"), "z − y"),
            ("evidence.point", ..., "missing"),
        ])

    def test_another_base(self):
        c = nearest()
        c["evidence"].update(base=["1", "-1"], multipliers=["1"])
        self.reject(c, "a bound ≥ 9, found 8")
        self.accept(self.changed(c, ("statement", "outcome", "lower_squared"), "8"))

    def test_inside(self):
        c = nearest()
        c["statement"]["outcome"].update(to=["1", "1/4"], lower_squared="0", upper_squared="0")
        c["evidence"].update(point=["1", "1/4"], base=["1", "1/4"], rows=[], multipliers=[])
        self.accept(c)
        self.reject(self.changed(c, ("statement", "outcome", "lower_squared"), "1/100"), "a bound")

    def test_the_scale_of_a_row_counts(self):
        # weight 3/2 throughout: h = (9/4)·2x₂, and half of it at …; the multiplier goes down with it
        c = nearest()
        c["curve"] = bezier([(0, 0), (1, 1), (2, 0)], [F(3, 2)] * 3)
        c["curve_sha256"] = hashlib.sha256(curve_block(c["curve"])).hexdigest()
        self.reject(c, "z − y")
        self.accept(self.changed(c, ("evidence", "multipliers"), ["2/3"]))

    def test_the_scale_at_an_open_end(self):
        # (0,0), (1,0), (2,0), x: h = 0, x₂/2, x₂, so g = x₂, x₂ on [0,1]; on [0,1/2] h = 0, x₂/4, x₂/2 and g = x₂/2
        for end, multiplier in (("1", "3"), ("1/2", "6")):
            c = certificate(STRAIGHT, [3], ARCH_BOX, nearest()["statement"]["outcome"],
                            {**nearest()["evidence"], "rows": [at_piece(0, "0")], "multipliers": [multiplier]},
                            interval=("0", end), open_ends=(True, False))
            self.accept(c)
            self.reject(self.changed(c, ("evidence", "multipliers"), ["1"]), "z − y")
            self.reject(self.changed(c, ("statement", "open"), [False, False]), "center: not shown in K")
            self.accept({**c, "evidence": {**c["evidence"], "rows": [at_piece(0, "1/2")], "multipliers": ["6"]}})


STRAIGHT = bezier([(0, 0), (1, 0), (2, 0), (5, 5)])


class Fair(Damage):
    def energy(self, curve, lengths, listed, x):
        """∫ |c''|² of the curve with x put in: Simpson's rule on parts exact for the degree, from the pieces."""
        moved, flat = copy.deepcopy(curve), 0
        for part in moved["bezier"]["pieces"] if "bezier" in moved else [moved["bspline"]]:
            for k in range(len(part["points"])):
                if flat + k in listed:
                    part["points"][k] = [str(c) for c in x]
            flat += len(part["points"])
        total = F(0)
        for arc, length in zip(chain_of(moved).pieces, lengths):
            for axis in range(len(x)):
                power, n = [F(0)], len(arc.points) - 1
                for k, p in enumerate(arc.points):
                    term = [F(math.comb(n, k) * p[axis], p[3])]
                    for factor in [(0, 1)] * k + [(1, -1)] * (n - k):
                        term = [factor[0] * a + factor[1] * b for a, b in zip([*term, 0], [0, *term])]
                    power = [a + b for a, b in itertools.zip_longest(power, term, fillvalue=F(0))]
                second = [j * (j - 1) * c for j, c in enumerate(power)][2:]
                total += sum(a * b / (i + j + 1) for (i, a), (j, b) in
                             itertools.product(enumerate(second), repeat=2)) / F(length) ** 3
        return total

    def test_least_energy(self):
        rng = random.Random(8)
        knots = [0, 0, 0, 0, 1, F(5, 2), 3, 7, 7, 7, 7]
        two = {"bezier": {"pieces": [piece([(0, 0), (1, 2), (3, 1)]), piece([(3, 1), (4, 0), (5, 3), (6, 6), (9, 9)],
                                                                             [2] * 5)]}}
        cases = [(bspline(3, knots, [[rng.randint(-9, 9) for _ in range(3)] for _ in range(7)], [F(3, 2)] * 7),
                  [1, F(3, 2), F(1, 2), 4], listed) for listed in ([0], [3], [2, 4], [6])]
        cases += [(two, [1, 1], listed) for listed in ([0], [1], [2, 3], [4, 5], [7])]
        cases.append((bezier([(0, 0), (1, 3), (2, 2)]), [1], [1]))
        for curve, lengths, listed in cases:
            made = domain_of(curve, listed)
            found = domain.fair_point(made)
            here = self.energy(curve, lengths, listed, found)
            for axis in range(made.dimension):
                step = [F(a == axis) for a in range(made.dimension)]
                more = self.energy(curve, lengths, listed, [x + s for x, s in zip(found, step)])
                less = self.energy(curve, lengths, listed, [x - s for x, s in zip(found, step)])
                self.assertEqual(more, less)
                self.assertGreater(more, here)

    def test_certificate(self):
        # the second difference of the arch vanishes for x = (1, 0), on the boundary of K
        c = nearest()
        c["statement"]["outcome"].update(to="fair", lower_squared="0", upper_squared="0")
        c["evidence"].update(point=["1", "0"], base=["1", "0"], rows=[], multipliers=[])
        self.assertIn("from the fair point", domain.sentence(self.accept(c)))
        self.reject(self.changed(c, ("evidence", "point"), ["1", "1/8"]), "p−y")

    def test_refused(self):
        with self.assertRaisesRegex(document.Reject, "polynomial pieces only"):
            domain.fair_point(domain_of(bezier([(0, 0), (1, 1), (2, 0)], [1, 2, 1]), [1]))
        with self.assertRaisesRegex(document.Reject, "denominator"):
            domain.fair_point(domain_of(bezier([(0, 0), (1, 1)]), [1]))
        mixed = {"bezier": {"pieces": [piece([(0, 0), (1, 1), (2, 0)]), piece([(2, 0), (3, 0), (4, 1)], [1, 2, 1])]}}
        with self.assertRaisesRegex(document.Reject, "polynomial pieces only"):
            domain.fair_point(domain_of(mixed, [1]))


class Change(Damage):
    def test_obligations(self):
        self.damage(change, [
            ("statement.outcome.lower_squared", "0", None),
            ("statement.outcome.lower_squared", "26/100", "lowest terms"),
            ("statement.outcome.lower_squared", "13/50", "from: not shown so far"),
            ("statement.outcome.upper_squared", "1", None),
            ("statement.outcome.upper_squared", "6/25", "evidence.row: expected a squared distance ≤ 6/25, found 1/4"),
            ("statement.outcome.from", ["1", "0"], "from: not shown in K"),
            ("statement.outcome.from", ["100", "1/2"], None),
            ("statement.outcome.from", ["1", "1/2", "0"], "2 coordinates"),
            ("statement.outcome.from", "fair", "list"),
            ("evidence.row", side(1, "low"), "a row of a piece"),
            ("evidence.row.u", "3", "a parameter of a section"),
            ("evidence.rows", [], "unknown"),
            ("evidence.row", ..., "missing"),
        ])

    def test_margin_between_the_coefficients(self):
        # g² − L·|A|² for the cubic: from (−2, −16/5), h = 12/5, −21/5, 72/5, so that the least is inside
        made = domain_of(CUBIC, [1])
        p, lows = place(-2, F(-16, 5)), []
        for u in (F(k, 200) for k in range(201)):
            row = made.row({"piece": 0, "u": u}, "")
            lows.append(row.value(p) ** 2 / sum(a * a for a in row.gradient()))
        least, u = min((low, F(k, 200)) for k, low in enumerate(lows))
        self.assertTrue(0 < u < 1)
        made.require_margin(p, least * F(9, 10), "")
        with self.assertRaisesRegex(document.Reject, "so far"):
            made.require_margin(p, least * F(10001, 10000), "")
        outcome = {"kind": "change", "from": ["-2", "-16/5"], "lower_squared": str(least * F(9, 10)),
                   "upper_squared": str(least)}
        c = certificate(CUBIC, [1], ARCH_BOX, outcome, {"row": at_piece(0, str(u))})
        self.accept(c)
        self.reject(self.changed(c, ("evidence", "row", "u"), "0"), "a squared distance")

    def test_a_constant_row(self):
        # the first piece does not depend on x
        curve = {"bezier": {"pieces": [piece([(0, 0), (1, 0), (2, 1)]), piece([(2, 1), (3, 2), (4, 4)])]}}
        c = certificate(curve, [5], ARCH_BOX, {"kind": "change", "from": ["0", "7"], "lower_squared": "0",
                                               "upper_squared": "99"}, {"row": at_piece(1, "0")}, interval=("0", "2"))
        self.accept(c)
        self.reject(self.changed(c, ("evidence", "row", "piece"), 0), "a row that is not constant")


class Ball(Damage):
    def test_obligations(self):
        self.damage(ball, [
            ("statement.outcome.lower", "1/4", None),
            ("statement.outcome.lower", "3/5", "center: expected a distance ≥ 3/5"),
            ("statement.outcome.lower", "0", "number > 0"),
            ("statement.outcome.upper", "1", None),
            ("statement.outcome.upper", "49/100", "a bound ≤ 49/100, found 1/2"),
            ("evidence.center", ["1", "9/16"], "a distance ≥ 1/2"),
            ("evidence.center", ["1", "7/16"], "center: not shown so far"),
            ("evidence.center", ["-3/4", "1/2"], "a distance ≥ 1/2"),
            ("evidence.center", ["-1/2", "1/2"], None),
            ("evidence.lengths", ["2", "2"], "length 1: expected"),
            ("evidence.lengths", ["2", "1/2"], "a bound"),
            ("evidence.lengths", ["-2", "1"], "number ≥ 0"),
            ("evidence.lengths", ["0", "0"], "one that is not 0"),
            ("evidence.lengths", ["2"], "as many as rows"),
            ("evidence.multipliers", ["0", "0"], "one that is not 0"),
            ("evidence.multipliers", ["1", "1"], "a sum of rows that is constant"),
            ("evidence.multipliers", ["1", "-2"], "number ≥ 0"),
            ("evidence.multipliers", ["1"], "as many as rows"),
            ("evidence.multipliers", ["1/2", "1"], None),
            ("evidence.point", ["1", "1"], "unknown"),
        ])
        c = ball()
        c["statement"]["outcome"]["lower"] = "1/100"
        self.reject(self.changed(c, ("evidence", "center"), ["1", "0"]), "center: not shown in K")


class Statement(Damage):
    def test_fields(self):
        self.damage(sandwich, [
            ("statement.points", [], "at least one"),
            ("statement.points", [3], "indices below 3"),
            ("statement.points", [1, 1], "increasing order"),
            ("statement.points", [2, 1], "increasing order"),
            ("statement.points", [1 << 32], "integer from"),
            ("statement.points", ["1"], "integer from"),
            ("statement.points", [True], "integer from"),
            ("statement.points", 1, "a list"),
            ("statement.sign", "±", "'\\+' or '-'"),
            ("statement.interval", ["0", "2"], "a < b ≤ 1"),
            ("statement.interval", ["-1", "1"], "0 ≤ a"),
            ("statement.interval", ["1", "1"], "a < b"),
            ("statement.interval", ["1", "0"], "a < b"),
            ("statement.interval", ["1/3", "1/2"], None),
            ("statement.interval", ["0", "1/3"], None),
            ("statement.interval", ["0", "1/4"], "row 0: expected a parameter of a section"),
            ("statement.interval", ["0"], "list of 2"),
            ("statement.interval", ["0", 1], "fraction"),
            ("statement.open", [0, 1], "true or false"),
            ("statement.open", ["false", "false"], "true or false"),
            ("statement.open", [False], "list of 2"),
            ("statement.open", [True, True], None),
            ("statement.box", [["-1", "-1"], ["3", "1"], ["3", "1"]], "list of 2"),
            ("statement.box", [["-1", "-1"], ["3"]], "two positions of 2"),
            ("statement.box", [["-1", "-1", "0"], ["3", "1", "1"]], "list of 3|two positions"),
            ("statement.box", [["3", "-1"], ["3", "1"]], "low < high"),
            ("statement.box", [["-1", "1"], ["3", "-1"]], "low < high"),
            ("statement.outcome.kind", "Sandwich", "'sandwich' or"),
            ("statement.outcome.kind", "empty", "unknown"),
            ("statement.outcome.kind", ..., "missing"),
            ("statement.outcome", {"kind": "empty"}, "unknown|missing"),
            ("statement.outcome", None, "an object"),
            ("statement.convention", "smooth", "unknown"),
            ("statement.claim", "domains", "'msd' or 'domain'"),
            ("statement.claim", "msd", "unknown"),
            ("evidence.tree", None, "unknown"),
            ("evidence.inner.rows", [], "unknown"),
            ("evidence.denominator", "02", "canonical"),
            ("evidence.center.0", "2.0", "canonical"),
            ("evidence.center.0", 2, "string"),
            ("evidence.inner.points.0.0", "-2/1", "q ≥ 2"),
            ("statement.outcome.inner_measure", "8/2", "lowest terms"),
            ("snapped_joints", 1, None),
        ])
        for name, make in GOOD.items():
            for part in ("statement", "evidence"):
                for field in make()[part]:
                    with self.subTest(name, field=field):
                        self.reject(self.changed(make(), (part, field), ...), "missing")

    def test_joints_of_pieces(self):
        curve = {"bezier": {"pieces": [piece([(0, 0), (1, 0), (2, 1)]), piece([(2, 1), (3, 3), (3, 5)], [1, 1, 2]),
                                       piece([(3, 5), (2, 7), (0, 0)])]}}
        for listed in ([0], [1], [2, 3], [5, 6], [8], [0, 2, 3, 8]):
            domain_of(curve, listed)
        for listed in ([2], [3], [5], [6], [2, 5], [3, 6], [1, 2], [2, 3, 5]):
            with self.assertRaisesRegex(document.Reject, "of a joint"):
                domain_of(curve, listed)
        domain_of(WEDGE, [2])  # of a spline every index stands alone

    def test_a_point_of_a_curve_that_stays(self):
        # the position that the curve gives to the moved point is not used, but the curve itself must be one
        c = self.changed(sandwich(), ("curve", "bezier", "pieces", 0, "points", 1), ["7", "7"])
        c["curve_sha256"] = hashlib.sha256(curve_block(c["curve"])).hexdigest()
        self.accept(c)
        c["curve"] = bezier([(0, 0), (0, 0), (0, 0)])
        c["curve_sha256"] = hashlib.sha256(curve_block(c["curve"])).hexdigest()
        self.reject(c, "single point")


if __name__ == "__main__":
    unittest.main()
