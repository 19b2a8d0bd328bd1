"""Surfaces of a project: facets of a model by the materials that stand for its styles."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from quasilux.ifc import _glass, _model
from quasilux.ifc._geometry import Part, Shape
from quasilux.ifc._solids import is_closed, outward

if TYPE_CHECKING:
    from quasilux.ifc._findings import Findings
    from quasilux.ifc._geometry import Floats
    from quasilux.ifc._mapping import Mapping

# Reflectances where a mapping says nothing: the customary values of interior lighting, and those
# that EN 12464-1:2021, 4.2.2 recommends for ceilings, walls and floors lie around them.
REFLECTANCES = {
    "ceiling": 0.7,
    "wall": 0.5,
    "floor": 0.2,
    "ground": 0.2,
    "door": 0.5,
    "frame": 0.5,
    "furniture": 0.5,
    "equipment": 0.5,
    "other": 0.5,
}
_MANY = {
    "ceiling": "ceilings",
    "wall": "walls",
    "floor": "floors",
    "door": "doors",
    "frame": "frames",
    "other": "other parts",
}
# Light transmittance at normal incidence of a clear double glazing.
GLASS_TRANSMITTANCE = 0.78

# Styles at least as clear are glass.
_LEAST_CLEAR = 0.3
_GLASS = re.compile(
    r"glass|glaz|glas\b|verglasung|verre|vitrage|vidrio|vetro|vidro|szk[lł]"
    r"|стекл|玻璃|ガラス",
    re.IGNORECASE,
)
_NO_GLASS = re.compile(r"wool|fib(re|er)|faser|block|laine|grp|gfk|frame|bead", re.IGNORECASE)

# The first class that a product is of says what its surfaces are.
_ROLES = (
    ("IfcWindow", "frame"),
    ("IfcDoor", "door"),
    ("IfcCovering", "oriented"),
    ("IfcSlab", "oriented"),
    ("IfcRoof", "oriented"),
    ("IfcStair", "oriented"),
    ("IfcStairFlight", "oriented"),
    ("IfcRamp", "oriented"),
    ("IfcRampFlight", "oriented"),
    ("IfcBuildingElementPart", "oriented"),
    ("IfcWall", "wall"),
    ("IfcCurtainWall", "wall"),
    ("IfcColumn", "wall"),
    ("IfcBeam", "ceiling"),
    ("IfcMember", "frame"),
    ("IfcSite", "ground"),
    ("IfcGeographicElement", "ground"),
    ("IfcFurnishingElement", "furniture"),
    ("IfcDistributionElement", "equipment"),
)
# How coverings that are surfaces without thickness face, by their type.
_SHEETS = {"CEILING": -1.0, "FLOORING": 1.0}
# A window that is one body is no thicker.
_MOST_WINDOW_M = 0.5
# Cosine to the vertical beyond which a facet is a floor or a ceiling.
_STEEP = 0.7


@dataclass
class Surfaces:
    """Triangles by object and material, and the keys of the materials.

    Attributes
    ----------
    objects : list of (str, str, ndarray)
        Name of the object, name of the material, corners in m.
    materials : dict
        Keys of the project by names of materials.
    default_of : dict
        For materials that no mapping names, what they were taken for.
    """

    objects: list[tuple[str, str, Floats]] = field(default_factory=list)
    materials: dict[str, dict[str, Any]] = field(default_factory=dict)
    default_of: dict[str, str] = field(default_factory=dict)


def surfaces_of(shapes: Iterable[Shape], mapping: Mapping, findings: Findings) -> Surfaces:
    """Give each facet of shapes its material."""
    maker = _Maker(mapping, findings)
    for shape in shapes:
        maker.add(shape)
    maker.tell_defaults()
    maker.tell_unused()
    return maker.surfaces


@dataclass(frozen=True)
class _Material:
    """A material of the project: named by a key of the mapping, or by a default role."""

    name: str
    keys: dict[str, Any]
    key: str = ""
    role: str = ""


@dataclass(frozen=True)
class _Pane:
    sheet: _glass.Sheet
    material: _Material

    @property
    def area_m2(self) -> float:
        return _area_m2(self.sheet.corners)

    def is_behind(self, other: _Pane) -> bool:
        """Whether another pane stands for this one: two names of the mapping stay two panes."""
        is_named_apart = self.material.key and self.material.key != other.material.key
        return not is_named_apart and _glass.is_behind(self.sheet, other.sheet)


class _Maker:
    def __init__(self, mapping: Mapping, findings: Findings) -> None:
        self.mapping = mapping
        self.findings = findings
        self.surfaces = Surfaces()
        self._key_of: dict[str, str] = {}
        self._used: set[str] = set()

    def add(self, shape: Shape) -> None:
        """Add all parts of a product."""
        product = shape.product
        if _role(product) == "oriented":
            shape = outward(shape)
        place = _model.label(product)
        materials = _model.material_names(product)
        parts = _parted(shape, place, materials, self.findings)
        panes: list[_Pane] = []
        for part, is_glass in parts:
            names = _names(product, part, materials)
            mapped = self.mapping.material(names)
            style = part.style or (materials[0] if len(materials) == 1 else "")
            if mapped is not None:
                panes += self._add_mapped(place, part.corners, style, mapped)
            elif is_glass:
                glass = self._default(f"glass {style}".strip(), "glass")
                panes += self._sheets(place, part.corners, glass)
            else:
                self._add_default(place, product, part.corners, style)
        self._add_panes(place, panes)

    def _add_mapped(
        self, place: str, corners: Floats, style: str, mapped: tuple[str, dict[str, Any]]
    ) -> list[_Pane]:
        key, entries = mapped
        self._used.add(key)
        if entries.get("skip") is True:
            self.findings.note(f'facets of "{key}" are left out, as the mapping says', place)
            return []
        material = _Material(self._named(style or key, key), dict(entries), key)
        kind = entries.get("kind", "diffuse")
        if kind in ("pane", "glazing", "bsdf") or entries.get("transmittance"):
            return self._sheets(place, corners, material)
        self._emit(place, material, corners)
        return []

    def _sheets(self, place: str, corners: Floats, material: _Material) -> list[_Pane]:
        """Flat panes of a part; what is none is emitted."""
        sheets = _glass.sheets_of(corners)
        for body in sheets.solid:
            if not is_closed(body):
                self._emit(place, material, body)
            elif material.role:
                solid = self._default(f"{material.name} body", "glass body")
                self._emit(place, solid, body)
            else:
                message = (
                    f'a body of "{material.name}" that is no thin flat pane keeps its facets: '
                    "light passes two of them"
                )
                self.findings.note(message, place)
                self._emit(place, material, body)
        return [_Pane(sheet, material) for sheet in sheets.flat]

    def _add_panes(self, place: str, panes: list[_Pane]) -> None:
        """Emit panes of a product; of panes behind one another those that the mapping names."""
        kept: list[_Pane] = []
        # Larger panes first, and those of the mapping before them.
        for pane in sorted(panes, key=lambda pane: (bool(pane.material.role), -pane.area_m2)):
            if any(pane.is_behind(other) for other in kept):
                note = (
                    "panes behind one another are one sheet, whose material stands for all of them"
                )
                self.findings.note(note, place)
            else:
                kept.append(pane)
        for pane in panes:
            if any(pane is one for one in kept):
                self._emit(place, pane.material, pane.sheet.corners)

    def _add_default(self, place: str, product: Any, corners: Floats, style: str) -> None:
        for which, facets in _by_role(product, corners, place, self.findings).items():
            self._emit(place, self._default(f"{which} {style}".strip(), which), facets)

    def _default(self, name: str, role: str) -> _Material:
        """Return a material with the default of what it was taken for."""
        return _Material(self._named(name, f"default {role}"), _default(role), role=role)

    def _named(self, name: str, key: str) -> str:
        """Return a name that an OBJ file can hold, and that no other key has."""
        plain = obj_name(name) or "material"
        candidate, number = plain, 2
        while self._key_of.setdefault(candidate, key) != key:
            candidate, number = f"{plain} {number}", number + 1
        return candidate

    def _emit(self, place: str, material: _Material, corners: Floats) -> None:
        self.surfaces.materials.setdefault(material.name, material.keys)
        if material.role:
            self.surfaces.default_of[material.name] = material.role
        self.surfaces.objects.append((obj_name(place), material.name, corners))

    def tell_unused(self) -> None:
        """Tell which names of the mapping nothing has."""
        for key in self.mapping.materials:
            if key not in self._used:
                self.findings.note(f'no facet is of "{key}", which the mapping has a material for')

    def tell_defaults(self) -> None:
        """Tell which materials have properties that no mapping and no file gave."""
        by_role: dict[str, list[str]] = {}
        for name, role in self.surfaces.default_of.items():
            by_role.setdefault(role, []).append(name)
        for role, names in sorted(by_role.items()):
            for name in names:
                self.findings.note(_told(role), f'"{name}"')


def _default(role: str) -> dict[str, Any]:
    if role == "glass":
        return {"kind": "pane", "transmittance": GLASS_TRANSMITTANCE}
    if role == "glass body":
        return {"kind": "dielectric", "eta": 1.5}
    return {"kind": "diffuse", "reflectance": REFLECTANCES[role]}


def _told(role: str) -> str:
    if role == "glass":
        return (
            f"a pane of transmittance {GLASS_TRANSMITTANCE} by default, as of clear double "
            "glazing; give [materials.NAME] in a mapping"
        )
    if role == "glass body":
        return "glass that is no flat pane: a clear body of refractive index 1.5"
    return (
        f"reflectance {REFLECTANCES[role]} by default, for {_MANY.get(role, role)}; give "
        "[materials.NAME] in a mapping"
    )


def _role(product: Any) -> str:
    return next((role for name, role in _ROLES if _model.is_a(product, name)), "other")


def _by_role(
    product: Any, corners: Floats, place: str, findings: Findings
) -> dict[str, Floats]:
    """Facets of slabs and the like by the way they face."""
    role = _role(product)
    if role != "oriented":
        return {role: corners}
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(cross, axis=1)
    upward = np.divide(cross[:, 2], length, out=np.zeros(len(length)), where=length > 0)
    if not (upward > _STEEP).any() or not (upward < -_STEEP).any():
        # A surface without thickness.
        side = _SHEETS.get(str(_model.get(product, "PredefinedType")))
        if side is not None:
            upward = np.where(np.abs(upward) > _STEEP, side, 0.0)
        elif (np.abs(upward) > _STEEP).any():
            message = "a surface without thickness is floor or ceiling by the way it faces"
            findings.note(message, place)
    masks = {"floor": upward > _STEEP, "ceiling": upward < -_STEEP}
    masks["wall"] = ~(masks["floor"] | masks["ceiling"])
    return {which: corners[mask] for which, mask in masks.items() if mask.any()}


def _names(product: Any, part: Part, materials: tuple[str, ...]) -> list[str]:
    """Names by which a mapping may know a part, the most special first."""
    names = [part.style, *(materials if not part.style or len(materials) == 1 else ())]
    ifc_type = _model.type_of(product)
    names.append(_model.text_of(ifc_type, "Name"))
    names.append(product.is_a())
    # Ancestors, so that IfcWall is for an IfcWallStandardCase too.
    names += [name for name, _ in _ROLES if _model.is_a(product, name)]
    return list(dict.fromkeys(name for name in names if name))


def is_glass_name(name: str) -> bool:
    """Whether a name is that of a glass."""
    return bool(_GLASS.search(name)) and not _NO_GLASS.search(name)


def _is_glass(part: Part, materials: tuple[str, ...]) -> bool:
    if part.transparency is not None and part.transparency >= _LEAST_CLEAR:
        return True
    if part.style:
        return is_glass_name(part.style)
    return len(materials) == 1 and is_glass_name(materials[0])


def _parted(
    shape: Shape, place: str, materials: tuple[str, ...], findings: Findings
) -> list[tuple[Part, bool]]:
    """Parts of a product, and which are glass; windows that do not tell are parted by shape."""
    parts = [(part, _is_glass(part, materials)) for part in shape.parts]
    if not _model.is_a(shape.product, "IfcWindow"):
        return parts
    if any(is_glass for _, is_glass in parts):
        return _one_pane(shape, parts)
    bodies = [(part, body) for part in shape.parts for body in _glass.bodies_of(part.corners)]
    panes = [_is_pane_of(body, shape) for _, body in bodies]
    whole = _one_pane(shape, [(part, True) for part in shape.parts])
    if len(bodies) == 1 and whole[0][0] is not shape.parts[0]:
        # One body that fills the opening.
        message = "a window of one body, which no style tells to be glass: all of it is a pane"
        bodies, panes = [(whole[0][0], whole[0][0].corners)], [True]
    elif any(panes):
        message = "no style tells its glass: thin flat bodies that fill most of it are panes"
    else:
        message = (
            "a window without glass: no style tells it, and no body has the shape of a pane; give "
            "[materials.NAME] of its style or type in a mapping"
        )
    findings.note(message, place)
    found: list[tuple[Part, bool]] = []
    for (part, body), is_pane in zip(bodies, panes):
        found.append((Part(part.style, part.transparency, part.rgb, body), is_pane))
    return found


def _one_pane(shape: Shape, parts: list[tuple[Part, bool]]) -> list[tuple[Part, bool]]:
    """A window of one body of glass, thick as a frame, as a sheet; others as they are."""
    bodies = _glass.bodies_of(shape.corners)
    if len(parts) != 1 or len(bodies) != 1:
        return parts
    flat = _glass.sheets_of(bodies[0], thickness_m=_MOST_WINDOW_M).flat
    if not flat:
        return parts
    return [(dataclasses.replace(parts[0][0], corners=flat[0].corners), parts[0][1])]


def _is_pane_of(body: Floats, shape: Shape) -> bool:
    """Whether a body of a window is flat, thin, and fills a tenth of the window or more."""
    sheets = _glass.sheets_of(body)
    if len(sheets.flat) != 1:
        return False
    spread = np.ptp(body.reshape(-1, 3), axis=0)
    whole = np.ptp(shape.corners.reshape(-1, 3), axis=0)
    across = np.sort(whole)[1:].prod()
    area = _area_m2(sheets.flat[0].corners)
    return bool(area > 0.1 * across and np.sort(spread)[1] > 0.1)


def _area_m2(corners: Floats) -> float:
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return float(np.linalg.norm(cross, axis=1).sum() / 2)


def obj_name(name: str) -> str:
    """Return a name as a line of an OBJ file can have it."""
    kept = (c if c.isprintable() and c not in '#\\"' else " " for c in name)
    return " ".join("".join(kept).split())[:120]
