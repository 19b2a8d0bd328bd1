"""Panes of solid bodies: a project has a pane as one sheet, a model as a thin box.

A sheet is what one face of the box shows, moved to the middle of its thickness, so that outlines
and holes stay. Panes behind one another in one product are one sheet too: the material stands for
the whole glazing.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from quasilux.ifc._solids import bodies

if TYPE_CHECKING:
    from quasilux.ifc._geometry import Floats

# Beyond this thickness a body is no pane.
MOST_THICKNESS_M = 0.1
# Distance of panes that belong to one glazing.
_SAME_GLAZING_M = 0.12
# Share of the surface of a pane that its two faces have at least.
_LEAST_SHARE = 0.6
_ALIGNED = 0.9995
# Facets and panes nearer than this, in m, lie in one plane.
_SAME_PLANE_M = 1e-3
# Bodies with more planes than panes with spacers have are left as they are.
_MOST_LAYERS = 32


@dataclass
class Sheets:
    """Flat panes and what is none.

    Attributes
    ----------
    flat : list of Sheet
        Flat panes.
    solid : list of ndarray
        Bodies that are no panes, unchanged.
    """

    flat: list[Sheet]
    solid: list[Floats]


@dataclass
class Sheet:
    """A flat pane: its triangles, of shape (n, 3, 3) in m, and the plane that they lie in."""

    corners: Floats
    normal: Floats
    offset_m: float


def sheets_of(corners: Floats, *, thickness_m: float = MOST_THICKNESS_M) -> Sheets:
    """Return the panes of a part, of shape (n, 3, 3), as sheets."""
    result = Sheets([], [])
    for body in bodies_of(corners):
        sheet = _sheet(body, thickness_m)
        if sheet is None:
            result.solid.append(body)
        else:
            result.flat.append(sheet)
    return result


def bodies_of(corners: Floats) -> list[Floats]:
    """Return the triangles of each body by itself."""
    return [corners[body] for body in bodies(corners)]


def _sheet(corners: Floats, thickness_m: float) -> Sheet | None:
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
    shown = _foremost(shown, normal)
    moved = shown + (offset - shown @ normal)[..., None] * normal
    return Sheet(moved, normal, offset)


def _foremost(facets: Floats, normal: Floats) -> Floats:
    """Facets of one side of a body without those behind others, as in panes with a spacer."""
    import shapely

    layer = np.round((facets @ normal).mean(axis=1) / _SAME_PLANE_M)
    layers = sorted(np.unique(layer), reverse=True)
    if len(layers) == 1 or len(layers) > _MOST_LAYERS:
        return facets
    flat: Any = shapely.polygons(facets @ _plane(normal).T)
    is_kept = np.zeros(len(facets), dtype=bool)
    covered = shapely.Polygon()
    for number in layers:
        here = np.flatnonzero(layer == number)
        hidden = shapely.area(shapely.intersection(flat[here], covered))
        is_kept[here] = hidden < 0.5 * shapely.area(flat[here])
        covered = shapely.union_all([covered, *flat[here]], grid_size=1e-6)
    return facets[is_kept]


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


def is_behind(one: Sheet, other: Sheet) -> bool:
    """Whether two panes lie behind one another: most of the smaller is before the larger."""
    import shapely

    if abs(one.normal @ other.normal) < _ALIGNED:
        return False
    center = one.corners.reshape(-1, 3).mean(axis=0)
    apart = abs(center @ other.normal - other.offset_m)
    if not _SAME_PLANE_M < apart <= _SAME_GLAZING_M:
        return False
    first, second = (
        shapely.union_all(shapely.polygons(sheet.corners @ _plane(other.normal).T), grid_size=1e-6)
        for sheet in (one, other)
    )
    shared = shapely.area(shapely.intersection(first, second))
    return bool(shared > 0.8 * min(shapely.area(first), shapely.area(second)))


def _plane(normal: Floats) -> Floats:
    """Two directions across a normal, of shape (2, 3)."""
    return np.linalg.svd(normal[None, :])[2][1:]
