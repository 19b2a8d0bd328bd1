"""Spaces of a model, and which products belong to one."""

from __future__ import annotations

import difflib
import functools
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from quasilux._errors import input_error
from quasilux.ifc import _model

if TYPE_CHECKING:
    from quasilux.ifc._geometry import Floats, Shape
    from quasilux.ifc._model import Model

Extent = Literal["space", "storey", "building"]

# Products this near to a space, in m, may bound it: half a thick wall, a suspended ceiling.
REACH_M = 0.3


@dataclass(frozen=True)
class Space:
    """A space of a model.

    Attributes
    ----------
    global_id, name, long_name, storey : str
        As in the model; empty where it has none.
    is_outside : bool
        Whether the model says that it lies outside.
    is_whole : bool
        Whether it is made of other spaces.
    corners : ndarray or None
        Corners of its triangles in m, of shape (n, 3, 3).
    """

    entity: Any
    global_id: str
    name: str
    long_name: str
    storey: str
    is_outside: bool
    is_whole: bool
    corners: Floats | None

    @property
    def title(self) -> str:
        """Its number and name."""
        if self.long_name and self.long_name not in self.name:
            return f"{self.name} {self.long_name}".strip()
        return self.name or self.global_id

    @functools.cached_property
    def box_m(self) -> Floats | None:
        """Lowest and highest coordinates, of shape (2, 3)."""
        if self.corners is None:
            return None
        points = self.corners.reshape(-1, 3)
        return np.array([points.min(axis=0), points.max(axis=0)])

    @functools.cached_property
    def footprint(self) -> Any:
        """What it covers in plan, as a polygon of shapely in m; None without area."""
        return None if self.corners is None else footprint_of(self.corners)


def spaces_of(model: Model, shapes: dict[int, Shape]) -> list[Space]:
    """Return all spaces of a model, those without a shape too."""
    found: list[Space] = []
    for entity in model.of_class("IfcSpace"):
        shape = shapes.get(entity.id())
        storey = storey_of(entity)
        found.append(
            Space(
                entity=entity,
                global_id=_model.text_of(entity, "GlobalId"),
                name=_model.text_of(entity, "Name"),
                long_name=_model.text_of(entity, "LongName"),
                storey=_model.text_of(storey, "Name") if storey is not None else "",
                is_outside=_is_outside(entity),
                is_whole=_is_whole(entity),
                corners=None if shape is None else shape.corners,
            )
        )
    return found


def footprint_of(corners: Floats) -> Any:
    """Return what a space covers in plan, as a polygon of shapely in m; None without area."""
    import shapely

    triangles = shapely.polygons(corners[:, :, :2])
    try:
        joined = shapely.union_all(shapely.make_valid(triangles), grid_size=1e-4)
    except shapely.errors.ShapelyError:
        return None
    parts = [part for part in shapely.get_parts(joined) if part.geom_type == "Polygon"]
    return max(parts, key=lambda part: part.area) if parts else None


def _is_whole(space: Any) -> bool:
    parts = [
        part
        for relation in _model.get(space, "IsDecomposedBy") or ()
        for part in _model.get(relation, "RelatedObjects") or ()
    ]
    return any(_model.is_a(part, "IfcSpace") for part in parts)


def _is_outside(space: Any) -> bool:
    kinds = (_model.get(space, "PredefinedType"), _model.get(space, "InteriorOrExteriorSpace"))
    common = _model.psets_of(space).get("Pset_SpaceCommon")
    is_external = isinstance(common, dict) and common.get("IsExternal") is True
    return "EXTERNAL" in kinds or is_external


def storey_of(product: Any) -> Any:
    """Return the storey that a product or a space is in, or None."""
    import ifcopenshell.util.element as elements

    entity = product
    for _ in range(32):
        if entity is None or _model.is_a(entity, "IfcBuildingStorey"):
            return entity
        try:
            entity = elements.get_parent(entity)
        except Exception:
            return None
    return None


def chosen_spaces(
    spaces: Sequence[Space], wanted: Iterable[str], storey: str | None, model: Model
) -> list[Space]:
    """Return the spaces that are asked for by GlobalId, number, name or both; else all.

    Raises
    ------
    InputError
        For names of no space, or of several.
    """
    chosen: list[Space] = []
    for name in wanted:
        found = _named(spaces, name)
        if len(found) > 1:
            ids = ", ".join(space.global_id for space in found[:5])
            message = f'{len(found)} spaces are called "{name}"; expected a GlobalId, one of {ids}'
            raise input_error(message, model.name)
        if not found:
            raise input_error(f'no space "{name}"; {_offer(spaces, name)}', model.name)
        chosen += [space for space in found if space not in chosen]
    if chosen:
        return chosen
    if storey is None:
        return list(spaces)
    storeys = [entity for entity in model.of_class("IfcBuildingStorey")]
    names = [_model.text_of(entity, "Name") for entity in storeys]
    if storey.casefold() not in [name.casefold() for name in names]:
        known = ", ".join(f'"{name}"' for name in names[:20]) or "none"
        raise input_error(f'no storey "{storey}"; expected one of {known}', model.name)
    return [space for space in spaces if space.storey.casefold() == storey.casefold()]


