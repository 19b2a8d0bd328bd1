"""The IES files of these rooms: our own ones, plain tables of candelas.

Only what they use is read: type C, TILT=NONE, planes from 0 to 0, 90 or 360 degrees. Programs that
read IES read the file itself.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True)
class Table:
    """Intensities in cd at [C, gamma], linear in both between measured angles, in degrees."""

    gammas_deg: NDArray[np.float64]
    planes_deg: NDArray[np.float64]
    intensities_cd: NDArray[np.float64]

    def fold(self, c_deg: NDArray[np.float64]) -> NDArray[np.float64]:
        """The measured plane that shows what is seen at C."""
        c = np.mod(c_deg, 360.0)
        if len(self.planes_deg) == 1:
            return np.zeros_like(c)
        if self.planes_deg[-1] == 90.0:
            c = np.where(c > 180.0, 360.0 - c, c)
            return np.where(c > 90.0, 180.0 - c, c)
        return c

    def regular(self, step_deg: float) -> NDArray[np.float64]:
        """Intensities at [C, gamma] in steps that all measured angles are multiples of.

        C from 0 to 360 and gamma from 0 to 180 degrees, both ends included: linear interpolation
        between these is that of the file.
        """
        gammas = np.arange(0.0, 180.0 + step_deg / 2, step_deg)
        planes = self.fold(np.arange(0.0, 360.0 + step_deg / 2, step_deg))
        rows = np.array(
            [np.interp(gammas, self.gammas_deg, row, right=0.0) for row in self.intensities_cd]
        )
        if len(rows) == 1:
            return np.tile(rows, (len(planes), 1))
        columns = [np.interp(planes, self.planes_deg, column) for column in rows.T]
        return np.array(columns).T

    def flux_lm(self) -> float:
        """The flux of the table, in steps of half a degree."""
        cells = self.regular(0.5)
        around = np.mean((cells[1:] + cells[:-1]) / 2, axis=0)
        gammas = np.radians(np.arange(len(around)) * 0.5)
        rings = 2 * np.pi * (np.cos(gammas[:-1]) - np.cos(gammas[1:]))
        return float(np.sum(rings * (around[1:] + around[:-1]) / 2))


def read(path: Path) -> Table:
    """The table of an IES file."""
    text = path.read_text()
    if "TILT=NONE" not in text:
        raise ValueError(f"{path}: has tilt factors; expected TILT=NONE")
    numbers = [float(word) for word in text.split("TILT=NONE")[1].split()]
    factor, gamma_count, plane_count, kind = numbers[2], *map(int, numbers[3:6])
    if kind != 1:
        raise ValueError(f"{path}: photometric type {kind}; expected 1, type C")
    factor *= numbers[10]
    start = 13
    gammas = np.array(numbers[start : start + gamma_count])
    start += gamma_count
    planes = np.array(numbers[start : start + plane_count])
    start += plane_count
    cells = np.array(numbers[start : start + gamma_count * plane_count])
    if planes[-1] not in (0.0, 90.0, 360.0):
        raise ValueError(f"{path}: last plane at {planes[-1]}; expected 0, 90 or 360 degrees")
    return Table(gammas, planes, factor * cells.reshape(plane_count, gamma_count))


def spot(path: Path, peak_cd: float, half_beam_deg: float) -> None:
    """Writes a file of a rotationally symmetric spot: half of the peak at `half_beam_deg`."""
    gammas = np.arange(0.0, 91.0, 1.0)
    shape = np.exp(-np.log(2.0) * (gammas / half_beam_deg) ** 2)
    cells = np.where(gammas <= 3 * half_beam_deg, peak_cd * shape, 0.0)
    middle = np.radians(np.arange(0.5, 90.0, 1.0))
    means = (cells[1:] + cells[:-1]) / 2
    lumens = float(np.sum(2 * np.pi * np.sin(middle) * means) * np.radians(1.0))
    lines = [
        "IESNA:LM-63-2002",
        "[TEST] computed from a formula, not measured",
        "[MANUFAC] quasilux benches",
        "[LUMINAIRE] Spot",
        "TILT=NONE",
        f"1 {lumens:.1f} 1 {len(gammas)} 1 1 2 -0.05 0 0",
        "1 1 10",
        " ".join(f"{gamma:g}" for gamma in gammas),
        "0",
        " ".join(f"{cell:.2f}" for cell in cells),
    ]
    path.write_text("\n".join(_wrapped(lines)) + "\n")


def _wrapped(lines: list[str]) -> list[str]:
    wrapped: list[str] = []
    for line in lines:
        words = line.split(" ")
        if len(words) <= 12:
            wrapped.append(line)
        else:
            wrapped += [" ".join(words[i : i + 10]) for i in range(0, len(words), 10)]
    return wrapped
