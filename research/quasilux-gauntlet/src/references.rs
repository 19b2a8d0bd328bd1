//! What the brute-force program finds, computed once a room and kept by its digest.

use crate::brute_scene::{brute_parts, brute_scene};
use crate::room::Room;
use quasilux_brute::{Estimate, Limits, solve_parts};
use serde::{Deserialize, Serialize};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// References that are shipped with the crate: one room a line.
const SHIPPED: &str = include_str!("../references.jsonl");
/// Seeds of the two halves that have to agree.
const SEEDS: [u64; 2] = [1, 2];
/// Halves that are farther apart, in standard errors of their difference, know less than they say.
const MAX_APART: f64 = 4.5;
/// A single path that makes a larger share of a value leaves too much to chance.
const MAX_OF_ONE_PATH: f64 = 0.02;

/// What a place gets.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reference {
    /// The illuminance in lx.
    pub lx: f64,
    /// Its standard error in lx.
    pub standard_error_lx: f64,
    /// Whether both halves agree, and no single path makes much of them.
    pub is_sound: bool,
}

/// The references of a room.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RoomReferences {
    /// The room's family.
    pub family: String,
    /// Its number in the family.
    pub number: u64,
    /// Its digest.
    pub digest: String,
    /// Standard error over value that they were to have.
    pub relative_error: f64,
    /// The time that they were given, in s.
    pub seconds: f64,
    /// In the order of its places.
    pub points: Vec<Reference>,
}

/// Where references are kept, and what they may cost.
pub struct ReferenceStore {
    /// The folder.
    pub folder: PathBuf,
    /// Standard error over value that is enough.
    pub relative_error: f64,
    /// Time for one room, in s; nothing is computed where it is 0.
    pub seconds: f64,
}

impl Reference {
    /// Whether it can judge values that are to be known to this half-width over value.
    #[must_use]
    pub fn can_judge(&self, rel_tol: f64) -> bool {
        // A hair more than a fifth: runs for the reference end where it is just reached.
        self.is_sound && self.lx > 0.0 && self.standard_error_lx <= 0.2001 * rel_tol * self.lx
    }
}

impl RoomReferences {
    fn fits(&self, room: &Room) -> bool {
        self.digest == room.digest() && self.points.len() == room.places.len()
    }

    /// Whether all places have what was wanted.
    fn is_complete(&self, relative_error: f64) -> bool {
        self.points.iter().all(|point| point.can_judge(5.0 * relative_error))
    }
}

impl ReferenceStore {
    /// The references of a room: kept ones, else new ones; `None` where there are none and none may
    /// be computed.
    ///
    /// # Errors
    /// When the folder cannot be written.
    pub fn for_room(&self, room: &Room) -> io::Result<Option<RoomReferences>> {
        let path = self.folder.join(format!("{}.json", room.digest()));
        let kept = kept(&path).into_iter().chain(shipped_references()).filter(|it| it.fits(room));
        let mut kept: Vec<RoomReferences> = kept.collect();
        let error = |it: &RoomReferences| {
            it.points.iter().filter(|point| point.is_sound).count() as f64 - it.relative_error
        };
        kept.sort_by(|a, b| error(b).total_cmp(&error(a)));
        let best = kept.into_iter().next();
        let suffices = |it: &RoomReferences| {
            let no_better = self.seconds <= it.seconds && it.relative_error <= self.relative_error;
            it.is_complete(self.relative_error) || no_better
        };
        if self.seconds <= 0.0 || best.as_ref().is_some_and(suffices) {
            return Ok(best);
        }
        let new = self.computed(room);
        fs::create_dir_all(&self.folder)?;
        fs::write(&path, serde_json::to_string(&new)?)?;
        Ok(Some(new))
    }

    #[expect(clippy::disallowed_methods, reason = "a reference may take so long")]
    fn computed(&self, room: &Room) -> RoomReferences {
        let scene = brute_scene(room);
        let parts = brute_parts(room, &scene);
        // Of two halves each has the root of two of the error of both.
        let relative_error = self.relative_error * std::f64::consts::SQRT_2;
        let limits = Limits { relative_error, paths: 1 << 40 };
        let halves = SEEDS.map(|seed| {
            let start = Instant::now();
            let may_go_on = || start.elapsed().as_secs_f64() < 0.5 * self.seconds;
            solve_parts(&scene, &parts, limits, seed, may_go_on)
        });
        RoomReferences {
            family: room.family.to_owned(),
            number: room.number,
            digest: room.digest(),
            relative_error: self.relative_error,
            seconds: self.seconds,
            points: (0..room.places.len()).map(|k| joined([halves[0][k], halves[1][k]])).collect(),
        }
    }
}

/// Both halves together.
fn joined(halves: [Estimate; 2]) -> Reference {
    let paths = halves.map(|half| half.paths as f64);
    let share = paths[0] / (paths[0] + paths[1]);
    let errors = halves.map(|half| half.standard_error_lx);
    let lx = share * halves[0].lx + (1.0 - share) * halves[1].lx;
    let standard_error_lx = libm::hypot(share * errors[0], (1.0 - share) * errors[1]);
    let apart = (halves[0].lx - halves[1].lx).abs();
    let agree = apart <= MAX_APART * libm::hypot(errors[0], errors[1]) + 1e-9 * lx;
    let is_sound = agree && halves.iter().all(|half| half.largest_share <= MAX_OF_ONE_PATH);
    Reference { lx, standard_error_lx, is_sound }
}

/// The references that are shipped with the crate.
#[must_use]
pub fn shipped_references() -> Vec<RoomReferences> {
    shipped(SHIPPED).collect()
}

fn kept(path: &Path) -> Option<RoomReferences> {
    serde_json::from_str(&fs::read_to_string(path).ok()?).ok()
}

fn shipped(text: &str) -> impl Iterator<Item = RoomReferences> + '_ {
    text.lines().filter_map(|line| serde_json::from_str(line).ok())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn half(lx: f64, standard_error_lx: f64) -> Estimate {
        Estimate { lx, standard_error_lx, largest_share: 0.001, paths: 1000 }
    }

    #[test]
    fn halves_that_are_far_apart_are_not_sound() {
        let both = joined([half(10.0, 0.1), half(10.2, 0.1)]);
        assert!(both.is_sound && (both.lx - 10.1).abs() < 1e-12);
        assert!((both.standard_error_lx - 0.1 / std::f64::consts::SQRT_2).abs() < 1e-12);
        assert!(both.can_judge(0.04) && !both.can_judge(0.03));
        assert!(!joined([half(10.0, 0.1), half(11.0, 0.1)]).is_sound);
        let of_one = Estimate { largest_share: 0.5, ..half(10.0, 0.1) };
        assert!(!joined([of_one, half(10.0, 0.1)]).is_sound);
        assert!(!joined([half(0.0, 0.0); 2]).can_judge(0.03), "nothing was found");
    }

    #[test]
    fn shipped_references_are_of_rooms_that_are_made() {
        for known in shipped_references() {
            let room = crate::families::room_of(&known.family, known.number);
            assert!(
                room.is_some_and(|room| known.fits(&room)),
                "{} {}",
                known.family,
                known.number
            );
        }
    }
}
