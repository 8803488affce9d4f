#!/usr/bin/env python3
"""Second, independent checker of knotproof certificates (`certificate/1`).

Written from docs/FORMAT.md alone; Python 3.11 or newer, standard library only.
The section numbers (§) in the comments are those of FORMAT.md.

All arithmetic is exact.  A vector is a tuple of three integers (a plane curve has
third coordinate 0) over a positive integer denominator kept beside it:
a *hull* is (list of vectors, denominator), *tangents* are a list of such groups.
"""

import argparse
import hashlib
import json
import math
import re
import sys
from fractions import Fraction

MAX_BITS = 65_536  # numerator or denominator of a number, §1
MAX_LEAF_BITS = 4_096  # integer of a leaf, §5
MAX_DEGREE = 64
MAX_PIECES = 4_000_000
MAX_HEADER = 16_777_216
MAX_JSON_BYTES = 1 << 30
MAX_GRID = 100_000
MAX_DEPTH = 120  # of a part; parameters of nodes are kept multiplied by 2^120
MAGIC = b"KNOTCRT1"

INTEGER = re.compile(r"0|-?[1-9][0-9]*")
FRACTION = re.compile(r"(0|-?[1-9][0-9]*)(?:/([1-9][0-9]*))?")
HASH = re.compile(r"[0-9a-f]{64}")


sys.set_int_max_str_digits(0)  # the length of a text is checked before every conversion


class Reject(Exception):
    """The certificate is not accepted; the message says where and why."""


def show(value):
    """A number for a message: exact when short, otherwise rounded."""
    text = str(value) if value.numerator.bit_length() + value.denominator.bit_length() < 120 else ""
    if text:
        return text
    try:
        return f"about {float(value):.6g}"
    except OverflowError:
        return "a number of huge size"


# ---------------------------------------------------------------- §1 numbers


def bounded(number, bits, where):
    if number.bit_length() > bits:
        raise Reject(f"{where}: expected at most {bits} bits, found {number.bit_length()}")
    return number


def parse_integer(text, where, bits=MAX_BITS):
    if not isinstance(text, str) or len(text) > bits // 3 + 2 or not INTEGER.fullmatch(text):
        raise Reject(f"{where}: expected a string holding a canonical integer, found {clip(text)}")
    return bounded(int(text), bits, where)


def parse_fraction(text, where):
    longest = MAX_BITS // 3 + 2
    match = FRACTION.fullmatch(text) if isinstance(text, str) and len(text) <= 2 * longest else None
    if not match or any(part and len(part) > longest for part in match.groups()):
        raise Reject(f"{where}: expected a string holding a canonical fraction, found {clip(text)}")
    numerator = bounded(int(match[1]), MAX_BITS, where)
    if match[2] is None:
        return Fraction(numerator)
    denominator = bounded(int(match[2]), MAX_BITS, where)
    if numerator == 0 or denominator < 2 or math.gcd(numerator, denominator) != 1:
        raise Reject(f"{where}: expected lowest terms p/q with p ≠ 0, q ≥ 2, found {clip(text)}")
    return Fraction(numerator, denominator)


def clip(value):
    text = repr(value)
    return text if len(text) <= 60 else text[:57] + "..."


# ---------------------------------------------------------------- strict JSON


def parse_json(data, what):
    def pairs(items):
        found = {}
        for key, value in items:
            if key in found:
                raise Reject(f"{what}: the field {clip(key)} is repeated")
            found[key] = value
        return found

    def refuse(text):
        raise Reject(f"{what}: the literal {clip(text)} has no place here")

    def whole(text):
        if len(text) > 20 or not INTEGER.fullmatch(text):
            refuse(text)
        return int(text)

    try:
        return json.loads(data.decode("utf-8"), object_pairs_hook=pairs, parse_float=refuse,
                          parse_constant=refuse, parse_int=whole)
    except UnicodeDecodeError as error:
        raise Reject(f"{what}: not UTF-8 at byte {error.start}") from None
    except json.JSONDecodeError as error:
        raise Reject(f"{what}: not JSON: {error}") from None
    except RecursionError:
        raise Reject(f"{what}: nested too deeply") from None


def fields(value, where, required, optional=()):
    """The object `value` has all required fields and none but the allowed ones."""
    if not isinstance(value, dict):
        raise Reject(f"{where}: expected an object, found {clip(value)}")
    for key in value:
        if key not in required and key not in optional:
            raise Reject(f"{where}: unknown field {clip(key)}")
    for key in required:
        if key not in value:
            raise Reject(f"{where}: the field '{key}' is missing")
    return value


def json_integer(value, where, low, high=None):
    if type(value) is not int or value < low or (high is not None and value > high):  # bool is no int
        limit = f"from {low} to {high}" if high is not None else f"of at least {low}"
        raise Reject(f"{where}: expected an integer {limit}, found {clip(value)}")
    return value


def json_string(value, where, allowed=None):
    if not isinstance(value, str) or (allowed is not None and value not in allowed):
        wish = "a string" if allowed is None else " or ".join(f"'{a}'" for a in allowed)
        raise Reject(f"{where}: expected {wish}, found {clip(value)}")
    if any("\ud800" <= c <= "\udfff" for c in value):
        raise Reject(f"{where}: a lone surrogate is no character")
    return value


def json_list(value, where, length=None):
    if not isinstance(value, list) or (length is not None and len(value) != length):
        size = "" if length is None else f" of {length}"
        raise Reject(f"{where}: expected a list{size}, found {clip(value)}")
    return value


