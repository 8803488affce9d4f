"""The claim `motion`: its events in both forms (FORMAT.md §14).

A move is a list of pairs (number of a point, (x, y, z)).
"""

import itertools
from fractions import Fraction

import msd
from document import Reject, anything, bounded, expect, integer, items, natural, number, record, require, text, varint

TRACKS = ("curve", "polygon")
MAX_HALVINGS = 60  # of a step in time
MAX_LEAF = (1 << 64) - 1
MAX_TIME_BITS = 4_096

track = text(*TRACKS)


def time(value, where):
    """The reader of a time, or of another fraction that is short."""
    return number(value, where, MAX_TIME_BITS)


FORMS = {
    "tree": record({"tree": track, "tokens": anything}),
    "edit": record({"edit": track, "leaf": natural(0, MAX_LEAF), "tokens": anything}),
    "end": record({"end": track}),
    "step": record({"step": items(anything)}),
    "begin": record({"begin": items(anything)}),
    "go": record({"go": time}),
}


def json_events(value, dimension, count):
    """The events of the JSON form, of a curve with `count` own control points: (kind, further fields …)."""
    expect(isinstance(value, list), "evidence.events", "a list", value)
    for i, event in enumerate(value):
        where = f"evidence.events[{i}]"
        kind = next((kind for kind in FORMS if isinstance(event, dict) and kind in event), None)
        expect(kind, where, f"an object with one of the fields {', '.join(FORMS)}", event)
        fields = FORMS[kind](event, where)
        if "tokens" in fields:
            tokens = msd.json_tokens(fields["tokens"], dimension)
            yield (kind, fields[kind], tokens) if kind == "tree" else (kind, fields[kind], fields["leaf"], tokens)
            for rule, _ in tokens:
                raise Reject(f"{where}: expected the end of the tree, found '{rule}'")
        elif kind == "go":
            yield kind, fraction_of_step(fields["go"], where)
        elif kind == "end":
            yield kind, fields["end"]
        else:
            yield kind, json_move(fields[kind], where, dimension, count)


def fraction_of_step(found, where):
    dyadic = found.denominator & (found.denominator - 1) == 0 and found.denominator <= 1 << MAX_HALVINGS
    expect(dyadic and 0 < found <= 1, where, f"j/2^e in (0, 1], e ≤ {MAX_HALVINGS}", found)
    return found


def json_move(entries, where, dimension, count):
    move = []
    for i, entry in enumerate(entries):
        entry_at = f"{where}[{i}]"
        expect(isinstance(entry, list) and len(entry) == 1 + dimension, entry_at, f"a list of {1 + dimension}", entry)
        point = natural(0, count - 1)(entry[0], entry_at)
        add_entry(move, point, [integer(x, entry_at) for x in entry[1:]], entry_at)
    return move


def add_entry(move, point, displacement, where):
    expect(not move or move[-1][0] < point, where, "numbers that increase", point)
    require(any(displacement), f"{where}: expected a displacement that is not zero")
    move.append((point, (*displacement, 0)[:3]))


def binary_events(value, block, dimension, count):
    """The same of the event block."""
    text("binary")(value, "evidence.events")
    while block.left():
        where = f"byte {block.at}"
        code = block.byte("event")
        kind = {0x40: "step", 0x41: "begin", 0x42: "go", 0x43: "tree", 0x44: "tree", 0x45: "edit", 0x46: "edit",
                0x47: "end", 0x48: "end"}.get(code)
        expect(kind, where, "an event", f"0x{code:02x}")
        name = TRACKS[(code - 0x43) % 2]
        if kind in ("step", "begin"):
            yield kind, binary_move(block, where, dimension, count)
        elif kind == "go":
            numerator, halvings = block.varint("j", MAX_HALVINGS + 8), block.count("e", 0, MAX_HALVINGS)
            expect(numerator % 2 == 1, where, "j odd", numerator)
            yield kind, fraction_of_step(Fraction(numerator, 1 << halvings), where)
        elif kind == "end":
            yield kind, name
        elif kind == "tree":
            yield kind, name, msd.binary_tokens("binary", block, dimension)
        else:
            yield kind, name, block.count("leaf", 0, MAX_LEAF), msd.binary_tokens("binary", block, dimension)


def binary_move(block, where, dimension, count):
    move, point = [], 0
    for i in range(block.count("entries of a move", 0, count)):
        point += block.count("number of a point", int(i > 0), count)
        expect(point < count, where, f"a number of a point below {count}", point)
        add_entry(move, point, [block.signed("displacement") for _ in range(dimension)], where)
    return move


def move_bytes(move, dimension):
    """The spelling of a move in the event block, which is hashed in both forms."""
    numbers = [point for point, _ in move]
    found = [varint(len(move))]
    for before, (point, displacement) in zip(itertools.chain([0], numbers), move):
        found.append(varint(point - before))
        found += [varint(2 * x if x >= 0 else -2 * x - 1) for x in displacement[:dimension]]
    return b"".join(found)


def denominator(value, where):
    found = integer(value, where)
    expect(found >= 1, where, "an integer ≥ 1", found)
    return bounded(found, where)
