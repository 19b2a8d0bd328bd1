//! Light that comes over mirrors. All lights have areas: light of points over mirrors cannot be
//! found by directions.

use crate::dice::Dice;
use crate::room::{Parallelogram, Room, Surface};
use crate::shell::{Block, Opening, Side};
use glam::DVec3;

/// A small bright light behind a baffle that only a mirror shows, and a panel on the ceiling.
pub(crate) fn baffle(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let block = Block::new([0.0; 3], [5.0, 4.0, 2.8]);
    room.add_shell(block, Surface::Grey(dice.draw("reflectance", 0.2, 0.6)), &[]);
    // On the wall at x = 5; the light shines at it from a box that is open on that side.
    let mirror = Parallelogram {
        corner: DVec3::new(4.98, 0.5, 0.5),
        u: DVec3::Z * dice.draw("mirror m", 0.5, 1.8),
        v: DVec3::Y * 2.5,
    };
    room.add_face(mirror, Surface::Mirror(0.9));
    let side = dice.log("light m", 0.005, 0.1);
    let baffle = Block::new([1.5, 1.2, 1.5], [1.8, 1.4, 1.7]);
    let sides = [Side::LowX, Side::LowY, Side::HighY, Side::LowZ, Side::HighZ];
    let black = Surface::Grey(0.03);
    sides.into_iter().for_each(|side| room.add_side(baffle, side, black, &[]));
    let corner = DVec3::new(1.55, 1.3 - 0.5 * side, 1.6 - 0.5 * side);
    let light = Parallelogram { corner, u: DVec3::Y * side, v: DVec3::Z * side };
    room.add_panel(light, dice.log("light cd", 10.0, 1e4) / (side * side));
    let corner = DVec3::new(2.0, 2.6, 2.79);
    let panel = Parallelogram { corner, u: DVec3::Y * 0.6, v: DVec3::X * 0.6 };
    room.add_panel(panel, dice.log("panel cd/m2", 100.0, 3000.0));
    room.scatter(dice, DVec3::new(2.2, 0.5, 0.4), DVec3::new(4.6, 3.5, 2.4), 5);
    room.scatter(dice, DVec3::new(0.3, 0.5, 0.4), DVec3::new(1.3, 3.5, 2.4), 2);
    room.add_hints(block, [light.image(mirror.corner, DVec3::X)]);
    room.hint_shares = [0.5, 0.3];
    room
}

/// Two rooms above each other, and two mirrors at 45 degrees in a shaft beside them.
pub(crate) fn periscope(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let side = dice.log("shaft m", 0.1, 0.6);
    let reflectance = dice.draw("mirrors", 0.7, 0.98);
    let walls = Surface::Grey(dice.draw("reflectance", 0.2, 0.7));
    let lower = Block::new([0.0; 3], [4.0, 4.0, 2.6]);
    let upper = Block::new([0.0, 0.0, 3.0], [4.0, 4.0, 5.6]);
    let hole = |z: f64| Opening { side: Side::HighX, low: [1.8, z], high: [1.8 + side, z + side] };
    let (low_m, high_m) = (1.2, 4.2);
    room.add_shell(lower, walls, &[hole(low_m)]);
    room.add_shell(upper, walls, &[hole(high_m)]);
    let shaft = Block::new([4.2, 1.8, low_m], [4.2 + side, 1.8 + side, high_m + side]);
    let lining = Surface::Grey(0.1);
    let doors = [low_m, high_m].map(|z| Opening { side: Side::LowX, ..hole(z) });
    room.add_shell(shaft, lining, &doors);
    [low_m, high_m].iter().for_each(|&z| room.add_tunnel(hole(z).tunnel(4.0, 4.2), 0, lining));
    // From the low front edge up to the far wall, and from the high front edge down to it.
    let below = DVec3::new(4.2, 1.8, low_m);
    let above = DVec3::new(4.2, 1.8, high_m + side);
    let across = DVec3::Y * side;
    let mirror = |corner, v| Parallelogram { corner, u: across, v };
    room.add_face(mirror(below, DVec3::new(side, 0.0, side)), Surface::Mirror(reflectance));
    room.add_face(mirror(above, DVec3::new(side, 0.0, -side)), Surface::Mirror(reflectance));
    // It faces the shaft.
    let size = dice.log("light m", 0.05, 1.0);
    let corner = DVec3::new(0.5, 1.8 + 0.5 * (side - size), high_m + 0.5 * (side - size));
    let light = Parallelogram { corner, u: DVec3::Y * size, v: DVec3::Z * size };
    room.add_panel(light, dice.log("light cd", 1e3, 1e5) / (size * size));
    let corner = DVec3::new(0.5, 3.0, 2.59);
    let panel = Parallelogram { corner, u: DVec3::Y * 0.3, v: DVec3::X * 0.3 };
    room.add_panel(panel, dice.log("panel cd/m2", 10.0, 3000.0));
    room.scatter(dice, DVec3::new(0.3, 0.4, 0.3), DVec3::new(3.7, 3.6, 2.3), 6);
    let middle = 0.5 * side;
    room.add_place(DVec3::new(2.0, 1.8 + middle, low_m + middle), DVec3::X);
    room.add_place(DVec3::new(0.0, 1.8 + middle, low_m + middle), DVec3::X);
    let once = light.image(above, DVec3::new(-1.0, 0.0, -1.0).normalize());
    let twice = once.image(below, DVec3::new(-1.0, 0.0, 1.0).normalize());
    // The light's beam through the shaft lands on the wall at x = 0 of the lower room.
    let margin = side + size;
    let spot = Opening {
        side: Side::LowX,
        low: [1.8 - margin, low_m - margin].map(|low| low.max(0.0)),
        high: [1.8 + side + margin, low_m + side + margin].map(|high| high.min(2.6)),
    };
    room.add_hints(lower, [twice, hole(low_m).at(4.0), spot.at(0.0)]);
    let in_shaft = Block { low: DVec3::new(4.0, 0.0, 0.0), high: shaft.high };
    room.add_hints(in_shaft, [twice, once, hole(high_m).at(4.0)]);
    room.hint_shares = [0.7, 0.3];
    room
}
