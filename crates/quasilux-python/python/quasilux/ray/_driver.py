"""A run on a cluster, from the driver's side."""

from __future__ import annotations

import dataclasses
import logging
import os
from typing import TYPE_CHECKING, Any, Literal

from quasilux import _native
from quasilux._options import RunOptions
from quasilux._result import Result
from quasilux._simulation import as_scene, tell_remarks, watching

try:
    import ray
except ImportError as error:
    raise ImportError("quasilux.ray needs Ray: pip install 'quasilux[ray]'") from error

from quasilux.ray._cluster import Cluster
from quasilux.ray._parts import Parts

if TYPE_CHECKING:
    from collections.abc import Callable

    from quasilux._native import Progress
    from quasilux._scene import Scene
    from quasilux._simulation import Estimator

logger = logging.getLogger("quasilux.ray")

DEFAULT_IN_FLIGHT = 1024
"""Tasks that are handed to Ray at a time, where nothing else is asked for."""


def simulate(
    scene: Scene | str | os.PathLike[str],
    *,
    rel_tol: float | str | None = None,
    abs_tol_lx: float | None = None,
    unseen_tol: float | str | None = None,
    tolerance_on: Literal["points", "summary"] | None = None,
    interval: Literal["student-t", "certified"] | None = None,
    confidence: float | str | None = None,
    samples: int | None = None,
    rays: int | None = None,
    time_s: float | None = None,
    estimator: Estimator | None = None,
    sequence: str | None = None,
    seed: int | None = None,
    strict: bool = False,
    progress: bool | Callable[[Progress], object] | None = None,
    directory: str | os.PathLike[str] | None = None,
    num_cpus: int = 1,
    in_flight: int = DEFAULT_IN_FLIGHT,
) -> Result:
    """Simulate a scene on a Ray cluster, to the bits of `quasilux.simulate`.

    Connects to the cluster that ``ray.init`` has been called for, or to that of the environment,
    or begins one on this machine. The driver surveys the scene, keeps the sums and looks at the
    checkpoints; photons and paths are traced by tasks of the cluster. Tasks that are lost with
    their process or node are done again, nodes may come and go at any time. Surveys and pilots,
    and photons of maps that all paths end on, are traced by the driver and once more in each
    process; pictures, and steps between two checkpoints that are short, by the driver alone.

    Parameters
    ----------
    scene : Scene or path-like
        A scene, or its project file on the driver's machine. It is shipped to the cluster once.
    rel_tol, abs_tol_lx, unseen_tol, tolerance_on, interval, confidence, samples, rays, time_s
        As in `quasilux.simulate`.
    estimator, sequence, seed, strict, progress
        As in `quasilux.simulate`.
    directory : path-like, optional
        Where the driver keeps what blocks gave. A new driver with the same scene and parameters
        goes on from there; whoever has no more use for it removes it.
    num_cpus : int, default 1
        Processors of a task, and threads that it traces with. Each process has the scene in
        memory, so that large scenes want many threads in few processes.
    in_flight : int, default 1024
        Most tasks that are handed to Ray at a time; no more than these can run.

    Returns
    -------
    Result
        As that of `quasilux.simulate`. Its rays are those of all machines.

    Raises
    ------
    InputError
        When a parameter makes no sense, by itself or for the scene.
    ray.exceptions.RayError
        When the cluster fails as a whole.

    Examples
    --------
    >>> import ray
    >>> _ = ray.init(num_cpus=2)  # doctest: +SKIP
    >>> result = simulate("examples/cube/cube.toml", rel_tol=0.01, seed=1)  # doctest: +SKIP
    """
    for name, value in (("num_cpus", num_cpus), ("in_flight", in_flight)):
        if isinstance(value, bool) or not isinstance(value, int) or value < 1:
            raise ValueError(f"{name} is {value!r}; expected a whole number of 1 or more")
    scene = as_scene(scene)
    options = RunOptions(
        rel_tol=rel_tol,
        abs_tol_lx=abs_tol_lx,
        unseen_tol=unseen_tol,
        tolerance_on=tolerance_on,
        interval=interval,
        confidence=confidence,
        samples=samples,
        rays=rays,
        time_s=time_s,
        estimator=estimator,
        sequence=sequence,
        seed=seed,
        strict=strict,
    )
    try:
        run = _native.identify_run(scene._native, options)
        if not ray.is_initialized():
            ray.init()
        parts = None if directory is None else Parts(directory, run[:32])
        cluster = Cluster(
            scene._native.to_bundle(),
            dataclasses.replace(options, threads=num_cpus),
            run=run,
            parts=parts,
            num_cpus=num_cpus,
            in_flight=in_flight,
        )
        with watching(progress) as callback:
            told = _Told(callback)
            outcome = _native.simulate(scene._native, options, told, cluster)
    except _native.InputError as error:
        raise scene._origins.error(error) from None
    logger.info("done: %d blocks traced, %d found on disk", cluster.traced, cluster.found)
    tell_remarks(outcome)
    return Result(outcome, scene._origins)


class _Told:
    """Writes checkpoints to the log, and passes progress on."""

    def __init__(self, callback: Callable[[Progress], object] | None) -> None:
        self._callback = callback

    def __call__(self, progress: Progress) -> Any:
        if progress.is_checkpoint:
            width = progress.largest_relative_half_width
            known = "unknown" if width is None else f"{100 * width:.3f} %"
            logger.info(
                "checkpoint at %d samples, %d rays, %.1f s: largest half-width %s",
                progress.samples, progress.rays, progress.seconds, known,
            )
        return None if self._callback is None else self._callback(progress)
