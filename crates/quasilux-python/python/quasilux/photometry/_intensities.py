"""Intensities over directions: the grid of a file, and the distribution that it stands for."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING

import numpy as np

from quasilux.photometry import _arrays, _facts

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from quasilux import _native
    from quasilux.photometry._arrays import Floats


class Intensities:
    """The light of a luminaire: what of `Photometry` does not depend on its header."""

    def __init__(self, native: _native.Luminaire) -> None:
        self._native = native

    @property
    def type(self) -> _facts.PhotometricType:
        """The photometric type: the web of angles that the intensities are given in."""
        return self._native.photometric_type

    @property
    def symmetry(self) -> _facts.Symmetry:
        """``"rotational"``, ``"quadrant"``, ``"bilateral"`` or ``"none"``."""
        return self._native.symmetry

    @property
    def flux_lm(self) -> float:
        """Luminous flux in lumens, integrated exactly from the table."""
        return self._native.flux_lm

    @property
    def maximum_cd(self) -> float:
        """The greatest intensity in candela; 0 where there is no light."""
        return self._native.maximum_cd

    def flux_below_lm(self, gamma_deg: ArrayLike) -> Floats:
        """Return the flux between nadir and cones about the vertical axis.

        It is exact for types A and C, and integrated over small cells for type B.

        Parameters
        ----------
        gamma_deg : array_like
            Angles from nadir, 0 to 180 degrees; beyond, results are NaN.

        Returns
        -------
        ndarray
            In lumens, of the shape of `gamma_deg`.
        """
        found = _arrays.real(gamma_deg, "gamma_deg")
        return _arrays.shaped(self._native.flux_below_lm(found.reshape(-1)), found.shape)

    @functools.cached_property
    def _grid(self) -> _facts.Grid:
        return _facts.grid(self._native.grid(False))

    @property
    def intensity_cd(self) -> Floats:
        """Intensities of the file in candela, of shape (m, n).

        They are as measured, not unfolded by symmetry; mirror images of types A and B are written
        out.
        """
        return self._grid.intensity_cd

    @property
    def horizontal_deg(self) -> Floats:
        """Horizontal angles of the file, of shape (m,): C of type C, H of types A and B."""
        return self._grid.horizontal_deg

    @property
    def vertical_deg(self) -> Floats:
        """Vertical angles of the file, of shape (n,): gamma of type C, V of types A and B."""
        return self._grid.vertical_deg

    @property
    def c_deg(self) -> Floats:
        """Half-planes C of the file, of shape (m,); types A and B have none."""
        self._expect_type_c("c_deg", "horizontal_deg")
        return self._grid.horizontal_deg

    @property
    def gamma_deg(self) -> Floats:
        """Angles gamma of the file, of shape (n,); types A and B have none."""
        self._expect_type_c("gamma_deg", "vertical_deg")
        return self._grid.vertical_deg

    def _expect_type_c(self, asked: str, instead: str) -> None:
        if self.type != "C":
            message = f"a luminaire of type {self.type} has no {asked}; expected {instead}"
            raise AttributeError(message, name=asked, obj=self)

    @property
    def counts(self) -> str:
        """Numbers of planes and of angles in each, such as ``"4 x 19"``."""
        planes, angles = self._grid_counts
        return f"{planes} x {angles}"

    @property
    def _grid_counts(self) -> tuple[int, int]:
        """Of planes, which meet in the poles, and of angles between them."""
        horizontal, vertical = self._grid.intensity_cd.shape
        return (vertical, horizontal) if self.type == "B" else (horizontal, vertical)

    def unfolded(self) -> _facts.Grid:
        """Return the grid all around, closing plane included, whatever the symmetry.

        Returns
        -------
        Grid
            That of a sector, as types A and B mostly have it, stays a sector.
        """
        return _facts.grid(self._native.grid(True))

    def intensity(self, directions: ArrayLike) -> Floats:
        """Return intensities in candela.

        Between the angles of the file they are bilinear; outside of what was measured they are 0.

        Parameters
        ----------
        directions : array_like of shape (..., 3)
            Vectors in the frame of the luminaire.

        Returns
        -------
        ndarray of shape (...)
            A scalar for a single direction.

        Raises
        ------
        ValueError
            For other shapes.
        """
        found = _arrays.rows(directions, "directions", 3)
        return _arrays.shaped(self._native.intensity_cd(found.flat), found.shape)

    def intensity_at(self, *, c_deg: ArrayLike = 0.0, gamma_deg: ArrayLike) -> Floats:
        """Return intensities in candela at angles C and gamma, for luminaires of any type.

        Parameters
        ----------
        c_deg : array_like
            Half-planes in degrees, any number of turns off.
        gamma_deg : array_like
            Angles from nadir, 0 to 180 degrees; beyond, results are NaN.

        Returns
        -------
        ndarray
            Of the shape that both are broadcast to.

        Examples
        --------
        >>> from quasilux import photometry
        >>> lamp = photometry.from_intensities([0, 90], [0, 90], [[300, 0], [300, 60]])
        >>> lamp.intensity_at(c_deg=[[0], [270]], gamma_deg=[0, 45, 90])
        array([[300., 150.,   0.],
               [300., 180.,  60.]])
        """
        c_rows = _arrays.scalars(c_deg, "c_deg")
        gamma_rows = _arrays.scalars(gamma_deg, "gamma_deg")
        shape = _arrays.common_shape(c_rows, gamma_rows, "c_deg and gamma_deg")
        if 0 in shape:
            return np.empty(shape)
        values = self._native.intensity_at_cd(c_rows.broadcast(shape), gamma_rows.broadcast(shape))
        return _arrays.shaped(values, shape)

    def sample(self, u: ArrayLike) -> Floats:
        """Return directions distributed as the light is: with density intensity / flux.

        This is an exact inverse transform, continuous in `u` wherever there is light: points of a
        low-discrepancy sequence stay well spread.

        Parameters
        ----------
        u : array_like of shape (..., 2)
            Coordinates in [0, 1).

        Returns
        -------
        ndarray of shape (..., 3)
            Unit vectors.

        Raises
        ------
        ValueError
            For other shapes and coordinates, and where there is no light.

        Examples
        --------
        >>> import numpy as np
        >>> from quasilux import photometry
        >>> lamp = photometry.from_intensities(0, [0, 90], [100, 100])
        >>> wo = lamp.sample(np.random.default_rng(1).random((1000, 2)))
        >>> bool(np.allclose(lamp.pdf(wo), 1 / (2 * np.pi)))
        True
        """
        found = _arrays.coordinates(u)
        if not self.flux_lm > 0.0:
            raise ValueError("the luminaire gives no light; expected a flux above 0")
        return self._native.sample(found.flat).reshape(*found.shape, 3)

    def pdf(self, directions: ArrayLike) -> Floats:
        """Return the density of `sample` over solid angle, in 1/sr; 0 where there is no light.

        Parameters
        ----------
        directions : array_like of shape (..., 3)
            Vectors in the frame of the luminaire.

        Returns
        -------
        ndarray of shape (...)

        Raises
        ------
        ValueError
            For other shapes.
        """
        found = _arrays.rows(directions, "directions", 3)
        return _arrays.shaped(self._native.pdf_sr(found.flat), found.shape)

    def invert(self, directions: ArrayLike) -> Floats:
        """Return the coordinates that `sample` turns into directions.

        A direction outside of what was measured is first moved to its border.

        Parameters
        ----------
        directions : array_like of shape (..., 3)
            Vectors in the frame of the luminaire.

        Returns
        -------
        ndarray of shape (..., 2)

        Raises
        ------
        ValueError
            For other shapes.
        """
        found = _arrays.rows(directions, "directions", 3)
        return self._native.invert(found.flat).reshape(*found.shape, 2)

    def projected_area_m2(self, directions: ArrayLike) -> Floats:
        """Return the area of the luminous shape as it is seen from directions, in square metres.

        Intensity over area is the mean luminance.

        Parameters
        ----------
        directions : array_like of shape (..., 3)
            Vectors in the frame of the luminaire.

        Returns
        -------
        ndarray of shape (...)
            0 for points and lines.

        Raises
        ------
        ValueError
            For other shapes.
        """
        found = _arrays.rows(directions, "directions", 3)
        return _arrays.shaped(self._native.projected_area_m2(found.flat), found.shape)
