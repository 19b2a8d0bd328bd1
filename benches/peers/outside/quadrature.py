"""What comes straight through blinds in a black room, by sums that share nothing with a program.

Patches of the matrix are constant. In the coordinates of a matrix x is to the right and y upward
for who looks out, and z goes in; here the room is to the north of the window.
"""

import dataclasses
import math

import numpy as np
from numpy.typing import NDArray

from contest.room import Diffuse, Vectors
from outside.blinds import BANDS, Blinds, patches
from outside.rooms import Windowed
from outside.sky import SUN_DEG, Outside

WINDOW_POINTS = 400
SUN_POINTS = 4000


def black(place: Windowed) -> Windowed:
    """The room with surfaces that reflect nothing."""
    dark = {name: Diffuse(0.0) for name in place.room.materials}
    return dataclasses.replace(place, room=dataclasses.replace(place.room, materials=dark))


def illuminances(place: Windowed, blinds: Blinds, outside: Outside) -> Vectors:
    """Of the sensors of a black room, in lx: midpoints of the window."""
    luminance = blinds.transmission() @ _incident_lx(outside)
    corners = place.window.corners()
    low, high = corners.min(axis=0), corners.max(axis=0)
    parts = (np.arange(WINDOW_POINTS) + 0.5) / WINDOW_POINTS
    x, z = np.meshgrid(*(low[i] + parts * (high[i] - low[i]) for i in (0, 2)))
    points = np.stack([x.ravel(), np.zeros(x.size), z.ravel()], axis=1)
    area = (high[0] - low[0]) * (high[2] - low[2])
    found = []
    for position, normal in zip(place.room.sensors.positions, place.room.sensors.normals):
        way = position - points
        square = (way**2).sum(axis=1)
        onward = way / np.sqrt(square)[:, None]
        cosines = np.maximum(-(onward @ normal), 0) * onward[:, 1]
        found.append(area * np.mean(luminance[_patch(onward)] * cosines / square))
    return np.array(found)


def _incident_lx(outside: Outside) -> Vectors:
    """On the window from each incident patch."""
    cells = patches()
    inward = cells.directions
    from_there = -np.stack([-inward[..., 0], inward[..., 2], inward[..., 1]], axis=-1)
    sky = outside.scale_cd_m2() * outside.relative_luminance(from_there.reshape(-1, 3))
    ground = outside.ground_reflectance * outside.horizontal_lx() / math.pi
    luminance = np.where(from_there[..., 2] > 0, sky.reshape(from_there.shape[:2]), ground)
    lx = luminance.mean(axis=1) * cells.projected_sr
    if outside.sun.normal_lx > 0:
        rays = -_sun_disk(outside)
        parts = outside.sun.normal_lx * rays[:, 1] / len(rays)
        np.add.at(lx, _patch(rays), parts)
    return lx


def _sun_disk(outside: Outside) -> Vectors:
    """Directions all over the sun, along a spiral."""
    centre = outside.sun.direction()
    across = np.cross(centre, [0.0, 0.0, 1.0])
    across /= np.linalg.norm(across)
    up = np.cross(across, centre)
    numbers = np.arange(SUN_POINTS) + 0.5
    aside = math.sin(math.radians(SUN_DEG / 2)) * np.sqrt(numbers / SUN_POINTS)
    turn = numbers * math.pi * (3 - math.sqrt(5))
    rows = np.outer(aside * np.cos(turn), across) + np.outer(aside * np.sin(turn), up)
    return rows + np.outer(np.sqrt(1 - aside**2), centre)


def _patch(onward: Vectors) -> NDArray[np.int64]:
    """In which light goes on that goes north."""
    x, y = -onward[:, 0], onward[:, 2]
    counts = np.array([count for _, count in BANDS])
    ends = np.sin(np.radians([upper_deg for upper_deg, _ in BANDS[:-1]])) ** 2
    band = np.searchsorted(ends, x**2 + y**2, side="right")
    turns = np.arctan2(y, x) / (2 * math.pi) * counts[band] + 0.5
    first = np.cumsum(counts) - counts
    return first[band] + np.floor(turns).astype(np.int64) % counts[band]
