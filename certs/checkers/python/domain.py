"""The claim `domain`: its statement, its outcomes and their obligations (FORMAT.md §9)."""

import math
from collections import Counter
from fractions import Fraction

from document import expect, integer, items, natural, number, record, require, shown, text, unless, variant
from domain_sign import At, Domain, at, differences, is_polynomial

MAX_COUNT = 4_194_304  # points, cells and rows together
PARAMETER_BITS = 4096


def boolean(value, where):
    expect(isinstance(value, bool), where, "true or false", value)
    return value


def within(reader, low, strict=False):
    """A reader of a number ≥ low, or > low."""
    def read(value, where):
        found = reader(value, where)
        expect(found > low if strict else found >= low, where, f"a number {'>' if strict else '≥'} {low}", found)
        return found
    return read


def row(value, where):
    return (POINT_ROW if isinstance(value, dict) and "piece" in value else SIDE_ROW)(value, where)


def parameter(value, where):
    """The reader of a parameter, short enough for powers of it."""
    return number(value, where, PARAMETER_BITS)


INDEX = natural(0, (1 << 32) - 1)
POINT_ROW = record({"piece": INDEX, "u": parameter})
SIDE_ROW = record({"axis": INDEX, "side": text("low", "high")})
ROWS = items(row, most=MAX_COUNT)
NOT_NEGATIVE = within(number, 0)
SQUARED_BOUNDS = {"lower_squared": NOT_NEGATIVE, "upper_squared": number}
OUTCOMES = {
    "sandwich": {"inner_measure": within(number, 0, strict=True), "outer_measure": number},
    "empty": {},
    "nearest": {"to": unless("fair", items(number)), **SQUARED_BOUNDS},
    "change": {"from": items(number), **SQUARED_BOUNDS},
    "ball": {"lower": within(number, 0, strict=True), "upper": number},
}
STATEMENT = {"points": items(INDEX), "sign": text("+", "-"), "interval": items(parameter, 2), "open": items(boolean, 2),
             "box": items(items(number), 2), "outcome": variant("kind", OUTCOMES)}


def evidence_of(statement):
    """The reader of the evidence; it depends on the outcome and on the dimension (that of the box)."""
    d = len(statement["box"][0])
    grid_point, place = items(integer, d), items(number, d)
    points = {"points": items(grid_point, most=MAX_COUNT)}
    combination = {"rows": ROWS, "multipliers": items(NOT_NEGATIVE)}
    return record({
        "sandwich": {"denominator": within(integer, 1), "center": grid_point, "rows": ROWS,
                     "inner": record({**points, "cells": items(items(INDEX, d), most=MAX_COUNT)}),
                     "outer": record({**points, "cells": items(items(INDEX, d + 1), most=MAX_COUNT)})},
        "empty": {"rows": ROWS, "multipliers": items(within(integer, 0))},
        "nearest": {"center": place, "point": place, "base": place, **combination},
        "change": {"row": row},
        "ball": {"center": place, **combination, "lengths": items(NOT_NEGATIVE)},
    }[statement["outcome"]["kind"]])


def check(chain, statement, evidence, _block):
    """Check the claim; the figures are the numbers of sections and of rows."""
    domain, outcome = Domain(chain, statement), statement["outcome"]
    rows = [domain.row(value, f"evidence: row {i}") for i, value in enumerate(evidence.get("rows", []))]
    {"sandwich": sandwich, "empty": empty, "nearest": nearest, "change": change, "ball": ball}[outcome["kind"]](
        domain, outcome, evidence, rows)
    return {"sections": len(domain.sections), "rows": len(rows)}


def sentence(statement):
    """An accepted statement in words."""
    outcome = statement["outcome"]
    between = "{} in [{}, {}]".format
    words = {
        "sandwich": lambda: between("measure of K in the box", outcome["inner_measure"], outcome["outer_measure"]),
        "empty": lambda: "K in the box is empty",
        "nearest": lambda: between(f"squared distance of K in the box from {position(outcome['to'])}",
                                   outcome["lower_squared"], outcome["upper_squared"]),
        "change": lambda: between(f"squared distance from {position(outcome['from'])} to the complement of K",
                                  outcome["lower_squared"], outcome["upper_squared"]),
        "ball": lambda: between("radius of the largest ball in K in the box", outcome["lower"], outcome["upper"]),
    }[outcome["kind"]]()
    return (f"{words}, points {', '.join(map(str, statement['points']))}, sign {statement['sign']}, "
            f"{statement['sections']} sections, {statement['rows']} rows, curve {statement['curve_sha256']}")


