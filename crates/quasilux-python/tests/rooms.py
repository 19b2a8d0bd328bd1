"""Examples, the command line, and a room of arrays for the tests of scenes and results."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np

import quasilux

ROOT = Path(os.environ.get("QUASILUX_ROOT") or Path(__file__).resolve().parents[3])

# What differs between runs that have the same results.
_OF_THE_MACHINE = {"seconds", "threads", "bytes"}


def example(name: str) -> Path:
    """The project file of an example."""
    return ROOT / "examples" / name / f"{name}.toml"


def command_line(*words: object, cwd: Path | None = None) -> subprocess.CompletedProcess[str]:
    """The command line of the same package in a process of its own."""
    command = [sys.executable, "-m", "quasilux._command_line", *map(str, words)]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    return subprocess.run(
        command, cwd=cwd, env=environment, capture_output=True, text=True, timeout=600
    )


def comparable(document: Any) -> Any:
    """A result document without what the machine decides."""
    if isinstance(document, str):
        document = json.loads(document)
    if isinstance(document, dict):
        kept = {key: x for key, x in document.items() if key not in _OF_THE_MACHINE}
        return {key: comparable(x) if isinstance(x, (dict, list)) else x for key, x in kept.items()}
    return [comparable(x) if isinstance(x, (dict, list)) else x for x in document]


def same_bits(one: quasilux.Result, other: quasilux.Result) -> bool:
    """Whether all arrays of all sensors are the same."""
    names = ["illuminance_lx", "half_width_lx", "direct_lx", "replicates_lx", "samples"]
    return list(one) == list(other) and all(
        np.array_equal(getattr(one[sensor], name), getattr(other[sensor], name), equal_nan=True)
        for sensor in one
        for name in names
    )


VERTICES = np.array([[x, y, z] for z in (0, 2.5) for y in (0, 3) for x in (0, 4)], dtype=float)
# Floor, ceiling, and the four walls, their front sides inward.
TRIANGLES = np.array(
    [
        [0, 1, 3],
        [0, 3, 2],
        [4, 7, 5],
        [4, 6, 7],
        [0, 4, 5],
        [0, 5, 1],
        [1, 5, 7],
        [1, 7, 3],
        [3, 7, 6],
        [3, 6, 2],
        [2, 6, 4],
        [2, 4, 0],
    ]
)
MATERIALS = {"floor": {"reflectance": 0.2}, "wall": {"reflectance": 0.5}}
MATERIAL_OF = np.array([0, 0] + [1] * 10)
LIGHT = {"kind": "point", "position": [2, 1.5, 2.2], "intensity_cd": 300}
DESK = {
    "kind": "grid",
    "origin": [0.5, 0.5, 0.8],
    "u": [3, 0, 0],
    "v": [0, 2, 0],
    "spacing": 0.5,
    "normal": [0, 0, 1],
}


def room(**changes: Any) -> quasilux.Scene:
    """A room of arrays."""
    arguments: dict[str, Any] = {
        "vertices": VERTICES,
        "triangles": TRIANGLES,
        "material_of": MATERIAL_OF,
        "materials": MATERIALS,
        "lights": [LIGHT],
        "sensors": {"desk": DESK},
        **changes,
    }
    if "mesh" in changes:
        for name in ("vertices", "triangles", "material_of"):
            arguments.pop(name)
    return quasilux.Scene(**arguments)


def room_obj() -> str:
    """The same room as an OBJ file."""
    lines = ["o mesh"]
    lines += [f"v {x!r} {y!r} {z!r}" for x, y, z in VERTICES.tolist()]
    for number, corners in enumerate(TRIANGLES + 1):
        lines += [f"usemtl {list(MATERIALS)[MATERIAL_OF[number]]}"]
        lines += ["f " + " ".join(map(str, corners))]
    return "\n".join(lines) + "\n"


ROOM_TOML = """[scene]
geometry = ["mesh.obj"]

[materials]
floor = { reflectance = 0.2 }
wall = { reflectance = 0.5 }

[[lights]]
kind = "point"
position = [2, 1.5, 2.2]
intensity_cd = 300

[[sensors]]
name = "desk"
kind = "grid"
origin = [0.5, 0.5, 0.8]
u = [3, 0, 0]
v = [0, 2, 0]
spacing = 0.5
normal = [0, 0, 1]
"""


def write_room(folder: Path) -> Path:
    """Write the room as files, and return its project file."""
    (folder / "mesh.obj").write_text(room_obj())
    project = folder / "room.toml"
    project.write_text(ROOM_TOML)
    return project
