"""The claim `motion`: the table of leaves of a track, their nodes and obligations (FORMAT.md §14)."""

from fractions import Fraction

from curve import dot
from document import Reject, expect, require, shown
from motion_shape import applied
from msd import DEPTH

RULES = frozenset({"separate", "monotone"})


class Node:
    """A run or a part, from parameter `start` to `end` (both times 2^120); `leaves` are the numbers of those it is in."""

    def __init__(self, table, start, end, parent):
        self.table, self.start, self.end, self.parent, self.leaves, self.made = table, start, end, parent, set(), None

    def __str__(self):
        return f"[{shown_parameter(self.start)}, {shown_parameter(self.end)}]"

    @property
    def children(self):
        if self.made is None:
            self.made = self.halves()
        return self.made

    def below(self):
        """The node itself and all nodes made by splitting it."""
        yield self
        for child in self.made or ():
            yield from child.below()


def shown_parameter(x):
    return shown(Fraction(x, 1 << DEPTH))


class Run(Node):
    def __init__(self, table, start, end, parent):
        super().__init__(table, start, end, parent)
        self.box = None
        middle = (self.first + self.last) // 2 << DEPTH
        self.made = [table.node(start, middle, self), table.node(middle, end, self)]

    @property
    def first(self):
        return self.start >> DEPTH

    @property
    def last(self):
        return self.end >> DEPTH

    def forget(self):
        self.box = None

    def bounds(self):
        """The least box of the own control points of the pieces, over the denominator times 2^shift: (low, high, shift)."""
        if self.box is None:
            boxes = [child.bounds() for child in self.made]
            shift = max(box[2] for box in boxes)
            lows, highs = ([[x << (shift - box[2]) for x in box[side]] for box in boxes] for side in (0, 1))
            self.box = tuple(map(min, *lows)), tuple(map(max, *highs)), shift
        return self.box

    def extent(self, n):
        """The least and the greatest n·p over H, and the number that both stand over."""
        low, high, shift = self.bounds()
        least = sum(c * (high[i] if c < 0 else low[i]) for i, c in enumerate(n))
        most = sum(c * (low[i] if c < 0 else high[i]) for i, c in enumerate(n))
        return least, most, 1 << shift

    def fields(self):
        """The D_k of each part."""
        for child in self.made:
            yield from child.fields()


class Part(Node):
    def __init__(self, table, start, end, parent):
        super().__init__(table, start, end, parent)
        self.forget()

    def forget(self):
        self.hull = self.field = None

    def halves(self):
        size = self.end - self.start
        require(size > 1, f"a part of depth {DEPTH} is not split")
        middle = self.start + size // 2
        return [Part(self.table, self.start, middle, self), Part(self.table, middle, self.end, self)]

    def own(self):
        """Rows and places, which both stand in the order of the own control points of the piece."""
        shape = self.table.shape
        numbers = shape.numbers[self.start >> DEPTH]
        return shape.rows_of(self.start, self.end - self.start), *self.table.places.aligned(numbers)

    def bounds(self):
        """As of a run; only of a whole piece."""
        points, shift = self.table.places.aligned(self.table.shape.numbers[self.start >> DEPTH])
        return tuple(map(min, zip(*points))), tuple(map(max, zip(*points))), shift

    def extent(self, n):
        if self.hull is None:
            (rows, common, _), points, shift = self.own()
            self.hull = [applied(row, points) for row in rows], common << shift
        values = [dot(n, p) for p in self.hull[0]]
        return min(values), max(values), self.hull[1]

    def fields(self):
        if self.field is None:
            (_, _, rows), points, _ = self.own()
            self.field = [applied(row, points) for row in rows]
        yield self.field


class LeafTable:
    """The leaves by their numbers: (A, B, rule, n)."""

    def __init__(self, shape, places):
        self.shape, self.places, self.leaves, self.next = shape, places, {}, 0
        self.elements = [None] * shape.size
        self.whole = self.node(0, shape.size << DEPTH, None)

    def node(self, start, end, parent):
        if end - start > 1 << DEPTH:
            return Run(self, start, end, parent)
        part = self.elements[start >> DEPTH] = Part(self, start, end, parent)
        return part

    def plant(self, tokens):
        """The complete tree of all pairs."""
        self.grow((self.whole, self.whole), tokens)

    def edit(self, leaf, tokens):
        expect(leaf in self.leaves, "edit", f"the number of one of the {len(self.leaves)} leaves", leaf)
        a, b, _, _ = self.leaves.pop(leaf)
        for node in {a, b}:
            node.leaves.discard(leaf)
        self.grow((a, b), tokens)

    def grow(self, pair, tokens):
        stack, count = [pair], 0
        while stack:
            a, b = stack.pop()
            token = next(tokens, None)
            if token is None:
                raise Reject(f"token {count}, pair {a} x {b}: expected a token, found the end of the tree")
            rule, integers = token
            try:
                stack.extend(self.step(a, b, rule, integers))
            except Reject as error:
                words = " ".join([rule, *map(shown, integers)])
                raise Reject(f"token {count}, pair {a} x {b}, rule '{words}': {error}") from None
            count += 1

    def step(self, a, b, rule, integers):
        """The pairs that follow, the last one first; a leaf has none and joins the table."""
        if integers:
            require(rule in RULES, "a leaf of another claim")
            require(any(integers), "expected integers not all zero")
            leaf = a, b, rule, (*integers, 0)[:3]
            self.obligation(*leaf)
            for node in (a, b):
                node.leaves.add(self.next)
            self.leaves[self.next] = leaf
            self.next += 1
            return []
        require((rule == "split") == (a is b), "this token is not for such a pair")
        if rule == "first":
            return [(child, b) for child in reversed(a.children)]
        if rule == "second":
            return [(a, child) for child in reversed(b.children)]
        one, two = a.children
        return [(two, two), (one, two), (one, one)]

    def obligation(self, a, b, rule, n):
        if rule == "separate":
            require(a is not b, "expected two different nodes")
            (least, _, v), (_, most, w) = a.extent(n), b.extent(n)
            require(least * w > most * v, "expected min n·p − max n·q > 0, found a value ≤ 0")
            return
        around = self.shape.closed and a.start == 0 and b.end == self.shape.size << DEPTH
        require(a is b or a.end == b.start or around, "expected equal or adjacent nodes")
        for node in {a, b}:
            for field in node.fields():
                vectors = [v for v in field if any(v)]
                require(vectors, "expected a part with a D_k that is not zero, found none")
                holds = all(dot(n, v) > 0 for v in vectors)
                require(holds, "expected n·D_k > 0 or D_k = 0 for every k, found another value")

    def moved(self, pieces):
        """The own control points of these pieces have moved: the leaves that depend on them must hold."""
        above, found = set(), set()
        for i in pieces:
            node = self.elements[i]
            for part in node.below():
                part.forget()
                found |= part.leaves
            while (node := node.parent) is not None and node not in above:
                node.forget()
                above.add(node)
                found |= node.leaves
        for number in sorted(found):
            a, b, rule, n = self.leaves[number]
            try:
                self.obligation(a, b, rule, n)
            except Reject as error:
                words = " ".join([rule, *map(str, n[:self.shape.dimension])])
                raise Reject(f"leaf {number}, pair {a} x {b}, rule '{words}': {error}") from None
