"""Years of hours: begun."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING

from quasilux import _native
from quasilux._options import YearOptions
from quasilux._simulation import as_scene, watching
from quasilux._year import Year

if TYPE_CHECKING:
    from collections.abc import Callable

    from quasilux._native import YearProgress
    from quasilux._scene import Scene


def annual(
    scene: Scene | str | os.PathLike[str],
    *,
    rel_tol: float | str | None = None,
    abs_tol_lx: float | None = None,
    confidence: float | str | None = None,
    samples: int | None = None,
    occupied_h: tuple[float, float] | None = None,
    seed: int | None = None,
    threads: int | None = None,
    progress: bool | Callable[[YearProgress], object] | None = None,
) -> Year:
    """Simulate the daylight of a year, hour by hour, by the weather file of a scene.

    Lamps are off, and blinds move as the scene says. The result has the bits that ``quasilux
    annual`` writes, whatever the number of threads. Python's other threads go on meanwhile.

    Parameters
    ----------
    scene : Scene or path-like
        A scene with a weather file, or its project file.
    rel_tol : float or str, default 0.02
        Wanted root mean square over the hours of half-width over value, at every sensor point, as
        in 0.02 or ``"2%"``.
    abs_tol_lx : float, default 1.0
        Half-width in lx that is enough in any hour.
    confidence : float or str, optional
        Confidence level of the intervals, as in 0.95.
    samples : int, optional
        Paths of each sensor point in each replicate, at most.
    occupied_h : tuple of float, optional
        From when to when people are there, in h by the clock of the site; (8, 18) where neither
        this nor the scene says.
    seed : int, optional
        Seed of all randomisations.
    threads : int, default all cores
        Threads that work on it.
    progress : bool or callable, optional
        True shows on stderr how far the year is. A callable gets a `YearProgress` about ten times a
        second, in the thread of the caller. To stop the year it returns True or raises
        StopIteration: the year ends with the points that are over. Any other exception ends it,
        too, and is raised then.

    Returns
    -------
    Year
        The hours and measures of each sensor, by its name.

    Raises
    ------
    InputError
        When a parameter makes no sense, or the scene has no weather file or no sensors.
    KeyboardInterrupt
        After Ctrl-C, once the year has ended; after a second Ctrl-C at once.

    See Also
    --------
    simulate : one moment.

    Examples
    --------
    >>> year = annual("examples/daylight-office/year.toml", samples=4, abs_tol_lx=100)
    >>> list(year), len(year.calendar)
    (['workplane'], 8760)
    >>> plane = year["workplane"]
    >>> noon = (year.calendar.month == 6) & (year.calendar.middle_h == 12.5)
    >>> plane.illuminance_lx.shape, plane.illuminance_lx[..., noon].shape
    ((8, 6, 8760), (8, 6, 30))
    >>> plane.sda.low <= plane.sda.value <= plane.sda.high
    True
    """
    options = YearOptions(
        rel_tol=rel_tol,
        abs_tol_lx=abs_tol_lx,
        confidence=confidence,
        samples=samples,
        occupied_h=occupied_h,
        seed=seed,
        threads=threads,
    )
    scene = as_scene(scene)
    with watching(progress) as callback:
        try:
            entry = _native.annual(scene._native, options, callback)
        except _native.InputError as error:
            raise scene._origins.error(error) from None
    shapes = {name: place.shape for name, place in scene.sensors.items()}
    return Year(entry, shapes, scene._origins)
