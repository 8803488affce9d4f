"""The claim `motion`: statement, and the events in their order (FORMAT.md §14)."""

import hashlib
from fractions import Fraction

from curve import MAX_COUNT
from document import Reject, anything, expect, natural, record, require, text, unless, varint
from motion_contact import Contact
from motion_criteria import CRITERIA, Criteria
from motion_events import binary_events, denominator, json_events, move_bytes, time
from motion_shape import Places, Polygon, Shape
from motion_table import LeafTable

MAX_STEPS = 100_000_000

TRACK = unless(None, record({"embedded_through": time, "meets_by": unless(None, time)}))
STATEMENT = {"steps": natural(0, MAX_STEPS), "denominator": denominator, "motion_sha256": text(),
             "curve": TRACK, "polygon": TRACK, "criteria": unless(None, CRITERIA)}


def evidence_of(_statement):
    return record({"curve_contact": anything, "polygon_contact": anything, "events": anything})


def check(chain, statement, evidence, block):
    """Check the claim; `block` is the reader of the events in the binary form.  The figure is the number of events."""
    motion = Motion(chain, statement, evidence)
    count = len(motion.places.initial)
    source = evidence["events"]
    events = (json_events(source, chain.dimension, count) if block is None
              else binary_events(source, block, chain.dimension, count))
    number_of_events = 0
    for kind, *fields in events:
        try:
            motion.event(kind, fields)
        except Reject as error:
            raise Reject(f"event {number_of_events} ('{kind}') at time {motion.time()}: {error}") from None
        number_of_events += 1
    motion.finish()
    return {"events": number_of_events}


def sentence(statement):
    """An accepted statement in words."""
    words = [f"{statement['steps']} steps"]
    for name in ("curve", "polygon"):
        if statement[name] is not None:
            meets = statement[name]["meets_by"]
            words.append(f"{name} embedded and isotopic through {statement[name]['embedded_through']}"
                         + (f", meets itself by {meets}" if meets is not None else ""))
    if statement["criteria"] is not None:
        words.append("criteria evaluated")
    return ", ".join(words + [f"{statement['events']} events", f"curve {statement['curve_sha256']}",
                              f"motion {statement['motion_sha256']}"])


class Track:
    """A track that is claimed: its table (absent at first and after its end) and its contact."""

    def __init__(self, name, shape, places, stated, steps, contact):
        self.name, self.shape, self.places, self.table, self.over = name, shape, places, None, False
        self.through, by = stated["embedded_through"], stated["meets_by"]
        where = f"statement.{name}"
        expect(0 <= self.through <= steps, f"{where}.embedded_through", f"a time from 0 to {steps}", self.through)
        self.contact = None
        if by is not None:
            last = self.through.numerator // self.through.denominator + 1
            expect(self.through < by <= min(steps, last), f"{where}.meets_by",
                   f"a time after {self.through}, at most {min(steps, last)}", by)
            self.contact = Contact(contact, f"evidence.{name}_contact", shape, self.through, by)

    def present(self):
        require(self.table is not None, f"expected a tree of '{self.name}' before, found none")
        return self.table

    def moved(self, move):
        if self.table is not None:
            try:
                self.table.moved(self.shape.pieces_of(move))
            except Reject as error:
                raise Reject(f"{self.name}, {error}") from None


