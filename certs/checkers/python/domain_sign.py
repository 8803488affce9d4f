"""The claim `domain`: the moving curve, its sign function, sections, rows, positivity by halving (FORMAT.md §9).

A function affine in the position x is a tuple of integers (A_1, …, A_d, b) over some scale and means (A·x + b)/scale.
A position is an `At`: integers over a common denominator.
"""

import math
from fractions import Fraction
from typing import NamedTuple

from curve import split_at
from document import expect, require

MAX_HALVINGS = 60
MAX_PARTS = 4_096


class At(NamedTuple):
    """The position numerators/denominator."""

    numerators: tuple
    denominator: int


def at(x):
    """The position with these fractions."""
    q = math.lcm(*(c.denominator for c in x))
    return At(tuple([c.numerator * (q // c.denominator) for c in x]), q)


# ---------------------------------------------------------------- the moving curve


def moving_pieces(chain, listed):
    """For each piece its control points as integers (w, C_1, …, C_d, α), and their scale."""
    d, source = chain.dimension, chain.source
    count = sum(len(points) for points, _ in source.lists)
    rising = bool(listed) and all(i < j for i, j in zip(listed, listed[1:])) and listed[-1] < count
    expect(rising, "statement.points", f"indices below {count}, at least one, in increasing order", listed)
    wanted, lists, begin = set(listed), [], 0
    for points, scale in source.lists:
        if begin > 0 and source.knots is None:
            both = (begin - 1 in wanted) == (begin in wanted)
            expect(both, "statement.points", f"both or none of the indices {begin - 1}, {begin} of a joint", listed)
        lists.append(([(p[3], *[0] * d, p[3]) if k in wanted else (p[3], *p[:d], 0)
                       for k, p in enumerate(points, begin)], scale))
        begin += len(points)
    return list(source.pieces(lists))


def is_polynomial(points):
    return all(p[0] == points[0][0] for p in points)


def differences(row):
    return [tuple([y - x for x, y in zip(p, q)]) for p, q in zip(row, row[1:])]


# ---------------------------------------------------------------- polynomials in Bernstein form
#
# *Scaled* coefficients contain the binomials: the polynomial is Σ s_k u^k (1−u)^(n−k); their product is a convolution.


def product(p, q):
    out = [0] * (len(p) + len(q) - 1)
    for i, x in enumerate(p):
        if x:
            for k, y in enumerate(q, i):
                out[k] += x * y
    return out


def determinant(rows, columns=None):
    """The determinant of a square matrix of polynomials, all of one degree, along its first row."""
    columns = range(len(rows)) if columns is None else columns
    if len(columns) == 1:
        return rows[0][columns[0]]
    terms = [(product(rows[0][c], determinant(rows[1:], [*columns[:i], *columns[i + 1:]])), i)
             for i, c in enumerate(columns)]
    return [sum([-x if i % 2 else x for x, (_, i) in zip(xs, terms)]) for xs in zip(*(term for term, _ in terms))]


def unscaled(scaled):
    """Bernstein coefficients, all multiplied by the factor that is given back too."""
    n = len(scaled) - 1
    factor = math.lcm(*(math.comb(n, k) for k in range(n + 1)))
    quotients = [factor // math.comb(n, k) for k in range(n + 1)]
    return [tuple([f * x for x in s]) for f, s in zip(quotients, scaled)], factor


def sign_function(points, scale, d, sign):
    """The scaled coefficients of h, each a function affine in x, and the scale of all."""
    if is_polynomial(points):
        q = [p[1:] for p in differences(points)]  # (ΔC, Δα)
        m, alpha = d, d
    else:
        q, m, alpha = points, d + 1, d + 1
    e = len(points) - 1 - d
    if e < 0:
        return [(0,) * (d + 1)], 1
    binomials = [math.comb(e, i) for i in range(e + 1)]
    # b[r][j]: the polynomial that is entry number r of column number j
    b = [[[f * q[i + j][r] for i, f in enumerate(binomials)] for j in range(m)] for r in range(alpha + 1)]
    moves, zero = any(p[-1] for p in points), [0] * (m * e + 1)
    parts = [determinant([b[alpha] if r == a else b[r] for r in range(m)]) if moves else zero for a in range(m - d, m)]
    parts.append(determinant(b[:m]))
    return [tuple([sign * x for x in xs]) for xs in zip(*parts)], scale ** m


def halves(c):
    """The coefficients on both halves, multiplied by 2^degree."""
    left, right, row = [], [], c
    for k in range(len(c) - 1, -1, -1):
        left.append(row[0] << k)
        right.append(row[-1] << k)
        row = [x + y for x, y in zip(row, row[1:])]
    return left, right[::-1]


def require_by_halving(coefficients, strict, where):
    """Positive (strict) or non-negative by halving."""
    least = 1 if strict else 0  # the coefficients are integers
    todo, count = [(coefficients, 0)], 0
    while todo:
        c, depth = todo.pop()
        count += 1
        if min(c) >= least:
            continue
        wish = "positive" if strict else "non-negative"
        require(c[0] >= least and c[-1] >= least, f"{where}: the polynomial is not {wish}")
        require(depth < MAX_HALVINGS, f"{where}: not seen to be {wish} after {MAX_HALVINGS} halvings of a part")
        todo += [(half, depth + 1) for half in halves(c)]
        require(count + len(todo) <= MAX_PARTS, f"{where}: not seen to be {wish} in {MAX_PARTS} parts")


# ---------------------------------------------------------------- sections and rows


def without_leading_zeros(g, scale):
    """g without the factor u^z, z the number of leading coefficients that vanish."""
    n, z = len(g) - 1, next((k for k, c in enumerate(g) if any(c)), 0)
    if z == 0:
        return g, scale
    factor = math.lcm(*(math.comb(n - z, k) for k in range(n - z + 1)))
    factors = [math.comb(n, k + z) * (factor // math.comb(n - z, k)) for k in range(n - z + 1)]
    return [tuple([f * x for x in c]) for f, c in zip(factors, g[z:])], scale * factor


class Section:
    """One piece of the interval: [u0, u1] of piece number i; `open` says which ends are open ends of the interval."""

    def __init__(self, piece, i, u0, u1, ends, sign, d):
        self.i, self.u0, self.u1, self.open = i, u0, u1, ends
        self.h, self.h_scale = sign_function(*piece, d, sign)  # scaled
        g, factor = unscaled(self.h)
        n = len(g) - 1
        g = split_at(split_at(g, u1)[0], u0 / u1)[1]
        scale = self.h_scale * factor * u1.denominator ** n * (u0 / u1).denominator ** n
        if ends[0]:
            g, scale = without_leading_zeros(g, scale)
        if ends[1]:
            g, scale = without_leading_zeros(g[::-1], scale)
            g = g[::-1]
        common = math.gcd(scale, *(x for c in g for x in c))
        self.g, self.scale = [tuple([x // common for x in c]) for c in g], scale // common
        self.moves = any(any(c[:-1]) for c in self.g)

    def values(self, x):
        """A positive multiple of the coefficients of g(·; x)."""
        if len(x.numerators) == 2:
            (x1, x2), x0 = x
            return [a1 * x1 + a2 * x2 + b * x0 for a1, a2, b in self.g]
        (x1, x2, x3), x0 = x
        return [a1 * x1 + a2 * x2 + a3 * x3 + b * x0 for a1, a2, a3, b in self.g]

    def row_at(self, u):
        """The row at u, and its scale."""
        for is_open, end, g in zip(self.open, (self.u0, self.u1), (self.g[0], self.g[-1])):
            if is_open and u == end:
                return Row(g[:-1], g[-1], self.scale, False)
        n, a, r = len(self.h) - 1, u.numerator, u.denominator
        powers = [a ** k * (r - a) ** (n - k) for k in range(n + 1)]
        *linear, constant = [sum([p * x for p, x in zip(powers, xs)]) for xs in zip(*self.h)]
        return Row(tuple(linear), constant, self.h_scale * r ** n, True)

    def require_margin(self, x, squared, where):
        """g(·; x)² − squared·|A(·)|² is non-negative by halving."""
        n, q = len(self.g) - 1, x.denominator
        columns = [self.values(x), *([q * y for y in column] for column in list(zip(*self.g))[:-1])]
        factors = [squared.denominator] + [-squared.numerator] * (len(columns) - 1)
        scaled = [[math.comb(n, k) * y for k, y in enumerate(column)] for column in columns]
        squares = [[f * y for y in product(column, column)] for f, column in zip(factors, scaled)]
        coefficients, _ = unscaled([(sum(ys),) for ys in zip(*squares)])
        require_by_halving([c for c, in coefficients], False, where)


class Row(NamedTuple):
    """The function (linear·x + constant)/scale, scale > 0."""

    linear: tuple
    constant: int
    scale: int
    strict: bool

    def sign_at(self, x):
        """A positive multiple of the value."""
        return sum([a * c for a, c in zip(self.linear, x.numerators)]) + self.constant * x.denominator

    def value(self, x):
        return Fraction(self.sign_at(x), self.scale * x.denominator)

    def gradient(self):
        return [Fraction(a, self.scale) for a in self.linear]

    def constant_term(self):
        return Fraction(self.constant, self.scale)


class Domain:
    """K and B of a statement."""

    def __init__(self, chain, statement):
        self.dimension = d = chain.dimension
        (a, b), self.low, self.high = statement["interval"], *statement["box"]
        expect(len(self.low) == len(self.high) == d, "statement.box", f"two positions of {d} coordinates", self.low)
        expect(all(x < y for x, y in zip(self.low, self.high)), "statement.box", "low < high on each axis", self.high)
        expect(0 <= a < b <= chain.size, "statement.interval", f"0 ≤ a < b ≤ {chain.size}", a, b)
        self.pieces, self.lengths = moving_pieces(chain, statement["points"]), chain.source.lengths()
        first, last = math.floor(a), math.ceil(b) - 1
        start_open, end_open = statement["open"]
        self.sections = {i: Section(self.pieces[i], i, Fraction(max(a - i, 0)), Fraction(min(b - i, 1)),
                                    (start_open and i == first, end_open and i == last),
                                    1 if statement["sign"] == "+" else -1, d) for i in range(first, last + 1)}

    def require_in_box(self, x, where):
        q = x.denominator
        inside = all(low.numerator * q <= c * low.denominator and c * high.denominator <= high.numerator * q
                     for low, c, high in zip(self.low, x.numerators, self.high))
        require(inside, f"{where}: expected a point of the box")

    def require_in_k(self, x, where):
        for section in self.sections.values():
            require_by_halving(section.values(x), True, f"{where}: not shown in K, piece {section.i}")

    def require_in_closure(self, x, where):
        """Shown in cl K.  Sections that do not depend on x are not looked at: some point is shown in K already."""
        for section in self.sections.values():
            if section.moves:
                require_by_halving(section.values(x), False, f"{where}: not shown in cl K, piece {section.i}")

    def require_margin(self, x, squared, where):
        for section in self.sections.values():
            section.require_margin(x, squared, f"{where}: not shown so far from the end of K, piece {section.i}")

    def row(self, value, where):
        """The row that a record names."""
        if "piece" in value:
            section, u = self.sections.get(value["piece"]), value["u"]
            expect(section and section.u0 <= u <= section.u1, where, "a parameter of a section", value["piece"], u)
            return section.row_at(u)
        axis, sign = value["axis"], 1 if value["side"] == "low" else -1
        expect(axis < self.dimension, where, f"an axis below {self.dimension}", axis)
        bound = (self.low if sign > 0 else self.high)[axis]
        linear = tuple([sign * bound.denominator * (a == axis) for a in range(self.dimension)])
        return Row(linear, -sign * bound.numerator, bound.denominator, False)
