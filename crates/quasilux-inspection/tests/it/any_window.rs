//! Wrong openings and skies of rooms at random with a window, and right ones.

use crate::any_room::{GRIDS, LAMPS, SIZES};
use crate::furnished::{Furnished, Lamp, Patch, v};
use crate::room::{Face, body};
use crate::spoil::{Spoil, fault, quiet, told};
use glam::DVec3;
use quasilux_inspection::Check;
use quasilux_stats::SplitMix64;

const OPENINGS: &str = "[[openings]]";
const CLOSED: &[Check] = &[Check::OpeningClosed];

const ELSEWHERE: &[Spoil] = &[
    |room, dice| {
        // Half of it outside.
        let outer = -room.window?.reveal_m;
        let opening = room.opening.as_mut()?;
        opening.u = DVec3::Y * dice.within(0.5, 0.9) * room.size.y;
        opening.origin.y = outer - 0.5 * opening.u.y;
        Some(fault("through the wall", CLOSED, OPENINGS))
    },
    |room, _| {
        let opening = room.opening.as_mut()?;
        let Patch { origin, u, v } = *opening;
        *opening = Patch { origin: 1e3 * origin, u: 1e3 * u, v: 1e3 * v };
        Some(fault("in mm", CLOSED, OPENINGS))
    },
    |room, dice| {
        room.opening.as_mut()?.origin.y = room.size.y + dice.within(-0.04, 0.04);
        Some(fault("before the wall across", CLOSED, OPENINGS))
    },
    |room, dice| {
        let [left, right, ..] = room.window?.hole;
        let width = right - left;
        let is_left = left > room.size.x - right;
        let free = if is_left { left } else { room.size.x - right };
        let away = dice.within(0.65, 1.0).min(free / width) * width;
        (away >= 0.65 * width).then_some(())?;
        let opening = room.opening.as_mut()?;
        opening.origin.x = if is_left { left - away } else { left + away };
        opening.u.x = width;
        Some(fault("beside the window", CLOSED, OPENINGS))
    },
    |room, dice| {
        room.opening.as_mut()?.origin.y -= dice.within(20.0, 60.0);
        Some(fault("far outside", CLOSED, OPENINGS))
    },
    |room, dice| {
        room.opening.as_mut()?.origin.x += room.size.x + dice.within(0.5, 9.0);
        Some(fault("beside the room", CLOSED, OPENINGS))
    },
    |room, dice| {
        let opening = room.opening.as_mut()?;
        opening.v = DVec3::Y * opening.v.z.min(0.9 * room.size.y);
        opening.origin = opening.origin.with_y(0.02).with_z(dice.within(-0.03, 0.03));
        Some(fault("on the floor", CLOSED, OPENINGS))
    },
];

#[test]
fn openings_elsewhere_are_told() {
    told(300..310, Furnished::with_window, ELSEWHERE);
}

/// A lamp above the ceiling lights the house across the street, and that the room.
#[test]
fn lamps_in_wrong_places_are_told_by_day() {
    told(700..708, Furnished::with_window, LAMPS);
}

#[test]
fn sensors_and_units_are_told_by_day() {
    told(720..724, Furnished::with_window, GRIDS);
    told(720..728, Furnished::with_window, SIZES);
}

/// A frame around the hole, blinds and shelves behind it, a pier in it.
const MEANT: &[fn(&mut Furnished, &mut SplitMix64)] = &[
    |room, dice| {
        let opening = room.opening.as_mut().expect("a window");
        opening.origin.y += dice.within(-0.1, 0.0);
    },
    |room, _| {
        // The other way round.
        let opening = room.opening.as_mut().expect("a window");
        std::mem::swap(&mut opening.u, &mut opening.v);
    },
    |room, dice| {
        let [left, right, bottom, top] = room.window.expect("a window").hole;
        let y = dice.within(0.08, 0.3);
        let corners =
            vec![v(left, y, bottom), v(right, y, bottom), v(right, y, top), v(left, y, top)];
        room.faces.push(Face { object: "blind", material: "wall", corners });
        room.grid.origin.y = room.grid.origin.y.max(y + 0.1);
        room.grid.v *= 0.5;
    },
    |room, dice| {
        let window = room.window.expect("a window");
        let [left, right, bottom, top] = window.hole;
        let opening = room.opening.as_mut().expect("a window");
        opening.origin = v(left, opening.origin.y, bottom);
        (opening.u.x, opening.v.z) = (right - left, top - bottom);
        let width = dice.within(0.1, 0.4) * (right - left);
        let low =
            v(left + dice.within(0.0, 0.6) * (right - left), -window.reveal_m + 0.001, bottom);
        room.faces.extend(body("pier", low, v(low.x + width, 0.02, top)));
    },
    |room, dice| {
        // A lamp on the outer wall, for a square.
        let outer = -room.window.expect("a window").reveal_m;
        let at = v(dice.within(0.2, 0.8) * room.size.x, outer - dice.within(0.05, 0.3), 2.2);
        room.lamps.push(Lamp { position: at, keys: String::new() });
        let square = room.at(at + v(0.3, -1.0, -2.1));
        room.sections += &format!(
            "[[sensors]]\nname = \"square\"\nkind = \"points\"\npoints = [{square}]\n\
             normals = [[0, 0, 1]]\n"
        );
    },
    |room, dice| {
        // Without a pane.
        room.faces.retain(|face| face.material != "glass");
        room.spacing_m = dice.within(0.15, 0.4);
    },
];

#[test]
fn openings_that_are_meant_so_are_right() {
    quiet(500..510, Furnished::with_window, MEANT);
}

/// What the loader says of the sun of Munich's longitude and others, by clocks near and far.
#[test]
fn light_by_night_and_clocks_of_other_continents_are_told() {
    for seed in 600..640 {
        let mut dice = SplitMix64::new(seed);
        let longitude_deg = dice.within(-170.0, 170.0);
        let zone_h = (longitude_deg / 15.0 + dice.within(-0.5, 0.5)).round();
        // At noon and at midnight everywhere between the polar circles.
        let warned = |zone_h: f64, hour: u32, sky: &str| {
            let mut room = Furnished::with_window(&mut SplitMix64::new(seed));
            room.sky = format!(
                "{sky}horizontal_illuminance_lx = 20000\n[site]\nlatitude_deg = {}\n\
                 longitude_deg = {longitude_deg:.2}\ntime_zone_h = {zone_h}\n[sun]\n\
                 time = 2026-{:02}-{:02}T{hour:02}:10:00\n",
                40.0 * (seed as f64 / 20.0 % 2.0 - 1.0),
                1 + seed % 12,
                1 + seed % 28
            );
            room.case().warnings()
        };
        let [clear, perez] =
            ["type = 12\n", "type = 9\n"].map(|it| format!("[sky]\nmodel = \"cie\"\n{it}"));
        let noon = warned(zone_h, 12, &clear);
        assert!(noon.is_empty(), "{seed}: {noon:?}");
        let midnight = warned(zone_h, 0, &perez);
        assert!(midnight.iter().any(|it| it.contains("the sky gives")), "{seed}: {midnight:?}");
        let other = zone_h + dice.pick(&[-1.0, 1.0]) * dice.within(5.0, 11.0).round();
        let other = (other + 36.0).rem_euclid(24.0) - 12.0;
        let elsewhere = warned(other, 12, &clear);
        let is_told = elsewhere.iter().any(|it| it.contains("set it to about"));
        assert!(is_told, "{seed}, {other} h: {elsewhere:?}");
    }
}
