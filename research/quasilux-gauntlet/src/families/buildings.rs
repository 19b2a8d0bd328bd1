//! Large, long and tiny places: decks, stairs, tunnels, corridors with niches.

use crate::dice::Dice;
use crate::room::{FoundBy, Lamp, Parallelogram, Room, Shine, Surface};
use crate::shell::{Block, Opening, Side};
use glam::DVec3;

/// A low deck with columns and beams under the ceiling.
pub(crate) fn parking(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let size = [dice.draw("length m", 20.0, 50.0), dice.draw("width m", 15.0, 30.0), 2.5];
    let walls = Surface::Grey(dice.draw("reflectance", 0.1, 0.5));
    room.add_shell(Block::new([0.0; 3], size), walls, &[]);
    let spacing = dice.draw("columns m", 4.0, 8.0);
    let counts = [size[0], size[1]].map(|length| (length / spacing) as u32);
    for column in 1..counts[0] {
        for row in 1..counts[1] {
            let [x, y] = [column, row].map(|k| f64::from(k) * spacing);
            let post = Block::new([x, y, 0.0], [x + 0.4, y + 0.4, 2.5]);
            for side in [Side::LowX, Side::HighX, Side::LowY, Side::HighY] {
                room.add_outer_side(post, side, walls);
            }
        }
    }
    let beam = Block::new([0.5 * size[0], 0.0, 2.2], [0.5 * size[0] + 0.3, size[1], 2.5]);
    for side in [Side::LowX, Side::HighX, Side::LowZ] {
        room.add_outer_side(beam, side, walls);
    }
    let intensity_cd = dice.log("lamp cd", 100.0, 2000.0);
    for column in 0..counts[0] {
        for row in 0..counts[1] {
            let [x, y] = [column, row].map(|k| (f64::from(k) + 0.55) * spacing);
            room.add_downlight(DVec3::new(x, y, 2.45), intensity_cd);
        }
    }
    room.scatter(dice, DVec3::new(1.0, 1.0, 0.2), DVec3::new(size[0] - 1.0, size[1] - 1.0, 1.9), 8);
    clear_of_columns(&mut room, spacing);
    room
}

/// Moves places that a column holds beside it.
fn clear_of_columns(room: &mut Room, spacing: f64) {
    for place in &mut room.places {
        let within = |along: f64| {
            let rest = along - spacing * libm::floor(along / spacing);
            rest < 0.45 || spacing - rest < 0.05
        };
        if within(place.position.x) && within(place.position.y) {
            place.position.x += 0.6;
        }
    }
}

/// A flight of stairs, a lamp at its top.
pub(crate) fn stairs(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let steps = dice.count("steps", 6, 18);
    let (rise, going) = (0.17, 0.28);
    let length = 2.4 + going * f64::from(steps);
    let height = rise * f64::from(steps) + 2.4;
    let block = Block::new([0.0; 3], [length, dice.draw("width m", 1.0, 2.0), height]);
    let walls = Surface::Grey(dice.draw("reflectance", 0.2, 0.7));
    room.add_shell(block, walls, &[]);
    let width = block.high.y;
    for step in 0..steps {
        let x = 1.2 + going * f64::from(step);
        let z = rise * f64::from(step);
        let riser = DVec3::new(x, 0.0, z);
        let (u, v) = (DVec3::Z * rise, DVec3::Y * width);
        room.add_face(Parallelogram { corner: riser, u, v }, walls);
        let tread = DVec3::new(x, 0.0, z + rise);
        let depth = if step + 1 == steps { going + 1.2 } else { going };
        room.add_face(Parallelogram { corner: tread, u: DVec3::X * depth, v }, walls);
        if step % 3 == 1 {
            room.add_place(DVec3::new(x + 0.14, 0.5 * width, z + rise), DVec3::Z);
        }
    }
    let top = rise * f64::from(steps);
    let lamp = DVec3::new(length - 0.5, 0.3 * width, top + dice.draw("lamp over top m", 0.3, 2.2));
    room.add_lamp(lamp, dice.log("lamp cd", 10.0, 1000.0));
    // A ceiling over the lower end, so that its light comes over the edge.
    let slab = DVec3::new(0.0, 0.0, 2.3);
    let reach = dice.draw("slab m", 0.5, 2.0);
    room.add_face(Parallelogram { corner: slab, u: DVec3::Y * width, v: DVec3::X * reach }, walls);
    room.add_place(DVec3::new(0.5, 0.5 * width, 0.0), DVec3::Z);
    room.add_place(DVec3::new(0.0, 0.5 * width, 1.2), DVec3::X);
    room.add_place(DVec3::new(0.6, 0.5 * width, 1.5), DVec3::NEG_X);
    room.add_place(DVec3::new(length - 0.3, 0.7 * width, top), DVec3::Z);
    room
}

/// Two kilometres with lamps far apart.
pub(crate) fn tunnel(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let block = Block::new([0.0; 3], [2000.0, 8.0, 5.0]);
    room.add_shell(block, Surface::Grey(dice.draw("reflectance", 0.1, 0.6)), &[]);
    let spacing = dice.log("lamps m", 30.0, 400.0);
    let intensity_cd = dice.log("lamp cd", 300.0, 10_000.0);
    let mut x = 0.5 * spacing;
    while x < 2000.0 {
        room.add_downlight(DVec3::new(x, 4.0, 4.8), intensity_cd);
        x += spacing;
    }
    for number in 0..8 {
        let x = dice.between(20.0, 1980.0);
        let place = DVec3::new(x, dice.between(1.0, 7.0), 0.0);
        let normals = [DVec3::Z, DVec3::Z, DVec3::X, DVec3::NEG_X];
        let normal = normals[number % 4];
        room.add_place(if normal == DVec3::Z { place } else { place + DVec3::Z * 1.5 }, normal);
    }
    room
}

