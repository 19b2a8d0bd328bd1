"""Scenes: from files, or from arrays and dicts."""

from __future__ import annotations

import dataclasses
import json
import os
from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Literal, overload

from quasilux import _native
from quasilux._errors import missing_file
from quasilux._finding import Check
from quasilux._origins import Origins

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from quasilux._native import GeometryEntry

    Entry = Mapping[str, Any]
    Entries = Iterable[Entry] | Mapping[str, Entry]


def load(path: str | os.PathLike[str]) -> Scene:
    """Load a project file with all the files that it names.

    Parameters
    ----------
    path : path-like
        A project file, or what `Scene.save` wrote.

    Returns
    -------
    Scene
        The scene, checked.

    Raises
    ------
    InputError
        When a file cannot be read or something in it makes no sense, with file, line and column.
    FileNotFoundError
        When there is no project file: an `InputError`, too.

    Examples
    --------
    >>> scene = load("examples/cube/cube.toml")
    >>> list(scene.sensors)
    ['probes', 'wall']
    """
    path = os.fspath(path)
    if not os.path.lexists(path):
        raise missing_file(path)
    return Scene._loaded(_native.Scene.open(path), Origins())


@dataclasses.dataclass(frozen=True)
class SensorPlace:
    """Where a sensor of a scene measures.

    Attributes
    ----------
    name : str
        The name of the sensor.
    shape : tuple of int
        Shape of the arrays that it gives: (v, u) of a grid, (n,) of points.
    positions_m : ndarray of float64, shape (v, u, 3) or (n, 3)
        Positions in m; centres of the cells of a grid. Read-only.
    normals : ndarray of float64, shape (v, u, 3) or (n, 3)
        Unit normals; light from their side counts. Read-only.
    """

    name: str
    shape: tuple[int, ...]
    positions_m: NDArray[np.float64] = dataclasses.field(repr=False)
    normals: NDArray[np.float64] = dataclasses.field(repr=False)


