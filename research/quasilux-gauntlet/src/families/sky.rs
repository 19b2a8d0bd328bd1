//! Light of the sky from above: wells, pipes, roofs.

use crate::dice::Dice;
use crate::room::{FoundBy, Outside, Room, SkyKind, Surface};
use crate::shell::{Block, Opening, Side};
use glam::DVec3;

const SIZE_M: [f64; 3] = [6.0, 4.0, 2.8];

fn add_sky(room: &mut Room, dice: &mut Dice) {
    let kind = if dice.coin("overcast") { SkyKind::Overcast } else { SkyKind::Uniform };
    room.outside = Some(Outside::sky(kind, dice.log("zenith cd/m2", 300.0, 3e4)));
}

/// A well to the sky, its walls matt.
pub(crate) fn well(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let block = Block::new([0.0; 3], SIZE_M);
    let side = dice.log("side m", 0.3, 2.0);
    let depth = side * dice.log("depth over side", 1.0, 8.0);
    let low = [3.0 - 0.5 * side, 2.0 - 0.5 * side];
    let mouth = Opening { side: Side::HighZ, low, high: low.map(|low| low + side) };
    room.add_shell(block, Surface::Grey(dice.draw("reflectance", 0.2, 0.8)), &[mouth]);
    let lining = Surface::Grey(dice.draw("lining", 0.1, 0.9));
    let top = SIZE_M[2] + depth;
    room.add_tunnel(mouth.tunnel(SIZE_M[2], top), 2, lining);
    add_sky(&mut room, dice);
    room.scatter(dice, DVec3::splat(0.3), DVec3::new(5.7, 3.7, 2.2), 7);
    room.add_place(DVec3::new(3.0, 2.0, 0.0), DVec3::Z);
    room.add_hints(block, [mouth.at(SIZE_M[2])]);
    let within =
        Block { low: DVec3::new(0.0, 0.0, SIZE_M[2] + 1e-3), high: DVec3::new(6.0, 4.0, top) };
    room.add_hints(within, [mouth.at(top)]);
    room.hint_shares = [0.5, 0.3];
    if dice.coin("openings named") {
        room.openings.push(mouth.at(top));
    }
    room
}

/// A pipe of mirrors to the sky.
pub(crate) fn pipe(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let block = Block::new([0.0; 3], SIZE_M);
    let side = dice.log("side m", 0.15, 0.6);
    let length = side * dice.log("length over side", 1.0, 12.0);
    let mouth = Opening { side: Side::HighZ, low: [2.8, 1.8], high: [2.8 + side, 1.8 + side] };
    room.add_shell(block, Surface::Grey(dice.draw("reflectance", 0.2, 0.8)), &[mouth]);
    let top = SIZE_M[2] + length;
    let mirrors = Surface::Mirror(dice.draw("mirrors", 0.8, 0.98));
    room.add_tunnel(mouth.tunnel(SIZE_M[2], top), 2, mirrors);
    // The roof keeps the sky away from the outside of the room.
    add_sky(&mut room, dice);
    if dice.coin("diffuser") {
        let sheet = Surface::Translucent { reflectance: 0.3, transmittance: 0.6 };
        room.add_face(mouth.at(SIZE_M[2] + 0.01), sheet);
    }
    room.scatter(dice, DVec3::splat(0.3), DVec3::new(5.7, 3.7, 2.2), 7);
    room.add_place(DVec3::new(2.8 + 0.5 * side, 1.8 + 0.5 * side, 0.0), DVec3::Z);
    room.add_hints(block, [mouth.at(SIZE_M[2])]);
    room.hint_shares = [0.5, 0.3];
    room
}

