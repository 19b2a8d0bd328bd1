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
    """

    luminaires: list[dict[str, Any]]
    unmapped: list[Fixture]


def place_fixtures(
    model: Model,
    fixtures: Iterable[Fixture],
    mapping: Mapping,
    shapes: dict[int, Shape],
) -> Placed:
    """Give fixtures the photometric files of a mapping, in m and coordinates of the model."""
    placed = Placed([], [])
    used: set[str] = set()
    for fixture in fixtures:
        entry = mapping.luminaire(fixture.names)
        if entry is None:
            placed.unmapped.append(fixture)
            continue
        key, keys = entry
        used.add(key)
        if keys.get("skip"):
            message = f'fixtures of "{key}" are left out, as the mapping says'
            model.findings.note(message, _model.label(fixture.product))
            continue
        placed.luminaires.append(_luminaire(model, fixture, keys, shapes))
    for key in mapping.luminaires:
        if key not in used and "*" not in key:
            model.findings.note(f'no fixture is called "{key}", which the mapping has a file for')
    return placed


def without_bodies(
    fixtures: Iterable[Fixture], mapping: Mapping, *, keep_bodies: bool
) -> set[int]:
    """Return the numbers of the fixtures whose bodies do not stay."""
    found: set[int] = set()
    for fixture in fixtures:
        entry = mapping.luminaire(fixture.names)
        keys = entry[1] if entry is not None else {}
        if not keys.get("keep_body", keep_bodies):
            found.add(fixture.product.id())
    return found


def _luminaire(
    model: Model, fixture: Fixture, keys: dict[str, Any], shapes: dict[int, Shape]
) -> dict[str, Any]:
    turn = _turn(fixture.frame)
    offset = np.array(keys.get("offset_m", (0.0, 0.0, 0.0)), dtype=float)
    aim = np.array(keys.get("aim", (0.0, 0.0, -1.0)), dtype=float)
    # Light along x has its C0 along y, where the mapping does not say.
    along_x = np.linalg.norm(aim[1:]) < 1e-6 * np.linalg.norm(aim)
    c0 = np.array(keys.get("c0", (0.0, 1.0, 0.0) if along_x else (1.0, 0.0, 0.0)), dtype=float)
    centre = np.zeros(3)
    if keys.get("position", "auto") == "auto" and fixture.product.id() in shapes:
        centre = _centre(model, fixture, turn, aim, shapes[fixture.product.id()])
    position = fixture.frame[:3, 3] + turn @ (centre + offset)
    axes = {"aim": turn @ aim, "c0": turn @ c0}
    _tell_maintenance(model, fixture)
    others = ("as", "rotation_deg", "dimming", "flux_lm")
    rest = {name: keys[name] for name in others if name in keys}
    return {"photometry": keys["photometry"], "position": position, **axes, **rest}


def _turn(frame: Floats) -> Floats:
    """The rotation of a placement, without scale."""
    turn = frame[:3, :3]
    length = np.linalg.norm(turn, axis=0)
    return turn / np.where(length > 0, length, 1.0)


def _centre(
    model: Model, fixture: Fixture, turn: Floats, aim: Floats, shape: Shape
) -> Floats:
    """The photometric centre in coordinates of the fixture, in m.

    It is the origin, where that is at the side of the body that the light leaves, mostly the lower
    one; else the middle of that side: an origin at the ceiling is not where a pendant shines, and
    one above the body of a recessed luminaire is above the ceiling.
    """
    local = (shape.corners.reshape(-1, 3) - fixture.frame[:3, 3]) @ turn
    low, high = local.min(axis=0), local.max(axis=0)
    if high[1] - low[1] > _OBLONG * (high[0] - low[0]):
        model.findings.note(
            "the body of a fixture is longer along its y than along x, where C0 and the length of "
            "photometric files lie: if its light is turned, set rotation_deg = 90 in the mapping",
            _model.label(fixture.product),
        )
    axis = int(np.abs(aim).argmax())
    side = (high if aim[axis] > 0 else low)[axis]
    is_within = (low <= _AT_LOWER_SIDE_M).all() and (high >= -_AT_LOWER_SIDE_M).all()
    if is_within and abs(side) <= _AT_LOWER_SIDE_M:
        return np.zeros(3)
    which = "side that it aims at"
    if axis == 2:
        which = "upper side" if aim[axis] > 0 else "lower side"
    model.findings.note(
        f"the photometric centre is the middle of the {which} of the body, and not the origin of "
        'the fixture; position = "origin" in the mapping keeps that',
        _model.label(fixture.product),
    )
    centre = (low + high) / 2
    centre[axis] = side
    return centre


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
