"""python benches/python/ray_chaos.py [RUNS]: kills tasks, processes, nodes and drivers at random.

Each run simulates the office on a local cluster of four nodes of Ray in a driver process of its
own, while processes of the cluster that trace blocks, whole nodes (a new one takes the place of
each) and the driver itself (a new one goes on from the parts on disk) are killed at random times.
Every run has to end with the bits of `quasilux.simulate`.
"""

from __future__ import annotations

import argparse
import json
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROJECT = ROOT / "examples/office/office.toml"

DRIVER = """
import json, sys
import ray, quasilux, quasilux.ray
address, project, parts, out, seed, rel_tol = sys.argv[1:]
ray.init(address=address, log_to_driver=False)
result = quasilux.ray.simulate(
    quasilux.load(project), rel_tol=float(rel_tol), seed=int(seed), directory=parts)
bits = {name: [float(x).hex() for part in (sensor.illuminance_lx, sensor.half_width_lx)
               for x in part.ravel()] for name, sensor in result.items()}
open(out, "w").write(json.dumps(bits))
"""


def bits(result) -> dict[str, list[str]]:
    """Every value and half-width of a result, in hexadecimal digits."""
    return {
        name: [
            float(x).hex()
            for part in (sensor.illuminance_lx, sensor.half_width_lx)
            for x in part.ravel()
        ]
        for name, sensor in result.items()
    }


def worker_processes() -> list[int]:
    """Processes of Ray that trace blocks."""
    found = []
    for folder in Path("/proc").iterdir():
        if not folder.name.isdigit():
            continue
        try:
            name = (folder / "cmdline").read_bytes().split(b"\0")[0]
        except OSError:
            continue
        if name.startswith(b"ray::_trace"):
            found.append(int(folder.name))
    return found


def end_session(name: str) -> None:
    """Kill all processes of a session of Ray; those that trace end with them."""
    for folder in Path("/proc").glob("[0-9]*"):
        try:
            words = (folder / "cmdline").read_bytes()
        except OSError:
            continue
        if name.encode() in words and int(folder.name) != os.getpid():
            kill(int(folder.name))


def kill(process: int) -> bool:
    try:
        os.kill(process, signal.SIGKILL)
    except ProcessLookupError:
        return False
    return True


class Chaos:
    """A cluster, a run on it, and what is killed meanwhile."""

    def __init__(self, seed: int, rel_tol: float) -> None:
        self.random = random.Random(seed)
        self.seed, self.rel_tol = seed, rel_tol
        self.killed = {"task": 0, "node": 0, "driver": 0}

    def start_driver(self, address: str, folder: str) -> subprocess.Popen[bytes]:
        places = [str(PROJECT), f"{folder}/parts", f"{folder}/result.json"]
        words = [address, *places, str(self.seed), str(self.rel_tol)]
        # Ray tells of every process that died, and waits where nobody reads that.
        return subprocess.Popen(
            [sys.executable, "-c", DRIVER, *words],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )

    def run(self) -> dict[str, list[str]]:
        from ray.cluster_utils import Cluster

        cluster = Cluster(initialize_head=True, head_node_args={"num_cpus": 0})
        nodes = [cluster.add_node(num_cpus=1) for _ in range(3)]
        try:
            with tempfile.TemporaryDirectory() as folder:
                driver = self.start_driver(cluster.address, folder)
                while driver.poll() is None:
                    time.sleep(self.random.uniform(1.0, 6.0))
                    choice = self.random.random()
                    if choice < 0.6 and (processes := worker_processes()):
                        self.killed["task"] += kill(self.random.choice(processes))
                    elif choice < 0.8:
                        node = nodes.pop(self.random.randrange(len(nodes)))
                        cluster.remove_node(node, allow_graceful=False)
                        nodes.append(cluster.add_node(num_cpus=1))
                        self.killed["node"] += 1
                    elif self.killed["driver"] < 3 and driver.poll() is None:
                        driver.kill()
                        driver.wait()
                        self.killed["driver"] += 1
                        driver = self.start_driver(cluster.address, folder)
                if driver.returncode != 0:
                    raise RuntimeError(f"the driver ended with {driver.returncode}")
                return json.loads(Path(folder, "result.json").read_text())
        finally:
            # `Cluster.shutdown` waits for processes that nobody will see end.
            end_session(Path(cluster.head_node.get_session_dir_path()).name)


def main() -> int:
    import quasilux

    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("runs", type=int, nargs="?", default=20)
    parser.add_argument("--rel-tol", type=float, default=0.004)
    arguments = parser.parse_args()
    os.environ["RAY_AUTH_MODE"] = "disabled"
    scene = quasilux.load(PROJECT)
    same = 0
    for seed in range(1, arguments.runs + 1):
        expected = bits(quasilux.simulate(scene, rel_tol=arguments.rel_tol, seed=seed))
        chaos = Chaos(seed, arguments.rel_tol)
        start = time.monotonic()
        is_same = chaos.run() == expected
        same += is_same
        took = time.monotonic() - start
        verdict = "the same bits" if is_same else "OTHER BITS"
        print(f"run {seed}: {verdict} after {took:.0f} s, killed {chaos.killed}", flush=True)
    print(f"{same} of {arguments.runs} runs have the same bits")
    return 0 if same == arguments.runs else 1


if __name__ == "__main__":
    sys.exit(main())
