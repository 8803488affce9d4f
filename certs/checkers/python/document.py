"""Strict reading of numbers, of JSON values and of the binary form (FORMAT.md §1, §2, §7).

A *reader* is a function of a JSON value and of the words that say where it stands.  It gives back what the value
means, or raises `Reject`.
"""

import contextlib
import json
import math
import re
import reprlib
import sys
from fractions import Fraction

MAX_BITS = 65_536  # numerator or denominator of a number or of a vector, §1
NUMBER = re.compile(r"(0|-?[1-9][0-9]*)(?:/([1-9][0-9]*))?")
DIGITS = re.compile(r"0|[1-9][0-9]{0,19}")

sys.set_int_max_str_digits(0)  # the length of a text is checked before every conversion
reprlib.aRepr.maxstring = 70


class Reject(Exception):
    """The certificate is not accepted; the message says where and why."""


def expect(holds, where, wish, *found):
    if not holds:
        raise Reject(", found ".join([f"{where}: expected {wish}", *map(shown, found)]))


def require(holds, message):
    if not holds:
        raise Reject(message)


def shown(value):
    """A value for a message: a number is exact when short, otherwise rounded."""
    if not isinstance(value, (int, Fraction)):
        return reprlib.repr(value)[:100]
    if value.numerator.bit_length() + value.denominator.bit_length() < 120:
        return str(value)
    with contextlib.suppress(OverflowError):
        return f"about {float(value):.6g}"
    return "a number of huge size"


def bounded(number, where, bits=MAX_BITS):
    if number.bit_length() > bits:
        raise Reject(f"{where}: expected at most {bits} bits, found {number.bit_length()}")
    return number


# ---------------------------------------------------------------- JSON


def parse_json(data, what):
    def object_of(pairs):
        found = dict(pairs)
        expect(len(found) == len(pairs), what, "no repeated field", [key for key, _ in pairs])
        return found

    def refuse(text):
        raise Reject(f"{what}: the number {shown(text)} has no place here")

    try:
        return json.loads(data.decode("utf-8"), object_pairs_hook=object_of, parse_float=refuse, parse_constant=refuse,
                          parse_int=lambda text: int(text) if DIGITS.fullmatch(text) else refuse(text))
    except (ValueError, RecursionError) as error:
        raise Reject(f"{what}: not JSON in UTF-8: {error}") from None


def anything(value, _where):
    """The reader of a value that is read later."""
    return value


def number(value, where, bits=MAX_BITS, kind="fraction"):
    """The reader of a string that holds a canonical fraction."""
    match = NUMBER.fullmatch(value) if isinstance(value, str) and len(value) <= bits else None
    expect(match, where, f"a string holding a canonical {kind}", value)
    p, q = bounded(int(match[1]), where, bits), bounded(int(match[2] or 1), where, bits)
    lowest = match[2] is None or (p != 0 and q > 1 and math.gcd(p, q) == 1)
    expect(lowest, where, "lowest terms p/q with p ≠ 0, q ≥ 2", value)
    return Fraction(p, q)


def integer(value, where, bits=MAX_BITS):
    """The reader of a string that holds a canonical integer."""
    found = number(value, where, bits, "integer")
    expect(found.denominator == 1, where, "a string holding a canonical integer", value)
    return found.numerator


def natural(low, high=(1 << 64) - 1):
    """A reader of a JSON number."""
    def read(value, where):
        # a bool is no integer here
        expect(type(value) is int and low <= value <= high, where, f"an integer from {low} to {high}", value)
        return value
    return read


def text(*allowed):
    """A reader of one of the strings, or of any string of Unicode characters."""
    wish = " or ".join(f"'{a}'" for a in allowed) or "a string of Unicode characters"

    def read(value, where):
        unicode = isinstance(value, str) and not any("\ud800" <= c <= "\udfff" for c in value)
        expect(unicode and (not allowed or value in allowed), where, wish, value)
        return value
    return read


def items(reader, length=None, most=None):
    """A reader of a list, of this length or of at most so many."""
    wish = "a list" if length is None and most is None else f"a list of {length or f'at most {most}'}"

    def read(value, where):
        fits = isinstance(value, list) and length in (None, len(value)) and (most is None or len(value) <= most)
        expect(fits, where, wish, value)
        return [reader(x, f"{where}[{i}]") for i, x in enumerate(value)]
    return read


def unless(value_of_none, reader):
    """A reader that gives None for one special value."""
    return lambda value, where: None if value == value_of_none else reader(value, where)


def record(required, optional=None):
    """A reader of an object with all required fields and none but the given ones, each with its reader."""
    readers = {**required, **(optional or {})}

    def read(value, where):
        expect(isinstance(value, dict), where, "an object", value)
        for key in value:
            expect(key in readers, where, "no unknown field", key)
        for key in required:
            expect(key in value, where, f"the field '{key}', which is missing", list(value))
        return {key: readers[key](part, f"{where}.{key}") for key, part in value.items()}
    return read


def variant(tag, kinds):
    """A reader of an object whose field `tag` names its kind, and so its other fields."""
    def read(value, where):
        expect(isinstance(value, dict), where, "an object", value)
        expect(tag in value, where, f"the field '{tag}', which is missing", list(value))
        kind = text(*kinds)(value[tag], f"{where}.{tag}")
        return record({tag: anything, **kinds[kind]})(value, where)
    return read


# ---------------------------------------------------------------- binary form


def varint(n):
    digits = format(n, "b")
    digits = "0" * (-len(digits) % 7) + digits
    groups = [int(digits[i:i + 7], 2) for i in range(len(digits) - 7, -1, -7)]
    return bytes([g | 128 for g in groups[:-1]] + groups[-1:])


def vector_bytes(numbers, where):
    """A vector as in §7; the common denominator and the numerators over it are within bounds at every step."""
    q = 1
    for x in numbers:
        q = bounded(math.lcm(q, x.denominator), f"{where}: least common denominator")
    numerators = [bounded(x.numerator * (q // x.denominator), f"{where}: common numerator") for x in numbers]
    return varint(q) + b"".join(varint(2 * n if n >= 0 else -2 * n - 1) for n in numerators)


class BinaryReader:
    """Reads bytes from a place on; every shortage is a rejection."""

    def __init__(self, data):
        self.data, self.at = data, 0

    def left(self):
        return len(self.data) - self.at

    def take(self, count, what):
        if count > self.left():
            raise Reject(f"byte {self.at}: truncated: expected {what} ({count} bytes), found {self.left()} bytes")
        self.at += count
        return self.data[self.at - count:self.at]

    def byte(self, what):
        return self.take(1, what)[0]

    def varint(self, what, bits=MAX_BITS):
        start = self.at
        while self.byte(what) & 128:
            if 7 * (self.at - start) >= bits:
                raise Reject(f"byte {start}: {what}: expected at most {bits} bits")
        groups = self.data[start:self.at]
        require(groups[-1] or len(groups) == 1, f"byte {start}: {what}: padded varint")
        return bounded(int("".join([format(g & 127, "07b") for g in reversed(groups)]), 2), what, bits)

    def signed(self, what, bits=MAX_BITS):
        value = self.varint(what, bits + 8)
        return bounded(-(value + 1) // 2 if value & 1 else value // 2, what, bits)

    def count(self, what, low, high):
        return natural(low, high)(self.varint(what, 64), what)

    def vector(self, count, what):
        """Denominator and numerators."""
        q, numerators = self.varint(what), [self.signed(what) for _ in range(count)]
        least = q > 0 and math.gcd(q, *numerators) == 1
        require(least, f"byte {self.at}: {what}: the denominator is not the least common one")
        return q, numerators
