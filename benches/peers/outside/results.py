"""What was found, as plain numbers that a file keeps."""

import json
from dataclasses import asdict, dataclass
from pathlib import Path

from contest.results import rounded
from outside.moments import Compared, Distance
from outside.years import Errors, Key, Level


@dataclass(frozen=True)
class Machine:
    """Where and with what it was measured."""

    processor: str
    cores: int
    load_before: float
    date: str
    quasilux: str
    radiance: str


@dataclass(frozen=True)
class YearResult:
    """The settings of both programs under the weather of a place, and what noise was left."""

    place: str
    rounds: int
    lit_hours: int
    sunless_hours: int
    quasilux_noise: float
    rcontrib_noise: float
    rcontrib_sunless_noise: float
    between: Errors
    levels: list[Level]


@dataclass(frozen=True)
class Results:
    """Moments, and a year where there was a weather file."""

    machine: Machine
    """Of the moments."""
    moments: list[Compared]
    year: YearResult | None
    year_machine: Machine | None


def save(results: Results, path: Path) -> None:
    """Writes all numbers, to four digits."""
    path.parent.mkdir(exist_ok=True)
    path.write_text(json.dumps(rounded(asdict(results)), indent=1) + "\n")


def load(path: Path) -> Results:
    """Reads what `save` wrote."""
    document = json.loads(path.read_text())
    year = document["year"] and _year(document["year"])
    moments = [_compared(it) for it in document["moments"]]
    year_machine = document["year_machine"] and Machine(**document["year_machine"])
    return Results(Machine(**document["machine"]), moments, year, year_machine)


def _compared(document: dict) -> Compared:
    names = ("radiance_from_quasilux", "quasilux_from_sums", "radiance_from_sums")
    distances = {name: document[name] and Distance(**document[name]) for name in names}
    return Compared(**document | distances)


def _year(document: dict) -> YearResult:
    levels = [
        Level(**it | {"key": Key(**it["key"]), "errors": Errors(**it["errors"])})
        for it in document["levels"]
    ]
    return YearResult(**document | {"levels": levels, "between": Errors(**document["between"])})
