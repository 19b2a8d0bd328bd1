"""White tiles at the sensors, for programs that only know what surfaces look like.

The luminance of a white diffuse tile times pi is the illuminance on it. At 2 mm a tile averages
over next to nothing and hides as little.
"""

import numpy as np
from numpy.typing import NDArray

from contest.room import Room, Vectors

TILE_M = 0.002


def tiles(room: Room) -> Vectors:
    """The corners of each tile, counter-clockwise seen from where its normal points to."""
    normals = room.sensors.normals
    other = np.where(np.abs(normals[:, :1]) < 0.9, [[1.0, 0.0, 0.0]], [[0.0, 1.0, 0.0]])
    u = np.cross(other, normals)
    u *= (TILE_M / 2) / np.linalg.norm(u, axis=1, keepdims=True)
    v = np.cross(normals, u)
    p = room.sensors.positions
    return np.stack([p - u - v, p + u - v, p + u + v, p - u + v], axis=1)


def two_each(rectangles: int) -> NDArray[np.int64]:
    """Two triangles for each four corners."""
    starts = 4 * np.arange(rectangles)[:, None, None]
    return (starts + np.array([[0, 1, 2], [0, 2, 3]])).reshape(-1, 3)


def merged(room: Room, material: str) -> tuple[Vectors, NDArray[np.int64]]:
    """Vertices and triangles of all surfaces of one material."""
    vertices = [part.corners() for part in room.rectangles if part.material == material]
    triangles = [two_each(len(vertices))]
    start = 4 * len(vertices)
    for mesh in room.meshes:
        if mesh.material == material:
            vertices.append(mesh.vertices)
            triangles.append(mesh.triangles + start)
            start += len(mesh.vertices)
    return np.concatenate([np.zeros((0, 3)), *vertices]), np.concatenate(triangles)
