"""Interval branch and bound with Codac: its contractor on both equations, bisection, interval Newton for each solution.

The contractor, the functions and their derivatives are Codac's (C++), the loop is Python.
"""

from codac import AnalyticFunction, CtcInverse, Interval, IntervalVector, VectorVar, sqrt, vec
from math import inf, nextafter

from pairs import Found, batches, trivial_corners

PROVES = "boxes, each with one double normal; the regions discarded are not recorded"
# Boxes are given up below this width.
LEAST = 1e-9
# Interval Newton is tried below this width.
NEWTON = 0.05
UNIT = Interval(0, 1)


def enclosure(x):
    """The narrowest interval around an exact number."""
    near = float(x)
    return Interval(near if near <= x else nextafter(near, -inf), near if near >= x else nextafter(near, inf))


def prepare(chain):
    """Enclosures of the power coefficients, [piece][axis][power], and of those of the derivative."""
    power = [
        [[enclosure(coefficient[axis]) for coefficient in piece] for axis in range(len(piece[0]))]
        for piece in chain.power
    ]
    derivative = [[[Interval(k) * a[k] for k in range(1, len(a))] for a in piece] for piece in power]
    return power, derivative


def horner(coefficients, t):
    """Value of a polynomial at an interval or an expression."""
    result = coefficients[-1]
    for coefficient in coefficients[-2::-1]:
        result = result * t + coefficient
    return result


def equations(power, derivative, i, j):
    """Both equations as one Codac function; for one piece the chord is divided by s − t."""
    x = VectorVar(2)
    f = g = None
    for a, b, da, db in zip(power[i], power[j], derivative[i], derivative[j]):
        if i == j:
            chord = horner([horner(a[m + 1 :], x[1]) for m in range(len(a) - 1)], x[0])
        else:
            chord = horner(a, x[0]) - horner(b, x[1])
        left, right = chord * horner(da, x[0]), chord * horner(db, x[1])
        f, g = (left, right) if f is None else (f + left, g + right)
    return AnalyticFunction([x], vec(f, g))


def newton(function, box):
    """The Newton image of a box, by Cramer's rule; None when the Jacobian may be singular."""
    jacobian = function.diff(box)
    fs, ft, gs, gt = jacobian[0, 0], jacobian[0, 1], jacobian[1, 0], jacobian[1, 1]
    determinant = fs * gt - ft * gs
    if determinant.contains(0):
        return None
    middle = box.mid()
    value = function.eval(IntervalVector(middle))
    return IntervalVector(
        [
            Interval(middle[0]) - (gt * value[0] - ft * value[1]) / determinant,
            Interval(middle[1]) - (fs * value[1] - gs * value[0]) / determinant,
        ]
    )


def only_solution(function, box):
    """A tight box around the only solution in and around `box`, "none" when there is none, or None."""
    wide = IntervalVector(box).inflate(0.1 * box.max_diam() + 1e-9)
    image = newton(function, wide)
    if image is None:
        return None
    if (image & wide).is_empty():
        return "none"
    if not image.is_strict_interior_subset(wide):
        return None
    for _ in range(8):
        tighter = newton(function, image)
        if tighter is None or not (tighter & image).max_diam() < image.max_diam():
            break
        image = tighter & image
    return image


def straight(derivative, ranges):
    """Whether all tangents of these (piece, parameter range) make acute angles with each other."""
    total = Interval(0)
    for axis in range(len(derivative[0])):
        hull = None
        for piece, parameters in ranges:
            values = horner(derivative[piece][axis], parameters)
            hull = values if hull is None else hull | values
        total = total + hull * Interval(hull)
    return total.lb() > 0


def distance(power, i, j, s, t):
    """The length of the chord."""
    square = Interval(0)
    for a, b in zip(power[i], power[j]):
        chord = horner(a, s) - horner(b, t)
        square = square + chord * chord
    return sqrt(square)


def around(box, i, j, corners):
    """Parameter ranges that contain the box and connect its two points along the curve, or nothing."""
    if i == j:
        return [(i, box[0] | box[1])]
    for s, t in corners:
        return [(i, box[0] | Interval(s)), (j, box[1] | Interval(t))]
    return []


def find(chain, prepared):
    """All double normals of the pairs examined, and the boxes that stayed undecided."""
    power, derivative = prepared
    found = Found(chain)
    undecided = boxes = 0
    width = 0.0
    for batch in batches(chain, found, size=64):
        for i, j, apart in zip(*(column.tolist() for column in batch)):
            if apart >= found.bound():
                break
            function = equations(power, derivative, i, j)
            contractor = CtcInverse(function, [[0, 0], [0, 0]])
            corners = trivial_corners(chain, i, j)
            stack = [IntervalVector([[0, 1], [0, 1]])]
            while stack:
                box = stack.pop()
                boxes += 1
                contractor.contract(box)
                if box.is_empty() or (i == j and box[0].lb() >= box[1].ub()):
                    continue
                ranges = around(box, i, j, corners)
                if ranges and straight(derivative, ranges):
                    continue
                if box.max_diam() < NEWTON:
                    solution = only_solution(function, box)
                    if isinstance(solution, IntervalVector):
                        s, t = solution[0], solution[1]
                        length = distance(power, i, j, s, t)
                        inside = all(x.intersects(UNIT) for x in (s, t))
                        if inside and (i != j or s.mid() < t.mid()):
                            found.add(length.mid(), i + s.mid(), j + t.mid())
                            sure = all(x.is_subset(UNIT) for x in (s, t))
                            found.enclose(length.lb(), length.ub() if sure else None)
                            width = max(width, length.diam())
                    if solution is not None:
                        continue
                if box.max_diam() < LEAST:
                    undecided += 1
                    found.enclose(distance(power, i, j, box[0], box[1]).lb())
                    continue
                stack.extend(box.bisect_largest())
    found.note = f"{boxes} boxes, widths up to {width:.0e}" + (f", {undecided} undecided" if undecided else "")
    return found
