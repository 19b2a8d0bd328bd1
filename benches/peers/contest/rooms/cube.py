"""The diffuse cube of Voloboy, Dmitriev and Kopylov (2003): one point in the middle, no shadow."""

from contest.room import Diffuse, PointLight, Room, grid
from contest.shapes import box_faces


def room() -> Room:
    """10 m, every wall with reflectance 2/3, 100 sensors 1 cm in front of one wall."""
    normal = (-1.0, 0.0, 0.0)
    sensors = grid((4.99, -5.0, -5.0), (0.0, 10.0, 0.0), (0.0, 0.0, 10.0), (10, 10), normal)
    return Room(
        name="cube",
        title="Diffuse cube, one point light",
        sensors=sensors,
        materials={"wall": Diffuse(2 / 3)},
        rectangles=box_faces("wall", (-5.0, -5.0, -5.0), (5.0, 5.0, 5.0)),
        points=[PointLight((0.0, 0.0, 0.0), 50000.0)],
    )
