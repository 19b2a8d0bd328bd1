"""A model that became a project: its text, its files, and writing them."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from quasilux import _native
from quasilux._errors import input_error
from quasilux._toml import ProjectText, quoted
from quasilux._whole_file import write_whole
from quasilux.ifc._files import named

if TYPE_CHECKING:
    from quasilux.ifc._findings import Finding
    from quasilux.ifc._geometry import Floats

# The geometry file; names of all files begin with that of the project.
GEOMETRY = "model.obj"

_MOST_STEM_BYTES = 120

# A sensor in place of those that a project lacks, to see whether it loads.
_STAND_IN = """
[[sensors]]
name = "stand-in"
kind = "points"
points = [[0, 0, {z}]]
normals = [[0, 0, 1]]
"""


class Imported:
    """A project that was made of an IFC model; `load` returns one.

    Attributes
    ----------
    name : str
        The model, as messages call it.
    findings : tuple of Finding
        Parts of the model that the project has otherwise, or not at all, and all defaults.
    spaces : tuple of str
        Numbers and names of the spaces that it is about.
    measures : bool
        Whether there is a sensor.
    """

    def __init__(
        self,
        *,
        name: str,
        head: list[str],
        sections: list[tuple[str, dict[str, Any]]],
        objects: list[tuple[str, str, Floats]],
        files: dict[str, bytes],
        findings: tuple[Finding, ...],
        spaces: tuple[str, ...],
    ) -> None:
        self.name = name
        self.findings = findings
        self.spaces = spaces
        self.measures = any(heading == "[[sensors]]" for heading, _ in sections)
        self._head = head
        self._sections = sections
        self._objects = objects
        self._files = files
        self._warnings: tuple[str, ...] | None = None

    @property
    def stem(self) -> str:
        """The name of the model without its ending, with which names of files begin."""
        stem = os.path.splitext(os.path.basename(self.name))[0]
        kept = "".join(c if c.isprintable() else " " for c in stem)
        # With room for what names of files end with; at most 255 bytes are allowed.
        return kept.encode()[:_MOST_STEM_BYTES].decode("utf-8", "ignore").strip() or "model"

    @property
    def text(self) -> str:
        """The text of the project file."""
        return self._text(self.stem)

    @property
    def files(self) -> dict[str, bytes]:
        """Files that the project names, by name."""
        return self._all_files(self.stem)

    @property
    def luminaires(self) -> list[dict[str, Any]]:
        """Keys of the luminaires, as the project has them."""
        found = [keys for heading, keys in self._sections if heading == "[[luminaires]]"]
        return [named(keys, self.stem) for keys in found]

    @property
    def sensors(self) -> list[dict[str, Any]]:
        """Keys of the sensors, as the project has them."""
        return [dict(keys) for heading, keys in self._sections if heading == "[[sensors]]"]

    @property
    def materials(self) -> dict[str, dict[str, Any]]:
        """Keys of the materials by name, as the project has them."""
        found = [keys for heading, keys in self._sections if heading == "[materials]"]
        return {name: named(keys, self.stem) for table in found for name, keys in table.items()}

    def triangles(self, material: str | None = None) -> Floats:
        """Return the corners of all triangles, or those of a material, of shape (n, 3, 3), in m."""
        chosen = [
            corners for _, name, corners in self._objects if material is None or name == material
        ]
        return np.concatenate(chosen) if chosen else np.zeros((0, 3, 3))

    def write(self, where: str | os.PathLike[str]) -> Path:
        """Write the project file and what it names: new files only.

        Parameters
        ----------
        where : str or os.PathLike
            The project file, where it ends in ``.toml``, else a folder for one that has the name of
            the model. Folders are made.

        Returns
        -------
        Path
            The project file.

        Raises
        ------
        InputError
            When one of the files is there already, or the project cannot be loaded; nothing is
            written then.
        """
        out = Path(os.fsdecode(where))
        if out.suffix.lower() != ".toml":
            out = out / f"{self.stem}.toml"
        if not out.name.isprintable():
            raise input_error("control characters in the name; give another name", repr(str(out)))
        files = {out.parent / name: data for name, data in self._all_files(out.stem).items()}
        try:
            _refuse_old(out, files)
        except OSError as error:
            raise input_error(error.strerror or str(error), str(error.filename or out)) from None
        self.warnings()
        _write_all({**files, out: self._text(out.stem).encode()})
        return out

    def warnings(self) -> tuple[str, ...]:
        """Load the project, and return what the loader says of it.

        Raises
        ------
        InputError
            When it cannot be loaded.
        """
        if self._warnings is None:
            self._warnings = self._loaded()
        return self._warnings

    def _loaded(self) -> tuple[str, ...]:
        with tempfile.TemporaryDirectory() as folder:
            for name, data in self.files.items():
                Path(folder, name).write_bytes(data)
            project = Path(folder, f"{self.stem}.toml")
            text = self.text
            if not self.measures:
                above = max(float(corners[..., 2].max()) for _, _, corners in self._objects) + 1
                text += _STAND_IN.replace("{z}", repr(above))
            project.write_text(text, encoding="utf-8")
            begin = os.path.join(folder, "")
            try:
                native = _native.Scene.open(str(project))
            except _native.InputError as error:
                raise input_error(str(error).replace(begin, ""), self.name) from None
            return tuple(warning.replace(begin, "") for warning in native.warnings)

    def _text(self, stem: str) -> str:
        written = ProjectText()
        for line in self._head:
            written.heading(f"# {line}")
        for heading, keys in self._sections:
            if heading == "[materials]":
                for name, entries in keys.items():
                    table = f"[materials.{quoted(name, name)}]"
                    written.table(table, named(entries, stem), name)
            else:
                written.table(heading, named(keys, stem), heading)
        return written.text

    def _all_files(self, stem: str) -> dict[str, bytes]:
        files = {f"{stem}-{GEOMETRY}": _obj(self._objects)}
        files.update({f"{stem}-{name}": data for name, data in self._files.items()})
        return files

    def __repr__(self) -> str:
        counts = (
            f"{len(self.luminaires)} luminaires, {len(self.sensors)} sensors, "
            f"{len(self.findings)} findings"
        )
        return f"<quasilux.ifc.Imported {self.name!r}: {counts}>"


def _refuse_old(out: Path, files: Iterable[Path]) -> None:
    # Links that lead nowhere are there, too.
    for place in (out, *files):
        try:
            os.lstat(place)
        except (FileNotFoundError, NotADirectoryError):
            continue
        message = "is there already; give another name, or remove it"
        if place != out:
            message = (
                "is there already, and the project would have a file of this name; give another "
                "name, or remove it"
            )
        raise input_error(message, str(place))


def _write_all(files: dict[Path, bytes]) -> None:
    """Write all files; none of them stays where one cannot be written."""
    written: list[Path] = []
    try:
        for place, data in files.items():
            place.parent.mkdir(parents=True, exist_ok=True)
            write_whole(place, data)
            written.append(place)
    except OSError as error:
        for place in written:
            place.unlink(missing_ok=True)
        where = str(error.filename or next(iter(files)))
        raise input_error(error.strerror or str(error), where) from None


def _obj(objects: list[tuple[str, str, Floats]]) -> bytes:
    """An OBJ file, z up, in m; coordinates to a micrometre."""
    lines: list[str] = []
    begin = 1
    for name, material, corners in objects:
        rounded = np.round(corners.reshape(-1, 3), 6) + 0.0
        vertices, index = np.unique(rounded, axis=0, return_inverse=True)
        faces = index.reshape(-1, 3)
        is_facet = (faces != np.roll(faces, 1, axis=1)).all(axis=1)
        faces = faces[is_facet] + begin
        if not len(faces):
            continue
        lines += [f"o {name}", f"usemtl {material}"]
        lines += ["v %.6f %.6f %.6f" % tuple(vertex) for vertex in vertices.tolist()]
        lines += ["f %d %d %d" % tuple(face) for face in faces.tolist()]
        begin += len(vertices)
    return ("\n".join(lines) + "\n").encode()
