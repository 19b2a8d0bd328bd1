"""What a reader of results must know of them."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any


@dataclasses.dataclass(frozen=True)
class Caveat:
    """A reason to read values with care.

    Attributes
    ----------
    kind : str
        What it is, such as ``"no_interval"``, ``"few_samples"``, ``"caustics"`` or
        ``"paths_terminated"``: the same in all versions.
    message : str
        The sentence for people, which is one of `Result.warnings`.
    figures : mapping of str
        Its figures by their names, such as ``points``, ``sensor`` or ``camera``.

    Examples
    --------
    >>> import quasilux
    >>> cube = "examples/cube/cube.toml"
    >>> result = quasilux.simulate(cube, estimator="bidirectional-map", samples=64)
    >>> [caveat.kind for caveat in result.caveats]
    ['means_over_map_elements']
    """

    kind: str
    message: str
    figures: Mapping[str, Any]

    @classmethod
    def _from_entry(cls, entry: dict[str, Any]) -> Caveat:
        figures = {name: entry[name] for name in entry if name not in ("kind", "message")}
        return cls(entry["kind"], entry["message"], figures)

    def __str__(self) -> str:
        return self.message
