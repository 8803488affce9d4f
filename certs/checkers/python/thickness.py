"""The claim `thickness`: what follows from bounds of σ and of the greatest curvature (FORMAT.md §12)."""

from fractions import Fraction

import curvature
import msd
from document import anything, expect, natural, record, require, text, unless, variant

STATEMENT = {"convention": text("smooth", "critical"), "lower_squared": unless("inf", curvature.not_negative),
             "upper_squared": unless(None, curvature.not_negative)}
CORNER = record({"corner": natural(0, (1 << 32) - 1)})


def part(claim, name):
    """The reader of the statement and the evidence of another claim."""
    outer = record({"statement": variant("claim", {name: claim.STATEMENT}), "evidence": anything})

    def read(value, where):
        found = outer(value, where)
        evidence = claim.evidence_of(found["statement"])(found["evidence"], f"{where}.evidence")
        return found["statement"], evidence
    return read


BOUNDS = record({"msd": part(msd, "msd"), "curvature": part(curvature, "curvature")})


def evidence_of(_statement):
    return lambda value, where: (CORNER if isinstance(value, dict) and "corner" in value else BOUNDS)(value, where)


def check(chain, statement, evidence, block):
    """Check the claim; `block` is the reader of the tree in the binary form."""
    lower, upper, convention = (statement[key] for key in ("lower_squared", "upper_squared", "convention"))
    expect(upper is None or (lower is not None and lower <= upper), "statement", "lower_squared ≤ upper_squared", upper)
    expect(chain.closed or convention == "critical", "statement.convention", "'critical' for an open curve", convention)
    corners = (i for i in range(0 if chain.closed else 1, chain.size) if chain.is_corner(Fraction(i)))
    if "corner" in evidence:
        expect(evidence["corner"] in corners, "evidence.corner", "a joint that is a corner", evidence["corner"])
        expect(lower == 0, "statement.lower_squared", "0, because of the corner", lower)
        return {}
    corner = next(corners, None)
    require(corner is None, f"evidence: joint {corner} is a corner")
    (sigma, sigma_evidence), (kappa, kappa_evidence) = evidence["msd"], evidence["curvature"]
    expect(sigma["convention"] == convention, "evidence.msd.statement.convention", convention, sigma["convention"])
    least, most = sigma["lower_squared"], sigma["upper_squared"]  # None: infinite, not bounded
    if lower is None:
        follows = least is None and kappa["upper_squared"] == 0
    else:
        follows = lower == 0 or ((least is None or 4 * lower <= least) and lower * kappa["upper_squared"] <= 1)
    expect(follows, "statement.lower_squared", "at most 1/κ² and σ²/4 by the bounds in the evidence", lower)
    follows = upper is None or (most is not None and 4 * upper >= most) or upper * kappa["lower_squared"] >= 1
    expect(follows, "statement.upper_squared", "at least 1/κ² or σ²/4 by the bounds in the evidence", upper)
    curvature.check(chain, kappa, kappa_evidence, None)
    return msd.check(chain, sigma, sigma_evidence, block)


def sentence(statement):
    """An accepted statement in words."""
    lower, upper = statement["lower_squared"], statement["upper_squared"]
    return (f"the squared thickness in [{lower}, {'∞' if upper is None else upper}], convention "
            f"{statement['convention']}, curve {statement['curve_sha256']}")
