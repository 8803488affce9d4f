"""The claim `motion`: the criteria (FORMAT.md §14), which are exact figures of the moving control points."""

from fractions import Fraction

import msd
from curve import dot
from document import expect, natural, number, record, require, unless
from motion_shape import applied

MAX_EDGES = 4_096


def positive(value, where):
    found = number(value, where)
    expect(found > 0, where, "a number > 0", found)
    return found


def square(value, where):
    found = number(value, where)
    expect(found >= 0, where, "no negative square", found)
    return found


failures = record({norm: unless(None, natural(0)) for norm in ("infinity", "euclidean")})
CRITERIA = record({"display_tolerance": positive, "second_differences": failures,
                   "half_nu": unless(None, record({"nu_squared": square, "infinity": unless(None, natural(0)),
                                                   "euclidean": unless(None, natural(0))}))})


class Criteria:
    """The first frames at which the values reach the bounds, found frame by frame."""

    def __init__(self, stated, chain, shape, polygon, places):
        self.stated, self.shape, self.places, self.tolerance = stated, shape, places, stated["display_tolerance"]
        for i, piece in enumerate(chain.pieces):
            require(len({p[3] for p in piece.points}) == 1, f"statement.criteria: piece {i} is rational")
        self.nu_squared = None
        if stated["half_nu"] is not None:
            self.nu_squared = least_squared_distance(polygon, places)
            found = stated["half_nu"]["nu_squared"]
            expect(found == self.nu_squared, "statement.criteria.half_nu.nu_squared", self.nu_squared, found)
        self.first = {name: {"infinity": None, "euclidean": None} for name in ("second_differences", "half_nu")}
        self.bends = [None] * shape.size  # of each piece: N∞·max‖Δ₂‖, and its square in the Euclidean norm
        self.away = [(0, 0)] * len(places.initial)  # of each point: ‖P(i) − P(0)‖, and the square of the Euclidean one
        self.moved(0, range(len(places.initial)), range(shape.size))

    def moved(self, frame, points, pieces):
        """At this frame these points, and so these pieces, have moved."""
        q = self.places.q
        for i in pieces:
            self.bends[i] = self.bend(i)
        for k in points:
            x = [a - b for a, b in zip(self.places.frame[k], self.places.initial[k])]
            self.away[k] = max(map(abs, x)), dot(x, x)
        far, far_squared = max(x for x, _ in self.away), max(x for _, x in self.away)
        far, far_squared = Fraction(far, q), Fraction(far_squared, q * q)
        bend, bend_squared = max(x for x, _ in self.bends), max(x for _, x in self.bends)
        self.note("second_differences", "infinity", frame, bend + far >= self.tolerance)
        self.note("second_differences", "euclidean", frame, roots_reach(bend_squared, far_squared, self.tolerance))
        if self.nu_squared is not None:
            self.note("half_nu", "infinity", frame, 4 * far * far >= self.nu_squared)
            self.note("half_nu", "euclidean", frame, 4 * far_squared >= self.nu_squared)

    def note(self, name, norm, frame, reached):
        if reached and self.first[name][norm] is None:
            self.first[name][norm] = frame

    def bend(self, piece):
        rows, common, _ = self.shape.rows_of(piece << msd.DEPTH, 1 << msd.DEPTH)
        points = [self.places.frame[k] for k in self.shape.numbers[piece]]
        control, n = [applied(row, points) for row in rows], len(rows) - 1
        second = [[a - 2 * b + c for a, b, c in zip(*three)] for three in zip(control, control[1:], control[2:])]
        factor = Fraction((n // 2) * ((n + 1) // 2), 2 * n * common * self.places.q)
        greatest = max((max(map(abs, x)) for x in second), default=0)
        greatest_squared = max((dot(x, x) for x in second), default=0)
        return factor * greatest, factor * factor * greatest_squared

    def finish(self):
        for name, found in self.first.items():
            if self.stated[name] is not None:
                for norm, frame in found.items():
                    stated = self.stated[name][norm]
                    expect(stated == frame, f"statement.criteria.{name}.{norm}", frame, stated)


def roots_reach(a, b, bound):
    """√a + √b ≥ bound, for a, b ≥ 0 and bound > 0."""
    rest = bound * bound - a - b
    return rest <= 0 or 4 * a * b >= rest * rest


def least_squared_distance(polygon, places):
    """ν²: of the vertices to the edges that do not end in them."""
    expect(polygon.size <= MAX_EDGES, "statement.criteria.half_nu", f"at most {MAX_EDGES} edges", polygon.size)
    edges = [list(edge) for edge in polygon.numbers]
    if polygon.closed:
        edges[-1][1] = 0  # the last own control point of a B-spline is the same vertex
    best = None
    for i, j in edges:
        a, b = places.initial[i], places.initial[j]
        d = [y - x for x, y in zip(a, b)]
        length = dot(d, d)
        for k in {k for edge in edges for k in edge} - {i, j}:
            v = places.initial[k]
            x = [y - z for y, z in zip(v, a)]
            along = dot(x, d)
            if along <= 0:
                found = dot(x, x), 1
            elif along >= length:
                found = dot(y := [p - z for p, z in zip(v, b)], y), 1
            else:
                found = dot(x, x) * length - along * along, length
            if best is None or found[0] * best[1] < best[0] * found[1]:
                best = found
    require(best, "statement.criteria.half_nu: the polygon has no vertex off an edge")
    return Fraction(best[0], best[1] * places.q * places.q)
