"""A corridor with a bend: both luminaires hang in one leg, all sensors lie in the other."""

from contest.room import Diffuse, Luminaire, Rectangle, Room, grid
from contest.rooms.office import FOLDER

HEIGHT = 2.5


def room() -> Room:
    """Legs of 8 m (along x) and 10 m (along y), 2 m wide; sensors 2 cm above the floor."""
    plan = [(0.0, 0.0), (8.0, 0.0), (8.0, 10.0), (6.0, 10.0), (6.0, 2.0), (0.0, 2.0)]
    surfaces = [
        Rectangle("wall", (x, y, 0.0), (to_x - x, to_y - y, 0.0), (0.0, 0.0, HEIGHT))
        for (x, y), (to_x, to_y) in zip(plan, plan[1:] + plan[:1])
    ]
    for name, z in (("floor", 0.0), ("ceiling", HEIGHT)):
        surfaces.append(Rectangle(name, (0.0, 0.0, z), (8.0, 0.0, 0.0), (0.0, 2.0, 0.0)))
        surfaces.append(Rectangle(name, (6.0, 2.0, z), (2.0, 0.0, 0.0), (0.0, 8.0, 0.0)))
    up = (0.0, 0.0, 1.0)
    return Room(
        name="bend",
        title="Corridor with a bend",
        sensors=grid((6.2, 3.4, 0.02), (1.2, 0.0, 0.0), (0.0, 6.0, 0.0), (3, 16), up),
        materials={"floor": Diffuse(0.3), "wall": Diffuse(0.6), "ceiling": Diffuse(0.7)},
        rectangles=surfaces,
        luminaires=[
            Luminaire(FOLDER / "batwing.ies", (x, 1.0, 2.45), c0=(0.0, 1.0, 0.0))
            for x in (2.5, 5.0)
        ],
    )
