//! What the values of a room are held against.
//!
//! The truth is the value at the point, or the mean of the cell; where a value is told as blurred,
//! light that only photons can bring counts as its mean over the disc that the run names.

use crate::record::{LookRecord, PointRecord, RunOutcome, RunRecord};
use crate::references::{Reference, RoomReferences};

/// Of the tolerance, the part of a value that may be a mean over the disc and is not told.
const TOLD_SHARE: f64 = 0.1;

/// References of a room.
#[derive(Clone, Debug, PartialEq)]
pub struct Truth {
    /// Of the points as they are.
    pub points: RoomReferences,
    /// Of the points with discs, where runs blur.
    pub discs: Option<DiscReferences>,
}

/// References for points with discs.
#[derive(Clone, Debug, PartialEq)]
pub struct DiscReferences {
    /// The radius of each disc; `None` where no run blurs.
    pub radii_m: Vec<Option<f64>>,
    /// What is found with them.
    pub references: RoomReferences,
}

impl PointRecord {
    /// The radius of the disc over which the value is told to be blurred.
    #[must_use]
    pub fn blurred_over_m(&self, rel_tol: f64) -> Option<f64> {
        let is_told = self.merged_lx > TOLD_SHARE * rel_tol * self.lx;
        self.disc_radius_m.filter(|_| is_told)
    }
}

impl Truth {
    /// What a value is held against; `None` where there is no reference for its disc.
    #[must_use]
    pub fn at_place(&self, place: usize, point: &PointRecord, rel_tol: f64) -> Option<Reference> {
        let Some(radius_m) = point.blurred_over_m(rel_tol) else {
            return Some(self.points.points[place]);
        };
        let discs = self.discs.as_ref()?;
        (discs.radii_m[place] == Some(radius_m)).then(|| discs.references.points[place])
    }
}

/// The radii of the discs over which runs of a room blur, by place; the first one of each.
#[must_use]
pub fn blurred_places(runs: &[RunRecord], digest: &str, places: usize) -> Vec<Option<f64>> {
    let mut radii_m = vec![None; places];
    for run in runs.iter().filter(|run| run.key.digest == digest) {
        let RunOutcome::Done(looks) = &run.outcome else { continue };
        for LookRecord { points, .. } in looks {
            for (radius_m, point) in radii_m.iter_mut().zip(points) {
                *radius_m = radius_m.or(point.blurred_over_m(run.key.rel_tol));
            }
        }
    }
    radii_m
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blurred_values_are_held_against_discs_of_their_radius() {
        let reference = |lx| Reference { lx, standard_error_lx: 0.0, is_sound: true };
        let of = |lx| RoomReferences {
            family: String::new(),
            number: 0,
            digest: String::new(),
            relative_error: 0.006,
            seconds: 1.0,
            points: vec![reference(lx)],
        };
        let discs = DiscReferences { radii_m: vec![Some(0.1)], references: of(2.0) };
        let truth = Truth { points: of(1.0), discs: Some(discs) };
        let point = |merged_lx, radius_m| PointRecord {
            lx: 1.0,
            half_width_lx: Some(0.1),
            unseen_lx: Some(0.0),
            merged_lx,
            disc_radius_m: Some(radius_m),
        };
        let found = |merged_lx, radius_m| {
            truth.at_place(0, &point(merged_lx, radius_m), 0.03).map(|reference| reference.lx)
        };
        assert_eq!(found(0.002, 0.1), Some(1.0), "less than a tenth of the tolerance");
        assert_eq!(found(0.004, 0.1), Some(2.0));
        assert_eq!(found(0.004, 0.2), None, "of another disc nothing is known");
    }
}
