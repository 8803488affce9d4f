#!/usr/bin/env python3
"""Tests of the checker on tiny certificates made by hand.  Run: python3 test_check.py

The encoder below is written apart from the checker's own, from docs/FORMAT.md §7.
"""

import contextlib
import copy
import hashlib
import io
import json
import math
import os
import random
import struct
import tempfile
import unittest
from fractions import Fraction as F
from unittest import mock

import check
import document
import msd
from curve import read_chain

# ---------------------------------------------------------------- a second encoder


def leb(n):
    out = bytearray()
    while True:
        n, low = n >> 7, n & 127
        if n == 0:
            out.append(low)
            return bytes(out)
        out.append(low + 128)


def zigzag(n):
    return leb(2 * n if n >= 0 else -2 * n - 1)


def numbers(texts):
    values = [F(t) for t in texts]
    q = math.lcm(*(v.denominator for v in values))
    return leb(q) + b"".join(zigzag(int(v * q)) for v in values)


def curve_block(curve):
    def tail(part):
        out = numbers([x for p in part["points"] for x in p])
        return out + (b"\1" + numbers(part["weights"]) if "weights" in part else b"\0")

    if "bspline" in curve:
        b = curve["bspline"]
        head = bytes([len(b["points"][0]), 0]) + leb(b["degree"]) + leb(len(b["points"]))
        return head + numbers(b["knots"]) + tail(b)
    pieces = curve["bezier"]["pieces"]
    out = bytes([len(pieces[0]["points"][0]), 1]) + leb(len(pieces))
    return out + b"".join(leb(len(p["points"]) - 1) + tail(p) for p in pieces)


RULES = ["split", "first", "second", "far", "not_normal", "cone", "bend", "separate", "monotone", "turn", "pedal"]


def tree_block(tree, short=False):
    out = bytearray()
    for token in tree:
        rule, *words = token.split()
        n = [int(w) for w in words]
        if short and rule in ("far", "separate") and sorted(map(abs, n)) == [0] * (len(n) - 1) + [1]:
            axis = [abs(x) for x in n].index(1)
            out.append((0x10 if rule == "far" else 0x30) + 2 * axis + (n[axis] < 0))
        elif short and rule == "not_normal" and sorted(map(abs, n)) == [0, 1]:
            out.append({(1, 0): 0x20, (-1, 0): 0x21, (0, 1): 0x22, (0, -1): 0x23}[tuple(n)])
        else:
            out.append(RULES.index(rule))
            out += b"".join(map(zigzag, n))
    return bytes(out)


def binary(certificate, short=False):
    header = copy.deepcopy(certificate)
    header["curve"] = "binary"
    tree = header["evidence"].get("tree")
    if tree is not None:
        header["evidence"]["tree"] = "binary"
    text = json.dumps(header).encode()
    return (b"KNOTCRT1" + struct.pack("<I", len(text)) + text + curve_block(certificate["curve"])
            + (b"" if tree is None else tree_block(tree, short)))


# ---------------------------------------------------------------- certificates


def texts(points):
    return [[str(F(x)) for x in p] for p in points]


def piece(points, weights=None):
    out = {"points": texts(points)}
    if weights:
        out["weights"] = [str(F(w)) for w in weights]
    return out


def polygon(*points):
    return {"bezier": {"pieces": [piece(pq) for pq in zip(points, points[1:])]}}


def certificate(curve, lower="0", tree=None, upper=None, rule=None, convention="smooth", grid=4):
    return {"knotproof": "certificate/1", "tool": "hand", "curve": copy.deepcopy(curve),
            "curve_sha256": hashlib.sha256(curve_block(curve)).hexdigest(),
            "statement": {"claim": "msd", "convention": convention,
                          "lower_squared": lower, "upper_squared": upper},
            "evidence": {"grid": grid, "tree": tree, "upper": rule}}


def segment(convention="smooth"):
    return certificate(polygon((0, 0), (3, 0)), "inf", ["cone 1 0"], convention=convention)


SQUARE = polygon((0, 0), (1, 0), (1, 1), (0, 1), (0, 0))

SMOOTH_SQUARE_TREE = """
split
split | cone 1 0 | bend 1 1 | cone 0 1
first | second | far 0 -1 | bend 1 1
        second | bend 1 1 | far 1 0
split | cone -1 0 | bend 1 1 | cone 0 -1"""

CRITICAL_SQUARE_TREE = """
split
  split | split | bend 0 1 | cone 1 0
          first | far -1 0
                  second | bend 1 0 | bend 1 1
          split | bend 0 1 | cone 0 1
  first | second | far 0 -1
                   first | second | far 0 -1 | bend 0 1
                           second | far 0 -1 | bend 1 1
          second | first | far 0 -1
                           second | bend 1 0 | bend 1 1
                   far 1 0
  split | split | bend 0 1 | cone -1 0
          first | far 1 0
                  second | bend 1 0 | bend 1 1
          split | bend 0 1 | cone 0 -1"""


def tree_of(text):
    return [token.strip() for line in text.strip().splitlines() for token in line.split("|")]


def square(convention="smooth"):
    tree = tree_of(SMOOTH_SQUARE_TREE if convention == "smooth" else CRITICAL_SQUARE_TREE)
    if convention == "smooth":
        rule = {"rule": "root", "s": "0", "s_side": "before", "t": "1", "t_side": "after"}
    else:
        rule = {"rule": "critical_root", "s": "0", "t": "1"}
    return certificate(SQUARE, "1", tree, "1", rule, convention)


def circle():
    """The unit circle in four quarters (1−u², 2u)/(1+u²), turned by quarter turns."""
    def turned(x, y, times):
        return (x, y) if times == 0 else turned(-y, x, times - 1)

    pieces = [piece([turned(*p, i) for p in ((1, 0), (1, 1), (0, 1))], (1, 1, 2)) for i in range(4)]

    def within():
        return ["split", "bend 1 1", "bend 1 1", "bend 1 1"]

    def next_to(i):  # pair (i, i+1)
        far = "far %d %d" % turned(1, 0, i)
        return ["first", "second", far, far, "second", "bend 1 1", far]

    around = ["first", "second", "far 0 1", "bend 1 1", "second", "far 0 1", "far 0 1"]  # pair (0, 3)
    tree = (["split", "split", *within(), *next_to(0), *within(),
             "first", "second", "far 1 1", *around, "second", *next_to(1), "far -1 1",
             "split", *within(), *next_to(2), *within()])
    rule = {"rule": "root", "s": "1/2", "s_side": "after", "t": "5/2", "t_side": "after"}
    return certificate({"bezier": {"pieces": pieces}}, "1/10", tree, "4", rule)


