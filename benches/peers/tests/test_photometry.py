"""Reading the IES files of the rooms."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

from contest import photometry
from contest.rooms.gallery import SPOT
from contest.rooms.office import FOLDER


class Files(unittest.TestCase):
    def test_the_batwing_has_its_flux(self) -> None:
        self.assertAlmostEqual(photometry.read(FOLDER / "batwing.ies").flux_lm(), 3000, delta=0.5)

    def test_quadrants_fold(self) -> None:
        table = photometry.read(FOLDER / "batwing.ies")
        cells = table.regular(0.5)
        self.assertEqual(cells.shape, (721, 361))
        for c, same in ((30, 150), (30, 210), (30, 330), (0, 180), (90, 270)):
            np.testing.assert_allclose(cells[2 * c], cells[2 * same])
        self.assertAlmostEqual(cells[180, 75], 1441.3, delta=0.1)

    def test_the_spot_in_the_tree_is_what_the_formula_says(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            again = Path(folder) / "spot.ies"
            photometry.spot(again, 4000.0, 12.0)
            self.assertEqual(again.read_text(), SPOT.read_text())

    def test_other_types_are_refused(self) -> None:
        with tempfile.TemporaryDirectory() as folder:
            other = Path(folder) / "b.ies"
            other.write_text("TILT=NONE\n1 100 1 2 1 2 2 0 0 0\n1 1 1\n0 90\n0\n1 1\n")
            with self.assertRaises(ValueError):
                photometry.read(other)


if __name__ == "__main__":
    unittest.main()
