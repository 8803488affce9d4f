"""The claim `msd`: its statement (FORMAT.md §4) and the replay of its cover tree (§5).

A *hull* is a list of points with the same w.  *Tangents* are a list of groups, each a list of vectors with the same w.
"""

import itertools
import math
from fractions import Fraction
from functools import cached_property

import msd_upper
from curve import combination_positive, difference, dot
from document import Reject, anything, expect, integer, natural, number, record, require, shown, text, unless

MAX_WITNESS_BITS = 4_096  # integer of a leaf
MAX_GRID = 100_000
DEPTH = 120  # of a part, at most; parameters of nodes are kept multiplied by 2^120


def bound(value, where):
    found = number(value, where)
    expect(found >= 0, where, "no negative bound", found)
    return found


STATEMENT = {"convention": text("smooth", "critical"), "lower_squared": unless("inf", bound),
             "upper_squared": unless(None, bound)}


def evidence_of(_statement):
    return record({"grid": natural(0, MAX_GRID), "tree": anything, "upper": anything})


def check(chain, statement, evidence, block):
    """Check the claim; `block` is the reader of the tree in the binary form.  The figure is the number of tokens."""
    lower, upper, tree = statement["lower_squared"], statement["upper_squared"], evidence["tree"]
    expect(upper is None or (lower is not None and lower <= upper), "statement", "lower_squared ≤ upper_squared", upper)
    for name, absent, when in (("tree", lower == 0, 'lower_squared is "0"'),
                               ("upper", upper is None, "upper_squared is null")):
        wish = f"null when and only when {when}"
        expect((evidence[name] is None) == absent, f"evidence.{name}", wish, evidence[name])
    critical, count = statement["convention"] == "critical", 0
    if tree is not None:
        tokens = json_tokens(tree, chain.dimension) if block is None else binary_tokens(tree, block, chain.dimension)
        count = Cover(chain, critical, evidence["grid"], lower).replay(tokens)
    if upper is not None:
        msd_upper.check(chain, evidence["upper"], upper, critical)
    return {"tokens": count}


def sentence(statement):
    """An accepted statement in words."""
    lower, upper = statement["lower_squared"], statement["upper_squared"]
    bounds = "no double normal" if lower == "inf" else f"σ² in [{lower}, {'∞' if upper is None else upper}]"
    return (f"{bounds}, convention {statement['convention']}, {statement['tokens']} tokens, "
            f"curve {statement['curve_sha256']}")


# ---------------------------------------------------------------- tokens


def token_counts(dimension):
    """How many integers each token has; in the order of their codes."""
    return {"split": 0, "first": 0, "second": 0, "far": dimension, "not_normal": 2, "cone": dimension, "bend": 2,
            "separate": dimension, "monotone": dimension, "turn": 2 * dimension, "pedal": 5}


def json_tokens(tree, dimension):
    counts = token_counts(dimension)
    expect(isinstance(tree, list), "evidence.tree", "a list", tree)
    for i, token in enumerate(tree):
        rule, *words = token.split(" ") if isinstance(token, str) else [None]
        expect(counts.get(rule) == len(words), f"token {i}", "a known token", token)
        yield rule, tuple([integer(word, f"token {i}", MAX_WITNESS_BITS) for word in words])


def binary_tokens(tree, block, dimension):
    def units(n):
        return [tuple(sign * (i == axis) for i in range(n)) for axis in range(n) for sign in (1, -1)]

    text("binary")(tree, "evidence.tree")
    long = dict(enumerate(token_counts(dimension).items()))
    short = {0x10 + i: ("far", n) for i, n in enumerate(units(dimension))}
    short |= {0x20 + i: ("not_normal", n) for i, n in enumerate(units(2))}
    short |= {0x30 + i: ("separate", n) for i, n in enumerate(units(dimension))}
    while block.left():
        code = block.byte("token")
        if code in short:
            yield short[code]
        elif code in long:
            rule, count = long[code]
            yield rule, tuple([block.signed(rule, MAX_WITNESS_BITS) for _ in range(count)])
        else:
            raise Reject(f"byte {block.at - 1}: unknown token 0x{code:02x}")


# ---------------------------------------------------------------- nodes


class Node:
    """A part, a point element or a run, from parameter `start` to `end` (both times 2^120).

    It has `hull` and `tangents`, the H and T of FORMAT.md, and `children`, all made once; `ends` are the parameters
    of the ends of an open curve in it (convention critical).
    """

    ends = frozenset()

    def __str__(self):
        start, end = (str(Fraction(x, 1 << DEPTH)) for x in (self.start, self.end))
        return f"[{start}, {end}]" if self.start < self.end else "{%s}" % start


