"""The office of examples/office: desks, shelves, screens, six batwing luminaires."""

import tomllib
from pathlib import Path

import numpy as np

from contest import obj
from contest.room import Diffuse, Luminaire, Room, Sensors, grid, joined

FOLDER = Path(__file__).resolve().parents[4] / "examples/office"


def room() -> Room:
    """Workplane in half metres, four desks, the whiteboard in 40 cm."""
    project = tomllib.loads((FOLDER / "office.toml").read_text())
    desks = np.array(project["sensors"][1]["points"])
    board = grid((0.03, 1.6, 0.9), (0.0, 1.6, 0.0), (0.0, 0.0, 0.8), (4, 2), (1.0, 0.0, 0.0))
    workplane = grid((0.5, 0.5, 0.85), (5.0, 0.0, 0.0), (0.0, 4.0, 0.0), (10, 8), (0.0, 0.0, 1.0))
    return Room(
        name="office",
        title="Office, 6 luminaires",
        sensors=joined([workplane, Sensors(desks, np.tile([0.0, 0.0, 1.0], (4, 1))), board]),
        materials={
            name: Diffuse(value["reflectance"]) for name, value in project["materials"].items()
        },
        meshes=obj.read(FOLDER / "office.obj"),
        luminaires=[
            Luminaire(FOLDER / lamp["photometry"], tuple(lamp["position"]), c0=tuple(lamp["c0"]))
            for lamp in project["luminaires"]
        ],
    )
