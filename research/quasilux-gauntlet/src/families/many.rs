//! Many luminaires in cells, of which few matter.

use crate::dice::Dice;
use crate::room::{Room, Surface};
use crate::shell::{Block, Opening, Side};
use glam::DVec3;

const CELL_M: f64 = 3.0;
const HEIGHT_M: f64 = 2.6;

/// Cells in rows and columns, a door in every wall between two; sensors in the first ones.
pub(crate) fn cells(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let counts = [dice.count("columns", 3, 6), dice.count("rows", 2, 5)];
    let lamps = dice.count("lamps of a cell", 9, 10);
    let walls = Surface::Grey(dice.draw("reflectance", 0.3, 0.8));
    let sizes = counts.map(|count| f64::from(count) * CELL_M);
    room.add_shell(Block::new([0.0; 3], [sizes[0], sizes[1], HEIGHT_M]), walls, &[]);
    let door = dice.draw("door m", 0.2, 1.0);
    add_partitions(&mut room, counts, door, walls);
    let intensity_cd = dice.log("lamp cd", 20.0, 500.0);
    // The first cell is nearly dark.
    let share_of_first = dice.log("share of the first cell", 1e-4, 1.0);
    for column in 0..counts[0] {
        for row in 0..counts[1] {
            let low = DVec3::new(f64::from(column) * CELL_M, f64::from(row) * CELL_M, 2.0);
            let dimming = if column + row == 0 { share_of_first } else { 1.0 };
            for _ in 0..lamps {
                let place = dice.within(low + DVec3::new(0.3, 0.3, 0.0), low + DVec3::splat(2.7));
                let place = DVec3::new(place.x, place.y, 2.0 + 0.02 * place.z);
                room.add_lamp(place, intensity_cd * dimming);
            }
        }
    }
    let high = DVec3::new(2.7, 2.7, 1.8);
    room.scatter(dice, DVec3::splat(0.3), high, 6);
    room.scatter(dice, DVec3::new(3.3, 0.3, 0.3), high + DVec3::X * CELL_M, 2);
    room.hint_shares = [0.4, 0.15];
    room
}

/// Walls between cells, each with a door in its middle; those of the first cell are hints.
fn add_partitions(room: &mut Room, counts: [u32; 2], door: f64, walls: Surface) {
    for column in 0..counts[0] {
        for row in 0..counts[1] {
            let low = DVec3::new(f64::from(column) * CELL_M, f64::from(row) * CELL_M, 0.0);
            let cell = Block { low, high: low + DVec3::new(CELL_M, CELL_M, HEIGHT_M) };
            let ends = [0, 1].map(|k| low[k] + 1.5 - 0.5 * door);
            if column + 1 < counts[0] {
                let low = [ends[1], 0.0];
                let hole = Opening { side: Side::HighX, low, high: [ends[1] + door, 2.0] };
                room.add_side(cell, Side::HighX, walls, &[hole]);
                add_hint(room, column + row, hole, cell.high.x);
            }
            if row + 1 < counts[1] {
                let low = [ends[0], 0.0];
                let hole = Opening { side: Side::HighY, low, high: [ends[0] + door, 2.0] };
                room.add_side(cell, Side::HighY, walls, &[hole]);
                add_hint(room, column + row, hole, cell.high.y);
            }
        }
    }
}

fn add_hint(room: &mut Room, from_first: u32, hole: Opening, plane_m: f64) {
    if from_first == 0 {
        let first = Block::new([0.0; 3], [CELL_M, CELL_M, HEIGHT_M]);
        room.add_hints(first, [hole.at(plane_m)]);
    }
}
