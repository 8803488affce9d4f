"""geomdl (NURBS-Python)."""

from importlib.metadata import version

from geomdl import BSpline, NURBS, operations

import adapter


def returned(made):
    weights = made.weights if made.rational else None
    return adapter.curve(made.degree, made.knotvector, made.ctrlpts, weights)


class Engine:
    def curve(self, asked):
        made = (NURBS if "weights" in asked else BSpline).Curve(normalize_kv=False)
        made.degree = asked["degree"]
        made.ctrlpts = [list(map(float, point)) for point in asked["points"]]
        if "weights" in asked:
            made.weights = [float(weight) for weight in asked["weights"]]
        made.knotvector = [float(knot) for knot in asked["knots"]]
        return made

    def point(self, asked, case):
        return {"point": adapter.numbers(self.curve(asked).evaluate_single(case["parameter"]))}

    def derivative(self, asked, case):
        return {"vector": adapter.numbers(self.curve(asked).derivatives(case["parameter"], case["order"])[case["order"]])}

    def insert_knot(self, asked, case):
        return {"curve": returned(operations.insert_knot(self.curve(asked), [case["parameter"]], [case["times"]]))}

    def remove_knot(self, asked, case):
        return {"curve": returned(operations.remove_knot(self.curve(asked), [case["parameter"]], [case["times"]]))}

    def elevate_degree(self, asked, case):
        made = self.curve(asked)
        operations.degree_operations(made, [case["times"]])
        return {"curve": returned(made)}

    def split(self, asked, case):
        return {"curves": [returned(made) for made in operations.split_curve(self.curve(asked), case["parameter"])]}

    def decompose(self, asked, _case):
        return {"curves": [returned(made) for made in operations.decompose_curve(self.curve(asked))]}


adapter.main(f"geomdl {version('geomdl')}", Engine())
