//! Bodies of clear glass: balls, slabs in series.

use crate::dice::Dice;
use crate::room::{FoundBy, Lookout, Parallelogram, Room, Surface};
use crate::shell::{Block, Opening, Side};
use glam::DVec3;

/// A ball in a corner, a lamp across the room.
pub(crate) fn ball(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let block = Block::new([0.0; 3], [4.0, 4.0, 2.6]);
    room.add_shell(block, Surface::Grey(dice.draw("reflectance", 0.2, 0.8)), &[]);
    let radius = dice.log("ball m", 0.02, 0.3);
    let middle = DVec3::new(1.3 * radius, 1.3 * radius, 1.2 * radius + dice.draw("z m", 0.0, 1.0));
    room.add_ball(middle, radius, Surface::Glass(dice.draw("eta", 1.3, 1.8)));
    let place = dice.within(DVec3::new(1.5, 1.5, 1.0), DVec3::new(3.5, 3.5, 2.3));
    room.add_lamp(place, dice.log("lamp cd", 1.0, 1000.0));
    room.find_all(FoundBy::Joins);
    let floor = DVec3::new(1.5 * radius, 1.5 * radius, 0.001);
    room.add_cell(floor, DVec3::Z, radius);
    let wall = DVec3::new(0.001, middle.y, middle.z);
    room.add_cell(wall, DVec3::X, radius);
    add_cells(&mut room, dice, 5);
    room
}

/// A dark room with a night light and a ball, a keyhole to a bright room.
pub(crate) fn keyhole_ball(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let side = dice.log("hole m", 0.01, 0.1);
    let hole = Opening { side: Side::HighY, low: [1.8, 1.0], high: [1.8 + side, 1.0 + side] };
    let dark = Block::new([0.0; 3], [4.0, 4.0, 2.6]);
    let bright = Block::new([0.0, 4.05, 0.0], [4.0, 8.0, 2.6]);
    let walls = Surface::Grey(dice.draw("reflectance", 0.3, 0.8));
    room.add_shell(dark, walls, &[hole]);
    room.add_shell(bright, walls, &[Opening { side: Side::LowY, ..hole }]);
    room.add_tunnel(hole.tunnel(4.0, 4.05), 1, walls);
    let radius = dice.log("ball m", 0.02, 0.2);
    let middle = DVec3::new(1.3 * radius, 1.3 * radius, 1.2 * radius);
    room.add_ball(middle, radius, Surface::Glass(1.5));
    room.add_lamp(DVec3::new(3.5, 0.6, 2.2), dice.log("night light cd", 0.003, 1.0));
    let intensity_cd = dice.log("downlights cd", 100.0, 30_000.0);
    room.add_downlight(DVec3::new(1.2, 5.5, 2.5), intensity_cd);
    room.add_downlight(DVec3::new(2.8, 6.5, 2.5), intensity_cd);
    room.find_all(FoundBy::Joins);
    room.lamps[1..].iter_mut().for_each(|lamp| lamp.found = FoundBy::BeamsAndJoins);
    let Block { low, high } = bright;
    room.aims.push(Lookout { shape: hole.at(4.05), low, high });
    room.aim_share = 0.5;
    room.add_cell(DVec3::new(1.5 * radius, 1.5 * radius, 0.001), DVec3::Z, radius);
    add_cells(&mut room, dice, 6);
    room
}

/// Slabs one behind the other between a panel and the places.
pub(crate) fn slabs(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let block = Block::new([0.0; 3], [6.0, 3.0, 2.6]);
    room.add_shell(block, Surface::Grey(dice.draw("reflectance", 0.2, 0.7)), &[]);
    let slabs = dice.count("slabs", 1, 6);
    let thickness = dice.log("thickness m", 0.004, 0.2);
    let eta = dice.draw("eta", 1.3, 1.8);
    for slab in 0..slabs {
        let x = 2.0 + 0.4 * f64::from(slab);
        let body = Block::new([x, 0.05, 0.05], [x + thickness, 2.95, 2.55]);
        room.add_body(body, Surface::Glass(eta));
    }
    let side = dice.log("panel m", 0.1, 1.0);
    let place = DVec3::new(0.5, 1.5, 1.4);
    let panel = Parallelogram::square(place, DVec3::X, side);
    room.add_panel(panel, dice.log("panel cd", 30.0, 3000.0) / (side * side));
    room.scatter(dice, DVec3::new(4.5, 0.3, 0.3), DVec3::new(5.7, 2.7, 2.3), 5);
    room.scatter(dice, DVec3::new(0.8, 0.3, 0.3), DVec3::new(1.8, 2.7, 2.3), 2);
    room.add_hints(block, [panel]);
    room.hint_shares = [0.4, 0.1];
    room
}

fn add_cells(room: &mut Room, dice: &mut Dice, count: u32) {
    for _ in 0..count {
        let place = dice.within(DVec3::new(0.6, 0.6, 0.1), DVec3::new(3.4, 3.4, 1.8));
        let normal = dice.normal();
        room.add_cell(place, normal, 0.3);
    }
}
