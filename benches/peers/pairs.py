"""Pairs of pieces that may hold a short double normal, and the list of those found: shared by all peers.

The culling is the same for every peer and its time counts for each. On chains of at most `ALL` pieces every pair is
searched, so that all double normals are found; on longer ones the pairs come in order of the distance of their bounding
boxes and the search ends when that distance reaches the shortest double normal found.
"""

from math import inf

import numpy as np

ALL = 32
MOST_PIECES = 5000
# Relative to the size of the products tested: far above rounding, far below what matters.
MARGIN = 1e-12


class Found:
    """Double normals (length, u, v), u ≤ v global parameters, each once."""

    def __init__(self, chain):
        self.pieces = len(chain)
        self.closed = chain.closed
        self.all = len(chain) <= ALL
        self.normals = []
        self.pairs = 0
        # All double normals are at least `lower` long, one is at most `upper`: kept by the peers that enclose.
        self.lower = self.upper = inf

    def add(self, length, u, v):
        """Adds one; on a closed chain the last parameter is the first."""
        if self.closed:
            u, v = (0 * x if x >= self.pieces - 1e-9 else x for x in (u, v))
        self.normals.append((length, min(u, v), max(u, v)))

    def enclose(self, lower, upper=None):
        """Notes a region that may hold a double normal, of length at least `lower`; with `upper`, one is shown that is at most so long."""
        self.lower = min(self.lower, lower)
        if upper is not None:
            self.upper = min(self.upper, upper)

    def shortest(self):
        """Length of the shortest so far."""
        return min((normal[0] for normal in self.normals), default=inf)

    def bound(self):
        """Pairs of boxes at least this far apart need no search."""
        return inf if self.all else float(self.shortest())

    def distinct(self, tolerance=1e-6):
        """Those with different parameters, by length: a double normal on a joint is found from both pieces."""
        kept, cells = [], {}
        for normal in sorted(self.normals):
            u, v = float(normal[1]), float(normal[2])
            a, b = int(u / tolerance), int(v / tolerance)
            around = ((a + x, b + y) for x in (-1, 0, 1) for y in (-1, 0, 1))
            near = (other for cell in around for other in cells.get(cell, ()))
            if not any(abs(u - x) < tolerance and abs(v - y) < tolerance for x, y in near):
                cells.setdefault((a, b), []).append((u, v))
                kept.append(normal)
        return kept


def trivial_corners(chain, i, j):
    """Corners (s, t) of the parameter square of pieces i, j at which both points are the same joint."""
    corners = []
    if j == i + 1:
        corners.append((1, 0))
    if chain.closed and i == 0 and j == len(chain) - 1:
        corners.append((0, 1))
    return corners


def padded(rows):
    """Equal numbers of points for all pieces; repeated points change no convex hull."""
    most = max(map(len, rows))
    return np.array([[[float(x) for x in p] for p in row + [row[-1]] * (most - len(row))] for row in rows])


def batches(chain, found, size=1024):
    """Arrays (i, j, distance of the boxes) of culled pairs, until `found` says that the rest is too far."""
    pieces = len(chain)
    if pieces > MOST_PIECES:
        raise ValueError(f"more than {MOST_PIECES} pieces")
    points = padded(chain.bezier)
    hodographs = padded([[tuple(q - p for p, q in zip(a, b)) for a, b in zip(piece, piece[1:])] for piece in chain.bezier])
    low, high = points.min(axis=1), points.max(axis=1)
    square = np.zeros((pieces, pieces))
    for axis in range(points.shape[2]):
        gap = low[:, None, axis] - high[None, :, axis]
        square += np.maximum(np.maximum(gap, gap.T), 0) ** 2
    i, j = np.triu_indices(pieces)
    distance = np.sqrt(square[i, j])
    order = np.argsort(distance, kind="stable")
    i, j, distance = i[order], j[order], distance[order] * (1 - MARGIN)
    for start in range(0, len(i), size):
        part = slice(start, min(start + size, np.searchsorted(distance, found.bound())))
        if part.start >= part.stop:
            return
        keep = may_be_normal(chain, points, hodographs, i[part], j[part])
        found.pairs += int(keep.sum())
        yield i[part][keep], j[part][keep], distance[part][keep]


def may_be_normal(chain, points, hodographs, i, j):
    """False where control points show that pieces i and j have no double normal.

    Pieces apart: all chords make an acute (or all an obtuse) angle with all tangents of one piece. A piece with itself
    or its neighbour: all tangents make acute angles with each other.
    """
    chords = points[i][:, :, None, None] - points[j][:, None, :, None]
    keep = np.ones(len(i), dtype=bool)
    for piece in (i, j):
        tangents = hodographs[piece][:, None, None]
        products = (chords * tangents).sum(axis=-1).reshape(len(i), -1)
        margin = MARGIN * (np.abs(chords) * np.abs(tangents)).sum(axis=-1).reshape(len(i), -1).max(axis=1)
        keep &= (products.min(axis=1) <= margin) & (products.max(axis=1) >= -margin)
    near = (i == j) | (j == i + 1)
    if chain.closed:
        near |= (i == 0) & (j == len(chain) - 1)
    near = np.flatnonzero(near)
    if len(near):
        tangents = np.concatenate([hodographs[i[near]], hodographs[j[near]]], axis=1)
        products = (tangents[:, :, None] * tangents[:, None]).sum(axis=-1)
        keep[near] = products.reshape(len(near), -1).min(axis=1) <= 0
    if chain.closed and len(chain) <= 2:
        keep[near] = True
    return keep
