"""Wavefront OBJ, as far as rooms need it: vertices, polygons, names of materials."""

from pathlib import Path

import numpy as np

from contest.room import Mesh, Room


def read(path: Path) -> list[Mesh]:
    """One mesh for each material; polygons become fans of triangles."""
    vertices: list[list[float]] = []
    triangles: dict[str, list[list[int]]] = {}
    material = ""
    for line in path.read_text().splitlines():
        words = line.split()
        if not words:
            continue
        if words[0] == "v":
            vertices.append([float(word) for word in words[1:4]])
        elif words[0] == "usemtl":
            material = words[1]
        elif words[0] == "f":
            corners = [int(word.split("/")[0]) - 1 for word in words[1:]]
            fan = triangles.setdefault(material, [])
            fan += [[corners[0], *corners[i : i + 2]] for i in range(1, len(corners) - 1)]
    return [
        _compact(name, np.array(vertices), np.array(faces)) for name, faces in triangles.items()
    ]


def write(room: Room, path: Path, panel_names: list[str]) -> None:
    """All surfaces of a room; `panel_names` are the materials of its panels."""
    with path.open("w") as out:
        start = 1
        flat = [(part.material, part) for part in room.rectangles]
        flat += [
            (name, panel.rectangle)
            for name, panel in zip(panel_names, room.panels, strict=True)
        ]
        for name, rectangle in flat:
            np.savetxt(out, rectangle.corners(), fmt="v %.9g %.9g %.9g")
            out.write(f"usemtl {name}\nf {start} {start + 1} {start + 2} {start + 3}\n")
            start += 4
        for mesh in room.meshes:
            np.savetxt(out, mesh.vertices, fmt="v %.9g %.9g %.9g")
            out.write(f"usemtl {mesh.material}\n")
            np.savetxt(out, mesh.triangles + start, fmt="f %d %d %d")
            start += len(mesh.vertices)


def _compact(material: str, vertices: np.ndarray, triangles: np.ndarray) -> Mesh:
    used, renamed = np.unique(triangles, return_inverse=True)
    return Mesh(material, vertices[used], renamed.reshape(-1, 3))