def fractions_of(value, where, length=None):
    return [parse_fraction(x, f"{where}[{i}]") for i, x in enumerate(json_list(value, where, length))]


def integers_of(value, where, length):
    return [parse_integer(x, f"{where}[{i}]") for i, x in enumerate(json_list(value, where, length))]


# ---------------------------------------------------------------- §2 the curve as given


class Curve:
    """A B-spline (degree, knots, points, weights) or a list of Bézier pieces (points, weights).

    Points are tuples of fractions; weights are None where left out.
    """

    def __init__(self, dimension, bspline=None, bezier=None):
        self.dimension, self.bspline, self.bezier = dimension, bspline, bezier
        if bspline:
            check_bspline(*bspline)
        else:
            check_bezier(bezier)


def check_bspline(degree, knots, points, weights):
    last = len(points) - 1
    if not 1 <= degree <= MAX_DEGREE:
        raise Reject(f"curve: expected a degree from 1 to {MAX_DEGREE}, found {degree}")
    if last < degree or len(knots) != last + degree + 2:
        raise Reject(f"curve: {len(points)} points and {len(knots)} knots do not fit degree {degree}")
    run, pieces = 1, 0
    for i, knot in enumerate(knots):
        if i and knot < knots[i - 1]:
            raise Reject(f"curve: knot {i} is smaller than the one before")
        run = run + 1 if i and knot == knots[i - 1] else 1
        inside = knots[degree] < knot < knots[last + 1]
        if run > degree + 1 or (inside and run > degree):
            raise Reject(f"curve: knot {i} has too high a multiplicity")
        pieces += degree <= i <= last and knot < knots[i + 1]
    if not knots[degree] < knots[last + 1]:
        raise Reject("curve: the parameter range is empty")
    if pieces > MAX_PIECES:
        raise Reject("curve: too many pieces")
    check_weights(weights, points)


def check_bezier(pieces):
    if not 1 <= len(pieces) <= MAX_PIECES:
        raise Reject(f"curve: expected 1 to {MAX_PIECES} pieces, found {len(pieces)}")
    for i, (points, weights) in enumerate(pieces):
        if not 2 <= len(points) <= MAX_DEGREE + 1:
            raise Reject(f"curve: piece {i}: expected a degree from 1 to {MAX_DEGREE}, found {len(points) - 1}")
        if i and pieces[i - 1][0][-1] != points[0]:
            raise Reject(f"curve: piece {i} does not begin where the one before ends")
        check_weights(weights, points)


def check_weights(weights, points):
    if weights is not None and (len(weights) != len(points) or min(weights) <= 0):
        raise Reject("curve: expected as many weights as points, all positive")


def curve_from_json(value):
    fields(value, "curve", (), ("bspline", "bezier"))
    if len(value) != 1:
        raise Reject("curve: expected one of 'bspline' and 'bezier'")

    def points_of(value, where, dimension):
        points = [tuple(fractions_of(p, f"{where}[{i}]")) for i, p in enumerate(json_list(value, where))]
        dimension = dimension or (len(points[0]) if points else 0)
        if dimension not in (2, 3) or any(len(p) != dimension for p in points):
            raise Reject(f"{where}: expected points of 2 or of 3 coordinates, all alike")
        return points, dimension

    def weights_of(value, where):
        return fractions_of(value["weights"], where + ".weights") if "weights" in value else None

    if "bspline" in value:
        spline = fields(value["bspline"], "curve.bspline", ("degree", "knots", "points"), ("weights",))
        degree = json_integer(spline["degree"], "curve.bspline.degree", 1, MAX_DEGREE)
        knots = fractions_of(spline["knots"], "curve.bspline.knots")
        points, dimension = points_of(spline["points"], "curve.bspline.points", 0)
        return Curve(dimension, bspline=(degree, knots, points, weights_of(spline, "curve.bspline")))
    pieces, dimension = [], 0
    bezier = fields(value["bezier"], "curve.bezier", ("pieces",))
    for i, piece in enumerate(json_list(bezier["pieces"], "curve.bezier.pieces")):
        where = f"curve.bezier.pieces[{i}]"
        fields(piece, where, ("points",), ("weights",))
        points, dimension = points_of(piece["points"], where + ".points", dimension)
        pieces.append((points, weights_of(piece, where)))
    return Curve(dimension, bezier=pieces)


# ---------------------------------------------------------------- §7 binary form and hash


def varint(number):
    if number < 128:
        return bytes((number,))
    digits = format(number, "b")
    digits = "0" * (-len(digits) % 7) + digits
    groups = [int(digits[i:i + 7], 2) for i in range(len(digits) - 7, -1, -7)]
    return bytes([g | 128 for g in groups[:-1]] + groups[-1:])