def position(value):
    return "the fair point" if value == "fair" else f"({', '.join(value)})"


# ---------------------------------------------------------------- sandwich


def sandwich(domain, outcome, evidence, rows):
    q, inner, outer = evidence["denominator"], evidence["inner"], evidence["outer"]
    count = len(evidence["rows"]) + sum(len(star[name]) for star in (inner, outer) for name in ("points", "cells"))
    expect(count <= MAX_COUNT, "evidence", f"at most {MAX_COUNT} points, cells and rows", count)
    center = At(tuple(evidence["center"]), q)
    domain.require_in_box(center, "center")
    domain.require_in_k(center, "center")
    for i, point in enumerate(inner["points"]):
        domain.require_in_box(At(point, q), f"inner point {i}")
        domain.require_in_closure(At(point, q), f"inner point {i}")
    unit = math.factorial(domain.dimension) * q ** domain.dimension
    found = Fraction(star(center.numerators, inner["points"], inner["cells"], "inner"), unit)
    expect(found >= outcome["inner_measure"], "inner", f"a measure ≥ {shown(outcome['inner_measure'])}", found)
    cells = [cell[:-1] for cell in outer["cells"]]
    found = Fraction(star(center.numerators, outer["points"], cells, "outer"), unit)
    expect(found <= outcome["outer_measure"], "outer", f"a measure ≤ {shown(outcome['outer_measure'])}", found)
    for i, (*cell, number_of_row) in enumerate(outer["cells"]):
        expect(number_of_row < len(rows), f"outer cell {i}", f"a row below {len(rows)}", number_of_row)
        one = rows[number_of_row]
        require(one.sign_at(center) > 0, f"outer cell {i}: expected a row positive at the center")
        cut_off = all(one.sign_at(At(outer["points"][j], q)) <= 0 for j in cell)
        require(cut_off, f"outer cell {i}: expected a row ≤ 0 at the points of the cell")


def determinant(vectors):
    if len(vectors) == 2:
        (a, b), (c, d) = vectors
        return a * d - b * c
    (a, b, c), (d, e, f), (g, h, i) = vectors
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)


def star(center, points, cells, name):
    """The sum of the determinants of a star's cells."""
    require(cells, f"{name}: expected at least one cell")
    arms, total, edges, first_sum = [[x - c for x, c in zip(p, center)] for p in points], 0, Counter(), None
    for i, cell in enumerate(cells):
        expect(max(cell) < len(arms), f"{name} cell {i}", f"points below {len(arms)}", max(cell))
        vectors = [arms[j] for j in cell]
        found = determinant(vectors)
        expect(found > 0, f"{name} cell {i}", "a positive determinant", found)
        total += found
        if len(cell) == 2:
            edges[cell[0]] += 1
            edges[cell[1]] -= 1
        else:
            for a, b in zip(cell, [*cell[1:], cell[0]]):
                edges[min(a, b), max(a, b)] += 1 if a < b else -1
        if first_sum is None:
            first_sum = [sum(xs) for xs in zip(*vectors)]
        else:
            replaced = ([*vectors[:k], first_sum, *vectors[k + 1:]] for k in range(len(vectors)))
            require(any(determinant(v) < 0 for v in replaced), f"{name} cell {i}: it overlaps cell 0")
    open_at = next((edge for edge, count in edges.items() if count), None)
    expect(open_at is None, name, "a boundary that cancels", open_at)
    return total


# ---------------------------------------------------------------- the other outcomes


def dot(a, b):
    return sum([x * y for x, y in zip(a, b)])


def squared_distance(a, b):
    return sum((x - y) ** 2 for x, y in zip(a, b))


def combination(multipliers, rows, d):
    """The linear part and the constant of Σ multiplier·row."""
    total = [Fraction(0)] * (d + 1)
    for factor, one in zip(multipliers, rows):
        total = [t + factor * x for t, x in zip(total, [*one.gradient(), one.constant_term()])]
    return total[:-1], total[-1]


def for_each_row(values, rows, name):
    expect(len(values) == len(rows), f"evidence.{name}", f"as many as rows ({len(rows)})", len(values))
    return values


def empty(domain, _outcome, evidence, rows):
    multipliers = for_each_row(evidence["multipliers"], rows, "multipliers")
    require(any(multipliers), "multipliers: expected one that is not 0")
    linear, constant = combination(multipliers, rows, domain.dimension)
    expect(not any(linear), "multipliers", "a sum of rows that is constant", linear)
    strict = any(factor and one.strict for factor, one in zip(multipliers, rows))
    expect(constant < 0 or (constant == 0 and strict), "multipliers", "a sum < 0, or 0 with a strict row", constant)