def parabolas(joint=False):
    """Two facing parabolas with one double normal of length 2; with `joint` at its foot."""
    if joint:
        lower = [piece([(-1, -1), (F(-1, 2), 0), (0, 0)]), piece([(0, 0), (F(1, 4), 0), (F(1, 2), F(-1, 4))])]
        middle = piece([(F(1, 2), F(-1, 4)), (1, 3)])
    else:
        lower, middle = [piece([(-1, -1), (0, 1), (1, -1)])], piece([(1, -1), (1, 3)])
    curve = {"bezier": {"pieces": lower + [middle, piece([(1, 3), (0, 1), (-1, 3)])]}}
    rule = {"rule": "miranda", "s": ["4/5", "7/5"] if joint else ["2/5", "3/5"],
            "t": ["17/5", "18/5"] if joint else ["12/5", "13/5"], "first": ["1", "0"], "second": ["0", "-1"],
            "regular": [["1", "0"], ["-1", "0"]], "subdivisions": 1}
    return certificate(curve, "0", None, "5", rule)


ZIGZAG = polygon((0, 0), (2, 2), (2, 0), (0, 2))
OMEGA = polygon((-1, 0), (-2, 2), (2, 2), (1, 0))


def crossing():
    rule = {"rule": "crossing", "s": ["1/4", "3/4"], "t": ["9/4", "11/4"], "first": ["1", "1"], "second": ["1", "-1"]}
    return certificate(ZIGZAG, "0", None, "0", rule)


def touch():
    return certificate(ZIGZAG, "0", None, "0", {"rule": "touch", "s": "1/2", "t": "5/2"})


def critical_ends():
    return certificate(OMEGA, "0", None, "4", {"rule": "critical_root", "s": "0", "t": "3"}, "critical")


def critical_corner():
    rule = {"rule": "critical_interval", "s": "1", "t": ["2", "3"], "regular": ["-1", "0"]}
    return certificate(OMEGA, "0", None, "16", rule, "critical")


def critical_end():
    curve = polygon((0, 0), (-1, 0), (-1, -2), (3, -2), (3, 2))
    rule = {"rule": "critical_interval", "s": "0", "t": ["3", "4"], "regular": ["0", "1"]}
    return certificate(curve, "0", None, "13", rule, "critical")


GOOD = {"segment": segment, "segment critical": lambda: segment("critical"), "square": square,
        "square critical": lambda: square("critical"), "circle": circle, "parabolas": parabolas,
        "parabolas, joint": lambda: parabolas(True), "crossing": crossing, "touch": touch,
        "critical ends": critical_ends, "critical corner": critical_corner, "critical end": critical_end}


class Checks(unittest.TestCase):
    def accept(self, certificate):
        data = certificate if isinstance(certificate, bytes) else json.dumps(certificate).encode()
        return check.check_certificate(data)

    def reject(self, certificate, reason):
        with self.assertRaisesRegex(document.Reject, reason):
            self.accept(certificate)

    def changed(self, certificate, path, value):
        """A copy with one field replaced (`...` deletes it)."""
        out = copy.deepcopy(certificate)
        *way, last = path
        place = out
        for key in way:
            place = place[key]
        if value is ...:
            del place[last]
        else:
            place[last] = value
        return out


class Accepted(Checks):
    def test_json_and_both_binary_spellings(self):
        for name, make in GOOD.items():
            with self.subTest(name):
                statement = self.accept(make())
                self.assertEqual(statement, self.accept(binary(make())))
                self.assertEqual(statement, self.accept(binary(make(), short=True)))

    def test_optional_fields_prove_nothing(self):
        c = segment()
        c["name"], c["snapped_joints"] = "δ", 3
        self.accept(c)

    def test_vacuous_statement(self):
        self.assertEqual(self.accept(certificate(SQUARE))["tokens"], 0)

    def test_all_upper_rules_on_the_square(self):
        for rule in ({"rule": "root", "s": "1/2", "s_side": "after", "t": "5/2", "t_side": "after"},
                     {"rule": "root", "s": "1", "s_side": "after", "t": "2", "t_side": "before"}):
            wanted = not (rule["s"] == "1")
            c = self.changed(square(), ("evidence", "upper"), rule)
            self.accept(c) if wanted else self.reject(c, "not orthogonal to the direction at s")

    def test_wrapping_interval_on_a_closed_curve(self):
        # two facing parabolas, closed by two lines; joint 0 is smooth, at the foot of the double normal
        pieces = [piece([(0, 0), (F(1, 2), 0), (1, -1)]), piece([(1, -1), (1, 3)]), piece([(1, 3), (0, 1), (-1, 3)]),
                  piece([(-1, 3), (-1, -1)]), piece([(-1, -1), (F(-1, 2), 0), (0, 0)])]
        rule = {"rule": "miranda", "s": ["12/5", "13/5"], "t": ["24/5", "26/5"], "first": ["1", "0"],
                "second": ["0", "-1"], "regular": [["-1", "0"], ["1", "0"]], "subdivisions": 1}
        c = certificate({"bezier": {"pieces": pieces}}, "0", None, "5", rule)
        self.accept(c)
        for t in (["24/5", "5"], ["0", "1/5"], ["29/5", "31/5"]):
            self.reject(self.changed(c, ("evidence", "upper", "t"), t), "value . 0 on this edge|disjoint|on the curve")
        pieces[0] = piece([(0, 0), (F(1, 2), F(-1, 50)), (1, -1)])
        self.reject(certificate({"bezier": {"pieces": pieces}}, "0", None, "5", rule), "the joint 0 inside is a corner")


def chain_of(value):
    return read_chain(document.BinaryReader(curve_block(value)))


