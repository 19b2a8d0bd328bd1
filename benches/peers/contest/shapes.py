"""Boxes, walls and round bodies to furnish rooms with."""

import numpy as np

from contest.room import Mesh, Rectangle, Vectors

Triple = tuple[float, float, float]


def box_faces(material: str, low: Triple, high: Triple, skip: str = "") -> list[Rectangle]:
    """The faces of a box, but for those named in `skip` ("-x +z" and so on), facing outward."""
    (x, y, z), (a, b, c) = low, (high[0] - low[0], high[1] - low[1], high[2] - low[2])
    faces = {
        "-x": ((x, y, z), (0.0, 0.0, c), (0.0, b, 0.0)),
        "+x": ((x + a, y, z), (0.0, b, 0.0), (0.0, 0.0, c)),
        "-y": ((x, y, z), (a, 0.0, 0.0), (0.0, 0.0, c)),
        "+y": ((x, y + b, z), (0.0, 0.0, c), (a, 0.0, 0.0)),
        "-z": ((x, y, z), (0.0, b, 0.0), (a, 0.0, 0.0)),
        "+z": ((x, y, z + c), (a, 0.0, 0.0), (0.0, b, 0.0)),
    }
    return [
        Rectangle(material, *place) for side, place in faces.items() if side not in skip.split()
    ]


def hall(size: Triple, floor: str, wall: str, ceiling: str, skip: str = "") -> list[Rectangle]:
    """The inside of an empty room with a corner at the origin."""
    names = {"-z": floor, "+z": ceiling}
    parts: list[Rectangle] = []
    for side in ("-x", "+x", "-y", "+y", "-z", "+z"):
        if side in skip.split():
            continue
        others = " ".join({"-x", "+x", "-y", "+y", "-z", "+z"} - {side})
        parts += box_faces(names.get(side, wall), (0.0, 0.0, 0.0), size, others)
    return parts


def desk(x: float, y: float, wide: float, deep: float) -> list[Rectangle]:
    """A table top on four legs, its lower left corner at (x, y)."""
    parts = box_faces("desk", (x, y, 0.70), (x + wide, y + deep, 0.73))
    for dx in (0.02, wide - 0.06):
        for dy in (0.02, deep - 0.06):
            low = (x + dx, y + dy, 0.0)
            parts += box_faces("metal", low, (low[0] + 0.04, low[1] + 0.04, 0.70), "-z +z")
    return parts


def turned(material: str, profile: Vectors, segments: int) -> Mesh:
    """The surface that a profile of (radius, z) makes when it turns about the z axis."""
    angles = 2 * np.pi * np.arange(segments) / segments
    rings = len(profile)
    vertices = np.empty((rings, segments, 3))
    vertices[:, :, 0] = profile[:, :1] * np.cos(angles)
    vertices[:, :, 1] = profile[:, :1] * np.sin(angles)
    vertices[:, :, 2] = profile[:, 1:]
    ring, step = np.meshgrid(np.arange(rings - 1), np.arange(segments), indexing="ij")
    after = (step + 1) % segments
    a, b = ring * segments + step, ring * segments + after
    c, d = a + segments, b + segments
    triangles = np.stack([np.stack([a, b, d], -1), np.stack([a, d, c], -1)], 2)
    return Mesh(material, vertices.reshape(-1, 3), triangles.reshape(-1, 3))


def moved(mesh: Mesh, offsets: Vectors) -> Mesh:
    """Copies of a mesh at each offset, in one mesh."""
    count = len(mesh.vertices)
    vertices = (mesh.vertices[None] + offsets[:, None]).reshape(-1, 3)
    starts = count * np.arange(len(offsets))
    triangles = (mesh.triangles[None] + starts[:, None, None]).reshape(-1, 3)
    return Mesh(mesh.material, vertices, triangles)
