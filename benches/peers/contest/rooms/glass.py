"""Two offices with a glass wall between them; only one has its panels on."""

from contest.room import Diffuse, Pane, Panel, Rectangle, Room, grid
from contest.shapes import desk, hall


def room() -> Room:
    """8 m x 5 m x 2.8 m, the pane at x = 4 m, four ceiling panels of 1.2 m before it."""
    surfaces = hall((8.0, 5.0, 2.8), "floor", "wall", "ceiling")
    for x in (0.8, 2.2, 4.6, 6.2):
        for y in (1.0, 3.2):
            surfaces += desk(x, y, 1.0, 0.7)
    pane = Rectangle("glass", (4.0, 0.0, 0.0), (0.0, 5.0, 0.0), (0.0, 0.0, 2.8))
    panels = [
        Panel(Rectangle("panel", (x, y, 2.79), (0.0, 1.2, 0.0), (1.2, 0.0, 0.0)), 1000.0)
        for x in (0.5, 2.3)
        for y in (0.7, 3.1)
    ]
    up = (0.0, 0.0, 1.0)
    return Room(
        name="glass",
        title="Glass partition, 4 panels on one side",
        sensors=grid((0.4, 0.4, 0.75), (7.2, 0.0, 0.0), (0.0, 4.2, 0.0), (8, 6), up),
        materials={
            "floor": Diffuse(0.2),
            "wall": Diffuse(0.5),
            "ceiling": Diffuse(0.7),
            "desk": Diffuse(0.5),
            "metal": Diffuse(0.3),
            "glass": Pane(1.5),
        },
        rectangles=[*surfaces, pane],
        panels=panels,
    )
