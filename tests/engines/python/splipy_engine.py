"""Splipy."""

from importlib.metadata import version

import numpy as np
from splipy import BSplineBasis, Curve

import adapter


def returned(made):
    control = np.array(made.controlpoints)
    weights = None
    if made.rational:
        weights = control[:, -1]
        control = control[:, :-1] / weights[:, None]
    return adapter.curve(made.order(0) - 1, made.knots(0, with_multiplicities=True), control, weights)


def above(asked, case):
    """At the ends of the domain there is one side only."""
    start, end = adapter.domain(asked)
    return case["parameter"] == start or case["side"] == "right" and case["parameter"] != end


class Engine:
    def curve(self, asked):
        basis = BSplineBasis(asked["degree"] + 1, np.array(asked["knots"], float))
        control = np.array(asked["points"], float)
        weights = asked.get("weights")
        if weights is not None:
            # Control points are held with their weights multiplied in.
            weights = np.array(weights, float)[:, None]
            control = np.hstack([control * weights, weights])
        return Curve(basis, control, rational=weights is not None)

    def point(self, asked, case):
        return {"point": adapter.numbers(self.curve(asked)(case["parameter"]))}

    def derivative(self, asked, case):
        found = self.curve(asked).derivative(case["parameter"], case["order"], above(asked, case))
        return {"vector": adapter.numbers(found)}

    def curvature(self, asked, case):
        return {"value": adapter.number(self.curve(asked).curvature(case["parameter"], above(asked, case)))}

    def torsion(self, asked, case):
        return {"value": adapter.number(self.curve(asked).torsion(case["parameter"], above(asked, case)))}

    def insert_knot(self, asked, case):
        return {"curve": returned(self.curve(asked).insert_knot([case["parameter"]] * case["times"]))}

    def elevate_degree(self, asked, case):
        return {"curve": returned(self.curve(asked).raise_order(case["times"]))}

    def split(self, asked, case):
        return {"curves": [returned(made) for made in self.curve(asked).split(case["parameter"])]}

    def decompose(self, asked, _case):
        made = self.curve(asked)
        interior = [float(knot) for knot in made.knots(0)[1:-1]]
        return {"curves": [returned(part) for part in (made.split(interior) if interior else [made])]}


adapter.main(f"splipy {version('splipy')}", Engine())
