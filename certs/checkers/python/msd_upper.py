"""The claim `msd`: the rules for the upper bound (FORMAT.md §6).  Each rule is a function of its fields."""

import itertools
import math
from fractions import Fraction

from curve import difference, dot
from document import Reject, expect, integer, items, natural, number, require, shown, text, variant

MAX_SUBSECTIONS = 1_024


def check(chain, rule, upper, critical):
    """Check the rule for the bound upper_squared."""
    parameter, interval = readers(chain)
    pair, vector, side = items(integer, 2), items(integer, chain.dimension), text("after", "before")
    rules = {
        "miranda": {"s": interval, "t": interval, "first": pair, "second": pair, "regular": items(vector, 2),
                    "subdivisions": natural(1, MAX_SUBSECTIONS)},
        "root": {"s": parameter, "s_side": side, "t": parameter, "t_side": side},
        "touch": {"s": parameter, "t": parameter},
        "crossing": {"s": interval, "t": interval, "first": pair, "second": pair},
    }
    if critical:
        rules["critical_root"] = {"s": parameter, "t": parameter}
        rules["critical_interval"] = {"s": parameter, "t": interval, "regular": vector}
    fields = variant("rule", rules)(rule, "upper")
    require_order(chain, fields["s"], fields["t"])
    if rule["rule"] == "miranda" and not critical:
        for place in fields["s"], fields["t"]:
            place.require_smooth()
    CHECKS[fields.pop("rule")](chain, upper, **fields)


def readers(chain):
    """The readers of a parameter and of an interval of the curve."""
    def parameter(value, where):
        s = number(value, where)
        expect(0 <= s <= chain.size and not (chain.closed and s == chain.size), where, "a parameter of the curve", s)
        return s

    return parameter, lambda value, where: Interval(chain, where, *items(number, 2)(value, where))


def require_order(chain, s, t):
    """Two intervals are disjoint and in order, two parameters different and in order."""
    if isinstance(s, Interval):
        disjoint = s.end < t.start and not (chain.closed and t.end >= s.start + chain.size)
        require(disjoint, "upper: expected disjoint intervals in order, found others")
    elif not isinstance(t, Interval):
        expect(s < t, "upper", "s < t", [str(s), str(t)])


class Interval:
    """[s0, s1] with the arcs on its sections, and the points and D at its two ends."""

    def __init__(self, chain, where, s0, s1):
        self.where, self.start, self.end, size = where, s0, s1, chain.size
        expect(0 <= s0 < s1 <= s0 + 1 and s0 < size and (s1 <= size or chain.closed), where,
               "0 ≤ s₀ < s₁ ≤ s₀ + 1 on the curve", [str(s0), str(s1)])
        inside = Fraction(math.floor(s0) + 1)
        cuts = [s0, inside, s1] if inside < s1 else [s0, s1]
        self.corners = [s % size for s in cuts[1:-1] if chain.is_corner(s % size)]
        self.arcs = [chain.pieces[math.floor(a) % size].restricted(a - math.floor(a), b - math.floor(a))
                     for a, b in zip(cuts, cuts[1:])]
        self.points = [p for arc in self.arcs for p in arc.points]
        first, last = self.arcs[0], self.arcs[-1]
        self.ends = (first.points[0], first.d[0]), (last.points[-1], last.d[-1])

    def require_smooth(self):
        for corner in self.corners:
            raise Reject(f"{self.where}: the joint {corner} inside is a corner")

    def require_regular(self, m):
        """m·v > 0 for all tangents."""
        holds = all(dot((*m, 0), v) > 0 for arc in self.arcs for v in arc.d)
        require(holds, f"{self.where}: expected m·v > 0 for all tangents, found a value ≤ 0")

    def require_signs(self, other, n):
        """n·(end of this one − q) is negative at the start and positive at the end for all points q of the other interval."""
        for (end, _), sign, wish in zip(self.ends, (-1, 1), "<>"):
            if not all(sign * dot(n, difference(end, q)) > 0 for q in other.points):
                raise Reject(f"{self.where}: expected a value {wish} 0 on this edge, found another sign")

    def require_products(self, other, count, orientation, alpha, beta):
        """orientation·(end − c)·(α D(end) + β D) is negative at the start and positive at the end, by Bernstein coefficients.

        c and D run over each of `count` equal sub-sections of every section of the other interval.
        """
        for arc, i in itertools.product(other.arcs, range(count)):
            points, d = arc.restricted(Fraction(i, count), Fraction(i + 1, count))
            for (end, (x, y, z, scale)), sign, wish in zip(self.ends, (-orientation, orientation), "<>"):
                chords = [difference(end, q) for q in points]
                rows = [[alpha * v[3] * a + beta * scale * b for a, b in zip((x, y, z), v)] for v in d]
                values = [0] * (len(chords) + len(rows) - 1)
                for (j, chord), (k, row) in itertools.product(enumerate(chords), enumerate(rows)):
                    values[j + k] += math.comb(len(chords) - 1, j) * math.comb(len(rows) - 1, k) * dot(chord, row)
                if not all(sign * value > 0 for value in values):
                    raise Reject(f"{self.where}: expected a value {wish} 0 on this edge, found another sign")


