"""bezier: polynomial Bézier curves only."""

from importlib.metadata import version

import bezier
import numpy as np

import adapter


def returned(made, start=0.0, end=1.0):
    order = made.degree + 1
    return adapter.curve(made.degree, [start] * order + [end] * order, made.nodes.T)


class Engine:
    def curve(self, asked):
        if not adapter.is_bezier(adapter.polynomial(asked)):
            raise adapter.NotOffered
        return bezier.Curve.from_nodes(np.asfortranarray(np.array(asked["points"], float).T))

    def point(self, asked, case):
        return {"point": adapter.numbers(self.curve(asked).evaluate(case["parameter"])[:, 0])}

    def derivative(self, asked, case):
        if case["order"] > 1:
            raise adapter.NotOffered
        return {"vector": adapter.numbers(self.curve(asked).evaluate_hodograph(case["parameter"])[:, 0])}

    def elevate_degree(self, asked, case):
        made = self.curve(asked)
        for _ in range(case["times"]):
            made = made.elevate()
        return {"curve": returned(made)}

    def split(self, asked, case):
        made, at = self.curve(asked), case["parameter"]
        return {"curves": [returned(made.specialize(0.0, at), 0.0, at), returned(made.specialize(at, 1.0), at, 1.0)]}


adapter.main(f"bezier {version('bezier')}", Engine())
