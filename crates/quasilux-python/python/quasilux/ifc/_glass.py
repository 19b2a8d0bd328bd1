"""Panes of solid bodies: a project has a pane as one sheet, a model as a thin box.

A sheet is what one face of the box shows, moved to the middle of its thickness, so that outlines
and holes stay. Panes behind one another in one product are one sheet too: the material stands for
the whole glazing.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from quasilux.ifc._geometry import Floats

# Beyond this thickness a body is no pane.
MOST_THICKNESS_M = 0.1
# Distance of panes that belong to one glazing.
_SAME_GLAZING_M = 0.12
# Share of the surface of a pane that its two faces have at least.
_LEAST_SHARE = 0.6
_ALIGNED = 0.9995
_WELD_M = 1e-6


@dataclass
class Sheets:
    """Flat panes and what is none.

    Attributes
    ----------
    flat : list of ndarray
        Corners of the triangles of each sheet, of shape (n, 3, 3), in m.
    solid : list of ndarray
        Bodies that are no panes, unchanged.
    merged : int
        Panes that lie before another one of the same glazing, and are left out.
    """

    flat: list[Floats]
    solid: list[Floats]
    merged: int = 0


@dataclass
class _Sheet:
    corners: Floats
    normal: Floats
    offset_m: float


def sheets_of(corners: Floats, *, thickness_m: float = MOST_THICKNESS_M) -> Sheets:
    """Return the panes of a part, of shape (n, 3, 3), as sheets."""
    found: list[_Sheet] = []
    result = Sheets([], [])
    for body in bodies_of(corners):
        sheet = _sheet(body, thickness_m)
        if sheet is None:
            result.solid.append(body)
        elif any(_is_before(sheet, other) for other in found):
            result.merged += 1
        else:
            found.append(sheet)
    result.flat = [sheet.corners for sheet in found]
    return result


def bodies_of(corners: Floats) -> list[Floats]:
    """Return the triangles of each body by itself: bodies share no corners."""
    keys = np.round(corners.reshape(-1, 3) / _WELD_M).astype(np.int64)
    _, index = np.unique(keys, axis=0, return_inverse=True)
    triangles = index.reshape(-1, 3)
    # The lowest number among connected corners, by repeated halving of the way to it.
    parent = np.arange(triangles.max() + 1)
    while True:
        lowest = parent[triangles].min(axis=1)
        new = parent.copy()
        for corner in range(3):
            np.minimum.at(new, triangles[:, corner], lowest)
        new = new[new]
        if (new == parent).all():
            break
        parent = new
    body_of = parent[triangles[:, 0]]
    return [corners[body_of == body] for body in np.unique(body_of)]


def _sheet(corners: Floats, thickness_m: float) -> _Sheet | None:
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    twice_m2 = np.linalg.norm(cross, axis=1)
    has_area = twice_m2 > 0
    corners, cross, twice_m2 = corners[has_area], cross[has_area], twice_m2[has_area]
    if not len(corners):
        return None
    normals = cross / twice_m2[:, None]
    normal = _main_normal(normals, twice_m2)
    along = normals @ normal
    front, back = along > _ALIGNED, along < -_ALIGNED
    if twice_m2[front | back].sum() < _LEAST_SHARE * twice_m2.sum():
        return None
    heights = corners @ normal
    if heights.max() - heights.min() > thickness_m:
        return None
    shown = corners[front] if twice_m2[front].sum() > 0 else corners[back]
    offset = float((heights.max() + heights.min()) / 2)
    moved = shown + (offset - shown @ normal)[..., None] * normal
    return _Sheet(moved, normal, offset)


def _main_normal(normals: Floats, weights: Floats) -> Floats:
    """The direction that most of the area faces, forward or backward."""
    best, most = normals[0], -1.0
    # A pane has few directions; a curved body is refused by any.
    for candidate in normals[np.argsort(weights)[::-1][:8]]:
        area = weights[np.abs(normals @ candidate) > _ALIGNED].sum()
        if area > most:
            best, most = candidate, area
    # A sign that does not depend on the order of facets.
    largest = int(np.abs(best).argmax())
    return best if best[largest] > 0 else -best


def _is_before(one: _Sheet, other: _Sheet) -> bool:
    """Whether two panes lie behind one another."""
    if abs(one.normal @ other.normal) < _ALIGNED:
        return False
    center = one.corners.reshape(-1, 3).mean(axis=0)
    if abs(center @ other.normal - other.offset_m) > _SAME_GLAZING_M:
        return False
    plane = np.linalg.svd(other.normal[None, :])[2][1:]
    first, second = (sheet.corners.reshape(-1, 3) @ plane.T for sheet in (one, other))
    low = np.maximum(first.min(axis=0), second.min(axis=0))
    high = np.minimum(first.max(axis=0), second.max(axis=0))
    shared = np.prod(np.maximum(high - low, 0.0))
    larger = max(np.prod(np.ptp(points, axis=0)) for points in (first, second))
    return bool(shared > 0.8 * larger)
