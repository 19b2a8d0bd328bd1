"""Scattering by one table: arrays of directions in and out."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from quasilux import _native
from quasilux.bsdf._facts import Kind, Matrix, Mode, Side, Which
from quasilux.photometry import _arrays
from quasilux.photometry._arrays import Floats, frozen

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


def direction(*, theta_deg: ArrayLike, phi_deg: ArrayLike = 0.0) -> Floats:
    """Return unit directions at polar angles and azimuths.

    Parameters
    ----------
    theta_deg : array_like
        Angles from the normal, in degrees.
    phi_deg : array_like
        Angles around the normal, from x towards y, in degrees.

    Returns
    -------
    ndarray of shape (..., 3)
        Of the shape that both are broadcast to.

    Examples
    --------
    >>> from quasilux import bsdf
    >>> bsdf.direction(theta_deg=90, phi_deg=[0, 180]).round(9) + 0.0
    array([[ 1.,  0.,  0.],
           [-1.,  0.,  0.]])
    """
    # Not by numpy's sine, which is not the same everywhere: patches begin at round angles.
    theta, phi = _arrays.scalars(theta_deg, "theta_deg"), _arrays.scalars(phi_deg, "phi_deg")
    pairs = _Pairs(theta, phi, "theta_deg and phi_deg")
    return _native.bsdf_directions(pairs.first, pairs.second).reshape(*pairs.shape, 3)


def angles_deg(directions: Floats) -> tuple[Floats, Floats]:
    """Polar angles, and azimuths from 0 to 360 degrees, of directions of shape (..., 3)."""
    x, y, z = directions[..., 0], directions[..., 1], directions[..., 2]
    theta_deg: Floats = np.degrees(np.arctan2(np.hypot(x, y), z))
    phi_deg: Floats = np.degrees(np.arctan2(y, x))
    # Also turns -0 into 0.
    return theta_deg, phi_deg + np.where(phi_deg < 0.0, 360.0, 0.0)


class Table:
    """How light that arrives on one side of a sheet is reflected, or transmitted.

    Directions are vectors of any length in the frame of the module. Where one is zero or not
    finite, results are NaN; below its side nothing is scattered. Arrays of directions and
    coordinates are broadcast against each other.

    Attributes
    ----------
    side : {"front", "back"}
        The side that light arrives on.
    mode : {"reflection", "transmission"}
        Where it goes.
    kind : {"Klems", "tensor tree", "gridded"}
        Constant in pairs of patches, in boxes of varied size, or lobes over a grid of incidences.
    is_isotropic : bool
        Whether the table stays the same when both directions turn together about the normal.
    is_coloured : bool
        Whether colour channels differ.
    incidences : ndarray of shape (k, 3)
        The incident directions that the table is stored for.
    matrix : Matrix or None
        The matrix of a table over patches.
    leaves, resolution : int or None
        Of a tensor tree: its number of boxes, and how many of the smallest there are along an axis.
    """

    def __init__(self, surface: _native.Surface, entry: _native.TableEntry) -> None:
        self._surface = surface
        self.side: Side = entry["side"]
        self.mode: Mode = entry["mode"]
        self.kind: Kind = entry["kind"]
        self.is_isotropic: bool = entry["is_isotropic"]
        self.is_coloured: bool = entry["is_coloured"]
        self.incidences: Floats = frozen(entry["incidences"].reshape(-1, 3))
        self.leaves: int | None = entry["leaves"]
        self.resolution: int | None = entry["resolution"]
        matrix = entry["matrix"]
        self.matrix: Matrix | None = None if matrix is None else Matrix._of(matrix)

    @property
    def _which(self) -> Which:
        return self.side, self.mode

    def __repr__(self) -> str:
        count = len(self.incidences)
        return f"<Table {self.side} {self.mode}: {self.kind}, {count} incident directions>"

    def albedo(self, wi: ArrayLike, *, rgb: bool = False) -> Floats:
        """Return the share of light from a direction that is scattered; see `Bsdf.albedo`."""
        return albedo(self._surface, self._which, wi, rgb=rgb)

    def evaluate(self, wi: ArrayLike, wo: ArrayLike, *, rgb: bool = False) -> Floats:
        """Return f in 1/sr, without the cosine; see `Bsdf.evaluate`."""
        return evaluate(self._surface, self._which, wi, wo, rgb=rgb)

    def sample(self, wi: ArrayLike, u: ArrayLike) -> Floats:
        """Return scattered directions; see `Bsdf.sample`."""
        return sample(self._surface, self._which, wi, u)

    def pdf(self, wi: ArrayLike, wo: ArrayLike) -> Floats:
        """Return the density of `sample` in 1/sr; see `Bsdf.pdf`."""
        return pdf(self._surface, self._which, wi, wo)

    def invert(self, wi: ArrayLike, wo: ArrayLike) -> Floats:
        """Return coordinates that `sample` turns into directions; see `Bsdf.invert`."""
        return invert(self._surface, self._which, wi, wo)


def albedo(surface: _native.Surface, which: Which, wi: ArrayLike, *, rgb: bool) -> Floats:
    """Return `Bsdf.albedo` of a table."""
    found = _arrays.rows(wi, "wi", 3)
    if rgb:
        return surface.albedo_rgb(which, found.flat).reshape(*found.shape, 3)
    return _arrays.shaped(surface.albedo(which, found.flat), found.shape)


def evaluate(
    surface: _native.Surface,
    which: Which,
    wi: ArrayLike,
    wo: ArrayLike,
    *,
    rgb: bool,
) -> Floats:
    """Return `Bsdf.evaluate` of a table."""
    pairs = _Pairs.of_directions(wi, wo)
    if rgb:
        return surface.evaluate_rgb(which, pairs.first, pairs.second).reshape(*pairs.shape, 3)
    return _arrays.shaped(surface.evaluate(which, pairs.first, pairs.second), pairs.shape)


def sample(surface: _native.Surface, which: Which, wi: ArrayLike, u: ArrayLike) -> Floats:
    """Return `Bsdf.sample` of a table."""
    pairs = _Pairs(_arrays.rows(wi, "wi", 3), _arrays.coordinates(u), "wi and u")
    return surface.sample(which, pairs.first, pairs.second).reshape(*pairs.shape, 3)


def pdf(surface: _native.Surface, which: Which, wi: ArrayLike, wo: ArrayLike) -> Floats:
    """Return `Bsdf.pdf` of a table."""
    pairs = _Pairs.of_directions(wi, wo)
    return _arrays.shaped(surface.pdf_sr(which, pairs.first, pairs.second), pairs.shape)


def invert(surface: _native.Surface, which: Which, wi: ArrayLike, wo: ArrayLike) -> Floats:
    """Return `Bsdf.invert` of a table."""
    pairs = _Pairs.of_directions(wi, wo)
    return surface.invert(which, pairs.first, pairs.second).reshape(*pairs.shape, 2)


class _Pairs:
    """Rows of two arrays that are broadcast against each other."""

    def __init__(self, first: _arrays.Rows, second: _arrays.Rows, names: str) -> None:
        self.shape = _arrays.common_shape(first, second, names)
        self.first, self.second = first.broadcast(self.shape), second.broadcast(self.shape)

    @classmethod
    def of_directions(cls, wi: ArrayLike, wo: ArrayLike) -> _Pairs:
        return cls(_arrays.rows(wi, "wi", 3), _arrays.rows(wo, "wo", 3), "wi and wo")