class Geometry(Checks):
    def test_d_is_the_numerator_of_the_derivative(self):
        rng, compared = random.Random(5), 0
        for n in (1, 2, 3, 5):
            points = [tuple(F(rng.randint(-9, 9), rng.randint(1, 5)) for _ in range(3)) for _ in range(n + 1)]
            weights = [F(rng.randint(1, 9), rng.randint(1, 5)) for _ in range(n + 1)]
            made, = chain_of({"bezier": {"pieces": [piece(points, weights)]}}).pieces
            u = F(2, 7)

            def bernstein(values, degree):
                return sum(v * F(math.comb(degree, k)) * u ** k * (1 - u) ** (degree - k)
                           for k, v in enumerate(values))

            def slope(values):
                return n * bernstein([b - a for a, b in zip(values, values[1:])], n - 1)

            for axis in range(3):
                x = [w * p[axis] for w, p in zip(weights, points)]
                wanted = slope(x) * bernstein(weights, n) - bernstein(x, n) * slope(weights)
                self.assertGreater(len(set(weights)), 1)
                d = [F(v[axis], v[3]) for v in made.d]
                self.assertEqual(bernstein(d, 2 * n - 2), wanted)
                half = made.restricted(F(1, 7), F(4, 7)).d  # u = 2/7 is 1/3 of the way
                third = sum(F(v[axis], v[3]) * math.comb(2 * n - 2, k) * F(1, 3) ** k * F(2, 3) ** (2 * n - 2 - k)
                            for k, v in enumerate(half))
                self.assertEqual(third, wanted)
                compared += 1
        self.assertEqual(compared, 12)

    def test_bspline_pieces_lie_on_the_spline(self):
        knots = [F(x) for x in (-1, 0, 0, 1, F(5, 3), F(5, 3), 4, 5, 5, 6)]
        points = [(F(k * k % 7), F(3 * k % 5, 2)) for k in range(6)]
        weights = [F(1), F(2), F(1, 3), F(1), F(5), F(1)]
        p = 3

        def basis(i, q, t):
            if q == 0:
                return F(knots[i] <= t < knots[i + 1])
            out = F(0)
            if knots[i + q] > knots[i]:
                out += (t - knots[i]) / (knots[i + q] - knots[i]) * basis(i, q - 1, t)
            if knots[i + q + 1] > knots[i + 1]:
                out += (knots[i + q + 1] - t) / (knots[i + q + 1] - knots[i + 1]) * basis(i + 1, q - 1, t)
            return out

        chain = chain_of({"bspline": {"degree": p, "knots": [str(t) for t in knots], **piece(points, weights)}})
        intervals = [(a, b) for a, b in zip(knots[p:7], knots[p + 1:7]) if a < b]
        self.assertEqual(chain.size, len(intervals))
        for made, (a, b) in zip(chain.pieces, intervals):
            for u in (F(0), F(1, 3), F(3, 4)):
                t = a + u * (b - a)
                total = sum(basis(i, p, t) * w for i, w in enumerate(weights))
                x, y, _, den = made.point(u)
                self.assertEqual((F(x, den), F(y, den)), tuple(
                    sum(basis(i, p, t) * w * q[axis] for i, (w, q) in enumerate(zip(weights, points))) / total
                    for axis in range(2)))

    def test_box_of_a_run_is_rounded_outwards(self):
        chain = chain_of(polygon(("1/3", "-1/3"), ("2/3", 0), ("1/2", "1/3")))
        whole = msd.Cover(chain, False, 2, F(1)).whole
        self.assertEqual(whole.hull, [(1, -2, 0, 4), (1, 2, 0, 4), (3, -2, 0, 4), (3, 2, 0, 4)])


