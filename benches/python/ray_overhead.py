"""python benches/python/ray_overhead.py [PROJECT] [REL_TOL]: two workers of Ray against two threads.

Runs `quasilux.simulate` on two threads and `quasilux.ray.simulate` on two workers of this machine
in turn, and prints the median of the ratios of their times. Processes of Ray have begun and have
the scene before the first run counts, as on a cluster that is there.
"""

from __future__ import annotations

import os
import statistics
import sys
import time
from pathlib import Path

os.environ["RAY_AUTH_MODE"] = "disabled"

import numpy as np  # noqa: E402
import ray  # noqa: E402

import quasilux  # noqa: E402
import quasilux.ray  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
PAIRS = 5


def main() -> None:
    project = sys.argv[1] if len(sys.argv) > 1 else str(ROOT / "examples/office/office.toml")
    options = {"rel_tol": float(sys.argv[2]) if len(sys.argv) > 2 else 0.002}
    ray.init(address="local", num_cpus=2, include_dashboard=False, log_to_driver=False)
    scene = quasilux.load(project)
    quasilux.ray.simulate(scene, **options)
    ratios = []
    for pair in range(PAIRS):
        runs = [
            lambda: quasilux.simulate(scene, threads=2, **options),
            lambda: quasilux.ray.simulate(scene, **options),
        ]
        seconds, results = [0.0, 0.0], [None, None]
        # Whoever is first may find a faster machine.
        for which in (0, 1) if pair % 2 == 0 else (1, 0):
            start = time.perf_counter()
            results[which] = runs[which]()
            seconds[which] = time.perf_counter() - start
        name = next(iter(results[0]))
        assert np.array_equal(results[0][name].illuminance_lx, results[1][name].illuminance_lx)
        ratios.append(seconds[1] / seconds[0])
        print(f"threads {seconds[0]:.2f} s, Ray {seconds[1]:.2f} s, ratio {ratios[-1]:.3f}")
    print(f"median of the ratios: {statistics.median(ratios):.3f}")


if __name__ == "__main__":
    main()
