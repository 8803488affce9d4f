"""The claim `deviation`: the distance between a curve and its control polygon (FORMAT.md §13)."""

import math
from fractions import Fraction

from curvature import not_negative, scaled, total
from document import expect, natural, number, record, shown
from domain_sign import is_polynomial, product, require_by_halving, unscaled

INDEX = natural(0, (1 << 32) - 1)
PARAMETER_BITS = 4096
MOST_SUBDIVISIONS = 16
MOST_EDGES = 1 << 22
ONE = [1, 1]  # the constant 1 in degree 1, scaled

STATEMENT = {"subdivisions": INDEX, "lower_squared": not_negative, "upper_squared": not_negative}


def evidence_of(_statement):
    return record({"piece": INDEX, "part": INDEX, "u": lambda value, where: number(value, where, PARAMETER_BITS)})


def check(chain, statement, evidence, _block):
    lower, upper, m = statement["lower_squared"], statement["upper_squared"], statement["subdivisions"]
    expect(lower <= upper, "statement", "lower_squared ≤ upper_squared", lower)
    expect(m <= MOST_SUBDIVISIONS, "statement.subdivisions", f"at most {MOST_SUBDIVISIONS}", m)
    edges = sum(len(piece.points) - 1 for piece in chain.pieces) << m
    expect(edges <= MOST_EDGES, "statement.subdivisions", f"at most {MOST_EDGES} edges", edges)
    i, j, u = evidence["piece"], evidence["part"], evidence["u"]
    expect(i < chain.size, "evidence.piece", f"a piece below {chain.size}", i)
    expect(j < 1 << m, "evidence.part", f"a part below {1 << m}", j)
    expect(0 <= u <= 1, "evidence.u", "a parameter from 0 to 1", u)
    for number_of_piece, piece in enumerate(chain.pieces):
        for number_of_part, columns in enumerate(parts(piece.points, chain.dimension, m)):
            where = f"part {number_of_part} of piece {number_of_piece}"
            if (number_of_piece, number_of_part) == (i, j):
                found = squared_at(columns, u)
                expect(found >= lower, "evidence.u", f"a squared distance ≥ {shown(lower)}", found)
            for k in range(len(columns[0]) - 1):
                halve(bounded(columns, k, upper), f"{where}, edge {k}: upper_squared less the squared distance")
    return {"edges": edges}


def sentence(statement):
    """An accepted statement in words."""
    return (f"the greatest squared distance from the control polygon after {statement['subdivisions']} subdivisions in "
            f"[{statement['lower_squared']}, {statement['upper_squared']}], curve {statement['curve_sha256']}")


def parts(points, dimension, m):
    """The parts of a piece: columns of X and w, integers up to a positive factor."""
    found = [[[p[axis] for p in points] for axis in (*range(dimension), 3)]]
    for _ in range(m):
        found = [half for columns in found for half in halves(columns)]
    return found


def halves(columns):
    left, right = [], []
    for column in columns:
        n, row = len(column) - 1, list(column)
        starts, ends = [], []
        for r in range(n + 1):
            starts.append(row[0] << n - r)
            ends.append(row[-1] << n - r)
            row = [a + b for a, b in zip(row, row[1:])]
        left.append(starts)
        right.append(ends[::-1])
    return left, right


def bernstein(column, u):
    n = len(column) - 1
    return sum(math.comb(n, k) * x * u ** k * (1 - u) ** (n - k) for k, x in enumerate(column))


def squared_at(columns, u):
    n = len(columns[0]) - 1
    k = min(math.floor(u * n), n - 1)
    v, weight = u * n - k, bernstein(columns[-1], u)
    line = [(1 - v) * Fraction(x[k], columns[-1][k]) + v * Fraction(x[k + 1], columns[-1][k + 1]) for x in columns[:-1]]
    return sum((bernstein(x, u) / weight - y) ** 2 for x, y in zip(columns, line))


def section(column, k):
    """The scaled coefficients on [k/n, (k+1)/n], times n^n, by the blossom."""
    n = len(column) - 1
    found = []
    for r in range(n + 1):
        row = list(column)
        for at in [k] * (n - r) + [k + 1] * r:
            row = [(n - at) * a + at * b for a, b in zip(row, row[1:])]
        found.append(math.comb(n, r) * row[0])
    return found


def bounded(columns, k, upper):
    """upper·w² − |X − w·L|² on edge k, scaled, up to a positive factor."""
    a, b = columns[-1][k], columns[-1][k + 1]
    *xs, w = (section(column, k) for column in columns)
    f = []
    for x, column in zip(xs, columns):
        line = product(w, [column[k] * b, column[k + 1] * a])
        f.append([a * b * p - q for p, q in zip(product(x, ONE), line)])
    squares = total([product(g, g) for g in f])
    room = product(product(w, w), product(ONE, ONE))
    return [upper.numerator * (a * b) ** 2 * x - upper.denominator * y for x, y in zip(room, squares)]


def halve(polynomial, where):
    coefficients, _ = unscaled([(x,) for x in polynomial])
    require_by_halving([c for c, in coefficients], False, where)