class Tree(Checks):
    def test_leaves(self):
        for old, new, reason in (
                ("bend 1 1", "bend 0 0", "not all zero"),
                ("bend 1 1", "cone 1 1", "within 45°"),
                ("bend 1 1", "bend 1 -1", "expected .*αv"),
                ("far 0 -1", "far 0 0", "not all zero"),
                ("far 0 -1", "far 0 1", "g > 0, found -1"),
                ("far 0 -1", "far 1 -1", "g > 0"),
                ("far 0 -1", "cone 0 1", "equal or adjacent"),
                ("far 0 -1", "bend 1 1", "equal or adjacent"),
                ("far 0 -1", "not_normal 1 1", "p−q"),
                ("bend 1 1", "split", ""),
                ("first", "split", "not for such a pair"),
                ("split", "first", "not for such a pair"),
                ("far 0 -1", "far 0 -01", "canonical"),
                ("far 0 -1", "far 0 -1 ", "a known token"),
                ("far 0 -1", "far  0 -1", "a known token"),
                ("far 0 -1", "far 0", "a known token"),
                ("far 0 -1", "far 0 -1 0", "a known token"),
                ("far 0 -1", "Far 0 -1", "a known token"),
                ("far 0 -1", "far 0 -" + "9" * 1300, "canonical|bits")):
            tree = square()["evidence"]["tree"]
            tree[tree.index(old)] = new
            with self.subTest(new=new):
                self.reject(self.changed(square(), ("evidence", "tree"), tree), reason)

    def test_the_bound_is_sharp(self):
        c = square()
        c["statement"].update(lower_squared="1000001/1000000", upper_squared="2")
        self.reject(c, "token 7, pair .0, 1. x .2, 3., rule 'far 0 -1': expected .* ≥ 1000001/1000000, found 1")

    def test_not_normal(self):
        # two parallel segments, one far to the right of the other, joined by a third
        curve = polygon((0, 0), (1, 0), (2, 1), (3, 1))
        # M = 3: the runs are {0} and {1, 2}
        tree = ["split", "cone 1 0", "second", "cone 2 1", "not_normal -1 0", "split", "cone 1 1", "cone 2 1", "cone 1 0"]
        c = certificate(curve, "inf", tree)
        self.accept(c)
        for token in ("not_normal 1 0", "not_normal 0 1", "not_normal -1 1"):
            self.reject(self.changed(c, ("evidence", "tree", 4), token), "p−q")
        self.accept(self.changed(c, ("evidence", "tree", 4), "not_normal -1 -1"))
        self.reject(self.changed(c, ("evidence", "tree", 1), "not_normal 1 0"), "two different nodes")

    def test_tangents_keep_their_lengths(self):
        # D is (1/3, 0) and (-1/7, 2/7); with both multiplied out the same `bend` would fail, and another one hold
        curve = polygon((0, 0), ("1/3", 0), ("4/21", "2/7"))
        c = certificate(curve, "inf", ["split", "cone 1 0", "bend 1 1", "cone -1 2"])
        self.accept(c)
        self.accept(binary(c))
        self.reject(self.changed(c, ("evidence", "tree", 2), "bend 3 7"), "αv")
        # a parabola with D = (2, 1), (2, -1): the length of D must not change by splitting
        arc = {"bezier": {"pieces": [piece([(0, 0), (2, 1), (4, 0)])]}}
        c = certificate(arc, "inf", ["split", "cone 1 0", "second", "bend 7 -4", "not_normal -1 0", "cone 1 0"])
        self.accept(c)
        self.reject(self.changed(c, ("evidence", "tree", 3), "bend 7 -8"), "αv")
        self.reject(self.changed(c, ("evidence", "tree", 3), "bend 3 -4"), "αv")

    def test_turn(self):
        # there and nearly back, with two equal control points at the corner on both sides
        curve = {"bezier": {"pieces": [piece([(0, 0), (2, 0), (3, 0), (3, 0)]),
                                       piece([(3, 0), (3, 0), (2, F(1, 10)), (0, F(3, 10))])]}}
        c = certificate(curve, "inf", ["split", "cone 1 0", "turn 200 0 -201 0", "cone -1 0"])
        self.accept(c)
        self.accept(binary(c))
        for token, reason in (("bend 1 1", "αv"), ("turn 200 0 -200 0", "p·v.w"), ("turn 200 0 201 0", "q·w > 0"),
                              ("turn -200 0 -201 0", "p·v > 0"), ("turn 0 0 -201 0", "p·v > 0")):
            self.reject(self.changed(c, ("evidence", "tree", 2), token), reason)

    def test_pedal(self):
        # quarters of circles of radius 3 and 1 around the origin, joined by a radius
        curve = {"bezier": {"pieces": [piece([(3, 0), (3, 3), (0, 3)], (1, 1, 2)), piece([(0, 3), (0, 1)]),
                                       piece([(0, 1), (1, 1), (1, 0)], (1, 1, 2))]}}
        leaf = "pedal 0 0 1 3 -1"
        tree = ["split", "split", "cone -2 3", "bend 1 1", "cone -3 1", "first", "second", "first", "far 1 0",
                "not_normal -2 -3", leaf, "second", "bend 1 3", leaf, "split", "cone 0 -3", "first", "not_normal -1 0",
                "second", "bend 1 1", "not_normal -1 0", "split", "cone 3 -2", "bend 1 1", "cone 1 -3"]
        c = certificate(curve, "4", tree)
        self.accept(c)
        self.accept(binary(c))
        for token, reason in (("pedal 0 0 1 3 1", "p−z"), ("pedal 0 0 1 3 -2", "l.m"), ("pedal 0 0 0 3 -1", "r > 0"),
                              ("pedal 0 0 1000 3001 -1001", "distances from z"), ("pedal 1 0 1 3 -1", "distances from z"),
                              ("pedal 0 0 1 -1 3", "distances from z"), ("pedal 0 0 1 2 0", "r > 0")):
            self.reject(self.changed(c, ("evidence", "tree", 10), token), reason)
        # a line through the center crosses the arc
        crossed = {"bezier": {"pieces": [piece([(4, 4), (0, 0)]), piece([(0, 0), (3, 0)]),
                                         piece([(3, 0), (3, 3), (0, 3)], (1, 1, 2))]}}
        tree = ["split", "cone -1 -1", "second", "bend 1 2", "pedal 0 0 1 -1 3"]
        self.reject(certificate(crossed, "4", tree), "nearer to z")

    def test_far_under_inf(self):
        c = certificate(polygon((0, 0), (1, 0), (2, 1), (3, 1)), "inf",
                        ["split", "cone 1 0", "second", "cone 2 1", "far -1 0", "cone 2 1"])
        self.reject(c, "token 4, .*no 'far' under")

    def test_length_of_the_tree(self):
        for name, make in GOOD.items():
            tree = make()["evidence"]["tree"]
            if tree is None:
                continue
            with self.subTest(name):
                for form in (lambda x: x, binary):
                    self.reject(form(self.changed(make(), ("evidence", "tree"), tree[:-1])), "found the end of the tree")
                    self.reject(form(self.changed(make(), ("evidence", "tree"), tree + [tree[-1]])), "expected the end")
                    self.reject(form(self.changed(make(), ("evidence", "tree"), [])), "found the end of the tree")

    def test_ends_in_the_critical_convention(self):
        # nodes {0}, [0,1], {1}; the whole is split into {0} and the run of the other two
        tree = ["split", "second", "bend 1 1", "far -1 0", "split", "cone 1 0", "bend 1 1"]
        c = certificate(polygon((0, 0), (3, 0)), "9", tree, "9", None, "critical")
        c["statement"]["upper_squared"] = None
        self.accept(c)
        self.reject(self.changed(c, ("evidence", "tree", 2), "bend -1 2"), "α ≥ 0 at the start")
        self.reject(self.changed(c, ("evidence", "tree", 6), "bend 2 -1"), "β ≥ 0 at the end")
        self.accept(self.changed(c, ("evidence", "tree", 6), "bend 0 1"))
        self.reject(self.changed(c, ("evidence", "tree", 3), "not_normal -1 1"), "β ≤ 0 at an end")
        self.reject(self.changed(c, ("evidence", "tree", 3), "not_normal 1 -1"), "α ≤ 0, ")
        self.accept(self.changed(c, ("evidence", "tree", 3), "not_normal -1 -1"))
        self.reject(self.changed(c, ("evidence", "tree", 3), "first"), "point element is not split")

    def test_false_critical_statement(self):
        # the ends of the omega are critical at distance 2: nothing proves "none shorter than 3" for that pair
        tree = ["split"] + ["bend 1 1"] * 20
        self.reject(certificate(OMEGA, "9", tree, None, None, "critical"), "token")

    def test_depth(self):
        tree = []
        for _ in range(121):
            tree += ["split"]
        self.reject(certificate(polygon((0, 0), (3, 0)), "inf", tree), "token 120, .*depth 120")

    def test_closed_curve_of_one_piece(self):
        loop = {"bezier": {"pieces": [piece([(0, 0), (3, 3), (-3, 3), (0, 0)])]}}
        self.reject(certificate(loop, "inf", ["cone 0 1"]), "45°")
        self.reject(certificate(loop, "inf", ["bend 1 1"]), "αv")
        # [0, 1/2] and [1/2, 1] touch in both ways; no rule holds for a whole loop
        self.reject(certificate(loop, "inf", ["split", "bend 1 1"]), "token 1")


