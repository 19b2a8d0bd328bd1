"""Rooms with one window, and how each program is told of them.

The window is a rectangle in the wall at y = 0, with the south outside.
"""

from dataclasses import dataclass
from pathlib import Path

from contest import obj
from contest.programs import quasilux, radiance
from contest.room import Diffuse, Rectangle, Room, grid
from outside.blinds import Blinds
from outside.glass import Glass

WINDOW = "window"
UP = (0.0, 0.0, 1.0)


@dataclass(frozen=True)
class Size:
    """A box of x by y by z metres, and the window's lower and upper corner in x and z."""

    box: tuple[float, float, float]
    low: tuple[float, float]
    high: tuple[float, float]


@dataclass(frozen=True)
class Windowed:
    """A room, its window, whose normal points outdoors, and what fills it."""

    room: Room
    window: Rectangle
    filling: Glass | Blinds


def small(filling: Glass | Blinds) -> Windowed:
    """4 m x 6 m x 3 m with 12 sensors, for moments."""
    size = Size((4.0, 6.0, 3.0), (0.5, 0.9), (3.5, 2.5))
    return _windowed("small", size, filling, (3, 4))


def office() -> Windowed:
    """6 m x 8 m x 2.8 m with 96 sensors, for a year."""
    size = Size((6.0, 8.0, 2.8), (0.3, 0.9), (5.7, 2.5))
    return _windowed("office", size, Glass(0.8), (8, 12))


def write_project(place: Windowed, outside: list[str], folder: Path) -> Path:
    """A project file of quasilux with its OBJ; `outside` are lines of it."""
    room = place.room
    whole = Room(room.name, "", room.sensors, {}, [*room.rectangles, place.window])
    obj.write(whole, folder / "room.obj", [])
    lines = ["[scene]", 'geometry = ["room.obj"]', "", "[materials]"]
    lines += [f"{name} = {quasilux.material(kind)}" for name, kind in room.materials.items()]
    lines += [f"{WINDOW} = {place.filling.project(folder)}", "", *outside, ""]
    lines += ["[[sensors]]", 'name = "sensors"', 'kind = "points"']
    lines += [f"points = {room.sensors.positions.tolist()}"]
    lines += [f"normals = {room.sensors.normals.tolist()}", ""]
    path = folder / "room.toml"
    path.write_text("\n".join(lines))
    return path


def write_octree(place: Windowed, outside: list[str], folder: Path) -> Path:
    """An octree of Radiance; `outside` are lines of its scene."""
    room = place.room
    lines = [radiance.material(name, kind) for name, kind in room.materials.items()]
    for index, part in enumerate(room.rectangles):
        lines.append(radiance.polygon(part.material, f"r{index}", part.corners()))
    lines.append(place.filling.radiance(WINDOW, folder))
    # Radiance turns the normals of such surfaces into the room.
    lines.append(radiance.polygon(WINDOW, "pane", place.window.corners()[::-1]))
    (folder / "room.rad").write_text("\n".join([*lines, *outside]) + "\n")
    octree = folder / "room.oct"
    octree.write_bytes(radiance.tool("oconv", ["room.rad"], folder, b""))
    return octree


def sensor_lines(room: Room) -> bytes:
    """The sensors as `rtrace` and `rcontrib` read them."""
    pairs = zip(room.sensors.positions, room.sensors.normals, strict=True)
    rows = [" ".join(f"{x:.9g}" for x in (*position, *normal)) for position, normal in pairs]
    return ("\n".join(rows) + "\n").encode()


def _windowed(
    name: str, size: Size, filling: Glass | Blinds, counts: tuple[int, int]
) -> Windowed:
    x, y, z = size.box
    (left, bottom), (right, top) = size.low, size.high
    across, along, up = (x, 0.0, 0.0), (0.0, y, 0.0), (0.0, 0.0, z)
    surfaces = [
        Rectangle("floor", (0.0, 0.0, 0.0), across, along),
        Rectangle("ceiling", (0.0, 0.0, z), along, across),
        Rectangle("wall", (0.0, y, 0.0), across, up),
        Rectangle("wall", (0.0, 0.0, 0.0), along, up),
        Rectangle("wall", (x, 0.0, 0.0), up, along),
        _facade(0.0, 0.0, x, bottom),
        _facade(0.0, top, x, z),
        _facade(0.0, bottom, left, top),
        _facade(right, bottom, x, top),
    ]
    width, height = (right - left, 0.0, 0.0), (0.0, 0.0, top - bottom)
    window = Rectangle(WINDOW, (left, 0.0, bottom), width, height)
    margin, plane = 0.3, 0.8
    inner = ((x - 2 * margin, 0.0, 0.0), (0.0, y - 2 * margin, 0.0))
    sensors = grid((margin, margin, plane), *inner, counts, UP)
    materials = {"floor": Diffuse(0.2), "wall": Diffuse(0.5), "ceiling": Diffuse(0.7)}
    return Windowed(Room(name, "", sensors, materials, surfaces), window, filling)


def _facade(left: float, bottom: float, right: float, top: float) -> Rectangle:
    width, height = (right - left, 0.0, 0.0), (0.0, 0.0, top - bottom)
    return Rectangle("wall", (left, 0.0, bottom), width, height)
