"""maturin develop --release -m crates/quasilux-python/Cargo.toml && python benches/python/leak.py

Memory of a process that makes, simulates and pickles scenes, 10 000 of each: the resident size in
MiB as it goes, and what a call of the second half leaves behind by a straight line through it. The
allocator may take a few MiB more at any moment, once.
"""

from __future__ import annotations

import argparse
import gc
import os
import pickle

import numpy as np
import quasilux

CORNERS = np.array([[x, y, z] for z in (0.0, 2.5) for y in (0.0, 3.0) for x in (0.0, 4.0)])
FACES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (1, 5, 7, 3), (3, 7, 6, 2), (2, 6, 4, 0)]
TRIANGLES = np.array([half for a, b, c, d in FACES for half in ((a, b, c), (a, c, d))])


def call(number: int) -> None:
    """Make a scene, simulate it, and hand both from hand to hand."""
    scene = quasilux.Scene(
        vertices=CORNERS,
        triangles=TRIANGLES,
        materials={"wall": {"reflectance": 0.5}},
        lights=[{"kind": "point", "position": [2, 1.5, 2.2], "intensity_cd": 300}],
        sensors={
            "desk": {
                "kind": "grid",
                "origin": [0.5, 0.5, 0.8],
                "u": [3, 0, 0],
                "v": [0, 2, 0],
                "spacing": 1.0,
                "normal": [0, 0, 1],
            }
        },
    )
    scene = pickle.loads(pickle.dumps(scene))
    result = quasilux.simulate(
        scene,
        samples=1,
        seed=number,
        estimator="path",
        threads=1,
        progress=lambda progress: False,
    )
    result["desk"].replicates_lx.sum()
    result.to_dict()
    if number % 100 == 0:
        pickle.loads(pickle.dumps(result))
    try:
        quasilux.simulate(scene, samples=-1)
    except quasilux.InputError:
        pass


def resident_mib() -> float:
    """Memory that this process has."""
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 2**20


def main() -> None:
    """Call and look."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--calls", type=int, default=10_000)
    calls = parser.parse_args().calls
    numbers, sizes = [], []
    for number in range(calls + 1):
        call(number)
        if number % (calls // 20) == 0:
            gc.collect()
            numbers.append(number)
            sizes.append(resident_mib())
            print(f"{number:6d} calls {sizes[-1]:8.2f} MiB", flush=True)
    kept = np.array(numbers) >= calls / 2
    slope = np.polyfit(np.array(numbers)[kept], np.array(sizes)[kept], 1)[0]
    print(f"{slope * 2**20:.1f} bytes a call")


if __name__ == "__main__":
    main()
