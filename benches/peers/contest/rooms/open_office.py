"""An open office: 60 batwing luminaires, 24 desks in pairs with screens between them."""

from contest.room import Diffuse, Luminaire, Room, grid
from contest.rooms.office import FOLDER
from contest.shapes import box_faces, desk, hall


def room() -> Room:
    """18 m x 12 m x 3 m, sensors at 75 cm."""
    surfaces = hall((18.0, 12.0, 3.0), "floor", "wall", "ceiling")
    for column in range(6):
        for row in range(2):
            x, y = 1.4 + 2.7 * column, 2.2 + 5.2 * row
            surfaces += desk(x, y, 1.6, 0.8) + desk(x, y + 0.86, 1.6, 0.8)
            surfaces += box_faces("screen", (x, y + 0.81, 0.0), (x + 1.6, y + 0.85, 1.25))
    up = (0.0, 0.0, 1.0)
    return Room(
        name="open_office",
        title="Open office, 60 luminaires",
        sensors=grid((0.5, 0.5, 0.75), (17.0, 0.0, 0.0), (0.0, 11.0, 0.0), (12, 8), up),
        materials={
            "floor": Diffuse(0.2),
            "wall": Diffuse(0.5),
            "ceiling": Diffuse(0.8),
            "desk": Diffuse(0.4),
            "metal": Diffuse(0.3),
            "screen": Diffuse(0.35),
        },
        rectangles=surfaces,
        luminaires=[
            Luminaire(FOLDER / "batwing.ies", (0.9 + 1.8 * column, 1.0 + 2.0 * row, 2.7))
            for column in range(10)
            for row in range(6)
        ],
    )
