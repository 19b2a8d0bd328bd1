//! Openings that light from outside does not come through: on a wall, in the open, inside.

use crate::finding::{Check, Findings, MAX_LISTED};
use crate::names;
use crate::probe::{cosine_direction, square};
use crate::survey::Survey;
use glam::DVec3;
use quasilux_scene::Opening;

/// Places that are looked at along each edge, and in all openings together.
const MAX_ALONG: u32 = 6;
const PLACES: u32 = 4096;
/// Directions in which the sky is looked for.
const DIRECTIONS: u32 = 64;
/// A surface this near behind an opening closes it, in m; blinds hang further away.
const CLOSED_M: f64 = 0.05;
/// An opening may be so much larger than the glass in it: frames and piers. So much of one that has
/// no room behind it is neither.
const MAX_CLOSED: f64 = 0.5;

/// Why no light comes in at a place.
#[derive(Clone, Copy, PartialEq)]
enum Closed {
    /// A surface is right behind it.
    BySurface,
    /// What is behind it is outside, too.
    InTheOpen,
    /// No side sees the outside.
    Inside,
}

pub(crate) fn check(survey: &Survey<'_>, findings: &mut Findings<'_>) {
    let Some(outside) = &survey.probe.scene.environment else { return };
    let along = (PLACES / outside.openings.len().max(1) as u32).isqrt().clamp(1, MAX_ALONG);
    let before = findings.found.len();
    for (number, opening) in outside.openings.iter().enumerate() {
        if findings.found.len() - before >= MAX_LISTED {
            break;
        }
        let places = places_of(opening, along);
        let closed: Vec<(DVec3, Closed)> =
            places.filter_map(|at| Some((at, closed(survey, opening, at)?))).collect();
        let share_of = |count: usize| count as f64 / f64::from(along * along);
        let share = share_of(closed.len());
        let count = |why: Closed| closed.iter().filter(|(_, it)| *it == why).count();
        if share <= MAX_CLOSED && share_of(count(Closed::InTheOpen)) < MAX_CLOSED {
            continue;
        }
        let reasons = [
            (Closed::BySurface, "a solid surface is right behind it"),
            (Closed::InTheOpen, "there is no room behind it"),
            (Closed::Inside, "it does not face the outside"),
        ];
        let most = reasons.into_iter().max_by_key(|(why, _)| count(*why));
        let (why, reason) = most.expect("three reasons");
        let message = format!(
            "no light comes in through {:.0} % of opening {}: {reason}",
            100.0 * share,
            number + 1
        );
        let cure = "place origin, u and v, in m, in the hole of a wall or the plane of its glass";
        let at = closed.iter().find(|(_, it)| *it == why).expect("there is one").0;
        let place = findings.places.openings[number];
        let message = format!("{message}, for example at {}", names::position(at));
        findings.add(Check::OpeningClosed, place, message, cure).at(at);
    }
}

/// This many places along each edge.
fn places_of(opening: &Opening, count: u32) -> impl Iterator<Item = DVec3> {
    let Opening { origin, u, v } = *opening;
    let along = move |i: u32| (f64::from(i) + 0.5) / f64::from(count);
    (0..count * count).map(move |i| origin + u * along(i % count) + v * along(i / count))
}

/// `None` where light from outside comes in.
fn closed(survey: &Survey<'_>, opening: &Opening, at: DVec3) -> Option<Closed> {
    let probe = survey.probe;
    let n = opening.u.cross(opening.v).normalize();
    let is_outside = |side: DVec3| {
        let from = at + side * probe.hair_m;
        (0..DIRECTIONS).any(|i| probe.first(from, cosine_direction(side, square(i))).is_none())
    };
    let sides = [n, -n].into_iter().filter(|&side| is_outside(side));
    let why = sides.map(|outward| {
        let Some(met) = probe.first(at - outward * probe.hair_m, -outward) else {
            return Some(Closed::InTheOpen);
        };
        let middle = at - 0.5 * met.distance_m * outward;
        match met.distance_m {
            d if d < CLOSED_M => Some(Closed::BySurface),
            _ => survey.is_in_the_open(middle).then_some(Closed::InTheOpen),
        }
    });
    let why: Vec<Option<Closed>> = why.collect();
    match why[..] {
        [] => Some(Closed::Inside),
        [first, ..] if why.iter().all(Option::is_some) => first,
        _ => None,
    }
}