class Motion:
    """The events so far.  `frame` is the number of moves that are complete, `begun` the fraction of the next one."""

    def __init__(self, chain, statement, evidence):
        self.chain, self.statement, self.frame = chain, statement, 0
        self.begun, self.move = None, None
        self.curve = Shape(chain)
        self.places = Places(chain, self.curve, statement["denominator"])
        self.polygon = Polygon(chain, self.places)
        self.hash = hashlib.sha256(chain.block)
        self.hash.update(varint(statement["denominator"]))
        self.tracks = {}
        for name, shape in (("curve", self.curve), ("polygon", self.polygon)):
            stated, contact = statement[name], evidence[f"{name}_contact"]
            meets = stated is not None and stated["meets_by"] is not None
            wish = "null when and only when meets_by is"
            expect((contact is not None) == meets, f"evidence.{name}_contact", wish, contact)
            if stated is not None:
                self.tracks[name] = Track(name, shape, self.places, stated, statement["steps"], contact)
        if "polygon" in self.tracks:
            expect(self.polygon.size <= MAX_COUNT, "statement.polygon", f"at most {MAX_COUNT} edges", self.polygon.size)
        self.closed = [self.curve] if chain.closed else []
        if "polygon" in self.tracks and self.polygon.closed:
            self.closed.append(self.polygon)
        self.criteria = None
        if statement["criteria"] is not None:
            self.criteria = Criteria(statement["criteria"], chain, self.curve, self.polygon, self.places)
        self.begin_frame()

    def time(self):
        return self.frame + (self.begun or 0)

    def begin_frame(self):
        for shape in self.closed:
            require(shape.stays_closed(self.places), f"expected a curve that is still closed, at frame {self.frame}")
        for track in self.tracks.values():
            if track.contact is not None:
                track.contact.begin_frame(self.frame, self.places)

    def track(self, name):
        require(name in self.tracks, f"expected a track of the statement, '{name}' is null")
        return self.tracks[name]

    def event(self, kind, fields):
        getattr(self, f"on_{kind}")(*fields)

    def on_tree(self, name, tokens):
        track = self.track(name)
        require(track.table is not None or (self.time() == 0 and not track.over),
                "expected the first tree at time 0, and none after the end")
        track.table = LeafTable(track.shape, self.places)
        track.table.plant(tokens)

    def on_edit(self, name, leaf, tokens):
        self.track(name).present().edit(leaf, tokens)

    def on_end(self, name):
        track = self.track(name)
        track.present()
        expect(track.through == self.time(), f"statement.{name}.embedded_through", f"the time {self.time()}", track.through)
        track.table, track.over = None, True

    def begin_move(self, move):
        require(self.begun is None, "expected the next frame to be reached before another move")
        expect(self.frame < self.statement["steps"], "events", f"{self.statement['steps']} moves", "another")
        self.hash.update(move_bytes(move, self.chain.dimension))
        for track in self.tracks.values():
            if track.contact is not None:
                track.contact.begin_move(self.frame, move)

    def on_begin(self, move):
        self.begin_move(move)
        self.begun, self.move = Fraction(0), move

    def on_go(self, time):
        require(self.begun is not None, "expected a move that has begun")
        expect(time > self.begun, "go", f"a time after {self.begun}", time)
        if time == 1:
            self.arrive(self.move)
            return
        self.begun = time
        self.places.go(self.move, time)
        for track in self.tracks.values():
            track.moved(self.move)

    def on_step(self, move):
        self.begin_move(move)
        self.arrive(move)

    def arrive(self, move):
        self.frame, self.begun, self.move = self.frame + 1, None, None
        self.places.arrive(move)
        self.begin_frame()
        for track in self.tracks.values():
            track.moved(move)
        if self.criteria is not None:
            self.criteria.moved(self.frame, [number for number, _ in move], self.curve.pieces_of(move))

    def finish(self):
        steps = self.statement["steps"]
        expect(self.begun is None and self.frame == steps, "events", f"{steps} complete moves", self.frame)
        for name, track in self.tracks.items():
            require(track.over or track.table is not None, f"evidence.events: expected a tree of '{name}', found none")
            if not track.over:
                expect(track.through == steps, f"statement.{name}.embedded_through", f"the time {steps}", track.through)
        if self.criteria is not None:
            self.criteria.finish()
        expect(self.statement["motion_sha256"] == self.hash.hexdigest(), "statement.motion_sha256", self.hash.hexdigest(),
               self.statement["motion_sha256"])
