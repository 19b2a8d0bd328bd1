"""Luminaire files, own and of others, and integrals over them, for the tests of photometry."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from files import ROOT, corpus
from hypothesis import HealthCheck, settings

BATWING = ROOT / "examples/office/batwing.ies"

HEAD = b"IESNA:LM-63-2002\n[TEST] made up\n[LUMINAIRE] Lamp <b>\n"
# Without symmetry, with a kink at each angle.
UNEVEN = HEAD + (
    b"TILT=NONE\n1 -1 1 5 4 1 2 0.3 0.6 0.1\n1 1 10\n0 20 60 110 180\n0 70 200 360\n"
    b"100 80 50 10 20\n100 20 90 0 20\n100 60 10 40 20\n100 80 50 10 20\n"
)
# A floodlight of type B, and a headlight of type A, both with four vertical angles.
TYPE_B, TYPE_A = (
    HEAD
    + f"TILT=NONE\n1 -1 1 4 3 {kind} 2 0 0 0\n1 1 10\n-90 0 20 90\n-90 10 90\n".encode()
    + b"1 40 20 2\n0 300 80 4\n0 50 60 6\n"
    for kind in (2, 3)
)

# With the factors of a tilted lamp in a file of their own.
TILTED = HEAD + b"TILT=lamp.tlt\n1 1000 1 2 1 1 2 0 0 0\n1 1 10\n0 90\n0\n100 0\n"
FACTORS = b"1\n3\n0 45 90\n1 0.9 0.8\n"

fuzz = settings(
    deadline=None,
    max_examples=60,
    database=None,
    suppress_health_check=[HealthCheck.too_slow, HealthCheck.data_too_large],
)


def luminaire_files() -> list[Path]:
    return corpus("ies/*.[iI][eE][sS]", "ldt/*.ldt", "ies/tm33/*.xml")


def direction(c_deg, gamma_deg):
    """The frame's definition: gamma = 0 is -z, C0 is +x, C90 is +y."""
    c, gamma = np.radians(c_deg), np.radians(gamma_deg)
    sine = np.sin(gamma)
    parts = np.broadcast_arrays(sine * np.cos(c), sine * np.sin(c), -np.cos(gamma))
    return np.stack(parts, axis=-1)


def gauss(edges_deg, order=10):
    """Places in degrees and weights in radians, a rule of Gauss and Legendre for each interval."""
    x, w = np.polynomial.legendre.leggauss(order)
    low, high = edges_deg[:-1, None], edges_deg[1:, None]
    place = low + (high - low) * (x + 1) / 2
    return place.ravel(), np.radians((high - low) * w / 2).ravel()


def integral(lamp, low_deg=0.0, high_deg=180.0, c_range=(0.0, 360.0)):
    """Of intensities of type C over solid angle, between the kinks of the table."""
    grid = lamp.unfolded()
    inside = [g for g in grid.vertical_deg if low_deg < g < high_deg]
    gamma, w_gamma = gauss(np.array([low_deg, *inside, high_deg]))
    planes = [c for c in grid.horizontal_deg % 360 if c_range[0] < c < c_range[1]]
    c, w_c = gauss(np.array(sorted({c_range[0], *planes, c_range[1]})), 2)
    values = lamp.intensity_at(c_deg=c[:, None], gamma_deg=gamma)
    return w_c @ values @ (w_gamma * np.sin(np.radians(gamma)))
