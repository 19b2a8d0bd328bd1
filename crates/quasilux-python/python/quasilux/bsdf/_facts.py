"""Matrices over patches, and figures of measured surfaces."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, Union

import numpy as np

from quasilux.photometry._arrays import Floats, frozen

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from quasilux import _native

Side = Literal["front", "back"]
Mode = Literal["reflection", "transmission"]
Kind = Literal["Klems", "tensor tree", "gridded"]
Which = tuple[Side, Mode]
Incidence = Union[float, tuple[float, float]]


@dataclass(frozen=True, eq=False)
class AngleBasis:
    """A hemisphere cut into bands of the polar angle, each cut into equal patches (Klems 1994).

    Patches are counted band by band from the normal on, in a band from azimuth 0 on towards y. The
    azimuth is that of light going *onwards*: of the exit direction, or of the incident one turned
    by half a turn. So light that goes straight through has the same patch on both sides.

    Attributes
    ----------
    name : str
        Such as ``"LBNL/Klems Full"``.
    lower_deg, upper_deg : ndarray of shape (b,)
        Polar angles where bands begin and end.
    patches : ndarray of int of shape (b,)
        Patches of each band.
    theta_deg, phi_deg : ndarray of shape (n,)
        The middle of each patch; 0 for a band of one patch about the normal.
    projected_solid_angle_sr : ndarray of shape (n,)
        Of each patch: the integral of the cosine over its solid angle.
    """

    name: str
    lower_deg: Floats
    upper_deg: Floats
    patches: NDArray[np.intp]
    theta_deg: Floats
    phi_deg: Floats
    projected_solid_angle_sr: Floats

    @classmethod
    def _of(cls, entry: _native.BasisEntry) -> AngleBasis:
        lower_deg, upper_deg = np.array(entry["lower_deg"]), np.array(entry["upper_deg"])
        patches = np.array(entry["patches"], dtype=np.intp)
        patches.flags.writeable = False
        is_cap = (lower_deg == 0.0) & (patches == 1)
        middle_deg = np.where(is_cap, 0.0, 0.5 * (lower_deg + upper_deg))
        of_bands = [360.0 * patch / count for count in entry["patches"] for patch in range(count)]
        return cls(
            name=entry["name"],
            lower_deg=frozen(lower_deg),
            upper_deg=frozen(upper_deg),
            patches=patches,
            theta_deg=frozen(np.repeat(middle_deg, patches)),
            phi_deg=frozen(np.array(of_bands)),
            projected_solid_angle_sr=frozen(entry["projected_solid_angle_sr"]),
        )


@dataclass(frozen=True, eq=False)
class Matrix:
    """A scattering matrix over patches.

    The product of `values` with the projected solid angles of exit patches is the albedo of each
    incident patch.

    Attributes
    ----------
    values : ndarray of shape (n, m)
        f in 1/sr, without the cosine, for n incident and m exit patches.
    incident, exit : AngleBasis
        The patches.
    """

    values: Floats
    incident: AngleBasis
    exit: AngleBasis

    @classmethod
    def _of(cls, entry: _native.MatrixEntry) -> Matrix:
        incident, leaving = AngleBasis._of(entry["incident"]), AngleBasis._of(entry["exit"])
        shape = (incident.theta_deg.size, leaving.theta_deg.size)
        return cls(frozen(entry["values"].reshape(shape)), incident, leaving)


@dataclass(frozen=True)
class EnergyBalance:
    """Where light of one side goes; shares are luminous and run from 0 to 1.

    Attributes
    ----------
    side : {"front", "back"}
        The side that light arrives on.
    normal_reflectance, normal_transmittance : float
        For light along the normal.
    diffuse_reflectance, diffuse_transmittance : float
        For diffuse light: means over projected solid angle, exact for what the tables say.
    most_scattered : float
        The greatest sum of both over all incidences, of the strongest colour channel: above 1 the
        table breaks the conservation of energy.
    most_scattered_wi : tuple of 3 floats
        The incident direction where that is.
    """

    side: Side
    normal_reflectance: float
    normal_transmittance: float
    diffuse_reflectance: float
    diffuse_transmittance: float
    most_scattered: float
    most_scattered_wi: tuple[float, float, float]


@dataclass(frozen=True)
class Reciprocity:
    """How far f is the same when both directions are swapped.

    Attributes
    ----------
    side : {"front", "back"}
        The side that light arrives on.
    mode : {"reflection", "transmission"}
        Of transmission there is one figure for both sides.
    mean_defect : float
        The mean difference over the mean of the greater value of both.
    worst_defect : float
        The largest difference over the greater value of both, 0 to 1.
    worst_pair : tuple of 2 directions
        Where that is, in the frames of their sides.
    """

    side: Side
    mode: Mode
    mean_defect: float
    worst_defect: float
    worst_pair: tuple[tuple[float, float, float], tuple[float, float, float]]


def energy_balance(entry: _native.EnergyEntry) -> EnergyBalance:
    """Make a balance of what the native half returns."""
    x, y, z = entry["most_scattered_wi"]
    return EnergyBalance(
        side=entry["side"],
        normal_reflectance=entry["normal_reflectance"],
        normal_transmittance=entry["normal_transmittance"],
        diffuse_reflectance=entry["diffuse_reflectance"],
        diffuse_transmittance=entry["diffuse_transmittance"],
        most_scattered=entry["most_scattered"],
        most_scattered_wi=(x, y, z),
    )


def reciprocity(entry: _native.ReciprocityEntry) -> Reciprocity:
    """Make figures of what the native half returns."""
    (ax, ay, az), (bx, by, bz) = entry["worst_pair"]
    return Reciprocity(
        side=entry["side"],
        mode=entry["mode"],
        mean_defect=entry["mean_defect"],
        worst_defect=entry["worst_defect"],
        worst_pair=((ax, ay, az), (bx, by, bz)),
    )
