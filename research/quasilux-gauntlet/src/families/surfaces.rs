//! White, glossy and scattering surfaces, and places close to them.

use crate::dice::Dice;
use crate::room::{FoundBy, Lookout, Room, Surface};
use crate::shell::{Block, Opening, Side};
use glam::DVec3;

/// A white room below a lit one, a hole between them.
pub(crate) fn lit_through_hole(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let size = [dice.draw("length m", 2.0, 5.0), 3.0, 2.5];
    let white = 1.0 - dice.log("absorbed", 0.02, 0.5);
    let side = dice.log("hole m", 0.0002, 0.02);
    let hole = Opening { side: Side::HighZ, low: [1.0, 1.5], high: [1.0 + side, 1.5 + side] };
    room.add_shell(Block::new([0.0; 3], size), Surface::Grey(white), &[hole]);
    let above = Block::new([0.0, 0.0, 2.501], [size[0], 3.0, 5.0]);
    let other = Surface::Grey(dice.draw("reflectance above", 0.2, 0.8));
    room.add_shell(above, other, &[Opening { side: Side::LowZ, ..hole }]);
    room.add_tunnel(hole.tunnel(2.5, 2.501), 2, Surface::Grey(0.3));
    let lamp = dice.within(DVec3::new(0.8, 1.0, 3.2), DVec3::new(1.8, 2.0, 4.5));
    room.add_downlight(lamp, dice.log("lamp cd", 100.0, 1e5));
    room.find_all(FoundBy::KeyholesAndJoins);
    let Block { low, high } = above;
    room.aims.push(Lookout { shape: hole.at(2.501), low, high });
    room.aim_share = 0.7;
    let inner = Block::new([0.0; 3], size).inset(0.3);
    room.scatter(dice, inner.low, inner.high, 7);
    room
}

/// A floor of polished metal under downlights.
pub(crate) fn glossy_floor(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let block = Block::new([0.0; 3], [dice.draw("length m", 4.0, 10.0), 4.0, 2.8]);
    let floor = Opening::all(Side::LowZ);
    room.add_shell(block, Surface::Grey(dice.draw("reflectance", 0.3, 0.8)), &[floor]);
    let reflectance = dice.draw("floor", 0.05, 0.9);
    let roughness = dice.draw("roughness", 0.2, 0.6);
    let whole = Opening { side: Side::LowZ, low: [0.0; 2], high: [block.high.x, 4.0] };
    room.add_face(whole.at(0.0), Surface::Metal { reflectance, roughness });
    let intensity_cd = dice.log("downlights cd", 30.0, 3000.0);
    for share in [0.25, 0.75] {
        room.add_downlight(DVec3::new(share * block.high.x, 2.0, 2.75), intensity_cd);
    }
    let inner = block.inset(0.4);
    room.scatter(dice, inner.low, inner.high, 6);
    room.add_place(DVec3::new(0.0, 2.0, 1.4), DVec3::X);
    room
}

/// A ceiling that light comes through, lamps above it.
pub(crate) fn luminous_ceiling(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let block = Block::new([0.0; 3], [6.0, 5.0, 3.2]);
    room.add_shell(block, Surface::Grey(dice.draw("reflectance", 0.3, 0.8)), &[]);
    let transmittance = dice.draw("transmittance", 0.1, 0.7);
    let gap = dice.draw("gap m", 0.0, 0.2);
    let sheet = Opening { side: Side::HighZ, low: [gap; 2], high: [6.0 - gap, 5.0 - gap] };
    let surface = Surface::Translucent { reflectance: 0.95 - transmittance, transmittance };
    room.add_face(sheet.at(2.7), surface);
    let intensity_cd = dice.log("lamps cd", 10.0, 1000.0);
    let below = dice.log("lamps over sheet m", 0.02, 0.4);
    for column in 0..3 {
        for row in 0..2 {
            let place = DVec3::new(1.0 + 2.0 * f64::from(column), 1.25 + 2.5 * f64::from(row), 2.7);
            room.add_lamp(place + DVec3::Z * below, intensity_cd);
        }
    }
    room.scatter(dice, DVec3::splat(0.4), DVec3::new(5.6, 4.6, 2.3), 8);
    room
}

/// Places a millimetre from walls, from edges and from the lamp.
pub(crate) fn close(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let block = Block::new([0.0; 3], [4.0, 3.0, 2.5]);
    room.add_shell(block, Surface::Grey(dice.draw("reflectance", 0.2, 0.85)), &[]);
    let lamp = dice.within(DVec3::new(1.0, 0.8, 1.0), DVec3::new(3.0, 2.2, 2.0));
    room.add_lamp(lamp, dice.log("lamp cd", 3.0, 300.0));
    let near = dice.log("distance m", 0.0005, 0.02);
    room.add_place(DVec3::new(near, 1.5, 1.0), DVec3::X);
    room.add_place(DVec3::new(near, 1.5, 1.4), DVec3::NEG_X);
    room.add_place(DVec3::new(near, near, 1.0), DVec3::Z);
    room.add_place(DVec3::new(2.0, near, near), DVec3::Z);
    room.add_place(DVec3::new(4.0 - near, 3.0 - near, 2.5 - near), DVec3::NEG_Y);
    room.add_place(lamp - DVec3::Z * near, DVec3::Z);
    room.add_place(lamp + DVec3::Z * near, DVec3::Z);
    room.add_place(lamp + DVec3::X * near, DVec3::Y);
    room
}
