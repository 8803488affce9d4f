#!/usr/bin/env python3
"""Tests of the claim `motion` on small cases.  Run: python3 test_motion.py

Trees are searched here among small vectors; the encoder of the events is written apart from the checker's own.
"""

import copy
import hashlib
import itertools
import json
import random
import struct
import unittest
from fractions import Fraction as F
from operator import mul

import document
import motion_criteria
from motion_shape import Moment, Places, Polygon, Shape
from motion_table import LeafTable
from test_check import SQUARE, Checks, chain_of, curve_block, leb, piece, polygon, texts, tree_block, zigzag

CODES = {"step": 0x40, "begin": 0x41}


def move_block(move):
    out, before = leb(len(move)), 0
    for number, *displacement in move:
        out += leb(number - before) + b"".join(zigzag(int(x)) for x in displacement)
        before = number
    return out


def event_block(events, short=False):
    out = b""
    for event in events:
        kind = next(iter(event))
        if kind in CODES:
            out += bytes([CODES[kind]]) + move_block(event[kind])
        elif kind == "go":
            time = F(event["go"])
            out += b"\x42" + leb(time.numerator) + leb(time.denominator.bit_length() - 1)
        else:
            track = event[kind] == "polygon"
            out += bytes([{"tree": 0x43, "edit": 0x45, "end": 0x47}[kind] + track])
            out += leb(event["leaf"]) if kind == "edit" else b""
            out += tree_block(event.get("tokens", []), short)
    return out


def motion_hash(curve, denominator, events):
    moves = b"".join(move_block(move) for event in events for kind, move in event.items() if kind in CODES)
    return hashlib.sha256(curve_block(curve) + leb(denominator) + moves).hexdigest()


def certificate(curve, events, steps, denominator=1, /, criteria=None, contacts=(None, None), **tracks):
    """A track is a pair (embedded_through, meets_by) or a text for the first, or None."""
    stated = {}
    for name in ("curve", "polygon"):
        found = tracks.get(name)
        through, by = found if isinstance(found, tuple) else (found, None)
        stated[name] = None if found is None else {"embedded_through": through, "meets_by": by}
    return {"knotproof": "certificate/1", "tool": "hand", "curve": copy.deepcopy(curve),
            "curve_sha256": hashlib.sha256(curve_block(curve)).hexdigest(),
            "statement": {"claim": "motion", "steps": steps, "denominator": str(denominator),
                          "motion_sha256": motion_hash(curve, denominator, events), **stated, "criteria": criteria},
            "evidence": {"curve_contact": contacts[0], "polygon_contact": contacts[1], "events": copy.deepcopy(events)}}


def binary(found, short=False, events=None):
    header = copy.deepcopy(found)
    header["curve"] = header["evidence"]["events"] = "binary"
    text = json.dumps(header).encode()
    events = found["evidence"]["events"] if events is None else events
    return (b"KNOTCRT1" + struct.pack("<I", len(text)) + text + curve_block(found["curve"])
            + (events if isinstance(events, bytes) else event_block(events, short)))


def tree_of(table, a, b, depth=0):
    """A tree for the pair that holds now: the first small vector, else halves."""
    reach = range(-2, 3)
    for n in sorted(itertools.product(*[reach] * table.shape.dimension), key=lambda n: sum(map(abs, n))):
        full = (*n, 0)[:3]
        for rule in ("separate", "monotone"):
            try:
                if any(n):
                    table.obligation(a, b, rule, full)
                    return [" ".join([rule, *map(str, n)])]
            except document.Reject:
                pass
    if depth > 12:
        raise document.Reject("no tree found")
    if a is b:
        one, two = a.children
        pairs = [(one, one), (one, two), (two, two)]
        return ["split", *(t for pair in pairs for t in tree_of(table, *pair, depth + 1))]
    wide = a.end - a.start >= b.end - b.start
    pairs = [(c, b) for c in a.children] if wide else [(a, c) for c in b.children]
    return ["first" if wide else "second", *(t for pair in pairs for t in tree_of(table, *pair, depth + 1))]


def setting(curve, denominator=1):
    chain = chain_of(curve)
    shape = Shape(chain)
    places = Places(chain, shape, denominator)
    return shape, Polygon(chain, places), places


def initial_tree(curve, denominator=1, track="curve"):
    shape, polygon_shape, places = setting(curve, denominator)
    table = LeafTable(shape if track == "curve" else polygon_shape, places)
    return tree_of(table, table.whole, table.whole)


# ---------------------------------------------------------------- the cases

SQUARE_TREE = ["split", "split", "monotone 1 0", "monotone 1 1", "monotone 0 1", "first", "second", "separate 0 -1",
               "monotone 1 -1", "second", "monotone -1 1", "separate 1 0", "split", "monotone -1 0", "monotone -1 -1",
               "monotone 0 -1"]
CHANNEL = polygon((0, 0), (4, 0), (4, 3), (0, 3))
CHANNEL_TREE = ["split", "monotone 1 0", "second", "monotone 1 1", "separate 0 -1", "split", "monotone 0 1",
                "monotone -1 1", "monotone -1 0"]
