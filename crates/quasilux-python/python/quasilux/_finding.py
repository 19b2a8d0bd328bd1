"""What is probably wrong with a scene."""

from __future__ import annotations

import dataclasses
import json
from collections.abc import Iterator
from typing import Any


@dataclasses.dataclass(frozen=True)
class Finding:
    """Something in a scene that is probably wrong.

    Attributes
    ----------
    check : str
        The check that found it.
    message : str
        What is odd.
    cure : str
        What would mend it.
    file : str
        The file to mend, as messages name it.
    line, column : int or None
        The place in it, counted from 1.
    position_m : tuple of float or None
        Where in the scene, in m.
    """

    check: str
    message: str
    cure: str
    file: str
    line: int | None
    column: int | None
    position_m: tuple[float, float, float] | None

    @classmethod
    def _from_entry(cls, entry: dict[str, Any]) -> Finding:
        position = entry["position"]
        return cls(
            check=entry["check"],
            message=entry["message"],
            cure=entry["cure"],
            file=entry["file"],
            line=entry["line"],
            column=entry["column"],
            position_m=None if position is None else tuple(position),
        )

    def __str__(self) -> str:
        place = ":".join(str(part) for part in (self.file, self.line, self.column) if part)
        return f"{place}: {self.message}; {self.cure} [{self.check}]"


@dataclasses.dataclass(frozen=True)
class Check:
    """What a check of a scene found: a sequence of findings.

    Attributes
    ----------
    findings : tuple of Finding
        What is probably wrong; empty where nothing is.
    warnings : tuple of str
        Oddities that the loaders lived with.
    text : str
        What was understood of the scene, and all of that, as ``quasilux check`` prints it.
    """

    findings: tuple[Finding, ...]
    warnings: tuple[str, ...]
    text: str = dataclasses.field(repr=False)

    @classmethod
    def _from_document(cls, document: str, text: str) -> Check:
        parsed = json.loads(document)
        findings = tuple(Finding._from_entry(entry) for entry in parsed["findings"])
        return cls(findings, tuple(parsed["warnings"]), text)

    def __len__(self) -> int:
        return len(self.findings)

    def __iter__(self) -> Iterator[Finding]:
        return iter(self.findings)

    def __getitem__(self, index: int) -> Finding:
        return self.findings[index]

    def __str__(self) -> str:
        return self.text
