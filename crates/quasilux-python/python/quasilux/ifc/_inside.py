"""Points that lie inside bodies, where no light comes: an upward ray leaves a body once more."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from quasilux.ifc._geometry import Floats, Shape

# Rays stand beside points by this much, in m, lest they meet the edges of facets.
_BESIDE_M = np.array([1.2345e-5, 0.7531e-5])
# Pairs of a point and a facet that are looked at together.
_AT_ONCE = 4_000_000


class Bodies:
    """Shapes that points may lie inside of."""

    def __init__(self, shapes: Iterable[Shape]) -> None:
        self._shapes = list(shapes)
        self._boxes = np.array([shape.box_m for shape in self._shapes]).reshape(-1, 2, 3)

    def hold(self, points: Floats) -> NDArray[np.bool_]:
        """Return which points, of shape (n, 3) in m, lie inside one of the shapes."""
        inside = np.zeros(len(points), dtype=bool)
        if not len(points):
            return inside
        lowest, highest = points.min(axis=0), points.max(axis=0)
        may_hold = (self._boxes[:, 1] >= lowest) & (self._boxes[:, 0] <= highest)
        for number in np.flatnonzero(may_hold.all(axis=1)):
            low, high = self._boxes[number]
            near = np.flatnonzero(((points >= low) & (points <= high)).all(axis=1) & ~inside)
            if len(near):
                inside[near] = is_inside(points[near], self._shapes[number].corners)
        return inside


def is_inside(points: Floats, corners: Floats) -> NDArray[np.bool_]:
    """Return which points, of shape (n, 3) in m, lie inside a closed body."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    u, v = (b - a)[:, :2], (c - a)[:, :2]
    area = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    is_seen = area != 0
    a, b, c, u, v, area = (part[is_seen] for part in (a, b, c, u, v, area))
    odd = np.zeros(len(points), dtype=bool)
    step = max(1, _AT_ONCE // max(len(area), 1))
    for begin in range(0, len(points), step):
        chosen = points[begin : begin + step]
        w = (chosen[:, None, :2] + _BESIDE_M) - a[None, :, :2]
        s = (w[..., 0] * v[:, 1] - w[..., 1] * v[:, 0]) / area
        t = (u[:, 0] * w[..., 1] - u[:, 1] * w[..., 0]) / area
        z = a[:, 2] + s * (b - a)[:, 2] + t * (c - a)[:, 2]
        hit = (s >= 0) & (t >= 0) & (s + t <= 1) & (z > chosen[:, 2, None])
        odd[begin : begin + step] = hit.sum(axis=1) % 2 == 1
    return odd
