//! The sun through pinholes, glass and doors, and on mirrors.

use crate::dice::Dice;
use crate::room::{FoundBy, Outside, Parallelogram, Room, SkyKind, SunPlace, Surface};
use crate::shell::{Block, Opening, Side};
use glam::DVec3;

const SIZE_M: [f64; 3] = [4.0, 5.0, 2.8];
/// Farther than all rooms reach.
const FAR_M: f64 = 1e5;

/// Sky and sun before the wall at y = 0, which looks south.
fn add_sun(room: &mut Room, dice: &mut Dice) -> SunPlace {
    let sun = SunPlace {
        altitude_deg: dice.draw("altitude deg", 15.0, 55.0),
        azimuth_deg: dice.draw("azimuth deg", 150.0, 210.0),
        normal_illuminance_lx: dice.log("sun lx", 1e4, 9e4),
    };
    let sky = Outside::sky(SkyKind::Uniform, dice.log("sky cd/m2", 300.0, 5000.0));
    room.outside = Some(Outside { sun: Some(sun), ..sky });
    sun
}

/// The wall's window as a way in: `u x v` toward the outside, which is at low y.
fn way_in(window: Opening) -> Parallelogram {
    // x cross z is -y.
    window.at(0.0)
}

fn window(dice: &mut Dice) -> Opening {
    let width = dice.draw("window m", 0.5, 2.0);
    Opening { side: Side::LowY, low: [2.0 - 0.5 * width, 1.0], high: [2.0 + 0.5 * width, 2.2] }
}

fn add_cells(room: &mut Room, dice: &mut Dice, side_m: f64) {
    for column in 0..3 {
        for row in 0..3 {
            let middle =
                DVec3::new(0.8 + 1.2 * f64::from(column), 0.8 + 1.5 * f64::from(row), 0.02);
            room.add_cell(middle, DVec3::Z, side_m);
        }
    }
    let wall = DVec3::new(dice.between(0.5, 3.5), 4.98, 1.2);
    room.add_cell(wall, DVec3::NEG_Y, side_m);
}

/// Pinholes in a wall, the sun on cells.
pub(crate) fn pinholes(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let block = Block::new([0.0; 3], SIZE_M);
    let count = dice.count("pinholes", 1, 6);
    let side = dice.log("pinhole m", 0.001, 0.03);
    let mut holes = Vec::new();
    for hole in 0..count {
        let x = 0.5 + 0.5 * f64::from(hole) + 0.3 * dice.unit();
        let z = dice.between(1.2, 2.4);
        holes.push(Opening { side: Side::LowY, low: [x, z], high: [x + side, z + side] });
    }
    room.add_shell(block, Surface::Grey(dice.draw("reflectance", 0.2, 0.7)), &holes);
    add_sun(&mut room, dice);
    room.ways_in = holes.iter().map(|&hole| way_in(hole)).collect();
    room.add_lamp(DVec3::new(3.0, 4.0, 2.5), dice.log("lamp cd", 0.1, 10.0));
    add_cells(&mut room, dice, 0.8);
    (room.sun_found, room.sky_found) = (FoundBy::BeamsAndJoins, FoundBy::BeamsAndJoins);
    if dice.coin("openings named") {
        room.openings = room.ways_in.clone();
    }
    room
}

/// Glazing drawn as a solid body before a window.
pub(crate) fn glass_body(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let block = Block::new([0.0; 3], SIZE_M);
    let window = window(dice);
    room.add_shell(block, Surface::Grey(dice.draw("reflectance", 0.3, 0.75)), &[window]);
    let thickness = dice.log("thickness m", 0.004, 0.05);
    let low = [window.low[0] - 0.05, -0.002 - thickness, window.low[1] - 0.05];
    let high = [window.high[0] + 0.05, -0.002, window.high[1] + 0.05];
    room.add_body(Block::new(low, high), Surface::Glass(dice.draw("eta", 1.4, 1.7)));
    add_sun(&mut room, dice);
    add_cells(&mut room, dice, 0.4);
    room.add_hints(block, [window.at(0.0)]);
    room.sun_found = FoundBy::Joins;
    room
}

/// Panes one behind the other in a window.
pub(crate) fn panes(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let block = Block::new([0.0; 3], SIZE_M);
    let window = window(dice);
    room.add_shell(block, Surface::Grey(dice.draw("reflectance", 0.3, 0.75)), &[window]);
    for pane in 0..dice.count("panes", 1, 4) {
        let y = 0.02 * f64::from(pane) + 0.001;
        room.add_face(window.at(y), Surface::Pane(1.52));
    }
    add_sun(&mut room, dice);
    room.ways_in = vec![way_in(window)];
    add_cells(&mut room, dice, 0.4);
    room.add_hints(block, [window.at(0.0)]);
    (room.sun_found, room.hint_shares) = (FoundBy::Joins, [0.4, 0.1]);
    if dice.coin("openings named") {
        room.openings = room.ways_in.clone();
    }
    room
}

