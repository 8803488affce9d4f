"""Newton's method on the two equations of a double normal (Moore, Peters 2006), vectorised over pairs and seeds."""

import numpy as np

from pairs import Found, batches, padded

PROVES = "nothing"
SEEDS = np.linspace(0.1, 0.9, 9)


def power_arrays(chain):
    """Coefficients [derivative][power][axis, piece] of the pieces as binary64, degrees padded with zeros."""
    most = max(map(len, chain.power))
    power = np.zeros((most, len(chain.power[0][0]), len(chain)))
    for i, piece in enumerate(chain.power):
        for k, coefficient in enumerate(piece):
            power[k, :, i] = [float(x) for x in coefficient]
    first = np.array([k * power[k] for k in range(1, most)])
    second = np.array([k * first[k] for k in range(1, most - 1)] or [0 * power[0]])
    return power, first, second


def horner(coefficients, piece, t):
    """Value at t of the polynomials of these pieces, one axis a row."""
    value = coefficients[-1][:, piece]
    for row in coefficients[-2::-1]:
        value = value * t + row[:, piece]
    return value


def prepare(chain):
    """Binary64 coefficients and the size of the chain."""
    extent = padded(chain.bezier).reshape(-1, len(chain.bezier[0][0]))
    return power_arrays(chain), float(np.ptp(extent, axis=0).max())


def find(chain, prepared):
    """Double normals from 9×9 seeds in each pair of pieces."""
    (c, d, dd), scale = prepared
    found = Found(chain)
    for i, j, _ in batches(chain, found):
        s, t = (grid.ravel() for grid in np.meshgrid(SEEDS, SEEDS, indexing="ij"))
        pair = np.repeat(np.arange(len(i)), len(s))
        a, b = i[pair], j[pair]
        s, t = np.tile(s, len(i)), np.tile(t, len(i))
        # The same piece twice: half of the square, without its diagonal.
        seeds = (a != b) | (s < t - 0.05)
        a, b, s, t = a[seeds], b[seeds], s[seeds], t[seeds]
        for _ in range(30):
            chord = horner(c, a, s) - horner(c, b, t)
            ds, dt = horner(d, a, s), horner(d, b, t)
            f, g = (chord * ds).sum(axis=0), (chord * dt).sum(axis=0)
            cross = (ds * dt).sum(axis=0)
            fs = (chord * horner(dd, a, s)).sum(axis=0) + (ds * ds).sum(axis=0)
            gt = (chord * horner(dd, b, t)).sum(axis=0) - (dt * dt).sum(axis=0)
            with np.errstate(all="ignore"):
                determinant = fs * gt + cross * cross
                step_s = (f * gt + g * cross) / determinant
                step_t = (fs * g - cross * f) / determinant
                s, t = s - step_s, t - step_t
                size = np.maximum(np.abs(step_s), np.abs(step_t))
                inside = (np.abs(s - 0.5) < 1.0) & (np.abs(t - 0.5) < 1.0)
            for k in np.flatnonzero(inside & (size < 1e-12)):
                if -1e-9 <= min(s[k], t[k]) and max(s[k], t[k]) <= 1 + 1e-9:
                    record(found, c, scale, a[k], b[k], s[k], t[k])
            live = inside & (size >= 1e-12)
            a, b, s, t = a[live], b[live], s[live], t[live]
            if not len(a):
                break
    return found


def record(found, c, scale, a, b, s, t):
    """Adds a converged solution unless it is the trivial one, a chord of length zero."""
    s, t = min(max(s, 0.0), 1.0), min(max(t, 0.0), 1.0)
    length = float(np.linalg.norm(horner(c, a, s) - horner(c, b, t)))
    if length > 1e-6 * scale:
        found.add(length, float(a + s), float(b + t))
