"""The claim `embedding`: its statement, the leaves of its cover tree, their margins (FORMAT.md §10).

A *row* holds the coefficients of a linear function of the control points that a piece depends on, up to a factor that all rows of a
list have in common.
"""

import itertools
import math
from fractions import Fraction

import msd
from curve import bspline_pieces, dot, reduced, split_at
from document import anything, expect, natural, number, record, require


def length(value, where):
    found = number(value, where)
    expect(found >= 0, where, "no negative length", found)
    return found


STATEMENT = {"edges": natural(0), "perturbation_radius": record({"infinity": length, "euclidean": length})}


def evidence_of(_statement):
    return record({"grid": natural(0, msd.MAX_GRID), "tree": anything})


def check(chain, statement, evidence, block):
    """Check the claim; `block` is the reader of the tree in the binary form.  The figure is the number of tokens."""
    tree, dimension = evidence["tree"], chain.dimension
    tokens = msd.json_tokens(tree, dimension) if block is None else msd.binary_tokens(tree, block, dimension)
    cover = Cover(chain, evidence["grid"])
    count = cover.replay(tokens)
    expect(statement["edges"] == cover.edges(), "statement.edges", cover.edges(), statement["edges"])
    stated = statement["perturbation_radius"]
    for norm, exponent in (("infinity", 1), ("euclidean", 2)):
        least = min(cover.radii[norm])
        expect(stated[norm] ** exponent <= least, f"statement.perturbation_radius.{norm}",
               f"its power {exponent} at most {least}", stated[norm])
    return {"tokens": count}


def sentence(statement):
    """An accepted statement in words."""
    radius = statement["perturbation_radius"]
    return (f"embedded, isotopic polygon of {statement['edges']} edges, perturbation radius {radius['infinity']} "
            f"(Euclidean {radius['euclidean']}), {statement['tokens']} tokens, curve {statement['curve_sha256']}")


class Cover(msd.Cover):
    """The replay of the cover tree, which collects the ends of the leaves' nodes and the least quotients of margins."""

    rules = frozenset({"separate", "monotone"})

    def __init__(self, chain, grid):
        super().__init__(chain, False, grid, None)
        self.table = Table(chain)
        self.ends, self.radii = set(), {"infinity": set(), "euclidean": set()}

    def edges(self):
        return len(self.ends) - (not self.chain.closed)

    def note(self, a, b, n, margin):
        """The leaf's obligation holds; its margin counts."""
        whole = self.chain.size << msd.DEPTH
        for parameter in (a.start, a.end, b.start, b.end):
            self.ends.add(parameter % whole if self.chain.closed else parameter)
        for norm, quotient in (("infinity", margin / sum(map(abs, n))), ("euclidean", margin * margin / dot(n, n))):
            self.radii[norm] = {min({quotient} | self.radii[norm])}

    def separate(self, a, b, *n):
        require(a is not b, "expected two different nodes")
        n = (*n, 0)[:3]
        least, most = min([dot(n, p) for p in a.hull]), max([dot(n, q) for q in b.hull])
        gap = Fraction(least, a.hull[0][3]) - Fraction(most, b.hull[0][3])
        expect(gap > 0, "separate", "min n·p − max n·q > 0", gap)
        self.note(a, b, n, self.table.gap_margin(a, b, n))

    def monotone(self, a, b, *n):
        self.require_neighbours(a, b)
        n = (*n, 0)[:3]
        for v in itertools.chain(*a.tangents, *b.tangents):
            require(dot(v, n) > 0, "expected v·n > 0 for every tangent v, found one that is not")
        self.note(a, b, n, self.table.slope_margin({a, b}, n))


# ---------------------------------------------------------------- linear functions of the own control points


def parts_of(node):
    """The parts that a node consists of: itself, or the pieces of a run."""
    if isinstance(node, msd.Part):
        return [node]
    return [part for child in node.children for part in parts_of(child)]


