"""Triangles of a model: each product with its openings cut, by the styles of its parts."""

from __future__ import annotations

import functools
import os
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from quasilux._errors import input_error
from quasilux.ifc import _model
from quasilux.ifc._care import CARE

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from quasilux.ifc._model import Model

    Floats = NDArray[np.float64]

# Triangles of a whole model; beyond, a part of the building is asked for.
MOST_TRIANGLES = 20_000_000
# Coordinates beyond it, in m, are on no site.
_FARTHEST_M = 1e8

# Products that bound no light, or whose surfaces are within others.
_WITHOUT_SURFACES = (
    "IfcAnnotation",
    "IfcFeatureElementSubtraction",
    "IfcGrid",
    "IfcPort",
    "IfcReinforcingElement",
    "IfcStructuralActivity",
    "IfcStructuralItem",
    "IfcVirtualElement",
)
_SPATIAL = ("IfcSpatialStructureElement", "IfcSpatialElement")


@dataclass(frozen=True)
class Part:
    """The facets of a product that have one style.

    Attributes
    ----------
    style : str
        Name of the style or material, empty where there is none.
    transparency : float or None
        0 opaque, 1 clear, where a style says so.
    rgb : tuple of float or None
        Colour of the style, 0 to 1.
    corners : ndarray of shape (n, 3, 3)
        Corners of the triangles in m; counter-clockwise from outside.
    """

    style: str
    transparency: float | None
    rgb: tuple[float, float, float] | None
    corners: Floats


@dataclass(frozen=True)
class Shape:
    """A product with its surfaces."""

    product: Any
    parts: tuple[Part, ...]

    @property
    def corners(self) -> Floats:
        """Corners of all triangles in m, of shape (n, 3, 3)."""
        return np.concatenate([part.corners for part in self.parts])

    @functools.cached_property
    def box_m(self) -> Floats:
        """Lowest and highest coordinates, of shape (2, 3)."""
        corners = self.corners.reshape(-1, 3)
        return np.array([corners.min(axis=0), corners.max(axis=0)])


def products_with_surfaces(model: Model) -> list[Any]:
    """Return the products that may reflect light: no spaces, openings or axes."""
    found: list[Any] = []
    inside_concrete = 0
    for product in model.of_class("IfcProduct"):
        if _model.is_a(product, "IfcReinforcingElement"):
            inside_concrete += 1
        if any(_model.is_a(product, name) for name in _WITHOUT_SURFACES):
            continue
        is_spatial = any(_model.is_a(product, name) for name in _SPATIAL)
        if is_spatial and not _model.is_a(product, "IfcSite"):
            continue
        if _model.get(product, "Representation") is not None:
            found.append(product)
    if inside_concrete:
        model.findings.note(f"reinforcement ({inside_concrete}) is left out: it is inside concrete")
    if len(found) > _model.MOST_PRODUCTS:
        message = (
            f"{len(found)} products; expected at most {_model.MOST_PRODUCTS}: export a part of "
            "the building"
        )
        raise input_error(message, model.name)
    return found


def shapes_of(model: Model, products: list[Any]) -> dict[int, Shape]:
    """Return shapes of products by their numbers; those without are left out.

    Raises
    ------
    InputError
        For more triangles than are read.
    """
    found: dict[int, Shape] = {}
    count = 0
    for element in _elements(model, products):
        shape = _shape(model, element)
        if shape is None or shape.product.id() in found:
            continue
        found[shape.product.id()] = shape
        count += sum(len(part.corners) for part in shape.parts)
        if count > MOST_TRIANGLES:
            message = f"more than {MOST_TRIANGLES} triangles; export a part of the building"
            raise input_error(message, model.name)
    return dict(sorted(found.items()))


