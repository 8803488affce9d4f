"""SciPy: scipy.interpolate.BSpline. No rational curves."""

import numpy as np
import scipy
from scipy.interpolate import BPoly, BSpline, PPoly

import adapter


class Engine:
    def spline(self, asked):
        asked = adapter.polynomial(asked)
        knots, points = np.array(asked["knots"], float), np.array(asked["points"], float)
        return BSpline(knots, points, asked["degree"], extrapolate=False)

    def point(self, asked, case):
        return {"point": adapter.numbers(self.spline(asked)(case["parameter"]))}

    def derivative(self, asked, case):
        return {"vector": adapter.numbers(self.spline(asked)(case["parameter"], nu=case["order"]))}

    def insert_knot(self, asked, case):
        made = self.spline(asked).insert_knot(case["parameter"], case["times"])
        return {"curve": adapter.curve(made.k, made.t, made.c[: len(made.t) - made.k - 1])}

    def decompose(self, asked, _case):
        made = self.spline(asked)
        # PPoly takes splines of one coordinate.
        axes = [PPoly.from_spline((made.t, made.c[:, axis], made.k)) for axis in range(made.c.shape[1])]
        pieces = [BPoly.from_power_basis(axis) for axis in axes]
        breaks, control = pieces[0].x, np.stack([axis.c for axis in pieces], axis=-1)
        start, end = adapter.domain(asked)
        curves, order = [], made.k + 1
        for i, (a, b) in enumerate(zip(breaks, breaks[1:])):
            if start <= a < b <= end:
                curves.append(adapter.curve(made.k, [a] * order + [b] * order, control[:, i]))
        return {"curves": curves}


adapter.main(f"scipy {scipy.__version__}", Engine())