DIP = [[3, "2", "-6"]]  # the last point of the channel, through its floor at 1/2
ARCH = {"bezier": {"pieces": [piece([(0, 0), (1, 3), (2, 3), (3, 0)])]}}
HOOK = polygon((-2, 0, 0), (2, 0, 0), (2, 2, 2), (0, 2, 2), (0, -2, 2))
FALL = [[3, "0", "0", "-4"], [4, "0", "0", "-4"]]


def plant(tokens, track="curve"):
    return {"tree": track, "tokens": list(tokens)}


def square(**changes):
    events = [plant(SQUARE_TREE), plant(SQUARE_TREE, "polygon"), {"step": [[1, "1", "-1"]]},
              {"begin": [[0, "-1", "0"], [2, "1", "1"]]}, {"go": "3/8"},
              {"edit": "curve", "leaf": 0, "tokens": ["monotone 2 1"]},
              {"edit": "curve", "leaf": 10, "tokens": ["split", "monotone 2 1", "monotone 2 1", "monotone 3 1"]},
              {"go": "1"}, {"step": []}]
    return {**certificate(SQUARE, events, 3, 2, curve="3", polygon="3"), **changes}


def dip(through="3/8", by="1/2", rule=None, at_go="3/8"):
    events = [plant(CHANNEL_TREE), {"begin": DIP}, {"go": at_go}, {"end": "curve"}, {"go": "1"}]
    rule = rule or {"rule": "touch", "time": "1/2", "s": "1/4", "t": "3"}
    return certificate(CHANNEL, events, 1, contacts=(rule, None), curve=(through, by))


CROSSING = {"rule": "crossing", "time": "1", "s": ["1/2", "1"], "t": ["9/4", "11/4"], "first": ["3", "-1"],
            "second": ["0", "1"]}
PASSAGE = {"rule": "passage", "times": ["0", "1"], "s": ["1/4", "3/4"], "t": ["13/4", "15/4"], "first": ["1", "0", "0"],
           "second": ["0", "1", "0"], "third": ["0", "0", "1"]}


def fall(**changes):
    events = [plant(initial_tree(HOOK)), {"end": "curve"}, {"step": FALL}]
    return certificate(HOOK, events, 1, contacts=({**PASSAGE, **changes}, None), curve=("0", "1"))


class Cases(Checks):
    def accept_both(self, found):
        self.accept(found)
        self.accept(binary(found))
        self.accept(binary(found, short=True))

    def reject_both(self, found, words):
        self.reject(found, words)
        self.reject(binary(found), words)

    def with_events(self, found, events, **statement):
        """The certificate with other events, and the hash of their moves."""
        found = copy.deepcopy(found)
        found["evidence"]["events"] = events
        found["statement"].update(statement)
        found["statement"]["motion_sha256"] = motion_hash(found["curve"], int(found["statement"]["denominator"]), events)
        return found

    def replaced(self, found, i, *events, **statement):
        before = found["evidence"]["events"]
        return self.with_events(found, before[:i] + list(events) + before[i + 1:], **statement)


class Statement(Cases):
    def test_square(self):
        self.accept_both(square())

    def test_nothing_claimed(self):
        self.accept_both(certificate(SQUARE, [], 0))
        self.accept_both(certificate(SQUARE, [{"step": []}, {"step": [[0, "1", "0"]]}], 2))

    def test_steps(self):
        for steps in (2, 4, 100_000_001):
            found = square()
            found["statement"]["steps"] = steps
            self.reject_both(found, "")
        self.reject_both(certificate(SQUARE, [{"begin": []}], 0), "another")
        self.reject_both(certificate(SQUARE, [{"begin": []}], 1), "1 complete moves")

    def test_denominator(self):
        halves = polygon((0, 0), ("1/2", 0))
        self.accept_both(certificate(halves, [plant(["monotone 1 0"])], 0, 2, curve="0"))
        self.accept_both(certificate(halves, [plant(["monotone 1 0"])], 0, 4, curve="0"))
        self.reject_both(certificate(halves, [plant(["monotone 1 0"])], 0, 3, curve="0"), "denominator")
        for text in ("0", "-1", "1/2"):
            found = square()
            found["statement"]["denominator"] = text
            self.reject_both(found, "denominator")

    def test_hash(self):
        found = square()
        found["statement"]["motion_sha256"] = found["curve_sha256"]
        self.reject_both(found, "motion_sha256")
        found = square()  # another move under the old hash
        found["evidence"]["events"][2] = {"step": [[1, "1", "-2"]]}
        self.reject_both(found, "motion_sha256")
        found = square()  # `step` and `begin` of the same move hash alike
        found["evidence"]["events"][2:3] = [{"begin": [[1, "1", "-1"]]}, {"go": "1"}]
        self.accept_both(found)

    def test_embedded_through(self):
        for text in ("2", "5/2", "4", "-1", "0"):
            for name in ("curve", "polygon"):
                found = square()
                found["statement"][name]["embedded_through"] = text
                self.reject_both(found, f"statement.{name}")

    def test_tracks_and_trees(self):
        found = square()
        found["statement"]["polygon"] = None
        self.reject_both(found, "'polygon' is null")
        events = square()["evidence"]["events"]
        self.reject_both(self.with_events(square(), events[:1] + events[2:]), "expected a tree of 'polygon'")
        late = events[:1] + events[2:] + [events[1]]
        self.reject_both(self.with_events(square(), late), "first tree at time 0")

    def test_contact_only_with_meets_by(self):
        found = dip()
        found["evidence"]["curve_contact"] = None
        self.reject_both(found, "curve_contact")
        found = square()
        found["evidence"]["polygon_contact"] = CROSSING
        self.reject_both(found, "polygon_contact")

    def test_fields(self):
        for change in ({"extra": 1}, {"events": None}):
            found = square()
            found["evidence"].update(change)
            self.reject(found, "")
        for name in ("steps", "denominator", "motion_sha256", "curve", "polygon", "criteria"):
            found = square()
            del found["statement"][name]
            self.reject_both(found, name)
        found = square()
        found["evidence"]["events"] = "binary"
        self.reject(found, "a list")
        self.reject(binary(square())[:-1], "")
        self.reject(binary(square()) + b"\x40", "truncated")
        self.reject(binary(square()) + b"\x49", "an event")


