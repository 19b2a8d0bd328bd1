"""A gallery: 100 narrow spots, most of them aimed at pictures on two walls."""

from pathlib import Path

from contest.room import Diffuse, Luminaire, Room, grid, joined
from contest.shapes import box_faces, hall

SPOT = Path(__file__).resolve().parent / "spot.ies"


def room() -> Room:
    """24 m x 10 m x 4 m; sensors on a wall and on the floor."""
    surfaces = hall((24.0, 10.0, 4.0), "floor", "wall", "ceiling")
    for index in range(6):
        x = 3.0 + 3.6 * index
        surfaces += box_faces("plinth", (x, 4.7, 0.0), (x + 0.6, 5.3, 1.1), "-z")
    lamps = []
    for index in range(40):
        x = 0.3 + 0.6 * index
        lamps.append(Luminaire(SPOT, (x, 2.0, 3.8), (0.0, -1.98, -2.3)))
        lamps.append(Luminaire(SPOT, (x, 8.0, 3.8), (0.0, 1.98, -2.3)))
    lamps += [Luminaire(SPOT, (1.2 + 1.2 * index, 5.0, 3.8)) for index in range(20 - 1)]
    lamps.append(Luminaire(SPOT, (23.4, 5.0, 3.8)))
    wall = grid((0.5, 0.02, 0.8), (23.0, 0.0, 0.0), (0.0, 0.0, 1.5), (16, 3), (0.0, 1.0, 0.0))
    floor = grid((0.5, 1.0, 0.02), (23.0, 0.0, 0.0), (0.0, 3.0, 0.0), (12, 4), (0.0, 0.0, 1.0))
    return Room(
        name="gallery",
        title="Gallery, 100 spots",
        sensors=joined([wall, floor]),
        materials={
            "floor": Diffuse(0.25),
            "wall": Diffuse(0.75),
            "ceiling": Diffuse(0.5),
            "plinth": Diffuse(0.7),
        },
        rectangles=surfaces,
        luminaires=lamps,
    )
