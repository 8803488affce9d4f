"""The claim `values`: lower bounds of distances (FORMAT.md §15)."""

from fractions import Fraction
from functools import cached_property

from curvature import scaled, total
from curve import reduced, split_at
from document import expect, integer, require
from domain_sign import product, require_by_halving, unscaled

MOST_BITS = 4_096  # integer of a token
DEPTH = 120
HALF = Fraction(1, 2)


def require_far(points, q, lower, where):
    """|X − w·q|² − lower·w² of a piece is non-negative by halving."""
    *xs, w = (scaled([p[axis] for p in points]) for axis in range(4))
    common = 1
    for c in q:
        common *= c.denominator
    away = [[x * common - v * int(c * common) for x, v in zip(column, w)] for column, c in zip(xs, q)]
    squares = total([product(f, f) for f in away])
    room = [lower.denominator * x - lower.numerator * common ** 2 * y for x, y in zip(squares, product(w, w))]
    coefficients, _ = unscaled([(x,) for x in room])
    require_by_halving([c for c, in coefficients], False, where)


class Part:
    """A part of a piece, halved `depth` times."""

    def __init__(self, points, depth):
        self.points, self.depth = points, depth

    @cached_property
    def children(self):
        require(self.depth < DEPTH, f"a part halved {DEPTH} times is not split")
        return [Part(reduced(half), self.depth + 1) for half in split_at(self.points, HALF)]

    def along(self, n):
        """The products of n with the hull points."""
        return [Fraction(sum(a * x for a, x in zip(n, p)), p[3]) for p in self.points]


class Run:
    """At least two consecutive pieces, with the box around their control points."""

    def __init__(self, pieces):
        middle = len(pieces) // 2
        self.children = [node_of(pieces[:middle]), node_of(pieces[middle:])]
        boxes = [child.box if isinstance(child, Run) else box_of(child.points) for child in self.children]
        self.box = [(min(low for low, _ in sides), max(high for _, high in sides)) for sides in zip(*boxes)]

    def along(self, n):
        sides = [(a * low, a * high) for a, (low, high) in zip(n, self.box)]
        return [sum(min(side) for side in sides), sum(max(side) for side in sides)]


def box_of(points):
    return [(min(xs), max(xs)) for xs in zip(*([Fraction(x, p[3]) for x in p[:3]] for p in points))]


def node_of(pieces):
    return Part(pieces[0], 0) if len(pieces) == 1 else Run(pieces)


def replay(tree, located, lower, where):
    """The tree over pairs of a node of one curve and a node of the other."""
    d = located[0].dimension
    todo = [tuple(node_of(side.pieces) for side in located)]
    for i, token in enumerate(tree):
        at = f"{where}: token {i}"
        rule, *words = token.split(" ") if isinstance(token, str) else [None]
        expect({"first": 0, "second": 0, "far": d}.get(rule) == len(words), at, "first, second or far", token)
        require(todo, f"{at}: expected no token, for the tree is complete")
        a, b = todo.pop()
        if rule == "first":
            todo += [(half, b) for half in reversed(a.children)]
        elif rule == "second":
            todo += [(a, half) for half in reversed(b.children)]
        else:
            n = [integer(word, at, MOST_BITS) for word in words]
            gap = min(a.along(n)) - max(b.along(n))
            far = gap > 0 and gap ** 2 >= lower * sum(x * x for x in n)
            require(far, f"{at}: expected nodes that are far along {n}")
    require(not todo, f"{where}: the tokens end before the tree")
