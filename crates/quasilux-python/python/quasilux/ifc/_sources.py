"""Light sources of a model: goniometric ones become photometric files.

`IfcLightSourceGoniometric` has a placement, a flux, and a distribution or the name of a file. The
placement orients the distribution; how, IFC leaves open. Here the axes are those of a photometric
file: gamma = 0 along -z, C0 along x. Intensities are relative to the flux, in cd/lm or cd/klm:
files with either are around, and the flux that the distribution has tells which.

The other sources have intensities from 0 to 1 for pictures, and no photometric meaning.
"""

from __future__ import annotations

import math
import os
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any
from urllib.parse import unquote

import numpy as np

from quasilux._errors import input_error
from quasilux.ifc import _model

if TYPE_CHECKING:
    from quasilux import photometry
    from quasilux.ifc._geometry import Floats
    from quasilux.ifc._model import Model

_ENDINGS = (".ies", ".ldt", ".xml")
_MOST_VALUES = 1_000_000
_MOST_DEPTH = 8
MOST_FILE_BYTES = 64 << 20
# Flux of a distribution over that of its lamps: losses, and room for rounded or inflated figures.
_LEAST_RATIO, _MOST_RATIO = 0.1, 1.3


@dataclass(frozen=True)
class Source:
    """A goniometric source with a photometric file.

    Attributes
    ----------
    frame : ndarray of shape (4, 4)
        Its placement in m.
    ending : str
        Of the name of the file, ``.ies`` for those that are made here.
    data : bytes
        The photometric file.
    """

    product: Any
    frame: Floats
    title: str
    ending: str
    data: bytes


def sources_of(model: Model) -> list[Source]:
    """Return the goniometric sources of products; all that cannot be used are told."""
    found: list[Source] = []
    if not model.of_class("IfcLightSource"):
        return found
    used: set[int] = set()
    for product in model.of_class("IfcProduct"):
        place = None
        for item, within in _light_items(product):
            used.add(item.id())
            if not _model.is_a(item, "IfcLightSourceGoniometric"):
                continue
            place = model.placement(product) if place is None else place
            label = _model.label(product)
            if place is None:
                message = "a light source whose placement cannot be resolved is left out"
                model.findings.note(message, label)
                continue
            source = _goniometric(model, product, label, item, place @ within)
            if source is not None:
                found.append(source)
    _tell_others(model, used)
    return found


def _tell_others(model: Model, used: set[int]) -> None:
    for item in model.of_class("IfcLightSource"):
        if _model.is_a(item, "IfcLightSourceGoniometric"):
            if item.id() not in used:
                message = "a light source that no product has is left out"
                model.findings.note(message, f"#{item.id()}")
        else:
            model.findings.note(
                f"{item.is_a()} is left out: its intensity serves pictures, and is no light",
                f"#{item.id()}",
            )


def _light_items(product: Any) -> list[tuple[Any, Floats]]:
    """Light sources in representations, with where they are in the product, in its units."""
    found: list[tuple[Any, Floats]] = []
    representation = _model.get(product, "Representation")
    for shape in _model.get(representation, "Representations") or ():
        _walk(_model.get(shape, "Items") or (), np.eye(4), 0, found)
    return found


def _walk(items: Any, within: Floats, depth: int, found: list[tuple[Any, Floats]]) -> None:
    import ifcopenshell.util.placement as placements

    for item in items:
        if _model.is_a(item, "IfcLightSource"):
            found.append((item, within))
        elif _model.is_a(item, "IfcMappedItem") and depth < _MOST_DEPTH:
            try:
                step = np.array(placements.get_mappeditem_transformation(item), dtype=float)
                inner = item.MappingSource.MappedRepresentation.Items or ()
            except Exception:
                continue
            _walk(inner, within @ step, depth + 1, found)


def _goniometric(
    model: Model, product: Any, label: str, item: Any, place: Floats
) -> Source | None:
    import ifcopenshell.util.placement as placements

    try:
        own = np.array(placements.get_axis2placement(item.Position), dtype=float)
    except Exception:
        model.findings.note("a goniometric source without a position is left out", label)
        return None
    frame = place @ own
    frame[:3, 3] *= model.unit_m
    if not np.isfinite(frame).all():
        model.findings.note("a goniometric source at no finite position is left out", label)
        return None
    title = _model.text_of(item, "Name") or _model.text_of(product, "Name") or "source"
    data_source = _model.get(item, "LightDistributionDataSource")
    if _model.is_a(data_source, "IfcLightIntensityDistribution"):
        made = _photometry(model, label, title, item, data_source)
        if made is None:
            return None
        return Source(product, frame, title, ".ies", bytes(made.to_ies()))
    if _model.is_a(data_source, "IfcExternalReference"):
        return _referenced(model, product, label, title, frame, data_source)
    model.findings.note("a goniometric source without a distribution is left out", label)
    return None


def _referenced(
    model: Model, product: Any, label: str, title: str, frame: Floats, reference: Any
) -> Source | None:
    location = _model.text_of(reference, "Location") or _model.text_of(reference, "Name")
    path = inside_folder(model.folder, location)
    if path is None:
        model.findings.note(
            f'the file "{location}" of a goniometric source is left out: expected the name of an '
            "IES, LDT or TM-33 file in the folder of the model",
            label,
        )
        return None
    ending = os.path.splitext(path)[1].lower()
    return Source(product, frame, title, ending, read_bytes(path, model.name))


