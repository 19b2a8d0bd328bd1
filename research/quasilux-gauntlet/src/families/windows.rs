//! Daylight that has to squeeze in: louvres, a slit, a shaft.

use crate::dice::Dice;
use crate::room::{Parallelogram, Room, Surface};
use crate::shell::{Block, Opening, Side};
use glam::DVec3;

const SIZE_M: [f64; 3] = [6.0, 4.0, 2.8];

/// A bright panel outside, wide enough for a hole in the wall at x = 0.
fn add_sky(room: &mut Room, distance_m: f64, luminance_cd_m2: f64) {
    let corner = DVec3::new(-distance_m, -1.0, -1.0);
    let (u, v) = (DVec3::Y * 6.0, DVec3::Z * 6.0);
    room.add_panel(Parallelogram { corner, u, v }, luminance_cd_m2);
}

/// Slats over a window, open by a share of their distance.
pub(crate) fn louvres(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let block = Block::new([0.0; 3], SIZE_M);
    let window = Opening { side: Side::LowX, low: [1.0, 0.9], high: [3.0, 2.1] };
    room.add_shell(block, Surface::Grey(dice.draw("reflectance", 0.3, 0.8)), &[window]);
    add_sky(&mut room, 1.5, dice.log("sky cd/m2", 1e3, 3e4));
    let slats = dice.count("slats", 8, 24);
    let slope = dice.draw("slope", 0.3, 1.5);
    let pitch = 1.2 / f64::from(slats);
    let depth = pitch * dice.draw("depth over pitch", 0.8, 1.6);
    let grey = Surface::Grey(dice.draw("slat reflectance", 0.02, 0.7));
    for slat in 0..slats {
        let corner = DVec3::new(-0.01, 1.0, 0.9 + pitch * (f64::from(slat) + 0.5));
        let (u, v) = (DVec3::Y * 2.0, DVec3::new(-1.0, 0.0, slope).normalize() * depth);
        room.add_face(Parallelogram { corner, u, v }, grey);
    }
    let inner = block.inset(0.4);
    room.scatter(dice, inner.low, inner.high, 7);
    room.add_hints(block, [window.at(0.0)]);
    room.hint_shares = [0.6, 0.3];
    room
}

/// A slit in a thick wall.
pub(crate) fn slit(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let block = Block::new([0.0; 3], SIZE_M);
    let width = dice.log("slit m", 0.001, 0.05);
    let slit = Opening { side: Side::LowX, low: [1.9, 0.5], high: [1.9 + width, 2.3] };
    let walls = Surface::Grey(dice.draw("reflectance", 0.2, 0.8));
    room.add_shell(block, walls, &[slit]);
    let wall = dice.draw("wall m", 0.03, 0.3);
    room.add_tunnel(slit.tunnel(-wall, 0.0), 0, walls);
    // The outside of the wall keeps the rest of the sky out.
    let outside = Block::new([-2.0, -2.0, -2.0], [-wall, 6.0, 6.0]);
    let mouth = Opening { side: Side::HighX, ..slit };
    room.add_side(outside, Side::HighX, Surface::Grey(0.2), &[mouth]);
    add_sky(&mut room, 1.0 + wall, dice.log("sky cd/m2", 3e3, 1e6));
    let inner = block.inset(0.4);
    room.scatter(dice, inner.low, inner.high, 7);
    room.add_place(DVec3::new(1.0, 1.9 + 0.5 * width, 0.0), DVec3::Z);
    // Light that comes straight through lands in strips on the far wall and on the floor.
    let reach = width * SIZE_M[0] / wall;
    let far = slit.widened([reach, 1.0], block);
    let low = [0.0, (1.9 - 0.5 * reach).max(0.0)];
    let high = [SIZE_M[0], (1.9 + width + 0.5 * reach).min(SIZE_M[1])];
    let floor = Opening { side: Side::LowZ, low, high };
    room.add_hints(block, [slit.at(0.0), far.at(SIZE_M[0]), floor.at(0.0)]);
    room.hint_shares = [0.6, 0.3];
    room
}

/// A deep shaft to the sky.
pub(crate) fn shaft(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let block = Block::new([0.0; 3], SIZE_M);
    let side = dice.log("side m", 0.15, 1.0);
    let depth = side * dice.log("depth over side", 1.0, 12.0);
    let mouth = Opening { side: Side::HighZ, low: [2.5, 1.6], high: [2.5 + side, 1.6 + side] };
    room.add_shell(block, Surface::Grey(dice.draw("reflectance", 0.2, 0.8)), &[mouth]);
    let top = SIZE_M[2] + depth;
    let lining = Surface::Grey(dice.draw("lining", 0.1, 0.9));
    room.add_tunnel(mouth.tunnel(SIZE_M[2], top), 2, lining);
    let corner = DVec3::new(2.5, 1.6, top);
    let (u, v) = (DVec3::Y * side, DVec3::X * side);
    room.add_panel(Parallelogram { corner, u, v }, dice.log("sky cd/m2", 3e3, 1e5));
    let inner = block.inset(0.4);
    room.scatter(dice, inner.low, inner.high, 7);
    room.add_place(DVec3::new(2.5 + 0.5 * side, 1.6 + 0.5 * side, 0.0), DVec3::Z);
    // What the sky sees of the floor straight down, in the middle of its light.
    let floor = Opening { side: Side::LowZ, low: [2.2, 1.3], high: [2.8 + side, 1.9 + side] };
    room.add_hints(block, [mouth.at(SIZE_M[2]), floor.at(0.0)]);
    room.hint_shares = [0.6, 0.3];
    room
}
