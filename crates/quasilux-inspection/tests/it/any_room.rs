//! Wrong rooms at random: each fault is told at its section, and the same room without it is right.

use crate::furnished::{Furnished, Lamp, Patch, v};
use crate::room::{plate, shell};
use crate::spoil::{Spoil, fault, quiet, told};
use glam::DVec3;
use quasilux_inspection::Check;
use quasilux_stats::SplitMix64;

const LUMINAIRES: &str = "[[luminaires]]";
const SENSORS: &str = "[[sensors]]";
const SCENE: &str = "[scene]";
const OUTSIDE: &[Check] = &[Check::LampOutside];

/// Moves a lamp; its number, from 1.
fn move_lamp(
    room: &mut Furnished,
    dice: &mut SplitMix64,
    place: impl Fn(&Furnished, &mut SplitMix64, DVec3) -> DVec3,
) -> usize {
    let number = dice.below(room.lamps.len());
    room.lamps[number].position = place(room, dice, room.lamps[number].position);
    number + 1
}

/// Moves a lamp to 1 mm to 20 cm above the ceiling.
fn lift(room: &mut Furnished, dice: &mut SplitMix64) -> usize {
    move_lamp(room, dice, |room, dice, at| at.with_z(room.size.z + dice.within(0.001, 0.2)))
}

pub(crate) const LAMPS: &[Spoil] = &[
    |room, dice| {
        let number = lift(room, dice);
        Some(fault("above the ceiling", OUTSIDE, LUMINAIRES).at(number).saying("\"ceiling\""))
    },
    |room, dice| {
        let number = move_lamp(room, dice, |room, _, at| at.with_z(room.size.z + 0.001));
        Some(fault("1 mm above it", OUTSIDE, LUMINAIRES).at(number).saying("\"ceiling\""))
    },
    |room, dice| {
        let number = move_lamp(room, dice, |_, dice, at| at.with_z(-dice.within(0.01, 0.4)));
        Some(fault("below the floor", OUTSIDE, LUMINAIRES).at(number).saying("\"floor\""))
    },
    |room, dice| {
        let behind = |room: &Furnished, dice: &mut SplitMix64, at: DVec3| {
            at.with_x(room.size.x + dice.within(0.01, 0.4))
        };
        let number = move_lamp(room, dice, behind);
        Some(fault("behind a wall", OUTSIDE, LUMINAIRES).at(number).saying("\"east\""))
    },
    |room, dice| {
        let in_wall = |room: &Furnished, dice: &mut SplitMix64, at: DVec3| {
            at.with_y(room.size.y).with_z(dice.within(0.5, 0.9) * room.size.z)
        };
        let number = move_lamp(room, dice, in_wall);
        "aim = [0, 0, -1]\n".clone_into(&mut room.lamps[number - 1].keys);
        Some(fault("in a wall", &[Check::LampInSurface], LUMINAIRES).at(number))
    },
    |room, dice| {
        let [low, high] = *room.cabinets.first()?;
        let number = move_lamp(room, dice, |_, _, _| 0.5 * (low + high));
        Some(fault("in a cabinet", &[Check::LampInBody], LUMINAIRES).at(number))
    },
    |room, dice| {
        let at = room.at(room.lamps[0].position.with_z(room.size.z + dice.within(0.001, 0.2)));
        room.sections +=
            &format!("[[lights]]\nkind = \"point\"\nintensity_cd = 200\nposition = {at}\n");
        Some(fault("a point above the ceiling", OUTSIDE, "[[lights]]").saying("\"ceiling\""))
    },
];

/// Their light comes to a room with windows, too.
const FAR_LAMPS: &[Spoil] = &[
    |room, dice| {
        let away = |_: &Furnished, dice: &mut SplitMix64, at: DVec3| {
            at + DVec3::Y * dice.within(60.0, 900.0)
        };
        let number = move_lamp(room, dice, away);
        Some(fault("far away", OUTSIDE, LUMINAIRES).at(number))
    },
    |room, dice| {
        let margin = v(dice.within(3.0, 20.0), dice.within(3.0, 20.0), dice.within(1.0, 9.0));
        room.faces.extend(shell(-margin, room.size + margin));
        let number = lift(room, dice);
        Some(fault("above it, in a hall", &[Check::LampBehindSurface], LUMINAIRES).at(number))
    },
];

#[test]
fn lamps_in_wrong_places() {
    told(0..8, Furnished::new, LAMPS);
    told(0..8, Furnished::new, FAR_LAMPS);
}