class Upper(Checks):
    def tamper(self, make, **changes):
        c = make()
        c["evidence"]["upper"].update(changes)
        return c

    def test_bound_too_small(self):
        for make, bound in ((square, None), (circle, "3"), (parabolas, "4"), (critical_ends, "3"),
                            (critical_corner, "15"), (critical_end, "12")):
            if bound:
                self.reject(self.changed(make(), ("statement", "upper_squared"), bound), "squared lengths ≤")

    def test_miranda(self):
        for make in (parabolas, lambda: parabolas(True)):
            for m in (1, 2, 7):
                self.accept(self.tamper(make, subdivisions=m))
            for changes, reason in (
                    ({"first": ["-1", "0"]}, "upper.s.*on this edge"), ({"second": ["0", "1"]}, "upper.t.*on this edge"),
                    ({"second": ["-2", "0"]}, "α₁β₂ ≠ α₂β₁"), ({"regular": [["-1", "0"], ["-1", "0"]]}, "m·v > 0"),
                    ({"regular": [["1", "0"], ["1", "0"]]}, "m·v > 0"), ({"subdivisions": 0}, "from 1 to 1024"),
                    ({"subdivisions": 1025}, "from 1 to 1024"), ({"subdivisions": True}, "from 1 to 1024"),
                    ({"subdivisions": "1"}, "from 1 to 1024"), ({"first": ["1"]}, "list of 2"),
                    ({"first": ["1/2", "0"]}, "canonical integer"), ({"t": ["3/5", "4/5"]}, "disjoint|edge|m·v"),
                    ({"s": ["3/5", "2/5"]}, "s₀ < s₁"), ({"s": ["0", "6/5"]}, "s₀ < s₁"), ({"extra": 1}, "unknown")):
                with self.subTest(changes=changes):
                    self.reject(self.tamper(make, **changes), reason)
        c = parabolas(True)
        c["curve"]["bezier"]["pieces"][1] = piece([(0, 0), (F(1, 4), F(1, 100)), (F(1, 2), F(-1, 4))])
        c["curve_sha256"] = hashlib.sha256(curve_block(c["curve"])).hexdigest()
        self.reject(c, "the joint 1 inside is a corner")

    def test_root(self):
        for changes, reason in (({"t": "2"}, "orthogonal"), ({"t": "1/2"}, "s < t"), ({"t": "4"}, "parameter"),
                                ({"s": "-1"}, "parameter"), ({"s_side": "left"}, "after"),
                                ({"s": "1/2", "s_side": "before"}, "s_side: expected 'after', found 'before'"), ({"s": 0}, "fraction")):
            with self.subTest(changes=changes):
                self.reject(self.tamper(circle, **changes), reason)
        self.accept(self.tamper(circle, s="0", t="2", s_side="before", t_side="before"))
        c = certificate(OMEGA, "0", None, "99", {"rule": "root", "s": "0", "s_side": "before", "t": "3", "t_side": "after"})
        self.reject(c, "s_side: expected .after., found .before.")
        c["evidence"]["upper"]["s_side"] = "after"
        self.reject(c, "t_side: expected .before., found .after.")
        fold = {"bezier": {"pieces": [piece([(0, 1), (0, 0), (0, 1)]), piece([(0, 1), (0, 9)])]}}
        c = certificate(fold, "0", None, "99", {"rule": "root", "s": "1/2", "s_side": "after", "t": "3/2", "t_side": "after"})
        self.reject(c, "vanishes")

    def test_touch_and_crossing(self):
        self.reject(self.tamper(touch, t="9/4"), "differ")
        self.reject(self.tamper(crossing, first=["-1", "-1"]), "upper.s.*on this edge")
        self.reject(self.tamper(crossing, second=["-1", "1"]), "upper.t.*on this edge")
        self.reject(self.tamper(crossing, second=["2", "2"]), "dependent")
        self.reject(self.tamper(crossing, second=["0", "0"]), "dependent")
        self.reject(self.tamper(crossing, s=["1/4", "1/2"]), "upper.s.*on this edge")
        space = polygon((0, 0, 0), (2, 2, 0), (2, 0, 0), (0, 2, 0))
        self.reject(certificate(space, "0", None, "0", crossing()["evidence"]["upper"]), "in the plane")

    def test_critical_rules(self):
        for make in (critical_ends, critical_corner, critical_end):
            self.reject(self.changed(make(), ("statement", "convention"), "smooth"), "rule: expected")
        straight = certificate(polygon((0, 0), (3, 0)), "0", None, "9", {"rule": "critical_root", "s": "0", "t": "1"}, "critical")
        self.reject(straight, "not critical at s")
        self.reject(self.tamper(critical_corner, s="1/2"), "a corner or an end")
        self.reject(self.tamper(critical_corner, s="2"), "contains s")
        self.reject(self.tamper(critical_corner, t=["2", "21/10"]), "opposite signs")
        self.reject(self.tamper(critical_corner, t=["3/2", "5/2"]), "joint 2 inside is a corner")
        self.reject(self.tamper(critical_corner, regular=["1", "0"]), "m·v > 0")
        self.reject(self.tamper(critical_end, t=["1", "2"], regular=["0", "-1"]), "opposite|seen to be critical")
        self.reject(self.tamper(critical_corner, s="0"), "seen to be critical")


