"""The claim `curvature`: the greatest curvature of the pieces (FORMAT.md §11)."""

import math
from fractions import Fraction

from curve import derivative
from document import expect, natural, number, record, require, shown
from domain_sign import is_polynomial, product, require_by_halving, unscaled

PARAMETER_BITS = 4096


def not_negative(value, where):
    found = number(value, where)
    expect(found >= 0, where, "a number ≥ 0", found)
    return found


STATEMENT = {"lower_squared": not_negative, "upper_squared": not_negative}


def evidence_of(_statement):
    return record({"piece": natural(0, (1 << 32) - 1),
                   "u": lambda value, where: number(value, where, PARAMETER_BITS)})


def check(chain, statement, evidence, _block):
    lower, upper = statement["lower_squared"], statement["upper_squared"]
    expect(lower <= upper, "statement", "lower_squared ≤ upper_squared", lower)
    i, u = evidence["piece"], evidence["u"]
    expect(i < chain.size, "evidence.piece", f"a piece below {chain.size}", i)
    expect(0 <= u <= 1, "evidence.u", "a parameter from 0 to 1", u)
    found = Quotient(chain.pieces[i], chain.dimension).at(u)
    expect(found >= lower, "evidence.u", f"a squared curvature ≥ {shown(lower)}", found)
    for i, piece in enumerate(chain.pieces):
        quotient = Quotient(piece, chain.dimension)
        quotient.require_regular(f"piece {i}: D")
        quotient.require_bound(upper, f"piece {i}: upper_squared·|D|⁶ less the numerator")
    return {}


def sentence(statement):
    """An accepted statement in words."""
    return (f"the greatest squared curvature in [{statement['lower_squared']}, {statement['upper_squared']}], "
            f"curve {statement['curve_sha256']}")


# ---------------------------------------------------------------- polynomials, by scaled coefficients (domain_sign.py)


def scaled(coefficients):
    n = len(coefficients) - 1
    return [math.comb(n, k) * x for k, x in enumerate(coefficients)]


def power(p, exponent):
    return [1] if exponent == 0 else product(power(p, exponent - 1), p)


def total(polynomials):
    return [sum(xs) for xs in zip(*polynomials)]


def value(p, u):
    """The value at u times (denominator of u)^degree."""
    a, r, n = u.numerator, u.denominator - u.numerator, len(p) - 1
    return sum(x * a ** k * r ** (n - k) for k, x in enumerate(p))


class Quotient:
    """κ² = factor · rest · H / |T|⁶ of a piece, where T is a positive multiple of D and all stands in scaled coefficients."""

    def __init__(self, piece, dimension):
        points, n = piece.points, len(piece.points) - 1
        d = derivative(points, 1)
        scale = d[0][3]  # D is T/scale
        self.t = [scaled([v[axis] for v in d]) for axis in range(3)]
        if is_polynomial([(p[3],) for p in points]):
            rows, self.rest = [tuple(v[:3]) for v in d], [math.comb(2 * n + 2, k) for k in range(2 * n + 3)]
            self.factor = Fraction((n - 1) * scale, n) ** 2
        else:
            rows, self.rest = [(p[3], *p[:3]) for p in points], power(scaled([p[3] for p in points]), 6)
            self.factor = Fraction(n ** 4 * (n - 1) ** 2 * scale ** 6)
        planes = [(0, 1)] if dimension == 2 else [(0, 1), (1, 2), (2, 0)]
        self.h = [self.minor(rows, n, i, j) for i, j in planes] if n >= 2 else []

    @staticmethod
    def minor(rows, n, i, j):
        """h_ij; the rows are three numbers, or four with the weight first."""
        def b(r, column):
            return scaled([row[column] for row in rows[r:r + n - 1]])

        def minor_of_two(r, s, first, second):
            return [x - y for x, y in zip(product(b(r, first), b(s, second)), product(b(r, second), b(s, first)))]

        if len(rows[0]) == 3:
            return minor_of_two(0, 1, i, j)
        # along the column of the weights
        return total([product(b(0, 0), minor_of_two(1, 2, i + 1, j + 1)),
                      [-x for x in product(b(1, 0), minor_of_two(0, 2, i + 1, j + 1))],
                      product(b(2, 0), minor_of_two(0, 1, i + 1, j + 1))])

    def at(self, u):
        speed = sum(value(p, u) ** 2 for p in self.t)
        require(speed, f"evidence.u: D vanishes at {shown(u)}")
        return self.factor * Fraction(sum(value(p, u) ** 2 for p in self.h) * value(self.rest, u), speed ** 3)

    def require_regular(self, where):
        used = [k for k, column in enumerate(zip(*self.t)) if any(column)]
        inside = [p[used[0]:used[-1] + 1] for p in self.t]
        self.halve(total([product(p, p) for p in inside]), True, where)

    def require_bound(self, upper, where):
        speed = power(total([product(p, p) for p in self.t]), 3)
        bend = product(total([product(p, p) for p in self.h]), self.rest) if self.h else [0] * len(speed)
        a, b = upper.numerator * self.factor.denominator, upper.denominator * self.factor.numerator
        self.halve([a * x - b * y for x, y in zip(speed, bend)], False, where)

    @staticmethod
    def halve(polynomial, strict, where):
        coefficients, _ = unscaled([(x,) for x in polynomial])
        require_by_halving([c for c, in coefficients], strict, where)