class Events(Cases):
    def test_order_of_time(self):
        events = square()["evidence"]["events"]
        base = square()
        self.reject_both(self.replaced(base, 4, {"go": "3/8"}, {"go": "3/8"}), "a time after")
        self.accept_both(self.replaced(base, 4, {"go": "3/8"}, {"go": "1/2"}))
        self.reject_both(self.replaced(base, 4, {"go": "1/2"}, {"go": "3/8"}), "a time after")
        self.reject_both(self.replaced(base, 2, {"go": "1/2"}, events[2]), "a move that has begun")
        self.reject_both(self.replaced(base, 4, {"step": []}, steps=4), "the next frame")
        self.reject_both(self.replaced(base, 4, {"begin": []}, steps=4), "the next frame")
        for text in ("9/8", "1/3", "0", "-1/2"):
            self.reject(self.replaced(base, 4, {"go": text}), "expected j/2")
        self.accept_both(self.replaced(base, 4, {"go": f"1/{1 << 60}"}))
        self.reject(self.replaced(base, 4, {"go": f"1/{1 << 61}"}), "expected j/2")
        self.reject(binary(base, events=event_block(events).replace(b"\x42\x03\x03", b"\x42\x06\x04")), "j odd")

    def test_moves(self):
        base = square()
        self.reject_both(self.replaced(base, 2, {"step": [[4, "1", "0"]]}), "")
        self.reject_both(self.replaced(base, 2, {"step": [[1, "0", "0"]]}), "not zero")
        for number in (0, 1):
            found = square()
            found["evidence"]["events"][2]["step"].append([number, "1", "0"])
            self.reject(found, "increase")
        self.reject(self.replaced(base, 2, {"step": [[1, "1"]]}), "a list of 3")
        self.reject(self.replaced(base, 2, {"step": [[1, "1", "0", "0"]]}), "a list of 3")
        broken = event_block([plant(SQUARE_TREE), plant(SQUARE_TREE, "polygon")]) + b"\x40\x02\x01\x02\x00\x00\x02\x00"
        self.reject(binary(base, events=broken), "number of a point")

    def test_step_that_breaks_a_leaf(self):
        events = [plant(SQUARE_TREE), {"step": [[0, "0", "2"]]}]
        self.reject_both(certificate(SQUARE, events, 1, curve="1"), "leaf")
        events = [plant(SQUARE_TREE), {"begin": [[0, "0", "2"]]}, {"go": "1/4"}, {"end": "curve"}, {"go": "1"}]
        self.accept_both(certificate(SQUARE, events, 1, curve="1/4"))
        events[2] = {"go": "1/2"}  # the corner at (0, 1) is met at 1/2, and leaf 1 fails
        self.reject_both(certificate(SQUARE, events, 1, curve="1/2"), "leaf")

    def test_edits(self):
        base = square()
        self.reject_both(self.replaced(base, 5, {"edit": "curve", "leaf": 11, "tokens": ["monotone 2 1"]}), "one of the")
        self.reject_both(self.replaced(base, 6, {"edit": "curve", "leaf": 0, "tokens": ["monotone 2 1"]}), "one of the")
        self.reject_both(self.replaced(base, 5, {"edit": "curve", "leaf": 0, "tokens": ["monotone -1 0"]}), "n·D_k")
        self.reject_both(self.replaced(base, 5, {"edit": "curve", "leaf": 0, "tokens": ["separate 0 -1"]}), "different")
        self.reject_both(self.replaced(base, 5, {"edit": "curve", "leaf": 0, "tokens": ["first"]}), "not for such a pair")
        self.reject_both(self.replaced(base, 5, {"edit": "curve", "leaf": 0, "tokens": ["cone 2 1"]}), "another claim")
        self.reject_both(self.replaced(base, 5, {"edit": "curve", "leaf": 0, "tokens": ["monotone 0 0"]}), "all zero")
        self.reject(self.replaced(base, 5, {"edit": "curve", "leaf": 0, "tokens": ["monotone 2 1"] * 2}), "end of the tree")
        self.reject(self.replaced(base, 5, {"edit": "curve", "leaf": 0, "tokens": []}), "expected a token")
        self.reject(self.replaced(base, 5, {"edit": "curve", "leaf": 0, "tokens": ["split", "monotone 2 1"]}), "a token")
        early = [{"edit": "curve", "leaf": 0, "tokens": ["monotone 1 0"]}]
        self.reject_both(certificate(SQUARE, early, 0, curve="0"), "before")
        # the new leaf is looked at in the next frame, the old one no more
        events = [plant(["monotone 1 0"]), {"edit": "curve", "leaf": 0, "tokens": ["monotone 2 1"]},
                  {"step": [[1, "-2", "2"]]}]
        line = polygon((0, 0), (1, 0))
        self.reject_both(certificate(line, events, 1, curve="1"), "leaf 1")
        events[1]["tokens"] = ["monotone 1 1"]
        self.accept_both(certificate(line, events, 1, curve="1"))

    def test_numbers_begin_again_with_a_new_tree(self):
        line = polygon((0, 0), (1, 0))
        edit = {"edit": "curve", "leaf": 0, "tokens": ["monotone 2 1"]}
        tree = plant(["monotone 1 0"])
        self.accept_both(certificate(line, [tree, edit, tree, edit], 0, curve="0"))
        self.accept_both(certificate(line, [tree, edit, {**edit, "leaf": 1}], 0, curve="0"))
        self.reject_both(certificate(line, [tree, edit, tree, {**edit, "leaf": 1}], 0, curve="0"), "one of the")
        self.accept_both(certificate(line, [tree, {"begin": []}, {"go": "1/2"}, tree, {"go": "1"}, tree], 1, curve="1"))
        self.reject_both(certificate(line, [tree, {"step": [[1, "-3", "0"]]}], 1, curve="1"), "leaf 0")
        self.reject_both(certificate(line, [tree, {"end": "curve"}, {"step": []}, tree], 1, curve="0"), "after the end")
        self.reject_both(certificate(line, [tree, {"end": "curve"}, tree], 0, curve="0"), "after the end")
        self.reject_both(certificate(line, [tree, {"end": "curve"}, {"end": "curve"}], 0, curve="0"), "before")
        self.reject_both(certificate(line, [{"end": "curve"}], 0, curve="0"), "before")

    def test_end_is_the_time_through(self):
        self.reject_both(dip(through="1/4"), "embedded_through")
        self.accept_both(dip(through="1/4", at_go="1/4"))
        found = dip()
        events = found["evidence"]["events"]
        self.accept_both(self.with_events(found, [*events[:2], {"go": "1/4"}, {"go": "3/8"}, *events[3:]]))

    def test_unknown_events(self):
        line = polygon((0, 0), (1, 0))
        for event in ({}, {"stop": "curve"}, {"end": "both"}, {"step": None}, {"step": [], "begin": []}, {"go": 1},
                      {"tree": "curve"}, {"edit": "curve", "leaf": "0", "tokens": []}, [], "end"):
            self.reject(certificate(line, [plant(["monotone 1 0"])], 0, curve="0")
                        | {"evidence": {"curve_contact": None, "polygon_contact": None, "events": [event]}}, r"events\[0\]")


