"""The claim `values`: results of the basic operations (FORMAT.md §15).

Points are found by de Casteljau, derivatives by Leibniz' rule from differences of control points, curvature and torsion from the
derivatives by definition; two curves are the same when they agree at more parameters of each common interval than the degree of
the polynomial X·v − Y·w.
"""

import itertools
import math
from collections import Counter
from fractions import Fraction

import values_distance
from curvature import not_negative
from curve import curve_block, read_chain, split_at
from document import BinaryReader, Reject, anything, expect, items, natural, number, record, require, shown, text, variant

PARAMETER_BITS = 4096
MOST_ENTRIES = 65_536
MOST_TOKENS = 4_194_304
UP_TO_64 = natural(1, 64)


def parameter(value, where):
    return number(value, where, PARAMETER_BITS)


def curve(value, where):
    """The chain of a curve in an entry."""
    try:
        return read_chain(BinaryReader(curve_block(value)))
    except Reject as error:
        raise Reject(f"{where}: {error}") from None


POSITION, SIDE = items(number, most=3), text("left", "right")
BOUNDS = {"lower_squared": not_negative, "upper_squared": not_negative}
ENTRY = variant("operation", {
    "point": {"parameter": parameter, "point": POSITION},
    "derivative": {"parameter": parameter, "order": UP_TO_64, "side": SIDE, "vector": POSITION},
    "curvature": {"parameter": parameter, "side": SIDE, "value_squared": not_negative},
    "torsion": {"parameter": parameter, "side": SIDE, "value": number},
    "insert_knot": {"parameter": parameter, "times": UP_TO_64, "curve": curve},
    "remove_knot": {"parameter": parameter, "times": UP_TO_64, "curve": curve},
    "elevate_degree": {"times": UP_TO_64, "curve": curve},
    "split": {"parameter": parameter, "curves": items(curve, 2)},
    "decompose": {"curve": curve},
    "nearest_point": {"target": POSITION, **BOUNDS},
    "curve_distance": {"other": curve, **BOUNDS}})
STATEMENT = {"entries": items(ENTRY, most=MOST_ENTRIES)}
WITNESSES = {"nearest_point": record({"parameter": parameter}),
             "curve_distance": record({"parameters": items(parameter, 2), "tree": anything})}


def evidence_of(statement):
    needing = [e["operation"] for e in statement["entries"] if e["operation"] in WITNESSES]

    def witnesses(value, where):
        found = items(anything, len(needing))(value, where)
        return [WITNESSES[operation](x, f"{where}[{i}]") for i, (operation, x) in enumerate(zip(needing, found))]
    return record({"witnesses": witnesses})


def check(chain, statement, evidence, _block):
    trees = [w["tree"] for w in evidence["witnesses"] if w.get("tree") is not None]
    expect(all(isinstance(tree, list) for tree in trees), "evidence.witnesses", "trees that are lists or null")
    count = sum(len(tree) for tree in trees)
    expect(count <= MOST_TOKENS, "evidence.witnesses", f"at most {MOST_TOKENS} tokens", count)
    located, witnesses = Located(chain), iter(evidence["witnesses"])
    for i, entry in enumerate(statement["entries"]):
        where, operation = f"statement.entries[{i}]", entry["operation"]
        arguments = [next(witnesses)] if operation in WITNESSES else []
        CHECKS[operation](located, entry, *arguments, where)
    return {"entries": len(statement["entries"])}


def sentence(statement):
    """An accepted statement in words."""
    return f"exact results of {statement['entries']} operations, curve {statement['curve_sha256']}"


# ---------------------------------------------------------------- the curve by its knots