class Strictness(Checks):
    def test_fields(self):
        for path in (("tool",), ("curve",), ("statement",), ("evidence", "grid"), ("evidence", "upper"),
                     ("statement", "claim"), ("curve_sha256",), ("knotproof",), ("curve", "bezier", "pieces", 0, "points")):
            self.reject(self.changed(square(), path, ...), "missing")
            if path[0] != "curve":
                self.reject(binary(self.changed(square(), path, ...)), "missing")
        for path in (("x",), ("evidence", "x"), ("statement", "x"), ("curve", "bezier", "x"),
                     ("curve", "bezier", "pieces", 0, "degree"), ("evidence", "upper", "x")):
            self.reject(self.changed(square(), path, 1), "unknown field")
        self.reject(self.changed(square(), ("curve", "closed"), True), "the one field")
        for path, value in ((("knotproof",), "certificate/2"), (("tool",), 7), (("name",), None), (("snapped_joints",), None),
                            (("snapped_joints",), True), (("evidence", "grid"), False), (("evidence", "grid"), 100001),
                            (("evidence", "grid"), "4"), (("statement", "claim"), "thickness"), (("curve",), "binary"),
                            (("statement", "convention"), "Smooth"), (("evidence", "tree"), "binary"),
                            (("evidence", "tree"), [1]), (("curve_sha256",), "0" * 63), (("evidence", "upper"), []),
                            (("evidence", "upper"), {"rule": ["root"]}), (("curve", "bezier", "pieces"), [])):
            self.reject(self.changed(square(), path, value), "expected")

    def test_statement(self):
        c = square()
        for changes, reason in (({"lower_squared": "2"}, "lower_squared ≤ upper_squared"),
                                ({"lower_squared": "inf"}, "lower_squared ≤ upper_squared"),
                                ({"lower_squared": "-1"}, "negative"), ({"lower_squared": "0"}, "null when and only when"),
                                ({"upper_squared": None}, "null when and only when"), ({"lower_squared": None}, "fraction"),
                                ({"lower_squared": 1}, "fraction"), ({"upper_squared": "inf"}, "fraction")):
            out = copy.deepcopy(c)
            out["statement"].update(changes)
            self.reject(out, reason)
        self.reject(self.changed(c, ("evidence", "upper"), None), "null when and only when")
        self.reject(self.changed(c, ("evidence", "tree"), None), "null when and only when")
        self.reject(certificate(SQUARE, "0", ["split"]), "null when and only when")

    def test_common_denominator_of_a_vector(self):
        c = certificate(polygon(("1/2", "1/3"), ("5/6", "-7/4")), "inf", ["cone 0 -1"])
        self.accept(c)
        self.accept(binary(c))

    def test_number_texts(self):
        for text in ("+1", "01", "-0", "2/4", "3/1", "1e0", "1.0", " 1", "1 ", "1\n", "0/2", "1/-2", "-1/0", "1/0", "",
                     "１", "0x1", "1_0", "inf", "nan", "1/02", "--1", "1" * 20000, "1/" + "1" * 20000):
            with self.subTest(text[:20]):
                self.reject(self.changed(square(), ("statement", "lower_squared"), text) if text != "inf" else
                            self.changed(square(), ("statement", "upper_squared"), text), "canonical|lowest terms|bits")
        largest = str(2 ** 65536 - 1)
        self.assertEqual(document.integer(largest, ""), 2 ** 65536 - 1)
        with self.assertRaises(document.Reject):
            document.number(str(2 ** 65536), "")

    def test_json_text(self):
        text = json.dumps(segment())
        self.accept(text.encode())
        self.accept((" \n" + text + "\t\r\n").encode())
        for old, new in (('"tool"', '"tool": "x", "tool"'), ('"tool"', '"\\u0074ool": "x", "tool"'),
                         ('"claim"', '"claim": "msd", "claim"'), ('"grid": 4', '"grid": NaN'), ('"grid": 4', '"grid": 4.0'),
                         ('"grid": 4', '"grid": 4e0'), ('"grid": 4', '"grid": -0'), ('"grid": 4', '"grid": Infinity'),
                         ('"grid": 4', '"grid": 04'), ('"hand"', '"ha\nnd"'), ('"hand"', '"\\ud800"'), ('"hand"', "'hand'"),
                         ('"grid": 4', '"grid": 4,'), ("{", "\ufeff{"), ('"grid": 4', '"grid": ' + "4" * 5000)):
            with self.subTest(new[:20]):
                self.reject(text.replace(old, new, 1).encode(), "")
        for data in (b"", b"null", b"[]", text.encode() + b"x", text.encode("utf-16"), text.encode()[:-1], b"[" * 200000,
                     text.encode().replace(b"hand", b"h\xff")):
            self.reject(data, "")

    def test_hash(self):
        self.reject(self.changed(square(), ("curve_sha256",), "0" * 64), "curve_sha256: expected")
        c = square()
        c["curve_sha256"] = c["curve_sha256"].upper()
        self.reject(c, "lower-case")
        c = square()
        c["curve"]["bezier"]["pieces"][1]["points"][0] = ["1", "1/7"]
        self.reject(c, "to begin where")
        with self.assertRaisesRegex(document.Reject, "another curve"):
            check.check_certificate(json.dumps(square()).encode(), "0" * 64)
        one = {"bezier": {"pieces": [dict(piece([(0, 0), (3, 0)]), weights=["1", "1"])]}}
        c = certificate(one, "inf", ["cone 1 0"])
        self.accept(c)
        self.assertNotEqual(c["curve_sha256"], segment()["curve_sha256"])

    def test_curves(self):
        def spline(degree=2, knots=(0, 0, 0, 1, 1, 1), points=((0, 0), (1, 0), (2, 1)), **more):
            body = {"degree": degree, "knots": [str(F(k)) for k in knots], "points": texts(points), **more}
            return certificate({"bspline": body}, "inf", ["cone 2 1"])

        self.accept(spline())
        self.accept(binary(spline()))
        for bad, reason in ((spline(knots=(0, 0, 0, 0, 1, 1)), "range is empty|multiplicity"), (spline(degree=0), "degree|from 1"),
                            (spline(knots=(0, 0, 0, 1, 1)), "expected 6 knots"), (spline(knots=(0, 0, 1, F(1, 2), 1, 1)), "smaller"),
                            (spline(weights=["1", "1"]), "as many weights"), (spline(weights=["1", "0", "1"]), "positive"),
                            (spline(points=((0,), (1,), (2,))), "2 or of 3|dimension"),
                            (spline(points=((0, 0), (1, 0), (2, 1)), degree=65), "degree|from 1"),
                            (spline(2, (0, 0, 0, 1, 1, 1, 2, 2, 2), ((0, 0),) * 6), "multiplicity")):
            self.reject(bad, reason)
            self.reject(binary(bad), reason.replace("expected 6 knots", "least common"))
        self.reject(certificate(polygon((0, 0), (0, 0))), "single point")
        self.reject(self.changed(spline(), ("curve", "bspline", "degree"), "2"), "expected an integer")
        self.reject(self.changed(spline(), ("curve", "bspline", "points", 0, 0), 0), "canonical")

    def test_binary_malformed(self):
        good = binary(square())
        header = struct.unpack("<I", good[8:12])[0]
        block = 12 + header
        for cut in [*range(0, 30), *range(block - 3, len(good))]:
            self.reject(good[:cut], "")
        self.reject(good + b"\0", "expected the end of the tree")
        self.reject(binary(certificate(SQUARE)) + b"\0", "left over")
        self.reject(good[:8] + struct.pack("<I", 16777217) + good[12:], "at most 16777216")
        self.reject(good[:8] + struct.pack("<I", 0xffffffff) + good[12:], "at most 16777216")
        self.reject(good[:block] + b"\4" + good[block + 1:], "dimension 2 or 3.*\\(4, 1\\)")
        self.reject(good[:block + 1] + b"\2" + good[block + 2:], "kind 0 or 1.*\\(2, 2\\)")
        self.reject(good[:block + 2] + b"\x84\0" + good[block + 3:], "padded")
        self.reject(good[:block + 2] + b"\x80" * 40 + b"\1" + good[block + 3:], "at most 64 bits")
        self.reject(good[:block + 4] + b"\0" + good[block + 5:], "least common")
        self.reject(good[:block + 4] + b"\2\0\0\4\0" + good[block + 9:], "least common")
        for code in (0x0b, 0x0f, 0x14, 0x15, 0x24, 0x34, 0xff):
            self.reject(good[:-3] + bytes([code]), "unknown token")

    def test_short_codes_in_space(self):
        line = polygon((0, 0, 0), (0, 0, 1), (0, 1, 5), (0, 0, 9))
        tree = ["split", "cone 0 0 1", "second", "cone 0 0 1", "far 0 0 -1", "cone 0 0 1"]
        data = binary(certificate(line, "16", tree), short=True)
        self.assertIn(0x15, data[-20:])
        self.accept(data)

    def test_damaged_bytes_never_crash(self):
        rng = random.Random(11)
        for make in GOOD.values():
            for data in (json.dumps(make()).encode(), binary(make(), short=True)):
                for _ in range(60):
                    damaged = bytearray(data)
                    for _ in range(rng.randint(1, 3)):
                        damaged[rng.randrange(len(damaged))] = rng.randrange(256)
                    with contextlib.suppress(document.Reject):
                        self.accept(bytes(damaged))


