//! Small bright things: a beam on a wall, a lamp in a tube, a panel of a few centimetres.

use crate::dice::Dice;
use crate::room::{FoundBy, Lamp, Parallelogram, Room, Shine, Surface};
use crate::shell::{Block, Opening, Side};
use glam::DVec3;

/// An evenly lit room, and a narrow beam on a wall.
pub(crate) fn beam(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let block = Block::new([0.0; 3], [6.0, 5.0, 2.8]);
    room.add_shell(block, Surface::Grey(dice.draw("reflectance", 0.3, 0.8)), &[]);
    let even_cd = dice.log("downlights cd", 30.0, 1000.0);
    for x in [1.5, 4.5] {
        room.add_downlight(DVec3::new(x, 2.5, 2.75), even_cd);
    }
    let half_deg = dice.log("half angle deg", 0.1, 4.0);
    let intensity_cd = dice.log("beam lm", 30.0, 1e4) / solid_angle(half_deg);
    let edge_deg = 1.2 * half_deg;
    let rows = vec![[0.0, intensity_cd], [half_deg, intensity_cd], [edge_deg, 0.0], [90.0, 0.0]];
    let lamp = DVec3::new(5.5, dice.draw("lamp y m", 0.5, 2.5), 2.5);
    let target = DVec3::new(0.0, dice.draw("spot y m", 2.0, 4.5), dice.draw("spot z m", 0.8, 1.8));
    let aim = (target - lamp).normalize();
    let shine = Shine::Table { aim, rows };
    room.lamps.push(Lamp { position: lamp, shine, found: FoundBy::Joins });
    room.scatter(dice, DVec3::new(0.4, 0.4, 0.4), DVec3::new(5.0, 4.6, 1.4), 8);
    let radius = (target - lamp).length() * libm::tan(edge_deg.to_radians()) / aim.x.abs();
    let spot = Opening {
        side: Side::LowX,
        low: [target.y - radius, target.z - radius].map(|low| low.max(0.0)),
        high: [(target.y + radius).min(5.0), (target.z + radius).min(2.8)],
    };
    room.add_hints(block, [spot.at(0.0)]);
    room.hint_shares = [0.5, 0.3];
    room
}

/// Of a cone, in sr.
fn solid_angle(half_deg: f64) -> f64 {
    let sin = libm::sin(0.5 * half_deg.to_radians());
    4.0 * std::f64::consts::PI * sin * sin
}

/// A lamp deep in a tube that is open at the top.
pub(crate) fn tube(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let block = Block::new([0.0; 3], [5.0, 4.0, 3.0]);
    room.add_shell(block, Surface::Grey(dice.draw("reflectance", 0.2, 0.8)), &[]);
    let side = dice.log("tube m", 0.04, 0.3);
    let length = side * dice.draw("length over side", 1.5, 6.0);
    let low = DVec3::new(2.0, 1.5, 0.8);
    let tube = Block { low, high: low + DVec3::new(side, side, length) };
    let lining = Surface::Grey(dice.draw("lining", 0.05, 0.9));
    let sides = [Side::LowX, Side::HighX, Side::LowY, Side::HighY, Side::LowZ];
    sides.into_iter().for_each(|side| room.add_side(tube, side, lining, &[]));
    let lamp = low + DVec3::new(0.5 * side, 0.5 * side, 0.5 * side);
    room.add_lamp(lamp, dice.log("lamp cd", 30.0, 1000.0));
    room.scatter(dice, DVec3::new(2.6, 0.4, 0.4), DVec3::new(4.6, 3.6, 2.6), 5);
    room.scatter(dice, DVec3::new(0.4, 0.4, 0.4), DVec3::new(1.6, 3.6, 2.6), 3);
    let mouth = Opening { side: Side::HighZ, low: [2.0, 1.5], high: [2.0 + side, 1.5 + side] };
    let spot = mouth.spot(lamp, tube.high.z, 3.0, block);
    let wider = mouth.widened([6.0 * (spot.high[0] - mouth.high[0]); 2], block);
    // From all but the tube; a place that belongs to two of the boxes has its hints twice.
    let above = Block { low: DVec3::new(0.0, 0.0, tube.high.z + 0.01), high: block.high };
    let below = Block { low: block.low, high: DVec3::new(5.0, 4.0, tube.high.z + 0.01) };
    let right = Block { low: below.low.with_x(tube.high.x + 0.01), high: below.high };
    let left = Block { low: below.low, high: below.high.with_x(low.x - 0.01) };
    for from in [above, right, left] {
        room.add_hints(from, [mouth.at(tube.high.z), spot.at(3.0), wider.at(3.0)]);
    }
    room.hint_shares = [0.5, 0.3];
    room
}

/// A bright panel of a few centimetres beside two ordinary luminaires.
pub(crate) fn panel(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let block = Block::new([0.0; 3], [6.0, 4.0, 2.8]);
    room.add_shell(block, Surface::Grey(dice.draw("reflectance", 0.3, 0.7)), &[]);
    let side = dice.log("panel m", 0.005, 0.2);
    let place = dice.within(DVec3::new(0.5, 0.5, 2.0), DVec3::new(2.5, 3.5, 2.6));
    let panel = Parallelogram { corner: place, u: DVec3::Y * side, v: DVec3::X * side };
    room.add_panel(panel, dice.log("panel cd", 10.0, 3000.0) / (side * side));
    let ordinary_cd = dice.log("luminaires cd", 100.0, 2000.0);
    room.add_downlight(DVec3::new(2.0, 2.0, 2.75), ordinary_cd);
    room.add_downlight(DVec3::new(4.5, 2.0, 2.75), ordinary_cd);
    room.scatter(dice, DVec3::new(0.4, 0.4, 0.4), DVec3::new(5.6, 3.6, 1.8), 8);
    room
}