const BRIGHT: &[Check] = &[Check::LampBright];
const FILES: &[Spoil] = &[
    |room, dice| {
        let number = dice.below(room.lamps.len());
        "dimming = 100\n".clone_into(&mut room.lamps[number].keys);
        Some(fault("dimming 100", BRIGHT, LUMINAIRES).at(number + 1))
    },
    |room, dice| {
        let watts = 2200.0 / dice.within(450.0, 1100.0);
        room.lamp_file = room.lamp_file.replace("\n1 1 20\n", &format!("\n1 1 {watts:.2}\n"));
        Some(fault("more than 400 lm/W", BRIGHT, LUMINAIRES))
    },
    |room, dice| {
        let multiplier = format!("1 2500 {} 4", dice.pick(&[0.01, 10.0, 100.0]));
        room.lamp_file = room.lamp_file.replace("1 2500 1 4", &multiplier);
        Some(fault("a wrong multiplier", &[Check::LampFlux], LUMINAIRES))
    },
    |room, _| {
        let Lamp { position, keys } = room.lamps[0].clone();
        room.lamps.push(Lamp { position, keys });
        Some(fault("listed twice", &[Check::LampTwice], LUMINAIRES).at(room.lamps.len()))
    },
    |room, _| {
        room.lamp_file = room.lamp_file.replace("0.1 1.2 0\n", "100 1200 0\n");
        Some(fault("a luminous opening in mm", &[Check::LampTooBig], LUMINAIRES))
    },
    |room, _| {
        let twin = plate("carpet", "wall", [DVec3::ZERO, room.size.with_z(0.0)], true);
        room.faces.push(twin);
        Some(fault("a floor twice", &[Check::CoincidentFaces], SCENE))
    },
];

#[test]
fn lamps_and_floors_that_cannot_be() {
    told(50..56, Furnished::new, FILES);
}

/// The grid over a table, so far below its top.
fn below_a_table(room: &mut Furnished, below_m: f64) -> Option<()> {
    let [low, high] = *room.tops.first()?;
    let inset = v(0.12, 0.12, 0.0);
    room.grid = Patch {
        origin: (low + inset).with_z(low.z - below_m),
        u: DVec3::X * (high.x - low.x - 0.24),
        v: DVec3::Y * (high.y - low.y - 0.24),
    };
    Some(())
}

const COVERED: &[Check] = &[Check::SensorCovered];
const BEYOND: &[Check] = &[Check::SensorOutside];
pub(crate) const GRIDS: &[Spoil] = &[
    |room, dice| {
        below_a_table(room, dice.within(0.003, 0.029))?;
        Some(fault("a grid below a table", COVERED, SENSORS))
    },
    |room, dice| {
        let [low, _] = *room.tops.first()?;
        room.grid.origin.z = low.z - dice.within(0.003, 0.029);
        Some(fault("a workplane with tables right above", COVERED, SENSORS))
    },
    |room, _| {
        std::mem::swap(&mut room.grid.u, &mut room.grid.v);
        Some(fault("u and v in the other order", &[Check::GridLooksDown], SENSORS))
    },
    |room, _| {
        "normal = [0, 0, -1]\n".clone_into(&mut room.grid_keys);
        Some(fault("looking down", &[Check::GridLooksDown], SENSORS))
    },
    |room, _| {
        room.grid.origin.z = 0.001;
        "normal = [0, 0, -1]\n".clone_into(&mut room.grid_keys);
        Some(fault("looking into the floor", COVERED, SENSORS))
    },
    |room, dice| {
        room.grid.origin.x += dice.within(0.3, 0.7) * room.size.x;
        Some(fault("beyond a wall", BEYOND, SENSORS).saying("within the walls"))
    },
    |room, _| {
        room.spacing_m = 40.0;
        Some(fault("of one point", &[Check::GridSize], SENSORS))
    },
];
/// By day these are on a roof and on a square.
const FAR_GRIDS: &[Spoil] = &[
    |room, dice| {
        room.grid.origin.z = room.size.z + dice.within(0.01, 0.5);
        Some(fault("above the ceiling", BEYOND, SENSORS))
    },
    |room, dice| {
        room.grid.origin.x += room.size.x + dice.within(0.0, 30.0);
        Some(fault("outside", BEYOND, SENSORS))
    },
];

#[test]
fn sensors_in_wrong_places() {
    told(100..107, Furnished::new, GRIDS);
    told(100..107, Furnished::new, FAR_GRIDS);
}