class Limits(Checks):
    def spline(self, knots=("0", "1"), points=(("0", "0"), ("1", "0")), weights=None):
        body = {"degree": 1, "knots": [knots[0], *knots, knots[-1]], "points": [list(p) for p in points]}
        return certificate({"bspline": body | ({"weights": list(weights)} if weights else {})}, "inf", ["cone 1 0"])

    def both(self, certificate, reason=None):
        for form in (certificate, binary(certificate)):
            self.accept(form) if reason is None else self.reject(form, reason)

    def test_common_denominators(self):
        a, b, c = "1/%d" % 2 ** 40000, "1/%d" % 3 ** 16000, "1/%d" % 3 ** 17000  # a b: 65,360 bits; a c: 66,945
        self.both(self.spline(("0", a), [("0", b), ("1", b)]))  # vectors are bounded one by one
        self.both(self.spline(("0", c), [("0", a), ("1", a)]))
        self.both(self.spline(points=[("0", a), ("1", b)]))
        self.both(self.spline(points=[("0", a), ("1", c)]), "65536 bits")
        self.both(self.spline(weights=(a, b)))
        self.both(self.spline(weights=(a, c)), "65536 bits")
        points = [("0", "0"), ("1", "0"), ("2", "0"), ("3", "0")]
        body = {"degree": 1, "knots": ["-1", "0", c, a, "1", "2"], "points": points}
        body["knots"].sort(key=F)
        self.both(certificate({"bspline": body}), "65536 bits")
        body["knots"][body["knots"].index(c)] = b
        body["knots"].sort(key=F)
        self.both(certificate({"bspline": body}))

        two = {"bezier": {"pieces": [piece([(0, 0), (F(a), 0), (1, 0)]), piece([(1, 0), (1 + F(c), 0), (2, 0)])]}}
        self.both(certificate(two, "inf", ["cone 1 0"]))
        two["bezier"]["pieces"][1]["points"][1][1] = a
        self.both(certificate(two, "inf", ["cone 1 0"]), "65536 bits")

    def test_common_numerators(self):
        tiny = "1/%d" % 2 ** 65535
        self.both(self.spline(points=[("0", tiny), ("1", "0")]))
        self.both(self.spline(points=[("0", tiny), ("2", "0")]), "65536 bits")
        self.both(self.spline(points=[("0", tiny), ("-2", "0")]), "65536 bits")
        self.both(self.spline(points=[("0", "0"), ("%d" % 2 ** 65535, "0")]))
        self.both(self.spline(points=[("0", "0"), ("%d" % 2 ** 65536, "0")]), "canonical|65536 bits")

    def test_common_denominator_does_not_blow_up(self):
        points = [("0", "1/%d" % k) for k in range(2, 50000)]  # lcm(1 … n) has about 1.44 n bits
        c = {**segment(), "curve": {"bezier": {"pieces": [{"points": points}]}}}
        self.reject(c, "least common denominator: expected at most 65536 bits")

    def test_no_quadratic_rules_on_runs(self):
        curve = polygon(*((x, 0) for x in range(7)))
        tree = ["split", "cone 1 0", "second", "cone 1 0", "not_normal -1 0", "cone 1 0"]
        for token in ("not_normal -1 0", "not_normal 0 -1", "not_normal -1 -1", "cone 1 0"):
            c = certificate(curve, "inf", tree[:4] + [token] + tree[5:])
            if token == "not_normal -1 -1":  # it holds, but [4, 6] is a run
                self.both(c, "token 4, pair .0, 3. x .4, 6., .*not for runs")
            elif token != "cone 1 0":
                self.both(c)
            else:
                self.both(c, "adjacent")
        self.both(certificate(curve, "inf", ["bend 1 1"]), "token 0, .*not for runs")
        self.both(certificate(curve, "inf", ["split", "cone 1 0", "bend 1 1", "cone 1 0"]), "token 2, .*not for runs")
        self.both(certificate(curve, "inf", ["split", "cone 1 0", "bend 1 0", "cone 1 0"]), "token 2, .*not for runs")
        # one part and one run: [0, 1] x [1, 3], and with [2, 3] x [3, 5] turned round
        curve = polygon(*((x, 0) for x in range(4)))
        self.both(certificate(curve, "inf", ["split", "cone 1 0", "cone 1 0", "cone 1 0"]))
        self.both(certificate(curve, "inf", ["split", "cone 1 0", "bend 1 1", "cone 1 0"]), "token 2, .*not for runs")
        parts = ["second", "bend 1 1", "not_normal -1 -1"]
        self.both(certificate(curve, "inf", ["split", "bend 1 1", *parts, "cone 1 0"]))
        curve = polygon(*((x, 0) for x in range(5)))
        halves = ["split", "cone 1 0", "second", "cone 1 0", "TOKEN", "cone 1 0"]
        for token, reason in (("not_normal 0 -1", None), ("not_normal -2 -1", "token 4, .*not for runs")):
            self.both(certificate(curve, "inf", [token if x == "TOKEN" else x for x in halves]), reason)

    def test_root_before_needs_an_integer(self):
        for side in "st":
            c = circle()
            c["evidence"]["upper"][side + "_side"] = "before"
            self.both(c, side + "_side: expected 'after', found 'before'")
        c = circle()
        c["evidence"]["upper"].update(s="1", s_side="before", t="3", t_side="before")
        self.both(c)

    def test_json_rules(self):
        text = json.dumps({**segment(), "snapped_joints": 77})
        self.accept(text.replace("77", "18446744073709551615").encode())
        for new in ("18446744073709551616", "-1", "-0", "1.0", "1e2", "077", '"77"', "null", "true"):
            with self.subTest(new):
                self.reject(text.replace("77", new).encode(), "")
        self.reject(b"\xef\xbb\xbf" + text.encode(), "not JSON")
        self.reject(self.changed(segment(), ("name",), None), "expected a string")
        self.reject(self.changed(segment(), ("curve", "bezier", "pieces", 0, "weights"), None), "expected a list")
        self.reject(self.changed(segment(), ("curve", "bezier", "pieces", 0, "points", 0, 0), 0), "canonical fraction")
        self.reject(self.changed(segment(), ("evidence", "tree"), "binary"), "expected a list")
        self.reject(self.changed(segment(), ("curve",), "binary"), "expected an object")

    def test_degree_and_counts(self):
        def line(degree):
            return certificate({"bezier": {"pieces": [piece([(k, 0) for k in range(degree + 1)])]}}, "inf", ["cone 1 0"])
        self.both(line(64))
        self.both(line(65), "from 1 to 64")
        with mock.patch("curve.MAX_COUNT", 4):
            points = [(str(k), "0") for k in range(5)]
            self.both(self.spline(("0", "1", "2", "3"), points[:4]))
            self.both(self.spline(("0", "1", "2", "3", "4"), points), "4")
            self.both(certificate(polygon(*((x, 0) for x in range(5))), "inf", ["cone 1 0"]))
            self.both(certificate(polygon(*((x, 0) for x in range(6))), "inf", ["cone 1 0"]), "1 to 4")

    def test_a_long_list_is_refused_before_it_is_read(self):
        reader = document.items(document.number, most=2)
        self.assertEqual(reader(["1", "1/2"], "x"), [1, F(1, 2)])
        with self.assertRaisesRegex(document.Reject, "x: expected a list of at most 2"):
            reader(["", "", ""], "x")

    def test_witnesses(self):
        for bits, reason in ((4096, None), (4097, "4096 bits")):
            for sign in ("", "-"):
                n = 2 ** bits - 1
                c = self.changed(segment(), ("evidence", "tree", 0), f"cone {n} {sign}1")
                self.both(c, reason)
        self.both(self.changed(segment(), ("evidence", "tree", 0), f"cone -{2 ** 4096} 1"), "4096 bits")

    def test_subsections(self):
        c = parabolas()
        c["evidence"]["upper"]["subdivisions"] = 1024
        self.accept(c)
        c["evidence"]["upper"]["subdivisions"] = 1025
        self.both(c, "from 1 to 1024")

    def test_varint_size_is_seen_early(self):
        data = binary(self.spline())
        block = data.index(curve_block(self.spline()["curve"]))
        self.reject(data[:block + 4] + b"\x80" * 1000000 + b"\1", "knots: expected at most 65536 bits")

    def test_size_of_a_json_file(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "large")
            with open(path, "wb") as stream:
                stream.truncate(1 << 30)  # a hole: it takes no room, and is rejected before it is read
            verdict, report = check.examine(path, None)
        self.assertEqual(verdict, "rejected")
        self.assertIn("at most 1073741823 bytes", report["reason"])
        data = json.dumps(segment()).encode()
        with mock.patch.object(check, "MAX_JSON_BYTES", len(data)):
            self.accept(data)
            self.reject(data + b" ", "bytes of JSON")


