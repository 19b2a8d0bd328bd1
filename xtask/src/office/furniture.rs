//! What stands in the office: four workplaces, shelves, a cabinet, a whiteboard, frames of door and
//! windows, radiators, and the housings of the luminaires.
//!
//! Everything is made of boxes that stay at least 1 mm apart and 1 mm off the room, so that no two
//! faces coincide.

use super::solids::{Block, Object};

/// Where the luminaires emit: 10 mm below their housings.
pub(crate) const LUMINAIRES_MM: [[i32; 3]; 6] = [
    [1000, 1250, 2500],
    [3000, 1250, 2500],
    [5000, 1250, 2500],
    [1000, 3750, 2500],
    [3000, 3750, 2500],
    [5000, 3750, 2500],
];

/// Lower left corner of each desk, and whether its user looks toward +y.
const DESKS_MM: [([i32; 2], bool); 4] =
    [([900, 1690], true), ([3500, 1690], true), ([900, 2510], false), ([3500, 2510], false)];
const DESK_SIZE_MM: [i32; 2] = [1600, 800];

/// All furniture.
pub(crate) fn objects() -> Vec<Object> {
    let mut objects = Vec::new();
    for (i, (corner, looks_up)) in DESKS_MM.into_iter().enumerate() {
        let place = Seat { corner_mm: corner, mirrored: !looks_up };
        objects.push(named(format!("desk_{}", i + 1), desk(&place)));
        objects.push(named(format!("screen_{}", i + 1), screen(&place)));
        objects.push(named(format!("chair_{}", i + 1), chair(&place)));
    }
    objects.push(named("shelves", shelves()));
    objects.push(named("books", books()));
    objects.push(named("cabinet", vec![Block::new("shelf", [5540, 3500, 10], [440, 1200, 760])]));
    objects.push(named(
        "whiteboard",
        vec![Block::new("whiteboard", [5, 1600, 900], [15, 1800, 1200])],
    ));
    objects.push(named("waste_bin", vec![Block::new("plastic", [3000, 1500, 1], [260, 260, 300])]));
    objects.push(named("door_frame", door_frame()));
    for (i, x_mm) in [600, 3300].into_iter().enumerate() {
        objects.push(named(format!("window_{}", i + 1), window(x_mm)));
    }
    for (i, place) in LUMINAIRES_MM.into_iter().enumerate() {
        objects.push(named(format!("luminaire_{}", i + 1), luminaire(place)));
    }
    objects
}

fn named(name: impl Into<String>, blocks: Vec<Block>) -> Object {
    Object { name: name.into(), blocks }
}

/// Where a desk stands: its parts are given as if the user sat at low y and looked toward +y.
struct Seat {
    corner_mm: [i32; 2],
    mirrored: bool,
}

impl Seat {
    /// A box in the frame of the desk, turned by half a turn about its centre where mirrored.
    fn block(&self, material: &'static str, low_mm: [i32; 3], size_mm: [i32; 3]) -> Block {
        let turned = |axis: usize| match self.mirrored {
            false => low_mm[axis],
            true => DESK_SIZE_MM[axis] - low_mm[axis] - size_mm[axis],
        };
        let [x, y] = self.corner_mm;
        Block::new(material, [x + turned(0), y + turned(1), low_mm[2]], size_mm)
    }
}

fn desk(place: &Seat) -> Vec<Block> {
    vec![
        place.block("desk", [0, 0, 715], [1600, 800, 25]),
        place.block("metal", [20, 50, 1], [30, 700, 713]),
        place.block("metal", [1550, 50, 1], [30, 700, 713]),
        place.block("desk", [60, 120, 30], [400, 600, 600]),
        place.block("paper", [1250, 420, 741], [250, 340, 40]),
    ]
}

fn screen(place: &Seat) -> Vec<Block> {
    vec![
        place.block("plastic", [680, 470, 741], [240, 180, 10]),
        place.block("plastic", [780, 545, 752], [40, 30, 117]),
        place.block("screen", [500, 545, 870], [600, 30, 340]),
        place.block("plastic", [580, 310, 741], [440, 130, 15]),
    ]
}

