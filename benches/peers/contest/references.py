"""References: illuminances that two programs agree on, and by how much they may be off.

Both sides are plain path tracers from random points that share no code: Mitsuba's `path` and
quasilux's `path` with `--sequence random`. Standard errors come from the spread of independent
batches. Where both agree, the reference is their mean, weighted by the inverse of their variances.
"""

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from contest.room import Room

FOLDER = Path(__file__).resolve().parents[1] / "references"


@dataclass(frozen=True)
class Side:
    """What one program says, from batches with different seeds."""

    program: str
    how: str
    illuminances_lx: NDArray[np.float64]
    standard_errors_lx: NDArray[np.float64]

    def error(self) -> float:
        """Standard error in the L2 norm, relative."""
        norm = np.linalg.norm(self.illuminances_lx)
        return float(np.linalg.norm(self.standard_errors_lx) / norm)

    def average_error(self) -> float:
        """Standard error of the average over its value; errors of sensors are independent."""
        root = np.linalg.norm(self.standard_errors_lx) / len(self.illuminances_lx)
        return float(root / np.mean(self.illuminances_lx))


@dataclass(frozen=True)
class Agreement:
    """How two sides differ."""

    deviation: float
    standard_error: float
    rms_z: float

    def holds(self) -> bool:
        """Averages within three standard errors, sensors within what small batches scatter."""
        return abs(self.deviation) <= 3 * self.standard_error and self.rms_z <= 1.3


@dataclass(frozen=True)
class Reference:
    """Illuminances with their relative errors."""

    illuminances_lx: NDArray[np.float64]
    error_l2: float
    error_of_average: float
    agreement: Agreement


def side(program: str, how: str, batches: list[NDArray[np.float64]]) -> Side:
    """The mean of the batches and the standard error of that."""
    stack = np.array(batches)
    errors = stack.std(axis=0, ddof=1) / np.sqrt(len(stack))
    return Side(program, how, stack.mean(axis=0), errors)


def agreement(a: Side, b: Side) -> Agreement:
    """How far apart they are, in units of both errors."""
    differences = a.illuminances_lx - b.illuminances_lx
    errors = np.hypot(a.standard_errors_lx, b.standard_errors_lx)
    mean = (np.mean(a.illuminances_lx) + np.mean(b.illuminances_lx)) / 2
    return Agreement(
        deviation=float(np.mean(differences) / mean),
        standard_error=float(np.linalg.norm(errors) / len(errors) / mean),
        rms_z=float(np.sqrt(np.mean((differences / errors) ** 2))),
    )


def joined(a: Side, b: Side) -> Reference:
    """The weighted mean; one weight for all sensors, so that it cannot follow their noise."""
    variance_a, variance_b = a.error() ** 2, b.error() ** 2
    weight = variance_b / (variance_a + variance_b)
    both = Side(
        "both",
        "",
        weight * a.illuminances_lx + (1 - weight) * b.illuminances_lx,
        np.hypot(weight * a.standard_errors_lx, (1 - weight) * b.standard_errors_lx),
    )
    return Reference(both.illuminances_lx, both.error(), both.average_error(), agreement(a, b))


def save(room: Room, sides: list[Side], command: str) -> Reference:
    """Writes the reference of a room, and how it was made."""
    reference = joined(*sides)
    document = {
        "room": room.name,
        "digest": room.digest(),
        "command": command,
        "sides": [
            {"program": part.program, "how": part.how, "error_l2": _short(part.error())}
            for part in sides
        ],
        "agreement": {
            "deviation": _short(reference.agreement.deviation),
            "standard_error": _short(reference.agreement.standard_error),
            "rms_z": _short(reference.agreement.rms_z),
        },
        "error_l2": _short(reference.error_l2),
        "error_of_average": _short(reference.error_of_average),
        "illuminances_lx": [float(f"{value:.7g}") for value in reference.illuminances_lx],
    }
    FOLDER.mkdir(exist_ok=True)
    (FOLDER / f"{room.name}.json").write_text(json.dumps(document, indent=1) + "\n")
    return reference


def load(room: Room) -> Reference:
    """The reference of a room; refused where the room has changed since."""
    path = FOLDER / f"{room.name}.json"
    if not path.exists():
        raise FileNotFoundError(f"{path}: missing; compare.py --references {room.name}")
    document = json.loads(path.read_text())
    if document["digest"] != room.digest():
        raise ValueError(f"{path}: of another room; compare.py --references {room.name}")
    return Reference(
        np.array(document["illuminances_lx"]),
        document["error_l2"],
        document["error_of_average"],
        Agreement(**document["agreement"]),
    )


def _short(value: float) -> float:
    return float(f"{value:.3g}")
