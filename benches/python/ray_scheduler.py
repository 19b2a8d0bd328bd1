"""python benches/python/ray_scheduler.py: what the scheduler of quasilux.ray costs by itself.

1. The time for 10^4 blocks that take none: the cost s of a block in the driver and in Ray.
2. A model of a work of n blocks that take t each on c cores,

       T = max(n t / c, n s) + t + o,

   whose parts are the cores, the driver, the last block and the start of the work; and its check
   against workers that only sleep.
3. What it says for 10 to 10 000 cores and blocks of two lengths.
"""

from __future__ import annotations

import math
import os
import statistics
import time


os.environ["RAY_AUTH_MODE"] = "disabled"

import ray  # noqa: E402

from quasilux.ray._cluster import Cluster  # noqa: E402

BLOCKS = 10_000
PAYLOAD = bytes(8192)


def sleeping(
    run: str, order: list, frame: bytes, start: int, end: int
) -> bytes:
    """Sleep as many microseconds as the frame says, and give as many bytes as a block does."""
    time.sleep(int(frame) * 1e-6)
    return PAYLOAD


class Sleepers(Cluster):
    function = staticmethod(sleeping)


def seconds(blocks: int, block_s: float) -> float:
    """The time for some work."""
    workers = Sleepers(b"", [], run="bench", parts=None, num_cpus=1, in_flight=512)
    frame = str(round(block_s * 1e6)).encode()
    start = time.perf_counter()
    answers = workers.trace(frame, [(i, i + 1) for i in range(blocks)])
    count = sum(answer is not None for answer in answers)
    assert count == blocks
    return time.perf_counter() - start


def model(blocks: int, block_s: float, cores: int, cost_s: float, start_s: float) -> float:
    return max(math.ceil(blocks / cores) * block_s, blocks * cost_s) + start_s


def main() -> None:
    cores = 32
    ray.init(address="local", num_cpus=cores, include_dashboard=False, log_to_driver=False)
    # Processes start with the first tasks, and some of them late.
    for _ in range(2):
        seconds(4 * cores, 0.5)
    costs = [seconds(BLOCKS, 0.0) / BLOCKS for _ in range(3)]
    cost_s = statistics.median(costs)
    print(f"cost of a block: {1e3 * cost_s:.2f} ms (of {BLOCKS} blocks, median of 3; "
          f"{1e3 * min(costs):.2f} to {1e3 * max(costs):.2f})")
    start_s = statistics.median(seconds(1, 0.0) for _ in range(9))
    print(f"start of a work: {1e3 * start_s:.1f} ms")
    print("\nworkers that sleep, on " + str(cores) + " cores that are none:")
    print("blocks  block s  model s  measured s")
    for blocks, block_s in [(320, 0.5), (640, 0.25), (640, 0.1), (2000, 0.02)]:
        expected = model(blocks, block_s, cores, cost_s, start_s)
        print(f"{blocks:6}  {block_s:7}  {expected:7.2f}  {seconds(blocks, block_s):10.2f}")
    print("\n10 000 blocks of a checkpoint: share of the cores that trace, by the model")
    print("cores   " + "".join(f"blocks of {t:g} s  " for t in (0.5, 2.0, 8.0)))
    for many in (10, 100, 1000, 10_000):
        shares = []
        for block_s in (0.5, 2.0, 8.0):
            took = model(BLOCKS, block_s, many, cost_s, start_s)
            shares.append(f"{BLOCKS * block_s / many / took:15.0%}  ")
        print(f"{many:6}  " + "".join(shares))


if __name__ == "__main__":
    main()
