"""Reading `curve/1` files into exact cubic, quintic, … Bézier pieces.

Nothing here is timed: every peer starts from the same exact pieces.
"""

import json
import re
from dataclasses import dataclass
from fractions import Fraction
from math import comb

_HEXADECIMAL = re.compile(r"([+-]?)0x([0-9a-f]*)\.?([0-9a-f]*)p([+-]?\d+)", re.IGNORECASE)


@dataclass
class Chain:
    """Polynomial pieces; `bezier[i][k]` is control point k of piece i, `power[i][k]` its coefficient of t**k."""

    name: str
    bezier: list
    power: list
    closed: bool

    def __len__(self):
        return len(self.bezier)


def exact(literal, numbers):
    """The exact value of a coordinate: decimal, fraction or hexadecimal floating point."""
    text = str(literal)
    hexadecimal = _HEXADECIMAL.fullmatch(text)
    if hexadecimal:
        sign, whole, places, exponent = hexadecimal.groups()
        digits = int(sign + (whole + places or "0"), 16)
        return Fraction(digits) * Fraction(2) ** (int(exponent) - 4 * len(places))
    value = Fraction(text)
    if numbers == "binary64" and "/" not in text:
        return Fraction(float(value))
    return value


def load(path):
    """The chain of a curve file."""
    with open(path, encoding="utf-8") as file:
        return read(file.read(), path)


def read(text, path):
    """The chain of the text of a curve file; weights must be equal, the peers know polynomial pieces only."""
    # Keep the literals: 0.1 stands for 1/10, not for the binary64 nearest to it.
    document = json.loads(text, parse_float=str, parse_int=str)
    if document.get("knotproof") != "curve/1":
        raise ValueError(f"{path}: not a curve/1 file")
    numbers = document.get("numbers", "decimal")

    def points(part):
        if len(set(exact(w, numbers) for w in part.get("weights", []))) > 1:
            raise ValueError(f"{path}: rational pieces are not compared")
        return [tuple(exact(x, numbers) for x in point) for point in part["points"]]

    if "bspline" in document:
        spline = document["bspline"]
        knots = [exact(knot, numbers) for knot in spline["knots"]]
        bezier = bspline_pieces(int(spline["degree"]), knots, points(spline))
    else:
        bezier = [points(piece) for piece in document["bezier"]["pieces"]]
    for before, after in zip(bezier, bezier[1:]):
        if before[-1] != after[0]:
            raise ValueError(f"{path}: consecutive pieces do not meet")
    return Chain(
        name=document.get("name", ""),
        bezier=bezier,
        power=[power_basis(piece) for piece in bezier],
        closed=bezier[0][0] == bezier[-1][-1],
    )


def bspline_pieces(degree, knots, points):
    """Bézier pieces of a B-spline: control point j on [a, b] is the blossom at a (degree − j times), b (j times)."""
    pieces = []
    for k in range(degree, len(points)):
        a, b = knots[k], knots[k + 1]
        if a < b:
            local = points[k - degree : k + 1]
            arguments = [[a] * (degree - j) + [b] * j for j in range(degree + 1)]
            pieces.append([blossom(degree, k, knots, local, values) for values in arguments])
    return pieces


def blossom(degree, k, knots, local, values):
    """The polar form of the segment on knots k, k + 1 (de Boor's triangle with one argument for each round)."""
    row = list(local)
    for r, value in enumerate(values, start=1):
        for i in range(degree, r - 1, -1):
            low, high = knots[k - degree + i], knots[k + 1 + i - r]
            ratio = (value - low) / (high - low)
            row[i] = tuple((1 - ratio) * p + ratio * q for p, q in zip(row[i - 1], row[i]))
    return row[degree]


def power_basis(piece):
    """Coefficients of 1, t, t², … of a Bézier piece."""
    n = len(piece) - 1
    return [
        tuple(
            comb(n, k) * sum((-1) ** (k - i) * comb(k, i) * piece[i][axis] for i in range(k + 1))
            for axis in range(len(piece[0]))
        )
        for k in range(n + 1)
    ]
