"""What a program took: by the clock, and of the processor."""

import resource
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeVar

Result = TypeVar("Result")


@dataclass(frozen=True)
class Times:
    """`cpu_seconds` are those of all processes that were started, user and system."""

    wall_seconds: float
    cpu_seconds: float

    def plus(self, other: "Times") -> "Times":
        """Both, one after the other."""
        return Times(
            self.wall_seconds + other.wall_seconds, self.cpu_seconds + other.cpu_seconds
        )


@dataclass(frozen=True)
class Timed(Generic[Result]):
    """What came out, and what it took."""

    result: Result
    times: Times


def timed(work: Callable[[], Result]) -> Timed[Result]:
    """Does work of this process and of programs that it waits for."""
    wall, cpu = time.perf_counter(), _cpu_seconds()
    result = work()
    return Timed(result, Times(time.perf_counter() - wall, _cpu_seconds() - cpu))


def _cpu_seconds() -> float:
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(it.ru_utime + it.ru_stime for it in used)
