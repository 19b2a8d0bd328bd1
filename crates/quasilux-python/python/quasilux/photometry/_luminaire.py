"""One measured luminaire as an object of Python."""

from __future__ import annotations

import dataclasses
import functools
import os
import pickle
from typing import TYPE_CHECKING, Any, Literal, cast

import numpy as np

from quasilux._errors import input_error
from quasilux.photometry import _arrays, _display, _facts, _files, _plot
from quasilux.photometry._diagram import Diagram
from quasilux.photometry._intensities import Intensities

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from matplotlib.axes import Axes
    from numpy.typing import ArrayLike

    from quasilux import _native

Kind = Literal["polar", "cartesian", "both"]
Unit = Literal["cd/klm", "cd"]
Edition = Literal["LM-63-1986", "LM-63-1991", "LM-63-1995", "LM-63-2002", "LM-63-2019"]

_PRINCIPAL_DEG = (0.0, 90.0)
_MOST_PLANES = 24


class Photometry(Intensities):
    """A measured luminaire: intensities over directions, with the facts of its file.

    `read` makes it of a file, `from_intensities` of arrays.

    Directions are vectors in the luminaire's frame, whatever the photometric type: gamma = 0
    (nadir) is -z, C0 is +x and C90 is +y. They may have any length. Where one is zero or not
    finite, results are NaN.

    All arrays that an attribute returns are read-only; those that a method returns are new.

    See Also
    --------
    quasilux.photometry.read, quasilux.photometry.from_intensities

    Examples
    --------
    >>> from quasilux import photometry
    >>> lamp = photometry.from_intensities(0, [0, 90, 180], [200, 100, 0], name="Pear")
    >>> lamp
    <Photometry 'Pear': LM-63-2002, type C, rotational, 1 x 3, 1257 lm>
    >>> lamp.intensity([[0, 0, -1], [1, 0, 0]])
    array([200., 100.])
    """

    def __init__(
        self,
        native: _native.Luminaire,
        *,
        recipe: tuple[Callable[..., Photometry], tuple[Any, ...]],
        source: _files.Contents | None = None,
        warnings: Sequence[_facts.FileWarning] = (),
    ) -> None:
        super().__init__(native)
        self._recipe = recipe
        self._source = source
        self._warnings = tuple(warnings)

    def __reduce__(self) -> tuple[Callable[..., Photometry], tuple[Any, ...]]:
        """Tell pickle how to make it again: of the bytes of its file, or of its arrays."""
        return self._recipe

    def _identity(self) -> tuple[Callable[..., Photometry], bytes]:
        """Return what it is made of, whatever the file is called."""
        make, arguments = self._recipe
        kept = [it.data if isinstance(it, _files.Contents) else it for it in arguments]
        return make, pickle.dumps(kept)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Photometry):
            return NotImplemented
        return self._identity() == other._identity()

    def __hash__(self) -> int:
        return hash(self._identity())

    # What the file is and says.

    @property
    def file(self) -> str | None:
        """What messages call the file; None where there was none."""
        return None if self._source is None else self._source.file

    @property
    def data(self) -> bytes | None:
        """The bytes of the file; None where there was none."""
        return None if self._source is None else self._source.data

    @property
    def format(self) -> _facts.FormatName | None:
        """``"LM-63"``, ``"EULUMDAT"`` or ``"TM-33"``; None where there was no file."""
        return self._native.format

    @property
    def misnamed(self) -> _facts.FormatName | None:
        """The format that the file's name promises, where its content is of another one."""
        return self._native.misnamed

    @functools.cached_property
    def facts(self) -> _facts.Facts:
        """All facts of the header."""
        return _facts.facts(self._native.facts())

    @property
    def warnings(self) -> tuple[_facts.FileWarning, ...]:
        """What was odd in the file, each kind once, at its first place."""
        return self._warnings

    @property
    def standard(self) -> str:
        """Standard and edition, such as ``"LM-63-2002"``."""
        return self.facts.standard

    @property
    def keywords(self) -> dict[str, str]:
        """The first value of each keyword, without labels that have none."""
        named = (keyword for keyword in reversed(self.facts.keywords) if keyword.name)
        found = {keyword.name: keyword.value for keyword in named}
        return dict(reversed(found.items()))

    @property
    def name(self) -> str:
        """What the file calls the luminaire: its name, else its number, else nothing."""
        return self._line("LUMINAIRE") or self._line("LUMCAT") or ""

    @property
    def manufacturer(self) -> str:
        """The manufacturer; empty where the file names none."""
        return self._line("MANUFAC") or ""

    @property
    def catalog_number(self) -> str:
        """The catalogue number; empty where the file has none."""
        return self._line("LUMCAT") or ""

    def _line(self, keyword: str) -> str | None:
        return " ".join(self.keywords.get(keyword, "").split()) or None

    @functools.cached_property
    def luminous_shape(self) -> _facts.LuminousShape:
        """What of the luminaire shines, by the signs of the file's dimensions."""
        return _facts.shape(self._native.shape())

    # Figures.

    @property
    def rated_flux_lm(self) -> float | None:
        """Lamp lumens times number of lamps; None for absolute photometry."""
        return self.analysis.rated_flux_lm

    @functools.cached_property
    def analysis(self) -> _facts.Analysis:
        """Light output ratio, efficacy, beam angles, flux code and fluxes of zones."""
        c0, c90 = (self.plane(c_deg) for c_deg in _PRINCIPAL_DEG)
        return _facts.analysis(self._native.analysis(), (c0, c90))

    def plane(self, c_deg: float = 0.0) -> _facts.PlaneCurve:
        """Return the intensities in a vertical plane, with beam and field angles.

        Parameters
        ----------
        c_deg : float
            The half-plane of positive gamma, in degrees; that of negative gamma is C + 180.

        Returns
        -------
        PlaneCurve

        Examples
        --------
        >>> from quasilux import photometry
        >>> lamp = photometry.from_intensities(0, [0, 30, 60, 90], [400, 300, 100, 0])
        >>> lamp.plane(0).beam
        Spread(angle_deg=90.0, start_deg=-45.0, end_deg=45.0)
        """
        c_deg = _angles([c_deg], "c_deg")[0]
        other = "-".join(f"C{(c_deg + off) % 360:g}" for off in (0, 180))
        return _facts.plane(other, self._native.plane(c_deg))

    def tilt_factor(self, down: ArrayLike) -> _facts.TiltFactor:
        """Return how much light the luminaire gives when it is tilted.

        Intensities, flux and density are those at factor 1.

        Parameters
        ----------
        down : array_like of shape (3,)
            Straight down, in the frame of the luminaire: (0, 0, -1) where it is not tilted.

        Returns
        -------
        TiltFactor

        Raises
        ------
        ValueError
            For other shapes and for a vector without a direction.
        """
        found = _arrays.rows(down, "down", 3)
        if found.shape != ():
            raise ValueError(f"down has the shape {(*found.shape, 3)}; expected (3,)")
        x, y, z = found.flat.tolist()
        return _facts.TiltFactor(**self._native.tilt_factor((x, y, z)))

    # Files.

    def to_ies(self, *, edition: Edition | None = None) -> _facts.Encoded:
        """Return the bytes of an IES file (ANSI/IES LM-63) that reads back to the same table.

        Parameters
        ----------
        edition : str, optional
            Such as ``"LM-63-1995"``. Without it a luminaire of LM-63-2019 stays one, and all
            others become LM-63-2002, which most programs read.

        Returns
        -------
        Encoded
            Bytes with `notes`: what the edition could not hold.

        Raises
        ------
        ValueError
            For other editions.

        Examples
        --------
        >>> from quasilux import photometry
        >>> lamp = photometry.from_intensities(0, [0, 90], [100, 100], keywords={"TEST": "none"})
        >>> data = lamp.to_ies()
        >>> data.splitlines()[0]
        b'IESNA:LM-63-2002'
        >>> photometry.read(data).flux_lm == lamp.flux_lm
        True
        """
        return _encoded(self._native.to_ies(edition))

    def to_ldt(self) -> _facts.Encoded:
        """Return the bytes of an EULUMDAT file that reads back to the same table.

        Types A and B are resampled to type C.

        Returns
        -------
        Encoded
            Bytes with `notes`: what the format could not hold.
        """
        return _encoded(self._native.to_ldt())

    def save(
        self, path: _files.Path, *, edition: Edition | None = None
    ) -> tuple[_facts.EncodingNote, ...]:
        """Write a file in the format that its name ends in, ``.ies`` or ``.ldt``.

        The file appears whole or not at all.

        Parameters
        ----------
        path : str or os.PathLike
            Where to.
        edition : str, optional
            Of IES files, as in `to_ies`.

        Returns
        -------
        tuple of EncodingNote
            What the format could not hold.

        Raises
        ------
        ValueError
            For other names and editions, and for the file that the luminaire was read from: a
            measurement is never written over.
        OSError
            When the file cannot be written.
        """
        kind = _files.extension(path)
        if kind == ".ies":
            encoded = self.to_ies(edition=edition)
        elif kind == ".ldt" and edition is None:
            encoded = self.to_ldt()
        elif kind == ".ldt":
            raise ValueError(f"edition is {edition!r} for an EULUMDAT file; expected None")
        else:
            raise ValueError(f"found the extension {kind!r}; expected .ies or .ldt")
        own = None if self._source is None else self._source.path
        if own is not None and _is_same(path, own):
            message = "would replace the measured file; expected another name"
            raise input_error(message, _files.printable(own))
        _files.write_whole(path, encoded)
        return encoded.notes

    def to_dict(self) -> dict[str, Any]:
        """Return the figures as numbers, texts and lists, as the command line's document has them.

        Returns
        -------
        dict
            With the keys of ``luminaire`` in ``quasilux photometry --json``: units stand in the
            names, shares run from 0 to 1, unknown figures are None.
        """
        found = self.analysis
        plane_keys = ("maximum_cd", "centre_cd", "beam", "centre_beam", "field")
        planes = [
            {"plane": plane.name, **{key: _plain(getattr(plane, key)) for key in plane_keys}}
            for plane in found.principal_planes
        ]
        return {
            "name": self._line("LUMINAIRE"),
            "manufacturer": self._line("MANUFAC"),
            "catalog_number": self._line("LUMCAT"),
            "standard": self.standard,
            "photometric_type": self.type,
            "symmetry": self.symmetry,
            "planes": found.measured_planes,
            "angles": self._grid_counts[1],
            "flux_lm": found.flux_lm,
            "downward_flux_lm": found.downward_flux_lm,
            "rated_flux_lm": found.rated_flux_lm,
            "light_output_ratio": found.light_output_ratio,
            "input_watts": self.facts.input_watts,
            "efficacy_lm_w": found.efficacy_lm_w,
            "maximum": _plain(found.maximum),
            "principal_planes": planes,
            "flux_code": _plain(found.flux_code),
            "zones_lm": found.zones_lm.tolist(),
        }

    # Diagrams.

    @property
    def title(self) -> str:
        """What diagrams call the luminaire: its `name`, else that of its file."""
        stem = os.path.splitext(os.path.basename(self.file or ""))[0]
        return self.name or stem or "luminaire"

    def diagram(
        self,
        kind: Kind = "polar",
        *,
        planes_deg: Sequence[float] = _PRINCIPAL_DEG,
        unit: Unit = "cd/klm",
        title: str | None = None,
    ) -> Diagram:
        """Draw intensities in vertical planes.

        Parameters
        ----------
        kind : {"polar", "cartesian", "both"}
            The polar diagram of data sheets, gamma = 0 down, or candela over gamma.
        planes_deg : sequence of float
            Half-planes C of positive gamma, in degrees, up to 24.
        unit : {"cd/klm", "cd"}
            Of the polar diagram: candela for each 1000 lm of the lamps, or of the luminaire in
            absolute photometry; or candela.
        title : str, optional
            What stands above it; the luminaire's name if not given.

        Returns
        -------
        Diagram
            Notebooks show it; ``save`` writes it as SVG or PNG.

        Raises
        ------
        ValueError
            For other kinds, planes and units.
        """
        if unit not in ("cd/klm", "cd"):
            raise ValueError(f'unit is {unit!r}; expected "cd/klm" or "cd"')
        planes = _angles(planes_deg, "planes_deg")
        title = self.title if title is None else _files.printable(title)
        drawing = self._native.diagram(kind, planes, unit == "cd", title)
        return Diagram(drawing, title)

    def plot(
        self,
        ax: Axes | None = None,
        *,
        kind: Literal["polar", "cartesian"] = "polar",
        planes_deg: Sequence[float] = _PRINCIPAL_DEG,
        unit: Unit = "cd",
        **line: Any,
    ) -> Axes:
        """Draw intensities in vertical planes with matplotlib.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Where to, polar axes for the polar diagram; new axes if not given.
        kind : {"polar", "cartesian"}
            As in `diagram`.
        planes_deg : sequence of float
            Half-planes C of positive gamma, in degrees.
        unit : {"cd", "cd/klm"}
            Of the intensities.
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
            For other kinds and units, and for axes that are not polar where they must be.
        """
        if unit not in ("cd/klm", "cd"):
            raise ValueError(f'unit is {unit!r}; expected "cd/klm" or "cd"')
        reference_lm = self.rated_flux_lm or self.flux_lm
        relative = unit == "cd/klm" and reference_lm > 0.0
        curves = [self.plane(c_deg) for c_deg in planes_deg]
        factor = 1000.0 / reference_lm if relative else 1.0
        return _plot.intensities(
            ax, curves, kind=kind, factor=factor, unit="cd/klm" if relative else "cd", line=line
        )

    def __repr__(self) -> str:
        what = f"{self.standard}, type {self.type}, {self.symmetry}, {self.counts}"
        return f"<Photometry {_display.short(self.title)!r}: {what}, {self.flux_lm:.4g} lm>"

    def _repr_svg_(self) -> str:
        return self.diagram().to_svg()

    def _repr_png_(self) -> tuple[bytes, dict[str, Any]]:
        return self.diagram()._repr_png_()

    def _repr_html_(self) -> str:
        return _display.html(self)


def _encoded(entry: _native.EncodedEntry) -> _facts.Encoded:
    return _facts.Encoded(entry["data"], [_facts.EncodingNote(**note) for note in entry["notes"]])


def _is_same(path: _files.Path, own: str) -> bool:
    """Whether a file that is there is that of the luminaire."""
    return os.path.exists(path) and os.path.exists(own) and os.path.samefile(path, own)


def _angles(values: Sequence[float], name: str) -> list[float]:
    """A few finite angles."""
    found = _arrays.real(values, name)
    if found.ndim != 1 or not 1 <= found.size <= _MOST_PLANES:
        message = f"{name} has the shape {found.shape}; expected 1 to {_MOST_PLANES} angles"
        raise ValueError(message)
    if not np.isfinite(found).all():
        raise ValueError(f"{name} has angles that are not finite; expected degrees")
    return found.tolist()


def _plain(value: Any) -> Any:
    """Numbers, texts, lists and dictionaries of what may hold dataclasses."""
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        return {key: _plain(part) for key, part in dataclasses.asdict(value).items()}
    return list(cast("tuple[Any, ...]", value)) if isinstance(value, tuple) else value
