"""The claim `motion`: the contacts, proofs that a track meets itself between two frames (FORMAT.md §14)."""

from curve import dot
from document import expect, integer, items, require, variant
from motion_events import time as short
from motion_shape import Moment
from msd_upper import crossing, readers, require_order, touch


class Contact:
    """The contact of a track that is stated with `through` < `by`; it is checked when the frames around it are known."""

    def __init__(self, value, where, shape, through, by):
        self.value, self.where, self.shape, self.through, self.by = value, where, shape, through, by
        self.frame = through.numerator // through.denominator
        self.points = None

    def begin_frame(self, frame, places):
        if frame == self.frame:
            self.points = list(places.frame)

    def begin_move(self, frame, move):
        """The move from this frame on: check."""
        if frame == self.frame:
            check(self, dict(move))

    def moment(self, displacements, time):
        return Moment(self.shape, self.points, displacements, time - self.frame)


def check(contact, displacements):
    dimension, where = contact.shape.dimension, contact.where
    vector, pair = items(integer, dimension), items(short, 2)
    # the parameters of a track are the same at all times
    parameter, interval = readers(contact.moment(displacements, contact.through))

    def place(value, where):
        short(value, where)
        return parameter(value, where)

    rules = {"touch": {"time": short, "s": place, "t": place}}
    if dimension == 2:
        rules["crossing"] = {"time": short, "s": interval, "t": interval, "first": vector, "second": vector}
    else:
        rules["passage"] = {"times": pair, "s": interval, "t": interval, "first": vector, "second": vector,
                            "third": vector}
    found = variant("rule", rules)(contact.value, where)
    rule = found.pop("rule")
    require_order(contact.shape, found["s"], found["t"])
    if rule == "passage":
        passage(contact, displacements, **found)
        return
    time = found.pop("time")
    expect(contact.through < time <= contact.by, f"{where}.time", "embedded_through < time ≤ meets_by", time)
    moment = contact.moment(displacements, time)
    if rule == "touch":
        touch(moment, None, **found)
    else:
        crossing(moment, None, at(moment, found["s"]), at(moment, found["t"]), found["first"], found["second"])


def at(moment, interval):
    """The interval of the chain at another time."""
    return type(interval)(moment, interval.where, interval.start, interval.end)


def passage(contact, displacements, times, s, t, first, second, third):
    start, end = times
    expect(contact.through <= start < end <= contact.by, f"{contact.where}.times",
           "embedded_through ≤ u₀ < u₁ ≤ meets_by", times)
    (a, b, c), (d, e, f), (g, h, i) = first, second, third
    independent = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g) != 0
    require(independent, f"{contact.where}: the three vectors are linearly dependent")
    for time, sign in ((start, 1), (end, -1)):
        moment = contact.moment(displacements, time)
        one, other = at(moment, s), at(moment, t)
        one.require_signs(other, first)
        other.require_signs(one, [-x for x in second])
        n = [sign * x for x in third]
        for p in one.points:
            for q in other.points:
                below = dot(n, p) * q[3] < dot(n, q) * p[3]
                require(below, f"{contact.where}.third: expected n₃·(p−q) {'<' if sign > 0 else '>'} 0 at {time}")
