"""All double normals by elimination: exact resultant (python-flint), isolation of its roots and back-substitution in
ball arithmetic (arb), each double normal confirmed by an interval Newton step.
"""

from fractions import Fraction
from math import lcm

from flint import arb, arb_poly, ctx, fmpz_mpoly_ctx, fmpz_poly

from pairs import Found, batches, trivial_corners

PROVES = "all double normals (balls); nothing to check afterwards"
BITS = 192
RING = fmpz_mpoly_ctx.get(["s", "t"], "lex")


def prepare(chain):
    """Integer power coefficients over one common denominator."""
    ctx.prec = BITS
    scale = lcm(*(x.denominator for piece in chain.power for coefficient in piece for x in coefficient))
    return scale, [
        [[int(coefficient[axis] * scale) for coefficient in piece] for axis in range(len(piece[0]))]
        for piece in chain.power
    ]


def polynomial(terms):
    """A polynomial in s and t from its coefficients by exponents."""
    return RING.from_dict({exponents: value for exponents, value in terms.items() if value})


def equations(p, q, same):
    """chord·c'(s) and chord·c'(t); for one piece the chord is divided by s − t, which removes the solution s = t."""
    f = g = polynomial({})
    for a, b in zip(p, q):
        ds = polynomial({(k - 1, 0): k * a[k] for k in range(1, len(a))})
        dt = polynomial({(0, k - 1): k * b[k] for k in range(1, len(b))})
        if same:
            chord = polynomial({(m, k): a[m + k + 1] for m in range(len(a) - 1) for k in range(len(a) - 1 - m)})
        else:
            chord = polynomial({(k, 0): x for k, x in enumerate(a)}) - polynomial({(0, k): x for k, x in enumerate(b)})
        f, g = f + chord * ds, g + chord * dt
    return f, g


class Equation:
    """A polynomial in s and t with its derivatives, to be evaluated in ball arithmetic."""

    def __init__(self, f, derivatives=True):
        table = [[0] * (f.degrees()[0] + 1) for _ in range(f.degrees()[1] + 1)]
        for (m, k), value in f.terms():
            table[k][m] = value
        self.rows = [fmpz_poly(row) for row in table]
        self.gradient = [Equation(f.derivative(k), False) for k in (0, 1)] if derivatives else []

    def at(self, s):
        """The polynomial in t left when s is put in."""
        return arb_poly([row(s) for row in self.rows])

    def __call__(self, s, t):
        return self.at(s)(t)


def univariate(f):
    """A polynomial that holds s alone."""
    coefficients = [0] * (f.degrees()[0] + 1)
    for (m, _), value in f.terms():
        coefficients[m] = value
    return fmpz_poly(coefficients)


def refined(p, t):
    """A smaller ball around the only zero of p in the ball t, where interval Newton steps give one."""
    derivative = p.derivative()
    for _ in range(8):
        slope = derivative(t)
        if slope.contains(0):
            break
        step = t.mid() - p(t.mid()) / slope
        if not step.rad() < t.rad():
            break
        t = step
    return t


def newton(f, g, x, box):
    """The Newton image of a box around the point x, by Cramer's rule; None when the Jacobian may be singular."""
    (fs, ft), (gs, gt) = ([d(*box) for d in h.gradient] for h in (f, g))
    determinant = fs * gt - ft * gs
    if determinant.contains(0):
        return None
    v, w = f(*x), g(*x)
    return x[0] - (gt * v - ft * w) / determinant, x[1] - (fs * w - gs * v) / determinant


def confirmed(f, g, x):
    """The balls of the only solution near x, or None when an interval Newton step shows no such thing."""
    x = [ball.mid() for ball in x]
    for _ in range(5):
        image = newton(f, g, x, x)
        if image is None:
            return None
        x = [ball.mid() for ball in image]
    box = [arb(ball, 2.0 ** (-BITS // 3)) for ball in x]
    image = newton(f, g, x, box)
    if image is None or not all(b.contains_interior(y) for b, y in zip(box, image)):
        return None
    return image


def solutions(f, g, corners):
    """Common zeros in the unit square other than the trivial ones, and the places where one was not confirmed."""
    eliminant = f.resultant(g, 1)
    if not eliminant:
        raise ValueError("the equations have a common factor")
    f, g = Equation(f), Equation(g)
    found, unconfirmed = [], []
    for root, _ in univariate(eliminant).complex_roots():
        s = root.real
        if not root.imag.is_zero() or s < 0 or s > 1:
            continue
        left = f.at(s)
        for root in left.complex_roots():
            t = refined(left, root.real)
            if not root.imag.contains(0) or t < 0 or t > 1 or not g(s, t).contains(0):
                continue
            if any(s.contains(a) and t.contains(b) for a, b in corners):
                continue
            balls = confirmed(f, g, (s, t))
            if balls is None:
                unconfirmed.append((s, t))
            elif not any(x < 0 or x > 1 for x in balls):
                found.append(balls)
    return found, unconfirmed


def exact(ball):
    """The number of a ball of radius 0."""
    mantissa, exponent = ball.man_exp()
    return Fraction(int(mantissa)) * Fraction(2) ** int(exponent)


def find(chain, prepared):
    """All double normals of the pairs examined; lengths and parameters are balls' midpoints."""
    scale, power = prepared
    found = Found(chain)
    unconfirmed = 0
    for batch in batches(chain, found, size=64):
        for i, j, distance in zip(*(column.tolist() for column in batch)):
            if distance >= found.bound():
                break
            f, g = equations(power[i], power[j], i == j)
            roots, doubtful = solutions(f, g, trivial_corners(chain, i, j))
            unconfirmed += len(doubtful)
            for (s, t), sure in [(x, True) for x in roots] + [(x, False) for x in doubtful]:
                if i == j and not s < t:
                    continue
                chord = [fmpz_poly(p)(s) - fmpz_poly(q)(t) for p, q in zip(power[i], power[j])]
                square = sum((x * x for x in chord), arb(0))
                # A ball around a square may reach below 0.
                low, high = ((end if end > 0 else arb(0)).sqrt() / scale for end in (square.lower(), square.upper()))
                inside = all(x >= 0 and x <= 1 for x in (s, t))
                found.enclose(exact(low.lower()), exact(high.upper()) if sure and inside else None)
                if sure:
                    found.add(low.union(high), i + s, j + t)
    found.note = f"{unconfirmed} solutions unconfirmed" if unconfirmed else ""
    return found
