"""What a model has that a mapping may name: spaces, types of fixtures, styles and classes."""

from __future__ import annotations

import os
from dataclasses import dataclass

from quasilux.ifc import _fixtures, _geometry, _model, _spaces
from quasilux.ifc._findings import Finding, Findings


@dataclass(frozen=True)
class SpaceEntry:
    """A space of a model.

    Attributes
    ----------
    global_id, name, long_name, storey : str
        As in the model; empty where it has none.
    area_m2, height_m : float or None
        Of its shape: what it covers in plan, and from its lowest to its highest point.
    """

    global_id: str
    name: str
    long_name: str
    storey: str
    area_m2: float | None
    height_m: float | None


@dataclass(frozen=True)
class Survey:
    """What a model has.

    Attributes
    ----------
    schema : str
        The schema, such as ``"IFC4"``.
    unit_m : float
        Its unit of length in m.
    spaces : tuple of SpaceEntry
        All spaces.
    fixtures : dict of str to int
        Numbers of light fixtures by the names of their types.
    styles : dict of str to dict of str to int
        For each style or material the classes that have it, with numbers of products.
    findings : tuple of Finding
        What cannot be read.
    """

    schema: str
    unit_m: float
    spaces: tuple[SpaceEntry, ...]
    fixtures: dict[str, int]
    styles: dict[str, dict[str, int]]
    findings: tuple[Finding, ...]

    def __str__(self) -> str:
        lines = [f"{self.schema}, unit of length {self.unit_m:g} m", "", "spaces"]
        lines += [_space_line(space) for space in self.spaces] or ["  none"]
        lines += ["", "light fixtures by type"]
        lines += [f"  {count:5}  {name}" for name, count in self.fixtures.items()] or ["  none"]
        lines += ["", "styles and materials"]
        for name, classes in self.styles.items():
            counts = ", ".join(f"{one} {count}" for one, count in classes.items())
            lines.append(f"  {name or '(no style)'}: {counts}")
        return "\n".join(lines)


def _space_line(space: SpaceEntry) -> str:
    size = "no shape"
    if space.area_m2 is not None and space.height_m is not None:
        size = f"{space.area_m2:.2f} m2, {space.height_m:.2f} m high"
    title = " ".join(part for part in (space.name, space.long_name) if part)
    return f"  {space.global_id}  {title}  [{space.storey}]  {size}"


def survey_here(path: str | os.PathLike[str]) -> Survey:
    """List what a model has, in this process."""
    model = _model.Model(path, Findings())
    products = _geometry.products_with_surfaces(model)
    shapes = _geometry.shapes_of(model, [*products, *model.of_class("IfcSpace")])
    spaces = _spaces.spaces_of(model, shapes)
    bodies = [shapes[product.id()] for product in products if product.id() in shapes]
    _geometry.tell_missing(model, products, shapes)
    return Survey(
        schema=model.schema,
        unit_m=model.unit_m,
        spaces=tuple(map(_entry, spaces)),
        fixtures=_fixtures.counted(_fixtures.fixtures_of(model)),
        styles=_styles(bodies),
        findings=model.findings.all(),
    )


def _entry(space: _spaces.Space) -> SpaceEntry:
    box = space.box_m
    area = height = None
    if box is not None:
        area = float(space.footprint.area) if space.footprint is not None else 0.0
        height = float(box[1][2] - box[0][2])
    return SpaceEntry(
        space.global_id, space.name, space.long_name, space.storey, area, height
    )


def _styles(bodies: list[_geometry.Shape]) -> dict[str, dict[str, int]]:
    found: dict[str, dict[str, int]] = {}
    for shape in bodies:
        materials = _model.material_names(shape.product)
        only = materials[0] if len(materials) == 1 else ""
        names = {part.style or only for part in shape.parts}
        for name in names:
            classes = found.setdefault(name, {})
            of_class = shape.product.is_a()
            classes[of_class] = classes.get(of_class, 0) + 1
    return {name: dict(sorted(found[name].items())) for name in sorted(found)}
