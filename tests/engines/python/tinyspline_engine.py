"""TinySpline. No rational curves."""

from importlib.metadata import version

import tinyspline

import adapter


def split_points(flat, dimension):
    return [flat[i : i + dimension] for i in range(0, len(flat), dimension)]


def returned(made):
    return adapter.curve(made.degree, made.knots, split_points(list(made.control_points), made.dimension))


class Engine:
    def curve(self, asked):
        asked = adapter.polynomial(asked)
        points = asked["points"]
        made = tinyspline.BSpline(len(points), len(points[0]), asked["degree"])
        made.control_points = [float(x) for point in points for x in point]
        made.knots = [float(knot) for knot in asked["knots"]]
        return made

    def point(self, asked, case):
        return {"point": adapter.numbers(self.curve(asked).eval(case["parameter"]).result[: len(asked["points"][0])])}

    def derivative(self, asked, case):
        made = self.curve(asked).derive(case["order"], -1.0)
        return {"vector": adapter.numbers(made.eval(case["parameter"]).result[: len(asked["points"][0])])}

    def insert_knot(self, asked, case):
        return {"curve": returned(self.curve(asked).insert_knot(case["parameter"], case["times"]))}

    def elevate_degree(self, asked, case):
        return {"curve": returned(self.curve(asked).elevate_degree(case["times"], 1e-10))}

    def split(self, asked, case):
        made, at = self.curve(asked), case["parameter"]
        start, end = adapter.domain(asked)
        return {"curves": [returned(made.sub_spline(start, at)), returned(made.sub_spline(at, end))]}

    def decompose(self, asked, _case):
        made = self.curve(asked).to_beziers()
        order, knots = made.order, list(made.knots)
        points = split_points(list(made.control_points), made.dimension)
        pieces = range(0, len(points), order)
        return {"curves": [adapter.curve(order - 1, knots[i : i + 2 * order], points[i : i + order]) for i in pieces]}


adapter.main(f"tinyspline {version('tinyspline')}", Engine())
