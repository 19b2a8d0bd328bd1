"""Files that a project names: gathered from where they are, under names of its own."""

from __future__ import annotations

import os
from typing import Any

from quasilux._errors import input_error, missing_file
from quasilux.ifc._sources import read_bytes
from quasilux.ifc._surfaces import obj_name


class ProjectFiles:
    """Bytes by names; the same bytes have one name."""

    def __init__(self) -> None:
        self.files: dict[str, bytes] = {}
        self._copied: dict[str, str] = {}

    def add(self, name: str, data: bytes) -> str:
        """Add a file, and return the name that it got."""
        for known, bytes_ in self.files.items():
            if bytes_ == data and os.path.splitext(known)[1] == os.path.splitext(name)[1].lower():
                return known
        begin, ending = os.path.splitext(_plain(name))
        begin, ending = begin or "file", ending.lower()
        taken = {known.casefold() for known in self.files}
        candidate, number = f"{begin}{ending}", 2
        while candidate.casefold() in taken:
            candidate, number = f"{begin}-{number}{ending}", number + 1
        self.files[candidate] = data
        return candidate

    def copy(self, name: str, folder: str, mapping: str) -> str:
        """Add a file that a mapping names, and return the name that it got.

        Raises
        ------
        InputError
            For one that cannot be read.
        """
        path = os.path.join(folder, name)
        if path in self._copied:
            return self._copied[path]
        if not os.path.exists(path):
            raise missing_file(path)
        if not os.path.isfile(path):
            raise input_error(f"{path} is no file; expected the name of one", mapping)
        self._copied[path] = self.add(os.path.basename(path), read_bytes(path, mapping))
        return self._copied[path]

    def of_material(self, keys: dict[str, Any], folder: str, mapping: str) -> dict[str, Any]:
        """Return the keys of a material with its files among those of the project."""
        keys = dict(keys)
        if isinstance(keys.get("file"), str):
            keys["file"] = FileName(self.copy(keys["file"], folder, mapping))
        layers = keys.get("layers")
        if isinstance(layers, list):
            keys["layers"] = [self._layer(layer, folder, mapping) for layer in layers]
        return keys

    def _layer(self, layer: Any, folder: str, mapping: str) -> Any:
        if isinstance(layer, str):
            return FileName(self.copy(layer, folder, mapping))
        if isinstance(layer, dict) and isinstance(layer.get("file"), str):
            return {**layer, "file": FileName(self.copy(layer["file"], folder, mapping))}
        return layer


class FileName(str):
    """The name of a file of the project, before its beginning is known."""


def named(value: Any, stem: str) -> Any:
    """Return a value with the beginning of the names of files in it."""
    if isinstance(value, FileName):
        return f"{stem}-{value}"
    if isinstance(value, dict):
        return {key: named(part, stem) for key, part in value.items()}
    if isinstance(value, list):
        return [named(part, stem) for part in value]
    return value


def _plain(name: str) -> str:
    kept = "".join(c if c.isalnum() or c in "-_. " else " " for c in obj_name(name))
    return "-".join(kept.split()).lstrip(".")