class Contacts(Cases):
    def test_touch(self):
        self.accept_both(dip())
        self.accept_both(dip(by="1"))
        self.accept_both(dip(by="3/4"))
        for by in ("3/8", "1/4", "5/4", "2"):
            self.reject_both(dip(by=by), "meets_by")
        self.reject_both(dip(by="7/16"), "embedded_through < time ≤ meets_by")
        touch = {"rule": "touch", "time": "1/2", "s": "1/4", "t": "3"}
        for field, value in (("time", "5/8"), ("time", "3/8"), ("s", "1/2"), ("t", "5/2"), ("s", "3"), ("t", "4"),
                             ("s", "-1")):
            self.reject_both(dip(rule={**touch, field: value}, by="1"), "")
        self.reject_both(dip(rule={**touch, "s": "3", "t": "3"}), "s < t")

    def test_long_fractions(self):
        """4,096 bits are allowed for times and for the parameters of a touch, 4,097 are not."""
        for bits, allowed in ((4_096, True), (4_097, False)):
            fraction = F((1 << bits) - 1 - (1 << (bits - 2)), 1 << (bits - 1))  # nearly 3/2, of so many bits
            touch = {"rule": "touch", "time": "1", "s": "1/2", "t": "3"}
            for field in ("time", "s"):
                rule = {**touch, field: str(fraction)}
                self.reject_both(dip(by="1", rule=rule), "time ≤ meets_by|differ" if allowed else "bits|fraction")

    def test_ends_of_a_closed_curve_are_one(self):
        triangle = polygon((0, 0), (4, 0), (0, 4), (0, 0))
        tree = initial_tree(triangle)
        events = [plant(tree), {"end": "curve"}, {"step": [[2, "0", "-4"]]}]
        touch = {"rule": "touch", "time": "1", "s": "0", "t": "2"}
        self.accept_both(certificate(triangle, events, 1, contacts=(touch, None), curve=("0", "1")))
        touch["t"] = "3"
        self.reject_both(certificate(triangle, events, 1, contacts=(touch, None), curve=("0", "1")), "parameter")

    def test_crossing(self):
        self.accept_both(dip(by="1", rule=CROSSING))
        for field, value in (("time", "1/2"), ("time", "3/8"), ("time", "5/4"), ("first", ["-3", "1"]),
                             ("first", ["0", "2"]), ("second", ["1", "0"]), ("s", ["0", "1/2"]), ("t", ["9/4", "5/2"]), ("t", ["1", "2"]),
                             ("s", ["1/2", "9/4"]), ("first", ["3", "-1", "0"])):
            self.reject_both(dip(by="1", rule={**CROSSING, field: value}), "")
        self.reject_both(dip(by="3/4", rule=CROSSING), "time")
        self.reject_both(dip(by="1", rule=PASSAGE), "rule")

    def test_passage(self):
        self.accept_both(fall())
        self.accept_both(fall(times=["1/4", "3/4"]))
        for field, value in (("times", ["1", "0"]), ("times", ["0", "1/2"]), ("times", ["1/2", "1"]),
                             ("times", ["0", "5/4"]), ("times", ["-1", "1"]), ("first", ["-1", "0", "0"]), ("second", ["0", "-1", "0"]),
                             ("third", ["0", "0", "-1"]), ("third", ["1", "1", "0"]), ("s", ["0", "1/4"]),
                             ("t", ["13/4", "7/2"]), ("s", ["1/4", "13/4"])):
            self.reject_both(fall(**{field: value}), "")
        found = fall()
        found["evidence"]["curve_contact"] = CROSSING
        self.reject_both(found, "rule")

    def test_not_within_the_move(self):
        """The contact is one of the move after the frame ⌊τ⌋."""
        found = fall()
        events = found["evidence"]["events"]
        still = self.with_events(found, events + [{"step": []}], steps=2)
        self.accept_both(still)
        before = self.with_events(found, [*events[:2], {"step": []}, events[2]], steps=2)
        self.reject_both(before, "n₃")
        before["statement"]["curve"]["meets_by"] = "2"
        self.reject_both(before, "meets_by")

    def test_polygon_of_a_curve(self):
        """The legs of an arch cross; the curve is not said to."""
        tree = initial_tree(ARCH, track="polygon")
        events = [plant(tree, "polygon"), {"begin": [[1, "4", "0"]]}, {"go": "1/8"}, {"end": "polygon"}, {"go": "1"}]
        shape = dict(contacts=(None, {"rule": "touch", "time": "1/4", "s": "1", "t": "2"}), polygon=("1/8", "1/4"))
        self.accept_both(certificate(ARCH, events, 1, **shape))
        wrong = dict(contacts=(shape["contacts"][1], None), curve=("1/8", "1/4"))
        self.reject_both(certificate(ARCH, events, 1, **wrong), "")
        beyond = dict(contacts=(None, {"rule": "touch", "time": "1/4", "s": "1", "t": "4"}), polygon=("1/8", "1/4"))
        self.reject_both(certificate(ARCH, events, 1, **beyond), "parameter")


