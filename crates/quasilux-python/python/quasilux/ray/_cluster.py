"""Blocks on a Ray cluster: which tasks there are, and what comes of them when."""

from __future__ import annotations

import hashlib
import logging
from collections import deque
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
import ray

from quasilux import _native
from quasilux._options import RunOptions
from quasilux.ray._parts import Parts

logger = logging.getLogger("quasilux.ray")

# Frames up to this many bytes go with each task, larger ones through the object store.
_INLINE_BYTES = 1 << 14

# Tracers of this process, by the run that each is for, the last used one last: surveys and pilots
# are made once.
_tracers: dict[str, _native.BlockTracer] = {}
_MAX_TRACERS = 2

# How often a driver that waits looks whether it is to stop.
_TICK_S = 1.0


def _trace(
    run: str,
    order: list[ray.ObjectRef],
    frame: bytes | list[ray.ObjectRef],
    start: int,
    end: int,
) -> bytes:
    """Trace a block in a process of the cluster; stateless but for what it need not make anew.

    References in lists are fetched where they are needed, and so once a process or a frame.
    """
    content: bytes = ray.get(frame[0]).tobytes() if isinstance(frame, list) else frame
    for is_last in (False, True):
        tracer = _tracers.pop(run, None)
        if tracer is None:
            while len(_tracers) >= _MAX_TRACERS:
                del _tracers[next(iter(_tracers))]
            bundle, options = ray.get(order[0])
            tracer = _native.BlockTracer(bundle.tobytes(), options, run)
        try:
            traced = tracer.trace(content, start, end)
        except (_native.StateError, RuntimeError):
            # Maps that have grown too far for this block, or a thread that is gone: another tracer
            # begins anew.
            if is_last:
                raise
        else:
            _tracers[run] = tracer
            return traced
    raise AssertionError("the loop returns or raises")


class Cluster:
    """Has blocks traced by the cluster that Ray is connected to.

    Parameters
    ----------
    bundle
        The scene in bytes, as it is pickled.
    options
        The options of the run, with the threads of a task.
    run
        What tells this run from others.
    parts
        Where to keep what blocks gave; None for nowhere.
    num_cpus
        Processors of a task, for as many threads as the options say.
    in_flight
        Most tasks that are handed to Ray at a time.
    """

    function = staticmethod(_trace)
    """What a task does; benchmarks put another in its place."""

    def __init__(
        self,
        bundle: bytes,
        options: RunOptions,
        *,
        run: str,
        parts: Parts | None,
        num_cpus: int,
        in_flight: int,
    ) -> None:
        # An array, so that processes of a node read the same memory.
        self._order = ray.put((np.frombuffer(bundle, dtype=np.uint8), options))
        self._run = run
        self._parts = parts
        self._in_flight = in_flight
        self._task: Any = ray.remote(num_cpus=num_cpus, max_retries=-1)(self.function)
        self.traced = 0
        """Blocks that were traced."""
        self.found = 0
        """Blocks that were on disk already."""

    def trace(
        self, frame: bytes, blocks: Sequence[tuple[int, int]]
    ) -> Iterator[tuple[int, bytes] | None]:
        """Yield the number of each block with what it gave, as they come; None where none do."""
        name = hashlib.sha256(frame).hexdigest()[:32]
        waiting: deque[int] = deque()
        for number, (start, end) in enumerate(blocks):
            known = self._parts.read(name, start, end) if self._parts else None
            if known is None:
                waiting.append(number)
            else:
                self.found += 1
                yield number, known
        logger.info("%d blocks, %d of them known", len(blocks), len(blocks) - len(waiting))
        sent: bytes | list[ray.ObjectRef] = frame
        if waiting and len(frame) > _INLINE_BYTES:
            sent = [ray.put(np.frombuffer(frame, dtype=np.uint8))]
        running: dict[ray.ObjectRef, int] = {}
        try:
            while waiting or running:
                while waiting and len(running) < self._in_flight:
                    number = waiting.popleft()
                    start, end = blocks[number]
                    task = self._task.remote(
                        self._run, [self._order], sent, start, end
                    )
                    running[task] = number
                done, _ = ray.wait(list(running), num_returns=1, timeout=_TICK_S)
                if not done:
                    yield None
                    continue
                # What else is there already costs no further wait.
                more, _ = ray.wait(list(running), num_returns=len(running), timeout=0)
                for task in {*done, *more}:
                    number = running.pop(task)
                    payload = ray.get(task)
                    start, end = blocks[number]
                    if self._parts:
                        self._parts.write(name, start, end, payload)
                    self.traced += 1
                    yield number, payload
        finally:
            for task in running:
                ray.cancel(task, force=False)