fn chair(place: &Seat) -> Vec<Block> {
    vec![
        place.block("fabric", [570, -440, 430], [460, 460, 60]),
        place.block("fabric", [580, -500, 520], [440, 40, 430]),
        place.block("metal", [775, -235, 51], [50, 50, 378]),
        place.block("metal", [550, -235, 1], [500, 50, 49]),
        place.block("metal", [775, -460, 1], [50, 224, 49]),
        place.block("metal", [775, -184, 1], [50, 224, 49]),
    ]
}

const SHELF_X_MM: i32 = 400;
const BAY_MM: i32 = 800;
const BAYS: i32 = 4;
const BOARDS_Z_MM: [i32; 6] = [60, 440, 820, 1200, 1580, 1960];

fn shelves() -> Vec<Block> {
    let mut blocks = vec![Block::new("shelf", [SHELF_X_MM, 5, 1], [BAYS * BAY_MM + 20, 8, 2000])];
    for bay in 0..=BAYS {
        blocks.push(Block::new("shelf", [SHELF_X_MM + bay * BAY_MM, 14, 1], [20, 346, 2000]));
    }
    for bay in 0..BAYS {
        for z_mm in BOARDS_Z_MM {
            let low_mm = [SHELF_X_MM + bay * BAY_MM + 21, 14, z_mm];
            blocks.push(Block::new("shelf", low_mm, [BAY_MM - 22, 340, 20]));
        }
    }
    blocks
}

/// Runs of books and binders of mixed sizes with gaps between them.
fn books() -> Vec<Block> {
    let mut blocks = Vec::new();
    let mut numbers = Numbers(2003);
    for bay in 0..BAYS {
        for board_z_mm in &BOARDS_Z_MM[..BOARDS_Z_MM.len() - 1] {
            let end_mm = SHELF_X_MM + (bay + 1) * BAY_MM - 2;
            let mut x_mm = SHELF_X_MM + bay * BAY_MM + 22 + numbers.between(0, 60);
            loop {
                let width_mm = numbers.between(70, 260);
                if x_mm + width_mm > end_mm {
                    break;
                }
                let material = if numbers.between(0, 3) == 0 { "paper" } else { "binder" };
                let size_mm = [width_mm, numbers.between(180, 260), numbers.between(220, 320)];
                blocks.push(Block::new(material, [x_mm, 20, board_z_mm + 21], size_mm));
                x_mm += width_mm + numbers.between(2, 90);
            }
        }
    }
    blocks
}

fn door_frame() -> Vec<Block> {
    vec![
        Block::new("frame", [5960, 330, 1], [39, 70, 2099]),
        Block::new("frame", [5960, 1300, 1], [39, 70, 2099]),
        Block::new("frame", [5960, 330, 2101], [39, 1040, 70]),
        Block::new("metal", [5940, 450, 1040], [25, 130, 20]),
    ]
}

fn window(x_mm: i32) -> Vec<Block> {
    vec![
        Block::new("frame", [x_mm, 4950, 900], [2100, 49, 50]),
        Block::new("frame", [x_mm, 4950, 2250], [2100, 49, 50]),
        Block::new("frame", [x_mm, 4950, 951], [50, 49, 1298]),
        Block::new("frame", [x_mm + 1025, 4950, 951], [50, 49, 1298]),
        Block::new("frame", [x_mm + 2050, 4950, 951], [50, 49, 1298]),
        Block::new("frame", [x_mm - 50, 4760, 860], [2200, 239, 30]),
        Block::new("luminaire", [x_mm + 200, 4870, 150], [1700, 90, 550]),
    ]
}

/// The housing with its two rods; the light comes from the middle of its underside.
fn luminaire([x, y, z]: [i32; 3]) -> Vec<Block> {
    vec![
        Block::new("luminaire", [x - 600, y - 100, z + 10], [1200, 200, 50]),
        Block::new("metal", [x - 402, y - 2, z + 61], [4, 4, 238]),
        Block::new("metal", [x + 398, y - 2, z + 61], [4, 4, 238]),
    ]
}

/// Whole numbers that look irregular: the linear congruential generator of Knuth's MMIX.
struct Numbers(u64);

impl Numbers {
    /// A number in [low, high).
    fn between(&mut self, low: i32, high: i32) -> i32 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        // The high half is below 2^32, so the product fits and the quotient is below high - low.
        let span = (high - low).unsigned_abs();
        low + (((self.0 >> 32) * u64::from(span)) >> 32) as i32
    }
}
