#!/usr/bin/env python3
"""Intensities by quasilux and by Radiance's ies2rad, as a Markdown table.

    python3 -m venv venv && venv/bin/pip install pyradiance==1.3.1
    venv/bin/python validation/ies2rad/compare.py FILE.ies ...

ies2rad writes a light source for each file. Rays are traced to it by rtrace from twenty directions,
on and off the measured angles, so that Radiance evaluates its own functions (corr, flatcorr, boxcorr,
cylcorr; src_phi, src_phi2, src_phi4, src_theta). The radiance that a ray meets, times the area that
the source shows in that direction, times 179 lm/W is an intensity in candela. It is compared with what
`cargo run --example intensities` prints.

Behind the given files come five that this script makes itself: planes 90 to 270, the factors of LM-63-1991, a
reserved field of LM-63-2002 that is not 1, a file generation type of LM-63-2019, and light at the last angle.
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


def primitives(rad_text):
    """The surfaces of the source: for each its centre, and its area in m^2 as seen from a direction."""
    lines = [line for line in rad_text.splitlines() if not line.startswith("#")]
    tokens = " ".join(lines).replace("'", " ").split()
    for index, token in enumerate(tokens):
        if token in ("polygon", "ring", "sphere", "cylinder"):
            count = int(tokens[index + 4])
            yield primitive(token, [float(number) for number in tokens[index + 5:index + 5 + count]])


def primitive(kind, numbers):
    points = [numbers[i:i + 3] for i in range(0, len(numbers) - len(numbers) % 3, 3)]
    if kind == "sphere":
        return points[0], lambda d: math.pi * numbers[3] ** 2
    if kind == "cylinder":
        (bottom, top), radius = points[:2], numbers[6]
        middle = [(x + y) / 2 for x, y in zip(bottom, top)]
        return middle, lambda d: 2 * radius * math.dist(bottom, top) * math.hypot(d[0], d[1])
    if kind == "ring":
        area = math.pi * (max(numbers[6:8]) ** 2 - min(numbers[6:8]) ** 2)
        return points[0], lambda d: area * max(0.0, dot(points[1], d))
    # Polygon: half the sum of cross products of its corners is area times normal.
    normal = [0.0, 0.0, 0.0]
    for a, b in zip(points, points[1:] + points[:1]):
        cross = (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
        normal = [n + 0.5 * x for n, x in zip(normal, cross)]
    middle = [sum(x) / len(points) for x in zip(*points)]
    return middle, lambda d: max(0.0, dot(normal, d))


def by_radiance(path, folder):
    run(["ies2rad", "-t", "default", "-o", "luminaire", str(path)], folder)
    (folder / "scene.oct").write_bytes(run(["oconv", "luminaire.rad"], folder))
    surfaces = list(primitives((folder / "luminaire.rad").read_text(encoding="latin-1")))
    rays, areas = [], []
    for angles in DIRECTIONS:
        direction = toward(*angles)
        shown = [area(direction) for _, area in surfaces]
        areas.append(sum(shown))
        # Aimed at the surface that shows most of itself.
        middle = surfaces[shown.index(max(shown))][0]
        origin = [m + FAR_M * x for m, x in zip(middle, direction)]
        rays.append(" ".join(f"{x:.12g}" for x in [*origin, *(-x for x in direction)]))
    out = run(["rtrace", "-h", "-ab", "0", "scene.oct"], folder, input="\n".join(rays).encode())
    radiances = [float(line.split()[1]) for line in out.decode().splitlines()]
    return [LUMENS_PER_WATT * radiance * area for radiance, area in zip(radiances, areas)]


def turned(c_deg, gamma_deg):
    return (c_deg + 180) % 360, gamma_deg


def projected(c_deg, gamma_deg):
    """The direction whose H of type B is the angle that source.cal takes for it: that of the projection along x."""
    x, y, z = toward(c_deg, gamma_deg)
    v, h = math.atan2(x, -z), math.atan2(-y, abs(z))
    x, y, z = math.cos(h) * math.sin(v), -math.sin(h), -math.cos(h) * math.cos(v)
    return math.degrees(math.atan2(y, x)) % 360, math.degrees(math.atan2(math.hypot(x, y), -z))


def by_quasilux(path, instead=lambda *angles: angles):
    angles = [f"{c!r},{gamma!r}" for c, gamma in (instead(*angles) for angles in DIRECTIONS)]
    cargo = ["cargo", "run", "--quiet", "-p", "quasilux-photometry", "--example", "intensities", "--"]
    out = subprocess.run([*cargo, str(path), *angles], cwd=ROOT, capture_output=True, text=True)
    if out.returncode != 0:
        raise ValueError(out.stderr.strip().splitlines()[-1])
    return [float(line) for line in out.stdout.split()]


TURNED = "made: planes 90 to 270"


def made_files(folder):
    """Files of our own for what the given ones may lack: name, edition, numbers."""
    planes = "0 45 90 180\n90 180 270\n100 200 0 0\n100 400 0 0\n100 600 0 0\n"
    first = [
        (TURNED, "IESNA:LM-63-2002", "1 -1 1 4 3 1 2 0 0 0\n1 1 10\n" + planes),
        ("made: 1991, factors 2, 0.8, 0.9", "IESNA91", "1 -1 2 3 1 1 2 0.1 0.2 0\n0.8 0.9 10\n0 45 90\n0\n100 80 20\n"),
        ("made: 2002, reserved field 1.2", "IESNA:LM-63-2002", "1 -1 1 3 1 1 1 0.5 0.5 0.25\n1 1.2 10\n0 90 180\n0\n100 80 20\n"),
        ("made: 2019, file generation 1.1", "IES:LM-63-2019", "1 -1 1 3 1 1 2 -0.1 -0.1 0\n1 1.10000 10\n0 45 90\n0\n100 80 20\n"),
        ("made: 20 cd at the last angle, 90", "IESNA:LM-63-2002", "1 -1 1 3 1 1 2 0 0 0\n1 1 10\n0 45 90\n0\n100 80 20\n"),
    ]
    for index, (name, standard, numbers) in enumerate(first):
        path = folder / f"made-{index}.ies"
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
                theirs = by_radiance(path, folder)
                print(row(name, by_quasilux(path), theirs))
                if name == TURNED:
                    print(row(name + ", ours turned by 180 degrees", by_quasilux(path, turned), theirs))
                if "srcB_" in (folder / "luminaire.rad").read_text(encoding="latin-1"):
                    print(row(name + ", ours at H as projected", by_quasilux(path, projected), theirs))
            except ValueError as error:
                print(f"| {name} | refused by quasilux: {error} | | |")
            except subprocess.CalledProcessError as error:
                reason = error.stderr.decode(errors="replace").strip().splitlines()[-2:]
                print(f"| {name} | refused by {pathlib.Path(error.cmd[0]).name}: {'; '.join(reason)} | | |")


if __name__ == "__main__":
    main()
