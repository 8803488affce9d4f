"""The curve: its block (FORMAT.md §2, §7) and the chain of its pieces (§3).

A point is a tuple of integers (x, y, z, w) and means (x, y, z)/w, w > 0; a plane curve has z = 0.  A vector is written
in the same way.  The common factor of a point or vector does not matter, except within one list of Bernstein
coefficients, which all stand over the same scale.
"""

import itertools
import math
from collections import Counter
from fractions import Fraction
from typing import NamedTuple

from document import expect, items, natural, number, record, require, shown, varint, vector_bytes

MAX_DEGREE = 64
MAX_COUNT = 4_000_000  # pieces, control points

POINTS, WEIGHTS = items(items(number), most=MAX_COUNT), items(number)
PIECE = record({"points": POINTS}, {"weights": WEIGHTS})
KINDS = {
    "bspline": record({"degree": natural(1, MAX_DEGREE), "knots": items(number), "points": POINTS},
                      {"weights": WEIGHTS}),
    "bezier": record({"pieces": items(PIECE, most=MAX_COUNT)}),
}


# ---------------------------------------------------------------- the curve block


def curve_block(value):
    """The curve block of a curve in JSON.  What `read_chain` tests is not tested here."""
    expect(isinstance(value, dict) and len(value) == 1 and next(iter(value)) in KINDS, "curve",
           "an object with the one field 'bspline' or 'bezier'", value)
    kind, found = next(iter(value.items()))
    where = f"curve.{kind}"
    found = KINDS[kind](found, where)
    pieces = found.get("pieces", [found])
    dimensions = {len(point) for piece in pieces for point in piece["points"]}
    expect(dimensions in ({2}, {3}) and all(piece["points"] for piece in pieces), "curve",
           "points of 2 or of 3 coordinates, all alike", sorted(dimensions))
    if kind == "bezier":
        block = [bytes([*dimensions, 1]), varint(len(pieces))]
    else:
        degree, knots, count = found["degree"], found["knots"], len(found["points"])
        expect(len(knots) == count + degree + 1, where, f"{count + degree + 1} knots", len(knots))
        block = [bytes([*dimensions, 0]), varint(degree), varint(count), vector_bytes(knots, where + ".knots")]
    for i, piece in enumerate(pieces):
        if kind == "bezier":
            where = f"curve.bezier.pieces[{i}]"
            block.append(varint(len(piece["points"]) - 1))
        block += [vector_bytes([x for point in piece["points"] for x in point], where + ".points"), b"\0"]
        if "weights" in piece:
            expect(len(piece["weights"]) == len(piece["points"]), where, "as many weights as points", piece["weights"])
            block[-1] = b"\1" + vector_bytes(piece["weights"], where + ".weights")
    return b"".join(block)


def read_chain(reader):
    """The chain of the curve whose block comes next."""
    begin, dimension, kind = reader.at, reader.byte("dimension"), reader.byte("kind of curve")
    expect(dimension in (2, 3) and kind in (0, 1), "curve block", "dimension 2 or 3, kind 0 or 1", (dimension, kind))

    def control_points(count):
        """Homogeneous control points as integers, and the scale they stand over."""
        q, x = reader.vector(count * dimension, "coordinates")
        flag = reader.byte("weight flag")
        expect(flag in (0, 1), "curve block", "a weight flag 0 or 1", flag)
        r, weights = reader.vector(count, "weights") if flag else (1, [1] * count)
        expect(min(weights) > 0, "curve", "as many weights as points, all positive", weights)
        points = [(*x[k:k + dimension], 0)[:3] for k in range(0, len(x), dimension)]
        return [(*(w * c for c in point), w * q) for w, point in zip(weights, points)], q * r

    if kind == 0:
        degree = reader.count("degree", 1, MAX_DEGREE)
        count = reader.count("number of points", degree + 1, MAX_COUNT)
        knot_scale, knots = reader.vector(count + degree + 1, "knots")
        source = Source(degree, knots, [control_points(count)], knot_scale)
        check_knots(degree, knots, count)
        pieces = source.pieces(source.lists)
    else:
        source = Source(None, None, [control_points(reader.count("degree", 1, MAX_DEGREE) + 1)
                                     for _ in range(reader.count("number of pieces", 1, MAX_COUNT))])
        pieces = source.lists
        for i, ((before, _), (after, _)) in enumerate(zip(pieces, pieces[1:]), 1):
            meets = not any(difference(before[-1], after[0]))
            expect(meets, f"curve: piece {i}", "to begin where the one before ends", after[0])
    arcs = [Arc(reduced(points), reduced(derivative(points, scale))) for points, scale in pieces]
    return Chain(dimension, arcs, source, memoryview(reader.data)[begin:reader.at])


