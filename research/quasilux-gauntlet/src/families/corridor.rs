//! A corridor with bends, the lamp at its far end.

use crate::dice::Dice;
use crate::room::{Outside, Parallelogram, Room, SkyKind, Surface};
use crate::shell::{Block, Opening, Side};
use glam::DVec3;

const HEIGHT_M: f64 = 2.5;

/// A corner from `low` on, at the end of a leg.
struct Bend {
    leg: Block,
    low: DVec3,
    width: f64,
    along_x: bool,
}

/// Legs along x and y in turn, a corner between each two, open toward each other.
pub(crate) fn corridor(dice: &mut Dice) -> Room {
    bent(dice, false)
}

/// The same with the sky at the end of it.
pub(crate) fn to_the_sky(dice: &mut Dice) -> Room {
    let mut room = bent(dice, true);
    room.outside = Some(Outside::sky(SkyKind::Overcast, dice.log("zenith cd/m2", 300.0, 3e4)));
    room
}

fn bent(dice: &mut Dice, is_open: bool) -> Room {
    let mut room = Room::empty();
    let bends = dice.count("bends", 1, 3);
    let width = dice.draw("width m", 1.0, 2.5);
    let walls = Surface::Grey(dice.draw("reflectance", 0.3, 0.8));
    let mut at = DVec3::ZERO;
    let mut last = Block { low: at, high: at };
    for leg in 0..=bends {
        let length = dice.between(2.0, 6.0);
        let along_x = leg.is_multiple_of(2);
        let ends = if along_x { [Side::LowX, Side::HighX] } else { [Side::LowY, Side::HighY] };
        let reach =
            if along_x { DVec3::new(length, width, 0.0) } else { DVec3::new(width, length, 0.0) };
        last = Block { low: at, high: at + reach + DVec3::Z * HEIGHT_M };
        let open: Vec<Opening> = [leg > 0, leg < bends || is_open]
            .into_iter()
            .zip(ends)
            .filter(|(is_open, _)| *is_open)
            .map(|(_, side)| Opening::all(side))
            .collect();
        room.add_shell(last, walls, &open);
        add_places(&mut room, dice, last, bends);
        if leg < bends {
            let from = if along_x { at + DVec3::X * length } else { at + DVec3::Y * length };
            add_corner(&mut room, Bend { leg: last, low: from, width, along_x }, walls);
            at = if along_x { from + DVec3::Y * width } else { from + DVec3::X * width };
        }
    }
    if is_open {
        let side = if bends.is_multiple_of(2) { Side::HighX } else { Side::HighY };
        let [i, j] = if bends.is_multiple_of(2) { [1, 2] } else { [0, 2] };
        let low = [last.low[i], last.low[j]];
        let end = Opening { side, low, high: [last.high[i], last.high[j]] };
        let plane = if bends.is_multiple_of(2) { last.high.x } else { last.high.y };
        room.add_hints(last, [end.at(plane)]);
        room.hint_shares = [0.6, 0.3];
        return room;
    }
    let lamp = if bends.is_multiple_of(2) {
        DVec3::new(last.high.x - 0.6, 0.5 * (last.low.y + last.high.y), 2.0)
    } else {
        DVec3::new(0.5 * (last.low.x + last.high.x), last.high.y - 0.6, 2.0)
    };
    room.add_lamp(lamp, dice.log("lamp cd", 100.0, 10_000.0));
    room.hint_shares = [0.6, 0.3];
    room
}

/// Where two legs meet, and what to look at: the way in from the first, the way on from within.
fn add_corner(room: &mut Room, bend: Bend, walls: Surface) {
    let Bend { leg, low, width, along_x } = bend;
    let corner = Block { low, high: low + DVec3::new(width, width, HEIGHT_M) };
    let sides = if along_x { [Side::LowX, Side::HighY] } else { [Side::LowY, Side::HighX] };
    room.add_shell(corner, walls, &sides.map(Opening::all));
    let across = if along_x { [DVec3::X, DVec3::Y] } else { [DVec3::Y, DVec3::X] };
    let [along, aside] = across.map(|axis| axis * width);
    let v = DVec3::Z * HEIGHT_M;
    let way_in = Parallelogram { corner: low, u: aside, v };
    let way_on = Parallelogram { corner: low + aside, u: along, v };
    room.add_hints(leg, [way_in]);
    room.add_hints(corner, [way_on]);
}

/// Two in the first legs, three in the only other one of a single bend.
fn add_places(room: &mut Room, dice: &mut Dice, leg: Block, bends: u32) {
    let inner = leg.inset(0.3);
    room.scatter(dice, inner.low, inner.high, if bends == 1 { 3 } else { 2 });
    if room.places.len() <= 3 {
        let position = DVec3::new(leg.low.x, 0.5 * (leg.low.y + leg.high.y), 1.2);
        room.add_place(position, DVec3::X);
    }
}