class Located:
    """A chain with the ends of its pieces; degree and knots if it is, or counts as, a B-spline."""

    def __init__(self, chain, ends=None):
        self.chain, self.pieces, self.dimension = chain, [p.points for p in chain.pieces], chain.dimension
        source = chain.source
        if source.knots is not None:
            self.degree, self.knots = source.degree, [Fraction(k, source.knot_scale) for k in source.knots]
            own = sorted(set(self.knots[self.degree:len(self.knots) - self.degree]))
        else:
            own = [Fraction(i) for i in range(chain.size + 1)]
            self.degree = len(self.pieces[0]) - 1 if chain.size == 1 else None
            self.knots = [Fraction(i) for i in (0, 1) for _ in self.pieces[0]] if chain.size == 1 else None
        self.ends = own if ends is None else ends

    def piece(self, t, side, where):
        """The homogeneous control points on one side of t, the local parameter, and the length of the interval."""
        for (low, high), points in zip(itertools.pairwise(self.ends), self.pieces):
            if low <= t < high if side == "right" else low < t <= high:
                return points, (t - low) / (high - low), high - low
        raise Reject(f"{where}.parameter: expected a piece on the side '{side}', found {shown(t)}")

    def point(self, t, where):
        points, u, _ = self.piece(t, "right" if t == self.ends[0] else "left", where)
        return affine(split_at(points, u)[0][-1], self.dimension)

    def derivatives(self, t, side, order, where):
        """c, c', …, up to the order, with respect to t."""
        row, u, length = self.piece(t, side, where)
        n, lifted = len(row) - 1, []
        for k in range(order + 1):
            if k > n:
                lifted.append((Fraction(0),) * 4)
                continue
            value = split_at(row, u)[0][-1]
            factor = Fraction(math.perm(n, k), u.denominator ** (n - k))
            lifted.append([factor * x for x in value])
            row = [tuple([y - x for x, y in zip(p, q)]) for p, q in zip(row, row[1:])]
        found = []
        for k, value in enumerate(lifted):
            rest = [value[a] - sum(math.comb(k, i) * lifted[i][3] * found[k - i][a] for i in range(1, k + 1))
                    for a in range(3)]
            found.append([x / lifted[0][3] for x in rest])
        return [[x / length ** k for x in v] for k, v in enumerate(found)]

    def require_inside(self, t, where):
        expect(self.ends[0] < t < self.ends[-1], f"{where}.parameter", "a parameter inside the domain", t)

    def require_spline(self, where):
        require(self.knots is not None, f"{where}: expected a B-spline or one Bézier piece, found several pieces")


def affine(point, dimension):
    return [Fraction(x, point[3]) for x in point[:dimension]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[i] * b[j] - a[j] * b[i] for i, j in ((1, 2), (2, 0), (0, 1))]


def coordinates(position, located, where):
    expect(len(position) == located.dimension, where, f"{located.dimension} coordinates", len(position))
    return position


# ---------------------------------------------------------------- operations with numbers for results


def check_point(located, entry, where):
    stated = coordinates(entry["point"], located, where)
    exact = located.point(entry["parameter"], where)
    require(stated == exact, f"{where}.point: expected {', '.join(map(shown, exact))}")


def check_derivative(located, entry, where):
    stated = coordinates(entry["vector"], located, where)
    exact = located.derivatives(entry["parameter"], entry["side"], entry["order"], where)[-1][:located.dimension]
    require(stated == exact, f"{where}.vector: expected {', '.join(map(shown, exact))}")


def check_curvature(located, entry, where):
    _, first, second = located.derivatives(entry["parameter"], entry["side"], 2, where)
    require(any(first), f"{where}: the derivative is zero")
    turn = cross(first, second)
    exact = dot(turn, turn) / dot(first, first) ** 3
    expect(entry["value_squared"] == exact, f"{where}.value_squared", shown(exact), entry["value_squared"])


def check_torsion(located, entry, where):
    expect(located.dimension == 3, where, "a curve in space")
    _, first, second, third = located.derivatives(entry["parameter"], entry["side"], 3, where)
    turn = cross(first, second)
    require(any(turn), f"{where}: the first two derivatives are dependent")
    exact = dot(turn, third) / dot(turn, turn)
    expect(entry["value"] == exact, f"{where}.value", shown(exact), entry["value"])


# ---------------------------------------------------------------- operations with curves for results


def check_insertion(located, entry, where):
    located.require_spline(where)
    t = entry["parameter"]
    expect(located.ends[0] <= t <= located.ends[-1], f"{where}.parameter", "a parameter of the domain", t)
    require_result(located, entry["curve"], located.degree, sorted(located.knots + [t] * entry["times"]), where)


def check_removal(located, entry, where):
    located.require_spline(where)
    t, times = entry["parameter"], entry["times"]
    located.require_inside(t, where)
    expect(located.knots.count(t) >= times, where, f"a knot that occurs {times} times", located.knots.count(t))
    first = located.knots.index(t)
    require_result(located, entry["curve"], located.degree, located.knots[:first] + located.knots[first + times:], where)


