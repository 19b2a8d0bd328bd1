#!/usr/bin/env python3
"""Intensities by quasilux and by Radiance's ies2rad, as a Markdown table.

    python3 -m venv venv && venv/bin/pip install pyradiance==1.3.1
    venv/bin/python validation/ies2rad/compare.py FILE.ies ...

ies2rad writes a light source for each file. Rays are traced to it by rtrace from twenty directions,
on and off the measured angles, so that Radiance evaluates its own functions (corr, flatcorr, boxcorr,
cylcorr; src_phi, src_phi2, src_phi4, src_theta). The radiance that a ray meets, times the area that
the source shows in that direction, times 179 lm/W is an intensity in candela. It is compared with what
`cargo run --example intensities` prints.

Without files, only the three that this script makes itself are compared: planes 90 to 270, the factors of
LM-63-1991, and a reserved field of LM-63-2002 that is not 1.
"""

import math
import os
import pathlib
import subprocess
import sys
import tempfile

import pyradiance

RADIANCE = pathlib.Path(pyradiance.__file__).parent
ROOT = pathlib.Path(__file__).resolve().parents[2]
LUMENS_PER_WATT = 179.0
FAR_M = 100.0

# (C, gamma) in degrees. Not at 0, 90 or 180: there, flat sources show no area and azimuths no meaning.
DIRECTIONS = [
    (0, 10), (0, 40), (15, 25), (30, 60), (45, 35), (60, 72.5), (75, 5), (90, 30), (100, 55), (120, 20),
    (135, 65), (150, 45), (165, 80), (180, 15), (200, 50), (225, 33), (250, 70), (270, 40), (300, 110), (340, 150),
]


def run(command, folder, **options):
    environment = dict(os.environ, RAYPATH=f".:{RADIANCE / 'lib'}")
    command = [str(RADIANCE / "bin" / command[0]), *command[1:]]
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, check=True, **options).stdout


def toward(c_deg, gamma_deg):
    c, gamma = math.radians(c_deg), math.radians(gamma_deg)
    return (math.sin(gamma) * math.cos(c), math.sin(gamma) * math.sin(c), -math.cos(gamma))


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def shown_areas(rad_text):
    """Functions from a direction to the area that each primitive of the source shows in it, in m^2."""
    lines = [line for line in rad_text.splitlines() if not line.startswith("#")]
    tokens = " ".join(lines).replace("'", " ").split()
    areas = []
    for index, token in enumerate(tokens):
        if token not in ("polygon", "ring", "sphere", "cylinder"):
            continue
        count = int(tokens[index + 4])
        numbers = [float(number) for number in tokens[index + 5:index + 5 + count]]
        areas.append(primitive(token, numbers))
    return areas


def primitive(kind, numbers):
    points = [numbers[i:i + 3] for i in range(0, len(numbers) - len(numbers) % 3, 3)]
    if kind == "sphere":
        return lambda d: math.pi * numbers[3] ** 2
    if kind == "cylinder":
        height = abs(points[1][2] - points[0][2])
        return lambda d: 2 * numbers[6] * height * math.hypot(d[0], d[1])
    if kind == "ring":
        area = math.pi * (max(numbers[6:8]) ** 2 - min(numbers[6:8]) ** 2)
        return lambda d: area * max(0.0, dot(points[1], d))
    # Polygon: half the sum of cross products of its corners is area times normal.
    normal = [0.0, 0.0, 0.0]
    for a, b in zip(points, points[1:] + points[:1]):
        cross = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
        normal = [n + 0.5 * x for n, x in zip(normal, cross)]
    return lambda d: max(0.0, dot(normal, d))


def by_radiance(path, folder):
    name = "luminaire"
    # White, whatever lamp the file names: the colours of lamp.tab are normalised to their luminance anyway.
    run(["ies2rad", "-t", "default", "-o", name, str(path)], folder)
    octree = run(["oconv", f"{name}.rad"], folder)
    (folder / "scene.oct").write_bytes(octree)
    directions = [toward(*angles) for angles in DIRECTIONS]
    rays = "".join(
        " ".join(f"{FAR_M * x:.12g}" for x in d) + " " + " ".join(f"{-x:.12g}" for x in d) + "\n" for d in directions
    )
    out = run(["rtrace", "-h", "-ab", "0", "scene.oct"], folder, input=rays.encode())
    areas = shown_areas((folder / f"{name}.rad").read_text(encoding="latin-1"))
    intensities = []
    for direction, line in zip(directions, out.decode().splitlines()):
        radiance = float(line.split()[1])
        intensities.append(LUMENS_PER_WATT * radiance * sum(area(direction) for area in areas))
    return intensities


def by_quasilux(path):
    angles = [f"{c},{gamma}" for c, gamma in DIRECTIONS]
    command = ["cargo", "run", "--quiet", "-p", "quasilux-photometry", "--example", "intensities", "--", str(path), *angles]
    out = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    if out.returncode != 0:
        raise ValueError(out.stderr.strip().splitlines()[-1])
    return [float(line) for line in out.stdout.split()]


def made_files(folder):
    """Files of our own for what the given ones may lack."""
    angles = "0 45 90\n90 180 270\n100 200 300\n100 400 500\n100 600 700\n"
    first = {
        "made: planes 90 to 270": ("IESNA:LM-63-2002", "1 -1 1 3 3 1 2 0 0 0\n1 1 10\n" + angles),
        "made: 1991, factors 2, 0.8, 0.9": ("IESNA91", "1 -1 2 3 1 1 2 0.1 0.2 0\n0.8 0.9 10\n0 45 90\n0\n100 80 20\n"),
        "made: 2002, reserved field 1.2": ("IESNA:LM-63-2002", "1 -1 1 3 1 1 1 0.5 0.5 0.25\n1 1.2 10\n0 90 180\n0\n100 80 20\n"),
    }
    for name, (standard, numbers) in first.items():
        path = folder / (name.split()[1].strip(",") + ".ies")
        path.write_text(f"{standard}\n[TEST] none\nTILT=NONE\n{numbers}")
        yield name, path


def row(name, ours, theirs):
    greatest = max(max(ours), max(theirs), 1e-300)
    differences = [abs(a - b) / greatest for a, b in zip(ours, theirs)]
    worst = max(range(len(differences)), key=differences.__getitem__)
    c, gamma = DIRECTIONS[worst]
    at = f"C{c:g}, gamma {gamma:g}: {ours[worst]:.6g} and {theirs[worst]:.6g} cd"
    return f"| {name} | {greatest:.6g} | {differences[worst]:.1e} | {at} |"


def main():
    print("| file | greatest, cd | largest difference over it | where: quasilux and ies2rad |")
    print("|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        given = [(pathlib.Path(name).name, pathlib.Path(name).resolve()) for name in sys.argv[1:]]
        for name, path in [*given, *made_files(folder)]:
            try:
                print(row(name, by_quasilux(path), by_radiance(path, folder)))
            except (ValueError, subprocess.CalledProcessError) as error:
                print(f"| {name} | refused: {error} | | |")


if __name__ == "__main__":
    main()
