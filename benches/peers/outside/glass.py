"""A pane of absorbing glass by angle: what Radiance's `glass` computes, as a table for quasilux.

Inner reflections are summed, and the two polarisations are kept apart.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

ETA = 1.52
"""The index that Radiance takes where none is given."""

ANGLES_DEG = [*range(60), *(60 + i / 4 for i in range(121))]


@dataclass(frozen=True)
class Shares:
    """What goes through and what is mirrored."""

    transmittance: float
    reflectance: float


@dataclass(frozen=True)
class Glass:
    """`transmissivity` is what one way through the glass leaves at normal incidence."""

    transmissivity: float

    name = "clear glass"

    def shares(self, angle_deg: float) -> Shares:
        """At an angle of incidence."""
        outer = float(np.cos(np.radians(angle_deg)))
        inner = float(np.sqrt(1 - (1 - outer**2) / ETA**2))
        once = self.transmissivity ** (1 / inner)
        across = ((outer - ETA * inner) / (outer + ETA * inner)) ** 2
        along = ((inner - ETA * outer) / (inner + ETA * outer)) ** 2
        through = [(1 - r) ** 2 * once / (1 - (r * once) ** 2) for r in (across, along)]
        mirrored = [r * (1 + once * t) for r, t in zip((across, along), through, strict=True)]
        return Shares(sum(through) / 2, sum(mirrored) / 2)

    def project(self, folder: Path) -> str:
        """A material of a project file of quasilux."""
        del folder
        rows = [(angle, self.shares(angle)) for angle in ANGLES_DEG]
        through = ", ".join(f"[{angle}, {it.transmittance:.7f}]" for angle, it in rows)
        mirrored = ", ".join(f"[{angle}, {it.reflectance:.7f}]" for angle, it in rows)
        return f'{{ kind = "pane", transmittance = [{through}], reflectance = [{mirrored}] }}'

    def radiance(self, name: str, folder: Path) -> str:
        """A material of Radiance."""
        del folder
        return f"void glass {name} 0 0 3 {' '.join(3 * [str(self.transmissivity)])}"
