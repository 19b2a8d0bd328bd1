"""A model to a project: what of it is taken, and what stands in the project."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Mapping as MappingOf
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from quasilux._errors import input_error
from quasilux.ifc import (
    _fixtures,
    _geometry,
    _model,
    _openings,
    _site,
    _sources,
    _spaces,
    _surfaces,
    _workplanes,
)
from quasilux.ifc._files import FileName, ProjectFiles
from quasilux.ifc._findings import Findings
from quasilux.ifc._inside import Bodies
from quasilux.ifc._imported import GEOMETRY, Imported
from quasilux.ifc._mapping import Mapping, read_mapping

if TYPE_CHECKING:
    from quasilux.ifc._geometry import Floats, Shape
    from quasilux.ifc._spaces import Extent, Space

# Coordinates beyond it, in m, lose digits on the way: the model is moved to the origin.
_FAR_M = 1000.0
# A luminaire this far above a space, in m, is in its suspended ceiling.
_ABOVE_M = 0.5
_EXTENTS = ("space", "storey", "building")


def load_here(
    path: str | os.PathLike[str],
    *,
    mapping: str | os.PathLike[str] | MappingOf[str, Any] | None = None,
    space: str | Iterable[str] = (),
    storey: str | None = None,
    extent: Extent | None = None,
    weather: str | os.PathLike[str] | None = None,
    workplane_m: float = 0.75,
    wall_zone_m: float = 0.5,
    keep_bodies: bool = False,
) -> Imported:
    """Read a model in this process; the arguments are those of `quasilux.ifc.load`."""
    terms = _Terms(
        spaces=(space,) if isinstance(space, str) else tuple(space),
        storey=storey,
        extent=extent,
        workplane_m=_length_m(workplane_m, "workplane_m"),
        wall_zone_m=_length_m(wall_zone_m, "wall_zone_m"),
        keep_bodies=keep_bodies,
    )
    if extent is not None and extent not in _EXTENTS:
        raise input_error(f'extent is {extent!r}; expected "space", "storey" or "building"')
    read = read_mapping(mapping)
    return _Import(_model.Model(path, Findings()), read, terms).imported(weather)


def _length_m(value: float, name: str) -> float:
    if not (math.isfinite(value) and 0 <= value <= 100):
        raise input_error(f"{name} is {value!r}; expected 0 to 100 m")
    return float(value)


@dataclass(frozen=True)
class _Terms:
    spaces: tuple[str, ...]
    storey: str | None
    extent: Extent | None
    workplane_m: float
    wall_zone_m: float
    keep_bodies: bool

    @property
    def kept_extent(self) -> Extent:
        """What is there of the building."""
        if self.extent is not None:
            return self.extent
        return "space" if self.spaces else "storey" if self.storey else "building"


class _Import:
    """One model on its way to a project."""

    def __init__(self, model: _model.Model, mapping: Mapping, terms: _Terms) -> None:
        self.model = model
        self.mapping = mapping
        self.terms = terms
        self.findings = model.findings
        self.files = ProjectFiles()

    def imported(self, weather: str | os.PathLike[str] | None) -> Imported:
        """Read all, and describe the project."""
        model = self.model
        products = _geometry.products_with_surfaces(model)
        cut = _openings.openings_of(model, products)
        openings = [opening for those in cut.values() for opening in those]
        asked = [*products, *model.of_class("IfcSpace"), *openings]
        shapes = _geometry.shapes_of(model, asked)
        _openings.tell_uncut(model, cut, shapes)
        hollow = {opening.id() for opening in openings}
        shapes = {number: shape for number, shape in shapes.items() if number not in hollow}
        known = _spaces.spaces_of(model, shapes)
        bodies = {number: shape for number, shape in shapes.items() if not _is_space(shape)}
        _geometry.tell_missing(model, products, bodies)
        chosen = _spaces.chosen_spaces(known, self.terms.spaces, self.terms.storey, model)
        if not known:
            note = "the model has no spaces: add [[sensors]] to the project, or spaces to the model"
            self.findings.note(note)
        taken = self._taken(chosen, bodies)
        luminaires, lamps = self._luminaires(chosen, shapes)
        taken = {number: shape for number, shape in taken.items() if number not in lamps}
        self._tell_enclosed(luminaires, taken)
        if not taken:
            having = f"{len(products)} of its products have a shape" if products else "it has none"
            message = f"no element with surfaces ({having}); expected walls, floors or the like"
            raise input_error(message, model.name)
        made = _surfaces.surfaces_of(taken.values(), self.mapping, self.findings)
        if not made.objects:
            raise input_error("the mapping leaves out all surfaces of the model", model.name)
        origin = self._origin(made.objects)
        sections = self._sections(made, luminaires, origin, weather)
        sections += self._sensors(chosen, taken, origin)
        return Imported(
            name=model.name,
            head=self._head(chosen, taken),
            sections=sections,
            objects=[(name, material, at - origin) for name, material, at in made.objects],
            files=self.files.files,
            findings=self.findings.all(),
            spaces=tuple(space.title for space in chosen),
        )

    def _taken(self, chosen: list[Space], bodies: dict[int, Shape]) -> dict[int, Shape]:
        extent = self.terms.kept_extent
        if extent == "building" or not (chosen or self.terms.storey):
            return bodies
        if extent == "space":
            taken = _spaces.members(chosen, bodies, self.model)
        else:
            taken = _spaces.of_storeys(chosen, self.terms.storey, bodies)
        left_out = len(bodies) - len(taken)
        if left_out:
            self.findings.note(
                f"products away from the chosen {extent} ({left_out}) are left out, and shade no "
                'daylight; extent = "building" keeps them'
            )
        return taken

    def _luminaires(
        self, chosen: list[Space], shapes: dict[int, Shape]
    ) -> tuple[list[dict[str, Any]], set[int]]:
        """Keys of the luminaires in coordinates of the model, and the bodies that are left out."""
        model = self.model
        fixtures = _fixtures.fixtures_of(model, self.mapping)
        sources = _sources.sources_of(model)
        inside = [one for one in fixtures if self._is_in(one.product, one.frame[:3, 3], chosen)]
        if len(inside) < len(fixtures):
            count = len(fixtures) - len(inside)
            self.findings.note(f"fixtures of other spaces ({count}) are left out")
        keep = self.terms.keep_bodies
        placed = _fixtures.place_fixtures(model, inside, self.mapping, shapes)
        unmapped = {fixture.product.id() for fixture in placed.unmapped}
        mapped = {fixture.product.id() for fixture in inside} - unmapped
        luminaires = [self._with_file(keys) for keys in placed.luminaires]
        lit: set[int] = set()
        for source in sources:
            number = source.product.id()
            if number in mapped:
                note = "the mapping goes before the goniometric source of a fixture"
                self.findings.note(note, _model.label(source.product))
            elif self._is_in(source.product, source.frame[:3, 3], chosen):
                lit.add(number)
                luminaires.append(self._of_source(source))
        _fixtures.tell_unmapped(model, [f for f in placed.unmapped if f.product.id() not in lit])
        bodies = _fixtures.without_bodies(fixtures, self.mapping, keep_bodies=keep)
        if not keep:
            bodies |= lit | _fixtures.lamps_of(model)
        if bodies & set(shapes):
            count = len(bodies & set(shapes))
            self.findings.note(
                f"bodies of light fixtures ({count}) are left out: they would stand in their light"
            )
        return luminaires, bodies

    def _is_in(self, product: Any, position: Floats, chosen: list[Space]) -> bool:
        """Whether a fixture is in what was chosen: a space, a storey or all."""
        terms = self.terms
        if not (terms.spaces or terms.storey) or _is_in(product, position, chosen):
            return True
        names = _spaces.storey_names((), terms.storey)
        return not terms.spaces and _spaces.is_in_storeys(product, names)

    def _tell_enclosed(self, luminaires: list[dict[str, Any]], taken: dict[int, Shape]) -> None:
        """Tell of luminaires whose light begins inside a body, as above an uncut ceiling."""
        if not luminaires:
            return
        aims = np.array([np.asarray(keys["aim"], dtype=float) for keys in luminaires])
        aims /= np.linalg.norm(aims, axis=1)[:, None]
        begin = np.array([keys["position"] for keys in luminaires]) + 1e-3 * aims
        for place in begin[Bodies(taken.values()).hold(begin)]:
            at = ", ".join(f"{value:.3f}" for value in place)
            self.findings.note(
                "a luminaire inside a body, which keeps its light: move it by offset_m in the "
                "mapping, or cut the body",
                f"({at}) m",
            )

    def _with_file(self, keys: dict[str, Any]) -> dict[str, Any]:
        name = self.files.copy(keys["photometry"], self.mapping.folder, self.mapping.file)
        return {**keys, "photometry": FileName(name)}

    def _of_source(self, source: _sources.Source) -> dict[str, Any]:
        name = self.files.add(source.title + source.ending, source.data)
        turn = source.frame[:3, :3]
        return {
            "photometry": FileName(name),
            "position": source.frame[:3, 3],
            "aim": -turn[:, 2],
            "c0": turn[:, 0],
        }

    def _origin(self, objects: list[tuple[str, str, Floats]]) -> Floats:
        """What is subtracted from coordinates: whole metres, where the model lies far away."""
        low = np.min([corners.min(axis=(0, 1)) for _, _, corners in objects], axis=0)
        high = np.max([corners.max(axis=(0, 1)) for _, _, corners in objects], axis=0)
        size = float((high - low).max())
        if size > 10_000 or size < 0.5:
            self.findings.note(
                f"the model is {size:.3g} m large: its unit of length ({self.model.unit_m:g} m) "
                "may be wrong"
            )
        if max(np.abs(low).max(), np.abs(high).max()) <= _FAR_M:
            return np.zeros(3)
        origin = np.floor((low + high) / 2)
        origin[2] = np.floor(low[2]) if max(abs(low[2]), abs(high[2])) > _FAR_M else 0.0
        at = ", ".join(f"{value:g}" for value in origin)
        self.findings.note(f"the model lies far from its origin: ({at}) m is subtracted everywhere")
        return origin

    def _head(self, chosen: list[Space], taken: dict[int, Shape]) -> list[str]:
        name = _surfaces.obj_name(os.path.basename(self.model.name))
        return [
            f"Made of the {self.model.schema} model {name} by quasilux.ifc:",
            f"{len(taken)} products, {len(chosen)} spaces.",
        ]

    def _sections(
        self,
        made: _surfaces.Surfaces,
        luminaires: list[dict[str, Any]],
        origin: Floats,
        weather: str | os.PathLike[str] | None,
    ) -> list[tuple[str, dict[str, Any]]]:
        scene: dict[str, Any] = {"geometry": [FileName(GEOMETRY)]}
        sections: list[tuple[str, dict[str, Any]]] = [("[scene]", scene)]
        materials = {
            name: self.files.of_material(keys, self.mapping.folder, self.mapping.file)
            for name, keys in made.materials.items()
        }
        sections.append(("[materials]", materials))
        sections += [("[[luminaires]]", _rounded(keys, origin)) for keys in luminaires]
        site = _site.site_of(self.model)
        if site:
            sections.append(("[site]", site))
        return sections + self._outside(bool(luminaires), weather)

    def _sensors(
        self, chosen: list[Space], taken: dict[int, Shape], origin: Floats
    ) -> list[tuple[str, dict[str, Any]]]:
        terms = _workplanes.Terms(
            self.terms.workplane_m, self.terms.wall_zone_m, origin, Bodies(taken.values())
        )
        sensors = _workplanes.workplanes(chosen, terms, self.findings)
        if chosen and not sensors:
            self.findings.note("no space has a workplane: add [[sensors]] to the project")
        return [("[[sensors]]", sensor) for sensor in sensors]

    def _outside(
        self, has_lamps: bool, weather: str | os.PathLike[str] | None
    ) -> list[tuple[str, dict[str, Any]]]:
        """The sky: that of the weather file, or without any light an overcast one."""
        if weather is not None:
            name = self.files.copy(os.fsdecode(weather), "", self.model.name)
            return [("[sky]", {"model": "weather"}), ("[weather]", {"file": FileName(name)})]
        if has_lamps:
            return []
        note = "there is no luminaire: an overcast sky of 10,000 lx (CIE type 16) lights the model"
        self.findings.note(note)
        sky = {"model": "cie", "type": 16, "horizontal_illuminance_lx": 10000}
        return [("[sky]", sky)]


def _is_space(shape: Shape) -> bool:
    return _model.is_a(shape.product, "IfcSpace")


def _rounded(keys: dict[str, Any], origin: Floats) -> dict[str, Any]:
    """Vectors of a luminaire as lists, its position from the origin of the project."""
    rounded = {**keys, "position": np.asarray(keys["position"]) - origin}
    for name in ("position", "aim", "c0"):
        rounded[name] = (np.round(rounded[name], 9) + 0.0).tolist()
    return rounded


def _is_in(product: Any, position: Floats, spaces: Iterable[Space]) -> bool:
    """Whether the model puts a product into one of the spaces, or it lies in one or above it."""
    import shapely
    import ifcopenshell.util.element as elements

    try:
        container = elements.get_container(product)
    except Exception:
        container = None
    for space in spaces:
        if container is not None and container.id() == space.entity.id():
            return True
        box = space.box_m
        if box is None or space.corners is None:
            continue
        if not box[0][2] <= position[2] <= box[1][2] + _ABOVE_M:
            continue
        footprint = space.footprint
        if footprint is not None and bool(shapely.contains_xy(footprint, *position[:2])):
            return True
    return False