def require_short(points, others, upper):
    wish = f"squared lengths ≤ {shown(upper)}"
    for p, q in itertools.product(points, others):
        x = difference(p, q)
        found = Fraction(dot(x, x), (p[3] * q[3]) ** 2)
        expect(found <= upper, "upper", wish, found)


def miranda(_chain, upper, s, t, first, second, regular, subdivisions):
    (alpha1, beta1), (alpha2, beta2) = first, second
    s.require_regular(regular[0])
    t.require_regular(regular[1])
    require(alpha1 * beta2 != alpha2 * beta1, "upper: expected α₁β₂ ≠ α₂β₁, found equality")
    s.require_products(t, subdivisions, 1, alpha1, beta1)
    t.require_products(s, subdivisions, -1, beta2, alpha2)
    require_short(s.points, t.points, upper)


def crossing(chain, _upper, s, t, first, second):
    expect(chain.dimension == 2, "upper, rule 'crossing'", "a curve in the plane", chain.dimension)
    require(first[0] * second[1] != first[1] * second[0], "upper: the two vectors are linearly dependent")
    n1, n2 = (*first, 0), (*second, 0)
    s.require_signs(t, n1)
    t.require_signs(s, [-x for x in n2])


def root(chain, upper, s, s_side, t, t_side):
    sides, located = (chain.sides(s), chain.sides(t)), []
    for found, side, name in zip(sides, (s_side, t_side), "st"):
        located.append(found[text(*found)(side, f"upper.{name}_side")])
    p, q = (piece.point(u) for piece, u in located)
    for name, (piece, u) in zip("st", located):
        product = dot(difference(p, q), piece.direction(u))
        require(product == 0, f"upper: the chord is not orthogonal to the direction at {name}")
    require_short([p], [q], upper)


def touch(chain, _upper, s, t):
    require(not any(difference(chain.place(s), chain.place(t))), "upper: the points at s and t differ")


def is_critical(chain, s, x):
    """Is the chord x = (other end) − c(s) critical at s (§4)?"""
    products = [dot(x, v) for v in chain.directions(s)]
    if chain.is_end(s):
        return products[0] <= 0 if s == 0 else products[0] >= 0
    if chain.is_corner(s):
        return products[0] * products[1] <= 0
    return products[-1] == 0


def critical_root(chain, upper, s, t):
    p, q = chain.place(s), chain.place(t)
    require(is_critical(chain, s, difference(q, p)), "upper: the chord is not critical at s")
    require(is_critical(chain, t, difference(p, q)), "upper: the chord is not critical at t")
    require_short([p], [q], upper)


def critical_interval(chain, upper, s, t, regular):
    expect(chain.is_end(s) or chain.is_corner(s), "upper.s", "the parameter of a corner or an end", s)
    around = chain.closed and t.start <= s + chain.size <= t.end
    require(not (t.start <= s <= t.end or around), "upper.t: the interval contains s")
    t.require_smooth()
    t.require_regular(regular)
    e = chain.place(s)
    chords = [difference(q, e) for q in t.points]
    if chain.is_end(s):
        critical = all(is_critical(chain, s, x) for x in chords)
    else:
        a, b = chain.directions(s)
        critical = any(all(sign * dot(x, a) >= 0 >= sign * dot(x, b) for x in chords) for sign in (1, -1))
    require(critical, "upper: not every chord is seen to be critical at s")
    signs = [dot(difference(point, e), d) for point, d in t.ends]
    require(min(signs) < 0 < max(signs), "upper: expected opposite signs at the ends of the interval")
    require_short([e], t.points, upper)


CHECKS = {rule.__name__: rule for rule in (miranda, root, touch, crossing, critical_root, critical_interval)}
