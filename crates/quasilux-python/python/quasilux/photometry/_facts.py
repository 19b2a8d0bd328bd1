"""What a luminaire's file says, what it was warned of, and figures."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from quasilux.photometry._arrays import Floats, frozen

if TYPE_CHECKING:
    from collections.abc import Sequence

    from quasilux import _native

PhotometricType = Literal["A", "B", "C"]
Symmetry = Literal["rotational", "quadrant", "bilateral", "none"]
FormatName = Literal["LM-63", "EULUMDAT", "TM-33"]


@dataclass(frozen=True)
class FileWarning:
    """Something odd in a file, which was tolerated.

    Attributes
    ----------
    file : str
        What messages call the file.
    line, column : int
        Where, counted from 1.
    count : int
        How often.
    kind : str
        The name of the rule, such as ``"FluxDiffers"``.
    message : str
        What was found, what was expected, and how it was read.
    """

    file: str
    line: int
    column: int
    count: int
    kind: str
    message: str

    def __str__(self) -> str:
        return f"{self.file}:{self.line}:{self.column}: {self.message} [{self.kind}]"


@dataclass(frozen=True)
class EncodingNote:
    """What a writer changed, left out or added because a format asks for it.

    Attributes
    ----------
    kind : str
        The name of the rule, such as ``"KeywordsLeftOut"``.
    message : str
        What was done.
    """

    kind: str
    message: str

    def __str__(self) -> str:
        return self.message


class Encoded(bytes):
    """The bytes of a luminaire file that was written, with notes.

    Attributes
    ----------
    notes : tuple of EncodingNote
        What the format could not hold.
    """

    notes: tuple[EncodingNote, ...]

    def __new__(cls, data: bytes, notes: Sequence[EncodingNote] = ()) -> Encoded:
        """Make the bytes of a file with notes."""
        encoded = super().__new__(cls, data)
        encoded.notes = tuple(notes)
        return encoded

    def __repr__(self) -> str:
        return f"<Encoded {len(self)} bytes, {len(self.notes)} notes>"


@dataclass(frozen=True)
class Keyword:
    """A line ``[NAME] value`` of a header.

    Attributes
    ----------
    name : str
        In capitals; empty for a label without a keyword.
    value : str
        The text, with those of its ``[MORE]`` lines behind line feeds.
    line : int
        The line of the file, counted from 1; 0 where there was no file.
    """

    name: str
    value: str
    line: int


@dataclass(frozen=True, eq=False)
class TiltTable:
    """How the output of the lamps depends on the tilt of the luminaire.

    Attributes
    ----------
    lamp_geometry : int
        1, 2 or 3: which tilt is meant (ANSI/IES LM-63-19, annex F).
    angles_deg : ndarray of shape (k,)
        Tilt angles, 0 straight down.
    factors : ndarray of shape (k,)
        Output relative to that of the untilted lamp.
    """

    lamp_geometry: int
    angles_deg: Floats
    factors: Floats


@dataclass(frozen=True)
class TiltFactor:
    """The light of a tilted luminaire.

    Attributes
    ----------
    factor : float
        Light relative to that of the luminaire as it was measured.
    angle_deg : float
        The tilt that the factor belongs to.
    support : {"listed", "end held", "other axis", "not read"}
        What the file says of that tilt: it is listed; it lies beyond the ends, of which the nearer
        one is held; the luminaire is turned about another axis than the file is about; the factors
        are in a file that was not read.
    """

    factor: float
    angle_deg: float
    support: Literal["listed", "end held", "other axis", "not read"]


@dataclass(frozen=True)
class EulumdatFacts:
    """Fields of an EULUMDAT file that other formats have not got.

    Attributes
    ----------
    type_indicator : str
        Ityp (field 2), as written.
    housing_m : tuple of 3 floats
        Length or diameter, width (0: round) and height of the luminaire.
    opening_heights_m : tuple of 4 floats
        Heights of the luminous area at C0, C90, C180 and C270.
    conversion_factor : float
        Factor of the intensities.
    lamps_flux_lm : float
        Flux of all lamps of the first set.
    further_lamp_sets : tuple of tuples of 6 str
        The other sets of lamps, field by field (26a to 26f), as written.
    """

    type_indicator: str
    housing_m: tuple[float, float, float]
    opening_heights_m: tuple[float, float, float, float]
    conversion_factor: float
    lamps_flux_lm: float
    further_lamp_sets: tuple[tuple[str, ...], ...]


@dataclass(frozen=True, eq=False)
class Facts:
    """What a luminaire's header says.

    Attributes
    ----------
    standard : str
        Standard and edition, such as ``"LM-63-2002"``.
    photometric_type : {"A", "B", "C"}
        The web of angles that the intensities are given in.
    keywords : tuple of Keyword
        Keywords and labels in the order of the file; texts of EULUMDAT and TM-33 stand under the
        keywords of LM-63 that mean the same.
    tilt : TiltTable or None
        Factors of tilted lamps.
    tilt_file : str or None
        The file that the factors are in, where it was not read.
    lamp_count : float
        Number of lamps.
    lumens_per_lamp : float or None
        Flux of one lamp in lumens; None for absolute photometry.
    ballast_factor : float
        The ballast factor.
    ballast_lamp_field : float
        The field behind it, as written.
    input_watts : float
        Electrical power in watts, as written.
    candela_factor : float
        Product of all factors that the written candela were multiplied by.
    opening_width_m, opening_length_m, opening_height_m : float
        The luminous opening with the signs of the file, which stand for its shape.
    light_output_ratio : float or None
        Flux of the luminaire over that of its lamps, as an EULUMDAT file claims it.
    measurement_tilt_deg : float
        Tilt of the luminaire while it was measured, as an EULUMDAT file gives it.
    eulumdat : EulumdatFacts or None
        What only EULUMDAT has.
    """

    standard: str
    photometric_type: PhotometricType
    keywords: tuple[Keyword, ...]
    tilt: TiltTable | None
    tilt_file: str | None
    lamp_count: float
    lumens_per_lamp: float | None
    ballast_factor: float
    ballast_lamp_field: float
    input_watts: float
    candela_factor: float
    opening_width_m: float
    opening_length_m: float
    opening_height_m: float
    light_output_ratio: float | None
    measurement_tilt_deg: float
    eulumdat: EulumdatFacts | None


@dataclass(frozen=True)
class LuminousShape:
    """What of a luminaire shines.

    Attributes
    ----------
    name : str
        Such as ``"rectangle"`` or ``"disk"``.
    size_m : tuple of 3 floats
        Extents along x (C0 to C180), y (C90 to C270) and z, in metres.
    """

    name: str
    size_m: tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class Grid:
    """Intensities over the angles of the photometric type.

    Attributes
    ----------
    horizontal_deg : ndarray of shape (m,)
        C of type C, H of types A and B.
    vertical_deg : ndarray of shape (n,)
        Gamma of type C, V of types A and B.
    intensity_cd : ndarray of shape (m, n)
        Luminous intensities in candela.
    """

    horizontal_deg: Floats
    vertical_deg: Floats
    intensity_cd: Floats


@dataclass(frozen=True)
class Spread:
    """An arc of directions in a vertical plane.

    Attributes
    ----------
    angle_deg : float
        From end to end.
    start_deg, end_deg : float
        Gamma, negative on the side of C + 180; above 180 where the arc passes zenith.
    """

    angle_deg: float
    start_deg: float
    end_deg: float


@dataclass(frozen=True, eq=False)
class PlaneCurve:
    """Intensities in a vertical plane, and how wide the luminaire shines in it.

    Attributes
    ----------
    name : str
        Such as ``"C0-C180"``.
    gamma_deg : ndarray of shape (k,)
        From -180 to 180 degrees, both zenith; negative on the side of C + 180. Two points at one
        angle are a jump.
    intensity_cd : ndarray of shape (k,)
        In candela, straight between points: exactly what the table says in types A and C; in type
        B it is sampled each 0.1 degrees.
    maximum_cd, centre_cd : float
        The greatest intensity, and that at gamma = 0.
    beam : Spread or None
        Half-peak divergence: the extent of all directions of half the maximum or more (CIE S 017).
        None in a dark plane.
    centre_beam : Spread or None
        The same for half the intensity at gamma = 0.
    field : Spread or None
        The same for a tenth of the maximum.
    """

    name: str
    gamma_deg: Floats
    intensity_cd: Floats
    maximum_cd: float
    centre_cd: float
    beam: Spread | None
    centre_beam: Spread | None
    field: Spread | None


@dataclass(frozen=True)
class Maximum:
    """The greatest intensity.

    Attributes
    ----------
    intensity_cd : float
        In candela.
    c_deg, gamma_deg : float
        Where; of several places one.
    """

    intensity_cd: float
    c_deg: float
    gamma_deg: float


@dataclass(frozen=True)
class FluxCode:
    """The CIE flux code (CIE 52, EN 13032-2).

    Attributes
    ----------
    percent : tuple of 5 floats
        N1 to N5 in per cent.
    upper : tuple of 3 floats
        The counterparts of N1 to N3 for light upwards, as shares from 0 to 1.
    upward : float
        The share of the flux above the horizon.
    """

    percent: tuple[float, float, float, float, float]
    upper: tuple[float, float, float]
    upward: float


@dataclass(frozen=True, eq=False)
class Analysis:
    """The figures of a luminaire.

    Attributes
    ----------
    flux_lm : float
        Luminous flux in lumens, integrated exactly from the table.
    downward_flux_lm : float
        The part of it below the horizon.
    rated_flux_lm : float or None
        Lamp lumens times number of lamps; None for absolute photometry.
    light_output_ratio : float or None
        Integrated flux over that of the lamps, both on the same ballast.
    efficacy_lm_w : float or None
        Integrated flux over the electrical power; None where that is not given.
    maximum : Maximum or None
        The greatest intensity; None where there is no light.
    flux_code : FluxCode
        The CIE flux code.
    zones_lm : ndarray of shape (18,)
        Flux in zones of 10 degrees of gamma, from nadir to zenith.
    measured_planes : int
        How many half-planes the file gives.
    principal_planes : tuple of 2 PlaneCurve
        C0-C180 and C90-C270.
    """

    flux_lm: float
    downward_flux_lm: float
    rated_flux_lm: float | None
    light_output_ratio: float | None
    efficacy_lm_w: float | None
    maximum: Maximum | None
    flux_code: FluxCode
    zones_lm: Floats
    measured_planes: int
    principal_planes: tuple[PlaneCurve, PlaneCurve]


def facts(entry: _native.FactsEntry) -> Facts:
    """Make facts of what the native half returns."""
    tilt, eulumdat = entry["tilt"], entry["eulumdat"]
    return Facts(
        standard=entry["standard"],
        photometric_type=entry["photometric_type"],
        keywords=tuple(Keyword(**keyword) for keyword in entry["keywords"]),
        tilt=None if tilt is None else _tilt(tilt),
        tilt_file=entry["tilt_file"],
        lamp_count=entry["lamp_count"],
        lumens_per_lamp=entry["lumens_per_lamp"],
        ballast_factor=entry["ballast_factor"],
        ballast_lamp_field=entry["ballast_lamp_field"],
        input_watts=entry["input_watts"],
        candela_factor=entry["candela_factor"],
        opening_width_m=entry["opening_width_m"],
        opening_length_m=entry["opening_length_m"],
        opening_height_m=entry["opening_height_m"],
        light_output_ratio=entry["light_output_ratio"],
        measurement_tilt_deg=entry["measurement_tilt_deg"],
        eulumdat=None if eulumdat is None else _eulumdat(eulumdat),
    )


def _tilt(entry: _native.TiltEntry) -> TiltTable:
    angles_deg, factors = (frozen(np.array(entry[key])) for key in ("angles_deg", "factors"))
    return TiltTable(entry["lamp_geometry"], angles_deg, factors)


def _eulumdat(entry: _native.EulumdatEntry) -> EulumdatFacts:
    length, width, height = entry["housing_m"]
    c0, c90, c180, c270 = entry["opening_heights_m"]
    return EulumdatFacts(
        type_indicator=entry["type_indicator"],
        housing_m=(length, width, height),
        opening_heights_m=(c0, c90, c180, c270),
        conversion_factor=entry["conversion_factor"],
        lamps_flux_lm=entry["lamps_flux_lm"],
        further_lamp_sets=tuple(tuple(fields) for fields in entry["further_lamp_sets"]),
    )


def shape(entry: _native.ShapeEntry) -> LuminousShape:
    """Make a shape of what the native half returns."""
    x, y, z = entry["size_m"]
    return LuminousShape(entry["name"], (x, y, z))


def grid(entry: _native.GridEntry) -> Grid:
    """Make a grid of what the native half returns."""
    horizontal_deg, vertical_deg = entry["horizontal_deg"], entry["vertical_deg"]
    shaped = entry["intensity_cd"].reshape(horizontal_deg.size, vertical_deg.size)
    return Grid(frozen(horizontal_deg), frozen(vertical_deg), frozen(shaped))


def plane(name: str, entry: _native.PlaneEntry) -> PlaneCurve:
    """Make the curve of a plane of what the native half returns."""
    beam, centre_beam, field = (
        None if spread is None else Spread(**spread)
        for spread in (entry["beam"], entry["centre_beam"], entry["field"])
    )
    return PlaneCurve(
        name=name,
        gamma_deg=frozen(entry["gamma_deg"]),
        intensity_cd=frozen(entry["intensity_cd"]),
        maximum_cd=entry["maximum_cd"],
        centre_cd=entry["centre_cd"],
        beam=beam,
        centre_beam=centre_beam,
        field=field,
    )


def analysis(entry: _native.AnalysisEntry, planes: tuple[PlaneCurve, PlaneCurve]) -> Analysis:
    """Make figures of what the native half returns."""
    maximum, code = entry["maximum"], entry["flux_code"]
    n1, n2, n3, n4, n5 = code["percent"]
    u1, u2, u3 = code["upper"]
    return Analysis(
        flux_lm=entry["flux_lm"],
        downward_flux_lm=entry["downward_flux_lm"],
        rated_flux_lm=entry["rated_flux_lm"],
        light_output_ratio=entry["light_output_ratio"],
        efficacy_lm_w=entry["efficacy_lm_w"],
        maximum=None if maximum is None else Maximum(**maximum),
        flux_code=FluxCode((n1, n2, n3, n4, n5), (u1, u2, u3), code["upward"]),
        zones_lm=frozen(np.array(entry["zones_lm"])),
        measured_planes=entry["measured_planes"],
        principal_planes=planes,
    )
