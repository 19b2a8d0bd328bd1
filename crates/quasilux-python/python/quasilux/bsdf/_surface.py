"""One measured surface as an object of Python."""

from __future__ import annotations

import functools
import os
from typing import TYPE_CHECKING, Any, get_args

import numpy as np

from quasilux import _native
from quasilux._errors import input_error
from quasilux.bsdf import _display, _facts, _tables
from quasilux.bsdf._facts import Incidence, Mode, Side
from quasilux.bsdf._tables import Table
from quasilux.photometry import _arrays, _files, _plot
from quasilux.photometry._diagram import Diagram
from quasilux.photometry._facts import FileWarning

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from matplotlib.axes import Axes
    from numpy.typing import ArrayLike

    from quasilux.photometry._arrays import Floats

_INCIDENCES_DEG = (0.0, 30.0, 60.0)
_MOST_INCIDENCES = 24


def read(source: _files.Source, *, name: str | None = None, strict: bool = False) -> Bsdf:
    """Read the file of a measured surface; its content tells the format.

    Only whether a DDR file is reflection (``.ddr``) or transmission (``.ddt``) is told by its name.

    Parameters
    ----------
    source : str, os.PathLike, bytes-like or file
        A path, the bytes of a file, or a file that is open in binary mode.
    name : str, optional
        What messages call the file; its path if not given.
    strict : bool, optional
        Refuse a file with warnings.

    Returns
    -------
    Bsdf

    Raises
    ------
    InputError
        A `ValueError` with the attributes ``file``, ``line``, ``column`` and ``message``, where the
        file has no meaning.
    OSError
        When the file cannot be read.
    TypeError
        For other sources.
    """
    surface = _read(_files.contents(source, name=name, most_bytes=_native.MAX_BSDF_BYTES))
    if strict and surface.warnings:
        first = surface.warnings[0]
        raise input_error(first.message, first.file, first.line, first.column)
    return surface


def _read(contents: _files.Contents) -> Bsdf:
    return Bsdf(_native.read_bsdf(contents.data, contents.file), source=contents)


