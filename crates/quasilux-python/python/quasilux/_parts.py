"""What a scene of Python values is made of: the text of a project, files and geometry."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from quasilux import _native
from quasilux._errors import input_error
from quasilux._origins import Origins
from quasilux._toml import ProjectText, quoted

if TYPE_CHECKING:
    from quasilux._native import GeometryEntry, PartsEntry


class Description:
    """A project that is being written.

    Parameters
    ----------
    name : str
        What messages call it.
    folder : str
        Folder of the files that it names.
    geometry : list of dict
        Its geometry; names are made unique.
    """

    def __init__(self, *, name: str, folder: str, geometry: list[GeometryEntry]) -> None:
        if not isinstance(name, str):
            raise TypeError(f"name is {type(name).__name__}; expected text")
        self._name = name
        self._folder = folder
        self._geometry = _with_unique_names(geometry)
        self._files: dict[str, bytes] = {}
        self._written = ProjectText()

    def parts(self) -> PartsEntry:
        """Return all of it."""
        return {
            "name": self._name,
            "text": self._written.text,
            "folder": self._folder,
            "files": self._files,
            "geometry": self._geometry,
        }

    def origins(self) -> Origins:
        """Return what its lines were made of."""
        names = (*(entry["name"] for entry in self._geometry), *self._files)
        return Origins(self._name, tuple(self._written.origins), names)

    def scene(self, **values: object) -> None:
        """Begin with what holds for all of the scene."""
        self._written.heading("[scene]")
        names = [quoted(entry["name"], "mesh") for entry in self._geometry]
        self._written.heading(f"geometry = [{', '.join(names)}]")
        for name, value in values.items():
            self._written.entry(name, value, name)

    def materials(self, materials: Mapping[str, Mapping[str, Any]]) -> None:
        """Add materials by name."""
        for name, entries in materials.items():
            origin = f'materials["{name}"]'
            entries = self._with_file(entries, "file", f"materials.{name}", origin, _bsdf_ending)
            self._written.table(f"[materials.{quoted(name, 'materials')}]", entries, origin)

    def luminaires(self, luminaires: Iterable[Mapping[str, Any]]) -> None:
        """Add luminaires, with the files of those that have them in memory."""
        for number, entries in _numbered(luminaires, "luminaires"):
            origin = f"luminaires[{number}]"
            entries = self._with_file(
                entries, "photometry", origin, origin, _native.photometry_ending
            )
            self._written.table("[[luminaires]]", entries, origin)

    def entries(self, section: str, entries: Iterable[Mapping[str, Any]]) -> None:
        """Add the tables of an array of tables."""
        for number, table in _numbered(entries, section):
            self._written.table(f"[[{section}]]", table, f"{section}[{number}]")

    def named(
        self,
        section: str,
        entries: Iterable[Mapping[str, Any]] | Mapping[str, Mapping[str, Any]],
    ) -> None:
        """Add tables with a name each, in a list or by name."""
        if not isinstance(entries, Mapping):
            self.entries(section, entries)
            return
        expect_by_name(section, entries)
        for name, table in entries.items():
            origin = f'{section}["{name}"]'
            if not isinstance(table, Mapping):
                raise TypeError(f"{origin} is {type(table).__name__}; expected a dict of its keys")
            if table.get("name", name) != name:
                raise input_error(f'{origin}["name"] is {table["name"]!r}; expected {name!r}')
            self._written.table(f"[[{section}]]", {"name": name, **table}, origin)

    def section(self, name: str, entries: Mapping[str, Any] | None) -> None:
        """Add a table that is there at most once, with its file where that is in memory."""
        if entries:
            endings = {"weather": "epw", "sky": "hdr", "annual": "csv", "blinds": "csv"}
            key = "file" if name in ("weather", "sky") else "schedule"
            ending = endings.get(name)
            if ending is not None:
                entries = self._with_file(entries, key, name, name, lambda _: ending)
            self._written.table(f"[{name}]", entries, name)

    def section_or_entries(
        self, name: str, entries: Mapping[str, Any] | Iterable[Mapping[str, Any]] | None
    ) -> None:
        """Add a table, or several of its name."""
        if isinstance(entries, Mapping):
            table: Any = entries
            self.section(name, table)
        elif entries is not None:
            self.entries(name, entries)

    def _with_file(
        self,
        entries: Any,
        key: str,
        stem: str,
        origin: str,
        ending: Any,
    ) -> Any:
        """Put a file that is in memory under a name, and the name in its place."""
        value = entries.get(key) if isinstance(entries, Mapping) else None
        if value is None or isinstance(value, (str, os.PathLike)):
            return entries
        content = _content(value)
        if content is None:
            raise TypeError(
                f'{origin}["{key}"] is {type(value).__name__}; expected the name of a file, bytes, '
                "or an object that has them"
            )
        known = (name for name, bytes_ in self._files.items() if bytes_ == content)
        name = next(known, f"{stem}.{ending(content)}")
        self._files[name] = content
        return {**entries, key: name}


def expect_by_name(name: str, entries: object) -> None:
    """Refuse what is no mapping from text.

    Raises
    ------
    TypeError
        For that.
    """
    if not isinstance(entries, Mapping):
        raise TypeError(f"{name} is {type(entries).__name__}; expected a dict of dicts")
    for key in entries:
        if not isinstance(key, str):
            raise TypeError(f"{name} has the key {key!r}; expected text")


def _content(value: Any) -> bytes | None:
    """Bytes, those of a file that an object was read from, or those that it can be written as."""
    if isinstance(value, (bytes, bytearray, memoryview)):
        return bytes(value)
    own = getattr(value, "data", None)
    if isinstance(own, bytes):
        return own
    if not hasattr(value, "to_ies"):
        return None
    written = value.to_ies()
    written = getattr(written, "data", written)
    return written.encode() if isinstance(written, str) else bytes(written)


def _bsdf_ending(content: bytes) -> str:
    return "xml" if content.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"<") else "bsdf"


def _numbered(entries: Any, section: str) -> Iterable[tuple[int, Any]]:
    if isinstance(entries, (Mapping, str, bytes)) or not isinstance(entries, Iterable):
        raise TypeError(f"{section} is {type(entries).__name__}; expected a list of dicts")
    return enumerate(entries)


def _with_unique_names(geometry: list[GeometryEntry]) -> list[GeometryEntry]:
    taken: set[str] = set()
    for entry in geometry:
        name, number = entry["name"], 2
        while entry["name"] in taken:
            entry["name"] = f"{name} {number}"
            number += 1
        taken.add(entry["name"])
    return geometry
