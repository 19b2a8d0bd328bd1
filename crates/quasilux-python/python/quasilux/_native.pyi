"""The native half of the package: conversions, and nothing that users call."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any, Literal, TypedDict, final, type_check_only

import numpy as np
from numpy.typing import NDArray

from quasilux._options import ResumeOptions, RunOptions, YearOptions

__version__: str

__all__ = [
    "BlockTracer",
    "Drawing",
    "InputError",
    "Luminaire",
    "MAX_BSDF_BYTES",
    "MAX_PHOTOMETRY_BYTES",
    "MAX_TILT_BYTES",
    "MAX_WEATHER_BYTES",
    "Outcome",
    "PointSet",
    "Progress",
    "SOBOL_DIMENSIONS",
    "Scene",
    "Sky",
    "StateError",
    "Surface",
    "YearProgress",
    "__version__",
    "annual",
    "bsdf_directions",
    "check_site",
    "command_line",
    "discrepancy",
    "exchange_change",
    "exchange_coordinates",
    "false_colour_map",
    "false_colour_scale",
    "figure_text",
    "identify_run",
    "luminance_scale",
    "photometry_ending",
    "photometry_from_intensities",
    "read_bsdf",
    "read_photometry",
    "resume",
    "simulate",
    "solar_day",
    "sun_positions",
    "to_normal",
]

class InputError(ValueError):
    """A file or a value that cannot be used.

    Attributes: `file` (str or None), `line` and `column` (int, counted from 1, or None) and
    `message` (str), which says what was found and what was expected.
    """

    file: str | None
    line: int | None
    column: int | None
    message: str

def command_line(words: Sequence[str | os.PathLike[str]]) -> int: ...

# scene

@type_check_only
class GeometryEntry(TypedDict):
    name: str
    vertices: NDArray[np.float64]
    triangles: NDArray[np.uint32]
    material_of: NDArray[np.uint32]
    materials: list[str]
    object: str

@type_check_only
class PartsEntry(TypedDict):
    name: str
    text: str
    folder: str | None
    files: dict[str, bytes]
    geometry: list[GeometryEntry]

@type_check_only
class CheckEntry(TypedDict):
    document: str
    text: str

@final
class Scene:
    @staticmethod
    def open(path: str | os.PathLike[str]) -> Scene: ...
    @staticmethod
    def from_parts(parts: PartsEntry) -> Scene: ...
    @staticmethod
    def from_bundle(bundle: bytes) -> Scene: ...
    def to_bundle(self) -> bytes: ...
    @property
    def name(self) -> str: ...
    @property
    def sha256(self) -> str: ...
    @property
    def text(self) -> str: ...
    @property
    def warnings(self) -> list[str]: ...
    def contents(self) -> str: ...
    def vertices(self) -> NDArray[np.float64]: ...
    def triangles(self) -> NDArray[np.uint32]: ...
    def material_of(self) -> NDArray[np.uint32]: ...
    def positions(self, sensor: int) -> NDArray[np.float64]: ...
    def normals(self, sensor: int) -> NDArray[np.float64]: ...
    def check(self) -> CheckEntry: ...
    def plan_png(self, px_per_unit: float) -> bytes: ...
    def plan_svg(self) -> str: ...

def photometry_ending(content: bytes) -> Literal["gldf", "ies", "ldt", "xml"]: ...

# simulation

@final
class Progress:
    """How far a run is.

    Attributes
    ----------
    photons, paths, rays : int
        What was traced so far.
    samples : int
        Indices of each replicate at the last checkpoint; 0 before the first.
    seconds : float
        What the run took so far, in s.
    largest_relative_half_width : float or None
        Largest half-width over value among all sensor points at the last checkpoint.
    slope : float or None
        Exponent of the number of samples in half-widths, about -0.5 for random points.
    expected_samples, expected_rays : int or None
        Those of the whole run up to the tolerance.
    done : float or None
        Share of the expected work that is done, in [0, 1]; of a picture while it is taken.
    camera : str or None
        The camera whose picture is taken, once sensors are done.
    is_checkpoint : bool
        Whether this is a checkpoint: if so, the run waits for the answer, and can end with the
        values of now.
    illuminance_lx, half_width_lx, unseen_lx : dict of str to ndarray
        At a checkpoint, values, half-widths and bounds on unseen light of each sensor in lx, as in
        its result; else empty.
    """

    @property
    def photons(self) -> int: ...
    @property
    def paths(self) -> int: ...
    @property
    def rays(self) -> int: ...
    @property
    def samples(self) -> int: ...
    @property
    def seconds(self) -> float: ...
    @property
    def largest_relative_half_width(self) -> float | None: ...
    @property
    def slope(self) -> float | None: ...
    @property
    def expected_samples(self) -> int | None: ...
    @property
    def expected_rays(self) -> int | None: ...
    @property
    def done(self) -> float | None: ...
    @property
    def camera(self) -> str | None: ...
    @property
    def is_checkpoint(self) -> bool: ...
    @property
    def illuminance_lx(self) -> dict[str, NDArray[np.float64]]: ...
    @property
    def half_width_lx(self) -> dict[str, NDArray[np.float64]]: ...
    @property
    def unseen_lx(self) -> dict[str, NDArray[np.float64]]: ...

@final
class Outcome:
    def document(self) -> str: ...
    def settings(self) -> str: ...
    def grids(self) -> str: ...
    def table(self) -> str: ...
    @property
    def stopped(self) -> str | None: ...
    @property
    def remarks(self) -> list[str]: ...
    def sensor_arrays(self, index: int) -> dict[str, Any]: ...
    def statuses(self, index: int) -> list[str] | None: ...
    def camera_arrays(self, index: int) -> dict[str, Any] | None: ...
    def write(self, folder: str | os.PathLike[str]) -> None: ...
    def file_names(self) -> list[str]: ...
    def file(self, name: str) -> bytes | None: ...

def simulate(
    scene: Scene,
    options: RunOptions,
    callback: Callable[[Progress], object] | None = None,
    workers: object | None = None,
) -> Outcome: ...
def resume(
    checkpoint: str | os.PathLike[str],
    options: ResumeOptions,
    scene: Scene | None = None,
    callback: Callable[[Progress], object] | None = None,
) -> Outcome: ...

# years

@final
class YearProgress:
    """How far a year is.

    Attributes
    ----------
    done : float
        Share of the work that seems to be done, in [0, 1].
    seconds : float
        What the year took so far, in s.
    """

    @property
    def done(self) -> float: ...
    @property
    def seconds(self) -> float: ...

@type_check_only
class BlindsEntry(TypedDict):
    name: str
    positions: list[str]
    position: NDArray[np.int64]

@type_check_only
class YearEntry(TypedDict):
    table: str
    files: dict[str, bytes]
    intervals: dict[str, Any]
    blinds: list[BlindsEntry]

def annual(
    scene: Scene,
    options: YearOptions,
    callback: Callable[[YearProgress], object] | None = None,
) -> YearEntry: ...

# sky

MAX_WEATHER_BYTES: int

@final
class Sky:
    @staticmethod
    def of_scene(scene: Scene) -> Sky: ...
    @staticmethod
    def of_weather(file: str, data: bytes, time: str) -> Sky: ...
    @staticmethod
    def cie(number: int, sun: Sequence[float] | None, lx: float) -> Sky: ...
    def document(self) -> str: ...
    def text(self) -> str: ...
    def drawing(self) -> Drawing: ...
    def luminance_cd_m2(self, directions_deg: NDArray[np.float64]) -> NDArray[np.float64]: ...

@type_check_only
class DayEntry(TypedDict):
    up_h: list[list[float]]
    highest_h: float
    highest_deg: list[float]

def check_site(place: Sequence[float]) -> None: ...
def sun_positions(
    place: Sequence[float], times: NDArray[np.float64]
) -> NDArray[np.float64]: ...
def solar_day(place: Sequence[float], year: int, month: int, day: int) -> DayEntry: ...

# figures

def figure_text(value: float | None, half_width: float | None) -> str: ...

# drawing

@type_check_only
class ScaleEntry(TypedDict):
    low: float
    high: float
    is_logarithmic: bool
    levels: list[float]
    labels: list[str]

def false_colour_map(count: int) -> NDArray[np.float64]: ...
def false_colour_scale(
    values: NDArray[np.float64], half_widths: NDArray[np.float64]
) -> ScaleEntry: ...
def luminance_scale(luminances_cd_m2: NDArray[np.float32]) -> ScaleEntry: ...

# points

SOBOL_DIMENSIONS: int

@final
class PointSet:
    def __new__(
        cls, sequence: str, randomization: str, key: int, dimensions: int
    ) -> PointSet: ...
    def __getnewargs__(self) -> tuple[str, str, int, int]: ...
    def fill(self, points: NDArray[np.float64], first_index: int, workers: int) -> None: ...

def discrepancy(
    sample: NDArray[np.float64], method: str, iterative: bool, workers: int
) -> float: ...
def exchange_change(
    sample: NDArray[np.float64], first: int, second: int, dimension: int
) -> float: ...
def exchange_coordinates(
    sample: NDArray[np.float64], exchanges: NDArray[np.uint64], patience: int
) -> None: ...
def to_normal(numbers: NDArray[np.float64]) -> None: ...

# photometry

from typing import type_check_only

_Floats = NDArray[np.float64]

MAX_PHOTOMETRY_BYTES: int
MAX_TILT_BYTES: int

@type_check_only
class WarningEntry(TypedDict):
    file: str
    line: int
    column: int
    count: int
    kind: str
    message: str

@type_check_only
class NoteEntry(TypedDict):
    kind: str
    message: str

@type_check_only
class EncodedEntry(TypedDict):
    data: bytes
    notes: list[NoteEntry]

@type_check_only
class KeywordEntry(TypedDict):
    name: str
    value: str
    line: int

@type_check_only
class TiltEntry(TypedDict):
    lamp_geometry: int
    angles_deg: list[float]
    factors: list[float]

@type_check_only
class TiltFactorEntry(TypedDict):
    factor: float
    angle_deg: float
    support: Literal["listed", "end held", "other axis", "not read"]

@type_check_only
class EulumdatEntry(TypedDict):
    type_indicator: str
    housing_m: list[float]
    opening_heights_m: list[float]
    conversion_factor: float
    lamps_flux_lm: float
    further_lamp_sets: list[list[str]]

@type_check_only
class FactsEntry(TypedDict):
    standard: str
    photometric_type: Literal["A", "B", "C"]
    keywords: list[KeywordEntry]
    tilt: TiltEntry | None
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
    eulumdat: EulumdatEntry | None

@type_check_only
class ShapeEntry(TypedDict):
    name: str
    size_m: list[float]

@type_check_only
class MaximumEntry(TypedDict):
    intensity_cd: float
    c_deg: float
    gamma_deg: float

@type_check_only
class FluxCodeEntry(TypedDict):
    percent: list[float]
    upper: list[float]
    upward: float

@type_check_only
class AnalysisEntry(TypedDict):
    flux_lm: float
    downward_flux_lm: float
    rated_flux_lm: float | None
    light_output_ratio: float | None
    efficacy_lm_w: float | None
    maximum: MaximumEntry | None
    flux_code: FluxCodeEntry
    zones_lm: list[float]
    measured_planes: int

@type_check_only
class SpreadEntry(TypedDict):
    angle_deg: float
    start_deg: float
    end_deg: float

@type_check_only
class PlaneEntry(TypedDict):
    gamma_deg: _Floats
    intensity_cd: _Floats
    maximum_cd: float
    centre_cd: float
    beam: SpreadEntry | None
    centre_beam: SpreadEntry | None
    field: SpreadEntry | None

@type_check_only
class GridEntry(TypedDict):
    horizontal_deg: _Floats
    vertical_deg: _Floats
    intensity_cd: _Floats

@type_check_only
class OwnFacts(TypedDict):
    keywords: list[tuple[str, str]]
    lamp_count: float
    lumens_per_lamp: float | None
    input_watts: float
    luminous_shape: str
    luminous_size_m: list[float]

@final
class Drawing:
    def to_svg(self) -> str: ...
    def to_png(self, px_per_unit: float) -> bytes: ...

@final
class Luminaire:
    @property
    def format(self) -> Literal["LM-63", "EULUMDAT", "TM-33"] | None: ...
    @property
    def misnamed(self) -> Literal["LM-63", "EULUMDAT", "TM-33"] | None: ...
    @property
    def photometric_type(self) -> Literal["A", "B", "C"]: ...
    @property
    def symmetry(self) -> Literal["rotational", "quadrant", "bilateral", "none"]: ...
    @property
    def flux_lm(self) -> float: ...
    @property
    def maximum_cd(self) -> float: ...
    @property
    def tilt_file(self) -> str | None: ...
    def warnings(self) -> list[WarningEntry]: ...
    def facts(self) -> FactsEntry: ...
    def analysis(self) -> AnalysisEntry: ...
    def shape(self) -> ShapeEntry: ...
    def plane(self, c_deg: float) -> PlaneEntry: ...
    def grid(self, unfolded: bool) -> GridEntry: ...
    def with_tilt(self, data: bytes, file: str) -> Luminaire: ...
    def tilt_factor(self, down: tuple[float, float, float]) -> TiltFactorEntry: ...
    def intensity_cd(self, directions: _Floats) -> _Floats: ...
    def intensity_at_cd(self, c_deg: _Floats, gamma_deg: _Floats) -> _Floats: ...
    def pdf_sr(self, directions: _Floats) -> _Floats: ...
    def sample(self, u: _Floats) -> _Floats: ...
    def invert(self, directions: _Floats) -> _Floats: ...
    def flux_below_lm(self, gamma_deg: _Floats) -> _Floats: ...
    def projected_area_m2(self, directions: _Floats) -> _Floats: ...
    def to_ies(self, edition: str | None) -> EncodedEntry: ...
    def to_ldt(self) -> EncodedEntry: ...
    def diagram(
        self, kind: str, planes_deg: list[float], in_candela: bool, title: str
    ) -> Drawing: ...

def read_photometry(data: bytes, file: str, format: str | None) -> Luminaire: ...
def photometry_from_intensities(
    c_deg: _Floats, gamma_deg: _Floats, intensity_cd: _Floats, facts: OwnFacts
) -> Luminaire: ...

# bsdf

_Which = tuple[Literal["front", "back"], Literal["reflection", "transmission"]]

MAX_BSDF_BYTES: int

@type_check_only
class BsdfFactsEntry(TypedDict):
    format: str
    name: str
    manufacturer: str
    thickness_m: float | None

@type_check_only
class BasisEntry(TypedDict):
    name: str
    lower_deg: list[float]
    upper_deg: list[float]
    patches: list[int]
    projected_solid_angle_sr: _Floats

@type_check_only
class MatrixEntry(TypedDict):
    values: _Floats
    incident: BasisEntry
    exit: BasisEntry

@type_check_only
class TableEntry(TypedDict):
    side: Literal["front", "back"]
    mode: Literal["reflection", "transmission"]
    kind: Literal["Klems", "tensor tree", "gridded"]
    is_isotropic: bool
    is_coloured: bool
    incidences: _Floats
    leaves: int | None
    resolution: int | None
    matrix: MatrixEntry | None

@type_check_only
class EnergyEntry(TypedDict):
    side: Literal["front", "back"]
    normal_reflectance: float
    normal_transmittance: float
    diffuse_reflectance: float
    diffuse_transmittance: float
    most_scattered: float
    most_scattered_wi: list[float]

@type_check_only
class ReciprocityEntry(TypedDict):
    side: Literal["front", "back"]
    mode: Literal["reflection", "transmission"]
    mean_defect: float
    worst_defect: float
    worst_pair: list[list[float]]

@final
class Surface:
    def facts(self) -> BsdfFactsEntry: ...
    def warnings(self) -> list[WarningEntry]: ...
    def tables(self) -> list[TableEntry]: ...
    def energy(self) -> list[EnergyEntry]: ...
    def reciprocity(self) -> list[ReciprocityEntry]: ...
    def albedo(self, which: _Which, wi: _Floats) -> _Floats: ...
    def albedo_rgb(self, which: _Which, wi: _Floats) -> _Floats: ...
    def evaluate(self, which: _Which, wi: _Floats, wo: _Floats) -> _Floats: ...
    def evaluate_rgb(self, which: _Which, wi: _Floats, wo: _Floats) -> _Floats: ...
    def pdf_sr(self, which: _Which, wi: _Floats, wo: _Floats) -> _Floats: ...
    def sample(self, which: _Which, wi: _Floats, u: _Floats) -> _Floats: ...
    def invert(self, which: _Which, wi: _Floats, wo: _Floats) -> _Floats: ...
    def diagram(
        self, title: str, incidences_deg: list[tuple[float, float]]
    ) -> Drawing: ...
    def lobe(
        self, side: Literal["front", "back"], incidence_deg: tuple[float, float]
    ) -> _Floats: ...

def read_bsdf(data: bytes, file: str) -> Surface: ...
def bsdf_directions(theta_deg: _Floats, phi_deg: _Floats) -> _Floats: ...

# blocks

class StateError(ValueError):
    """A block of another run, or one that a tracer has gone past."""

@final
class BlockTracer:
    def __new__(cls, bundle: bytes, options: RunOptions, run: str) -> BlockTracer: ...
    def trace(self, frame: bytes, start: int, end: int) -> bytes: ...

def identify_run(scene: Scene, options: RunOptions) -> str: ...