def field(rows):
    """The rows of the D_k (§3); the weight of a control point is the sum of its row."""
    weights, n = [sum(row) for row in rows], len(rows) - 1
    if len(set(weights)) == 1:
        return [tuple(y - x for x, y in zip(p, q)) for p, q in zip(rows, rows[1:])]
    common, found = math.lcm(*(math.comb(2 * n - 2, k) for k in range(2 * n - 1))), []
    for k in range(2 * n - 1):
        total = [0] * len(rows[0])
        for i in range(max(0, k - n + 1), k // 2 + 1):
            j = k - i + 1
            factor = (j - i) * math.comb(n, i) * math.comb(n, j) * (common // math.comb(2 * n - 2, k))
            total = [t + factor * (weights[i] * y - weights[j] * x) for t, x, y in zip(total, rows[i], rows[j])]
        found.append(tuple(total))
    return found


class Table:
    """The rows of all parts, made when asked for."""

    def __init__(self, chain):
        source, self.known = chain.source, {}
        self.whole, self.numbers, self.points = [], [], {}
        if source.knots is None:
            first = 0
            for points, _ in source.lists:
                self.whole.append([tuple(p[3] * (i == k) for i in range(len(points))) for k, p in enumerate(points)])
                self.numbers.append(list(range(first, first + len(points))))
                self.points.update({first + k: p for k, p in enumerate(points)})
                first += len(points) - 1
            if chain.closed:
                self.numbers[-1][-1] = 0
        else:
            degree, knots, points = source.degree, source.knots, source.lists[0][0]
            width = degree + 1  # of any `width` control points in a row, the remainders differ
            units = [tuple(p[3] * (i == k % width) for i in range(width)) for k, p in enumerate(points)]
            self.whole = [control for control, _ in bspline_pieces(degree, knots, units, 1)]
            self.points = dict(enumerate(points))
            for j in range(degree, len(points)):
                if knots[j] != knots[j + 1]:
                    self.numbers.append(sorted(range(j - degree, j + 1), key=lambda k: k % width))

    def rows(self, part):
        """The rows of the hull points and of the D_k of a part."""
        return self.rows_at(part.start, part.size)

    def rows_at(self, start, size):
        if (start, size) not in self.known:
            if size == 1 << msd.DEPTH:
                hull = self.whole[start >> msd.DEPTH]
                found = reduced(hull), reduced_or_zero(field(hull))
            else:
                parent, side = self.rows_at(start - start % (2 * size), 2 * size), (start // size) % 2
                found = tuple(reduced_or_zero(split_at(rows, Fraction(1, 2))[side]) for rows in parent)
            self.known[start, size] = found
        return self.known[start, size]

    def numbers_of(self, part):
        return self.numbers[part.start >> msd.DEPTH]

    def values(self, part, n):
        """n·P_j of the control points that the part depends on."""
        found = (self.points[number] for number in self.numbers_of(part))
        return [Fraction(dot(n, p), p[3]) for p in found]

    def sizes(self, terms):
        """Σ|m_j| of the terms (number, coefficient)."""
        total = {}
        for own, coefficient in terms:
            total[own] = total.get(own, 0) + coefficient
        return sum(map(abs, total.values()))

    def slope_margin(self, nodes, n):
        quotients = []
        for part in [part for node in nodes for part in parts_of(node)]:
            values = self.values(part, n)
            for row in self.rows(part)[1]:
                size = self.sizes(zip(self.numbers_of(part), row))
                quotients.append(sum(m * x for m, x in zip(row, values)) / size if size else Fraction(0))
        return min(quotients)

    def hull_values(self, part, n):
        values = self.values(part, n)
        return [sum(m * x for m, x in zip(row, values)) / sum(row) for row in self.rows(part)[0]]

    def gap_margin(self, a, b, n):
        both_parts = isinstance(a, msd.Part) and isinstance(b, msd.Part)
        if not both_parts or not set(self.numbers_of(a)) & set(self.numbers_of(b)):
            least = min(x for part in parts_of(a) for x in self.hull_values(part, n))
            most = max(x for part in parts_of(b) for x in self.hull_values(part, n))
            return (least - most) / 2
        quotients = []
        of_a, of_b = (list(zip(self.hull_values(part, n), self.rows(part)[0])) for part in (a, b))
        for (x, p), (y, q) in itertools.product(of_a, of_b):
            of_p = [(own, Fraction(m, sum(p))) for own, m in zip(self.numbers_of(a), p)]
            of_q = [(own, Fraction(-m, sum(q))) for own, m in zip(self.numbers_of(b), q)]
            size = self.sizes(of_p + of_q)
            quotients.append((x - y) / size if size else Fraction(0))
        return min(quotients)


def reduced_or_zero(rows):
    """The rows without common factor."""
    return reduced(rows) if any(map(any, rows)) else rows
