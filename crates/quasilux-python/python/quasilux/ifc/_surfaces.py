"""Surfaces of a project: facets of a model by the materials that stand for its styles."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from quasilux.ifc import _glass, _model
from quasilux.ifc._geometry import Part, Shape

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
    return maker.surfaces


class _Maker:
    def __init__(self, mapping: Mapping, findings: Findings) -> None:
        self.mapping = mapping
        self.findings = findings
        self.surfaces = Surfaces()
        self._key_of: dict[str, str] = {}

    def add(self, shape: Shape) -> None:
        """Add all parts of a product."""
        product = shape.product
        place = _model.label(product)
        materials = _model.material_names(product)
        parts = _parted(shape, place, materials, self.findings)
        for part, is_glass in parts:
            names = _names(product, part, materials)
            mapped = self.mapping.material(names)
            style = part.style or (materials[0] if len(materials) == 1 else "")
            if mapped is not None:
                self._add_mapped(place, part.corners, style, mapped)
            elif is_glass:
                name = self._material(f"glass {style}".strip(), "glass")
                self._add_sheets(place, part.corners, name)
            else:
                self._add_default(place, product, part.corners, style)

    def _add_mapped(
        self, place: str, corners: Floats, style: str, mapped: tuple[str, dict[str, Any]]
    ) -> None:
        key, entries = mapped
        if entries.get("skip") is True:
            self.findings.note(f'facets of "{key}" are left out, as the mapping says', place)
            return
        name = self._named(style or key, key)
        self.surfaces.materials[name] = dict(entries)
        kind = entries.get("kind", "diffuse")
        if kind in ("pane", "glazing", "bsdf") or entries.get("transmittance"):
            self._add_sheets(place, corners, name)
        else:
            self._emit(place, name, corners)

    def _add_sheets(self, place: str, corners: Floats, name: str) -> None:
        sheets = _glass.sheets_of(corners)
        for sheet in sheets.flat:
            self._emit(place, name, sheet)
        if sheets.merged:
            note = "panes behind one another are one sheet, whose material stands for all of them"
            self.findings.note(note, place)
        for body in sheets.solid:
            solid = self._material(f"{name} body", "glass body")
            self._emit(place, solid, body)

    def _add_default(self, place: str, product: Any, corners: Floats, style: str) -> None:
        role = next((role for name, role in _ROLES if _model.is_a(product, name)), "other")
        for which, facets in _by_role(role, corners).items():
            self._emit(place, self._material(f"{which} {style}".strip(), which), facets)

    def _material(self, name: str, role: str) -> str:
        """Return the name of a material with the default of what it was taken for."""
        name = self._named(name, f"default {role}")
        if name not in self.surfaces.materials:
            self.surfaces.materials[name] = _default(role)
            self.surfaces.default_of[name] = role
        return name

    def _named(self, name: str, key: str) -> str:
        """Return a name that an OBJ file can hold, and that no other key has."""
        plain = obj_name(name) or "material"
        candidate, number = plain, 2
        while self._key_of.setdefault(candidate, key) != key:
            candidate, number = f"{plain} {number}", number + 1
        return candidate

    def _emit(self, place: str, material: str, corners: Floats) -> None:
        self.surfaces.objects.append((obj_name(place), material, corners))

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


def _by_role(role: str, corners: Floats) -> dict[str, Floats]:
    """Facets of slabs and the like by the way they face."""
    if role != "oriented":
        return {role: corners}
    cross = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(cross, axis=1)
    upward = np.divide(cross[:, 2], length, out=np.zeros(len(length)), where=length > 0)
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
    is_window = _model.is_a(shape.product, "IfcWindow")
    if not is_window or any(is_glass for _, is_glass in parts):
        return parts
    bodies = [(part, body) for part in shape.parts for body in _glass.bodies_of(part.corners)]
    panes = [_is_pane_of(body, shape) for _, body in bodies]
    whole = _glass.sheets_of(bodies[0][1], thickness_m=_MOST_WINDOW_M).flat
    if len(bodies) == 1 and whole:
        # One body that fills the opening.
        message = "a window of one body, which no style tells to be glass: all of it is a pane"
        bodies, panes = [(bodies[0][0], whole[0])], [True]
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


def _is_pane_of(body: Floats, shape: Shape) -> bool:
    """Whether a body of a window is flat, thin, and fills a tenth of the window or more."""
    sheets = _glass.sheets_of(body)
    if len(sheets.flat) != 1:
        return False
    spread = np.ptp(body.reshape(-1, 3), axis=0)
    whole = np.ptp(shape.corners.reshape(-1, 3), axis=0)
    cross = np.cross(
        sheets.flat[0][:, 1] - sheets.flat[0][:, 0], sheets.flat[0][:, 2] - sheets.flat[0][:, 0]
    )
    area = np.linalg.norm(cross, axis=1).sum() / 2
    across = np.sort(whole)[1:].prod()
    return bool(area > 0.1 * across and np.sort(spread)[1] > 0.1)


def obj_name(name: str) -> str:
    """Return a name as a line of an OBJ file can have it."""
    kept = (c if c.isprintable() and c not in '#\\"' else " " for c in name)
    return " ".join("".join(kept).split())[:120]
