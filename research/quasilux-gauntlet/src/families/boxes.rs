//! Single rooms: plain, furnished, white.

use crate::dice::Dice;
use crate::room::{Room, Surface};
use crate::shell::{Block, Opening, Side};
use glam::DVec3;

/// A box with one isotropic lamp: a control.
pub(crate) fn plain(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let size = [dice.draw("length m", 3.0, 9.0), dice.draw("width m", 3.0, 6.0), 3.0];
    let walls = Surface::Grey(dice.draw("reflectance", 0.2, 0.8));
    let block = Block::new([0.0; 3], size);
    room.add_shell(block, walls, &[]);
    let place = dice.within(block.low + 1.0, block.high - 0.5);
    room.add_lamp(place, dice.log("lamp cd", 30.0, 3000.0));
    let inner = block.inset(0.3);
    room.scatter(dice, inner.low, inner.high, 5);
    let wall = DVec3::new(0.0, 0.5 * block.high.y, 1.2);
    room.add_place(wall, DVec3::X);
    room
}

/// Desks and cupboards under downlights: a control.
pub(crate) fn office(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let size = DVec3::new(dice.draw("length m", 5.0, 10.0), dice.draw("width m", 4.0, 7.0), 2.8);
    let walls = Surface::Grey(dice.draw("reflectance", 0.4, 0.75));
    room.add_shell(Block { low: DVec3::ZERO, high: size }, walls, &[]);
    let desks = dice.count("desks", 2, 6);
    for desk in 0..desks {
        let x = 0.8 + (size.x - 2.2) * f64::from(desk) / f64::from(desks);
        let y = 0.6 + (size.y - 2.0) * dice.unit();
        let top = Block::new([x, y, 0.7], [x + 0.7, y + 1.4, 0.74]);
        room.add_solid(top, Surface::Grey(0.5));
        let screen = Block::new([x + 0.05, y + 0.4, 0.8], [x + 0.1, y + 1.0, 1.2]);
        room.add_solid(screen, Surface::Grey(0.05));
        if desk < 4 {
            room.add_place(DVec3::new(x + 0.4, y + 0.7, 0.74), DVec3::Z);
        }
    }
    let cupboard = Block::new([size.x - 0.5, 0.2, 0.0], [size.x - 0.05, 1.6, 1.9]);
    room.add_solid(cupboard, Surface::Grey(0.35));
    let intensity_cd = dice.log("downlight cd", 200.0, 2000.0);
    for column in [0.25, 0.75] {
        for row in [0.3, 0.7] {
            room.add_downlight(DVec3::new(size.x * column, size.y * row, 2.75), intensity_cd);
        }
    }
    room.add_place(DVec3::new(0.3, 0.3, 0.0), DVec3::Z);
    room.add_place(DVec3::new(0.5 * size.x, size.y, 1.2), DVec3::NEG_Y);
    room.add_place(DVec3::new(0.5 * size.x, 0.4, 1.6), DVec3::new(0.6, 0.0, -0.8));
    room.add_place(DVec3::new(0.4, 0.5 * size.y, 2.0), DVec3::NEG_Z);
    room
}

/// Walls that reflect nearly all, and a hole that light leaves by.
pub(crate) fn white(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let block = Block::new([0.0; 3], [dice.draw("length m", 2.0, 5.0), 3.0, 2.5]);
    let loss = dice.log("absorbed", 0.02, 0.1);
    let side = dice.log("hole m", 0.1, 1.0);
    let hole = Opening { side: Side::LowX, low: [1.0, 0.8], high: [1.0 + side, 0.8 + side] };
    room.add_shell(block, Surface::Grey(1.0 - loss), &[hole]);
    let inner = block.inset(0.4);
    let place = dice.within(inner.low, inner.high);
    room.add_lamp(place, dice.log("lamp cd", 10.0, 1000.0));
    room.scatter(dice, inner.low, inner.high, 5);
    room.add_place(DVec3::new(block.high.x, 1.5, 1.2), DVec3::NEG_X);
    room
}
