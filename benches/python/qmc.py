"""maturin develop --release -m crates/quasilux-python/Cargo.toml && python benches/python/qmc.py

Scrambled Sobol' points as numpy arrays, here and from SciPy: nanoseconds a coordinate, the engine
made anew each time, medians of rounds in which all take turns. SciPy's scrambling is the linear
one, which is the default here. Nothing else should run meanwhile.
"""

from __future__ import annotations

import argparse
import os
import platform
import random
import statistics
import time
from collections.abc import Callable

import numpy as np
import quasilux
import scipy
from quasilux import qmc
from scipy.stats import qmc as scipy_qmc

DIMENSIONS = (4, 40)
LOGARITHMS = (8, 10, 12, 14, 16, 18, 20)
MOST_COORDINATES = 2**26


def contenders(d: int, m: int) -> dict[str, Callable[[], object]]:
    """The ways to 2^m points of d dimensions."""
    n = 2**m
    return {
        "SciPy": lambda: scipy_qmc.Sobol(d, scramble=True, rng=1).random_base2(m),
        "linear": lambda: qmc.Sobol(d, scramble=True, rng=1).random_base2(m),
        "linear, 1 thread": lambda: qmc.Sobol(d, scramble=True, rng=1).random_base2(m, workers=1),
        "Owen": lambda: qmc.Sobol(d, randomization="owen", rng=1).random_base2(m),
        "Owen, 1 thread": lambda: qmc.Sobol(d, randomization="owen", rng=1).random_base2(
            m, workers=1
        ),
        # What no generator can fall short of: numpy's memory, written once.
        "memory": lambda: np.empty((n, d)).fill(1.0),
    }


def medians(ways: dict[str, Callable[[], object]], seconds: float) -> dict[str, float]:
    """Median times in seconds; rounds in random order until the time is over, at least 7."""
    times: dict[str, list[float]] = {name: [] for name in ways}
    order = random.Random(1)
    end = time.perf_counter() + seconds
    while time.perf_counter() < end or len(times["SciPy"]) < 7:
        for name in order.sample(list(ways), len(ways)):
            start = time.perf_counter()
            ways[name]()
            times[name].append(time.perf_counter() - start)
    return {name: statistics.median(values) for name, values in times.items()}


def main() -> None:
    """Print a table: nanoseconds a coordinate, and in brackets how many times as fast as SciPy."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[2])
    parser.add_argument("--seconds", type=float, default=3.0, help="of each row of the table")
    seconds = parser.parse_args().seconds
    print(
        f"quasilux {quasilux.__version__}, SciPy {scipy.__version__}, numpy {np.__version__},"
        f" Python {platform.python_version()}, {platform.machine()}, {os.cpu_count()} processors\n"
    )
    names = list(contenders(1, 0))
    print("| d | points |", " | ".join(names), "|")
    print("|---" * (len(names) + 2) + "|")
    for d in DIMENSIONS:
        for m in LOGARITHMS:
            if d * 2**m > MOST_COORDINATES:
                continue
            found = medians(contenders(d, m), seconds)
            cells = [
                f"{value / (d * 2**m) * 1e9:.2f}"
                + ("" if name in ("SciPy", "memory") else f" ({found['SciPy'] / value:.1f})")
                for name, value in found.items()
            ]
            print(f"| {d} | 2^{m} |", " | ".join(cells), "|", flush=True)


if __name__ == "__main__":
    main()
