#!/usr/bin/env python3
"""Examples computed by quasilux, exported, and computed again by Radiance, as a Markdown table.

    python3 -m venv venv && venv/bin/pip install pyradiance==1.3.1
    venv/bin/python validation/radiance/round_trip.py [PROJECT.toml ...]

`rtrace` runs several times without a cache, so that its runs tell how far they differ. A value agrees
where the difference is within both half-widths (95 %) and an allowance of 1 % for what Radiance
has otherwise: materials that are only near, colours, lights that reflect, and its own bias. The
table has the means over the points of each project, and the largest difference over what is
allowed.
"""

import json
import math
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile

import pyradiance

RADIANCE = pathlib.Path(pyradiance.__file__).parent
ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = [
    "cube/cube.toml", "cornell/cornell.toml", "corridor/corridor.toml", "office/office.toml",
    "daylight-office/overcast.toml",
]
LUMENS_PER_WATT = 179.0
WEIGHTS = (0.265, 0.670, 0.065)
RUNS = 8
RAYS = 1024
# Student's t of 95 % for so many runs.
T = 2.365
ALLOWANCE = 0.01


def quasilux(*words):
    command = ["cargo", "run", "--quiet", "--release", "--package", "quasilux", "--", *words]
    subprocess.run(command, cwd=ROOT, check=True, stderr=subprocess.DEVNULL)


def radiance(folder, *words, **options):
    environment = dict(os.environ, RAYPATH=f".:{RADIANCE / 'lib'}")
    command = [str(RADIANCE / "bin" / words[0]), *words[1:]]
    done = subprocess.run(command, cwd=folder, env=environment, check=True, capture_output=True, **options)
    return done.stdout


def traced(folder, points):
    """Mean and half-width of each point in lx, from several runs."""
    runs = []
    settings = f"-h -I+ -n 2 -ab 100 -aa 0 -as 0 -ad {RAYS} -lw {1 / RAYS} -lr -100 -dt 0 -dc 1 -ds 0.05 -dj 1 -u+"
    lines = points.read_bytes()
    for _ in range(RUNS):
        out = radiance(folder, "rtrace", *settings.split(), "scene.oct", input=lines)
        rows = [line.split() for line in out.decode().splitlines()]
        weighed = lambda row: LUMENS_PER_WATT * sum(w * float(x) for w, x in zip(WEIGHTS, row))
        runs.append([weighed(row) for row in rows])
    return [(statistics.fmean(values), T * statistics.stdev(values) / math.sqrt(RUNS))
            for values in zip(*runs)]


def compare(project):
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        quasilux("run", str(project), "--quiet", "--out", str(folder / "out"))
        quasilux("export", str(project), "--radiance", str(folder / "scene"))
        (folder / "scene/scene.oct").write_bytes(radiance(folder / "scene", "oconv", "scene.rad"))
        document = json.loads((folder / "out/result.json").read_text())
        ours, theirs, worst = [], [], 0.0
        for sensor in document["sensors"]:
            found = traced(folder / "scene", folder / f"scene/{sensor['name']}.pts")
            for point, (lx, half_width) in zip(sensor["points"], found):
                own, own_width = point["illuminance_lx"], point["half_width_lx"] or 0.0
                allowed = math.hypot(own_width, half_width) + ALLOWANCE * abs(own)
                worst = max(worst, abs(lx - own) / allowed)
                ours.append(own)
                theirs.append(lx)
    mean, other = statistics.fmean(ours), statistics.fmean(theirs)
    name = pathlib.Path(project).name
    print(f"| `{name}` | {len(ours)} | {mean:.2f} | {other:.2f} | {100 * (other / mean - 1):+.2f} % | {worst:.2f} |")
    return worst


def main():
    projects = sys.argv[1:] or [ROOT / "examples" / name for name in EXAMPLES]
    print("| project | points | quasilux, lx | Radiance, lx | difference | largest over allowed |")
    print("|---|---|---|---|---|---|")
    worst = [compare(pathlib.Path(project).resolve()) for project in projects]
    # One interval of twenty may miss.
    sys.exit(0 if max(worst) < 2.5 else 1)


if __name__ == "__main__":
    main()
