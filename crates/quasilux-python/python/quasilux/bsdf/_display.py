"""Figures of a measured surface for programs and for notebooks."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from quasilux.bsdf import _tables
from quasilux.bsdf._facts import EnergyBalance, Reciprocity, Side
from quasilux.photometry import _display
from quasilux.photometry._display import short as short

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from quasilux.bsdf._facts import Mode
    from quasilux.photometry._arrays import Floats
    from quasilux.photometry._diagram import Diagram
    from quasilux.photometry._facts import FileWarning


class Described(Protocol):
    """What is said of a surface; properties are cached where the surface caches them."""

    @property
    def title(self) -> str: ...
    @property
    def manufacturer(self) -> str: ...
    @property
    def format(self) -> str: ...
    @property
    def thickness_m(self) -> float | None: ...
    @property
    def is_isotropic(self) -> bool: ...
    @cached_property
    def tables(self) -> tuple[_tables.Table, ...]: ...
    @cached_property
    def energy(self) -> tuple[EnergyBalance, ...]: ...
    @cached_property
    def reciprocity(self) -> tuple[Reciprocity, ...]: ...
    @property
    def warnings(self) -> tuple[FileWarning, ...]: ...
    def albedo(self, wi: ArrayLike, *, side: Side, mode: Mode) -> Floats: ...
    def diagram(self) -> Diagram: ...


def table_entry(table: _tables.Table) -> dict[str, Any]:
    """Return a table's entry of the document."""
    theta_deg, phi_deg = _tables.angles_deg(table.incidences)
    share = table.albedo(table.incidences)
    incidences = [
        {"theta_deg": theta, "phi_deg": phi, "share": part}
        for theta, phi, part in zip(theta_deg.tolist(), phi_deg.tolist(), share.tolist())
    ]
    return {"side": table.side, "mode": table.mode, "kind": table.kind, "incidences": incidences}


def shares(surface: Described, side: Side, incidences: Floats, wi: Floats) -> list[dict[str, float]]:
    """Return what is reflected and transmitted of light from each direction."""
    reflectance = surface.albedo(wi, side=side, mode="reflection").tolist()
    transmittance = surface.albedo(wi, side=side, mode="transmission").tolist()
    return [
        {"theta_deg": theta, "phi_deg": phi, "reflectance": reflected, "transmittance": passed}
        for (theta, phi), reflected, passed in zip(incidences.tolist(), reflectance, transmittance)
    ]


def energy_entry(balance: EnergyBalance) -> dict[str, Any]:
    """Return a side's entry of the document, but for its name and incidences."""
    theta_deg, phi_deg = _tables.angles_deg(np.array(balance.most_scattered_wi))
    return {
        "normal_reflectance": balance.normal_reflectance,
        "normal_transmittance": balance.normal_transmittance,
        "diffuse_reflectance": balance.diffuse_reflectance,
        "diffuse_transmittance": balance.diffuse_transmittance,
        "most_scattered": balance.most_scattered,
        "most_scattered_at_deg": [float(theta_deg), float(phi_deg)],
    }


def reciprocity_entry(found: Reciprocity) -> dict[str, Any]:
    """Return a table's entry of the document."""
    return {
        "side": found.side,
        "mode": found.mode,
        "mean_defect": found.mean_defect,
        "worst_defect": found.worst_defect,
    }


def incidence_text(theta_deg: float, phi_deg: float) -> str:
    """Return a direction as people write it."""
    theta, phi = (f"{angle:.6g}\N{DEGREE SIGN}" for angle in (theta_deg, phi_deg))
    return theta if phi_deg == 0.0 else f"{theta}, {phi}"


def html(surface: Described) -> str:
    """Return the facts of a surface above its lobes."""
    return _display.table(surface.title, _rows(surface), surface.diagram())


def _rows(surface: Described) -> list[tuple[str, str]]:
    """Facts in the order of the command line's summary."""
    thickness = surface.thickness_m
    rows = [
        ("manufacturer", surface.manufacturer),
        ("format", surface.format),
        ("thickness", "" if thickness is None else f"{1000.0 * thickness:.4g} mm"),
        ("symmetry", "isotropic" if surface.is_isotropic else "none"),
    ]
    for table in surface.tables:
        colour = ", coloured" if table.is_coloured else ""
        what = f"{table.kind}, {len(table.incidences)} incident directions{colour}"
        rows.append((f"{table.side}, {table.mode}", what))
    for energy in surface.energy:
        for kind, reflected, passed in (
            ("normal", energy.normal_reflectance, energy.normal_transmittance),
            ("diffuse", energy.diffuse_reflectance, energy.diffuse_transmittance),
        ):
            text = f"reflectance {100 * reflected:.2f} %, transmittance {100 * passed:.2f} %"
            rows.append((f"{energy.side}, {kind} light", text))
        rows.append((f"{energy.side}, most scattered", f"{100 * energy.most_scattered:.2f} %"))
    for found in surface.reciprocity:
        mean, worst = (f"{100 * x:.2f} %" for x in (found.mean_defect, found.worst_defect))
        text = f"swapped directions differ by {mean} in the mean, {worst} at worst"
        rows.append((f"reciprocity, {found.side}, {found.mode}", text))
    rows.extend(("warning", str(warning)) for warning in surface.warnings)
    return rows
