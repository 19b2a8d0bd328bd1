//! Light behind a ledge below the ceiling.

use crate::dice::Dice;
use crate::room::{Parallelogram, Room, Surface};
use crate::shell::{Block, Opening, Side};
use glam::DVec3;

/// A ledge along a wall, its strip or its row of lamps unseen from below.
pub(crate) fn cove(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let block = Block::new([0.0; 3], [5.0, 6.0, 3.0]);
    let walls = Surface::Grey(dice.draw("reflectance", 0.3, 0.85));
    room.add_shell(block, walls, &[]);
    let gap = dice.log("gap m", 0.05, 0.4);
    let depth = dice.draw("depth m", 0.15, 0.4);
    let bottom = 3.0 - gap - 0.2;
    let ledge = Block::new([0.1, 0.3, bottom], [0.1 + depth, 5.7, bottom + 0.02]);
    room.add_solid(ledge, walls);
    let lip = Block::new([0.1 + depth, 0.3, bottom], [0.12 + depth, 5.7, 3.0 - gap]);
    room.add_solid(lip, walls);
    // From the ledge to the wall, so that no light falls down behind it.
    let back = Opening { side: Side::LowZ, low: [0.0, 0.3], high: [0.1, 5.7] };
    room.add_face(back.at(bottom + 0.01), walls);
    let is_strip = dice.count("strip", 0, 1) == 1;
    let intensity_cd = dice.log("light cd", 300.0, 10_000.0);
    if is_strip {
        let corner = DVec3::new(0.15, 0.5, bottom + 0.05);
        let strip = Parallelogram { corner, u: DVec3::X * 0.05, v: DVec3::Y * 5.0 };
        room.add_panel(strip, intensity_cd / 0.25);
    } else {
        for step in 0..6 {
            let place = DVec3::new(0.18, 0.5 + f64::from(step), bottom + 0.08);
            room.add_lamp(place, intensity_cd / 20.0);
        }
    }
    room.scatter(dice, DVec3::new(0.8, 0.4, 0.3), DVec3::new(4.6, 5.6, 2.0), 8);
    let lip_m = 0.12 + depth;
    let mouth = Opening { side: Side::HighX, low: [0.3, 3.0 - gap], high: [5.7, 3.0] };
    let ceiling = [1.5 * gap, 1.0].map(|reach| {
        let high = [lip_m + reach, 5.7];
        Opening { side: Side::HighZ, low: [lip_m, 0.3], high }.at(3.0)
    });
    let out = Block { low: DVec3::new(lip_m + 0.01, 0.0, 0.0), high: block.high };
    room.add_hints(out, [mouth.at(lip_m), ceiling[0], ceiling[1]]);
    room.hint_shares = [0.5, 0.3];
    room
}