class CommandLine(unittest.TestCase):
    def run_main(self, *arguments):
        out = io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(io.StringIO()):
            try:
                code = check.main(list(arguments))
            except SystemExit as stop:
                code = stop.code
        return code, out.getvalue()

    def test_exit_codes_and_output(self):
        with tempfile.TemporaryDirectory() as folder:
            good, bad, lost = (os.path.join(folder, name) for name in ("good", "bad", "lost"))
            with open(good, "wb") as stream:
                stream.write(binary(square()))
            with open(bad, "w", encoding="utf-8") as stream:
                stream.write("{")
            code, out = self.run_main(good)
            self.assertEqual(code, 0)
            self.assertTrue(out.startswith(f"accepted: {good}: σ² in [1, 1]"))
            code, out = self.run_main(good, bad, "--json")
            first, second = map(json.loads, out.splitlines())
            self.assertEqual((code, first["verdict"], second["verdict"]), (1, "accepted", "rejected"))
            self.assertEqual(first["statement"]["lower_squared"], "1")
            self.assertIn("JSON", second["reason"])
            self.assertEqual(self.run_main(good, bad, "--quiet"), (1, ""))
            self.assertEqual(self.run_main(lost)[0], 2)
            self.assertEqual(self.run_main()[0], 2)
            self.assertEqual(self.run_main(good, "--curve-sha256", "xyz")[0], 2)
            self.assertEqual(self.run_main(good, "--curve-sha256", "0" * 64)[0], 1)
            self.assertEqual(self.run_main(good, "--curve-sha256", square()["curve_sha256"])[0], 0)


if __name__ == "__main__":
    unittest.main()
