"""What a sweep found, as plain numbers that a file keeps."""

import json
import math
from dataclasses import asdict, dataclass
from pathlib import Path

from contest.bound import Bound
from contest.curves import Found, Point, Reached, time_to
from contest.errors import Deviation
from contest.references import Reference
from contest.room import Room
from contest.sweep import Series

AGREES_FROM = 0.001


@dataclass(frozen=True)
class Line:
    """A program in a room: its curve, and whether it computes the same room."""

    program: str
    cannot: str | None
    points: list[Point]
    deviation: Deviation | None
    warm_up_seconds: float | None

    def agrees(self) -> bool:
        """Its average is right within three standard errors, or within a thousandth."""
        if self.deviation is None:
            return False
        return self.deviation.within(3) or abs(self.deviation.share) < AGREES_FROM

    def time_to(self, wanted: float) -> Reached:
        """When the error is reached; the curve of a biased program is not drawn out."""
        if self.cannot is not None:
            return Reached(math.inf, Found.NEVER)
        return time_to(wanted, self.points, extrapolate=self.agrees())


@dataclass(frozen=True)
class RoomResult:
    """A room with the lines of all programs."""

    name: str
    title: str
    triangles: int
    lights: int
    sensors: int
    goals: list[float]
    reference_error: float
    reference_deviation: Deviation
    reference_rms_z: float
    lines: list[Line]
    bound: Bound | None = None


@dataclass(frozen=True)
class Machine:
    """Where and with what it was measured."""

    processor: str
    cores: int
    load_before: float
    date: str
    rounds: int
    cap_seconds: float
    versions: dict[str, str]


@dataclass(frozen=True)
class Results:
    """A sweep."""

    machine: Machine
    rooms: list[RoomResult]


def room_result(
    room: Room,
    goals: list[float],
    reference: Reference,
    series: list[Series],
    bound: Bound | None,
) -> RoomResult:
    """The numbers of one room."""
    sides = reference.agreement
    return RoomResult(
        name=room.name,
        title=room.title,
        triangles=room.triangle_count(),
        lights=room.light_count(),
        sensors=len(room.sensors),
        goals=goals,
        reference_error=reference.error_l2,
        reference_deviation=Deviation(sides.deviation, sides.standard_error),
        reference_rms_z=sides.rms_z,
        lines=[_line(row, reference) for row in series],
        bound=bound,
    )


def save(results: Results, path: Path) -> None:
    """Writes all numbers, to four digits."""
    text = json.dumps(rounded(asdict(results)), indent=1)
    path.write_text(text + "\n")


def load(path: Path) -> Results:
    """Reads what `save` wrote."""
    document = json.loads(path.read_text())
    return Results(
        Machine(**document["machine"]), [_read_room(room) for room in document["rooms"]]
    )


def _line(row: Series, reference: Reference) -> Line:
    if row.cannot is not None:
        return Line(row.program, row.cannot, [], None, None)
    points, share = row.points(reference), row.deviation(reference)
    return Line(row.program, None, points, share, row.warm_up_seconds)


def _read_room(document: dict) -> RoomResult:
    lines = [
        Line(
            line["program"],
            line["cannot"],
            [Point(**point) for point in line["points"]],
            Deviation(**line["deviation"]) if line["deviation"] else None,
            line["warm_up_seconds"],
        )
        for line in document.pop("lines")
    ]
    sides = Deviation(**document.pop("reference_deviation"))
    own = document.pop("bound", None)
    bound = Bound(**own) if own else None
    return RoomResult(**document, reference_deviation=sides, lines=lines, bound=bound)


def rounded(value: object) -> object:
    """The same with all numbers to four digits."""
    match value:
        case float():
            return float(f"{value:.4g}")
        case dict():
            return {key: rounded(item) for key, item in value.items()}
        case list():
            return [rounded(item) for item in value]
    return value
