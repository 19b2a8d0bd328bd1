"""An IFC file that is open: checked beforehand, and asked in ways that cannot raise."""

from __future__ import annotations

import math
import os
import re
from collections.abc import Iterable
from typing import Any

from quasilux._errors import input_error, missing_file, optional
from quasilux.ifc._findings import Findings

# Limits of what is read; beyond them a file is refused.
MOST_BYTES = 1 << 30
MOST_PRODUCTS = 200_000
_MOST_PLACEMENTS = 256

_SCHEMAS = ("IFC2X3", "IFC4", "IFC4X3")
# What the kernel logs of a file.
_ERROR = re.compile(r"^\[error\] (?:\[[^\]]*\] )*(.*)$", re.MULTILINE)
_OFFSET = re.compile(r"at offset (\d+)")
_ODD_COUNT = re.compile(r"Expected \d+ attribute values, found \d+")

_INSTANCE = re.compile(rb"#\d+\s*=\s*([A-Za-z]\w*)\s*\(")


class Model:
    """An open model, and what of it is strange.

    Attributes
    ----------
    name : str
        The file, as messages call it.
    folder : str
        The folder that it lies in.
    unit_m : float
        Length of its unit in m.
    """

    def __init__(self, path: str | os.PathLike[str], findings: Findings) -> None:
        self.name = os.fsdecode(path).encode("utf-8", "replace").decode()
        self.folder = os.path.dirname(os.path.abspath(os.fsdecode(path)))
        self.path = os.fsdecode(path)
        self.findings = findings
        kernel = optional("ifcopenshell", "ifc")
        words = _looked_at(self.path, self.name)
        try:
            self.file: Any = kernel.open(self.path)
            self.schema = str(self.file.schema)
        except Exception as error:
            reason = _logged_error(kernel) or " ".join(str(error).split()) or type(error).__name__
            known = ", ".join(_SCHEMAS)
            message = f"no IFC file that can be read ({reason}); expected one of {known}"
            raise input_error(message, self.name, _line_of(self.path, reason)) from None
        if not self.schema.upper().startswith(_SCHEMAS):
            message = f"the schema {self.schema}; expected one of {', '.join(_SCHEMAS)}"
            raise input_error(message, self.name)
        self._tell_unknown(words)
        odd = len(_ODD_COUNT.findall(_log(kernel)))
        if odd:
            findings.note(
                f"entities ({odd}) have another number of attributes than the schema: what they "
                "lack counts as not set"
            )
        self.unit_m = self._unit_m()

    def _tell_unknown(self, words: Iterable[str]) -> None:
        from ifcopenshell import ifcopenshell_wrapper

        declared: Any = ifcopenshell_wrapper.schema_by_name(self.file.schema_identifier)
        known = {entity.name().upper() for entity in declared.entities()}
        unknown = sorted(set(words) - known)
        if unknown:
            named = ", ".join(unknown[:5])
            self.findings.note(
                f"entities that {self.file.schema_identifier} does not have are left out: {named}"
            )

    def _unit_m(self) -> float:
        import ifcopenshell.util.unit as units

        try:
            has_unit = units.get_project_unit(self.file, "LENGTHUNIT") is not None
            scale = float(units.calculate_unit_scale(self.file))
        except Exception:
            has_unit, scale = False, 1.0
        if not has_unit:
            self.findings.note("the model names no unit of length: metres are assumed")
        if not (math.isfinite(scale) and 1e-6 <= scale <= 1e4):
            message = f"its unit of length has {scale} m; expected 1e-6 to 10,000 m"
            raise input_error(message, self.name)
        return scale

    def angle_deg(self) -> float:
        """Return the unit of plane angles in degrees."""
        import ifcopenshell.util.unit as units

        try:
            scale = math.degrees(float(units.calculate_unit_scale(self.file, "PLANEANGLEUNIT")))
        except Exception:
            return math.degrees(1.0)
        return scale if math.isfinite(scale) and scale > 0 else math.degrees(1.0)

    def of_class(self, ifc_class: str) -> list[Any]:
        """Return the entities of a class and its subclasses; none where the schema lacks it."""
        try:
            return list(self.file.by_type(ifc_class))
        except Exception:
            return []

    def by_id(self, number: int) -> Any:
        """Return an entity by its number, or None."""
        try:
            return self.file.by_id(number)
        except Exception:
            return None

    def placement(self, product: Any) -> Any:
        """Return where a product is: (4, 4), in units of the file, or None."""
        import ifcopenshell.util.placement as placements
        import numpy as np

        matrix = np.eye(4)
        place = get(product, "ObjectPlacement")
        try:
            for _ in range(_MOST_PLACEMENTS):
                if place is None:
                    return matrix if np.isfinite(matrix).all() else None
                if not is_a(place, "IfcLocalPlacement"):
                    return np.array(placements.get_local_placement(place), dtype=float) @ matrix
                step = np.array(placements.get_axis2placement(place.RelativePlacement), dtype=float)
                # RefDirection need not be square to Axis: x lies in the plane of both.
                step[:3, 0] = np.cross(step[:3, 1], step[:3, 2])
                matrix = step @ matrix
                place = get(place, "PlacementRelTo")
        except Exception:
            return None
        return None


