"""Runs: begun, and gone on with."""

from __future__ import annotations

import os
import warnings
from typing import TYPE_CHECKING, Any, Literal

from quasilux import _native
from quasilux._options import ResumeOptions, RunOptions
from quasilux._origins import Origins
from quasilux._scene import Scene, load

if TYPE_CHECKING:
    from collections.abc import Callable

    from quasilux._native import Outcome, Progress
    from quasilux._result import Result

    Callback = Callable[[Progress], object]
    Estimator = Literal["auto", "photon", "path", "bidirectional", "bidirectional-map"]


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
    threads: int | None = None,
    strict: bool = False,
    progress: bool | Callback | None = None,
    checkpoint: str | os.PathLike[str] | None = None,
    checkpoint_every_s: float | None = None,
) -> Result:
    """Simulate a scene until every sensor point is known to the wanted tolerance.

    All parameters go before what the scene asks for itself. The result has the bits that
    ``quasilux run`` writes, whatever the number of threads. Python's other threads go on
    meanwhile.

    Parameters
    ----------
    scene : Scene or path-like
        A scene, or its project file.
    rel_tol : float or str, optional
        Wanted half-width of each interval over its value, as in 0.01 or ``"1%"``.
    abs_tol_lx : float, optional
        Half-width in lx that is enough whatever the value.
    unseen_tol : float or str, optional
        Light that no sample met over the value, as in 0.05 or ``"5%"``, that is little enough, of
        estimators that bound it; ``"off"`` does not wait for it. No less than `rel_tol` is asked.
    tolerance_on : {"points", "summary"}, optional
        What has to reach the tolerance: every sensor point, or the average of every sensor.
    interval : {"student-t", "certified"}, optional
        Which intervals are reported: Student's t, or also limits that hold for any number of
        samples.
    confidence : float or str, optional
        Confidence level of the intervals, as in 0.95.
    samples : int, optional
        Stop after this many indices in each replicate: photons, and paths for each sensor point.
    rays : int, optional
        Stop before more rays are traced.
    time_s : float, optional
        Stop after this time in s, at the last completed checkpoint.
    estimator, sequence : str, optional
        How light is followed, and the points that drive it.
    seed : int, optional
        Seed of all randomisations.
    threads : int, default all cores
        Threads that work on it.
    strict : bool, default False
        Refuse a scene in which something is probably wrong.
    progress : bool or callable, optional
        True shows on stderr how far the run is. A callable gets a `Progress` about ten times a
        second, and at every checkpoint one with the values so far, in the thread of the caller.
        To stop the run it returns True or raises StopIteration: the run ends with what the last
        checkpoint has, at a checkpoint with that. Any other exception ends the run, too, and is
        raised then.
    checkpoint : path-like, optional
        Keep the run in this file while it goes, for `resume`; a scene that is in no project file
        is kept beside it, in FILE.scene.
    checkpoint_every_s : float, default 5.0
        How often it is kept, at most, in s.

    Returns
    -------
    Result
        Values with their intervals, by the name of the sensor.

    Raises
    ------
    InputError
        When a parameter makes no sense, by itself or for the scene.
    KeyboardInterrupt
        After Ctrl-C, once the run has ended with its last checkpoint, which is kept where one was
        asked for; after a second Ctrl-C at once.

    See Also
    --------
    resume : go on with a run that was kept.

    Examples
    --------
    >>> result = simulate("examples/cube/cube.toml", rel_tol=0.05, samples=64, seed=1)
    >>> result["wall"].illuminance_lx.shape
    (10, 10)

    A callback that ends the run at the first checkpoint:

    >>> result = simulate("examples/cube/cube.toml", progress=lambda p: p.is_checkpoint)
    >>> result.samples, result.stopped
    (1, 'callback')
    """
    from quasilux._result import Result

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
        threads=threads,
        strict=strict,
        checkpoint=checkpoint,
        checkpoint_every_s=checkpoint_every_s,
    )
    scene = as_scene(scene)
    with watching(progress) as callback:
        try:
            outcome = _native.simulate(scene._native, options, callback)
        except _native.InputError as error:
            raise scene._origins.error(error) from None
    tell_remarks(outcome)
    return Result(outcome, scene._origins)


def resume(
    checkpoint: str | os.PathLike[str],
    *,
    scene: Scene | str | os.PathLike[str] | None = None,
    time_s: float | None = None,
    threads: int | None = None,
    progress: bool | Callback | None = None,
    checkpoint_every_s: float | None = None,
) -> Result:
    """Go on with a run that was kept, to the bits that it would have had.

    Parameters
    ----------
    checkpoint : path-like
        What `simulate`, or ``quasilux run --checkpoint``, kept; the run goes on keeping itself
        there.
    scene : Scene or path-like, default that of the run
        The scene, which has to be the one that the run was begun with.
    time_s : float, optional
        Stop after this time in s from now on, at the last completed checkpoint.
    threads, progress, checkpoint_every_s
        As in `simulate`.

    Returns
    -------
    Result
        As that of `simulate`.

    Raises
    ------
    InputError
        When there is no checkpoint of this version, or the scene is another one now.
    KeyboardInterrupt
        As by `simulate`.
    """
    from quasilux._result import Result

    options = ResumeOptions(
        time_s=time_s, threads=threads, checkpoint_every_s=checkpoint_every_s
    )
    found = None if scene is None else as_scene(scene)
    origins = Origins() if found is None else found._origins
    native = None if found is None else found._native
    with watching(progress) as callback:
        outcome = _native.resume(os.fspath(checkpoint), options, native, callback)
    tell_remarks(outcome)
    return Result(outcome, origins)


def as_scene(scene: Scene | str | os.PathLike[str]) -> Scene:
    """Return a scene, loaded where it is a path."""
    if isinstance(scene, Scene):
        return scene
    if isinstance(scene, (str, os.PathLike)):
        return load(scene)
    raise TypeError(f"scene is {type(scene).__name__}; expected a Scene or a path")


def watching(progress: bool | Callable[[Any], object] | None) -> Any:
    """Return a context in which a run calls back as its caller wants."""
    from quasilux._progress import Bar, Silent

    if progress is True:
        return Bar()
    if progress is None or progress is False:
        return Silent(None)
    if not callable(progress):
        raise TypeError(f"progress is {progress!r}; expected True, or a function of a Progress")
    return Silent(progress)


def tell_remarks(outcome: Outcome) -> None:
    """Warn of what nobody was told while a run went."""
    for remark in outcome.remarks:
        warnings.warn(remark, RuntimeWarning, stacklevel=3)
