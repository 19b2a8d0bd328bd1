"""One scene on many machines, with the bits of one: runs on a Ray cluster.

The driver makes the plan of a run once and keeps its sums. Ranges of photons and
paths, *blocks*, go to the cluster as stateless tasks; what comes of a block is a
function of scene, settings and range, so that blocks may be traced twice, in any
order, by workers that die. The driver looks at the results at the checkpoints of
`quasilux run`, which do not depend on who was fast, and issues blocks until the
tolerance is reached. The result has the bits of :func:`quasilux.simulate`.

Needs the extra ``quasilux[ray]``.
"""

from __future__ import annotations

from quasilux.ray._driver import DEFAULT_IN_FLIGHT, simulate
from quasilux.ray._parts import Parts

__all__ = ["DEFAULT_IN_FLIGHT", "Parts", "simulate"]
