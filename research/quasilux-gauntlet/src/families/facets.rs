//! Plane mirrors that light depends on: kaleidoscopes, facets that focus, chips.

use crate::dice::Dice;
use crate::room::{FoundBy, Lookout, Parallelogram, Room, Surface};
use crate::shell::{Block, Opening, Side};
use glam::DVec3;
use std::f64::consts::TAU;

/// A prism of mirrors between matt ends, a panel in one of them.
pub(crate) fn kaleidoscope(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let sides = dice.count("mirrors", 3, 6);
    let radius = dice.log("radius m", 0.2, 2.0);
    let length = radius * dice.draw("length over radius", 2.0, 10.0);
    let mirror = Surface::Mirror(dice.draw("mirrors reflect", 0.7, 0.97));
    let ends = Surface::Grey(dice.draw("reflectance", 0.1, 0.8));
    let corner = |side: u32, z: f64| {
        let (sin, cos) = libm::sincos(TAU * f64::from(side) / f64::from(sides));
        DVec3::new(radius * cos, radius * sin, z)
    };
    for side in 0..sides {
        let [a, b] = [corner(side, 0.0), corner(side + 1, 0.0)];
        let [c, d] = [corner(side + 1, length), corner(side, length)];
        room.add_polygon(vec![a, d, c, b], mirror);
    }
    room.add_polygon((0..sides).map(|side| corner(side, 0.0)).collect(), ends);
    room.add_polygon((0..sides).rev().map(|side| corner(side, length)).collect(), ends);
    let side = radius * dice.log("panel over radius", 0.02, 0.4);
    let middle = DVec3::new(0.1 * radius, 0.05 * radius, 0.999 * length);
    let panel = Parallelogram::square(middle, DVec3::NEG_Z, side);
    room.add_panel(panel, dice.log("panel cd", 10.0, 3000.0) / (side * side));
    let reach = 0.3 * radius;
    room.scatter(
        dice,
        DVec3::new(-reach, -reach, 0.05 * length),
        DVec3::new(reach, reach, 0.8 * length),
        7,
    );
    room
}

/// Facets on a wall, each turned so that it throws a panel's light to one place.
pub(crate) fn focus(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let block = Block::new([0.0; 3], [6.0, 5.0, 3.0]);
    room.add_shell(block, Surface::Grey(dice.draw("reflectance", 0.2, 0.7)), &[]);
    let count = dice.count("facets a side", 2, 5);
    let side = dice.log("facet m", 0.02, 0.15);
    let light = DVec3::new(3.5, 2.0, 2.6);
    let target = DVec3::new(2.5, 3.0, 0.8);
    let size = dice.log("panel m", 0.01, 0.2);
    let aim = (DVec3::new(5.8, 2.5, 1.5) - light).normalize();
    let panel = Parallelogram::square(light, aim, size);
    room.add_panel(panel, dice.log("panel cd", 30.0, 3000.0) / (size * size));
    room.add_panel(
        Parallelogram { corner: DVec3::new(1.0, 1.0, 2.99), u: DVec3::Y * 0.5, v: DVec3::X * 0.5 },
        dice.log("ceiling panel cd/m2", 100.0, 5000.0),
    );
    let mut images = Vec::new();
    for column in 0..count {
        for row in 0..count {
            let [y, z] =
                [column, row].map(|k| 1.3 * side * (f64::from(k) - 0.5 * f64::from(count - 1)));
            let middle = DVec3::new(5.8, 2.5 + y, 1.5 + z);
            let normal = ((light - middle).normalize() + (target - middle).normalize()).normalize();
            room.add_face(Parallelogram::square(middle, normal, side), Surface::Mirror(0.92));
            images.push(panel.image(middle, normal));
        }
    }
    room.add_hints(block, images);
    room.add_place(target, (DVec3::new(5.8, 2.5, 1.5) - target).normalize());
    for _ in 0..3 {
        let aside = dice.within(DVec3::splat(-0.1), DVec3::splat(0.1));
        room.add_place(target + aside, DVec3::X);
    }
    room.scatter(dice, DVec3::new(0.5, 0.5, 0.5), DVec3::new(5.0, 4.5, 2.4), 4);
    room.hint_shares = [0.6, 0.2];
    room
}

/// What both kinds of chips share: a room under a downlight, and the chip.
struct Chip {
    middle: DVec3,
    side: f64,
}

