"""scipy.optimize.root (MINPACK hybrj) with the exact Jacobian from 9×9 seeds in each pair of pieces.

The seeds are not culled: with the cosines of 0.4 proposed by Moore and Peters (2006) it misses one of the 16 double
normals of their own curve, and the shortest ones of others.
"""

from math import sqrt

from scipy.optimize import root

from pairs import Found, batches
from peer_numpy import SEEDS, prepare as prepare_numpy

PROVES = "nothing"


def prepare(chain):
    """Coefficients as plain numbers: faster than small arrays in the inner function."""
    _, scale = prepare_numpy(chain)
    return scale, [[[float(x) for x in coefficient] for coefficient in piece] for piece in chain.power]


def value(piece, t):
    """Point, first and second derivative by Horner's scheme, axis by axis."""
    rows = []
    for axis in range(len(piece[0])):
        x = dx = ddx = 0.0
        for coefficient in reversed(piece):
            ddx = ddx * t + 2 * dx
            dx = dx * t + x
            x = x * t + coefficient[axis]
        rows.append((x, dx, ddx))
    return rows


def equations(parameters, p, q):
    """Both equations and their Jacobian."""
    f = g = fs = gt = cross = 0.0
    s, t = map(float, parameters)
    for (x, dx, ddx), (y, dy, ddy) in zip(value(p, s), value(q, t)):
        chord = x - y
        f += chord * dx
        g += chord * dy
        fs += chord * ddx + dx * dx
        gt += chord * ddy - dy * dy
        cross += dx * dy
    return (f, g), ((fs, -cross), (cross, gt))


def find(chain, prepared):
    """Double normals from the seeds of each pair of pieces."""
    scale, power = prepared
    found = Found(chain)
    seeds = SEEDS.tolist()
    for batch in batches(chain, found, size=64):
        for i, j, distance in zip(*(column.tolist() for column in batch)):
            if distance >= found.bound():
                break
            # The same piece twice: half of the square, without its diagonal.
            for seed in ((s, t) for s in seeds for t in seeds if i != j or s < t - 0.05):
                solution = root(equations, seed, args=(power[i], power[j]), jac=True, tol=1e-14)
                s, t = (float(x) for x in solution.x)
                if not (-1e-9 <= min(s, t) and max(s, t) <= 1 + 1e-9):
                    continue
                # At full accuracy MINPACK reports lack of progress, so the residual decides.
                (f, g), ((fs, _), (_, gt)) = equations((s, t), power[i], power[j])
                if abs(f) > 1e-10 * abs(fs) or abs(g) > 1e-10 * abs(gt):
                    continue
                s, t = min(max(s, 0.0), 1.0), min(max(t, 0.0), 1.0)
                square = sum((x[0] - y[0]) ** 2 for x, y in zip(value(power[i], s), value(power[j], t)))
                if square > (1e-6 * scale) ** 2:
                    found.add(sqrt(square), i + s, j + t)
    return found