/// A roof with openings over desks.
pub(crate) fn skylights(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let block = Block::new([0.0; 3], [8.0, 6.0, 3.5]);
    let side = dice.draw("skylight m", 0.3, 1.2);
    let mut holes = Vec::new();
    for column in 0..dice.count("skylights", 1, 4) {
        let x = 0.8 + 1.8 * f64::from(column);
        holes.push(Opening { side: Side::HighZ, low: [x, 2.4], high: [x + side, 2.4 + side] });
    }
    room.add_shell(block, Surface::Grey(dice.draw("reflectance", 0.3, 0.8)), &holes);
    for desk in 0..dice.count("desks", 1, 3) {
        let x = 1.0 + 2.2 * f64::from(desk);
        let top = Block::new([x, 1.0, 0.7], [x + 0.8, 2.4, 0.74]);
        room.add_solid(top, Surface::Grey(0.5));
        room.add_place(DVec3::new(x + 0.4, 1.7, 0.74), DVec3::Z);
        room.add_place(DVec3::new(x + 0.4, 1.7, 0.4), DVec3::NEG_Z);
    }
    add_sky(&mut room, dice);
    room.scatter(dice, DVec3::new(0.4, 3.0, 0.3), DVec3::new(7.6, 5.6, 2.5), 5);
    room.add_hints(block, holes.iter().map(|hole| hole.at(3.5)));
    room.hint_shares = [0.4, 0.2];
    if dice.coin("openings named") {
        room.openings = holes.iter().map(|hole| hole.at(3.5)).collect();
    }
    room
}

/// A wall with slits, the sky behind it.
pub(crate) fn slits(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let block = Block::new([0.0; 3], SIZE_M);
    let width = dice.log("slit m", 0.002, 0.05);
    let mut holes = Vec::new();
    for slit in 0..dice.count("slits", 2, 6) {
        let y = 0.5 + 0.5 * f64::from(slit);
        holes.push(Opening { side: Side::LowX, low: [y, 0.3], high: [y + width, 2.5] });
    }
    let walls = Surface::Grey(dice.draw("reflectance", 0.2, 0.8));
    room.add_shell(block, walls, &holes);
    let wall = dice.draw("wall m", 0.02, 0.3);
    holes.iter().for_each(|hole| room.add_tunnel(hole.tunnel(-wall, 0.0), 0, walls));
    // The front of the wall keeps the light between wall and room out.
    let outside = Block::new([-2.0, -2.0, -2.0], [-wall, 6.0, 6.0]);
    let mouths: Vec<Opening> =
        holes.iter().map(|hole| Opening { side: Side::HighX, ..*hole }).collect();
    room.add_side(outside, Side::HighX, Surface::Grey(0.2), &mouths);
    add_sky(&mut room, dice);
    room.scatter(dice, DVec3::splat(0.4), DVec3::new(5.6, 3.6, 2.4), 7);
    // `u x v` is along y cross z, inward: the edges change places.
    let turned = |hole: &Opening| {
        let mut way = hole.at(-wall);
        std::mem::swap(&mut way.u, &mut way.v);
        way
    };
    room.ways_in = holes.iter().map(turned).collect();
    room.sky_found = FoundBy::BeamsAndJoins;
    room
}

/// A window that a building opposite hides the sky from, perhaps under an overhang.
pub(crate) fn facing(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let block = Block::new([0.0; 3], SIZE_M);
    let low = [dice.draw("window from m", 0.3, 1.0), dice.draw("sill m", 0.2, 1.2)];
    let high = [low[0] + dice.log("window m", 0.3, 2.5), 2.5];
    let window = Opening { side: Side::LowX, low, high };
    room.add_shell(block, Surface::Grey(dice.draw("reflectance", 0.2, 0.8)), &[window]);
    let far = dice.log("building away m", 1.5, 12.0);
    let height = dice.log("building m", 2.0, 20.0);
    let building = Block::new([-far - 5.0, -15.0, -0.5], [-far, 20.0, height]);
    room.add_solid(building, Surface::Grey(dice.draw("building reflectance", 0.1, 0.9)));
    let street = Block::new([-far, -15.0, -0.5], [-0.02, 20.0, -0.3]);
    room.add_solid(street, Surface::Grey(0.2));
    if dice.coin("overhang") {
        let out = dice.draw("overhang m", 0.4, 0.9 * far);
        let slab = Block::new([-out, -1.0, 2.6], [-0.02, 5.0, 2.7]);
        room.add_solid(slab, Surface::Grey(0.5));
    }
    add_sky(&mut room, dice);
    room.scatter(dice, DVec3::splat(0.3), DVec3::new(5.7, 3.7, 2.2), 7);
    room.add_place(DVec3::new(-0.5 * far, 2.0, -0.3), DVec3::Z);
    room.add_hints(block, [window.at(0.0)]);
    room.hint_shares = [0.5, 0.3];
    if dice.coin("openings named") {
        room.openings.push(window.at(0.0));
    } else {
        room.add_face(window.at(-0.01), Surface::Pane(1.52));
    }
    room
}
