//! Faint narrow beams where few look: on cells, beside shaded sensors, on a facet of metal.

use crate::dice::Dice;
use crate::room::{FoundBy, Parallelogram, Room, Surface};
use crate::shell::{Block, Side};
use glam::DVec3;

/// A recess under a table of a bright hall, open at low x.
const RECESS: [[f64; 3]; 2] = [[5.2, 4.3, 0.0], [6.8, 5.7, 0.8]];

/// Beams that light a spot each on cells whose means are asked for.
pub(crate) fn thin_beams(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let block = Block::new([0.0; 3], [6.0, 5.0, 2.9]);
    room.add_shell(block, Surface::Grey(dice.draw("reflectance", 0.1, 0.7)), &[]);
    room.add_downlight(DVec3::new(3.0, 2.5, 2.85), dice.log("downlight cd", 3.0, 300.0));
    let beams = dice.count("beams", 1, 6);
    let half_deg = dice.log("half angle deg", 0.02, 2.0);
    let flux_lm = dice.log("beam lm", 0.3, 100.0);
    for _ in 0..beams {
        let from = dice.within(DVec3::new(0.5, 0.5, 2.4), DVec3::new(5.5, 4.5, 2.6));
        let to = dice.within(DVec3::new(0.6, 0.6, 0.8), DVec3::new(5.4, 4.4, 0.8));
        room.add_beam(from, to, half_deg, flux_lm);
    }
    room.lamps[1..].iter_mut().for_each(|lamp| lamp.found = FoundBy::BeamsAndJoins);
    for column in 0..3 {
        for row in 0..3 {
            let middle = DVec3::new(1.0 + 2.0 * f64::from(column), 1.0 + 1.5 * f64::from(row), 0.8);
            room.add_cell(middle, DVec3::Z, 1.0);
        }
    }
    room
}

/// A beam inside a shaded recess of a bright hall makes a dot; sensors look at it.
pub(crate) fn dots(dice: &mut Dice) -> Room {
    let mut room = bright_hall(dice);
    let half_deg = dice.log("half angle deg", 0.03, 2.0);
    let flux_lm = dice.log("beam lm", 0.3, 30.0);
    let dot = DVec3::new(6.8, dice.draw("dot y m", 4.5, 5.5), dice.draw("dot z m", 0.15, 0.65));
    room.add_beam(DVec3::new(5.3, 5.0, 0.6), dot, half_deg, flux_lm);
    for _ in 0..6 {
        let reach = dice.between(0.04, 0.5);
        let aside = dice.within(DVec3::new(0.0, -0.1, -0.1), DVec3::new(0.0, 0.1, 0.1));
        let place = dot - DVec3::X * reach + aside;
        room.add_place(place, DVec3::X);
    }
    add_hall_places(&mut room, dice);
    room
}

/// A beam meets a facet of rough metal, which throws it on.
pub(crate) fn jewel(dice: &mut Dice) -> Room {
    let mut room = bright_hall(dice);
    let side = dice.log("facet m", 0.01, 0.1);
    let roughness = dice.draw("roughness", 0.12, 0.5);
    let facet = DVec3::new(6.3, 5.0, 0.08);
    let tilt = DVec3::new(-dice.draw("tilt", 0.0, 0.4), 0.0, 1.0).normalize();
    let metal = Surface::Metal { reflectance: 0.9, roughness };
    room.add_face(Parallelogram::square(facet, tilt, side), metal);
    let from = DVec3::new(5.3, 5.0, dice.draw("lamp z m", 0.3, 0.7));
    let half_deg = dice.log("half angle deg", 0.1, 2.0);
    room.add_beam(from, facet, half_deg, dice.log("beam lm", 1.0, 100.0));
    let along = (facet - from).normalize();
    let thrown = along - tilt * (2.0 * along.dot(tilt));
    for _ in 0..5 {
        let reach = dice.between(0.15, 0.4);
        let aside = dice.within(DVec3::splat(-0.05), DVec3::splat(0.05));
        let place = facet + thrown * reach + aside;
        let inside = place.clamp(DVec3::new(5.3, 4.4, 0.05), DVec3::new(6.7, 5.6, 0.75));
        room.add_place(inside, (facet - inside).normalize());
    }
    add_hall_places(&mut room, dice);
    room
}

/// A chip of millimetres over metal, which shows it as a narrow lobe.
pub(crate) fn chip(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let block = Block::new([0.0; 3], [4.0, 4.0, 2.8]);
    room.add_shell(block, Surface::Grey(dice.draw("reflectance", 0.1, 0.6)), &[]);
    let roughness = dice.log("roughness", 0.06, 0.4);
    let sheet = Parallelogram::square(DVec3::new(2.0, 2.0, 0.4), DVec3::Z, 1.4);
    room.add_face(sheet, Surface::Metal { reflectance: 0.8, roughness });
    let side = dice.log("chip m", 0.001, 0.02);
    let height = dice.draw("chip over metal m", 0.3, 1.2);
    let place = DVec3::new(1.6, 2.0, 0.4 + height);
    let chip = Parallelogram::square(place, DVec3::NEG_Z, side);
    room.add_panel(chip, dice.log("chip cd", 10.0, 1000.0) / (side * side));
    // Where the metal shows it, and as far as its lobes reach.
    let image = DVec3::new(1.6, 2.0, 0.4 - height);
    for reach in [0.0, 2.0, 8.0] {
        let side = side + reach * roughness * roughness * 2.0 * height;
        room.add_hints(block, [Parallelogram::square(image, DVec3::Z, side)]);
    }
    for _ in 0..6 {
        let place = dice.within(DVec3::new(2.0, 1.4, 0.6), DVec3::new(3.4, 2.6, 1.8));
        room.add_place(place, (DVec3::new(2.0, 2.0, 0.4) - place).normalize());
    }
    room.scatter(dice, DVec3::new(0.3, 0.3, 0.5), DVec3::new(3.7, 3.7, 2.4), 3);
    room.hint_shares = [0.6, 0.2];
    room
}

/// A hall under twelve downlights, with the recess.
fn bright_hall(dice: &mut Dice) -> Room {
    let mut room = Room::empty();
    let block = Block::new([0.0; 3], [12.0, 10.0, 4.0]);
    room.add_shell(block, Surface::Grey(dice.draw("reflectance", 0.2, 0.7)), &[]);
    let recess = Block::new(RECESS[0], RECESS[1]);
    let lining = Surface::Grey(dice.draw("recess", 0.05, 0.7));
    let sides = [Side::HighX, Side::LowY, Side::HighY, Side::HighZ];
    sides.into_iter().for_each(|side| room.add_side(recess, side, lining, &[]));
    let intensity_cd = dice.log("downlights cd", 30.0, 3000.0);
    for column in 0..4 {
        for row in 0..3 {
            let place = DVec3::new(1.5 + 3.0 * f64::from(column), 1.5 + 3.5 * f64::from(row), 3.9);
            room.add_downlight(place, intensity_cd);
        }
    }
    room
}

fn add_hall_places(room: &mut Room, dice: &mut Dice) {
    room.scatter(dice, DVec3::new(0.5, 0.5, 0.4), DVec3::new(4.5, 9.0, 1.8), 2);
}
