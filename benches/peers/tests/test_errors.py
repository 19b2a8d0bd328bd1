"""Norms and deviations."""

import unittest

import numpy as np

from contest.errors import deviation, relative_l2, without_reference


class RelativeL2(unittest.TestCase):
    def test_is_the_share_of_a_common_factor(self) -> None:
        reference = np.array([3.0, 4.0, 12.0])
        self.assertAlmostEqual(relative_l2(1.02 * reference, reference), 0.02)

    def test_bright_sensors_weigh_more(self) -> None:
        reference = np.array([3.0, 4.0])
        self.assertAlmostEqual(relative_l2(np.array([3.0, 4.5]), reference), 0.1)


class WithoutReference(unittest.TestCase):
    def test_variances_subtract(self) -> None:
        self.assertAlmostEqual(without_reference(0.05**2, 0.03), 0.04)

    def test_nothing_is_claimed_below_half_of_it(self) -> None:
        self.assertAlmostEqual(without_reference(0.03**2, 0.03), 0.015)


class DeviationOfAverages(unittest.TestCase):
    def test_a_bias_is_seen(self) -> None:
        reference = np.full(100, 50.0)
        noise = np.random.default_rng(1).normal(0.0, 0.1, (3, 100))
        found = deviation(list(50.5 + noise), reference, 0.0)
        self.assertAlmostEqual(found.share, 0.01, delta=0.001)
        self.assertFalse(found.within(3))

    def test_noise_is_none(self) -> None:
        reference = np.full(100, 50.0)
        noise = np.random.default_rng(2).normal(0.0, 0.5, (3, 100))
        found = deviation(list(50.0 + noise), reference, 0.0)
        self.assertTrue(found.within(3))
        self.assertLess(found.standard_error, 0.003)

    def test_the_error_of_the_reference_counts(self) -> None:
        reference = np.full(100, 50.0)
        noise = np.random.default_rng(1).normal(0.0, 0.1, (3, 100))
        self.assertTrue(deviation(list(50.5 + noise), reference, 0.005).within(3))


if __name__ == "__main__":
    unittest.main()
