"""Skies, glass and blinds against published values, conservation and closed forms."""

import math
import unittest

import numpy as np

from contest.room import Vectors
from outside import quadrature, rooms
from outside.blinds import Blinds, patches
from outside.glass import ETA, Glass
from outside.sky import Outside, Sun


class Skies(unittest.TestCase):
    def test_ratios_to_the_zenith_are_the_published_ones(self) -> None:
        # Zenith angles of 45 (sky) and 30 degrees (sun), azimuths half a turn apart.
        towards = Sun(45.0, 0.0).direction()
        for kind, ratio in ((1, 0.83258464279644), (12, 0.45445243068520)):
            sky = Outside("", kind, 1.0, Sun(60.0, 180.0))
            rows = np.array([towards, [0.0, 0.0, 1.0]])
            at_place, at_zenith = sky.relative_luminance(rows)
            self.assertAlmostEqual(at_place / at_zenith, ratio, places=10)

    def test_scaled_skies_have_their_illuminance(self) -> None:
        sky = Outside("", 12, 5000.0, Sun(35.0, 120.0))
        numbers = np.random.default_rng(3).random((400_000, 2))
        aside, turn = np.sqrt(numbers[:, 0]), 2 * math.pi * numbers[:, 1]
        rows = np.stack([aside * np.cos(turn), aside * np.sin(turn), np.sqrt(1 - aside**2)], axis=1)
        luminance = sky.scale_cd_m2() * sky.relative_luminance(rows)
        self.assertAlmostEqual(math.pi * luminance.mean() / 5000.0, 1.0, delta=0.01)


class Panes(unittest.TestCase):
    def test_clear_glass_keeps_all_light(self) -> None:
        for angle_deg in (0.0, 30.0, 60.0, 85.0):
            shares = Glass(1.0).shares(angle_deg)
            self.assertAlmostEqual(shares.transmittance + shares.reflectance, 1.0)
        self.assertAlmostEqual(Glass(1.0).shares(0.0).transmittance, 2 * ETA / (ETA**2 + 1))

    def test_light_that_goes_across_is_absorbed(self) -> None:
        normal, grazing = (Glass(0.5).shares(angle_deg) for angle_deg in (0.0, 89.9))
        once = ((ETA - 1) / (ETA + 1)) ** 2
        through = (1 - once) ** 2 * 0.5 / (1 - (0.5 * once) ** 2)
        self.assertAlmostEqual(normal.transmittance, through)
        self.assertGreater(grazing.reflectance, 0.98)


class Matrices(unittest.TestCase):
    def test_patches_make_a_hemisphere(self) -> None:
        cells = patches()
        self.assertEqual(len(cells.projected_sr), 145)
        self.assertAlmostEqual(cells.projected_sr.sum(), math.pi)

    def test_no_light_is_made(self) -> None:
        for blinds in (Blinds(), Blinds(False)):
            passed = patches().projected_sr @ blinds.transmission()
            self.assertTrue(np.all(passed <= 1.0))
            self.assertGreater(passed.max(), 0.1)


class Sums(unittest.TestCase):
    def test_an_even_window_gives_its_configuration_factor(self) -> None:
        place = quadrature.black(rooms.small(_Even()))
        outside = Outside("", 1, 10_000.0, Sun(60.0, 180.0))
        found = quadrature.illuminances(place, _Even(), outside)
        corners = place.window.corners()
        factors = np.array([_lambert(corners - at) for at in place.room.sensors.positions])
        numbers = np.random.default_rng(4).random((400_000, 2))
        aside, turn = np.sqrt(numbers[:, 0]), 2 * math.pi * numbers[:, 1]
        south = -np.sqrt(1 - aside**2)
        rows = np.stack([aside * np.cos(turn), south, aside * np.sin(turn)], axis=1)
        sky = outside.scale_cd_m2() * outside.relative_luminance(rows)
        ground = outside.ground_reflectance * outside.horizontal_lx() / math.pi
        window_lx = math.pi * float(np.where(rows[:, 2] > 0, sky, ground).mean())
        self.assertTrue(np.allclose(found, _Even.SHARE * window_lx * factors, rtol=5e-3))

    def test_the_sun_arrives_in_one_patch_or_its_neighbours(self) -> None:
        bright = Outside("", 12, 1.0, Sun(30.0, 180.0, 50_000.0))
        dark = Outside("", 12, 1.0, Sun(30.0, 180.0))
        place = quadrature.black(rooms.small(_Even()))
        sums = [quadrature.illuminances(place, _Even(), it) for it in (bright, dark)]
        expected = 50_000.0 * math.cos(math.radians(30.0))
        ground = 0.2 * 25_000.0 / 2
        factor = _lambert(place.window.corners() - place.room.sensors.positions[0])
        gained = (sums[0] - sums[1])[0] / (_Even.SHARE * factor)
        self.assertAlmostEqual(gained / (expected + ground), 1.0, delta=1e-3)


class _Even(Blinds):
    """Scatters a share evenly."""

    SHARE = 0.5

    def transmission(self) -> Vectors:
        return np.full((145, 145), self.SHARE / math.pi)


def _lambert(corners: Vectors) -> float:
    """Illuminance of a polygon over pi and its luminance, on a plane that faces up (Lambert)."""
    units = corners / np.linalg.norm(corners, axis=1)[:, None]
    total = 0.0
    for here, there in zip(units, np.roll(units, -1, axis=0), strict=True):
        normal = np.cross(here, there)
        angle = math.acos(float(np.clip(here @ there, -1.0, 1.0)))
        total += angle * normal[2] / float(np.linalg.norm(normal))
    return abs(total) / (2 * math.pi)


if __name__ == "__main__":
    unittest.main()