class Part(Node):
    def __init__(self, arc, start, size):
        self.arc, self.start, self.size, self.end = arc, start, size, start + size
        self.tangents = [arc.tangents()]

    @cached_property
    def hull(self):
        w = math.lcm(*{p[3] for p in self.arc.points})
        return [tuple([x * (w // p[3]) for x in p]) for p in self.arc.points]

    def columns(self, z1, z2, r, plain=0):
        """The coefficients of w(rc − z) and of w, then those of D, times the binomials unless `plain`."""
        points, d = self.arc
        rows = ([r * p[0] - z1 * p[3] for p in points], [r * p[1] - z2 * p[3] for p in points], [p[3] for p in points],
                [v[0] for v in d], [v[1] for v in d])
        return [[x * (1 if plain else math.comb(len(row) - 1, k)) for k, x in enumerate(row)] for row in rows]

    @cached_property
    def children(self):
        require(self.size > 1, f"a part of depth {DEPTH} is not split")
        half = self.size // 2
        return [Part(arc, self.start + i * half, half) for i, arc in enumerate(self.arc.cut(Fraction(1, 2)))]


class Point(Node):
    def __init__(self, chain, parameter):
        self.start = self.end = parameter << DEPTH
        self.hull = [chain.place(parameter)]
        self.tangents = [[direction] for direction in chain.directions(parameter)]
        if chain.is_end(parameter):
            self.ends = frozenset([parameter])

    @property
    def children(self):
        raise Reject("a point element is not split")


class Run(Node):
    def __init__(self, elements, grid):
        self.grid, self.start, self.end = grid, elements[0].start, elements[-1].end
        self.ends = elements[0].ends | elements[-1].ends
        middle = len(elements) // 2
        self.children = [node_of(half, grid) for half in (elements[:middle], elements[middle:])]

    @cached_property
    def hull(self):
        """The box; the box of a run inside is on the grid already, so that it can be rounded once more."""
        points, sides = [p for child in self.children for p in child.hull], []
        for axis in range(3):
            low = min((p[axis] << self.grid) // p[3] for p in points)
            high = max(-(-(p[axis] << self.grid) // p[3]) for p in points)
            sides.append({low, high})
        return sorted(itertools.product(*sides, [1 << self.grid]))

    @cached_property
    def tangents(self):
        return [group for child in self.children for group in child.tangents]


def node_of(elements, grid):
    return elements[0] if len(elements) == 1 else Run(elements, grid)


def elements_of(chain, critical):
    for i in range(chain.size + (not chain.closed)):
        if critical and (chain.is_end(i) or chain.is_corner(i)):
            yield Point(chain, i)
        if i < chain.size:
            yield Part(chain.pieces[i], i << DEPTH, 1 << DEPTH)


# ---------------------------------------------------------------- the cover tree


class Cover:
    """The replay of the cover tree; lower is None for "inf"."""

    rules = frozenset({"far", "not_normal", "cone", "bend", "turn", "pedal"})

    def __init__(self, chain, critical, grid, lower):
        self.chain, self.lower = chain, lower
        self.whole = node_of(list(elements_of(chain, critical)), grid)

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
                words = " ".join([rule, *map(shown, integers)])
                raise Reject(f"token {number}, pair {a} x {b}, rule '{words}': {error}") from None
            number += 1
        if stack:
            a, b = stack.pop()
            raise Reject(f"token {number}, pair {a} x {b}: expected a token, found the end of the tree")
        return number

    def step(self, a, b, rule, integers):
        """The pairs that follow, the last one first; a leaf has none."""
        if integers:
            require(rule in self.rules, "a leaf of another claim")
            require(any(integers), "expected integers not all zero")
            mixed = rule in ("bend", "turn", "pedal") or (rule == "not_normal" and all(integers))
            require(not (mixed and (isinstance(a, Run) or isinstance(b, Run))), "this rule is not for runs")
            getattr(self, rule)(a, b, *integers)
            return []
        require((rule == "split") == (a is b), "this token is not for such a pair")
        if rule == "first":
            return [(child, b) for child in reversed(a.children)]
        if rule == "second":
            return [(a, child) for child in reversed(b.children)]
        one, two = a.children
        return [(c, d) for c, d in ((two, two), (one, two), (one, one)) if c is not d or not isinstance(c, Point)]

    def far(self, a, b, *n):
        require(self.lower is not None, "expected no 'far' under lower_squared \"inf\"")
        n = (*n, 0)[:3]
        least, most = min([dot(n, p) for p in a.hull]), max([dot(n, q) for q in b.hull])
        gap = Fraction(least, a.hull[0][3]) - Fraction(most, b.hull[0][3])
        expect(gap > 0, "far", "g > 0", gap)
        squared = gap * gap / dot(n, n)
        if squared < self.lower:
            raise Reject(f"expected g²/(n·n) ≥ {shown(self.lower)}, found {shown(squared)}")

    def not_normal(self, a, b, alpha, beta):
        require(a is not b, "expected two different nodes")
        at_ends = (not a.ends or alpha <= 0) and (not b.ends or beta <= 0)
        require(at_ends, "expected α ≤ 0, β ≤ 0 at an end of the curve")
        for p, q in itertools.product(a.hull, b.hull):
            holds = combination_positive(difference(p, q), a.tangents, alpha, b.tangents, beta)
            require(holds, "expected (p−q)·(αv+βw) > 0, found a value ≤ 0")

    def require_neighbours(self, a, b):
        around = self.chain.closed and a.start == 0 and b.end == self.chain.size << DEPTH
        require(a is b or a.end == b.start or around, "expected equal or adjacent nodes")

    def cone(self, a, b, *n):
        self.require_neighbours(a, b)
        n = (*n, 0)[:3]
        nn = dot(n, n)
        for v in itertools.chain(*a.tangents, *b.tangents):
            vn = dot(v, n)
            within = vn > 0 and 2 * vn * vn > dot(v, v) * nn
            require(within, "expected all tangents within 45° of n, found one that is not")

    def bend(self, a, b, alpha, beta):
        self.require_neighbours(a, b)
        at_ends = (0 not in a.ends or alpha >= 0) and (self.chain.size not in b.ends or beta >= 0)
        require(at_ends, "expected α ≥ 0 at the start, β ≥ 0 at the end of the curve")
        for node in {a, b}:
            for x in [] if isinstance(node, Point) else itertools.chain(*node.tangents):
                holds = combination_positive(x, a.tangents, alpha, b.tangents, beta)
                require(holds, "expected (αv+βw)·x > 0, found a value ≤ 0")

    def turn(self, a, b, *vectors):
        self.require_neighbours(a, b)
        half = len(vectors) // 2
        p, q = ((*n, 0)[:3] for n in (vectors[:half], vectors[half:]))
        one, two = ([v for group in node.tangents for v in group] for node in (a, b))
        aligned = all(dot(p, v) > 0 for v in one) and all(dot(q, w) > 0 for w in two)
        require(aligned, "expected p·v > 0 and q·w > 0, found a value ≤ 0")
        path = [x for node in {a, b} if not isinstance(node, Point) for x in itertools.chain(*node.tangents)]
        for v, w, x in itertools.product(one, two, path):
            holds = dot(q, w) * dot(v, x) + dot(p, v) * dot(w, x) > 0
            require(holds, "expected ((q·w)v + (p·v)w)·x > 0, found a value ≤ 0")

    def pedal(self, a, b, z1, z2, r, l, m):
        require(self.lower is not None, "expected no 'pedal' under lower_squared \"inf\"")
        require(self.chain.dimension == 2, "expected a curve in the plane")
        require(isinstance(a, Part) and isinstance(b, Part) and a is not b, "expected two different parts of pieces")
        require(r > 0 and l and m, "expected r > 0 and l, m not 0")
        require(l + m > 0 and (l + m) ** 2 >= r * r * self.lower, "expected l+m > 0 and (l+m)² ≥ r²·lower_squared")
        for node, bound in ((a, l), (b, m)):
            x, y, w, dx, dy = node.columns(z1, z2, r)
            cross = [f - g for f, g in zip(product(x, dy), product(y, dx))]
            square = [f + g for f, g in zip(product(dx, dx), product(dy, dy))]
            for f, g in zip(product(cross, cross), product(product(w, w), square)):
                rest = f - bound * bound * g
                require(rest >= 0 if bound > 0 else rest <= 0, f"the tangents' distances from z are not bounded by {bound}/r")
        if l > 0 < m:
            for p, q in itertools.product(*(zip(*node.columns(z1, z2, r, 1)[:2]) for node in (a, b))):
                require(p[0] * q[0] + p[1] * q[1] <= 0, "expected (p−z)·(q−z) ≤ 0, found a value > 0")
            return
        inner, outer = (b, l) if l > 0 else (a, m)
        for x, y, w in zip(*inner.columns(z1, z2, r, 1)[:3]):
            require(x * x + y * y < (outer * w) ** 2, "expected a hull point nearer to z than the other part's tangents")


def product(f, g):
    """The product of two polynomials, all given by their Bernstein coefficients times the binomials of their degrees."""
    h = [0] * (len(f) + len(g) - 1)
    for (i, x), (j, y) in itertools.product(enumerate(f), enumerate(g)):
        h[i + j] += x * y
    return h