def _named(spaces: Sequence[Space], name: str) -> list[Space]:
    """Spaces of a name; a more special kind of name goes before others."""
    found = [space for space in spaces if space.global_id == name]
    for attribute in ("title", "name", "long_name"):
        if not found:
            found = [
                space
                for space in spaces
                if getattr(space, attribute).casefold() == name.casefold().strip()
            ]
    return found


def _offer(spaces: Sequence[Space], name: str) -> str:
    if not spaces:
        return "the model has no spaces"
    titles = [space.title for space in spaces]
    near = difflib.get_close_matches(name, titles, 1)
    shown = ", ".join(f'"{title}"' for title in titles[:20])
    more = f" and {len(titles) - 20} more" if len(titles) > 20 else ""
    return f"expected one of {shown}{more}" + (f'; did you mean "{near[0]}"?' if near else "")


def members(
    spaces: Sequence[Space], shapes: dict[int, Shape], model: Model
) -> dict[int, Shape]:
    """Return the products that bound spaces, are in them, or lie as near as `REACH_M`.

    Raises
    ------
    InputError
        When a space has no shape, and nothing says what bounds it.
    """
    kept: set[int] = set()
    for space in spaces:
        related = _related(space.entity)
        kept |= related
        box = space.box_m
        if box is None:
            if not related & set(shapes):
                message = f'the space "{space.title}" has no shape and no boundaries'
                raise input_error(message, model.name)
            continue
        low, high = box[0] - REACH_M, box[1] + REACH_M
        for number, shape in shapes.items():
            lowest, highest = shape.box_m
            if (highest >= low).all() and (lowest <= high).all():
                kept.add(number)
    kept |= _with_parts(kept, model)
    return {number: shape for number, shape in shapes.items() if number in kept}


def _with_parts(kept: set[int], model: Model) -> set[int]:
    """Numbers of what fills openings of products, and of what they are made of."""
    found: set[int] = set()
    ahead = [model.by_id(number) for number in kept]
    while ahead:
        product = ahead.pop()
        if product is None or product.id() in found or _model.is_a(product, "IfcSpace"):
            continue
        found.add(product.id())
        for voiding in _model.get(product, "HasOpenings") or ():
            opening = _model.get(voiding, "RelatedOpeningElement")
            for filling in _model.get(opening, "HasFillings") or ():
                ahead.append(_model.get(filling, "RelatedBuildingElement"))
        for relation in _model.get(product, "IsDecomposedBy") or ():
            ahead += _model.get(relation, "RelatedObjects") or ()
    return found


def of_storeys(
    spaces: Sequence[Space], storey: str | None, shapes: dict[int, Shape]
) -> dict[int, Shape]:
    """Return the products of the storeys of spaces, and those that reach into them."""
    names = storey_names(spaces, storey)
    inside = {
        number: shape
        for number, shape in shapes.items()
        if is_in_storeys(shape.product, names)
    }
    boxes = [space.box_m for space in spaces if space.box_m is not None]
    boxes = boxes or [shape.box_m for shape in inside.values()]
    if not boxes:
        return inside
    low = min(box[0][2] for box in boxes) - REACH_M
    high = max(box[1][2] for box in boxes) + REACH_M
    near = {
        number: shape
        for number, shape in shapes.items()
        if shape.box_m[1][2] >= low and shape.box_m[0][2] <= high
    }
    return dict(sorted({**inside, **near}.items()))


def storey_names(spaces: Iterable[Space], storey: str | None) -> frozenset[str]:
    """Return the names of the storeys of spaces, and that of a storey, in lower case."""
    names = {space.storey.casefold() for space in spaces} | {(storey or "").casefold()}
    return frozenset(names - {""})


def is_in_storeys(product: Any, names: frozenset[str]) -> bool:
    """Whether the model puts a product into a storey of one of the names of `storey_names`."""
    return _model.text_of(storey_of(product), "Name").casefold() in names


def _related(space: Any) -> set[int]:
    """Numbers of the products that the model relates to a space."""
    found: set[int] = set()
    for boundary in _model.get(space, "BoundedBy") or ():
        element = _model.get(boundary, "RelatedBuildingElement")
        if element is not None:
            found.add(element.id())
    for relation in _model.get(space, "ContainsElements") or ():
        found |= {element.id() for element in _model.get(relation, "RelatedElements") or ()}
    return found