/// Names and sizes of units.
const UNITS: [(&str, f64); 4] = [("mm", 0.001), ("cm", 0.01), ("in", 0.0254), ("ft", 0.3048)];
const EITHER: &[Check] = &[Check::Units, Check::GeometryElsewhere];
pub(crate) const SIZES: &[Spoil] = &[
    |room, dice| {
        let unit = dice.pick(&UNITS);
        room.position_unit = unit.1;
        let cure = format!("set position_units = \"{}\"", unit.0);
        Some(fault("positions of another unit", EITHER, SCENE).saying(&cure))
    },
    |room, dice| {
        room.scene_keys = format!("units = \"{}\"\n", dice.pick(&UNITS).0);
        Some(fault("metres taken for another unit", EITHER, SCENE))
    },
    |room, dice| {
        let away = dice.pick(&[DVec3::X, DVec3::NEG_X, DVec3::Y, v(0.6, 0.8, 0.0)]) * 1000.0;
        for corner in room.faces.iter_mut().flat_map(|face| &mut face.corners) {
            *corner += away;
        }
        Some(fault("a kilometre away", &[Check::GeometryElsewhere], SCENE))
    },
    |room, _| {
        "up = \"y\"\n".clone_into(&mut room.scene_keys);
        Some(fault("another axis up", &[Check::UpAxis], SCENE))
    },
];
/// Told by the height of the room: beside a higher house not always in the right unit.
const HEIGHTS: &[Spoil] = &[
    |room, dice| {
        let unit = dice.pick(&UNITS);
        room.geometry_unit = unit.1;
        let cure = format!("set units = \"{}\"", unit.0);
        Some(fault("geometry of another unit", EITHER, SCENE).saying(&cure))
    },
    |room, dice| {
        // All in feet is a large room.
        let unit = dice.pick(&UNITS[..3]);
        (room.geometry_unit, room.position_unit) = (unit.1, unit.1);
        Some(fault("both of another unit", EITHER, SCENE).saying(&format!("\"{}\"", unit.0)))
    },
];

#[test]
fn wrong_units_and_axes() {
    told(200..208, Furnished::new, SIZES);
    told(200..208, Furnished::new, HEIGHTS);
}

/// A camera at a place, looking at another.
fn look(room: &mut Furnished, position: DVec3, target: DVec3) {
    let [position, target] = [room.at(position), room.at(target)];
    room.sections += &format!(
        "[[cameras]]\nname = \"view\"\nposition = {position}\ntarget = {target}\n\
         vertical_fov_deg = 60\nresolution = [60, 40]\n"
    );
}

const VIEWS: &[Spoil] = &[
    |room, dice| {
        let at = v(0.5 * room.size.x, -dice.within(0.3, 9.0), 1.5);
        look(room, at, 0.5 * room.size);
        Some(fault("a camera behind a wall", &[Check::CameraOutside], "[[cameras]]"))
    },
    |room, dice| {
        let at = v(0.5 * room.size.x, -dice.within(0.3, 9.0), 1.5);
        look(room, at, at - DVec3::Y);
        Some(fault("a camera that looks away", &[Check::CameraOutside], "[[cameras]]"))
    },
    |room, dice| {
        let low = v(0.2, 0.2, room.size.z - dice.within(0.0, 0.05));
        let high = v(dice.within(0.5, 1.4), 0.8, low.z);
        room.faces.push(plate("panel", "panel", [low, high], true));
        "[materials.panel]\nreflectance = 0\n[[lights]]\nkind = \"area\"\nmaterial = \"panel\"\n\
         luminance_cd_m2 = 3000\n"
            .clone_into(&mut room.sections);
        Some(fault("a panel turned over", &[Check::EmitterLooksAway], "material = "))
    },
    |room, dice| {
        let wall = dice.pick(&["north", "west", "east"]);
        room.faces.retain(|face| face.object != wall);
        Some(fault("a wall missing", &[Check::Hole], SCENE))
    },
];

#[test]
fn cameras_panels_and_walls() {
    told(300..308, Furnished::new, VIEWS);
}

/// What is meant: light upward, points on floor and ceiling, on the wall, beside and under tables.
const MEANT: &[fn(&mut Furnished, &mut SplitMix64)] = &[
    |room, dice| {
        let number = dice.below(room.lamps.len());
        room.lamps[number].position.z = dice.within(1.5, room.size.z - 0.3);
        "aim = [0, 0, 1]\n".clone_into(&mut room.lamps[number].keys);
    },
    |room, _| room.grid.origin.z = 0.0,
    |room, _| {
        // On the ceiling, looking down.
        room.grid.origin.z = room.size.z - 0.01;
        "normal = [0, 0, -1]\n".clone_into(&mut room.grid_keys);
    },
    |room, dice| {
        // On a wall.
        room.grid.origin = v(0.0, 0.3, 0.4);
        room.grid.u = DVec3::Y * (room.size.y - 0.6);
        room.grid.v = DVec3::Z * dice.within(0.5, room.size.z - 0.6);
    },
    |room, dice| {
        let _ = below_a_table(room, dice.within(0.05, 0.6));
    },
    |room, dice| room.lamps[0].position.z = room.size.z - dice.within(0.0, 0.001),
    |room, _| room.lamps.truncate(1),
    |room, _| {
        // A picture from the middle.
        let [from, to] = [0.5 * room.size, v(0.1, 0.1, 0.5)];
        look(room, from, to);
    },
];

#[test]
fn rooms_that_are_meant_so_are_right() {
    quiet(400..408, Furnished::new, MEANT);
    quiet(410..414, Furnished::with_window, MEANT);
}
