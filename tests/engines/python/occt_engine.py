"""Open CASCADE Technology through cadquery-ocp. Planar curves are put into the plane z = 0."""

from importlib.metadata import version

from OCP.BRepBuilderAPI import BRepBuilderAPI_MakeEdge, BRepBuilderAPI_MakeVertex
from OCP.BRepExtrema import BRepExtrema_DistShapeShape
from OCP.collections import Array1_double, Array1_gp_Pnt, Array1_int
from OCP.Geom import Geom_BSplineCurve
from OCP.GeomAPI import GeomAPI_ExtremaCurveCurve
from OCP.GeomConvert import GeomConvert_BSplineCurveToBezierCurve
from OCP.GeomLProp import GeomLProp_CLProps
from OCP.gp import gp_Pnt

import adapter

TOLERANCE = 1e-9


def array(kind, values):
    made = kind(1, len(values))
    for i, value in enumerate(values, 1):
        made.SetValue(i, value)
    return made


def point(coordinates):
    return gp_Pnt(*(float(x) for x in [*coordinates, 0.0][:3]))


def coordinates(vector, dimension):
    return adapter.numbers([vector.X(), vector.Y(), vector.Z()][:dimension])


def control(made, dimension):
    points = [coordinates(made.Pole(i), dimension) for i in range(1, made.NbPoles() + 1)]
    weights = [made.Weight(i) for i in range(1, made.NbPoles() + 1)] if made.IsRational() else None
    return points, weights


def returned(made, dimension):
    points, weights = control(made, dimension)
    knots = [made.Knot(i) for i in range(1, made.NbKnots() + 1) for _ in range(made.Multiplicity(i))]
    return adapter.curve(made.Degree(), knots, points, weights)


class Engine:
    def curve(self, asked):
        knots = sorted(set(asked["knots"]))
        multiplicities = [asked["knots"].count(knot) for knot in knots]
        poles = array(Array1_gp_Pnt, [point(p) for p in asked["points"]])
        weights = array(Array1_double, [float(w) for w in asked.get("weights", [1] * len(asked["points"]))])
        return Geom_BSplineCurve(
            poles,
            weights,
            array(Array1_double, [float(knot) for knot in knots]),
            array(Array1_int, multiplicities),
            asked["degree"],
        )

    def dimension(self, asked):
        return len(asked["points"][0])

    def point(self, asked, case):
        found = self.curve(asked).Value(case["parameter"])
        return {"point": coordinates(found, self.dimension(asked))}

    def derivative(self, asked, case):
        found = self.curve(asked).DN(case["parameter"], case["order"])
        return {"vector": coordinates(found, self.dimension(asked))}

    def curvature(self, asked, case):
        return {"value": adapter.number(GeomLProp_CLProps(self.curve(asked), case["parameter"], 2, 1e-12).Curvature())}

    def insert_knot(self, asked, case):
        made = self.curve(asked)
        made.InsertKnot(case["parameter"], case["times"], 0.0, True)
        return {"curve": returned(made, self.dimension(asked))}

    def remove_knot(self, asked, case):
        made = self.curve(asked)
        index = next(i for i in range(1, made.NbKnots() + 1) if made.Knot(i) == case["parameter"])
        if not made.RemoveKnot(index, made.Multiplicity(index) - case["times"], TOLERANCE):
            raise ValueError("RemoveKnot returned false")
        return {"curve": returned(made, self.dimension(asked))}

    def elevate_degree(self, asked, case):
        made = self.curve(asked)
        made.IncreaseDegree(asked["degree"] + case["times"])
        return {"curve": returned(made, self.dimension(asked))}

    def split(self, asked, case):
        start, end = adapter.domain(asked)
        parts = []
        for a, b in [(start, case["parameter"]), (case["parameter"], end)]:
            made = self.curve(asked)
            made.Segment(a, b)
            parts.append(returned(made, self.dimension(asked)))
        return {"curves": parts}

    def decompose(self, asked, _case):
        pieces = GeomConvert_BSplineCurveToBezierCurve(self.curve(asked))
        curves = []
        for i in range(1, pieces.NbArcs() + 1):
            made = pieces.Arc(i)
            order = made.Degree() + 1
            curves.append(adapter.curve(order - 1, [0] * order + [1] * order, *control(made, self.dimension(asked))))
        return {"curves": curves}

    def edge(self, asked):
        return BRepBuilderAPI_MakeEdge(self.curve(asked)).Edge()

    def nearest_point(self, asked, case):
        vertex = BRepBuilderAPI_MakeVertex(point(case["target"])).Vertex()
        return {"distance": self.distance(vertex, self.edge(asked))}

    def curve_distance(self, asked, case):
        return {"distance": self.distance(self.edge(asked), self.edge(case["other"]))}

    def distance(self, a, b):
        found = BRepExtrema_DistShapeShape(a, b)
        if not found.IsDone():
            raise ValueError("BRepExtrema_DistShapeShape is not done")
        return adapter.number(found.Value())

    def msd(self, asked, _case):
        pieces = GeomConvert_BSplineCurveToBezierCurve(self.curve(asked))
        arcs = [pieces.Arc(i) for i in range(1, pieces.NbArcs() + 1)]
        found = []
        for i, a in enumerate(arcs):
            for b in arcs[i:]:
                extrema = GeomAPI_ExtremaCurveCurve(a, b)
                all_of = [extrema.Distance(k) for k in range(1, extrema.NbExtrema() + 1)]
                # A piece is everywhere at distance 0 from itself, and neighbours meet at their joint.
                found += [distance for distance in all_of if distance > TOLERANCE]
        return {"distance": adapter.number(min(found)) if found else None}


adapter.main(f"OCCT (cadquery-ocp {version('cadquery-ocp')})", Engine())
