#!/usr/bin/env python3
"""Tests of the claim `embedding` on small cases.  Run: python3 test_embedding.py"""

import copy
import hashlib
import itertools
import math
import random
import unittest
from fractions import Fraction as F

import document
import embedding
import msd
from test_check import SQUARE, Checks, binary, chain_of, curve_block, piece, polygon


def certificate(curve, tree, edges, infinity="0", euclidean="0", grid=0):
    return {"knotproof": "certificate/1", "tool": "hand", "curve": copy.deepcopy(curve),
            "curve_sha256": hashlib.sha256(curve_block(curve)).hexdigest(),
            "statement": {"claim": "embedding", "edges": edges,
                          "perturbation_radius": {"infinity": infinity, "euclidean": euclidean}},
            "evidence": {"grid": grid, "tree": tree}}


SQUARE_TREE = ["split", "split", "monotone 1 0", "monotone 1 1", "monotone 0 1", "first", "second", "separate 0 -1",
               "monotone 1 -1", "second", "monotone -1 1", "separate 1 0", "split", "monotone -1 0", "monotone -1 -1",
               "monotone 0 -1"]


def square(infinity="1/4", euclidean="353/1000", edges=4):
    return certificate(SQUARE, SQUARE_TREE, edges, infinity, euclidean)


def blossom(rows, arguments):
    row = rows
    for t in arguments:
        row = [[(1 - t) * x + t * y for x, y in zip(p, q)] for p, q in zip(row, row[1:])]
    return row[0]


def restricted(rows, start, end):
    n = len(rows) - 1
    return [blossom(rows, [start] * (n - k) + [end] * k) for k in range(n + 1)]


class Claim(Checks):
    def test_square_in_both_forms(self):
        self.accept(square())
        self.accept(binary(square()))
        self.accept(binary(square(), short=True))

    def test_edges(self):
        for edges in (0, 3, 5):
            self.reject(square(edges=edges), "edges")

    def test_radii(self):
        self.reject(square("251/1000"), "infinity")
        self.reject(square(euclidean="177/500"), "euclidean")
        self.reject(square("-1/4"), "negative")

    def test_leaves(self):
        def other(i, token):
            return certificate(SQUARE, SQUARE_TREE[:i] + [token] + SQUARE_TREE[i + 1:], 4)

        self.reject(other(7, "separate 0 1"), "min n·p")
        self.reject(other(7, "far 0 -1"), "another claim")
        self.reject(other(7, "monotone 0 1"), "adjacent")
        self.reject(other(2, "separate 1 0"), "two different nodes")
        self.reject(other(2, "monotone 0 1"), "every tangent")
        self.reject(other(2, "monotone 0 0"), "not all zero")
        self.reject(other(2, "cone 1 0"), "another claim")

    def test_tree_is_needed(self):
        self.reject(certificate(SQUARE, None, 4), "tree")