/// A box of millimetres.
pub(crate) fn millimetres(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let side = dice.log("side m", 0.001, 0.01);
    let block = Block::new([0.0; 3], [side, 0.8 * side, 0.6 * side]);
    let hole = Opening { side: Side::LowX, low: [0.3 * side; 2], high: [0.35 * side; 2] };
    room.add_shell(block, Surface::Grey(dice.draw("reflectance", 0.2, 0.9)), &[hole]);
    let inner = block.inset(0.1 * side);
    let lamp = dice.within(inner.low, inner.high);
    room.add_lamp(lamp, dice.log("lamp cd", 1e-6, 1e-3));
    for _ in 0..7 {
        let place = dice.within(inner.low, inner.high);
        let normal = dice.normal();
        room.add_place(place, normal);
    }
    room
}

/// A long corridor with screens, its lamp in a niche.
pub(crate) fn niche(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let length = dice.draw("length m", 10.0, 25.0);
    let block = Block::new([0.0; 3], [length, 2.0, 2.6]);
    let walls = Surface::Grey(dice.draw("reflectance", 0.4, 0.88));
    let mouth = Opening { side: Side::LowY, low: [1.0, 1.0], high: [2.0, 2.4] };
    room.add_shell(block, walls, &[mouth]);
    let recess = Block::new([1.0, -0.6, 1.0], [2.0, 0.0, 2.4]);
    room.add_shell(recess, walls, &[Opening::all(Side::HighY)]);
    let lamp = DVec3::new(1.5, -0.4, 2.2);
    let half_deg = dice.draw("half angle deg", 8.0, 40.0);
    let aim = DVec3::new(dice.draw("aim x", -0.5, 0.5), 0.88, -0.48).normalize();
    let intensity_cd = dice.log("lamp cd", 100.0, 30_000.0);
    let rows =
        vec![[0.0, intensity_cd], [half_deg, intensity_cd], [1.2 * half_deg, 0.0], [90.0, 0.0]];
    let shine = Shine::Table { aim, rows };
    room.lamps.push(Lamp { position: lamp, shine, found: FoundBy::Paths });
    let screens = dice.count("screens", 1, 3);
    let mut before = 0.0;
    for screen in 1..=screens {
        let x = length * f64::from(screen) / f64::from(screens + 1);
        let gap = dice.draw("gap m", 0.3, 1.0);
        let is_left = screen % 2 == 0;
        let low = if is_left { 0.0 } else { 2.0 - gap };
        let hole = Opening { side: Side::HighX, low: [low, 0.0], high: [low + gap, 2.1] };
        let part = Block::new([before, 0.0, 0.0], [x, 2.0, 2.6]);
        room.add_side(part, Side::HighX, walls, &[hole]);
        let beyond = Block::new([x + 1e-3, 0.0, 0.0], [length, 2.0, 2.6]);
        room.add_hints(beyond, [hole.at(x)]);
        before = x;
    }
    room.add_hints(block, [mouth.at(0.0)]);
    for place in 0..8 {
        let x = length * (f64::from(place) + 0.6) / 8.5;
        let aside = dice.between(0.3, 1.7);
        room.add_place(DVec3::new(x, aside, 0.8), DVec3::Z);
    }
    room.hint_shares = [0.4, 0.2];
    room
}

/// Partitions one behind the other, of panes or sheets, a panel at one end.
pub(crate) fn partitions(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let count = dice.count("partitions", 2, 6);
    let length = 1.5 * f64::from(count + 1);
    let block = Block::new([0.0; 3], [length, 3.0, 2.6]);
    room.add_shell(block, Surface::Grey(dice.draw("reflectance", 0.2, 0.7)), &[]);
    let is_pane = dice.coin("panes");
    let transmittance = dice.draw("transmittance", 0.1, 0.6);
    let sheet = Surface::Translucent { reflectance: 0.3, transmittance };
    for number in 1..=count {
        let wall = Opening { side: Side::HighX, low: [0.0; 2], high: [3.0, 2.6] };
        let surface = if is_pane { Surface::Pane(1.5) } else { sheet };
        room.add_face(wall.at(1.5 * f64::from(number)), surface);
        let place = dice.within(DVec3::new(0.3, 0.3, 0.3), DVec3::new(1.2, 2.7, 2.3));
        let normal = if number % 2 == 0 { DVec3::Z } else { DVec3::NEG_X };
        room.add_place(place + DVec3::X * (1.5 * f64::from(number)), normal);
    }
    let side = dice.log("panel m", 0.1, 1.0);
    let panel = Parallelogram::square(DVec3::new(0.1, 1.5, 1.5), DVec3::X, side);
    room.add_panel(panel, dice.log("panel cd", 100.0, 10_000.0) / (side * side));
    room.add_place(DVec3::new(0.8, 1.0, 0.0), DVec3::Z);
    room.scatter(dice, DVec3::splat(0.3), DVec3::new(1.3, 2.7, 2.3), 2);
    let last = length - 1.2;
    room.scatter(dice, DVec3::new(last, 0.3, 0.3), DVec3::new(length - 0.3, 2.7, 2.3), 2);
    room
}
