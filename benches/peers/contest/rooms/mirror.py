"""A room that a panel lights by way of a mirror: a baffle hides it from where people look."""

from contest.room import Diffuse, Mirror, Panel, Rectangle, Room, grid
from contest.shapes import box_faces, hall


def room() -> Room:
    """6 m x 4 m x 3 m; the mirror is the wall x = 0, the panel hangs on the baffle and faces it.

    Sensors stand upright behind the baffle, as faces that look into the mirror.
    """
    surfaces = hall((6.0, 4.0, 3.0), "floor", "wall", "ceiling")
    mirror = Rectangle("mirror", (0.01, 0.1, 0.1), (0.0, 3.8, 0.0), (0.0, 0.0, 2.8))
    baffle = box_faces("baffle", (1.7, 0.0, 1.5), (1.74, 4.0, 3.0), "-y +y +z")
    shining = Rectangle("panel", (1.69, 0.4, 1.6), (0.0, 0.0, 1.2), (0.0, 3.2, 0.0))
    ahead = (-1.0, 0.0, 0.0)
    return Room(
        name="mirror",
        title="Mirror wall, baffled area light",
        sensors=grid((2.4, 0.5, 1.1), (2.4, 0.0, 0.0), (0.0, 3.0, 0.0), (6, 8), ahead),
        materials={
            "floor": Diffuse(0.2),
            "wall": Diffuse(0.5),
            "ceiling": Diffuse(0.7),
            "baffle": Diffuse(0.3),
            "mirror": Mirror(0.9),
        },
        rectangles=[*surfaces, mirror, *baffle],
        panels=[Panel(shining, 1000.0)],
    )