class Bsdf:
    """A measured surface: how both sides of a thin sheet scatter light.

    `read` makes it of a file. The module says what frame directions are in; they are vectors of any
    length. Where one is zero or not finite, results are NaN; below its side, and where there is no
    table, nothing is scattered. Arrays of directions and coordinates are broadcast against each
    other.

    See Also
    --------
    quasilux.bsdf.read
    """

    def __init__(self, native: _native.Surface, *, source: _files.Contents) -> None:
        self._native = native
        self._source = source
        self._facts = native.facts()
        self._warnings = tuple(FileWarning(**warning) for warning in native.warnings())

    def __reduce__(self) -> tuple[Callable[..., Bsdf], tuple[Any, ...]]:
        """Tell pickle how to make it again: of the bytes of its file."""
        return _read, (self._source,)

    def __eq__(self, other: object) -> bool:
        return self.data == other.data if isinstance(other, Bsdf) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.data)

    # What the file is and says.

    @property
    def file(self) -> str:
        """What messages call the file."""
        return self._source.file

    @property
    def data(self) -> bytes:
        """The bytes of the file."""
        return self._source.data

    @property
    def format(self) -> str:
        """The format, such as ``"WINDOW XML, Klems"`` or ``"MERL"``."""
        return self._facts["format"]

    @property
    def name(self) -> str:
        """What the file calls the surface; empty where it does not."""
        return self._facts["name"]

    @property
    def manufacturer(self) -> str:
        """The manufacturer; empty where the file names none."""
        return self._facts["manufacturer"]

    @property
    def thickness_m(self) -> float | None:
        """Thickness of the sheet in metres, which changes no light; None where it is unknown."""
        return self._facts["thickness_m"]

    @property
    def warnings(self) -> tuple[FileWarning, ...]:
        """What was odd in the file, and defects of its tables, each kind once."""
        return self._warnings

    @functools.cached_property
    def tables(self) -> tuple[Table, ...]:
        """All tables, first those of light on the front."""
        return tuple(Table(self._native, entry) for entry in self._native.tables())

    def table(self, side: Side = "front", mode: Mode = "reflection") -> Table:
        """Return the table of a side and a mode.

        Parameters
        ----------
        side : {"front", "back"}
            The side that light arrives on.
        mode : {"reflection", "transmission"}
            Where it goes.

        Returns
        -------
        Table

        Raises
        ------
        LookupError
            Where nothing is scattered; `albedo` and `evaluate` of the surface are 0 there.
        ValueError
            For other sides and modes.
        """
        for given, known in ((side, get_args(Side)), (mode, get_args(Mode))):
            if given not in known:
                raise ValueError(f"found {given!r}; expected {' or '.join(known)}")
        for table in self.tables:
            if (table.side, table.mode) == (side, mode):
                return table
        names = ", ".join(f"{table.side} {table.mode}" for table in self.tables)
        raise LookupError(f"{self.file} has no {side} {mode}; expected {names or 'nothing'}")

    @property
    def is_isotropic(self) -> bool:
        """Whether the surface may be turned in its plane."""
        return all(table.is_isotropic for table in self.tables)

    @property
    def is_coloured(self) -> bool:
        """Whether a table has colour channels that differ."""
        return any(table.is_coloured for table in self.tables)

    @functools.cached_property
    def energy(self) -> tuple[_facts.EnergyBalance, ...]:
        """Where light goes, for each side that scatters."""
        return tuple(_facts.energy_balance(entry) for entry in self._native.energy())

    @functools.cached_property
    def reciprocity(self) -> tuple[_facts.Reciprocity, ...]:
        """How far swapped directions differ: reflection off each side, transmission once."""
        return tuple(_facts.reciprocity(entry) for entry in self._native.reciprocity())

    # Directions.

    def albedo(
        self,
        wi: ArrayLike,
        *,
        side: Side = "front",
        mode: Mode = "reflection",
        rgb: bool = False,
    ) -> Floats:
        """Return the share of light from a direction that is scattered.

        It is the integral of f times the cosine of wo, exact for what `evaluate` returns.

        Parameters
        ----------
        wi : array_like of shape (..., 3)
            Incident directions.
        side : {"front", "back"}
            The side that light arrives on.
        mode : {"reflection", "transmission"}
            Where it goes.
        rgb : bool
            Return three channels of linear RGB (ITU-R BT.709) instead of their luminance.

        Returns
        -------
        ndarray of shape (...) or (..., 3)

        Raises
        ------
        ValueError
            For other shapes, sides and modes.
        """
        return _tables.albedo(self._native, (side, mode), wi, rgb=rgb)

    def evaluate(
        self,
        wi: ArrayLike,
        wo: ArrayLike,
        *,
        side: Side = "front",
        mode: Mode = "reflection",
        rgb: bool = False,
    ) -> Floats:
        """Return the scattering distribution function f in 1/sr, without the cosine.

        Parameters
        ----------
        wi, wo : array_like of shape (..., 3)
            Incident and scattered directions.
        side : {"front", "back"}
            The side that light arrives on.
        mode : {"reflection", "transmission"}
            Where it goes.
        rgb : bool
            Return three channels of linear RGB (ITU-R BT.709) instead of their luminance.

        Returns
        -------
        ndarray of shape (...) or (..., 3)
            Of the shape that both are broadcast to.

        Raises
        ------
        ValueError
            For other shapes, sides and modes.
        """
        return _tables.evaluate(self._native, (side, mode), wi, wo, rgb=rgb)

    def sample(
        self, wi: ArrayLike, u: ArrayLike, *, side: Side = "front", mode: Mode = "reflection"
    ) -> Floats:
        """Return directions distributed as light is scattered.

        Their density is proportional to the luminance of f times the cosine of wo. This is an exact
        inverse transform, continuous in `u` within a cell of the table.

        Parameters
        ----------
        wi : array_like of shape (..., 3)
            Incident directions.
        u : array_like of shape (..., 2)
            Coordinates in [0, 1).
        side : {"front", "back"}
            The side that light arrives on.
        mode : {"reflection", "transmission"}
            Where it goes.

        Returns
        -------
        ndarray of shape (..., 3)
            Unit vectors; NaN where nothing is scattered.

        Raises
        ------
        ValueError
            For other shapes, coordinates, sides and modes.
        """
        return _tables.sample(self._native, (side, mode), wi, u)

    def pdf(
        self, wi: ArrayLike, wo: ArrayLike, *, side: Side = "front", mode: Mode = "reflection"
    ) -> Floats:
        """Return the density of `sample` over solid angle, in 1/sr.

        Parameters
        ----------
        wi, wo : array_like of shape (..., 3)
            Incident and scattered directions.
        side : {"front", "back"}
            The side that light arrives on.
        mode : {"reflection", "transmission"}
            Where it goes.

        Returns
        -------
        ndarray of shape (...)
            0 where nothing is scattered.

        Raises
        ------
        ValueError
            For other shapes, sides and modes.
        """
        return _tables.pdf(self._native, (side, mode), wi, wo)

    def invert(
        self, wi: ArrayLike, wo: ArrayLike, *, side: Side = "front", mode: Mode = "reflection"
    ) -> Floats:
        """Return coordinates that `sample` turns into directions.

        Parameters
        ----------
        wi, wo : array_like of shape (..., 3)
            Incident and scattered directions.
        side : {"front", "back"}
            The side that light arrives on.
        mode : {"reflection", "transmission"}
            Where it goes.

        Returns
        -------
        ndarray of shape (..., 2)
            NaN where the density is 0.

        Raises
        ------
        ValueError
            For other shapes, sides and modes.
        """
        return _tables.invert(self._native, (side, mode), wi, wo)

    def to_dict(self, *, incidences_deg: Sequence[Incidence] = _INCIDENCES_DEG) -> dict[str, Any]:
        """Return the figures as numbers, texts and lists, as the command line's document has them.

        Parameters
        ----------
        incidences_deg : sequence of float or of pairs of float
            Directions of light to report: angles from the normal, or from the normal and around it.

        Returns
        -------
        dict
            With the keys of ``surface`` in ``quasilux bsdf --json``: units stand in the names,
            shares are luminous and run from 0 to 1.

        Raises
        ------
        ValueError
            For other directions.
        """
        incidences = _incidences(incidences_deg)
        wi = _tables.direction(theta_deg=incidences[:, 0], phi_deg=incidences[:, 1])
        return {
            "format": self.format,
            "name": self.name,
            "manufacturer": self.manufacturer,
            "thickness_m": self.thickness_m,
            "is_isotropic": self.is_isotropic,
            "is_coloured": self.is_coloured,
            "tables": [_display.table_entry(table) for table in self.tables],
            "energy": [
                {
                    "side": balance.side,
                    "incidences": _display.shares(self, balance.side, incidences, wi),
                    **_display.energy_entry(balance),
                }
                for balance in self.energy
            ],
            "reciprocity": [_display.reciprocity_entry(found) for found in self.reciprocity],
        }

    # Diagrams.

    @property
    def title(self) -> str:
        """What diagrams call the surface: its name, else that of its file."""
        return self.name or os.path.splitext(os.path.basename(self.file))[0]

    def diagram(
        self,
        incidences_deg: Sequence[Incidence] = _INCIDENCES_DEG,
        *,
        title: str | None = None,
    ) -> Diagram:
        """Draw where light goes in the plane of incidence: f times the cosine, for each side.

        Parameters
        ----------
        incidences_deg : sequence of float or of pairs of float
            Directions of light: angles from the normal, from 0 to below 90 degrees, or pairs of
            that and the angle around the normal; up to 24.
        title : str, optional
            What stands above it; the surface's name if not given.

        Returns
        -------
        Diagram
            Notebooks show it; ``save`` writes it as SVG or PNG.

        Raises
        ------
        ValueError
            For other directions.
        """
        title = self.title if title is None else _files.printable(title)
        pairs = [(theta, phi) for theta, phi in _incidences(incidences_deg).tolist()]
        return Diagram(self._native.diagram(title, pairs), title)

    def plot(
        self,
        ax: Axes | None = None,
        *,
        incidences_deg: Sequence[Incidence] = _INCIDENCES_DEG,
        side: Side = "front",
        **line: Any,
    ) -> Axes:
        """Draw where light goes in the plane of incidence with matplotlib.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to, polar axes; new ones if not given.
        incidences_deg : sequence of float or of pairs of float
            Directions of light, as in `diagram`.
        side : {"front", "back"}
            The side that light arrives on, which is up.
        **line
            Properties of the lines, for matplotlib.

        Returns
        -------
        matplotlib.axes.Axes

        Raises
        ------
        ImportError
            Without matplotlib.
        ValueError
            For other directions and sides, and for axes that are not polar.
        """
        lobes = [
            (_display.incidence_text(theta, phi), self._native.lobe(side, (theta, phi)))
            for theta, phi in _incidences(incidences_deg).tolist()
        ]
        return _plot.lobes(ax, [(name, lobe.reshape(-1, 2)) for name, lobe in lobes], line=line)

    def __repr__(self) -> str:
        tables = ", ".join(f"{table.side} {table.mode}" for table in self.tables)
        return f"<Bsdf {_display.short(self.title)!r}: {self.format}; {tables}>"

    def _repr_svg_(self) -> str:
        return self.diagram().to_svg()

    def _repr_png_(self) -> tuple[bytes, dict[str, Any]]:
        return self.diagram()._repr_png_()

    def _repr_html_(self) -> str:
        return _display.html(self)


def _incidences(incidences_deg: Sequence[Incidence]) -> Floats:
    """Polar angles and azimuths, of shape (k, 2)."""
    pairs = [(given, 0.0) if np.ndim(given) == 0 else given for given in incidences_deg]
    if not 1 <= len(pairs) <= _MOST_INCIDENCES:
        message = f"incidences_deg has {len(pairs)} directions; expected 1 to {_MOST_INCIDENCES}"
        raise ValueError(message)
    found = _arrays.real(pairs, "incidences_deg")
    if found.shape != (len(pairs), 2):
        raise ValueError("incidences_deg has no angles or pairs; expected degrees")
    theta, phi = found[:, 0], found[:, 1]
    if not ((theta >= 0.0) & (theta < 90.0) & (np.abs(phi) <= 360.0)).all():
        raise ValueError(
            "incidences_deg has other angles; expected degrees from the normal, from 0 to below "
            "90, as in 30 or (30, 90)"
        )
    return found
