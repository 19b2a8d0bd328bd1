"""Light sources of a model: goniometric ones become photometric files.

`IfcLightSourceGoniometric` has a placement, a flux, and a distribution or the name of a file. The
placement orients the distribution; how, IFC leaves open. Here the axes are those of a photometric
file: gamma = 0 along -z, C0 along x. Intensities are relative to the flux, in cd/lm or cd/klm:
files with either are around, or in cd; the unit that the model declares, or the flux that the
distribution has, tells which.

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
# How much nearer to all of the flux the better one of two units has to come, as a ratio.
_CLEARLY = 1.3
# Items of representations that are looked at in a product.
_MOST_ITEMS = 2_000


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
        for item, within in _light_items(model, product):
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


def _light_items(model: Model, product: Any) -> list[tuple[Any, Floats]]:
    """Light sources in representations, with where they are in the product, in its units."""
    walk = _Walk()
    representation = _model.get(product, "Representation")
    for shape in _model.get(representation, "Representations") or ():
        walk.through(_model.get(shape, "Items") or (), np.eye(4), 0)
    if walk.left <= 0:
        message = f"more than {_MOST_ITEMS} items: light sources among the others are left out"
        model.findings.note(message, _model.label(product))
    return list(walk.found.values())


class _Walk:
    """Light sources of a product; one that several representations have at a place is one."""

    def __init__(self) -> None:
        self.left = _MOST_ITEMS
        self.found: dict[tuple[int, bytes], tuple[Any, Floats]] = {}

    def through(self, items: Any, within: Floats, depth: int) -> None:
        """Look at items, and at those that they map."""
        import ifcopenshell.util.placement as placements

        for item in items:
            self.left -= 1
            if self.left <= 0:
                return
            if _model.is_a(item, "IfcLightSource"):
                place = (np.round(within, 6) + 0.0).tobytes()
                self.found[item.id(), place] = (item, within)
            elif _model.is_a(item, "IfcMappedItem") and depth < _MOST_DEPTH:
                try:
                    step = np.array(placements.get_mappeditem_transformation(item), dtype=float)
                    inner = item.MappingSource.MappedRepresentation.Items or ()
                except Exception:
                    continue
                self.through(inner, within @ step, depth + 1)


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
    if np.linalg.det(frame[:3, :3]) < 0:
        message = "a mirrored light source: its distribution is turned, and not mirrored"
        model.findings.note(message, label)
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
    if table[1][0] > 0:
        message = f"a distribution begins at gamma {table[1][0]:g}: below that it is dark"
        model.findings.note(message, label)
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
    """What makes intensities cd/lm; None, which is told, where no unit or several may be meant."""
    declared = _declared_per_lumen(model)
    if declared is not None:
        readings = {"the unit that the model declares": declared}
    else:
        readings = {"cd/lm": 1.0, "cd/klm": 1e-3, "cd": 1.0 / flux_lm}
    plausible = {
        unit: integral * factor
        for unit, factor in readings.items()
        if _LEAST_RATIO <= integral * factor <= _MOST_RATIO
    }
    if not plausible:
        units = "the unit that the model declares" if declared else "any of cd/lm, cd/klm and cd"
        message = (
            f"a distribution is left out: it has {integral:.3g} lm by lumen, which is not "
            f"plausible in {units}"
        )
        model.findings.note(message, label)
        return None
    unit = _chosen_unit(plausible)
    if unit is None:
        shares = " or ".join(f"{100 * share:.0f} % in {one}" for one, share in plausible.items())
        message = (
            f"a distribution is left out: it has {shares} of {flux_lm:g} lm, and the model does "
            "not say which; map the type of its fixture to the file of the manufacturer"
        )
        model.findings.note(message, label)
        return None
    message = (
        f"intensities are taken as {unit}: with that its distribution has "
        f"{100 * plausible[unit]:.0f} % of {flux_lm:g} lm"
    )
    model.findings.note(message, label)
    return readings[unit]


def _chosen_unit(plausible: dict[str, float]) -> str | None:
    """cd/lm, which IFC asks for, else what is clearly nearer to all of the flux, or the same."""
    if len(plausible) == 1 or "cd/lm" in plausible:
        return next(iter(plausible))

    def distance(unit: str) -> float:
        # A luminaire may lose much of the flux of its lamps, and cannot add to it.
        logarithm = math.log(plausible[unit])
        return 3 * logarithm if logarithm > 0 else -logarithm

    best, second = sorted(plausible, key=distance)[:2]
    is_same = abs(plausible[best] - plausible[second]) < 0.02 * plausible[best]
    is_clear = distance(second) - distance(best) > math.log(_CLEARLY)
    return best if is_same or is_clear else None


def _declared_per_lumen(model: Model) -> float | None:
    """The unit of intensity distributions in cd/lm; None where the model declares none."""
    import ifcopenshell.util.unit as units

    for assignment in model.of_class("IfcUnitAssignment"):
        for unit in _model.get(assignment, "Units") or ():
            if _model.get(unit, "UnitType") != "LUMINOUSINTENSITYDISTRIBUTIONUNIT":
                continue
            try:
                scale = float(units.get_derived_unit_scale(unit))
            except Exception:
                continue
            if math.isfinite(scale) and scale > 0:
                return scale
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
        if not gamma.size:
            raise ValueError("a plane has no angles")
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
    if len({planes[angle][0][0] for angle in c}) > 1:
        raise ValueError("its planes begin at different gamma")
    # Planes with angles of their own are brought to all angles, along straight lines.
    rows = [np.interp(gammas, *planes[angle], left=0.0, right=0.0) for angle in c]
    return c, gammas, np.array(rows)
