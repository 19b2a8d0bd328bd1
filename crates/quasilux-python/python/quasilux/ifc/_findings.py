"""Parts of a model that a project has otherwise, or not at all."""

from __future__ import annotations

import dataclasses

# Places that a finding names; the others are counted.
_SHOWN_PLACES = 3


@dataclasses.dataclass(frozen=True)
class Finding:
    """Part of a model that the project has otherwise, or not at all.

    Attributes
    ----------
    message : str
        What was done, and what else could be done.
    places : tuple of str
        Where, by class, name and GlobalId; empty for what holds for the whole model.
    """

    message: str
    places: tuple[str, ...] = ()

    @property
    def count(self) -> int:
        """How many parts of the model it is about."""
        return max(len(self.places), 1)

    def __str__(self) -> str:
        if not self.places:
            return self.message
        if len(self.places) == 1:
            return f"{self.places[0]}: {self.message}"
        shown = ", ".join(self.places[:_SHOWN_PLACES])
        begin = "for example at " if self.count > _SHOWN_PLACES else "at "
        return f"{self.message} ({self.count} times, {begin}{shown})"


class Findings:
    """Findings that are being collected: those with the same message become one."""

    def __init__(self) -> None:
        self._places: dict[str, dict[str, None]] = {}

    def note(self, message: str, place: str = "") -> None:
        """Add a finding, or a place to one that is there."""
        places = self._places.setdefault(message, {})
        if place:
            places[place] = None

    def all(self) -> tuple[Finding, ...]:
        """Return all findings in the order in which they were made."""
        return tuple(Finding(message, tuple(at)) for message, at in self._places.items())
