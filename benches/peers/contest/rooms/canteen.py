"""A canteen of a million triangles: round tables, stools and vases, all finely turned."""

import numpy as np

from contest.room import Diffuse, Luminaire, Mesh, Room, grid
from contest.rooms.office import FOLDER
from contest.shapes import hall, moved, turned


def room() -> Room:
    """20 m x 12 m x 3.5 m, 24 tables, 20 luminaires, sensors at 80 cm."""
    tables = np.array([[1.9 + 3.2 * i, 1.7 + 2.85 * j, 0.0] for i in range(6) for j in range(4)])
    turns = np.radians([45.0, 135.0, 225.0, 315.0])
    around = np.stack([0.95 * np.cos(turns), 0.95 * np.sin(turns), np.zeros(4)], axis=1)
    stools = (tables[:, None] + around[None]).reshape(-1, 3)
    up = (0.0, 0.0, 1.0)
    return Room(
        name="canteen",
        title="Furnished canteen, 10^6 triangles",
        sensors=grid((0.5, 0.5, 0.8), (19.0, 0.0, 0.0), (0.0, 11.0, 0.0), (12, 8), up),
        materials={
            "floor": Diffuse(0.25),
            "wall": Diffuse(0.6),
            "ceiling": Diffuse(0.8),
            "wood": Diffuse(0.4),
            "stool": Diffuse(0.3),
            "vase": Diffuse(0.6),
        },
        rectangles=hall((20.0, 12.0, 3.5), "floor", "wall", "ceiling"),
        meshes=[moved(_table(), tables), moved(_stool(), stools), moved(_vase(), tables)],
        luminaires=[
            Luminaire(FOLDER / "batwing.ies", (2.0 + 4.0 * i, 1.5 + 3.0 * j, 2.9))
            for i in range(5)
            for j in range(4)
        ],
    )


def _table() -> Mesh:
    corners = [(0.3, 0.0), (0.3, 0.03), (0.05, 0.05), (0.04, 0.7), (0.6, 0.71), (0.6, 0.74)]
    return turned("wood", _fine([*corners, (0.001, 0.745)], 24), 96)


def _stool() -> Mesh:
    corners = [(0.17, 0.0), (0.12, 0.2), (0.1, 0.3), (0.14, 0.4), (0.19, 0.44), (0.19, 0.47)]
    return turned("stool", _fine([*corners, (0.001, 0.48)], 72), 48)


def _vase() -> Mesh:
    corners = [(0.001, 0.746), (0.04, 0.747), (0.06, 0.8), (0.07, 0.85), (0.03, 0.93)]
    return turned("vase", _fine([*corners, (0.045, 1.0)], 120), 64)


def _fine(corners: list[tuple[float, float]], rings: int) -> np.ndarray:
    points = np.array(corners)
    lengths = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    at = np.linspace(0.0, lengths[-1], rings)
    return np.stack([np.interp(at, lengths, points[:, k]) for k in range(2)], axis=1)
