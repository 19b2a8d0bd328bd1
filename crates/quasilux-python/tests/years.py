"""A terrace under a sheet, and two days of weather, for the tests of years and skies."""

from __future__ import annotations

from typing import Any

import numpy as np

import quasilux

# Nothing shines but in these hours: illuminances across the rays of the sun, and of the sky.
LIT = {(20, 11): (0, 9000), (20, 12): (60_000, 12_000), (21, 12): (0, 250)}
LIT_HOURS = [11, 12, 36]
HEADER = """place Here
latitude 37.72
longitude 122.22
time_zone 120
site_elevation 2
weather_data_file_units 3
"""


def weather() -> bytes:
    """A WEA file of two days."""
    rows = [
        "3 {} {}.5 {} {}".format(day, hour, *LIT.get((day, hour), (0, 0)))
        for day in (20, 21)
        for hour in range(24)
    ]
    return (HEADER + "\n".join(rows) + "\n").encode()


def square(size: float, height: float) -> np.ndarray[Any, Any]:
    """Corners around the middle of the terrace."""
    signs = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]])
    corners = 0.5 + 0.5 * size * signs
    return np.column_stack([corners, np.full(4, height)])


FACES = np.array([[0, 1, 2], [0, 2, 3]])
ROOF = {
    "kind": "grid",
    "origin": [0.25, 0.25, 1],
    "u": [0.5, 0, 0],
    "v": [0, 0.6, 0],
    "counts": [2, 3],
    "normal": [0, 0, 1],
}
POINTS = {"kind": "points", "points": [[0.5, 0.5, 1]], "normals": [[0, 0, 1]]}


def terrace(**changes: Any) -> quasilux.Scene:
    """A floor, and a wide sheet above its sensors that lets all light through."""
    arguments: dict[str, Any] = {
        "mesh": {"floor": (square(1, 0), FACES), "sheet": (square(200, 1.1), FACES)},
        "materials": {
            "floor": {"reflectance": 0.2},
            "sheet": {"reflectance": 0, "transmittance": 1},
        },
        "weather": {"file": weather()},
        "sky": {"model": "weather"},
        "sensors": {"roof": ROOF, "middle": POINTS},
        "name": "terrace",
        **changes,
    }
    return quasilux.Scene(**arguments)


def schedule(is_closed: list[bool]) -> bytes:
    """A CSV file of a column for the hours of both days."""
    return ("roof\n" + "".join(f"{int(closed)}\n" for closed in is_closed)).encode()
