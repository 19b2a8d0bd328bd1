//! `quasilux experiment neumann`: the terms of the Neumann series, table 1 of Voloboy, Dmitriev and
//! Kopylov (2003).
//!
//! Light propagates as `L = Le + I Le + I^2 Le + ...`; the paper shows a room with the first n
//! terms, n = 0, 1, 2 and 4. Here are five pictures of a furnished room under one exposure, these
//! four and all light, and the flux that each term adds: landing on all surfaces and through a
//! plane, by photons and by paths.

mod pictures;
mod plot;
mod report;
mod room;
mod terms;

use crate::outcome::{Options, Outcome, PictureFile};
use pictures::Picture;
use terms::Terms;

/// Bounces that are left in the pictures; `None` leaves all.
const CUTS: [Option<u32>; 5] = [Some(0), Some(1), Some(2), Some(4), None];
/// Replicates, unless the command line says otherwise.
const REPLICATES: u32 = 32;
/// Photons of a replicate, unless the command line says otherwise.
const PHOTONS: u64 = 1 << 17;
/// Paths of a cell are fewer by this factor.
const FEWER: u64 = 1 << 4;
/// Runs of photons for the flux that lands, each one replicate.
const FLUX_RUNS: u64 = 16;
/// Replicates of a pixel, and its paths in each.
const PIXEL_REPLICATES: u32 = 16;
const PIXEL_PATHS: u64 = 16;

/// To what share ratios of landing terms must be known: as much as they may differ by.
const KNOWN: f64 = 0.01;

/// How much is done.
struct Effort {
    replicates: u32,
    photons: u64,
    /// Of a cell of the plane.
    paths: u64,
    flux_runs: u64,
    pixel_paths: u64,
    resolution: [u32; 2],
    seed: u64,
}

/// Takes the pictures and measures the terms.
pub(super) fn run(arguments: &Options) -> Outcome {
    let photons = arguments.max_n.unwrap_or(PHOTONS);
    let effort = Effort {
        replicates: arguments.seeds.unwrap_or(REPLICATES),
        photons,
        paths: (photons / FEWER).max(1),
        flux_runs: FLUX_RUNS,
        pixel_paths: PIXEL_PATHS,
        resolution: room::resolution(),
        seed: arguments.seed,
    };
    let terms = Terms::measure(&effort);
    let pictures = CUTS.map(|cut| Picture::take(cut, &effort));
    let claims = report::claims(&terms, &pictures, KNOWN);
    let tables = report::markdown(&terms, &pictures, &claims);
    Outcome {
        pictures: vec![PictureFile {
            name: "terms".to_owned(),
            png: pictures::side_by_side(&pictures),
        }],
        ..Outcome::new(report::csv(&terms, &pictures), tables, plot::svg(&terms), &claims)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::course::mean_interval;

    /// Seed 0, 16 replicates of few paths and photons, pictures of a few pixels. The claims state
    /// their significance; a term that were counted one too early or late would be off by half, and
    /// terms are known to a seventh at least.
    #[test]
    fn terms_add_up_and_fall() {
        let effort = Effort {
            replicates: 16,
            photons: 1 << 12,
            paths: 1 << 7,
            flux_runs: 12,
            pixel_paths: 4,
            resolution: [12, 9],
            seed: 0,
        };
        let terms = Terms::measure(&effort);
        let pictures = CUTS.map(|cut| Picture::take(cut, &effort));
        for claim in report::claims(&terms, &pictures, 0.1) {
            assert!(claim.holds(), "{}", claim.text());
        }
        for (paths, photons) in terms.by_paths_lx.iter().zip(&terms.by_photons_lx) {
            for values in [paths, photons] {
                let share = mean_interval(values).relative_half_width();
                assert!(share.is_some_and(|share| share < 1.0 / 7.0), "{share:?}");
            }
        }
        assert!(!pictures::side_by_side(&pictures).is_empty());
    }
}
