"""A project as text, and what of it stands on which line.

The loaders know the lines of a project file. Whoever describes a scene in Python never sees that
text, so each line remembers the value that it was made of, and errors name that.
"""

from __future__ import annotations

import math
import os
import re
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from quasilux._errors import input_error

_BARE_KEY = re.compile(r"[A-Za-z0-9_-]+\Z")
_ESCAPES = {"\\": "\\\\", '"': '\\"', "\n": "\\n", "\r": "\\r", "\t": "\\t"}


class ProjectText:
    """A project file that is being written.

    Attributes
    ----------
    lines : list of str
        The text so far.
    origins : list of str
        For each line, what it was made of, as in ``sensors[0]["points"]``; empty where it was made
        of no value.
    """

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.origins: list[str] = []

    @property
    def text(self) -> str:
        """The whole text."""
        return "\n".join([*self.lines, ""])

    def origin(self, line: int | None) -> str:
        """What the line of that number, counted from 1, was made of."""
        return self.origins[line - 1] if line and line <= len(self.origins) else ""

    def heading(self, heading: str, origin: str = "") -> None:
        """Begin a table."""
        self.lines.append(heading)
        self.origins.append(origin)

    def entry(self, key: str, value: object, origin: str) -> None:
        """Add a key to the table.

        Raises
        ------
        InputError
            For a value that stands for nothing in a project file.
        """
        self.lines.append(f"{_key(key)} = {_value(value, origin)}")
        self.origins.append(origin)

    def table(self, heading: str, entries: object, origin: str) -> None:
        """Add a table with all its keys.

        Raises
        ------
        TypeError
            For what is no mapping from text.
        """
        if not isinstance(entries, Mapping):
            raise TypeError(f"{origin} is {type(entries).__name__}; expected a dict of its keys")
        self.heading(heading, origin)
        for key, value in entries.items():
            if not isinstance(key, str):
                raise TypeError(f"{origin} has the key {key!r}; expected text")
            if value is not None:
                self.entry(key, value, f'{origin}["{key}"]')


def quoted(text: str, origin: str) -> str:
    """Return text as a string of TOML."""
    try:
        text.encode()
    except UnicodeEncodeError as error:
        raise input_error(f"{origin} is {text!r}; expected text that UTF-8 can write") from error
    return '"' + "".join(map(_character, text)) + '"'


def _character(character: str) -> str:
    if character in _ESCAPES:
        return _ESCAPES[character]
    code = ord(character)
    return f"\\u{code:04x}" if code < 0x20 or 0x7F <= code < 0xA0 else character


def _key(key: str) -> str:
    return key if _BARE_KEY.match(key) else quoted(key, "a key")


def _value(value: object, origin: str) -> str:
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return _number(float(value), origin)
    if isinstance(value, str):
        return quoted(value, origin)
    if isinstance(value, os.PathLike):
        path: Any = os.fspath(value)
        return quoted(os.fsdecode(path).replace(os.sep, "/"), origin)
    if isinstance(value, np.ndarray):
        return _array(value, origin)
    if isinstance(value, Mapping):
        return _inline_table(value, origin)
    if isinstance(value, Sequence) and not isinstance(value, (bytes, bytearray, memoryview)):
        return "[" + ", ".join(_value(part, f"{origin}[{i}]") for i, part in enumerate(value)) + "]"
    raise TypeError(
        f"{origin} is {type(value).__name__}; expected a number, text, True or False, or a list, "
        "an array or a dict of them"
    )


def _inline_table(value: Mapping[Any, Any], origin: str) -> str:
    for key in value:
        if not isinstance(key, str):
            raise TypeError(f"{origin} has the key {key!r}; expected text")
    known = ((key, part) for key, part in value.items() if part is not None)
    parts = [_key(key) + " = " + _value(part, f'{origin}["{key}"]') for key, part in known]
    return f"{{ {', '.join(parts)} }}"


def _number(value: float, origin: str) -> str:
    if not math.isfinite(value):
        raise input_error(f"{origin} is {value}; expected a finite number")
    return repr(value)


def _array(value: np.ndarray[Any, Any], origin: str) -> str:
    if value.dtype.kind not in "biufU":
        raise TypeError(f"{origin} is an array of {value.dtype}; expected numbers")
    if value.dtype.kind == "f" and not np.isfinite(value).all():
        where = "".join(f"[{index}]" for index in np.argwhere(~np.isfinite(value))[0])
        at = value[~np.isfinite(value)][0]
        raise input_error(f"{origin}{where} is {at}; expected a finite number")
    return _value(value.tolist(), origin)
