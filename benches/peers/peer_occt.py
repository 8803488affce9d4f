"""Open CASCADE's GeomAPI_ExtremaCurveCurve for each pair of pieces, through cadquery-ocp."""

from OCP.Geom import Geom_BezierCurve
from OCP.GeomAPI import GeomAPI_ExtremaCurveCurve
from OCP.gp import gp_Pnt, gp_Vec

try:
    from OCP.collections import Array1_gp_Pnt as PointArray
except ImportError:
    from OCP.TColgp import TColgp_Array1OfPnt as PointArray

from pairs import Found, batches
from peer_numpy import prepare as prepare_numpy

PROVES = "nothing"


def prepare(chain):
    """The pieces as Open CASCADE curves."""
    curves = []
    for piece in chain.bezier:
        poles = PointArray(1, len(piece))
        for k, point in enumerate(piece, start=1):
            poles.SetValue(k, gp_Pnt(*(list(map(float, point)) + [0.0])[:3]))
        curves.append(Geom_BezierCurve(poles))
    return prepare_numpy(chain)[1], curves


def find(chain, prepared):
    """The extrema that are double normals: an extremum may also lie at an end of a piece."""
    scale, curves = prepared
    found = Found(chain)
    failed = 0
    for batch in batches(chain, found, size=64):
        for i, j, distance in zip(*(column.tolist() for column in batch)):
            if distance >= found.bound():
                break
            try:
                extrema = GeomAPI_ExtremaCurveCurve(curves[i], curves[j])
                parallel = extrema.IsParallel()
            except Exception:  # a piece against itself is outside what the class accepts
                failed += 1
                continue
            for k in range(1, 0 if parallel else extrema.NbExtrema() + 1):
                s, t = extrema.Parameters(k)
                p, q, ds, dt = gp_Pnt(), gp_Pnt(), gp_Vec(), gp_Vec()
                curves[i].D1(s, p, ds)
                curves[j].D1(t, q, dt)
                chord = gp_Vec(p, q)
                length = chord.Magnitude()
                normal = all(abs(chord.Dot(d)) <= 1e-6 * length * d.Magnitude() for d in (ds, dt))
                if length > 1e-6 * scale and normal:
                    found.add(length, i + s, j + t)
    found.note = f"{failed} pairs refused" if failed else ""
    return found