/// A sheet that scatters the sun in a window.
pub(crate) fn blind(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let block = Block::new([0.0; 3], SIZE_M);
    let window = window(dice);
    room.add_shell(block, Surface::Grey(dice.draw("reflectance", 0.3, 0.75)), &[window]);
    let transmittance = dice.log("transmittance", 0.02, 0.5);
    let mut sheet = window;
    // A strip at the bottom is left open.
    sheet.low[1] += dice.log("gap m", 0.005, 0.3);
    room.add_face(sheet.at(0.01), Surface::Translucent { reflectance: 0.4, transmittance });
    add_sun(&mut room, dice);
    room.scatter(dice, DVec3::new(0.4, 0.5, 0.02), DVec3::new(3.6, 4.6, 2.2), 8);
    room.add_hints(block, [window.at(0.0)]);
    room.hint_shares = [0.4, 0.1];
    room
}

/// A mirror on the floor throws the sun to ceiling and walls.
pub(crate) fn mirror(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let block = Block::new([0.0; 3], SIZE_M);
    let window = Opening { side: Side::LowY, low: [1.0, 0.8], high: [3.0, 2.4] };
    room.add_shell(block, Surface::Grey(dice.draw("reflectance", 0.2, 0.7)), &[window]);
    let side = dice.log("mirror m", 0.02, 1.0);
    let slope = DVec3::new(0.0, dice.draw("slope", -0.2, 0.2), 1.0).normalize();
    let sun = add_sun(&mut room, dice);
    // Where the ray through the middle of the window comes to the floor.
    let along = sun.direction();
    let entry = DVec3::new(2.0, 0.0, 1.6);
    let floor = entry - along * ((entry.z - 0.3) / along.z);
    let middle = floor.clamp(DVec3::new(0.6, 0.6, 0.3), DVec3::new(3.4, 4.4, 0.3));
    room.add_face(Parallelogram::square(middle, slope, side), Surface::Mirror(0.9));
    room.ways_in = vec![way_in(window)];
    let thrown = slope * (2.0 * along.dot(slope)) - along;
    let reach = (2.79 - middle.z) / thrown.z;
    let spot = middle + thrown * reach;
    let spot = spot.clamp(DVec3::new(0.5, 0.5, 0.0), DVec3::new(3.5, 4.5, 2.79));
    for aside in [0.0, 0.3, -0.3, 1.0] {
        let place = DVec3::new((spot.x + aside).clamp(0.3, 3.7), spot.y, 2.79);
        room.add_cell(place, DVec3::NEG_Z, 0.2);
    }
    for _ in 0..4 {
        let place = dice.within(DVec3::new(0.5, 0.5, 0.8), DVec3::new(3.5, 4.5, 1.6));
        room.add_cell(place, DVec3::NEG_Z, 0.3);
    }
    room.add_hints(block, [window.at(0.0)]);
    (room.sun_found, room.hint_shares) = (FoundBy::Joins, [0.4, 0.1]);
    room
}

/// A shelf in the window, white or a mirror, throws the sun to the ceiling.
pub(crate) fn shelf(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let block = Block::new([0.0; 3], SIZE_M);
    let window = Opening { side: Side::LowY, low: [0.5, 0.9], high: [3.5, 2.6] };
    room.add_shell(block, Surface::Grey(dice.draw("reflectance", 0.3, 0.8)), &[window]);
    let depth = dice.draw("depth m", 0.2, 0.8);
    let is_mirror = dice.coin("mirror");
    let top = if is_mirror { Surface::Mirror(0.9) } else { Surface::Grey(0.85) };
    let corner = DVec3::new(0.4, -0.5 * depth, 2.0);
    room.add_face(Parallelogram { corner, u: DVec3::X * 3.2, v: DVec3::Y * depth }, top);
    let below = DVec3::new(0.4, -0.5 * depth, 1.98);
    room.add_face(
        Parallelogram { corner: below, u: DVec3::Y * depth, v: DVec3::X * 3.2 },
        Surface::Grey(0.5),
    );
    let sun = add_sun(&mut room, dice);
    let mut shown = sun.direction();
    shown.z = -shown.z;
    room.scatter(dice, DVec3::new(0.4, 1.0, 0.4), DVec3::new(3.6, 4.6, 1.8), 6);
    room.add_place(DVec3::new(2.0, 1.5, 2.79), DVec3::NEG_Z);
    room.add_place(DVec3::new(2.0, 3.0, 2.79), DVec3::NEG_Z);
    let mut hints = vec![window.at(0.0)];
    if is_mirror {
        hints.push(Parallelogram::square(shown * FAR_M, -shown, 0.01 * FAR_M));
    }
    room.add_hints(block, hints);
    room.hint_shares = [0.5, 0.2];
    room
}

/// A door that stands open by a hair, the sun behind it.
pub(crate) fn door(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let block = Block::new([0.0; 3], SIZE_M);
    let gap = dice.log("gap m", 0.002, 0.1);
    let hole = Opening { side: Side::LowY, low: [2.0, 0.0], high: [2.0 + gap, 2.1] };
    room.add_shell(block, Surface::Grey(dice.draw("reflectance", 0.2, 0.7)), &[hole]);
    add_sun(&mut room, dice);
    room.ways_in = vec![way_in(hole)];
    add_cells(&mut room, dice, 0.5);
    (room.sun_found, room.sky_found) = (FoundBy::BeamsAndJoins, FoundBy::BeamsAndJoins);
    room
}