def _looked_at(path: str, name: str) -> set[str]:
    """Return the classes of the entities of a file that is whole.

    Raises
    ------
    InputError
        For what is no IFC file in clear text, is cut short or too large.
    """
    ending = os.path.splitext(path)[1].lower()
    if ending in (".ifczip", ".ifcxml"):
        message = f"{ending} is not read; save the model as .ifc (STEP text)"
        raise input_error(message, name)
    try:
        if not os.path.isfile(path):
            if os.path.exists(path):
                raise input_error("no file; expected an IFC file", name)
            raise missing_file(path)
        if os.path.getsize(path) > MOST_BYTES:
            message = f"the file is larger than {MOST_BYTES >> 20} MiB; export a part of the model"
            raise input_error(message, name)
        with open(path, "rb") as file:
            data = file.read(MOST_BYTES)
    except OSError as error:
        if hasattr(error, "file"):
            raise
        raise input_error(error.strerror or str(error), name) from None
    if b"ISO-10303-21" not in data[:1024]:
        raise input_error("no IFC file; expected ISO-10303-21 in its first line", name, 1)
    if b"END-ISO-10303-21" not in data[-1024:]:
        message = "the file is cut short; expected END-ISO-10303-21 at its end"
        raise input_error(message, name, data.count(b"\n") + 1)
    words = {found.group(1) for found in _INSTANCE.finditer(data)}
    return {word.decode("ascii").upper() for word in words}


def _log(kernel: Any) -> str:
    try:
        return str(kernel.get_log())
    except Exception:
        return ""


def _logged_error(kernel: Any) -> str:
    """The last error that the kernel logged."""
    found = _ERROR.findall(_log(kernel))
    return found[-1].strip() if found else ""


def _line_of(path: str, reason: str) -> int | None:
    """The line of an offset that a message names, counted from 1."""
    offset = _OFFSET.search(reason)
    if offset is None:
        return None
    with open(path, "rb") as file:
        return file.read(int(offset.group(1))).count(b"\n") + 1


def get(entity: Any, attribute: str) -> Any:
    """Return an attribute of an entity; None where it is not set, or there is none of the name."""
    try:
        return getattr(entity, attribute, None)
    except Exception:
        return None


def is_a(entity: Any, ifc_class: str) -> bool:
    """Whether an entity is of a class or a subclass of it; no if its schema lacks the class."""
    try:
        return bool(entity.is_a(ifc_class))
    except Exception:
        return False


def text_of(entity: Any, attribute: str) -> str:
    """Return a text attribute in one line, empty where it is not set."""
    value = get(entity, attribute)
    return " ".join(str(value).split()) if value is not None else ""


def label(entity: Any) -> str:
    """Return what findings call an entity: its class, name and GlobalId."""
    name = text_of(entity, "Name") or text_of(entity, "LongName")
    named = f' "{name}"' if name else ""
    guid = text_of(entity, "GlobalId")
    return f"{entity.is_a()}{named} {guid}".strip()


def type_of(product: Any) -> Any:
    """Return the type of a product, or None."""
    import ifcopenshell.util.element as elements

    try:
        return elements.get_type(product)
    except Exception:
        return None


def psets_of(product: Any) -> dict[str, Any]:
    """Return the property sets of a product and its type."""
    import ifcopenshell.util.element as elements

    try:
        return elements.get_psets(product)
    except Exception:
        return {}


def material_names(product: Any) -> tuple[str, ...]:
    """Return the names of the materials of a product, and of the sets they come in."""
    import ifcopenshell.util.element as elements

    try:
        found = [*elements.get_materials(product), elements.get_material(product)]
    except Exception:
        return ()
    names = [text_of(one, "Name") or text_of(one, "LayerSetName") for one in found if one]
    return tuple(dict.fromkeys(name for name in names if name))