class Margins(unittest.TestCase):
    def test_rows_are_the_blossoms(self):
        """Margins of parts of one cubic, from matrices that are made by blossoming."""
        points = [(0, 0), (0, 2), (2, 2), (2, 0)]
        chain = chain_of({"bezier": {"pieces": [piece(points)]}})
        cover = embedding.Cover(chain, 0)
        unit = [[int(i == j) for j in range(4)] for i in range(4)]
        steps = [[y - x for x, y in zip(p, q)] for p, q in zip(unit, unit[1:])]
        left, right = cover.whole.children
        quarter, second = left.children
        nodes = {left: (F(0), F(1, 2)), right: (F(1, 2), F(1)), quarter: (F(0), F(1, 4)), second: (F(1, 4), F(1, 2))}

        def value(row, n):
            return sum(m * (n[0] * x + n[1] * y) for m, (x, y) in zip(row, points))

        for n in itertools.product(range(-2, 3), range(-2, 3)):
            for node, ends in nodes.items():
                wish = min(value(row, n) / sum(map(abs, row)) for row in restricted(steps, *ends))
                self.assertEqual(cover.table.slope_margin({node}, (*n, 0)), wish)
            wish = min((value(p, n) - value(q, n)) / sum(abs(x - y) for x, y in zip(p, q))
                       for p in restricted(unit, *nodes[quarter]) for q in restricted(unit, *nodes[right]))
            self.assertEqual(cover.table.gap_margin(quarter, right, (*n, 0)), wish)

    def test_rows_give_the_points_and_the_field(self):
        """The rows applied to the control points are the hull points and, up to a factor, the D_k, on curves of all kinds."""
        chance = random.Random(7)
        knots = [0, 0, 1, 2, 2, 4, 5, 7, 7, 9, 10]
        for form, weighted in itertools.product(("bezier", "bspline"), (False, True)):
            points = [[chance.randrange(-9, 10) for _ in range(3)] for _ in range(7)]
            weights = [chance.randrange(1, 5) for _ in range(7)] if weighted else None
            if form == "bezier":
                curve = {"bezier": {"pieces": [piece(points[:4], weights and weights[:4]),
                                               piece(points[3:], weights and weights[3:])]}}
            else:
                curve = {"bspline": {"degree": 3, "knots": [str(t) for t in knots], **piece(points, weights)}}
            chain = chain_of(curve)
            cover = embedding.Cover(chain, 0)
            part = embedding.parts_of(cover.whole)[1].children[0].children[1]
            hull, field = cover.table.rows(part)
            own = [cover.table.points[number] for number in cover.table.numbers_of(part)]

            def applied(row, own=own):
                return [sum(m * F(p[i], p[3]) for m, p in zip(row, own)) for i in range(3)]

            for row, p in zip(hull, part.hull, strict=True):
                self.assertEqual([x / sum(row) for x in applied(row)], [F(x, p[3]) for x in p[:3]])
            found = [x for row in field for x in applied(row)]
            known = [F(x, v[3]) for v in part.arc.d for x in v[:3]]
            factor = next(x / y for x, y in zip(found, known, strict=True) if y)
            self.assertGreater(factor, 0)
            self.assertEqual(found, [factor * y for y in known])

    def test_joints_and_the_closing_point_are_one(self):
        chain = chain_of(SQUARE)
        table = embedding.Cover(chain, 0).table
        self.assertEqual(table.numbers, [[0, 1], [1, 2], [2, 3], [3, 0]])
        open_chain = chain_of(polygon((0, 0), (1, 0), (1, 1)))
        self.assertEqual(embedding.Cover(open_chain, 0).table.numbers, [[0, 1], [1, 2]])

    def test_a_move_within_the_radius(self):
        """The square with the radius 1/4: every move by less leaves the obligations of the tree true."""
        chance = random.Random(3)
        for _ in range(40):
            step = [[F(chance.choice((-249, 249)), 1000) for _ in range(2)] for _ in range(4)]
            corners = [(x + dx, y + dy) for (x, y), (dx, dy) in zip([(0, 0), (1, 0), (1, 1), (0, 1)], step)]
            chain = chain_of(polygon(*corners, corners[0]))
            tokens = msd.json_tokens(SQUARE_TREE, 2)
            self.assertEqual(embedding.Cover(chain, 20).replay(tokens), len(SQUARE_TREE))
        with self.assertRaises(document.Reject):
            chain = chain_of(polygon((0, F(1, 2)), (1, F(1, 2)), (1, F(49, 100)), (0, F(49, 100)), (0, F(1, 2))))
            embedding.Cover(chain, 20).replay(msd.json_tokens(SQUARE_TREE, 2))

    def test_margin_in_both_norms(self):
        cover = embedding.Cover(chain_of(SQUARE), 0)
        cover.replay(msd.json_tokens(SQUARE_TREE, 2))
        self.assertEqual(cover.radii, {"infinity": {F(1, 4)}, "euclidean": {F(1, 8)}})
        self.assertLess(F(353, 1000), math.sqrt(1 / 8))


if __name__ == "__main__":
    unittest.main()
