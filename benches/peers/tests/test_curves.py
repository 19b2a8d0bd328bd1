"""Times at a wanted error."""

import math
import unittest

from contest.curves import Found, Point, time_to


class TimeTo(unittest.TestCase):
    def test_between_points_it_follows_the_slope(self) -> None:
        points = [Point(1.0, 0.04), Point(16.0, 0.01)]
        reached = time_to(0.02, points, extrapolate=False)
        self.assertAlmostEqual(reached.seconds, 4.0)
        self.assertIs(reached.found, Found.BETWEEN)

    def test_the_cheapest_run_may_do(self) -> None:
        reached = time_to(0.05, [Point(1.0, 0.04), Point(16.0, 0.01)], extrapolate=False)
        self.assertEqual((reached.seconds, reached.found), (1.0, Found.BEFORE))

    def test_beyond_the_last_point_it_costs_the_square(self) -> None:
        points = [Point(1.0, 0.04), Point(16.0, 0.01)]
        reached = time_to(0.005, points, extrapolate=True)
        self.assertAlmostEqual(reached.seconds, 64.0)
        self.assertIs(reached.found, Found.BEYOND)

    def test_start_up_does_not_grow(self) -> None:
        points = [Point(1.0 + 0.1, 0.04), Point(1.0 + 0.4, 0.02)]
        self.assertAlmostEqual(time_to(0.01, points, extrapolate=True).seconds, 1.0 + 1.6)

    def test_a_biased_curve_never_gets_there(self) -> None:
        reached = time_to(0.005, [Point(1.0, 0.02), Point(4.0, 0.02)], extrapolate=False)
        self.assertTrue(math.isinf(reached.seconds))
        self.assertIs(reached.found, Found.NEVER)

    def test_the_first_crossing_counts(self) -> None:
        points = [Point(1.0, 0.04), Point(4.0, 0.01), Point(16.0, 0.02), Point(64.0, 0.001)]
        self.assertLess(time_to(0.015, points, extrapolate=False).seconds, 4.0)


if __name__ == "__main__":
    unittest.main()