def check_elevation(located, entry, where):
    located.require_spline(where)
    p, times, knots = located.degree, entry["times"], located.knots
    before, behind = len(set(knots[:p + 1])) - 1, len(set(knots[len(knots) - p - 1:])) - 1
    more = sorted(knots + list(Counter(knots)) * times)
    require_result(located, entry["curve"], p + times, more[before * times:len(more) - behind * times], where)


def check_split(located, entry, where):
    located.require_spline(where)
    t, p, knots = entry["parameter"], located.degree, located.knots
    located.require_inside(t, where)
    ends = [t] * (p + 1)
    wanted = [[k for k in knots if k < t] + ends, ends + [k for k in knots if k > t]]
    for result, knots in zip(entry["curves"], wanted):
        require_result(located, result, p, knots, where)


def check_decomposition(located, entry, where):
    located.require_spline(where)
    result = entry["curve"]
    require(result.source.knots is None, f"{where}.curve: expected Bézier pieces")
    degrees = [len(points) for points in located.pieces]
    expect([len(p.points) for p in result.pieces] == degrees, f"{where}.curve", f"{len(degrees)} pieces of the degree")
    require_same(located, Located(result, located.ends), where)


def require_result(located, result, degree, knots, where):
    found = Located(result)
    require(result.source.knots is not None, f"{where}: expected a B-spline")
    expect(found.degree == degree, f"{where}: result", f"degree {degree}", found.degree)
    require(found.knots == knots, f"{where}: result: expected other knots")
    require_same(located, found, where)


def require_same(located, result, where):
    expect(result.dimension == located.dimension, f"{where}: result", "the same dimension", result.dimension)
    inside = located.ends[0] <= result.ends[0] and result.ends[-1] <= located.ends[-1]
    require(inside, f"{where}: result: expected a domain inside that of the curve")
    cuts = sorted({*result.ends, *(t for t in located.ends if result.ends[0] < t < result.ends[-1])})
    for low, high in itertools.pairwise(cuts):
        sides = [(side.piece(low, "right", where), side.piece(high, "left", where)) for side in (located, result)]
        steps = sum(len(points) - 1 for (points, _, _), _ in sides)  # the degree of X·v − Y·w
        for k in range(steps + 1):
            share = Fraction(k, steps)
            p, q = (split_at(points, u + (v - u) * share)[0][-1] for (points, u, _), (_, v, _) in sides)
            same = all(x * q[3] == y * p[3] for x, y in zip(p[:3], q[:3]))
            require(same, f"{where}: result: another curve between {shown(low)} and {shown(high)}")


# ---------------------------------------------------------------- distances


def check_nearest(located, entry, witness, where):
    q = coordinates(entry["target"], located, f"{where}.target")
    found = squared(located.point(witness["parameter"], where), q)
    expect(found <= entry["upper_squared"], f"{where}.upper_squared", f"at least {shown(found)}", entry["upper_squared"])
    for i, points in enumerate(located.pieces):
        values_distance.require_far(points, q, entry["lower_squared"], f"{where}.lower_squared, piece {i}")


def check_distance(located, entry, witness, where):
    other, lower = Located(entry["other"]), entry["lower_squared"]
    expect(other.dimension == located.dimension, f"{where}.other", "the same dimension", other.dimension)
    s, t = witness["parameters"]
    found = squared(located.point(s, where), other.point(t, where))
    expect(found <= entry["upper_squared"], f"{where}.upper_squared", f"at least {shown(found)}", entry["upper_squared"])
    tree = witness["tree"]
    expect((tree is None) == (lower == 0), f"{where}", "a tree when and only when lower_squared is not 0")
    if tree is not None:
        values_distance.replay(tree, [located, other], lower, where)


def squared(p, q):
    return sum((x - y) ** 2 for x, y in zip(p, q))


CHECKS = {"point": check_point, "derivative": check_derivative, "curvature": check_curvature, "torsion": check_torsion,
          "insert_knot": check_insertion, "remove_knot": check_removal, "elevate_degree": check_elevation,
          "split": check_split, "decompose": check_decomposition, "nearest_point": check_nearest,
          "curve_distance": check_distance}
