"""Light fixtures: where they are, how they are turned, and which photometric file each has.

IFC says what a fixture is and where it is placed, and not how its light lies in its coordinates.
As in most libraries of components z points up: light of gamma = 0 leaves along -z, and C0, along
which the luminous length of photometric files lies, is x. A mapping says otherwise by `aim` and
`c0`.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from quasilux.ifc import _model

if TYPE_CHECKING:
    from quasilux.ifc._geometry import Floats, Shape
    from quasilux.ifc._mapping import Mapping
    from quasilux.ifc._model import Model

# The origin of a fixture is its photometric centre where it lies within this of its lower side.
_AT_LOWER_SIDE_M = 0.005
# Ratio of the sides of a body from which on it has a direction.
_OBLONG = 1.2


@dataclass(frozen=True)
class Fixture:
    """A light fixture of a model.

    Attributes
    ----------
    names : tuple of str
        What a mapping may call it: its type, the types of its object, its own name, its GlobalId.
    frame : ndarray of shape (4, 4)
        Its placement, in m.
    """

    product: Any
    names: tuple[str, ...]
    frame: Floats

    @property
    def title(self) -> str:
        """The name of its type."""
        return self.names[0]


# Classes by which exporters write fixtures that they know no better: a mapping may name them.
_MAY_BE_FIXTURES = ("IfcBuildingElementProxy", "IfcDistributionElement", "IfcFurnishingElement")


def fixtures_of(model: Model, mapping: Mapping | None = None) -> list[Fixture]:
    """Return all light fixtures of a model, and what a mapping names as one."""
    found: list[Fixture] = []
    for product in _fixture_products(model, mapping):
        place = model.placement(product)
        if place is None:
            message = "a fixture whose placement cannot be resolved is left out"
            model.findings.note(message, _model.label(product))
            continue
        frame = place.copy()
        frame[:3, 3] *= model.unit_m
        found.append(Fixture(product, _names(product), frame))
    return found


def _fixture_products(model: Model, mapping: Mapping | None) -> list[Any]:
    """IfcLightFixture, in IFC2x3 what has an IfcLightFixtureType, and what a mapping names."""
    found = {product.id(): product for product in model.of_class("IfcLightFixture")}
    for product in model.of_class("IfcFlowTerminal"):
        if _is_typed(product, "IfcLightFixtureType"):
            found[product.id()] = product
    known = {name.casefold() for name in (mapping.luminaires if mapping is not None else ())}
    for ifc_class in _MAY_BE_FIXTURES if known else ():
        for product in model.of_class(ifc_class):
            if known.intersection(name.casefold() for name in _names(product)):
                found[product.id()] = product
    return [found[number] for number in sorted(found)]


def lamps_of(model: Model) -> set[int]:
    """Return the numbers of the lamps within fixtures, whose bodies would stand in the light."""
    found = {product.id() for product in model.of_class("IfcLamp")}
    terminals = model.of_class("IfcFlowTerminal")
    return found | {one.id() for one in terminals if _is_typed(one, "IfcLampType")}


def _is_typed(product: Any, ifc_class: str) -> bool:
    ifc_type = _model.type_of(product)
    return ifc_type is not None and _model.is_a(ifc_type, ifc_class)


def _names(product: Any) -> tuple[str, ...]:
    ifc_type = _model.type_of(product)
    names = [
        _model.text_of(ifc_type, "Name"),
        _model.text_of(product, "ObjectType"),
        _model.text_of(product, "Name"),
        _model.text_of(product, "GlobalId"),
    ]
    return tuple(dict.fromkeys(name for name in names if name)) or ("without a name",)


def counted(fixtures: Iterable[Fixture]) -> dict[str, int]:
    """Return how many fixtures there are of each type."""
    counts: dict[str, int] = {}
    for fixture in fixtures:
        counts[fixture.title] = counts.get(fixture.title, 0) + 1
    return dict(sorted(counts.items()))


@dataclass
class Placed:
    """Fixtures of a project.

    Attributes
    ----------
    luminaires : list of dict
        Keys of each; ``photometry`` is the name that the mapping has for its file.
    unmapped : list of Fixture
        Those of types that no mapping has a file for.
    kept_bodies : set of int
        Numbers of products whose bodies stay.
    """

    luminaires: list[dict[str, Any]]
    unmapped: list[Fixture]
    kept_bodies: set[int]


def place_fixtures(
    model: Model,
    fixtures: Iterable[Fixture],
    mapping: Mapping,
    shapes: dict[int, Shape],
    *,
    keep_bodies: bool,
) -> Placed:
    """Give fixtures the photometric files of a mapping, in m and coordinates of the model."""
    placed = Placed([], [], set())
    used: set[str] = set()
    for fixture in fixtures:
        entry = mapping.luminaire(fixture.names)
        if entry is None:
            placed.unmapped.append(fixture)
            if keep_bodies:
                placed.kept_bodies.add(fixture.product.id())
            continue
        key, keys = entry
        used.add(key)
        if keys.get("keep_body", keep_bodies):
            placed.kept_bodies.add(fixture.product.id())
        if keys.get("skip"):
            message = f'fixtures of "{key}" are left out, as the mapping says'
            model.findings.note(message, _model.label(fixture.product))
            continue
        placed.luminaires.append(_luminaire(model, fixture, keys, shapes))
    for key in mapping.luminaires:
        if key not in used and "*" not in key:
            model.findings.note(f'no fixture is called "{key}", which the mapping has a file for')
    return placed


def _luminaire(
    model: Model, fixture: Fixture, keys: dict[str, Any], shapes: dict[int, Shape]
) -> dict[str, Any]:
    turn = _turn(fixture.frame)
    offset = np.array(keys.get("offset_m", (0.0, 0.0, 0.0)), dtype=float)
    centre = np.zeros(3)
    if keys.get("position", "auto") == "auto" and fixture.product.id() in shapes:
        centre = _centre(model, fixture, turn, shapes[fixture.product.id()])
    position = fixture.frame[:3, 3] + turn @ (centre + offset)
    axes = {
        name: turn @ np.array(keys.get(name, default), dtype=float)
        for name, default in (("aim", (0.0, 0.0, -1.0)), ("c0", (1.0, 0.0, 0.0)))
    }
    _tell_maintenance(model, fixture)
    others = ("as", "rotation_deg", "dimming", "flux_lm")
    rest = {name: keys[name] for name in others if name in keys}
    return {"photometry": keys["photometry"], "position": position, **axes, **rest}


def _turn(frame: Floats) -> Floats:
    """The rotation of a placement, without scale."""
    turn = frame[:3, :3]
    length = np.linalg.norm(turn, axis=0)
    return turn / np.where(length > 0, length, 1.0)


def _centre(model: Model, fixture: Fixture, turn: Floats, shape: Shape) -> Floats:
    """The photometric centre in coordinates of the fixture, in m.

    It is the origin, where that is at the lower side of the body; else the middle of the lower
    side: an origin at the ceiling is not where a pendant shines, and one above the body of a
    recessed luminaire is above the ceiling.
    """
    local = (shape.corners.reshape(-1, 3) - fixture.frame[:3, 3]) @ turn
    low, high = local.min(axis=0), local.max(axis=0)
    if high[1] - low[1] > _OBLONG * (high[0] - low[0]):
        model.findings.note(
            "the body of a fixture is longer along its y than along x, where C0 and the length of "
            "photometric files lie: if its light is turned, set rotation_deg = 90 in the mapping",
            _model.label(fixture.product),
        )
    is_within = (low[:2] <= _AT_LOWER_SIDE_M).all() and (high[:2] >= -_AT_LOWER_SIDE_M).all()
    if is_within and abs(low[2]) <= _AT_LOWER_SIDE_M:
        return np.zeros(3)
    model.findings.note(
        "the photometric centre is the middle of the lower side of the body, and not the origin of "
        'the fixture; position = "origin" in the mapping keeps that',
        _model.label(fixture.product),
    )
    return np.array([(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, low[2]])


def _tell_maintenance(model: Model, fixture: Fixture) -> None:
    for values in _model.psets_of(fixture.product).values():
        factor = values.get("MaintenanceFactor") if isinstance(values, dict) else None
        if isinstance(factor, (int, float)) and 0 < factor < 1:
            model.findings.note(
                f"a maintenance factor of {factor:g} is not used: set maintenance_factor in "
                "[scene], or dimming in the mapping",
                _model.label(fixture.product),
            )
            return


def tell_unmapped(model: Model, fixtures: Iterable[Fixture]) -> None:
    """Tell how many fixtures of each type have no photometric file."""
    for title, count in counted(fixtures).items():
        model.findings.note(
            f'fixtures of "{title}" ({count}) have no light: give [luminaires."{title}"] with '
            "photometry in a mapping"
        )
