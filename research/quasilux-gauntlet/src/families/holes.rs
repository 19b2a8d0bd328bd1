//! Two rooms and a narrow way between them.

use crate::dice::Dice;
use crate::room::{Room, Surface};
use crate::shell::{Block, Opening, Side};
use glam::DVec3;

/// A dark room and a lit one, the wall between them from x = `WALL_M` on.
const WALL_M: f64 = 4.0;
const HEIGHT_M: f64 = 2.6;
const DEPTH_M: f64 = 4.0;

/// Two rooms, and a hole through the wall between them.
fn add_rooms(room: &mut Room, hole: Opening, wall_m: f64, lamp: DVec3, walls: [Surface; 2]) {
    let dark = Block::new([0.0; 3], [WALL_M, DEPTH_M, HEIGHT_M]);
    let start = WALL_M + wall_m;
    let lit = Block::new([start, 0.0, 0.0], [start + 4.0, DEPTH_M, HEIGHT_M]);
    room.add_shell(dark, walls[0], &[hole]);
    room.add_shell(lit, walls[1], &[Opening { side: Side::LowX, ..hole }]);
    room.add_tunnel(hole.tunnel(WALL_M, start), 0, walls[0]);
    // Where light lands that comes straight through the hole, of the lamp and of the walls beyond.
    let of_lamp = hole.spot(lamp, start, 0.0, dark).at(0.0);
    let reach = [0, 1].map(|k| (hole.high[k] - hole.low[k]) * WALL_M / wall_m);
    let of_walls = hole.widened(reach, dark).at(0.0);
    room.add_hints(dark, [hole.at(WALL_M), of_lamp, of_walls]);
    let aside = 0.5 * reach[0];
    let floor = Opening {
        side: Side::LowZ,
        low: [0.0, (hole.low[0] - aside).max(0.0)],
        high: [WALL_M, (hole.high[0] + aside).min(DEPTH_M)],
    };
    room.add_hints(dark, [floor.at(0.0)]);
    add_spot_on_floor(room, hole, lamp, start, dark);
}

/// A lamp above the hole lights the floor behind it.
fn add_spot_on_floor(room: &mut Room, hole: Opening, lamp: DVec3, start: f64, dark: Block) {
    if lamp.z <= hole.low[1] {
        return;
    }
    let reach = |z: f64| lamp.x + (start - lamp.x) * lamp.z / (lamp.z - z);
    let far = if lamp.z > hole.high[1] { reach(hole.high[1]) } else { f64::NEG_INFINITY };
    let [far, near] = [far, reach(hole.low[1])].map(|x| x.clamp(0.0, WALL_M));
    let across = |y: f64, x: f64| lamp.y + (y - lamp.y) * (lamp.x - x) / (lamp.x - start);
    let sides = [far, near].map(|x| [across(hole.low[0], x), across(hole.high[0], x)]);
    let low = sides[0][0].min(sides[1][0]).clamp(0.0, DEPTH_M);
    let high = sides[0][1].max(sides[1][1]).clamp(0.0, DEPTH_M);
    let spot = Opening { side: Side::LowZ, low: [far, low], high: [near, high] };
    room.add_hints(dark, [spot.at(0.0)]);
}

/// A door that stands open by a hair.
pub(crate) fn door(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let gap = dice.log("gap m", 0.003, 0.15);
    let hole = Opening { side: Side::HighX, low: [1.8, 0.0], high: [1.8 + gap, 2.0] };
    let wall = dice.draw("wall m", 0.04, 0.2);
    let walls = [0, 1].map(|_| Surface::Grey(dice.between(0.3, 0.8)));
    let lamp = dice.within(DVec3::new(5.0, 0.7, 1.5), DVec3::new(7.5, 3.3, 2.3));
    add_rooms(&mut room, hole, wall, lamp, walls);
    room.add_lamp(lamp, dice.log("lamp cd", 100.0, 10_000.0));
    // The gap reaches down to the floor, which is brightest there.
    let dark = Block::new([0.0; 3], [WALL_M, DEPTH_M, HEIGHT_M]);
    for reach in [0.1, 0.5] {
        let low = [WALL_M - reach, 1.8 - 0.5 * reach];
        let floor = Opening { side: Side::LowZ, low, high: [WALL_M, 1.8 + gap + 0.5 * reach] };
        room.add_hints(dark, [floor.at(0.0)]);
    }
    room.scatter(dice, DVec3::new(0.3, 0.3, 0.3), DVec3::new(3.5, 3.7, 2.3), 6);
    room.add_place(DVec3::new(0.0, 2.0, 1.0), DVec3::X);
    room.hint_shares = [0.6, 0.3];
    room
}

/// A night light, and a keyhole to a bright room.
pub(crate) fn keyhole(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let side = dice.log("hole m", 0.006, 0.08);
    let hole = Opening { side: Side::HighX, low: [1.6, 1.0], high: [1.6 + side, 1.0 + side] };
    let wall = dice.draw("wall m", 0.02, 0.08);
    let walls = [0, 1].map(|_| Surface::Grey(dice.between(0.3, 0.8)));
    let lamp = dice.within(DVec3::new(4.8, 1.0, 0.6), DVec3::new(7.0, 2.8, 2.3));
    add_rooms(&mut room, hole, wall, lamp, walls);
    room.add_lamp(lamp, dice.log("lamp cd", 1e3, 1e7));
    let night = DVec3::new(0.4, 3.5, 0.4);
    room.add_lamp(night, dice.log("night light cd", 0.03, 3.0));
    room.scatter(dice, DVec3::new(0.3, 0.3, 0.3), DVec3::new(3.5, 3.1, 2.3), 7);
    room.hint_shares = [0.6, 0.3];
    room
}

/// Sensors from right under the lamp to the far end of a dark room behind a small opening.
pub(crate) fn decades(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let side = dice.log("opening m", 0.02, 0.3);
    let hole = Opening { side: Side::HighX, low: [2.0, 0.9], high: [2.0 + side, 0.9 + side] };
    let walls = [0, 1].map(|_| Surface::Grey(dice.between(0.05, 0.4)));
    let distance = dice.log("lamp to sensor m", 0.03, 0.2);
    let lamp = DVec3::new(6.0, 1.0, 0.8 + distance);
    add_rooms(&mut room, hole, 0.1, lamp, walls);
    let table = Block::new([5.7, 0.7, 0.7], [6.3, 1.3, 0.8]);
    room.add_solid(table, Surface::Grey(0.5));
    room.add_lamp(lamp, dice.log("lamp cd", 10.0, 1000.0));
    let spot = Opening { side: Side::HighZ, low: [5.8, 0.8], high: [6.2, 1.2] };
    let lit = Block::new([4.1, 0.0, 0.0], [8.1, DEPTH_M, HEIGHT_M]);
    room.add_hints(lit, [spot.at(0.8)]);
    room.add_place(DVec3::new(6.0, 1.0, 0.8), DVec3::Z);
    room.add_place(DVec3::new(6.25, 1.25, 0.8), DVec3::Z);
    room.add_place(DVec3::new(7.5, 3.5, 0.0), DVec3::Z);
    room.add_place(DVec3::new(5.0, 3.0, 1.5), DVec3::NEG_X);
    room.add_place(DVec3::new(6.0, 1.0, 0.3), DVec3::NEG_Z);
    room.scatter(dice, DVec3::new(0.3, 0.3, 0.3), DVec3::new(3.5, 3.7, 2.3), 4);
    room.hint_shares = [0.6, 0.3];
    room
}
