"""Luminaires of files and of arrays."""

from __future__ import annotations

import dataclasses
import os
from typing import TYPE_CHECKING, Literal

import numpy as np

from quasilux import _native
from quasilux._errors import input_error
from quasilux.photometry import _arrays, _files
from quasilux.photometry._facts import FileWarning
from quasilux.photometry._luminaire import Photometry

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import ArrayLike

    from quasilux.photometry._arrays import Floats

FormatChoice = Literal["LM-63", "EULUMDAT", "TM-33", "ies", "ldt", "xml"]
ShapeChoice = Literal["box", "cylinder", "cylinder along x", "cylinder along y", "ellipsoid"]

_FORMATS = {"ies": "LM-63", "ldt": "EULUMDAT", "xml": "TM-33"}
_TILT_FILE = "TiltFile"


def read(
    source: _files.Source,
    *,
    format: FormatChoice | None = None,
    tilt: _files.Source | None = None,
    name: str | None = None,
    strict: bool = False,
) -> Photometry:
    r"""Read a luminaire file: IES (ANSI/IES LM-63), EULUMDAT or TM-33.

    What files have that the standards do not allow is tolerated where its meaning is clear, and
    becomes one of `Photometry.warnings`.

    Parameters
    ----------
    source : str, os.PathLike, bytes-like or file
        A path, the bytes of a file, or a file that is open in binary mode.
    format : {"LM-63", "EULUMDAT", "TM-33"}, optional
        Also ``"ies"``, ``"ldt"`` and ``"xml"``. Without it the content tells the format.
    tilt : str, os.PathLike, bytes-like or file, optional
        A file of tilt factors, in place of those that the luminaire file has or names. Without it,
        a file that ``TILT=`` names is looked for beside that of `source`.
    name : str, optional
        What messages call the file; its path if not given.
    strict : bool, optional
        Refuse a file with warnings. That a luminaire gives less light than its lamps is none.

    Returns
    -------
    Photometry

    Raises
    ------
    InputError
        A `ValueError` with the attributes ``file``, ``line``, ``column`` and ``message``, where the
        file has no meaning.
    OSError
        When the file cannot be read.
    TypeError
        For other sources.

    Examples
    --------
    >>> from quasilux import photometry
    >>> file = b"IESNA:LM-63-2002\n[TEST] example\nTILT=NONE\n" + (
    ...     b"1 -1 1 3 1 1 2 0 0 0\n1 1 10\n0 45 90\n0\n100 80 10\n"
    ... )
    >>> lamp = photometry.read(file)
    >>> lamp.gamma_deg, lamp.intensity_cd
    (array([ 0., 45., 90.]), array([[100.,  80.,  10.]]))
    >>> try:
    ...     photometry.read(file.replace(b"80", b"8o"), name="lamp.ies")
    ... except ValueError as error:
    ...     print(error)
    lamp.ies:8:5: found "8o"; expected candela value 2 of 3 in plane 1 of 1
    """
    contents = _files.contents(source, name=name, most_bytes=_native.MAX_PHOTOMETRY_BYTES)
    factors = None
    if tilt is not None:
        factors = _files.contents(tilt, name=None, most_bytes=_native.MAX_TILT_BYTES)
    luminaire = _read(contents, format, factors)
    if strict:
        _refuse_warnings(luminaire)
    return luminaire


def _read(
    contents: _files.Contents, format: str | None, tilt: _files.Contents | None
) -> Photometry:
    """Read a file again from what pickle keeps, or for the first time."""
    if format is not None:
        format = _FORMATS.get(format, format)
    native = _native.read_photometry(contents.data, contents.file, format)
    reason = None
    if tilt is None and native.tilt_file is not None and contents.path is not None:
        path = _beside(contents.path, native.tilt_file)
        try:
            tilt = _files.regular_file(path, most_bytes=_native.MAX_TILT_BYTES)
        except OSError as error:
            reason = f'cannot read the tilt file "{path}": {error.strerror or error}'
    if tilt is not None:
        native = native.with_tilt(tilt.data, tilt.file)
    warnings = [FileWarning(**warning) for warning in native.warnings()]
    if reason is not None:
        warnings = [_unread(warning, reason) for warning in warnings]
    recipe = (_read, (contents, format, tilt))
    return Photometry(native, recipe=recipe, source=contents, warnings=warnings)


def _beside(path: str, name: str) -> str:
    """Return where a file is that another one names, with slashes of any kind."""
    return os.path.join(os.path.dirname(path), name.replace("\\", "/"))


def _unread(warning: FileWarning, reason: str) -> FileWarning:
    if warning.kind != _TILT_FILE:
        return warning
    message = f"{reason}; the lamps count as giving the same light at every tilt (factor 1)"
    return dataclasses.replace(warning, message=_files.printable(message))


def _refuse_warnings(luminaire: Photometry) -> None:
    ratio = luminaire.analysis.light_output_ratio
    has_losses = ratio is not None and ratio < 1.0 and luminaire.format == "LM-63"
    for warning in luminaire.warnings:
        if not (has_losses and warning.kind == "FluxDiffers"):
            raise input_error(warning.message, warning.file, warning.line, warning.column)


