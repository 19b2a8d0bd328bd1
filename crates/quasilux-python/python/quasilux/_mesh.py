"""Geometry from arrays, and from meshes of trimesh."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from quasilux._errors import input_error

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from quasilux._native import GeometryEntry

DEFAULT_MATERIAL = "default"
"""What triangles without a material have."""

_MAX_INDEX = 2**32 - 1


def from_arrays(
    vertices: ArrayLike,
    triangles: ArrayLike,
    material_of: ArrayLike | Sequence[str] | None,
    materials: Sequence[str],
) -> list[GeometryEntry]:
    """Return triangles as one piece of geometry.

    Raises
    ------
    InputError
        For arrays of another shape or kind.
    """
    corners = _triangles(triangles, "triangles")
    names, indices = _materials(material_of, list(materials), len(corners))
    return [_entry("mesh", _vertices(vertices, "vertices"), corners, names, indices)]


def from_mesh(
    mesh: Any,
    material_of: ArrayLike | Sequence[str] | None,
    materials: Sequence[str],
) -> list[GeometryEntry]:
    """Return a mesh of trimesh, a scene of such, or arrays by material, as pieces of geometry.

    Raises
    ------
    TypeError
        For anything else.
    InputError
        For arrays of another shape or kind.
    """
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
        if material_of is None:
            material_of = [_name(mesh, "", materials)] * len(mesh.faces)
        return from_arrays(mesh.vertices, mesh.faces, material_of, materials)
    if material_of is not None:
        raise TypeError("material_of goes with vertices and triangles or with one mesh of trimesh")
    if hasattr(mesh, "graph") and hasattr(mesh, "geometry"):
        return _from_scene(mesh, materials)
    if isinstance(mesh, Mapping):
        return [_from_pair(name, pair) for name, pair in mesh.items()]
    raise TypeError(
        f"mesh is {type(mesh).__name__}; expected a trimesh.Trimesh, a trimesh.Scene or a dict of "
        "(vertices, triangles) by the name of their material"
    )


def _from_pair(name: object, pair: object) -> GeometryEntry:
    if not isinstance(name, str):
        raise TypeError(f"mesh has the key {name!r}; expected the name of a material")
    origin = f'mesh["{name}"]'
    if not isinstance(pair, Sequence) or len(pair) != 2:
        raise TypeError(f"{origin} is {type(pair).__name__}; expected (vertices, triangles)")
    vertices, triangles = pair
    corners = _triangles(triangles, f"{origin}[1]")
    points = _vertices(vertices, f"{origin}[0]")
    return _entry(name, points, corners, [name], np.empty(0, np.uint32))


def _from_scene(scene: Any, materials: Sequence[str]) -> list[GeometryEntry]:
    entries: list[GeometryEntry] = []
    for node in scene.graph.nodes_geometry:
        transform, key = scene.graph[node]
        mesh = scene.geometry[key]
        if not hasattr(mesh, "faces"):
            continue
        matrix = np.asarray(transform, dtype=np.float64)
        vertices = np.asarray(mesh.vertices, dtype=np.float64)
        vertices = vertices @ matrix[:3, :3].T + matrix[:3, 3]
        corners = _triangles(mesh.faces, f"the faces of {key!r}")
        if np.linalg.det(matrix[:3, :3]) < 0.0:
            # Mirrored triangles keep their front side.
            corners = np.ascontiguousarray(corners[:, ::-1])
        names, none = [_name(mesh, str(key), materials)], np.empty(0, np.uint32)
        points = _vertices(vertices, f"the vertices of {key!r}")
        entries.append(_entry(str(node), points, corners, names, none))
    if not entries:
        raise input_error("mesh is a scene without meshes; expected at least one")
    return entries


def _name(mesh: Any, key: str, materials: Sequence[str]) -> str:
    """Name the material of a mesh: what it says itself, its key, or the only one that there is."""
    own = getattr(getattr(getattr(mesh, "visual", None), "material", None), "name", None)
    candidates = [name for name in (own, key) if name]
    for name in candidates:
        if name in materials:
            return str(name)
    if len(materials) == 1:
        return materials[0]
    return str(own or DEFAULT_MATERIAL)


def _entry(
    name: str,
    vertices: NDArray[np.float64],
    triangles: NDArray[np.uint32],
    materials: list[str],
    material_of: NDArray[np.uint32],
) -> GeometryEntry:
    return {
        "name": name,
        "vertices": vertices,
        "triangles": triangles,
        "material_of": material_of,
        "materials": materials,
        "object": name,
    }


def _vertices(values: ArrayLike, origin: str) -> NDArray[np.float64]:
    array = _array(values, origin)
    _expect_shape(array, origin, "(n, 3): x, y and z of each vertex")
    _expect_kind(array, origin, "fiu", "numbers")
    return np.ascontiguousarray(array, dtype=np.float64)


def _triangles(values: ArrayLike, origin: str) -> NDArray[np.uint32]:
    array = _array(values, origin)
    _expect_shape(array, origin, "(m, 3): indices of the vertices of each triangle")
    return _indices(array, origin, "indices of vertices")


def _indices(array: NDArray[Any], origin: str, what: str) -> NDArray[np.uint32]:
    _expect_kind(array, origin, "iu", what)
    outside = np.argwhere((array < 0) | (array > _MAX_INDEX))
    if len(outside):
        place = "".join(f"[{index}]" for index in outside[0])
        value = array[tuple(outside[0])]
        raise input_error(f"{origin}{place} is {value}; expected {what}, from 0 on")
    return np.ascontiguousarray(array, dtype=np.uint32)


def _materials(
    material_of: ArrayLike | Sequence[str] | None,
    materials: list[str],
    triangles: int,
) -> tuple[list[str], NDArray[np.uint32]]:
    """Names of materials, and the index of that of each triangle; none where all have the first."""
    if material_of is None:
        if len(materials) > 1:
            raise input_error(
                f"material_of is missing, and there are {len(materials)} materials; expected the "
                "index or the name of the material of each triangle"
            )
        return materials, np.empty(0, np.uint32)
    array = _array(material_of, "material_of")
    if array.shape != (triangles,):
        expected = f"({triangles},): the index or the name of the material of each triangle"
        raise input_error(f"material_of has the shape {array.shape}; expected {expected}")
    if array.dtype.kind in "UO":
        names: list[Any] = array.tolist()
        if all(isinstance(name, str) for name in names):
            return _by_name(names, materials)
        if not all(isinstance(name, int) and not isinstance(name, bool) for name in names):
            raise input_error("material_of mixes kinds; expected indices alone, or names alone")
        array = array.astype(np.int64)
    indices = _indices(array, "material_of", "indices into materials, or names of them")
    if triangles and indices.max() >= max(len(materials), 1):
        at = int(indices.argmax())
        raise input_error(
            f"material_of[{at}] is {indices[at]}; expected an index below {len(materials)}, the "
            "number of materials"
        )
    return materials, indices


def _by_name(names: list[str], known: list[str]) -> tuple[list[str], NDArray[np.uint32]]:
    number = {name: index for index, name in enumerate(known)}
    indices = [number.setdefault(name, len(number)) for name in names]
    return list(number), np.array(indices, dtype=np.uint32)


def _array(values: ArrayLike | Sequence[str], origin: str) -> NDArray[Any]:
    try:
        return np.asarray(values)
    except ValueError as error:
        raise input_error(f"{origin} is no array: {error}") from error


def _expect_shape(array: NDArray[Any], origin: str, expected: str) -> None:
    if array.ndim != 2 or array.shape[1] != 3:
        raise input_error(f"{origin} has the shape {array.shape}; expected {expected}")


def _expect_kind(array: NDArray[Any], origin: str, kinds: str, what: str) -> None:
    if array.dtype.kind not in kinds:
        raise input_error(f"{origin} is an array of {array.dtype}; expected {what}")
