"""Openings of walls and slabs: which there are, and which the geometry kernel did not cut."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from quasilux.ifc import _model
from quasilux.ifc._inside import is_inside
from quasilux.ifc._solids import volume_m3

if TYPE_CHECKING:
    from quasilux.ifc._geometry import Shape
    from quasilux.ifc._model import Model

# Openings that reach less far into their hosts, in m, are not looked at.
_LEAST_OPENING_M = 1e-3
# Points along each side of an opening at which it is looked at.
_SAMPLES = 5


def openings_of(model: Model, products: list[Any]) -> dict[int, list[Any]]:
    """Return the openings of products by the numbers of these."""
    found: dict[int, list[Any]] = {}
    for product in products:
        for relation in _model.get(product, "HasOpenings") or ():
            opening = _model.get(relation, "RelatedOpeningElement")
            if opening is not None:
                found.setdefault(product.id(), []).append(opening)
    return found


def tell_uncut(model: Model, openings: dict[int, list[Any]], shapes: dict[int, Shape]) -> None:
    """Tell of openings that are not cut: those without a shape, and those still filled."""
    for number, cut in openings.items():
        host = shapes.get(number)
        for opening in cut if host is not None else ():
            label = _model.label(opening)
            own = shapes.get(opening.id())
            if own is None or abs(volume_m3(own.corners)) < _LEAST_OPENING_M**3:
                message = "an opening without a sound body may not be cut"
                model.findings.note(message, label)
            elif host is not None and _is_filled(host, own):
                model.findings.note("an opening that the geometry kernel does not cut", label)


def _is_filled(host: Shape, opening: Shape) -> bool:
    """Whether points inside an opening are inside what it is to be cut from."""
    low = np.maximum(host.box_m[0], opening.box_m[0])
    high = np.minimum(host.box_m[1], opening.box_m[1])
    if (high - low <= _LEAST_OPENING_M).any():
        return False
    shares = (np.arange(_SAMPLES) + 0.5) / _SAMPLES
    grid = np.stack(np.meshgrid(shares, shares, shares), axis=-1).reshape(-1, 3)
    points = low + grid * (high - low)
    points = points[is_inside(points, opening.corners)]
    return bool(len(points) and is_inside(points, host.corners).mean() > 0.2)