def from_intensities(
    c_deg: ArrayLike,
    gamma_deg: ArrayLike,
    intensity_cd: ArrayLike,
    *,
    name: str = "",
    manufacturer: str = "",
    catalog_number: str = "",
    lamp: str = "",
    keywords: Mapping[str, str] | None = None,
    lamp_count: float = 1.0,
    lumens_per_lamp: float | None = None,
    input_watts: float = 0.0,
    luminous_shape: ShapeChoice = "box",
    luminous_size_m: Sequence[float] = (0.0, 0.0, 0.0),
) -> Photometry:
    """Make a luminaire of intensities in angles of photometric type C.

    A scene takes its `Photometry.to_ies` or `Photometry.to_ldt`.

    Parameters
    ----------
    c_deg : array_like of shape (m,) or ()
        Half-planes in degrees, ascending, 0.002 degrees apart or more. Their span tells the
        symmetry, as in files: a single one is rotational, a quarter or half a turn from a multiple
        of 90 degrees is mirrored in its ends, a whole turn has none; its closing plane may be left
        out, and equals the first one.
    gamma_deg : array_like of shape (n,)
        Angles from nadir, ascending from 0 to 180 degrees, as far apart, two or more. Outside of
        them the intensity is 0.
    intensity_cd : array_like of shape (m, n)
        Luminous intensities in candela, 0 or more; of shape (n,) for a single plane. Between angles
        they are bilinear.
    name, manufacturer, catalog_number, lamp : str, optional
        Texts for the keywords LUMINAIRE, MANUFAC, LUMCAT and LAMP.
    keywords : mapping of str to str, optional
        Further keywords of LM-63, such as ``{"TESTLAB": "own"}``.
    lamp_count : float, optional
        Number of lamps.
    lumens_per_lamp : float, optional
        Flux of one lamp in lumens; absolute photometry if not given.
    input_watts : float, optional
        Electrical power in watts.
    luminous_shape : {"box", "cylinder", "cylinder along x", "cylinder along y", "ellipsoid"}
        What shines: with extents of 0 a box is a rectangle, a line or a point, and a cylinder,
        which stands upright, is a disk.
    luminous_size_m : sequence of 3 floats, optional
        Extents along x (C0 to C180), y (C90 to C270) and z, in metres; a point if not given.

    Returns
    -------
    Photometry

    Raises
    ------
    ValueError
        For other shapes of arrays, and, as `InputError`, for angles, intensities and facts that
        make no luminaire.

    Examples
    --------
    A Lambertian disk of 1000 lm:

    >>> import numpy as np
    >>> from quasilux import photometry
    >>> gamma_deg = np.linspace(0, 90, 91)
    >>> disk = photometry.from_intensities(
    ...     0,
    ...     gamma_deg,
    ...     1000 / np.pi * np.cos(np.radians(gamma_deg)),
    ...     luminous_shape="cylinder",
    ...     luminous_size_m=(0.2, 0.2, 0),
    ... )
    >>> disk.luminous_shape
    LuminousShape(name='disk', size_m=(0.2, 0.2, 0.0))
    >>> round(disk.flux_lm, 1)
    1000.0
    """
    c, gamma, intensity = (
        _arrays.real(values, what)
        for values, what in (
            (c_deg, "c_deg"),
            (gamma_deg, "gamma_deg"),
            (intensity_cd, "intensity_cd"),
        )
    )
    if c.ndim > 1 or gamma.ndim != 1:
        shapes = f"{c.shape} and {gamma.shape}"
        raise ValueError(f"c_deg and gamma_deg have the shapes {shapes}; expected (m,) and (n,)")
    expected = (c.size, gamma.size)
    if intensity.shape != expected and not (c.size == 1 and intensity.shape == gamma.shape):
        raise ValueError(f"intensity_cd has the shape {intensity.shape}; expected {expected}")
    size_m = _arrays.real(luminous_size_m, "luminous_size_m")
    if size_m.shape != (3,):
        raise ValueError(f"luminous_size_m has the shape {size_m.shape}; expected (3,)")
    texts = {
        "LUMINAIRE": name,
        "MANUFAC": manufacturer,
        "LUMCAT": catalog_number,
        "LAMP": lamp,
    }
    facts: _native.OwnFacts = {
        "keywords": _keywords({**texts, **(keywords or {})}),
        "lamp_count": float(lamp_count),
        "lumens_per_lamp": None if lumens_per_lamp is None else float(lumens_per_lamp),
        "input_watts": float(input_watts),
        "luminous_shape": luminous_shape,
        "luminous_size_m": size_m.tolist(),
    }
    return _of_arrays(c.reshape(-1), gamma, intensity.reshape(-1), facts)


def _of_arrays(
    c_deg: Floats,
    gamma_deg: Floats,
    intensity_cd: Floats,
    facts: _native.OwnFacts,
) -> Photometry:
    native = _native.photometry_from_intensities(c_deg, gamma_deg, intensity_cd, facts)
    parts = (np.array(c_deg), np.array(gamma_deg), np.array(intensity_cd), facts)
    return Photometry(native, recipe=(_of_arrays, parts))


def _keywords(texts: Mapping[str, str]) -> list[tuple[str, str]]:
    """Return names and texts, without those that are empty.

    Raises
    ------
    ValueError
        For names that cannot stand between brackets.
    """
    for name in texts:
        allowed = name.replace("_", "").replace("-", "")
        if not (allowed.isascii() and allowed.isalnum() and name == name.upper()):
            raise ValueError(f"keywords has the name {name!r}; expected capitals and digits")
    return [(name, str(text)) for name, text in texts.items() if text]
