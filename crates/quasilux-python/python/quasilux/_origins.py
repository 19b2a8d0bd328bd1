"""Where values of Python code went, to name them in what is said of a scene."""

from __future__ import annotations

import dataclasses
import re
from typing import TYPE_CHECKING

from quasilux._errors import input_error

if TYPE_CHECKING:
    from quasilux._finding import Finding
    from quasilux._native import InputError


@dataclasses.dataclass(frozen=True)
class Origins:
    """What the lines of a text were made of that nobody has seen.

    Attributes
    ----------
    name : str
        What messages call the text; empty where the project is a file.
    lines : tuple of str
        For each line the value that it was made of.
    names : tuple of str
        Names of geometry and of files that are in memory.
    """

    name: str = ""
    lines: tuple[str, ...] = ()
    names: tuple[str, ...] = ()

    def _of_line(self, line: int | None) -> str:
        return self.lines[line - 1] if line and line <= len(self.lines) else ""

    def error(self, error: InputError) -> InputError:
        """Return an error that names the value and not the line."""
        message = error.message or str(error)
        if not self.name:
            return error
        if error.file == self.name:
            origin = self._of_line(error.line)
            return input_error(f"{origin}: {message}" if origin else message)
        if error.file in self.names and error.line is None:
            return input_error(f"{error.file}: {message}")
        return error

    def text(self, text: str) -> str:
        """Return a warning that names the value and not the line."""
        if not self.name:
            return text
        found = re.match(re.escape(self.name) + r"(?::(\d+):\d+)?: ", text)
        if found is None:
            return text
        origin = self._of_line(int(found[1] or 0))
        return f"{origin}: {text[found.end() :]}" if origin else text[found.end() :]

    def report(self, text: str) -> str:
        """Return a text of many lines that names values and no lines of the project."""
        if not self.name:
            return text
        place = re.compile(rf"(?<!\S){re.escape(self.name)}:(\d+):\d+: ")
        return place.sub(lambda found: f"{self._of_line(int(found[1])) or self.name}: ", text)

    def finding(self, finding: Finding) -> Finding:
        """Return a finding that names the value and not the line."""
        if not self.name or finding.file != self.name:
            return finding
        origin = self._of_line(finding.line) or self.name
        return dataclasses.replace(finding, file=origin, line=None, column=None)