def encode_vector(numbers):
    q = math.lcm(*(x.denominator for x in numbers))
    out = [varint(q)]
    for x in numbers:
        n = x.numerator * (q // x.denominator)
        out.append(varint(2 * n if n >= 0 else -2 * n - 1))
    return b"".join(out)


def encode_curve(curve):
    def points_and_weights(points, weights):
        flat = encode_vector([x for p in points for x in p])
        return flat + (b"\0" if weights is None else b"\1" + encode_vector(weights))

    out = [bytes((curve.dimension, 0 if curve.bspline else 1))]
    if curve.bspline:
        degree, knots, points, weights = curve.bspline
        out += [varint(degree), varint(len(points)), encode_vector(knots), points_and_weights(points, weights)]
    else:
        out.append(varint(len(curve.bezier)))
        for points, weights in curve.bezier:
            out += [varint(len(points) - 1), points_and_weights(points, weights)]
    return b"".join(out)


class Reader:
    """Strict reading of the binary form; every shortage is a rejection."""

    def __init__(self, data):
        self.data, self.at = data, 0

    def left(self):
        return len(self.data) - self.at

    def take(self, count, what):
        if count > self.left():
            raise Reject(f"byte {self.at}: truncated: expected {count} bytes of {what}, found {self.left()}")
        self.at += count
        return self.data[self.at - count:self.at]

    def byte(self, what):
        return self.take(1, what)[0]

    def varint(self, what, bits=None):
        start = self.at
        value = self.byte(what)
        if value < 128:
            return value
        while self.byte(what) & 128:
            if bits is not None and 7 * (self.at - start) > bits + 7:
                raise Reject(f"byte {start}: {what}: expected at most {bits} bits")
        groups = self.data[start:self.at]
        if groups[-1] == 0:
            raise Reject(f"byte {start}: {what}: padded varint")
        return int("".join(format(g & 127, "07b") for g in reversed(groups)), 2)

    def signed(self, what, bits=None):
        value = self.varint(what, bits and bits + 1)
        number = -(value + 1) // 2 if value & 1 else value // 2
        return number if bits is None else bounded(number, bits, what)

    def count(self, what, low, high):
        value = self.varint(what, 64)
        if not low <= value <= high:
            raise Reject(f"{what}: expected {low} to {high}, found {value}")
        return value

    def vector(self, count, what):
        start = self.at
        q = self.varint(what)
        if count > self.left():
            raise Reject(f"byte {self.at}: truncated: expected {count} numbers of {what}")
        numerators = [self.signed(what) for _ in range(count)]
        if q == 0 or math.gcd(q, *numerators) != 1:
            raise Reject(f"byte {start}: {what}: the denominator is not the least common one")
        numbers = [Fraction(n, q) for n in numerators]
        for x in numbers:
            bounded(x.numerator, MAX_BITS, what)
            bounded(x.denominator, MAX_BITS, what)
        return numbers

    def curve(self):
        dimension, kind = self.byte("dimension"), self.byte("kind of curve")
        if dimension not in (2, 3) or kind > 1:
            raise Reject(f"curve block: dimension {dimension} or kind {kind} is unknown")

        def points_and_weights(count):
            flat = self.vector(count * dimension, "coordinates")
            flag = self.byte("weight flag")
            if flag > 1:
                raise Reject(f"curve block: expected weight flag 0 or 1, found {flag}")
            points = [tuple(flat[i:i + dimension]) for i in range(0, len(flat), dimension)]
            return points, self.vector(count, "weights") if flag else None

        if kind == 0:
            degree = self.count("degree", 1, MAX_DEGREE)
            count = self.count("number of points", degree + 1, self.left())
            knots = self.vector(count + degree + 1, "knots")
            return Curve(dimension, bspline=(degree, knots, *points_and_weights(count)))
        count = self.count("number of pieces", 1, MAX_PIECES)
        return Curve(dimension, bezier=[points_and_weights(self.count("degree", 1, MAX_DEGREE) + 1)
                                        for _ in range(count)])

    def tokens(self, dimension):
        short = {0x20: (1, 0), 0x21: (-1, 0), 0x22: (0, 1), 0x23: (0, -1)}
        plain = {0: "split", 1: "first", 2: "second"}
        long = {3: ("far", dimension), 4: ("not_normal", 2), 5: ("cone", dimension), 6: ("bend", 2)}
        while self.left():
            code = self.byte("token")
            if code in plain:
                yield plain[code], ()
            elif code in long:
                rule, count = long[code]
                yield rule, tuple(self.signed(rule, MAX_LEAF_BITS) for _ in range(count))
            elif 0x10 <= code < 0x10 + 2 * dimension:
                axis, negative = divmod(code - 0x10, 2)
                yield "far", tuple((-1 if negative else 1) * (i == axis) for i in range(dimension))
            elif code in short:
                yield "not_normal", short[code]
            else:
                raise Reject(f"byte {self.at - 1}: unknown token 0x{code:02x}")


def tokens_from_json(texts, dimension):
    counts = {"far": dimension, "cone": dimension, "not_normal": 2, "bend": 2}
    for number, text in enumerate(texts, 1):
        if not isinstance(text, str):
            raise Reject(f"token {number}: expected a string, found {clip(text)}")
        if text in ("split", "first", "second"):
            yield text, ()
            continue
        rule, *words = text.split(" ")
        if counts.get(rule) != len(words):
            raise Reject(f"token {number}: unknown token {clip(text)}")
        yield rule, tuple(parse_integer(w, f"token {number}", MAX_LEAF_BITS) for w in words)


# ---------------------------------------------------------------- vectors and Bernstein coefficients


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def difference(p, p_denominator, q, q_denominator):
    """A positive multiple of p − q."""
    return tuple(x * q_denominator - y * p_denominator for x, y in zip(p, q))


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


def affine(homogeneous):
    """The hull of homogeneous control points: affine points over one denominator."""
    w = math.lcm(*{h[3] for h in homogeneous})
    return [tuple([x * (w // h[3]) for x in h[:3]]) for h in homogeneous], w


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
        """c(u) as vector and denominator."""
        (x, y, z, w), = split_at(self.homogeneous, u.numerator, u.denominator)[0][-1:]
        return (x, y, z), w

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
        self.pieces = list(bspline_pieces(*curve.bspline) if curve.bspline else bezier_pieces(curve.bezier))
        self.size = len(self.pieces)
        x, x_den = self.pieces[0].point(Fraction(0))
        y, y_den = self.pieces[-1].point(Fraction(1))
        self.closed = not any(difference(x, x_den, y, y_den))

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


def lifted(points, weights):
    """Homogeneous control points as integers over one scale."""
    weights = weights or [Fraction(1)] * len(points)
    rows = [[w * x for x in (*p, Fraction(0))[:3]] + [w] for p, w in zip(points, weights)]
    scale = math.lcm(*(x.denominator for row in rows for x in row))
    return [tuple(x.numerator * (scale // x.denominator) for x in row) for row in rows], scale


def bezier_pieces(pieces):
    for index, (points, weights) in enumerate(pieces):
        yield Piece(*lifted(points, weights), index)


def bspline_pieces(p, knots, points, weights):
    index = 0
    for j in range(p, len(points)):
        if knots[j] == knots[j + 1]:
            continue
        start, scale = lifted(points[j - p:j + 1], weights and weights[j - p:j + 1])
        near = knots[j - p:j + p + 2]  # near[i + p - j] is knot i; only quotients of differences matter
        common = math.lcm(*(x.denominator for x in near))
        t = [x.numerator * (common // x.denominator) for x in near]
        factors = []  # the least common denominator of the λ of each round
        for r in range(1, p + 1):
            factors.append(math.lcm(*(t[i + 1 + p - r] - t[i] for i in range(r, p + 1))))
        control = []
        for k in range(p + 1):
            d = list(start)
            for r in range(1, p + 1):
                a = t[p] if r <= p - k else t[p + 1]
                for i in range(p, r - 1, -1):
                    f = factors[r - 1]
                    lam = (a - t[i]) * (f // (t[i + 1 + p - r] - t[i]))
                    d[i] = tuple((f - lam) * x + lam * y for x, y in zip(d[i - 1], d[i]))
            control.append(d[p])
        yield Piece(control, scale * math.prod(factors), index)
        index += 1


# ---------------------------------------------------------------- §5 nodes


class Node:
    """A part, a point element or a run.  `start` and `end` are parameters times 2^120.

    `at_start`, `at_finish`: it contains the end at 0, at M, of an open curve (convention critical).
    hull(), tangents(), moving() are H, T, X of FORMAT.md, computed once.
    """

    is_point = False
    at_start = at_finish = False

    def __init__(self, start, end):
        self.start, self.end = start, end
        self.cache = {}

    def once(self, key, make):
        if key not in self.cache:
            self.cache[key] = make()
        return self.cache[key]

    def hull(self):
        return self.once("H", self.make_hull)

    def tangents(self):
        return self.once("T", self.make_tangents)

    def moving(self):
        return self.tangents()

    def children(self):
        return self.once("children", self.make_children)

    def box(self, grid):
        """Smallest box on the grid: lower and upper corner, as integers over 2^grid."""
        def make():
            points, w = self.hull()
            return ([min((p[a] << grid) // w for p in points) for a in range(3)],
                    [max(-(-(p[a] << grid) // w) for p in points) for a in range(3)])
        return self.once("box", make)

    def __str__(self):
        ends = [str(Fraction(x, 1 << MAX_DEPTH)) for x in (self.start, self.end)]
        return "{%s}" % ends[0] if self.is_point else "[%s, %s]" % tuple(ends)


class Part(Node):
    def __init__(self, index, j, e, homogeneous, d, d_den):
        unit = 1 << (MAX_DEPTH - e)
        super().__init__((index << MAX_DEPTH) + j * unit, (index << MAX_DEPTH) + (j + 1) * unit)
        self.index, self.j, self.e = index, j, e
        self.homogeneous, self.d, self.d_den = homogeneous, d, d_den

    def make_hull(self):
        return affine(self.homogeneous)

    def make_tangents(self):
        return [([v for v in self.d if any(v)], self.d_den)]

    def make_children(self):
        if self.e == MAX_DEPTH:
            raise Reject(f"a part of depth {MAX_DEPTH} is not split")
        denominator = self.d_den << (len(self.d) - 1)
        halves = zip(split_at(self.homogeneous, 1, 2), split_at(self.d, 1, 2))
        return [Part(self.index, 2 * self.j + side, self.e + 1, reduced(h)[0], *reduced(d, denominator))
                for side, (h, d) in enumerate(halves)]


class Point(Node):
    is_point = True

    def __init__(self, parameter, place, directions):
        super().__init__(parameter << MAX_DEPTH, parameter << MAX_DEPTH)
        self.place, self.directions = place, directions

    def make_hull(self):
        return [self.place[0]], self.place[1]

    def make_tangents(self):
        return [([v], den) for v, den in self.directions]

    def moving(self):
        return []

    def make_children(self):
        raise Reject("a point element is not split")


class Run(Node):
    def __init__(self, cover, a, b):
        super().__init__(cover.elements[a].start, cover.elements[b - 1].end)
        self.cover, self.a, self.b = cover, a, b
        self.at_start = cover.elements[a].at_start
        self.at_finish = cover.elements[b - 1].at_finish

    def make_children(self):
        middle = (self.a + self.b) // 2
        return [self.cover.node(self.a, middle), self.cover.node(middle, self.b)]

    def box(self, grid):
        def make():
            (low, high), (low2, high2) = (child.box(grid) for child in self.children())
            return [min(x) for x in zip(low, low2)], [max(x) for x in zip(high, high2)]
        return self.once("box", make)

    def make_hull(self):
        low, high = self.box(self.cover.grid)
        corners = {(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])}
        return sorted(corners), 1 << self.cover.grid

    def make_tangents(self):
        return [group for e in self.cover.elements[self.a:self.b] for group in e.tangents()]

    def moving(self):
        return [group for e in self.cover.elements[self.a:self.b] for group in e.moving()]


class Cover:
    """The elements of the curve, and the replay of the cover tree."""

    def __init__(self, chain, critical, grid, lower):
        self.chain, self.grid, self.lower = chain, grid, lower
        self.elements, last = [], chain.size
        for i, piece in enumerate(chain.pieces):
            if critical and i == 0 and not chain.closed:
                self.point(0, [(piece.outgoing, piece.d_den)]).at_start = True
            elif critical and chain.is_corner(Fraction(i)):
                self.point(i, chain.directions(i))
            self.elements.append(Part(i, 0, 0, piece.homogeneous, piece.d, piece.d_den))
        if critical and not chain.closed:
            piece = chain.pieces[-1]
            self.point(last, [(piece.incoming, piece.d_den)]).at_finish = True

    def point(self, s, directions):
        place = self.chain.locate(Fraction(s), "after" if s < self.chain.size else "before", "")
        self.elements.append(Point(s, place[0].point(place[1]), directions))
        return self.elements[-1]

    def node(self, a, b):
        return self.elements[a] if b - a == 1 else Run(self, a, b)

    def adjacent(self, a, b):
        forward = a.end == b.start
        return forward or (self.chain.closed and a.start == 0 and b.end == self.chain.size << MAX_DEPTH)

    def replay(self, tokens):
        """Check every token; return their number."""
        whole = self.node(0, len(self.elements))
        stack, number = [(whole, whole)], 0
        for rule, integers in tokens:
            number += 1
            if not stack:
                raise Reject(f"token {number}: expected the end of the tree, found '{rule}'")
            a, b = stack.pop()
            try:
                stack.extend(self.step(a, b, rule, integers))
            except Reject as error:
                words = " ".join([rule, *(show(n) for n in integers)])
                raise Reject(f"token {number}, pair {a} x {b}, rule '{words}': {error}") from None
            while stack and stack[-1][0] is stack[-1][1] and stack[-1][0].is_point:
                stack.pop()
        if stack:
            a, b = stack[-1]
            raise Reject(f"token {number + 1}, pair {a} x {b}: expected a token, found the end of the tree")
        return number

    def step(self, a, b, rule, integers):
        """The pairs that follow, the last one first; a leaf has none."""
        if rule in ("split", "first", "second"):
            if (rule == "split") != (a is b):
                raise Reject("this token is not for such a pair")
            if rule == "first":
                return [(child, b) for child in reversed(a.children())]
            if rule == "second":
                return [(a, child) for child in reversed(b.children())]
            one, two = a.children()
            return [(two, two), (one, two), (one, one)]
        if not any(integers):
            raise Reject("expected integers not all zero")
        if rule in ("far", "cone"):
            normal = (*integers, 0)[:3]
            self.far(a, b, normal) if rule == "far" else self.cone(a, b, normal)
        else:
            self.not_normal(a, b, *integers) if rule == "not_normal" else self.bend(a, b, *integers)
        return []

    def far(self, a, b, n):
        if self.lower is None:
            raise Reject("expected no 'far' under lower_squared \"inf\"")
        (points_a, w_a), (points_b, w_b) = a.hull(), b.hull()
        gap = min(dot(n, p) for p in points_a) * w_b - max(dot(n, q) for q in points_b) * w_a
        scale = w_a * w_b
        if gap <= 0:
            raise Reject(f"expected g > 0, found g = {show(Fraction(gap, scale))}")
        if gap * gap * self.lower.denominator < self.lower.numerator * dot(n, n) * scale * scale:
            found = Fraction(gap * gap, scale * scale * dot(n, n))
            raise Reject(f"expected g²/(n·n) ≥ {show(self.lower)}, found {show(found)}")

    def not_normal(self, a, b, alpha, beta):
        if a is b:
            raise Reject("expected two different nodes")
        for name, node, factor in (("α", a, alpha), ("β", b, beta)):
            if (node.at_start or node.at_finish) and factor > 0:
                raise Reject(f"expected {name} ≤ 0 at an end of the curve, found {show(factor)}")
        (points_a, w_a), (points_b, w_b) = a.hull(), b.hull()
        tangents_a, tangents_b = a.tangents(), b.tangents()
        points_a = [tuple([x * w_b for x in p]) for p in points_a]
        points_b = [tuple([x * w_a for x in q]) for q in points_b]
        for i, p in enumerate(points_a):
            for k, q in enumerate(points_b):
                chord = (p[0] - q[0], p[1] - q[1], p[2] - q[2])
                if not combination_positive(chord, tangents_a, alpha, tangents_b, beta):
                    raise Reject(f"expected (p−q)·(αv+βw) > 0, found a value ≤ 0 at hull points {i} and {k}")

    def neighbours(self, a, b):
        if a is not b and not self.adjacent(a, b):
            raise Reject("expected equal or adjacent nodes")

    def cone(self, a, b, n):
        self.neighbours(a, b)
        nn = dot(n, n)
        for group, _ in a.tangents() + (b.tangents() if a is not b else []):
            for v in group:
                vn = dot(v, n)
                if vn <= 0 or 2 * vn * vn <= dot(v, v) * nn:
                    raise Reject("expected all tangents within 45° of n, found one that is not")

    def bend(self, a, b, alpha, beta):
        self.neighbours(a, b)
        for name, present, factor in (("α", a.at_start, alpha), ("β", b.at_finish, beta)):
            if present and factor < 0:
                raise Reject(f"expected {name} ≥ 0 at an end of the curve, found {show(factor)}")
        tangents_a, tangents_b = a.tangents(), b.tangents()
        for group, _ in a.moving() + (b.moving() if a is not b else []):
            for x in group:
                if not combination_positive(x, tangents_a, alpha, tangents_b, beta):
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
    """[s0, s1] with its sections: (piece, u0, u1), and the homogeneous points and D on each."""

    def __init__(self, chain, value, where):
        self.start, self.end = fractions_of(value, where, 2)
        s0, s1, size = self.start, self.end, chain.size
        if not 0 <= s0 < s1 <= s0 + 1 or s0 >= size or (s1 > size and not chain.closed):
            raise Reject(f"{where}: expected 0 ≤ s₀ < s₁ ≤ s₀ + 1 on the curve, found {show(s0)}, {show(s1)}")
        self.chain, self.where = chain, where
        inside = math.floor(s0) + 1
        self.joint = inside % size if inside < s1 else None  # the integer strictly inside
        cuts = [s0, s1] if self.joint is None else [s0, Fraction(inside), s1]
        self.sections = []
        for a, b in zip(cuts, cuts[1:]):
            i = math.floor(a)
            self.sections.append((chain.pieces[i % size], a - i, b - i))
        whole = [piece.restricted(u0, u1) for piece, u0, u1 in self.sections]
        self.hulls = [affine(h) for h, _ in whole]
        self.tangents = [d for _, d in whole]
        (points, w), (points1, w1) = self.hulls[0], self.hulls[-1]
        self.ends = (points[0], w), (points1[-1], w1)
        (d, den), (d1, den1) = self.tangents[0], self.tangents[-1]
        self.end_tangents = ([d[0]], den), ([d1[-1]], den1)

    def require_smooth(self):
        if self.joint is not None and self.chain.is_corner(Fraction(self.joint)):
            raise Reject(f"{self.where}: the joint {self.joint} inside is a corner")

    def require_regular(self, m):
        if any(dot(m, v) <= 0 for d, _ in self.tangents for v in d):
            raise Reject(f"{self.where}: expected m·v > 0 for all tangents, found a value ≤ 0")

    def subsections(self, count):
        """(hull, tangents) of the equal sub-sections of every section."""
        for piece, u0, u1 in self.sections:
            step = (u1 - u0) / count
            for i in range(count):
                h, d = piece.restricted(u0 + step * i, u0 + step * (i + 1))
                yield affine(h), d


def apart(i, j):
    if not i.end < j.start or (i.chain.closed and not j.end < i.start + i.chain.size):
        raise Reject(f"upper: expected disjoint intervals in order, found [{show(i.start)}, {show(i.end)}] "
                     f"and [{show(j.start)}, {show(j.end)}]")


def vector_of(value, where, dimension):
    return (*integers_of(value, where, dimension), 0)[:3]


def require_short(hulls_a, hulls_b, upper):
    for points_a, w_a in hulls_a:
        for points_b, w_b in hulls_b:
            for p in points_a:
                for q in points_b:
                    x = difference(p, w_a, q, w_b)
                    found = dot(x, x)
                    if found * upper.denominator > upper.numerator * (w_a * w_b) ** 2:
                        found = Fraction(found, (w_a * w_b) ** 2)
                        raise Reject(f"upper: expected squared lengths ≤ {show(upper)}, found {show(found)}")


def parameter(chain, value, where):
    s = parse_fraction(value, where)
    if not 0 <= s <= chain.size or (chain.closed and s == chain.size):
        raise Reject(f"{where}: expected a parameter of the curve, found {show(s)}")
    return s


def ordered_parameters(chain, rule):
    s, t = parameter(chain, rule["s"], "upper.s"), parameter(chain, rule["t"], "upper.t")
    if not s < t:
        raise Reject(f"upper: expected s < t, found {show(s)} and {show(t)}")
    return s, t


def place(chain, s):
    piece, u = chain.locate(s, "before" if s == chain.size else "after", "upper")
    return piece.point(u)


def edge_sign(interval, other, factor_own, factor_other, m, sign_of_chord, name):
    """Obligations 4 and 5 of `miranda`: the sign on the two edges given by the ends of `interval`."""
    for hull, tangents in other.subsections(m):
        points, w = hull
        for side, sign in ((0, -1), (1, 1)):
            end, end_w = interval.ends[side]
            own = [interval.end_tangents[side]]
            for q in points:
                x = difference(end, end_w, q, w)
                x = tuple(sign * sign_of_chord * c for c in x)
                if not combination_positive(x, own, factor_own, [tangents], factor_other):
                    raise Reject(f"upper, rule 'miranda': expected a value {'<>'[side]} 0 on the edge "
                                 f"{name} = {show((interval.start, interval.end)[side])}, found another sign")


def check_miranda(chain, rule, upper):
    i, j = Interval(chain, rule["s"], "upper.s"), Interval(chain, rule["t"], "upper.t")
    apart(i, j)
    m = json_integer(rule["subdivisions"], "upper.subdivisions", 1, 1024)
    alpha1, beta1 = integers_of(rule["first"], "upper.first", 2)
    alpha2, beta2 = integers_of(rule["second"], "upper.second", 2)
    regular = json_list(rule["regular"], "upper.regular", 2)
    for k, interval in enumerate((i, j)):
        interval.require_smooth()
        interval.require_regular(vector_of(regular[k], f"upper.regular[{k}]", chain.dimension))
    if alpha1 * beta2 == alpha2 * beta1:
        raise Reject("upper, rule 'miranda': expected α₁β₂ ≠ α₂β₁, found equality")
    edge_sign(i, j, alpha1, beta1, m, 1, "s")
    edge_sign(j, i, beta2, alpha2, m, -1, "t")
    require_short(i.hulls, j.hulls, upper)


def check_root(chain, rule, upper):
    s, t = ordered_parameters(chain, rule)
    located = []
    for value, name in ((s, "s"), (t, "t")):
        side = json_string(rule[name + "_side"], f"upper.{name}_side", ("after", "before"))
        if value.denominator != 1 and side != "after":
            raise Reject(f"upper.{name}_side: expected 'after' at a parameter that is no integer")
        located.append(chain.locate(value, side, f"upper.{name}_side"))
    (p, p_w), (q, q_w) = (piece.point(u) for piece, u in located)
    x = difference(p, p_w, q, q_w)
    for (piece, u), name in zip(located, "st"):
        if dot(x, piece.direction(u, f"upper.{name}")):
            raise Reject(f"upper, rule 'root': the chord is not orthogonal to the direction at {name}")
    require_short([([p], p_w)], [([q], q_w)], upper)


def check_touch(chain, rule, _upper):
    s, t = ordered_parameters(chain, rule)
    if any(difference(*place(chain, s), *place(chain, t))):
        raise Reject(f"upper, rule 'touch': the points at {show(s)} and {show(t)} differ")


def check_crossing(chain, rule, _upper):
    if chain.dimension != 2:
        raise Reject("upper, rule 'crossing': only for curves in the plane")
    i, j = Interval(chain, rule["s"], "upper.s"), Interval(chain, rule["t"], "upper.t")
    apart(i, j)
    n1, n2 = (vector_of(rule[name], "upper." + name, 2) for name in ("first", "second"))
    if not any(cross(n1, n2)):
        raise Reject("upper, rule 'crossing': the two vectors are linearly dependent")
    for own, other, n, orientation, name in ((i, j, n1, 1, "s"), (j, i, n2, -1, "t")):
        for side, sign in ((0, -1), (1, 1)):
            end, end_w = own.ends[side]
            for points, w in other.hulls:
                for q in points:
                    if sign * orientation * dot(n, difference(end, end_w, q, w)) <= 0:
                        raise Reject(f"upper, rule 'crossing': expected a value {'<>'[side]} 0 on the edge "
                                     f"{name} = {show((own.start, own.end)[side])}, found another sign")


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
    s, t = ordered_parameters(chain, rule)
    (p, p_w), (q, q_w) = place(chain, s), place(chain, t)
    if not is_critical(chain, s, difference(q, q_w, p, p_w)):
        raise Reject(f"upper, rule 'critical_root': the chord is not critical at s = {show(s)}")
    if not is_critical(chain, t, difference(p, p_w, q, q_w)):
        raise Reject(f"upper, rule 'critical_root': the chord is not critical at t = {show(t)}")
    require_short([([p], p_w)], [([q], q_w)], upper)


def check_critical_interval(chain, rule, upper):
    s = parameter(chain, rule["s"], "upper.s")
    is_end = not chain.closed and s in (0, chain.size)
    if not is_end and not chain.is_corner(s):
        raise Reject(f"upper.s: expected the parameter of a corner or an end, found {show(s)}")
    j = Interval(chain, rule["t"], "upper.t")
    if j.start <= s <= j.end or (chain.closed and j.start <= s + chain.size <= j.end):
        raise Reject("upper.t: the interval contains s")
    j.require_smooth()
    j.require_regular(vector_of(rule["regular"], "upper.regular", chain.dimension))
    e, e_w = place(chain, s)
    chords = [difference(q, w, e, e_w) for points, w in j.hulls for q in points]
    if is_end:
        critical = all(is_critical(chain, s, x) for x in chords)
    else:
        (a, _), (b, _) = chain.directions(int(s))
        critical = any(all(sign * dot(x, a) >= 0 >= sign * dot(x, b) for x in chords) for sign in (1, -1))
    if not critical:
        raise Reject("upper, rule 'critical_interval': not every chord is seen to be critical at s")
    signs = []
    for (point, w), (d, _) in zip(j.ends, j.end_tangents):
        signs.append(dot(difference(point, w, e, e_w), d[0]))
    if not (min(signs) < 0 < max(signs)):
        raise Reject("upper, rule 'critical_interval': expected opposite signs at the ends of the interval")
    require_short([([e], e_w)], j.hulls, upper)


UPPER_RULES = {
    "miranda": (check_miranda, ("rule", "s", "t", "first", "second", "regular", "subdivisions"), False),
    "root": (check_root, ("rule", "s", "s_side", "t", "t_side"), False),
    "touch": (check_touch, ("rule", "s", "t"), False),
    "crossing": (check_crossing, ("rule", "s", "t", "first", "second"), False),
    "critical_root": (check_critical_root, ("rule", "s", "t"), True),
    "critical_interval": (check_critical_interval, ("rule", "s", "t", "regular"), True),
}


def check_upper(chain, rule, upper, critical):
    if not isinstance(rule, dict) or rule.get("rule") not in list(UPPER_RULES):
        raise Reject(f"evidence.upper: expected one of the rules of the format, found {clip(rule)}")
    check, names, critical_only = UPPER_RULES[rule["rule"]]
    fields(rule, "evidence.upper", names)
    if critical_only and not critical:
        raise Reject(f"evidence.upper: the rule '{rule['rule']}' is only for the convention 'critical'")
    check(chain, rule, upper)


# ---------------------------------------------------------------- §4 the certificate


def check_certificate(data, wanted_hash=None):
    """The statement of an accepted certificate, with `tokens` added; raises Reject otherwise."""
    if data[:8] == MAGIC:
        reader = Reader(data)
        reader.take(8, "magic")
        length = int.from_bytes(reader.take(4, "header length"), "little")
        if length > MAX_HEADER:
            raise Reject(f"header: expected at most {MAX_HEADER} bytes, found {length}")
        document = parse_json(reader.take(length, "header"), "header")
    elif len(data) > MAX_JSON_BYTES:
        raise Reject(f"expected at most {MAX_JSON_BYTES} bytes of JSON, found {len(data)}")
    else:
        reader, document = None, parse_json(data, "certificate")

    fields(document, "certificate", ("knotproof", "tool", "curve", "curve_sha256", "statement", "evidence"),
           ("name", "snapped_joints"))
    json_string(document["knotproof"], "knotproof", ("certificate/1",))
    json_string(document["tool"], "tool")
    json_string(document.get("name", ""), "name")
    json_integer(document.get("snapped_joints", 0), "snapped_joints", 0)
    evidence = fields(document["evidence"], "evidence", ("grid", "tree", "upper"))
    grid = json_integer(evidence["grid"], "evidence.grid", 0, MAX_GRID)
    tree = evidence["tree"]

    if reader:
        json_string(document["curve"], "curve", ("binary",))
        begin = reader.at
        curve = reader.curve()
        block = reader.data[begin:reader.at]
        if tree is not None:
            json_string(tree, "evidence.tree", ("binary",))
            tokens = reader.tokens(curve.dimension)
        elif reader.left():
            raise Reject(f"byte {reader.at}: {reader.left()} bytes are left over")
    else:
        curve = curve_from_json(document["curve"])
        block = encode_curve(curve)
        if tree is not None:
            tokens = tokens_from_json(json_list(tree, "evidence.tree"), curve.dimension)
    found_hash = hashlib.sha256(block).hexdigest()
    if not HASH.fullmatch(json_string(document["curve_sha256"], "curve_sha256")):
        raise Reject("curve_sha256: expected 64 lower-case hexadecimal digits")
    if document["curve_sha256"] != found_hash:
        raise Reject(f"curve_sha256: expected {found_hash}, found {document['curve_sha256']}")
    if wanted_hash is not None and wanted_hash != found_hash:
        raise Reject(f"the certificate is about another curve: expected {wanted_hash}, found {found_hash}")

    statement = fields(document["statement"], "statement", ("claim", "convention", "lower_squared", "upper_squared"))
    json_string(statement["claim"], "statement.claim", ("msd",))
    critical = json_string(statement["convention"], "statement.convention", ("smooth", "critical")) == "critical"
    lower, upper = None, None
    if statement["lower_squared"] != "inf":
        lower = parse_fraction(statement["lower_squared"], "statement.lower_squared")
    if statement["upper_squared"] is not None:
        upper = parse_fraction(statement["upper_squared"], "statement.upper_squared")
        if lower is None or lower > upper:
            raise Reject("statement: expected lower_squared ≤ upper_squared, found the contrary")
    if min(x for x in (lower, upper, 0) if x is not None) < 0:
        raise Reject("statement: expected bounds ≥ 0, found a negative one")
    if (tree is None) != (lower == 0):
        raise Reject("evidence.tree: expected null when and only when lower_squared is \"0\"")
    if (evidence["upper"] is None) != (upper is None):
        raise Reject("evidence.upper: expected null when and only when upper_squared is null")

    chain = Chain(curve)
    count = 0
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
            data = stream.read()
    except OSError as error:
        return "unreadable", {"reason": str(error)}
    try:
        return "accepted", {"statement": check_certificate(data, wanted_hash)}
    except Reject as error:
        return "rejected", {"reason": str(error)}
    except (MemoryError, RecursionError, OverflowError) as error:
        return "rejected", {"reason": f"the limits of this machine do not suffice: {error!r}"}


def hash_argument(text):
    if not HASH.fullmatch(text):
        raise argparse.ArgumentTypeError("expected 64 lower-case hexadecimal digits")
    return text


def main(arguments=None):
    parser = argparse.ArgumentParser(description="Check knotproof certificates (JSON or binary form).",
                                     epilog="Exit code: 0 all accepted, 1 any rejected, 2 unreadable file or usage.",
                                     allow_abbrev=False)
    parser.add_argument("files", nargs="+", metavar="CERT")
    parser.add_argument("--curve-sha256", metavar="HEX", type=hash_argument, help="the curve it must be about")
    parser.add_argument("--json", action="store_true", help="print one JSON object for each file")
    parser.add_argument("--quiet", action="store_true", help="print nothing; the exit code tells")
    options = parser.parse_args(arguments)
    if hasattr(sys.stdout, "reconfigure"):
        sys.stdout.reconfigure(encoding="utf-8", errors="backslashreplace")
    verdicts = set()
    for path in options.files:
        verdict, report = examine(path, options.curve_sha256)
        verdicts.add(verdict)
        if options.quiet:
            continue
        if options.json:
            print(json.dumps({"file": path, "verdict": verdict, **report}))
        else:
            text = sentence(report["statement"]) if verdict == "accepted" else report["reason"]
            print(f"{verdict}: {path}: {text}")
    return 1 if "rejected" in verdicts else 2 if "unreadable" in verdicts else 0


if __name__ == "__main__":
    sys.exit(main())