def check_knots(degree, knots, count):
    low, high = knots[degree], knots[count]
    expect(all(a <= b for a, b in zip(knots, knots[1:])), "curve", "no knot smaller than the one before", knots)
    for knot, multiplicity in Counter(knots).items():
        most = degree if low < knot < high else degree + 1
        expect(multiplicity <= most, "curve", f"a multiplicity of at most {most} of each knot", multiplicity)
    expect(low < high, "curve", "a range of parameters that is not empty", knots)


def bspline_pieces(p, t, points, scale):
    """The pieces of a B-spline; of the knots t only quotients of differences matter."""
    for j in range(p, len(points)):
        if t[j] == t[j + 1]:
            continue
        # common denominators of the λ of each round
        factors = [math.lcm(*(t[i + 1 + j - r] - t[i + j - p] for i in range(r, p + 1))) for r in range(1, p + 1)]
        control = []
        for k in range(p + 1):
            d = points[j - p:j + 1]
            for r, f in enumerate(factors, 1):
                a = t[j] if r <= p - k else t[j + 1]
                for i in range(p, r - 1, -1):
                    lam = (a - t[i + j - p]) * (f // (t[i + 1 + j - r] - t[i + j - p]))
                    d[i] = tuple((f - lam) * x + lam * y for x, y in zip(d[i - 1], d[i]))
            control.append(d[p])
        yield control, scale * math.prod(factors)


def derivative(h, scale):
    """The Bernstein coefficients of the field D of a piece with the homogeneous control points h/scale."""
    n = len(h) - 1
    if all(p[3] == h[0][3] for p in h):
        return [(*(y - x for x, y in zip(p[:3], q)), p[3]) for p, q in zip(h, h[1:])]
    common = math.lcm(*(math.comb(2 * n - 2, k) for k in range(2 * n - 1)))
    d = []
    for k in range(2 * n - 1):
        total = (0, 0, 0)
        for i in range(max(0, k - n + 1), k // 2 + 1):
            j = k - i + 1
            factor = (j - i) * math.comb(n, i) * math.comb(n, j) * (common // math.comb(2 * n - 2, k))
            total = [t + factor * x for t, x in zip(total, difference(h[j], h[i]))]
        d.append((*total, scale * scale * common))
    return d


# ---------------------------------------------------------------- vectors and Bernstein coefficients


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def difference(p, q):
    """A positive multiple of the vector p − q."""
    v, w = p[3], q[3]
    return p[0] * w - q[0] * v, p[1] * w - q[1] * v, p[2] * w - q[2] * v


def reduced(coefficients):
    """The coefficients without common factor."""
    factor = math.gcd(*(x for c in coefficients for x in c))
    return [tuple([x // factor for x in c]) for c in coefficients] if factor > 1 else coefficients


def least(chord, groups, factor):
    """The least value of factor·(v·chord) in each group of vectors with the same w, as (numerator, denominator)."""
    if factor == 0:
        return [(0, 1)]
    extreme, (x, y, z) = min if factor > 0 else max, chord[:3]
    return [(factor * extreme([v[0] * x + v[1] * y + v[2] * z for v in group]), group[0][3]) for group in groups]


def combination_positive(chord, groups_v, alpha, groups_w, beta):
    """Is chord·(αv + βw) > 0 for all v and all w?  (The least of a sum is the sum of the least.)"""
    pairs = itertools.product(least(chord, groups_v, alpha), least(chord, groups_w, beta))
    return all(v * w_den + w * v_den > 0 for (v, v_den), (w, w_den) in pairs)


def split_at(coefficients, u):
    """De Casteljau: the coefficients on [0, u] and on [u, 1], all multiplied by (denominator of u)^degree."""
    row, a, r = coefficients, u.numerator, u.denominator
    left, right, b = [row[0]], [row[-1]], r - a
    while len(row) > 1:
        row = [tuple([b * x + a * y for x, y in zip(p, q)]) for p, q in zip(row, row[1:])]
        left.append(row[0])
        right.append(row[-1])
    powers = [r ** k for k in range(len(left) - 1, -1, -1)]
    left, right = ([tuple([f * x for x in c]) for f, c in zip(powers, side)] for side in (left, right))
    return left, right[::-1]


# ---------------------------------------------------------------- the chain


class Arc(NamedTuple):
    """A piece or a section of one: homogeneous control points, and the coefficients of D (all with the same w)."""

    points: list
    d: list

    def cut(self, u):
        """The arcs on [0, u] and on [u, 1]."""
        (left, right), (d_left, d_right) = (map(reduced, split_at(row, u)) for row in self)
        return Arc(left, d_left), Arc(right, d_right)

    def restricted(self, u0, u1):
        return self.cut(u1)[0].cut(u0 / u1)[1]

    def tangents(self):
        """The coefficients of D that are not zero."""
        return [v for v in self.d if any(v[:3])]

    def point(self, u):
        return split_at(self.points, u)[0][-1]

    def direction(self, u):
        """The direction at u (§6, `root`): at the ends also where D vanishes."""
        d = split_at(self.d, u)[0][-1]
        if not any(d[:3]):
            require(u in (0, 1), f"upper: D vanishes inside a piece, at {shown(u)}, so there is no direction")
            d = self.tangents()[-int(u)]
        return d


class Source(NamedTuple):
    """The curve as it is given: the control points of a B-spline, or of each Bézier piece, each list with its scale.

    The knots are integers over knot_scale; they and the degree are None for Bézier pieces.
    """

    degree: int
    knots: list
    lists: list
    knot_scale: int = 1

    def pieces(self, lists):
        """The pieces that these lists in place of the own ones make, each with its scale."""
        return lists if self.knots is None else bspline_pieces(self.degree, self.knots, *lists[0])

    def lengths(self):
        """The length of each piece in the curve's own parameter, up to a common factor."""
        if self.knots is None:
            return [1] * len(self.lists)
        used = self.knots[self.degree:len(self.lists[0][0]) + 1]
        return [b - a for a, b in zip(used, used[1:]) if a < b]


class Chain:
    """The pieces, whether the curve is closed, its joints, the source it comes from, and its curve block."""

    def __init__(self, dimension, pieces, source, block):
        self.dimension, self.pieces, self.size, self.source, self.block = dimension, pieces, len(pieces), source, block
        for i, piece in enumerate(pieces):
            require(piece.tangents(), f"curve: piece {i} is a single point (D vanishes)")
        self.closed = not any(difference(pieces[0].points[0], pieces[-1].points[-1]))

    def sides(self, s):
        """The pieces at the parameter s, each with its local parameter, by side; of an integer, both that there are."""
        i, found = math.floor(s), {}
        if s == i and (i > 0 or self.closed):
            found["before"] = self.pieces[i - 1], Fraction(1)
        if i < self.size or self.closed:
            found["after"] = self.pieces[i % self.size], Fraction(s - i)
        return found

    def place(self, s):
        """The point c(s)."""
        piece, u = next(iter(self.sides(s).values()))
        return piece.point(u)

    def directions(self, s):
        """The incoming direction, if a piece ends at s, and the outgoing one, or the direction inside a piece."""
        return [piece.direction(u) for piece, u in self.sides(s).values()]

    def is_end(self, s):
        return not self.closed and s in (0, self.size)

    def is_corner(self, s):
        """Is the parameter s (0 ≤ s < M, or M of an open curve) a joint that is not smooth?"""
        if s.denominator != 1 or self.is_end(s):
            return False
        a, b = self.directions(s)
        return dot(a, b) <= 0 or dot(a, b) ** 2 < dot(a, a) * dot(b, b)  # equal when and only when parallel