def nearest(domain, outcome, evidence, rows):
    y, center, point, base = outcome["to"], at(evidence["center"]), at(evidence["point"]), evidence["base"]
    if y is None:
        y = fair_point(domain)
    expect(len(y) == domain.dimension, "statement.outcome.to", f"{domain.dimension} coordinates", y)
    domain.require_in_box(center, "center")
    domain.require_in_k(center, "center")
    domain.require_in_box(point, "point")
    domain.require_in_closure(point, "point")
    found = squared_distance(evidence["point"], y)
    expect(found <= outcome["upper_squared"], "point", f"|p−y|² ≤ {shown(outcome['upper_squared'])}", found)
    multipliers = for_each_row(evidence["multipliers"], rows, "multipliers")
    linear, _ = combination(multipliers, rows, domain.dimension)
    expect([z - c for z, c in zip(base, y)] == linear, "base", "z − y = Σ λ_i A_i", linear)
    z = at(base)
    found = squared_distance(base, y) - 2 * dot(multipliers, [one.value(z) for one in rows])
    expect(outcome["lower_squared"] <= found, "multipliers", f"a bound ≥ {shown(outcome['lower_squared'])}", found)


def fair_point(domain):
    d = domain.dimension
    require(all(is_polynomial(points) for points, _ in domain.pieces), "fair: expected polynomial pieces only")
    top, bottom = [Fraction(0)] * d, Fraction(0)
    for (points, _), length in zip(domain.pieces, domain.lengths):
        n, w = len(points) - 1, points[0][0]
        if n < 2:
            continue
        second = differences(differences(points))  # times the weight w: (0, S, β)
        betas = [s[-1] for s in second]
        f = Fraction((n * (n - 1)) ** 2, (2 * n - 3) * length ** 3 * w * w)
        pairing = [[Fraction(math.comb(n - 2, j) * math.comb(n - 2, k), math.comb(2 * n - 4, j + k))
                    for k in range(n - 1)] for j in range(n - 1)]
        weighted = [f * sum(b * pairing[j][k] for j, b in enumerate(betas)) for k in range(n - 1)]
        top = [t + dot(weighted, [s[a] for s in second]) for a, t in enumerate(top, 1)]
        bottom += dot(weighted, betas)
    require(bottom, "fair: expected a denominator that is not 0")
    return [-t / bottom for t in top]


def change(domain, outcome, evidence, _rows):
    expect(len(outcome["from"]) == domain.dimension, "statement.outcome.from", f"{domain.dimension} coordinates",
           outcome["from"])
    p, one = at(outcome["from"]), domain.row(evidence["row"], "evidence.row")
    domain.require_in_k(p, "from")
    domain.require_margin(p, outcome["lower_squared"], "from")
    require("piece" in evidence["row"], "evidence.row: expected a row of a piece")
    gradient = one.gradient()
    require(any(gradient), "evidence.row: expected a row that is not constant")
    found = one.value(p) ** 2 / dot(gradient, gradient)
    expect(found <= outcome["upper_squared"], "evidence.row", f"a squared distance ≤ {shown(outcome['upper_squared'])}",
           found)


def ball(domain, outcome, evidence, rows):
    lower, center = outcome["lower"], at(evidence["center"])
    for low, x, high in zip(domain.low, evidence["center"], domain.high):
        expect(low + lower <= x <= high - lower, "center", f"a distance ≥ {shown(lower)} from the sides of the box", x)
    domain.require_in_k(center, "center")
    domain.require_margin(center, lower ** 2, "center")
    multipliers = for_each_row(evidence["multipliers"], rows, "multipliers")
    lengths = for_each_row(evidence["lengths"], rows, "lengths")
    total = dot(multipliers, lengths)
    require(total, "multipliers: expected one that is not 0, with a length that is not 0")
    for i, (length, one) in enumerate(zip(lengths, rows)):
        gradient = one.gradient()
        found = dot(gradient, gradient)
        expect(length ** 2 <= found, f"length {i}", f"ℓ² ≤ A·A = {shown(found)}", length ** 2)
    linear, constant = combination(multipliers, rows, domain.dimension)
    expect(not any(linear), "multipliers", "a sum of rows that is constant", linear)
    expect(constant <= outcome["upper"] * total, "multipliers", f"a bound ≤ {shown(outcome['upper'])}",
           constant / total)
