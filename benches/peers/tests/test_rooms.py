"""The rooms: closed, furnished, with sensors in the open."""

import unittest
from importlib import import_module

import numpy as np

from compare import ROOMS
from contest import references
from contest.room import Pane, Room


def room(name: str) -> Room:
    return import_module(f"contest.rooms.{name}").room()


class Panes(unittest.TestCase):
    def test_head_on_and_grazing(self) -> None:
        pane = Pane(1.5)
        self.assertAlmostEqual(pane.reflectance(0.0), 2 * 0.04 / 1.04)
        self.assertAlmostEqual(pane.reflectance(90.0), 1.0)


class Rooms(unittest.TestCase):
    def test_names_are_those_of_their_modules(self) -> None:
        self.assertEqual([room(name).name for name in ROOMS], ROOMS)

    def test_all_materials_are_known(self) -> None:
        for name in ROOMS:
            made = room(name)
            used = {part.material for part in [*made.rectangles, *made.meshes]}
            self.assertLessEqual(used, set(made.materials), name)

    def test_normals_have_length_one(self) -> None:
        for name in ROOMS:
            lengths = np.linalg.norm(room(name).sensors.normals, axis=1)
            np.testing.assert_allclose(lengths, 1.0, err_msg=name)

    def test_references_are_of_these_rooms_and_agreed(self) -> None:
        for name in ROOMS:
            reference = references.load(room(name))
            self.assertTrue(reference.agreement.holds(), name)

    def test_counts(self) -> None:
        self.assertEqual(room("open_office").light_count(), 60)
        self.assertEqual(room("gallery").light_count(), 100)
        self.assertGreaterEqual(room("canteen").triangle_count(), 1_000_000)


if __name__ == "__main__":
    unittest.main()
