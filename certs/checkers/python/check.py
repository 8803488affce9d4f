#!/usr/bin/env python3
"""Second, independent checker of knotproof certificates (`certificate/1`).

Written from docs/FORMAT.md alone; Python 3.11 or newer, standard library only.
The section numbers (§) in the comments are those of FORMAT.md.

All arithmetic is exact.  A point is a tuple of integers (x, y, z, w) and means (x, y, z)/w, w > 0; a plane
curve has z = 0.  A *hull* is a list of points with the same w.  *Tangents* are a list of groups, each a list
of integer vectors (x, y, z) with a positive common denominator.
"""

import argparse
import hashlib
import itertools
import json
import math
import os
import re
import reprlib
import sys
from fractions import Fraction
from functools import cached_property
from typing import NamedTuple

MAX_BITS = 65_536  # numerator or denominator of a number or of a vector, §1
MAX_WITNESS_BITS = 4_096  # integer of a leaf, §5
MAX_DEGREE = 64
MAX_COUNT = 4_000_000  # pieces, control points
MAX_HEADER = 16_777_216
MAX_JSON_BYTES = (1 << 30) - 1
MAX_GRID = 100_000
MAX_SUBSECTIONS = 1_024
MAX_DEPTH = 120  # of a part; parameters of nodes are kept multiplied by 2^120
MAGIC = b"KNOTCRT1"
NUMBER = re.compile(r"(0|-?[1-9][0-9]*)(?:/([1-9][0-9]*))?")
DIGITS = re.compile(r"0|[1-9][0-9]{0,19}")
HASH = re.compile(r"[0-9a-f]{64}")

sys.set_int_max_str_digits(0)  # the length of a text is checked before every conversion
reprlib.aRepr.maxstring = 70


class Reject(Exception):
    """The certificate is not accepted; the message says where and why."""


def expect(holds, where, wish, found):
    if not holds:
        raise Reject(f"{where}: expected {wish}, found {shown(found)}")


def shown(value):
    """A value for a message: a number is exact when short, otherwise rounded."""
    if not isinstance(value, (int, Fraction)):
        return reprlib.repr(value)[:100]
    if value.numerator.bit_length() + value.denominator.bit_length() < 120:
        return str(value)
    try:
        return f"about {float(value):.6g}"
    except OverflowError:
        return "a number of huge size"


# ---------------------------------------------------------------- §1 numbers and strict JSON


def bounded(number, where, bits=MAX_BITS):
    if number.bit_length() > bits:
        raise Reject(f"{where}: expected at most {bits} bits, found {number.bit_length()}")
    return number


def parse_number(text, where, bits=MAX_BITS, integer=False):
    """The fraction in a canonical text; with `integer` the integer, as an int."""
    longest = bits // 3 + 2  # more digits than an integer of so many bits can have
    match = NUMBER.fullmatch(text) if isinstance(text, str) and len(text) <= 2 * longest else None
    fits = match and all(part is None or len(part) <= longest for part in match.groups())
    if not fits or (integer and match[2]):
        kind = "integer" if integer else "fraction"
        raise Reject(f"{where}: expected a string holding a canonical {kind}, found {shown(text)}")
    p, q = bounded(int(match[1]), where, bits), bounded(int(match[2] or 1), where, bits)
    if match[2]:
        expect(p != 0 and q > 1 and math.gcd(p, q) == 1, where, "lowest terms p/q with p ≠ 0, q ≥ 2", text)
    return p if integer else Fraction(p, q)


def parse_json(data, what):
    def object_of(pairs):
        found = dict(pairs)
        expect(len(found) == len(pairs), what, "no repeated field", [key for key, _ in pairs])
        return found

    def refuse(text):
        raise Reject(f"{what}: the number {shown(text)} has no place here")

    def integer(text):
        return int(text) if DIGITS.fullmatch(text) and int(text) < 1 << 64 else refuse(text)

    try:
        return json.loads(data.decode("utf-8"), object_pairs_hook=object_of, parse_float=refuse,
                          parse_constant=refuse, parse_int=integer)
    except UnicodeDecodeError as error:
        raise Reject(f"{what}: not UTF-8 at byte {error.start}") from None
    except json.JSONDecodeError as error:
        raise Reject(f"{what}: not JSON: {error}") from None
    except RecursionError:
        raise Reject(f"{what}: nested too deeply") from None


def fields(value, where, required, optional=()):
    """`value`, an object that has all required fields and none but the allowed ones."""
    expect(isinstance(value, dict), where, "an object", value)
    for key in value:
        expect(key in required or key in optional, where, "no unknown field", key)
    for key in required:
        expect(key in value, where, f"the field '{key}', which is missing", list(value))
    return value


def json_integer(value, where, low, high=(1 << 64) - 1):
    expect(type(value) is int and low <= value <= high, where, f"an integer from {low} to {high}", value)  # bool is no int
    return value


def json_string(value, where, *allowed):
    wish = " or ".join(f"'{a}'" for a in allowed) or "a string of Unicode characters"
    expect(isinstance(value, str) and (not allowed or value in allowed), where, wish, value)
    expect(not any("\ud800" <= c <= "\udfff" for c in value), where, wish, value)
    return value


def json_list(value, where, length=None):
    expect(isinstance(value, list) and length in (None, len(value)), where,
           "a list" if length is None else f"a list of {length}", value)
    return value


def json_numbers(value, where, length=None, integer=False):
    return [parse_number(x, f"{where}[{i}]", integer=integer) for i, x in enumerate(json_list(value, where, length))]


# ---------------------------------------------------------------- §2 the curve as given


class Curve(NamedTuple):
    """A list of (coordinates, weights or None): of the Bézier pieces, or the only one of a B-spline.

    Coordinates, weights and knots are pairs (q, numerators) as in §7.
    """

    dimension: int
    spline: tuple | None  # degree, knots
    pieces: list


