"""The claim `motion`: the own control points in motion, and what they make of the curve and of its polygon (FORMAT.md §14).

A *shape* is that of a track: its pieces as linear functions (rows) of the own control points.  It stays, and the
*places* of the points move.
"""

import math
from functools import cached_property

import msd
from curve import Arc, Chain, reduced
from document import bounded, expect
from embedding import Table


class Places:
    """The own control points: integers over the denominator at the last frame, and now over it times 2^shift."""

    def __init__(self, chain, table, q):
        self.q, self.initial = q, []
        again = chain.closed and chain.source.knots is None  # the last point of the last piece is the first of all
        for number in range(len(table.points) - again):
            *x, w = table.points[number]
            for c in x:
                expect(c * q % w == 0, "statement.denominator", f"one for the coordinates of own point {number}", q)
            self.initial.append(tuple([bounded(c * q // w, "coordinate over the denominator") for c in x]))
        self.frame, self.now, self.shift = list(self.initial), list(self.initial), [0] * len(self.initial)

    def go(self, move, time):
        """To the fraction `time` of the move."""
        numerator, shift = time.numerator, time.denominator.bit_length() - 1
        for number, displacement in move:
            self.now[number] = tuple([(x << shift) + numerator * d for x, d in zip(self.frame[number], displacement)])
            self.shift[number] = shift

    def arrive(self, move):
        """To the next frame."""
        for number, displacement in move:
            place = tuple([bounded(x + d, "coordinate") for x, d in zip(self.frame[number], displacement)])
            self.frame[number] = self.now[number] = place
            self.shift[number] = 0

    def aligned(self, numbers):
        """The places of these points now, all over the denominator times the same 2^shift, and that shift."""
        shift = max([self.shift[number] for number in numbers])
        return [tuple([x << (shift - self.shift[k]) for x in self.now[k]]) for k in numbers], shift


def applied(row, points):
    """The value of a linear function."""
    x = y = z = 0
    for m, p in zip(row, points):
        if m:
            x, y, z = x + m * p[0], y + m * p[1], z + m * p[2]
    return x, y, z


class Shape(Table):
    """The shape of the curve."""

    def __init__(self, chain):
        super().__init__(chain)
        self.size, self.closed, self.dimension, self.scaled = chain.size, chain.closed, chain.dimension, {}

    @cached_property
    def touched(self):
        """Of each own control point the pieces that depend on it."""
        found = {}
        for piece, numbers in enumerate(self.numbers):
            for number in numbers:
                found.setdefault(number, []).append(piece)
        return found

    def pieces_of(self, move):
        """The pieces that depend on the points of the move."""
        return {piece for number, _ in move for piece in self.touched.get(number, ())}

    def rows_of(self, start, size):
        """The rows of the hull points, their common sum, and the rows of the D_k, of a part."""
        if (start, size) not in self.scaled:
            hull, field = self.rows_at(start, size)
            common = math.lcm(*map(sum, hull))
            self.scaled[start, size] = [tuple([m * (common // sum(row)) for m in row]) for row in hull], common, field
        return self.scaled[start, size]

    def stays_closed(self, places):
        """Of a closed curve: do its ends coincide at this frame?  (Those of Bézier pieces are one own control point.)"""
        ends = []
        for piece, end in ((0, 0), (self.size - 1, -1)):
            rows, common, _ = self.rows_of(piece << msd.DEPTH, 1 << msd.DEPTH)
            value = applied(rows[end], [places.frame[k] for k in self.numbers[piece]])
            ends.append([(x, common) for x in value])
        return all(x * w == y * v for (x, v), (y, w) in zip(*ends))


class Polygon(Shape):
    """The shape of the polygon of the own control points."""

    def __init__(self, chain, places):
        count = len(places.initial)
        bezier = chain.source.knots is None
        round_again = bezier and chain.closed
        self.known, self.scaled, self.dimension = {}, {}, chain.dimension
        self.numbers = [[k, (k + 1) % count] for k in range(count if round_again else count - 1)]
        self.size, self.whole = len(self.numbers), [[(1, 0), (0, 1)]] * len(self.numbers)
        self.closed = round_again or (not bezier and places.initial[0] == places.initial[-1])


class Moment(Chain):
    """The chain of a track between two frames, without its field D."""

    def __init__(self, shape, points, displacements, time):
        """`points` at the frame, `displacements` by number, `time` from 0 to 1."""
        a, b, pieces = time.numerator, time.denominator, []
        for i in range(shape.size):
            rows = shape.rows_at(i << msd.DEPTH, 1 << msd.DEPTH)[0]
            moved = [[b * x + a * d for x, d in zip(points[k], displacements.get(k, (0, 0, 0)))] for k in shape.numbers[i]]
            pieces.append(Arc(reduced([(*applied(row, moved), b * sum(row)) for row in rows]), [(0, 0, 0, 1)]))
        self.dimension, self.closed, self.pieces, self.size = shape.dimension, shape.closed, pieces, shape.size

    def is_corner(self, _s):
        return False  # joints of every kind may lie inside an interval