def spline(degree, knots, points):
    return {"bspline": {"degree": degree, "knots": [str(t) for t in knots], **piece(points)}}


class Shapes(Cases):
    CLOSED = spline(2, [0, 0, 0, 1, 2, 3, 3, 3], [(0, 0), (4, 0), (4, 4), (0, 4), (0, 0)])
    UNCLAMPED = spline(2, range(8), [(0, 0), (4, 0), (2, 4), (0, 0), (4, 0)])

    def test_a_closed_spline_stays_closed(self):
        for curve, moves in ((self.CLOSED, (([0], [4]), [0, 4])), (self.UNCLAMPED, (([0], [3]), [0, 3]))):
            tree = initial_tree(curve)
            for broken in moves[0]:
                events = [plant(tree), {"step": [[k, "0", "-1"] for k in broken]}]
                self.reject_both(certificate(curve, events, 1, curve="1"), "closed")
                self.reject_both(certificate(curve, events[1:], 1), "closed")
            events = [plant(tree), {"step": [[k, "0", "-1"] for k in moves[1]]}]
            self.accept_both(certificate(curve, events, 1, curve="1"))

    def test_the_polygon_of_a_closed_spline(self):
        tree = initial_tree(self.CLOSED, track="polygon")
        events = [plant(tree, "polygon"), {"step": [[0, "-1", "0"], [4, "-1", "0"]]}]
        self.accept_both(certificate(self.CLOSED, events, 1, polygon="1"))

    def test_a_polygon_that_is_closed_alone(self):
        """First and last control point coincide, the curve is open: a claim about the polygon needs that it stays so."""
        curve = spline(2, range(8), [(0, 0), (4, 0), (4, 4), (0, 4), (0, 0)])
        tree = initial_tree(curve, track="polygon")
        events = [plant(tree, "polygon"), {"step": [[0, "-1", "0"]]}]
        self.reject_both(certificate(curve, events, 1, polygon="1"), "closed")
        self.accept_both(certificate(curve, events[1:], 1))

    def test_an_open_curve_does_not_become_closed(self):
        events = [plant(CHANNEL_TREE), {"step": [[3, "0", "-3"]]}]
        self.reject_both(certificate(CHANNEL, events, 1, curve="1"), "leaf")
        events = [plant(CHANNEL_TREE), {"end": "curve"}, {"step": [[3, "0", "-3"]]}]
        touch = {"rule": "touch", "time": "1", "s": "0", "t": "3"}
        self.accept_both(certificate(CHANNEL, events, 1, contacts=(touch, None), curve=("0", "1")))

    def test_no_adjacency_across_the_ends_of_an_open_polygon(self):
        """The arch as a closed chain is adjacent across 0 = M; its own polygon too; the channel's is not."""
        tree = [*CHANNEL_TREE]
        tree[4] = "monotone 1 0"
        self.reject_both(certificate(CHANNEL, [plant(tree, "polygon")], 0, polygon="0"), "adjacent")

    def test_the_polygon_of_a_closed_chain(self):
        curve = {"bezier": {"pieces": [piece([(0, 0), (4, 0), (4, 4), (0, 4), (0, 0)])]}}
        tree = initial_tree(curve, track="polygon")
        self.accept_both(certificate(curve, [plant(tree, "polygon"), {"step": [[0, "-1", "-1"]]}], 1, polygon="1"))
        self.reject_both(certificate(curve, [{"step": [[4, "-1", "-1"]]}], 1), "")

    def test_boxes_of_runs(self):
        """The points of a run are apart from a piece, but the corner of their box is not."""
        curve = polygon((0, 3), (1, 3), (4, 6), (5, 6), (6, 3), (7, 2))
        tokens = ["split"]
        shape, _, places = setting(curve)
        table = LeafTable(shape, places)
        run, other = table.whole.children
        tokens += tree_of(table, run, run)
        part = ["second", *tree_of(table, run, other.children[0]), "separate -1 1"]
        rest = tree_of(table, other, other)
        with self.subTest("points of a run"):
            a, b = run, other.children[1]
            points = [[places.initial[k][:2] for i in range(n.start >> 120, n.end >> 120) for k in shape.numbers[i]]
                      for n in (a, b)]
            gap = min(y - x for x, y in points[0]) - max(y - x for x, y in points[1])
            self.assertGreater(gap, 0)
        self.reject_both(certificate(curve, [plant(tokens + part + rest)], 0, curve="0"), "min n·p")
        part[-1] = "separate -1 0"
        self.accept_both(certificate(curve, [plant(tokens + part + rest)], 0, curve="0"))

    def test_zero_vectors(self):
        """A D_k that is zero is left out; not when all of a part are."""
        curve = {"bezier": {"pieces": [piece([(0, 0), (0, 0), (1, 0)])]}}
        self.accept_both(certificate(curve, [plant(["monotone 1 0"])], 0, curve="0"))
        self.accept_both(certificate(curve, [plant(["monotone 1 0"]), {"step": [[1, "1", "0"]]}], 1, curve="1"))
        self.reject_both(certificate(curve, [plant(["monotone 1 0"]), {"step": [[1, "2", "0"]]}], 1, curve="1"), "leaf")
        collapse = [plant(["monotone 1 0"]), {"step": [[2, "-1", "0"]]}]
        self.reject_both(certificate(curve, collapse, 1, curve="1"), "not zero")
        self.reject_both(certificate(curve, [plant(["monotone 1 0"], "polygon")], 0, polygon="0"), "not zero")