def _elements(model: Model, products: list[Any]) -> Iterator[Any]:
    """Yield what the kernel makes of products; those that it cannot make are passed over."""
    import ifcopenshell.geom as kernel

    settings = kernel.settings()
    if CARE.one_by_one:
        yield from _one_by_one(model, products, settings)
        return
    if not products:
        return
    try:
        threads = max(1, min(8, os.cpu_count() or 1))
        iterator = kernel.iterator(settings, model.file, threads, include=products)
        more = bool(iterator.initialize())
        while more:
            yield iterator.get()
            more = bool(iterator.next())
    except RuntimeError as error:
        reason = " ".join(str(error).split()) or type(error).__name__
        model.findings.note(f"the geometry kernel ended early: {reason}")


def _one_by_one(model: Model, products: list[Any], settings: Any) -> Iterator[Any]:
    import ifcopenshell.geom as kernel

    for product in products:
        how = CARE.skipped.get(product.id())
        if how is not None:
            message = f"is left out: on its geometry ifcopenshell {how}"
            model.findings.note(message, _model.label(product))
            continue
        CARE.note(product.id())
        try:
            element = kernel.create_shape(settings, product)
        except RuntimeError:
            continue
        yield element
    # What breaks from here on is no product's fault.
    CARE.end()


def tell_missing(model: Model, products: list[Any], shapes: dict[int, Shape]) -> None:
    """Tell of products that ought to have surfaces and have none."""
    for product in products:
        if product.id() in shapes or product.id() in CARE.skipped:
            continue
        if _model.is_a(product, "IfcSite") or not _has_body(product):
            if _model.is_a(product, "IfcElement"):
                model.findings.note("has no body, and is left out", _model.label(product))
            continue
        message = "its geometry cannot be made into surfaces: it is left out"
        model.findings.note(message, _model.label(product))


def _has_body(product: Any) -> bool:
    representation = _model.get(product, "Representation")
    shapes = _model.get(representation, "Representations") or ()
    names = {_model.text_of(shape, "RepresentationIdentifier") for shape in shapes}
    return bool(names & {"Body", "Facetation", "Tessellation", ""})


def _shape(model: Model, element: Any) -> Shape | None:
    """Return the shape of an element of the iterator, in coordinates of the model."""
    product = model.by_id(element.id)
    if product is None:
        return None
    geometry = element.geometry
    vertices = np.array(geometry.verts, dtype=float).reshape(-1, 3)
    faces = np.array(geometry.faces, dtype=np.int64).reshape(-1, 3)
    if not len(faces) or faces.min() < 0 or faces.max() >= len(vertices):
        return None
    matrix = np.array(element.transformation.matrix, dtype=float).reshape(4, 4).T
    vertices = vertices @ matrix[:3, :3].T + matrix[:3, 3]
    corners = vertices[faces]
    is_good = (np.isfinite(corners) & (np.abs(corners) < _FARTHEST_M)).all(axis=(1, 2))
    if not is_good.all():
        model.findings.note("facets far out of any site are left out", _model.label(product))
    style_of = np.array(geometry.material_ids, dtype=np.int64)
    if len(style_of) != len(faces):
        style_of = np.full(len(faces), -1)
    styles = list(geometry.materials)
    parts = []
    for number in np.unique(style_of):
        chosen = corners[(style_of == number) & is_good]
        if len(chosen):
            style = styles[number] if 0 <= number < len(styles) else None
            parts.append(_part(model, style, chosen))
    return Shape(product, tuple(parts)) if parts else None


def _part(model: Model, style: Any, corners: Floats) -> Part:
    number = style.instance_id() if style is not None else 0
    entity = model.by_id(number) if number > 0 else None
    if entity is None or style is None:
        # What the kernel gives to surfaces without a style says nothing about them.
        return Part("", None, None, corners)
    clear = float(style.transparency)
    name = _model.text_of(entity, "Name")
    rgb = tuple(float(value) for value in (style.diffuse.r(), style.diffuse.g(), style.diffuse.b()))
    return Part(
        style=name,
        transparency=clear if np.isfinite(clear) else None,
        rgb=(rgb[0], rgb[1], rgb[2]) if np.isfinite(rgb).all() else None,
        corners=corners,
    )