def inside_folder(folder: str, location: str) -> str | None:
    """Return the path of a photometric file in a folder; None for what lies outside, or is none."""
    local = unquote(location).replace("\\", "/")
    if not local or "://" in local or "\0" in local or local.startswith("/") or ":" in local:
        return None
    if os.path.splitext(local)[1].lower() not in _ENDINGS:
        return None
    root = os.path.realpath(folder)
    path = os.path.realpath(os.path.join(root, local))
    if os.path.commonpath([root, path]) != root or not os.path.isfile(path):
        return None
    return path


def read_bytes(path: str, name: str) -> bytes:
    """Read a photometric file.

    Raises
    ------
    InputError
        When it cannot be read, or is too large for one.
    """
    try:
        with open(path, "rb") as file:
            data = file.read(MOST_FILE_BYTES + 1)
    except OSError as error:
        raise input_error(f"{path}: {error.strerror or error}", name) from None
    if len(data) > MOST_FILE_BYTES:
        raise input_error(f"{path}: the file is larger than {MOST_FILE_BYTES >> 20} MiB", name)
    return data


def _photometry(
    model: Model, label: str, title: str, item: Any, distribution: Any
) -> photometry.Photometry | None:
    from quasilux import photometry

    curve = _model.get(distribution, "LightDistributionCurve")
    if curve not in ("TYPE_C", "NOTDEFINED"):
        message = (
            f"a goniometric source of {curve} is left out: only TYPE_C becomes a photometric file; "
            "map the type of its fixture to the file of the manufacturer"
        )
        model.findings.note(message, label)
        return None
    if curve == "NOTDEFINED":
        model.findings.note("a distribution of no type is taken as TYPE_C", label)
    try:
        table = _table(distribution, model.angle_deg())
    except (TypeError, ValueError) as error:
        model.findings.note(f"a distribution that cannot be read is left out: {error}", label)
        return None
    flux_lm = _model.get(item, "LuminousFlux")
    if not isinstance(flux_lm, (int, float)) or not (0 < flux_lm < 1e12):
        message = f"a goniometric source of {flux_lm} lm is left out; expected more than 0 lm"
        model.findings.note(message, label)
        return None
    try:
        unscaled = photometry.from_intensities(*table)
        per_lm = _per_lumen(model, label, unscaled.flux_lm, float(flux_lm))
        if per_lm is None:
            return None
        c, gamma, intensity = table
        return photometry.from_intensities(
            c,
            gamma,
            intensity * per_lm * flux_lm,
            name=title.encode("ascii", "replace").decode(),
            lumens_per_lamp=float(flux_lm),
        )
    except ValueError as error:
        message = str(error).partition("\n")[0]
        model.findings.note(f"a distribution that makes no luminaire is left out: {message}", label)
        return None


def _per_lumen(model: Model, label: str, integral: float, flux_lm: float) -> float | None:
    """What makes intensities cd/lm: 1 or 0.001, or the reciprocal of the flux for cd."""
    readings = {
        "cd/klm": 1e-3,
        "cd/lm": 1.0,
        "cd": 1.0 / flux_lm,
    }
    for unit, factor in readings.items():
        ratio = integral * factor
        if _LEAST_RATIO <= ratio <= _MOST_RATIO:
            message = (
                f"intensities are taken as {unit}: with that its distribution has "
                f"{100 * ratio:.0f} % of {flux_lm:g} lm"
            )
            model.findings.note(message, label)
            return factor
    message = (
        f"a distribution is left out: it has {integral:.3g} lm by lumen, which is plausible in "
        "neither cd/lm nor cd/klm"
    )
    model.findings.note(message, label)
    return None


def _table(distribution: Any, unit_deg: float) -> tuple[Floats, Floats, Floats]:
    """C in degrees, gamma in degrees, intensities of shape (C, gamma)."""
    planes: dict[float, tuple[Floats, Floats]] = {}
    count = 0
    for plane in distribution.DistributionData:
        gamma = np.round(np.array(plane.SecondaryPlaneAngle, dtype=float) * unit_deg, 6)
        intensity = np.array(plane.LuminousIntensity, dtype=float)
        if gamma.shape != intensity.shape or gamma.ndim != 1:
            raise ValueError(f"{gamma.size} angles and {intensity.size} intensities in a plane")
        count += gamma.size
        if count > _MOST_VALUES:
            raise ValueError(f"more than {_MOST_VALUES} intensities")
        order = np.argsort(gamma, kind="stable")
        planes[round(float(plane.MainPlaneAngle) * unit_deg, 6)] = (gamma[order], intensity[order])
    if not planes:
        raise ValueError("it has no planes")
    c = np.array(sorted(planes))
    gammas = np.unique(np.concatenate([planes[angle][0] for angle in c]))
    if not math.isfinite(gammas.sum() + c.sum()):
        raise ValueError("angles are not finite")
    if c.size * gammas.size > _MOST_VALUES:
        raise ValueError(f"more than {_MOST_VALUES} intensities at all angles of its planes")
    # Planes with angles of their own are brought to all angles, along straight lines.
    rows = [np.interp(gammas, *planes[angle], left=0.0, right=0.0) for angle in c]
    return c, gammas, np.array(rows)