def criteria(tolerance, second, half=None):
    def both(pair):
        return dict(zip(("infinity", "euclidean"), pair))

    return {"display_tolerance": tolerance, "second_differences": both(second),
            "half_nu": half and {"nu_squared": half[0], **both(half[1:])}}


class Figures(Cases):
    EVENTS = [{"step": [[1, "0", "1"]]}, {"step": [[1, "0", "1"]]}]  # over 2

    def arch(self, *found, curve=ARCH, denominator=2, events=None):
        events = self.EVENTS if events is None else events
        return certificate(curve, events, len(events), denominator, criteria=criteria(*found))

    def test_second_differences(self):
        # N∞ = 1/3; Δ₂ = (0, −3), (0, −3); then (0, −4), (0, −5/2); then (0, −5), (0, −2)
        for tolerance, frame in (("1/2", 0), ("1", 0), ("101/100", 1), ("11/6", 1), ("2", 2), ("8/3", 2), ("27/10", None)):
            self.accept_both(self.arch(tolerance, (frame, frame)))
            for wrong in {0, 1, 2, None} - {frame}:
                self.reject_both(self.arch(tolerance, (wrong, frame)), "infinity")
                self.reject_both(self.arch(tolerance, (frame, wrong)), "euclidean")
        self.reject_both(self.arch("0", (0, 0)), "> 0")

    def test_norms(self):
        # the displacement (3, 4) has the length 5; second differences do not change: all points move alike
        move = [[k, "3", "4"] for k in range(4)]
        for tolerance, found in (("5", (1, 1)), ("51/10", (None, 1)), ("6", (None, 1)), ("601/100", (None, None))):
            self.accept_both(self.arch(tolerance, found, denominator=1, events=[{"step": move}]))

    def test_degrees(self):
        """N∞ of each piece is that of its degree; straight pieces have no second differences."""
        self.accept_both(self.arch("1/2", (1, 1), curve=SQUARE, events=self.EVENTS[:1]))
        self.accept_both(self.arch("51/100", (None, None), curve=SQUARE, events=self.EVENTS[:1]))
        for n, wish in ((1, 0), (2, F(1, 4)), (3, F(1, 3)), (4, F(1, 2)), (5, F(3, 5))):
            points = [(k, F(k * k, 2)) for k in range(n + 1)]
            curve = {"bezier": {"pieces": [piece(points)]}}
            shape, poly, places = setting(curve, 2)
            stated = criteria(F(1), (None, None))
            value = motion_criteria.Criteria(stated, chain_of(curve), shape, poly, places)
            self.assertEqual(value.bends, [(wish, wish * wish)])

    def test_second_differences_of_a_spline_are_those_of_its_pieces(self):
        curve = spline(2, [0, 0, 0, 1, 2, 2, 2], [(0, 0), (0, 4), (4, 4), (4, 0)])
        # pieces (0,0), (0,4), (2,4) and (2,4), (4,4), (4,0): Δ₂ = (2, −4), (−2, −4); N∞ = 1/4
        still = [{"step": []}]
        self.accept_both(self.arch("1", (0, 0), curve=curve, denominator=1, events=still))
        self.accept_both(self.arch("11/10", (None, 0), curve=curve, denominator=1, events=still))
        self.accept_both(self.arch("1119/1000", (None, None), curve=curve, denominator=1, events=still))

    def test_rational_pieces_are_refused(self):
        curve = {"bezier": {"pieces": [piece([(0, 0), (1, 1), (2, 0)], [1, 2, 1])]}}
        self.reject_both(self.arch("1", (None, None), curve=curve, events=[]), "rational")
        curve["bezier"]["pieces"][0]["weights"] = ["2", "2", "2"]
        self.accept_both(self.arch("1", (None, None), curve=curve, events=[]))

    def test_half_nu(self):
        # the polygon (0,0), (1,3), (2,3), (3,0): (1,3) is 1 away from the last edge, which the line through it is not
        self.accept_both(self.arch("9", (None, None), ("1", 1, 1)))
        self.reject_both(self.arch("9", (None, None), ("9/10", 1, 1)), "nu_squared")
        self.reject_both(self.arch("9", (None, None), ("1", 2, 1)), "half_nu.infinity")
        self.reject_both(self.arch("9", (None, None), ("1", 1, None)), "half_nu.euclidean")
        square_move = [{"step": [[0, "0", "1"]]}]
        self.accept_both(self.arch("9", (None, None), ("1", 1, 1), curve=SQUARE, events=square_move))
        diagonal = [{"step": [[0, "1", "1"]]}]  # (1/3, 1/3): half of 1 is more than 1/3 and √2/3
        self.accept_both(self.arch("9", (None, None), ("1", None, None), curve=SQUARE, events=diagonal, denominator=3))
        self.accept_both(self.arch("9", (None, None), ("1", None, 1), curve=SQUARE, events=[{"step": [[0, "2", "2"]]}],
                                   denominator=5))

    def test_nu_needs_a_pair(self):
        line = polygon((0, 0), (1, 0))
        self.reject_both(self.arch("9", (None, None), ("1", None, None), curve=line, events=[]), "no vertex off an edge")
        closed = spline(2, [0, 0, 0, 1, 2, 2, 2], [(0, 0), (1, 0), (0, 1), (0, 0)])
        self.accept_both(self.arch("9", (None, None), ("1/2", None, None), curve=closed, events=[]))


