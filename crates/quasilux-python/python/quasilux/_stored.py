"""A run that another process finished."""

from __future__ import annotations

import dataclasses
import json
import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

from quasilux._whole_file import write_whole

if TYPE_CHECKING:
    from quasilux import _native


@dataclasses.dataclass(frozen=True)
class Stored:
    """A run that another process finished: the same answers, without the scene."""

    text: str
    settings_text: str
    table_text: str
    grids_text: str
    stopped: str | None
    sensors: list[dict[str, Any]]
    point_statuses: list[list[str] | None]
    cameras: list[dict[str, Any] | None]
    files: dict[str, bytes]

    @classmethod
    def of(cls, outcome: _native.Outcome | Stored) -> Stored:
        """Return what a run knows."""
        if isinstance(outcome, Stored):
            return outcome
        text = outcome.document()
        document = json.loads(text)
        return cls(
            text=text,
            settings_text=outcome.settings(),
            table_text=outcome.table(),
            grids_text=outcome.grids(),
            stopped=outcome.stopped,
            sensors=[outcome.sensor_arrays(i) for i in range(len(document["sensors"]))],
            point_statuses=[outcome.statuses(i) for i in range(len(document["sensors"]))],
            cameras=[outcome.camera_arrays(i) for i in range(len(document["cameras"]))],
            files={name: outcome.file(name) or b"" for name in outcome.file_names()},
        )

    def document(self) -> str:
        """Return the result document."""
        return self.text

    def settings(self) -> str:
        """Return all settings as JSON."""
        return self.settings_text

    def table(self) -> str:
        """Return the table of the terminal."""
        return self.table_text

    def grids(self) -> str:
        """Return the grid of each sensor as JSON."""
        return self.grids_text

    def sensor_arrays(self, index: int) -> dict[str, Any]:
        """Return the arrays of a sensor."""
        return {name: read_only(array) for name, array in self.sensors[index].items()}

    def statuses(self, index: int) -> list[str] | None:
        """Return what each point of a sensor waits for."""
        return self.point_statuses[index]

    def camera_arrays(self, index: int) -> dict[str, Any] | None:
        """Return the arrays of a camera."""
        arrays = self.cameras[index]
        return arrays and {name: read_only(array) for name, array in arrays.items()}

    def file(self, name: str) -> bytes | None:
        """Return a file of the results."""
        return self.files.get(name)

    def write(self, folder: str) -> None:
        """Write all files."""
        os.makedirs(folder, exist_ok=True)
        for name, content in self.files.items():
            write_whole(Path(folder, name), content)


def read_only(array: Any) -> Any:
    """Return an array that cannot be written to: pickle makes others."""
    array.flags.writeable = False
    return array
