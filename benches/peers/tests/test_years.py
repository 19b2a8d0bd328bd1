"""Errors of years that can be counted, and the time to one."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

from outside import results, years
from outside.hours import Calendar
from outside.moments import Answer, distance
from outside.results import Machine, Results, YearResult
from outside.times import Times
from outside.years import QUASILUX, RCONTRIB, Errors, Key, Level, Limit, Limits


def _level(seconds: float, noise: float) -> Level:
    errors = Errors(noise, 0.3, noise, 0.01, 0.0, 0.5)
    return Level(Key(RCONTRIB, "a", "b"), seconds, seconds, errors)


class OfYears(unittest.TestCase):
    calendar = Calendar(
        np.array([True, True, False]), np.array([True, False, False]), np.array([True, True, True])
    )

    def test_hours_that_do_not_count_do_not(self) -> None:
        right = np.array([[100.0, 200.0, 1.0], [400.0, 800.0, 1.0]], dtype=np.float32)
        other = Limit(2 * right, 0.0, 0.0)
        off = right * np.array([1.0, 1.1, 9.0], dtype=np.float32)
        limits = Limits(Limit(right, 0.0, 0.0), other)
        found = years.errors(QUASILUX, [off], limits, self.calendar)
        self.assertAlmostEqual(found.to_own, 0.1 / np.sqrt(2), places=6)
        self.assertAlmostEqual(found.to_own_sunless, 0.0)
        self.assertAlmostEqual(found.to_other_sunless, 0.5)
        self.assertAlmostEqual(found.sda, 0.5)

    def test_noise_shrinks_with_the_number_of_years(self) -> None:
        noise = np.random.default_rng(1).normal(1.0, 0.1, (25, 400, 3)).astype(np.float32)
        limit = years.limit(list(noise), self.calendar)
        self.assertAlmostEqual(limit.noise, 0.02, delta=0.002)

    def test_the_faster_family_counts(self) -> None:
        slow = [_level(8.0, 0.2), _level(32.0, 0.1)]
        fast = [
            Level(Key(RCONTRIB, "c", "d"), it.wall_seconds, it.cpu_seconds / 2, it.errors)
            for it in slow
        ]
        self.assertAlmostEqual(years.seconds_to(0.1, slow), 32.0)
        self.assertAlmostEqual(years.seconds_to(0.1, slow + fast), 16.0)


class OfMoments(unittest.TestCase):
    def test_distances_are_shares_of_the_base(self) -> None:
        took = Times(1.0, 1.0)
        base = Answer(np.array([100.0, 300.0]), np.array([3.0, 3.0]), took)
        other = Answer(np.array([110.0, 300.0]), np.array([4.0, 4.0]), took)
        found = distance(base, other)
        self.assertAlmostEqual(found.share, 0.025)
        self.assertAlmostEqual(found.largest_z, 2.0)
        self.assertAlmostEqual(found.largest_share, 0.1)
        self.assertAlmostEqual(found.standard_error, np.sqrt(50) / 2 / 200)


class Files(unittest.TestCase):
    def test_what_is_saved_is_loaded(self) -> None:
        level = _level(4.0, 0.1)
        year = YearResult("Here", 2, 5, 3, 0.1, 0.1, 0.1, level.errors, [level])
        before = Machine("p", 2, 0.5, "yesterday", "1", "6")
        saved = Results(before, [], year, Machine("p", 2, 0.0, "today", "1", "6"))
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "measured.json"
            results.save(saved, path)
            self.assertEqual(results.load(path), saved)


if __name__ == "__main__":
    unittest.main()