def random_curve(chance):
    dimension = chance.choice((2, 3))

    def point():
        return tuple(chance.randrange(-9, 10) for _ in range(dimension))

    if chance.random() < 0.5:
        count, corners = chance.randrange(2, 6), [point() for _ in range(7)]
        if chance.random() < 0.5:
            corners[count] = corners[0]
        pieces = []
        for a, b in zip(corners, corners[1:count + 1]):
            points = [a, *[point() for _ in range(chance.randrange(0, 3))], b]
            pieces.append(piece(points, [chance.randrange(1, 4) for _ in points] if chance.random() < 0.3 else None))
        return {"bezier": {"pieces": pieces}}
    degree, points = chance.randrange(1, 4), [point() for _ in range(chance.randrange(5, 9))]
    knots = sorted(chance.randrange(0, 9) for _ in range(len(points) + degree + 1))
    found = spline(degree, knots, points)
    if chance.random() < 0.3:
        found["bspline"]["weights"] = [str(chance.randrange(1, 4)) for _ in points]
    return found


class Incremental(unittest.TestCase):
    def test_a_table_knows_what_a_fresh_one_finds(self):
        """Random motions: the leaves that hold are the same whether nodes are kept from frame to frame or made anew."""
        chance, seen = random.Random(11), [0, 0]
        for _ in range(50):
            try:
                curve = random_curve(chance)
                shape, poly, places = setting(curve)
            except document.Reject:
                continue
            for shape in (shape, poly):
                places = setting(curve)[2]
                table = LeafTable(shape, places)
                try:
                    tokens = tree_of(table, table.whole, table.whole)
                except document.Reject:
                    continue
                read = list(document_tokens(tokens))
                table.plant(iter(read))
                for _ in range(4):
                    numbers = sorted(chance.sample(range(len(places.initial)), chance.randrange(0, 3)))
                    move = [(k, tuple([chance.choice((-1, 1)) for _ in range(shape.dimension)] + [0])[:3]) for k in numbers]
                    for time in (F(1, 4), F(1)):
                        if time < 1:
                            places.go(move, time)
                        else:
                            places.arrive(move)
                        kept = self.holds(lambda move=move: table.moved(shape.pieces_of(move)))
                        fresh = LeafTable(shape, places)
                        self.assertEqual(kept, self.holds(lambda fresh=fresh: fresh.plant(iter(read))))
                        seen[kept] += 1
                        if not kept:
                            break
                    if not kept:
                        break
        self.assertGreater(min(seen), 8)

    def holds(self, action):
        try:
            action()
        except document.Reject:
            return False
        return True

    def test_a_moment_is_the_chain_of_the_moved_points(self):
        chance, count = random.Random(5), 0
        for _ in range(60):
            try:
                curve = random_curve(chance)
                shape, _, places = setting(curve)
            except document.Reject:
                continue
            displacements = {k: tuple([chance.randrange(-4, 5) for _ in range(shape.dimension)] + [0])[:3]
                             for k in range(len(places.initial))}
            if shape.closed and "bspline" in curve:
                continue
            time = F(chance.randrange(0, 8), 7)
            points = [[str(x + time * d) for x, d in zip(p, displacements[k])][:shape.dimension]
                      for k, p in enumerate(places.initial)]
            moved = copy.deepcopy(curve)
            if "bspline" in curve:
                moved["bspline"]["points"] = points
            else:
                first = 0
                for part in moved["bezier"]["pieces"]:
                    last = first + len(part["points"])
                    part["points"] = [points[k % len(points)] for k in range(first, last)]
                    first = last - 1
            try:
                wish = chain_of(moved)
            except document.Reject:
                continue
            found, count = Moment(shape, places.frame, displacements, time), count + 1
            for k in range(shape.size * 3):
                s = F(k, 3)
                self.assertEqual(*[[F(x, p[3]) for x in p[:3]] for p in (wish.place(s), found.place(s))])
        self.assertGreater(count, 15)


def cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def segments_meet(p, q, adjacent):
    """Do the segments have a point in common (adjacent ones, the end of p the start of q: another one)?"""
    d, e, x = ([b - a for a, b in zip(*ends)] for ends in (p, q, (p[0], q[0])))
    normal = cross(d, e)
    if adjacent:
        return not any(d) or not any(e) or (not any(normal) and sum(map(mul, d, e)) < 0)
    if not any(normal):
        if any(cross(x, d)) or any(cross(x, e)):
            return False
        return any(min(p[0][i], p[1][i]) <= max(q[0][i], q[1][i]) and min(q[0][i], q[1][i]) <= max(p[0][i], p[1][i])
                   for i in [next((i for i in range(3) if d[i] or e[i]), 0)])
    square = sum(map(mul, normal, normal))
    s, t = (F(sum(map(mul, cross(x, v), normal)), square) for v in (e, d))
    return sum(map(mul, x, normal)) == 0 and 0 <= s <= 1 and 0 <= t <= 1


class Truth(unittest.TestCase):
    def test_segments(self):
        p = [(0, 0, 0), (2, 0, 0)]
        for q, wish in (([(1, -1, 0), (1, 1, 0)], True), ([(1, -1, 1), (1, 1, 0)], False), ([(1, 0, 0), (3, 0, 0)], True),
                        ([(3, 0, 0), (4, 0, 0)], False), ([(2, 0, 0), (2, 5, 5)], True), ([(0, 1, 0), (2, 1, 0)], False)):
            self.assertEqual(segments_meet(p, q, False), wish)
        self.assertTrue(segments_meet(p, [(2, 0, 0), (1, 0, 0)], True))
        self.assertFalse(segments_meet(p, [(2, 0, 0), (1, 1, 0)], True))

    def test_polygons_are_embedded_while_the_leaves_hold(self):
        """Random polygons and moves: at times between two at which all leaves hold no two edges meet."""
        chance, seen = random.Random(17), [0, 0]
        for _ in range(200):
            corners = [tuple(chance.randrange(-6, 7) for _ in range(2)) for _ in range(chance.randrange(3, 6))]
            if chance.random() < 0.5:
                corners.append(corners[0])
            try:
                shape, _, places = setting(polygon(*corners))
                table = LeafTable(shape, places)
                table.plant(document_tokens(tree_of(table, table.whole, table.whole, 6)))
            except document.Reject:
                continue
            for scale in (1, 6, 9):
                moving = [k for k in range(len(places.initial)) if chance.random() < 0.5]
                move = [(k, (scale * chance.randrange(-1, 2), scale * chance.choice((-1, 1)), 0)) for k in moving]
                before = list(places.frame)
                places.arrive(move)
                try:
                    table.moved(shape.pieces_of(move))
                    held = True
                except document.Reject:
                    held = False
                meets = any(self.meets(shape, before, places.frame, F(k, 7)) for k in range(8))
                seen[meets] += 1
                self.assertFalse(held and meets)
                if not held:
                    break
        self.assertGreater(min(seen), 5, seen)

    def meets(self, shape, before, after, time):
        at = [[a + time * (b - a) for a, b in zip(*two)] for two in zip(before, after)]
        edges = [[at[k] for k in numbers] for numbers in shape.numbers]
        for i, j in itertools.combinations(range(len(edges)), 2):
            around = shape.closed and i == 0 and j == len(edges) - 1
            if around and j > 1:
                i, j = j, i
            if segments_meet(edges[i], edges[j], around or j == i + 1):
                return True
        return False


def document_tokens(tokens):
    for token in tokens:
        rule, *words = token.split()
        yield rule, tuple(map(int, words))


if __name__ == "__main__":
    unittest.main()