def vector(numbers, where):
    """Least common denominator and numerators over it, both within bounds at every step."""
    q = 1
    for x in numbers:
        q = bounded(math.lcm(q, x.denominator), f"{where}: least common denominator")
    return q, [bounded(x.numerator * (q // x.denominator), f"{where}: common numerator") for x in numbers]


def check_curve(curve):
    expect(1 <= len(curve.pieces) <= MAX_COUNT, "curve", f"1 to {MAX_COUNT} pieces", len(curve.pieces))
    for i, ((q, x), weights) in enumerate(curve.pieces):
        where = "curve" if curve.spline else f"curve: piece {i}"
        count, d = len(x) // curve.dimension, curve.dimension
        degree = curve.spline[0] if curve.spline else count - 1
        expect(1 <= degree <= MAX_DEGREE, where, f"a degree from 1 to {MAX_DEGREE}", degree)
        expect(degree < count <= MAX_COUNT, where, f"{degree + 1} to {MAX_COUNT} points", count)
        if i:
            (q0, x0), _ = curve.pieces[i - 1]
            meets = all(a * q == b * q0 for a, b in zip(x0[-d:], x[:d]))
            expect(meets, where, "to begin where the one before ends", Fraction(x[0], q))
        fits = weights is None or (len(weights[1]) == count and min(weights[1]) > 0)
        expect(fits, where, "as many weights as points, all positive", weights)
    if curve.spline:
        check_knots(curve.spline[0], curve.spline[1][1], count)
    return curve


def check_knots(degree, knots, count):
    expect(len(knots) == count + degree + 1, "curve", f"{count + degree + 1} knots", len(knots))
    low, high, run = knots[degree], knots[count], 0
    for i, knot in enumerate(knots):
        before = knots[i - 1] if i else None
        expect(i == 0 or before <= knot, f"curve: knot {i}", "no smaller one than before", knot)
        run = run + 1 if knot == before else 1
        most = degree if low < knot < high else degree + 1
        expect(run <= most, f"curve: knot {i}", f"a multiplicity of at most {most}", run)
    expect(low < high, "curve", "a parameter range that is not empty", degree)


def curve_from_json(value):
    expect(isinstance(value, dict) and list(value) in (["bspline"], ["bezier"]), "curve",
           "an object with the one field 'bspline' or 'bezier'", value)

    def piece_of(part, where):
        points = json_list(part["points"], where + ".points")
        expect(len(points) <= MAX_COUNT, where, f"at most {MAX_COUNT} points", len(points))
        points = [json_numbers(p, f"{where}.points[{i}]") for i, p in enumerate(points)]
        dimensions.update(map(len, points))
        flat = vector([x for p in points for x in p], where + ".points")
        if "weights" not in part:
            return flat, None
        return flat, vector(json_numbers(part["weights"], where + ".weights"), where + ".weights")

    dimensions, spline = set(), None
    if "bspline" in value:
        where = "curve.bspline"
        part = fields(value["bspline"], where, ("degree", "knots", "points"), ("weights",))
        degree = json_integer(part["degree"], where + ".degree", 1, MAX_DEGREE)
        spline = degree, vector(json_numbers(part["knots"], where + ".knots"), where + ".knots")
        pieces = [piece_of(part, where)]
    else:
        parts = json_list(fields(value["bezier"], "curve.bezier", ("pieces",))["pieces"], "curve.bezier.pieces")
        expect(1 <= len(parts) <= MAX_COUNT, "curve", f"1 to {MAX_COUNT} pieces", len(parts))
        where = "curve.bezier.pieces[%d]"
        pieces = [piece_of(fields(part, where % i, ("points",), ("weights",)), where % i)
                  for i, part in enumerate(parts)]
    expect(dimensions in ({2}, {3}), "curve", "points of 2 or of 3 coordinates, all alike", sorted(dimensions))
    return check_curve(Curve(dimensions.pop(), spline, pieces))


# ---------------------------------------------------------------- §7 binary form and hash


def varint(number):
    digits = format(number, "b")
    digits = "0" * (-len(digits) % 7) + digits
    groups = [int(digits[i:i + 7], 2) for i in range(len(digits) - 7, -1, -7)]
    return bytes([g | 128 for g in groups[:-1]] + groups[-1:])


def curve_block(curve):
    """The curve block, in many small strings of bytes."""
    def vector_bytes(q, numerators):
        yield varint(q)
        for n in numerators:
            yield varint(2 * n if n >= 0 else -2 * n - 1)

    yield bytes((curve.dimension, 0 if curve.spline else 1))
    if not curve.spline:
        yield varint(len(curve.pieces))
    for coordinates, weights in curve.pieces:
        count = len(coordinates[1]) // curve.dimension
        if curve.spline:
            yield varint(curve.spline[0]) + varint(count)
            yield from vector_bytes(*curve.spline[1])
        else:
            yield varint(count - 1)
        yield from vector_bytes(*coordinates)
        yield b"\0" if weights is None else b"\1"
        if weights:
            yield from vector_bytes(*weights)


class Reader:
    """Strict reading of the binary form; every shortage is a rejection."""

    def __init__(self, data):
        self.data, self.at = data, 0

    def left(self):
        return len(self.data) - self.at

    def take(self, count, what):
        expect(count <= self.left(), f"byte {self.at}: truncated", f"{count} bytes of {what}", self.left())
        self.at += count
        return self.data[self.at - count:self.at]

    def byte(self, what):
        if self.at == len(self.data):
            raise Reject(f"byte {self.at}: truncated: expected a byte of {what}")
        self.at += 1
        return self.data[self.at - 1]

    def varint(self, what, bits=MAX_BITS):
        start = self.at
        value = self.byte(what)
        if value < 128:
            return value
        while self.byte(what) & 128:
            if 7 * (self.at - start) >= bits:
                raise Reject(f"byte {start}: {what}: expected at most {bits} bits")
        groups = self.data[start:self.at]
        if groups[-1] == 0:
            raise Reject(f"byte {start}: {what}: padded varint")
        return bounded(int("".join(format(g & 127, "07b") for g in reversed(groups)), 2), what, bits)

    def signed(self, what, bits=MAX_BITS):
        value = self.varint(what, bits + 8)
        return bounded(-(value + 1) // 2 if value & 1 else value // 2, what, bits)

    def count(self, what, low, high):
        return json_integer(self.varint(what, 64), what, low, high)

    def vector(self, count, what):
        q = self.varint(what)
        numerators = [self.signed(what) for _ in range(count)]
        if q == 0 or math.gcd(q, *numerators) != 1:
            raise Reject(f"byte {self.at}: {what}: the denominator is not the least common one")
        return q, numerators

    def curve(self):
        dimension, kind = self.byte("dimension"), self.byte("kind of curve")
        expect(dimension in (2, 3) and kind in (0, 1), "curve block", "dimension 2 or 3, kind 0 or 1", (dimension, kind))

        def piece(count):
            coordinates, flag = self.vector(count * dimension, "coordinates"), self.byte("weight flag")
            expect(flag in (0, 1), "curve block", "a weight flag 0 or 1", flag)
            return coordinates, self.vector(count, "weights") if flag else None

        if kind == 0:
            degree = self.count("degree", 1, MAX_DEGREE)
            count = self.count("number of points", degree + 1, MAX_COUNT)
            spline = degree, self.vector(count + degree + 1, "knots")
            return check_curve(Curve(dimension, spline, [piece(count)]))
        count = self.count("number of pieces", 1, MAX_COUNT)
        pieces = [piece(self.count("degree", 1, MAX_DEGREE) + 1) for _ in range(count)]
        return check_curve(Curve(dimension, None, pieces))

    def tokens(self, dimension):
        fixed = {0: ("split", ()), 1: ("first", ()), 2: ("second", ()),
                 0x20: ("not_normal", (1, 0)), 0x21: ("not_normal", (-1, 0)),
                 0x22: ("not_normal", (0, 1)), 0x23: ("not_normal", (0, -1))}
        for axis in range(dimension):
            for code, sign in ((0x10, 1), (0x11, -1)):
                fixed[code + 2 * axis] = "far", tuple(sign * (i == axis) for i in range(dimension))
        long = {3: ("far", dimension), 4: ("not_normal", 2), 5: ("cone", dimension), 6: ("bend", 2)}
        while self.left():
            code = self.byte("token")
            if code in fixed:
                yield fixed[code]
            elif code in long:
                rule, count = long[code]
                yield rule, tuple(self.signed(rule, MAX_WITNESS_BITS) for _ in range(count))
            else:
                raise Reject(f"byte {self.at - 1}: unknown token 0x{code:02x}")


def tokens_from_json(texts, dimension):
    counts = {"split": 0, "first": 0, "second": 0, "far": dimension, "cone": dimension, "not_normal": 2, "bend": 2}
    for number, text in enumerate(texts):
        rule, *words = text.split(" ") if isinstance(text, str) else [None]
        expect(counts.get(rule) == len(words), f"token {number}", "a known token", text)
        yield rule, tuple(parse_number(w, f"token {number}", MAX_WITNESS_BITS, True) for w in words)


# ---------------------------------------------------------------- vectors and Bernstein coefficients


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def difference(p, q):
    """A positive multiple of the vector p − q."""
    v, w = p[3], q[3]
    return p[0] * w - q[0] * v, p[1] * w - q[1] * v, p[2] * w - q[2] * v


def reduced(vectors, denominator=0):
    """The vectors and their denominator without common factor (0: the scale does not matter)."""
    factor = math.gcd(denominator, *(x for v in vectors for x in v))
    if factor > 1:
        vectors = [tuple(x // factor for x in v) for v in vectors]
    return vectors, denominator // (factor or 1)


def split_at(coefficients, a, r):
    """De Casteljau at a/r: the coefficients left and right of it, all multiplied by r^degree."""
    row, b = coefficients, r - a
    left, right = [row[0]], [row[-1]]
    while len(row) > 1:
        row = [tuple([b * x + a * y for x, y in zip(p, q)]) for p, q in zip(row, row[1:])]
        left.append(row[0])
        right.append(row[-1])
    powers = [r ** k for k in range(len(left) - 1, -1, -1)]
    left = [tuple([f * x for x in v]) for f, v in zip(powers, left)]
    right = [tuple([f * x for x in v]) for f, v in zip(powers, right)]
    return left, right[::-1]


def hull_of(points):
    """The same points with the same w."""
    w = math.lcm(*{p[3] for p in points})
    return [tuple([x * (w // p[3]) for x in p]) for p in points]


# ---------------------------------------------------------------- §3 the chain of pieces


class Piece:
    """Homogeneous control points (up to a common positive factor) and the field D over `d_den`."""

    __slots__ = ("homogeneous", "d", "d_den", "outgoing", "incoming")

    def __init__(self, homogeneous, scale, index):
        """The true homogeneous control points are `homogeneous`/`scale`."""
        n, h = len(homogeneous) - 1, homogeneous
        if all(x[3] == h[0][3] for x in h):
            d, denominator = [tuple(y - x for x, y in zip(p[:3], q[:3])) for p, q in zip(h, h[1:])], h[0][3]
        else:
            common = math.lcm(*(math.comb(2 * n - 2, k) for k in range(2 * n - 1)))
            d, denominator = [], scale * scale * common
            for k in range(2 * n - 1):
                total = (0, 0, 0)
                for i in range(max(0, k - n + 1), k // 2 + 1):
                    j = k - i + 1
                    factor = (j - i) * math.comb(n, i) * math.comb(n, j) * (common // math.comb(2 * n - 2, k))
                    total = tuple(t + factor * (h[i][3] * y - h[j][3] * x) for t, x, y in zip(total, h[i], h[j]))
                d.append(total)
        self.homogeneous = reduced(h)[0]
        self.d, self.d_den = reduced(d, denominator)
        directions = [v for v in self.d if any(v)]
        if not directions:
            raise Reject(f"curve: piece {index} is a single point (D vanishes)")
        self.outgoing, self.incoming = directions[0], directions[-1]

    def restricted(self, u0, u1):
        """Homogeneous control points, and D with its denominator, on [u0, u1], u0 < u1."""
        r = math.lcm(u0.denominator, u1.denominator)
        a, b = int(u0 * r), int(u1 * r)
        homogeneous = split_at(split_at(self.homogeneous, b, r)[0], a, b)[1]
        d = split_at(split_at(self.d, b, r)[0], a, b)[1]
        return reduced(homogeneous)[0], reduced(d, self.d_den * (r * b) ** (len(d) - 1))

    def point(self, u):
        return split_at(self.homogeneous, u.numerator, u.denominator)[0][-1]

    def direction(self, u, where):
        """The direction at u (§6, `root`), up to a positive factor."""
        d = split_at(self.d, u.numerator, u.denominator)[0][-1]
        if any(d):
            return d
        if u == 0:
            return self.outgoing
        if u == 1:
            return self.incoming
        raise Reject(f"{where}: D vanishes inside a piece, so there is no direction")


class Chain:
    """The pieces, whether the curve is closed, and its joints."""

    def __init__(self, curve):
        self.dimension = curve.dimension
        chain = [lifted(curve.dimension, *piece) for piece in curve.pieces]
        if curve.spline:
            chain = bspline_pieces(curve.spline[0], curve.spline[1][1], *chain[0])
        self.pieces = [Piece(points, scale, index) for index, (points, scale) in enumerate(chain)]
        self.size = len(self.pieces)
        self.closed = not any(difference(self.pieces[0].homogeneous[0], self.pieces[-1].homogeneous[-1]))

    def directions(self, joint):
        """Incoming and outgoing direction at a joint, each with its denominator."""
        before, after = self.pieces[joint - 1], self.pieces[joint % self.size]
        return (before.incoming, before.d_den), (after.outgoing, after.d_den)

    def is_corner(self, s):
        """Is the parameter s (0 ≤ s < M, or M of an open curve) a joint that is not smooth?"""
        if s.denominator != 1 or (not self.closed and s in (0, self.size)):
            return False
        (a, _), (b, _) = self.directions(int(s))
        return any(cross(a, b)) or dot(a, b) <= 0

    def locate(self, s, side, where):
        """Piece and local parameter of s, on the given side of it."""
        i = math.floor(s)
        if s == i and side == "before":
            if i == 0 and not self.closed:
                raise Reject(f"{where}: no piece ends at 0")
            return self.pieces[i - 1], Fraction(1)
        if i == self.size:
            raise Reject(f"{where}: no piece begins at {i}")
        return self.pieces[i], s - i


def lifted(dimension, coordinates, weights):
    """Homogeneous control points as integers, and the scale they stand over."""
    q, x = coordinates
    r, w = weights or (1, [1] * (len(x) // dimension))
    points = [(*x[k:k + dimension], 0)[:3] for k in range(0, len(x), dimension)]
    return [(*(f * c for c in p), f * q) for f, p in zip(w, points)], q * r


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


# ---------------------------------------------------------------- §5 nodes


class Node:
    """A part, a point element or a run, from parameter `start` to `end` (both times 2^120).

    It has `hull` and `tangents`, the H and T of FORMAT.md, and `children`, all made once; `ends` are the
    ends of an open curve in it (convention critical).
    """

    ends = frozenset()

    def __str__(self):
        start, end = (str(Fraction(x, 1 << MAX_DEPTH)) for x in (self.start, self.end))
        return f"[{start}, {end}]" if self.start < self.end else "{%s}" % start


class Part(Node):
    """[j/2^e, (j+1)/2^e] of the piece number `index`, with its homogeneous control points and its D."""

    def __init__(self, index, j, e, homogeneous, d, d_den):
        self.start = (index << MAX_DEPTH) + (j << MAX_DEPTH - e)
        self.end = self.start + (1 << MAX_DEPTH - e)
        self.index, self.j, self.e = index, j, e
        self.homogeneous, self.d, self.d_den = homogeneous, d, d_den

    @cached_property
    def hull(self):
        return hull_of(self.homogeneous)

    @cached_property
    def tangents(self):
        return [([v for v in self.d if any(v)], self.d_den)]

    @cached_property
    def children(self):
        if self.e == MAX_DEPTH:
            raise Reject(f"a part of depth {MAX_DEPTH} is not split")
        denominator = self.d_den << (len(self.d) - 1)
        halves = zip(split_at(self.homogeneous, 1, 2), split_at(self.d, 1, 2))
        return [Part(self.index, 2 * self.j + side, self.e + 1, reduced(h)[0], *reduced(d, denominator))
                for side, (h, d) in enumerate(halves)]


class Point(Node):
    def __init__(self, parameter, place, directions, ends=""):
        self.start = self.end = parameter << MAX_DEPTH
        self.hull = [place]
        self.tangents = [([v], denominator) for v, denominator in directions]
        self.ends = frozenset(ends)

    @property
    def children(self):
        raise Reject("a point element is not split")


class Run(Node):
    """The elements number a … b−1, at least two."""

    def __init__(self, elements, a, b, grid):
        self.elements, self.a, self.b, self.grid = elements, a, b, grid
        self.start, self.end = elements[a].start, elements[b - 1].end
        self.ends = elements[a].ends | elements[b - 1].ends

    @cached_property
    def children(self):
        middle = (self.a + self.b) // 2
        return [node(self.elements, self.a, middle, self.grid), node(self.elements, middle, self.b, self.grid)]

    @cached_property
    def box(self):
        """Lower and upper corner, as integers over 2^grid."""
        low, high = [], []
        for child in self.children:
            if isinstance(child, Run):
                low.append(child.box[0])
                high.append(child.box[1])
            else:
                axes, w = list(zip(*child.hull))[:3], child.hull[0][3]
                low.append([(min(x) << self.grid) // w for x in axes])
                high.append([-(-(max(x) << self.grid) // w) for x in axes])
        return [min(x) for x in zip(*low)], [max(x) for x in zip(*high)]

    @cached_property
    def hull(self):
        return sorted(set(itertools.product(*zip(*self.box), [1 << self.grid])))

    @cached_property
    def tangents(self):
        return [group for element in self.elements[self.a:self.b] for group in element.tangents]


def node(elements, a, b, grid):
    return elements[a] if b - a == 1 else Run(elements, a, b, grid)


def elements_of(chain, critical):
    elements, first, last = [], chain.pieces[0], chain.pieces[-1]
    if critical and not chain.closed:
        elements.append(Point(0, first.point(Fraction(0)), [(first.outgoing, first.d_den)], "0"))
    for i, piece in enumerate(chain.pieces):
        if critical and chain.is_corner(Fraction(i)):
            elements.append(Point(i, piece.point(Fraction(0)), chain.directions(i)))
        elements.append(Part(i, 0, 0, piece.homogeneous, piece.d, piece.d_den))
    if critical and not chain.closed:
        elements.append(Point(chain.size, last.point(Fraction(1)), [(last.incoming, last.d_den)], "M"))
    return elements


# ---------------------------------------------------------------- §5 the cover tree


class Cover:
    """The replay of the cover tree; lower is None for "inf"."""

    def __init__(self, chain, critical, grid, lower):
        self.chain, self.lower = chain, lower
        elements = elements_of(chain, critical)
        self.whole = node(elements, 0, len(elements), grid)
        self.rules = {"far": self.far, "not_normal": self.not_normal, "cone": self.cone, "bend": self.bend}

    def replay(self, tokens):
        """Check every token; return their number."""
        stack, number = [(self.whole, self.whole)], 0
        for rule, integers in tokens:
            if not stack:
                raise Reject(f"token {number}: expected the end of the tree, found '{rule}'")
            a, b = stack.pop()
            try:
                stack.extend(self.step(a, b, rule, integers))
            except Reject as error:
                words = " ".join([rule, *(shown(n) for n in integers)])
                raise Reject(f"token {number}, pair {a} x {b}, rule '{words}': {error}") from None
            while stack and stack[-1][0] is stack[-1][1] and isinstance(stack[-1][0], Point):
                stack.pop()
            number += 1
        if stack:
            raise Reject("token {}, pair {} x {}: expected a token, found the end of the tree".format(number, *stack[-1]))
        return number

    def step(self, a, b, rule, integers):
        """The pairs that follow, the last one first; a leaf has none."""
        if rule in self.rules:
            if not any(integers):
                raise Reject("expected integers not all zero")
            mixed = rule == "bend" or (rule == "not_normal" and all(integers))
            if mixed and (isinstance(a, Run) or isinstance(b, Run)):
                raise Reject("this rule is not for runs")
            self.rules[rule](a, b, *integers)
            return []
        if (rule == "split") != (a is b):
            raise Reject("this token is not for such a pair")
        if rule == "first":
            return [(child, b) for child in reversed(a.children)]
        if rule == "second":
            return [(a, child) for child in reversed(b.children)]
        one, two = a.children
        return [(two, two), (one, two), (one, one)]

    def far(self, a, b, *n):
        if self.lower is None:
            raise Reject("expected no 'far' under lower_squared \"inf\"")
        n, w_a, w_b = (*n, 0)[:3], a.hull[0][3], b.hull[0][3]
        gap = min(dot(n, p) for p in a.hull) * w_b - max(dot(n, q) for q in b.hull) * w_a
        scale = w_a * w_b
        if gap <= 0:
            raise Reject(f"expected g > 0, found g = {shown(Fraction(gap, scale))}")
        if gap * gap * self.lower.denominator < self.lower.numerator * dot(n, n) * scale * scale:
            found = Fraction(gap * gap, scale * scale * dot(n, n))
            raise Reject(f"expected g²/(n·n) ≥ {shown(self.lower)}, found {shown(found)}")

    def not_normal(self, a, b, alpha, beta):
        if a is b:
            raise Reject("expected two different nodes")
        if (a.ends and alpha > 0) or (b.ends and beta > 0):
            raise Reject("expected α ≤ 0, β ≤ 0 at an end of the curve")
        for i, p in enumerate(a.hull):
            for k, q in enumerate(b.hull):
                if not combination_positive(difference(p, q), a.tangents, alpha, b.tangents, beta):
                    raise Reject(f"expected (p−q)·(αv+βw) > 0, found a value ≤ 0 at hull points {i} and {k}")

    def require_neighbours(self, a, b):
        around = self.chain.closed and a.start == 0 and b.end == self.chain.size << MAX_DEPTH
        if not (a is b or a.end == b.start or around):
            raise Reject("expected equal or adjacent nodes")

    def cone(self, a, b, *n):
        self.require_neighbours(a, b)
        n = (*n, 0)[:3]
        nn = dot(n, n)
        for group, _ in a.tangents + (b.tangents if a is not b else []):
            for v in group:
                vn = dot(v, n)
                if vn <= 0 or 2 * vn * vn <= dot(v, v) * nn:
                    raise Reject("expected all tangents within 45° of n, found one that is not")

    def bend(self, a, b, alpha, beta):
        self.require_neighbours(a, b)
        if ("0" in a.ends and alpha < 0) or ("M" in b.ends and beta < 0):
            raise Reject("expected α ≥ 0 at the start, β ≥ 0 at the end of the curve")
        for x_node in {a, b}:
            for group, _ in [] if isinstance(x_node, Point) else x_node.tangents:
                if not all(combination_positive(x, a.tangents, alpha, b.tangents, beta) for x in group):
                    raise Reject("expected (αv+βw)·x > 0, found a value ≤ 0")


def least(chord, groups, factor):
    """The least value of factor·(v·chord), as numerator and denominator."""
    if factor == 0:
        return 0, 1
    best, best_den = None, 1
    x, y, z = chord
    for vectors, den in groups:
        values = [v[0] * x + v[1] * y + v[2] * z for v in vectors]
        value = factor * (min(values) if factor > 0 else max(values))
        if best is None or value * best_den < best * den:
            best, best_den = value, den
    return best, best_den


def combination_positive(chord, groups_v, alpha, groups_w, beta):
    """Is chord·(αv + βw) > 0 for all v and all w?  (The least of a sum is the sum of the least.)"""
    v, v_den = least(chord, groups_v, alpha)
    w, w_den = least(chord, groups_w, beta)
    return v * w_den + w * v_den > 0


# ---------------------------------------------------------------- §6 the upper bound


class Interval:
    """[s0, s1] with its sections (piece, u0, u1), and the homogeneous points and D on each."""

    def __init__(self, chain, rule, name):
        self.chain, self.where, size = chain, "upper." + name, chain.size
        self.start, self.end = s0, s1 = json_numbers(rule[name], self.where, 2)
        expect(0 <= s0 < s1 <= s0 + 1 and s0 < size and (s1 <= size or chain.closed), self.where,
               "0 ≤ s₀ < s₁ ≤ s₀ + 1 on the curve", [str(s0), str(s1)])
        inside = math.floor(s0) + 1
        self.joint = inside % size if inside < s1 else None  # the integer strictly inside
        cuts = [s0, s1] if self.joint is None else [s0, Fraction(inside), s1]
        self.sections = [(chain.pieces[math.floor(a) % size], a - math.floor(a), b - math.floor(a))
                         for a, b in zip(cuts, cuts[1:])]
        whole = list(self.subsections(1))
        self.points, self.tangents = [p for points, _ in whole for p in points], [d for _, d in whole]
        (d, den), (d1, den1) = self.tangents[0], self.tangents[-1]
        self.ends = (self.points[0], ([d[0]], den)), (self.points[-1], ([d1[-1]], den1))

    def require_regular(self, m, where):
        """Smooth joints inside only, and m·v > 0 for all tangents."""
        m = (*json_numbers(m, where, self.chain.dimension, True), 0)[:3]
        if self.joint is not None and self.chain.is_corner(Fraction(self.joint)):
            raise Reject(f"{self.where}: the joint {self.joint} inside is a corner")
        if any(dot(m, v) <= 0 for d, _ in self.tangents for v in d):
            raise Reject(f"{self.where}: expected m·v > 0 for all tangents, found a value ≤ 0")

    def subsections(self, count):
        """(points, tangents) of the equal sub-sections of every section."""
        for piece, u0, u1 in self.sections:
            step = (u1 - u0) / count
            for i in range(count):
                yield piece.restricted(u0 + step * i, u0 + step * (i + 1))


def two_intervals(chain, rule):
    i, j = Interval(chain, rule, "s"), Interval(chain, rule, "t")
    if not i.end < j.start or (chain.closed and not j.end < i.start + chain.size):
        raise Reject("upper: expected disjoint intervals in order, found others")
    return i, j


def parameter(chain, value, where):
    s = parse_number(value, where)
    expect(0 <= s <= chain.size and not (chain.closed and s == chain.size), where, "a parameter of the curve", s)
    return s


def two_parameters(chain, rule):
    s, t = parameter(chain, rule["s"], "upper.s"), parameter(chain, rule["t"], "upper.t")
    expect(s < t, "upper", "s < t", [str(s), str(t)])
    return s, t


def place(chain, s):
    """The point c(s)."""
    piece, u = chain.locate(s, "before" if s == chain.size else "after", "upper")
    return piece.point(u)


def require_short(points, others, upper):
    for p, q in itertools.product(points, others):
        x = difference(p, q)
        if dot(x, x) * upper.denominator > upper.numerator * (p[3] * q[3]) ** 2:
            found = Fraction(dot(x, x), (p[3] * q[3]) ** 2)
            raise Reject(f"upper: expected squared lengths ≤ {shown(upper)}, found {shown(found)}")


def require_signs(own, others, orientation, positive):
    """orientation·(end of own − q) has to be on the negative side at the start, on the positive at the end."""
    for points, tangents in others:
        for side, sign in ((0, -orientation), (1, orientation)):
            end, direction = own.ends[side]
            for q in points:
                x = difference(end, q)
                if not positive((sign * x[0], sign * x[1], sign * x[2]), direction, tangents):
                    raise Reject(f"{own.where}[{side}]: expected a value {'<>'[side]} 0 on this edge, found another sign")


def check_miranda(chain, rule, upper):
    i, j = two_intervals(chain, rule)
    m = json_integer(rule["subdivisions"], "upper.subdivisions", 1, MAX_SUBSECTIONS)
    alpha1, beta1 = json_numbers(rule["first"], "upper.first", 2, True)
    alpha2, beta2 = json_numbers(rule["second"], "upper.second", 2, True)
    for interval, m_own in zip((i, j), json_list(rule["regular"], "upper.regular", 2)):
        interval.require_regular(m_own, "upper.regular")
    if alpha1 * beta2 == alpha2 * beta1:
        raise Reject("upper: expected α₁β₂ ≠ α₂β₁, found equality")
    require_signs(i, j.subsections(m), 1, lambda x, d, w: combination_positive(x, [d], alpha1, [w], beta1))
    require_signs(j, i.subsections(m), -1, lambda x, d, v: combination_positive(x, [v], alpha2, [d], beta2))
    require_short(i.points, j.points, upper)


def check_crossing(chain, rule, _upper):
    expect(chain.dimension == 2, "upper, rule 'crossing'", "a curve in the plane", chain.dimension)
    i, j = two_intervals(chain, rule)
    n1, n2 = ((*json_numbers(rule[name], "upper." + name, 2, True), 0) for name in ("first", "second"))
    if not any(cross(n1, n2)):
        raise Reject("upper: the two vectors are linearly dependent")
    require_signs(i, j.subsections(1), 1, lambda x, _d, _w: dot(n1, x) > 0)
    require_signs(j, i.subsections(1), -1, lambda x, _d, _v: dot(n2, x) > 0)


def check_root(chain, rule, upper):
    located = []
    for name, s in zip("st", two_parameters(chain, rule)):
        where = f"upper.{name}_side"
        allowed = ("after", "before") if s.denominator == 1 else ("after",)
        located.append(chain.locate(s, json_string(rule[name + "_side"], where, *allowed), where))
    p, q = (piece.point(u) for piece, u in located)
    for (piece, u), name in zip(located, "st"):
        if dot(difference(p, q), piece.direction(u, f"upper.{name}")):
            raise Reject(f"upper: the chord is not orthogonal to the direction at {name}")
    require_short([p], [q], upper)


def check_touch(chain, rule, _upper):
    s, t = two_parameters(chain, rule)
    if any(difference(place(chain, s), place(chain, t))):
        raise Reject("upper: the points at s and t differ")


def is_critical(chain, s, x):
    """Is the chord x = (other end) − c(s) critical at s (§4)?"""
    if not chain.closed and s == 0:
        return dot(x, chain.pieces[0].outgoing) <= 0
    if not chain.closed and s == chain.size:
        return dot(x, chain.pieces[-1].incoming) >= 0
    if chain.is_corner(s):
        (a, _), (b, _) = chain.directions(int(s))
        return dot(x, a) * dot(x, b) <= 0
    piece, u = chain.locate(s, "after", "upper")
    return dot(x, piece.direction(u, "upper")) == 0


def check_critical_root(chain, rule, upper):
    s, t = two_parameters(chain, rule)
    p, q = place(chain, s), place(chain, t)
    for name, at, chord in (("s", s, difference(q, p)), ("t", t, difference(p, q))):
        if not is_critical(chain, at, chord):
            raise Reject(f"upper: the chord is not critical at {name}")
    require_short([p], [q], upper)


def check_critical_interval(chain, rule, upper):
    s = parameter(chain, rule["s"], "upper.s")
    is_end = not chain.closed and s in (0, chain.size)
    expect(is_end or chain.is_corner(s), "upper.s", "the parameter of a corner or an end", s)
    j = Interval(chain, rule, "t")
    if j.start <= s <= j.end or (chain.closed and j.start <= s + chain.size <= j.end):
        raise Reject("upper.t: the interval contains s")
    j.require_regular(rule["regular"], "upper.regular")
    e = place(chain, s)
    chords = [difference(q, e) for q in j.points]
    if is_end:
        critical = all(is_critical(chain, s, x) for x in chords)
    else:
        (a, _), (b, _) = chain.directions(int(s))
        critical = any(all(sign * dot(x, a) >= 0 >= sign * dot(x, b) for x in chords) for sign in (1, -1))
    if not critical:
        raise Reject("upper: not every chord is seen to be critical at s")
    signs = [dot(difference(point, e), d[0]) for point, (d, _) in j.ends]
    if not min(signs) < 0 < max(signs):
        raise Reject("upper: expected opposite signs at the ends of the interval")
    require_short([e], j.points, upper)


UPPER_RULES = {
    "miranda": (check_miranda, ("rule", "s", "t", "first", "second", "regular", "subdivisions")),
    "root": (check_root, ("rule", "s", "s_side", "t", "t_side")),
    "touch": (check_touch, ("rule", "s", "t")),
    "crossing": (check_crossing, ("rule", "s", "t", "first", "second")),
    "critical_root": (check_critical_root, ("rule", "s", "t")),
    "critical_interval": (check_critical_interval, ("rule", "s", "t", "regular")),
}


def check_upper(chain, rule, upper, critical):
    name = rule.get("rule") if isinstance(rule, dict) else None
    rules = [each for each in UPPER_RULES if critical or not each.startswith("critical")]
    check, names = UPPER_RULES[json_string(name, "evidence.upper: rule", *rules)]
    check(chain, fields(rule, "evidence.upper", names), upper)


# ---------------------------------------------------------------- §4 the certificate


def read_document(data):
    """The JSON document, and the reader of what follows it (None in the JSON form)."""
    if data[:8] != MAGIC:
        expect(len(data) <= MAX_JSON_BYTES, "certificate", f"at most {MAX_JSON_BYTES} bytes of JSON", len(data))
        return parse_json(data, "certificate"), None
    reader = Reader(data)
    reader.take(8, "magic")
    length = int.from_bytes(reader.take(4, "header length"), "little")
    expect(length <= MAX_HEADER, "header", f"at most {MAX_HEADER} bytes", length)
    return parse_json(reader.take(length, "header"), "header"), reader


def read_evidence(document, tree, reader):
    """The curve, its hash and the tokens of the tree."""
    if reader is None:
        curve, digest = curve_from_json(document["curve"]), hashlib.sha256()
        for piece in curve_block(curve):
            digest.update(piece)
        tokens = () if tree is None else tokens_from_json(json_list(tree, "evidence.tree"), curve.dimension)
        return curve, digest.hexdigest(), tokens
    json_string(document["curve"], "curve", "binary")
    begin, curve = reader.at, reader.curve()
    digest = hashlib.sha256(memoryview(reader.data)[begin:reader.at])
    if tree is None:
        expect(reader.left() == 0, f"byte {reader.at}", "no bytes left over", reader.left())
        return curve, digest.hexdigest(), ()
    json_string(tree, "evidence.tree", "binary")
    return curve, digest.hexdigest(), reader.tokens(curve.dimension)


def check_statement(statement):
    """Lower bound (None: "inf") and upper bound (None: none)."""
    fields(statement, "statement", ("claim", "convention", "lower_squared", "upper_squared"))
    json_string(statement["claim"], "statement.claim", "msd")
    json_string(statement["convention"], "statement.convention", "smooth", "critical")
    bounds = []
    for name, open_bound in (("lower_squared", "inf"), ("upper_squared", None)):
        where, value = "statement." + name, statement[name]
        bounds.append(None if value == open_bound else parse_number(value, where))
        expect(bounds[-1] is None or bounds[-1] >= 0, where, "no negative bound", bounds[-1])
    lower, upper = bounds
    expect(upper is None or (lower is not None and lower <= upper), "statement", "lower_squared ≤ upper_squared", upper)
    return lower, upper


def check_certificate(data, wanted_hash=None):
    """The statement of an accepted certificate, with `tokens` added; raises Reject otherwise."""
    document, reader = read_document(data)
    fields(document, "certificate", ("knotproof", "tool", "curve", "curve_sha256", "statement", "evidence"),
           ("name", "snapped_joints"))
    json_string(document["knotproof"], "knotproof", "certificate/1")
    json_string(document["tool"], "tool")
    json_string(document.get("name", ""), "name")
    json_integer(document.get("snapped_joints", 0), "snapped_joints", 0)
    evidence = fields(document["evidence"], "evidence", ("grid", "tree", "upper"))
    grid, tree = json_integer(evidence["grid"], "evidence.grid", 0, MAX_GRID), evidence["tree"]
    statement = document["statement"]
    lower, upper = check_statement(statement)
    expect((tree is None) == (lower == 0), "evidence.tree", "null when and only when lower_squared is \"0\"", tree)
    expect((evidence["upper"] is None) == (upper is None), "evidence.upper",
           "null when and only when upper_squared is null", evidence["upper"])

    curve, found_hash, tokens = read_evidence(document, tree, reader)
    stated_hash = json_string(document["curve_sha256"], "curve_sha256")
    expect(HASH.fullmatch(stated_hash), "curve_sha256", "64 lower-case hexadecimal digits", stated_hash)
    expect(stated_hash == found_hash, "curve_sha256", found_hash, stated_hash)
    expect(wanted_hash in (None, found_hash), "the certificate is about another curve", wanted_hash, found_hash)

    critical = statement["convention"] == "critical"
    chain, count = Chain(curve), 0
    if tree is not None:
        count = Cover(chain, critical, grid, lower).replay(tokens)
    if upper is not None:
        check_upper(chain, evidence["upper"], upper, critical)
    return {**statement, "curve_sha256": found_hash, "tokens": count}


# ---------------------------------------------------------------- command line


def sentence(statement):
    lower, upper = statement["lower_squared"], statement["upper_squared"]
    bounds = "no double normal" if lower == "inf" else f"σ² in [{lower}, {'∞' if upper is None else upper}]"
    return (f"{bounds}, convention {statement['convention']}, {statement['tokens']} tokens, "
            f"curve {statement['curve_sha256']}")


def examine(path, wanted_hash):
    """Verdict and the fields of the report for one file."""
    try:
        with open(path, "rb") as stream:
            size = os.fstat(stream.fileno()).st_size
            if stream.peek(8)[:8] != MAGIC:
                expect(size <= MAX_JSON_BYTES, "certificate", f"at most {MAX_JSON_BYTES} bytes of JSON", size)
            data = stream.read()
        return "accepted", {"statement": check_certificate(data, wanted_hash)}
    except OSError as error:
        return "unreadable", {"reason": str(error)}
    except Reject as error:
        return "rejected", {"reason": str(error)}
    except (MemoryError, RecursionError, OverflowError) as error:
        return "rejected", {"reason": f"the limits of this machine do not suffice: {error!r}"}


def main(arguments=None):
    parser = argparse.ArgumentParser(description="Check knotproof certificates (JSON or binary form).",
                                     epilog="Exit code: 0 all accepted, 1 any rejected, 2 unreadable file or usage.",
                                     allow_abbrev=False)
    parser.add_argument("files", nargs="+", metavar="CERT")
    parser.add_argument("--curve-sha256", metavar="HEX", help="the curve it must be about")
    parser.add_argument("--json", action="store_true", help="print one JSON object for each file")
    parser.add_argument("--quiet", action="store_true", help="print nothing; the exit code tells")
    options = parser.parse_args(arguments)
    if options.curve_sha256 is not None and not HASH.fullmatch(options.curve_sha256):
        parser.error("--curve-sha256: expected 64 lower-case hexadecimal digits")
    if hasattr(sys.stdout, "reconfigure"):
        sys.stdout.reconfigure(encoding="utf-8", errors="backslashreplace")
    verdicts = set()
    for path in options.files:
        verdict, report = examine(path, options.curve_sha256)
        verdicts.add(verdict)
        if options.json and not options.quiet:
            print(json.dumps({"file": path, "verdict": verdict, **report}))
        elif not options.quiet:
            print(f"{verdict}: {path}: {sentence(report['statement']) if verdict == 'accepted' else report['reason']}")
    return 1 if "rejected" in verdicts else 2 if "unreadable" in verdicts else 0


if __name__ == "__main__":
    sys.exit(main())