class Scene:
    """A room with its lights, sensors and cameras, checked and unchangeable.

    `load` reads one from a project file. This makes one of arrays and dicts, whose keys are those
    of the project file's tables.

    Parameters
    ----------
    mesh : trimesh.Trimesh, trimesh.Scene or dict, optional
        Instead of `vertices` and `triangles`: a mesh, a scene of meshes, or pairs (vertices,
        triangles) by the name of their material. A mesh of trimesh has the material whose name its
        visual or its key in the scene is, or the only one.
    vertices : array_like of float, shape (n, 3)
        Positions of vertices, in `units`. Those at one place become one.
    triangles : array_like of int, shape (m, 3)
        Indices of the vertices of each triangle, counter-clockwise seen from its front side.
    material_of : array_like of int or of str, shape (m,), optional
        The material of each triangle, as an index into `materials` or by name. It can be left out
        where there is one material or none.
    materials : dict of dict, optional
        Materials by name, such as ``{"wall": {"reflectance": 0.5}}``. A measured surface has the
        name of its file, the bytes of one, or an object with them in `data` as ``"file"``.
    luminaires : sequence of dict, optional
        Measured luminaires. ``"photometry"`` is the name of a file, the bytes of one, or a
        luminaire of `quasilux.photometry`.
    lights : sequence of dict, optional
        Point and area lights.
    sensors, cameras : sequence of dict, or dict of dict by name, optional
        Where light is asked for.
    site, weather, sky, sun, ground : dict, optional
        What is outside, such as ``sky={"model": "cie", "type": 16, "horizontal_illuminance_lx":
        10000}``. A weather file, or the picture of a sky, has the name of its file or the bytes of
        one as ``"file"``.
    openings : sequence of dict, optional
        Where light comes in; the panes of the scene where there are none.
    annual : dict, optional
        What a year is judged by.
    blinds, electric_light : dict or sequence of dict, optional
        Blinds and lamps of a year, in one group or zone or in several.
    simulation : dict, optional
        What `simulate` is asked for where its arguments do not say.
    maintenance_factor : float, default 1.0
        What all lights give in use over what they give when new, in (0, 1].
    units : {"m", "cm", "mm", "in", "ft"}, default "m"
        Unit of the geometry.
    position_units : {"m", "cm", "mm", "in", "ft"}, default "m"
        Unit of the positions and lengths in the dicts.
    up : {"z", "y"}, default "z"
        The axis that points up in the geometry; y is turned.
    folder : path-like, default the current one
        Folder of files that the dicts name.
    name : str, default "scene"
        Title of pictures.

    Raises
    ------
    InputError
        When something makes no sense, with its name, as in ``sensors[0]["counts"]``.
    TypeError
        For a value of a type that nothing stands for.

    Examples
    --------
    >>> scene = Scene(
    ...     vertices=[[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]],
    ...     triangles=[[0, 1, 2], [0, 2, 3]],
    ...     materials={"wood": {"reflectance": 0.4}},
    ...     lights=[{"kind": "point", "position": [1, 1, 2], "intensity_cd": 300}],
    ...     sensors={"desk": {"kind": "points", "points": [[1, 1, 0.8]], "normals": [[0, 0, 1]]}},
    ... )
    >>> scene
    <quasilux.Scene 'scene': 2 triangles, 1 light, sensors: desk>
    """

    _native: _native.Scene
    _origins: Origins
    _contents: dict[str, Any]

    def __init__(
        self,
        mesh: Any = None,
        *,
        vertices: ArrayLike | None = None,
        triangles: ArrayLike | None = None,
        material_of: ArrayLike | Sequence[str] | None = None,
        materials: Mapping[str, Entry] | None = None,
        luminaires: Iterable[Entry] = (),
        lights: Iterable[Entry] = (),
        sensors: Entries = (),
        cameras: Entries = (),
        site: Entry | None = None,
        weather: Entry | None = None,
        sky: Entry | None = None,
        sun: Entry | None = None,
        ground: Entry | None = None,
        openings: Iterable[Entry] = (),
        annual: Entry | None = None,
        blinds: Entry | Iterable[Entry] | None = None,
        electric_light: Entry | Iterable[Entry] | None = None,
        simulation: Entry | None = None,
        maintenance_factor: float = 1.0,
        units: str = "m",
        position_units: str = "m",
        up: str = "z",
        folder: str | os.PathLike[str] | None = None,
        name: str = "scene",
    ) -> None:
        from quasilux._parts import Description, expect_by_name

        expect_by_name("materials", materials or {})
        described = Description(
            name=name,
            folder=os.getcwd() if folder is None else os.fspath(folder),
            geometry=_geometry(vertices, triangles, material_of, mesh, materials or {}),
        )
        described.scene(
            units=units,
            position_units=position_units,
            up=up,
            maintenance_factor=maintenance_factor,
        )
        described.materials(materials or {})
        described.luminaires(luminaires)
        described.entries("lights", lights)
        described.named("sensors", sensors)
        described.named("cameras", cameras)
        outside = {"site": site, "weather": weather, "sky": sky, "sun": sun, "ground": ground}
        for section, entries in {**outside, "annual": annual, "simulation": simulation}.items():
            described.section(section, entries)
        described.entries("openings", openings)
        described.section_or_entries("blinds", blinds)
        described.section_or_entries("electric_light", electric_light)
        origins = described.origins()
        try:
            native = _native.Scene.from_parts(described.parts())
        except _native.InputError as error:
            raise origins.error(error) from None
        self._take(native, origins)

    @classmethod
    def _loaded(cls, native: _native.Scene, origins: Origins) -> Scene:
        scene = cls.__new__(cls)
        scene._take(native, origins)
        return scene

    def _take(self, native: _native.Scene, origins: Origins) -> None:
        self._native = native
        self._origins = origins
        self._contents = json.loads(native.contents())
        self._arrays: dict[str, Any] = {}

    def __reduce__(self) -> tuple[Any, ...]:
        return _unpickled, (self._native.to_bundle(), self._origins)

    def __copy__(self) -> Scene:
        return self

    def __deepcopy__(self, _memo: dict[int, Any]) -> Scene:
        return self

    def __eq__(self, other: object) -> bool:
        return self.sha256 == other.sha256 if isinstance(other, Scene) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.sha256)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write everything that the scene is made of to one file.

        `load` reads it, and so does every command of ``quasilux``, on any machine.

        Raises
        ------
        InputError
            When a file of the scene has changed since it was loaded.
        """
        bundle = self._native.to_bundle()
        with open(path, "wb") as file:
            file.write(bundle)

    @property
    def name(self) -> str:
        """What messages call the project."""
        return self._native.name

    @property
    def sha256(self) -> str:
        """Digest of all bytes that the scene is made of: scenes with the same are the same."""
        return self._native.sha256

    @property
    def bounds_m(self) -> NDArray[np.float64]:
        """Lowest and highest coordinates of the geometry in m, shape (2, 3)."""
        import numpy as np

        return np.array(self._contents["bounds_m"])

    @property
    def vertices(self) -> NDArray[np.float64]:
        """Positions of all vertices in m, z up, shape (n, 3). Read-only."""
        return self._array("vertices")

    @property
    def triangles(self) -> NDArray[np.uint32]:
        """Indices of the vertices of each triangle, shape (m, 3). Read-only."""
        return self._array("triangles")

    @property
    def material_of(self) -> NDArray[np.uint32]:
        """Index into `materials` of each triangle, shape (m,). Read-only."""
        return self._array("material_of")

    def _array(self, name: str) -> Any:
        if name not in self._arrays:
            self._arrays[name] = getattr(self._native, name)()
        return self._arrays[name]

    @property
    def materials(self) -> tuple[str, ...]:
        """Names of the materials of the geometry."""
        return tuple(entry["name"] for entry in self._contents["materials"])

    @property
    def sensors(self) -> Mapping[str, SensorPlace]:
        """Where each sensor measures, by name."""
        if "sensors" not in self._arrays:
            places = (self._sensor(i) for i in range(len(self._contents["sensors"])))
            self._arrays["sensors"] = MappingProxyType({place.name: place for place in places})
        return self._arrays["sensors"]

    def _sensor(self, index: int) -> SensorPlace:
        positions_m = self._native.positions(index)
        name = self._contents["sensors"][index]["name"]
        normals = self._native.normals(index)
        return SensorPlace(name, positions_m.shape[:-1], positions_m, normals)

    @property
    def cameras(self) -> Mapping[str, tuple[int, int]]:
        """Width and height in pixels of the picture of each camera, by name."""
        entries = self._contents["cameras"]
        return MappingProxyType({entry["name"]: tuple(entry["resolution"]) for entry in entries})

    @property
    def flux_lm(self) -> float:
        """What all lights give together, in lm."""
        return self._contents["flux_lm"]

    @property
    def project_text(self) -> str:
        """The text of the project file; of a scene of arrays, what it would be."""
        return self._native.text

    @property
    def warnings(self) -> tuple[str, ...]:
        """Oddities that were lived with."""
        return tuple(map(self._origins.text, self._native.warnings))

    def check(self) -> Check:
        """Look for what is probably wrong with the scene, as ``quasilux check`` does.

        Returns
        -------
        Check
            A sequence of findings, empty where there is nothing.

        Examples
        --------
        >>> len(load("examples/office/office.toml").check())
        0
        """
        entry = self._native.check()
        check = Check._from_document(entry["document"], entry["text"])
        return dataclasses.replace(
            check,
            findings=tuple(map(self._origins.finding, check.findings)),
            warnings=tuple(map(self._origins.text, check.warnings)),
            text=self._origins.report(check.text),
        )

    @overload
    def plan(self, format: Literal["png"] = "png", *, scale: float = 1.0) -> bytes: ...
    @overload
    def plan(self, format: Literal["svg"], *, scale: float = 1.0) -> str: ...
    def plan(self, format: str = "png", *, scale: float = 1.0) -> bytes | str:
        """Draw the plan and two elevations of the scene, findings marked in them.

        Parameters
        ----------
        format : {"png", "svg"}, default "png"
            What it is returned as: the bytes of a PNG file, or SVG text.
        scale : float, default 1.0
            Pixels of the PNG for each unit of the SVG.

        Returns
        -------
        bytes or str
            The drawing.
        """
        if format == "png":
            return self._native.plan_png(scale)
        if format == "svg":
            return self._native.plan_svg()
        raise ValueError(f'format is {format!r}; expected "png" or "svg"')

    def __repr__(self) -> str:
        contents = self._contents
        parts = [
            _plural(contents["triangles"], "triangle"),
            _plural(len(contents["lights"]), "light"),
        ]
        for kind in ("sensors", "cameras"):
            names = ", ".join(entry["name"] for entry in contents[kind])
            parts.extend([f"{kind}: {names}"] if names else [])
        return f"<quasilux.Scene {self.name!r}: {', '.join(parts)}>"

    def _repr_html_(self) -> str:
        from quasilux import _html

        return _html.scene(self, self._contents, self.plan())

    def _repr_png_(self) -> bytes:
        return self.plan()


def _unpickled(bundle: bytes, origins: Origins) -> Scene:
    return Scene._loaded(_native.Scene.from_bundle(bundle), origins)


def _plural(count: int, one: str) -> str:
    return f"{count} {one}" if count == 1 else f"{count} {one}s"


def _geometry(
    vertices: ArrayLike | None,
    triangles: ArrayLike | None,
    material_of: ArrayLike | Sequence[str] | None,
    mesh: Any,
    materials: Mapping[str, Entry],
) -> list[GeometryEntry]:
    from quasilux import _mesh

    if mesh is not None:
        if vertices is not None or triangles is not None:
            raise TypeError("mesh and vertices exclude each other; give one of them")
        return _mesh.from_mesh(mesh, material_of, list(materials))
    if vertices is None or triangles is None:
        raise TypeError("vertices and triangles go together; expected both, or mesh")
    return _mesh.from_arrays(vertices, triangles, material_of, list(materials))
