"""What counts as agreement."""

import unittest

import numpy as np

from contest import references

TRUTH = np.linspace(10.0, 500.0, 200)


def batches(seed: int, factor: float, noise: float) -> list[np.ndarray]:
    scatter = np.random.default_rng(seed).normal(0.0, noise, (16, len(TRUTH)))
    return list(factor * TRUTH * (1 + scatter))


class Agreement(unittest.TestCase):
    def test_two_noisy_sides_agree(self) -> None:
        a = references.side("a", "", batches(1, 1.0, 0.02))
        b = references.side("b", "", batches(2, 1.0, 0.01))
        self.assertTrue(references.agreement(a, b).holds())

    def test_half_a_percent_is_seen(self) -> None:
        a = references.side("a", "", batches(1, 1.0, 0.02))
        b = references.side("b", "", batches(2, 1.005, 0.01))
        self.assertFalse(references.agreement(a, b).holds())

    def test_one_wrong_sensor_in_ten_is_seen(self) -> None:
        a = references.side("a", "", batches(1, 1.0, 0.02))
        one_in_ten = np.where(np.arange(200) % 10 == 0, 1.03, 1.0)
        wrong = [batch * one_in_ten for batch in batches(2, 1.0, 0.01)]
        self.assertFalse(references.agreement(a, references.side("b", "", wrong)).holds())

    def test_the_better_side_weighs_more(self) -> None:
        a = references.side("a", "", batches(1, 1.0, 0.1))
        b = references.side("b", "", batches(2, 1.0, 0.001))
        joined = references.joined(a, b)
        self.assertLess(np.abs(joined.illuminances_lx / TRUTH - 1).max(), 0.002)
        self.assertLess(joined.error_l2, b.error() * 1.001)


if __name__ == "__main__":
    unittest.main()