fn chip(dice: &mut Dice, room: &mut Room) -> Chip {
    let block = Block::new([0.0; 3], [5.0, 4.0, 2.8]);
    room.add_shell(block, Surface::Grey(dice.draw("reflectance", 0.2, 0.7)), &[]);
    room.add_downlight(DVec3::new(2.0, 2.0, 2.75), dice.log("downlight cd", 30.0, 1000.0));
    let side = dice.log("chip m", 0.005, 0.1);
    Chip { middle: DVec3::new(4.95, dice.draw("chip y m", 0.5, 3.5), 1.8), side }
}

/// Adds the mirror between two places, and has walks find all light.
fn add_mirror(room: &mut Room, Chip { middle, side }: Chip, ends: [DVec3; 2]) {
    let [a, b] = ends.map(|end| (end - middle).normalize());
    let mirror = Parallelogram::square(middle, (a + b).normalize(), side);
    room.add_face(mirror, Surface::Mirror(0.9));
    let (low, high) = (DVec3::NEG_INFINITY, DVec3::INFINITY);
    room.aims.push(Lookout { shape: mirror, low, high });
    room.aim_share = 0.3;
    room.find_all(FoundBy::Joins);
}

/// A chip of mirror throws a beam on a cell and on a place.
pub(crate) fn thrown_beam(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let chip = chip(dice, &mut room);
    let target = dice.within(DVec3::new(1.0, 1.0, 0.6), DVec3::new(3.0, 3.0, 1.0));
    let from = DVec3::new(0.4, dice.draw("lamp y m", 0.4, 3.6), 2.2);
    let half_deg = dice.log("half angle deg", 0.2, 5.0);
    room.add_beam(from, chip.middle, half_deg, dice.log("beam lm", 1.0, 200.0));
    let toward = (chip.middle - target).normalize();
    room.add_cell(target, toward, dice.log("cell m", 0.02, 0.3));
    let spot = chip.side * dice.between(0.02, 0.2);
    add_mirror(&mut room, chip, [from, target]);
    room.add_place(target, DVec3::Z);
    room.places[1].disc_radius_m = spot;
    for _ in 0..4 {
        let place = dice.within(DVec3::new(0.4, 0.4, 0.4), DVec3::new(4.0, 3.6, 2.0));
        room.add_cell(place, DVec3::Z, 0.2);
    }
    room
}

/// A chip of mirror shows a dot that cells do not see themselves.
pub(crate) fn shown_dot(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let chip = chip(dice, &mut room);
    let dot = DVec3::new(dice.draw("dot x m", 0.3, 0.8), dice.draw("dot y m", 0.5, 3.5), 0.0);
    let screen = Opening { side: Side::HighX, low: [0.0, 0.0], high: [4.0, 0.8] };
    room.add_face(screen.at(1.0), Surface::Grey(0.4));
    let from = DVec3::new(dot.x, dot.y + 0.2, 1.5);
    let half_deg = dice.log("half angle deg", 0.1, 3.0);
    room.add_beam(from, dot, half_deg, dice.log("beam lm", 3.0, 300.0));
    let target = dice.within(DVec3::new(1.5, 1.0, 0.1), DVec3::new(3.5, 3.0, 0.5));
    let toward = (chip.middle - target).normalize();
    room.add_cell(target, toward, dice.log("cell m", 0.05, 0.3));
    add_mirror(&mut room, chip, [dot, target]);
    for _ in 0..5 {
        let place = dice.within(DVec3::new(1.3, 0.4, 0.1), DVec3::new(4.5, 3.6, 1.6));
        room.add_cell(place, DVec3::Z, 0.2);
    }
    room
}

/// Downlights before a wall of mirror.
pub(crate) fn mirror_wall(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let block = Block::new([0.0; 3], [5.0, 4.0, 2.8]);
    let mirrors = Opening { side: Side::LowX, low: [0.5, 0.3], high: [3.5, 2.4] };
    room.add_shell(block, Surface::Grey(dice.draw("reflectance", 0.2, 0.8)), &[mirrors]);
    let mut face = mirrors.at(0.0);
    std::mem::swap(&mut face.u, &mut face.v);
    room.add_face(face, Surface::Mirror(dice.draw("mirror", 0.5, 0.95)));
    if dice.coin("second mirror") {
        room.add_face(mirrors.at(4.9), Surface::Mirror(0.8));
    }
    let intensity_cd = dice.log("downlights cd", 30.0, 3000.0);
    for x in [1.2, 3.5] {
        room.add_downlight(DVec3::new(x, 2.0, 2.7), intensity_cd);
    }
    for _ in 0..6 {
        let place = dice.within(DVec3::new(0.4, 0.4, 0.2), DVec3::new(4.4, 3.6, 2.0));
        let normal = dice.normal();
        room.add_cell(place, normal, 0.25);
    }
    room.find_all(FoundBy::Joins);
    room
}
