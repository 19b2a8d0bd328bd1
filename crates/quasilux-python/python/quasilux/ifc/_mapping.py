"""What stands for the names of a model: materials and photometric files, as a TOML file says."""

from __future__ import annotations

import fnmatch
import os
import sys
from collections.abc import Iterable, Mapping as MappingOf
from dataclasses import dataclass, field
from typing import Any

from quasilux._errors import input_error, missing_file, optional

# Keys of a luminaire that a project file has too.
_OF_PROJECT = frozenset({"photometry", "dimming", "flux_lm", "as", "rotation_deg"})
_OF_LUMINAIRE = _OF_PROJECT | {"aim", "c0", "offset_m", "position", "keep_body", "skip"}
_POSITIONS = ("auto", "origin")
_MOST_BYTES = 16 << 20


@dataclass(frozen=True)
class Mapping:
    """A mapping file that was read.

    Attributes
    ----------
    file : str
        What messages call it.
    folder : str
        What files in it are relative to.
    materials : dict
        Keys of a material of the project by names of styles, materials, types or classes.
    luminaires : dict
        Keys of a luminaire by names of types of fixtures.
    """

    file: str = "mapping"
    folder: str = ""
    materials: dict[str, dict[str, Any]] = field(default_factory=dict)
    luminaires: dict[str, dict[str, Any]] = field(default_factory=dict)

    def material(self, names: Iterable[str]) -> tuple[str, dict[str, Any]] | None:
        """Return the first entry that is for one of the names, and the key it stands at."""
        return _entry(self.materials, names)

    def luminaire(self, names: Iterable[str]) -> tuple[str, dict[str, Any]] | None:
        """Return the first entry that is for one of the names, and the key it stands at."""
        return _entry(self.luminaires, names)


def read_mapping(
    source: str | os.PathLike[str] | MappingOf[str, Any] | Mapping | None,
) -> Mapping:
    """Read a mapping from a TOML file or a dict of the same tables.

    Raises
    ------
    InputError
        For a file that is missing or no TOML, and for keys that there are not.
    """
    if source is None:
        return Mapping()
    if isinstance(source, Mapping):
        return source
    if isinstance(source, MappingOf):
        return _checked(dict(source), "mapping", os.getcwd())
    path = os.fsdecode(source)
    # The module is in Python from 3.11 on; the extra brings its twin before.
    parser = optional("tomllib" if sys.version_info >= (3, 11) else "tomli", "ifc")
    try:
        with open(path, "rb") as file:
            data = file.read(_MOST_BYTES + 1)
        if len(data) > _MOST_BYTES:
            raise input_error(f"the file is larger than {_MOST_BYTES >> 20} MiB", path)
        table = parser.loads(data.decode("utf-8-sig"))
    except FileNotFoundError:
        raise missing_file(path) from None
    except OSError as error:
        raise input_error(error.strerror or str(error), path) from None
    except (ValueError, RecursionError) as error:
        if hasattr(error, "file"):
            raise
        raise input_error(f"no TOML: {error}", path) from None
    return _checked(table, path, os.path.dirname(os.path.abspath(path)))


def _checked(table: dict[str, Any], file: str, folder: str) -> Mapping:
    for section in table:
        if section not in ("materials", "luminaires"):
            raise input_error(f"[{section}]; expected [materials] or [luminaires]", file)
    sections: dict[str, dict[str, dict[str, Any]]] = {}
    for section in ("materials", "luminaires"):
        entries: Any = table.get(section, {})
        if not isinstance(entries, MappingOf):
            raise input_error(f"{section} is no table; expected [{section}.NAME]", file)
        for name, keys in entries.items():
            if not isinstance(keys, MappingOf):
                raise input_error(f"{section}.{name} is no table; expected its keys", file)
        sections[section] = {str(name): dict(keys) for name, keys in entries.items()}
    for name, keys in sections["luminaires"].items():
        _check_luminaire(f'luminaires."{name}"', keys, file)
    return Mapping(file, folder, sections["materials"], sections["luminaires"])


def _check_luminaire(place: str, keys: dict[str, Any], file: str) -> None:
    unknown = sorted(set(keys) - _OF_LUMINAIRE)
    if unknown:
        expected = ", ".join(sorted(_OF_LUMINAIRE))
        raise input_error(f"{place} has the key {unknown[0]}; expected one of {expected}", file)
    for key in ("keep_body", "skip"):
        if not isinstance(keys.get(key, False), bool):
            raise input_error(f"{place}.{key} is {keys[key]!r}; expected true or false", file)
    if keys.get("skip"):
        return
    if not isinstance(keys.get("photometry"), str):
        message = f"{place} lacks photometry; expected the name of an IES, LDT or TM-33 file"
        raise input_error(message, file)
    if keys.get("position", "auto") not in _POSITIONS:
        message = f'{place}.position is {keys["position"]!r}; expected "auto" or "origin"'
        raise input_error(message, file)
    for key in ("aim", "c0", "offset_m"):
        if key in keys and not _is_vector(keys[key]):
            raise input_error(f"{place}.{key} is {keys[key]!r}; expected [x, y, z]", file)
    _check_axes(place, keys, file)


def _check_axes(place: str, keys: dict[str, Any], file: str) -> None:
    for key in ("aim", "c0"):
        if key in keys and not any(keys[key]):
            raise input_error(f"{place}.{key} is {keys[key]!r}; expected a direction", file)
    x, y, z = keys.get("aim", (0, 0, -1))
    u, v, w = keys.get("c0", (0, 0, 0))
    if "c0" in keys and not any((y * w - z * v, z * u - x * w, x * v - y * u)):
        raise input_error(f"{place}.c0 is along aim; expected another direction", file)


def _is_vector(value: Any) -> bool:
    def is_number(part: Any) -> bool:
        return isinstance(part, (int, float)) and not isinstance(part, bool) and abs(part) < 1e6

    return isinstance(value, (list, tuple)) and len(value) == 3 and all(map(is_number, value))


def _entry(
    entries: dict[str, dict[str, Any]], names: Iterable[str]
) -> tuple[str, dict[str, Any]] | None:
    """Find by the whole name, whatever its case, else by a pattern with ``*``."""
    for name in names:
        folded = name.casefold()
        for key, keys in entries.items():
            if key.casefold() == folded:
                return key, keys
        for key, keys in entries.items():
            pattern = key.casefold().replace("[", "[[]").replace("?", "[?]")
            if "*" in key and fnmatch.fnmatchcase(folded, pattern):
                return key, keys
    return None
