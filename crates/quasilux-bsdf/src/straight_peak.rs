//! Light that goes straight through a sheet, as far as a table of cells shows it: as a peak of one
//! cell, however narrow it is.

use crate::distribution::Distribution;
use crate::measured::MeasuredBsdf;
use crate::side::{ScatteringMode, Side};
use glam::DVec3;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Steps of the polar angle over a quarter turn, and directions around the normal.
const STEPS: u32 = 720;
const AROUND: u32 = 16;
/// A cell that holds more of the hemisphere than this tells nothing of a peak, in rad.
const WIDEST_RAD: f64 = PI / 6.0;

/// A peak of light that goes straight through, at normal incidence.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StraightPeak {
    /// The share of the light that is in it, beyond what is scattered evenly around it.
    pub share: f64,
    /// How far from straight it reaches, in rad.
    pub half_width_rad: f64,
}

impl MeasuredBsdf {
    /// The peak straight through for light square to one side. `None` where nothing goes through,
    /// no direction stands out, or the table has lobes and no cells.
    ///
    /// What is one cell wide in the table may be as narrow as the sun's disk behind real glass: the
    /// table does not say.
    #[must_use]
    pub fn straight_peak(&self, side: Side) -> Option<StraightPeak> {
        let distribution = self.scattering(side, ScatteringMode::Transmission)?;
        if matches!(distribution, Distribution::Gridded(_)) {
            return None;
        }
        let rings: Vec<Ring> = (0..STEPS).map(|step| Ring::new(distribution, step)).collect();
        let top = rings.first()?.mean;
        let end = rings.iter().position(|ring| ring.mean < 0.5 * top)?;
        let half_width_rad = FRAC_PI_2 * end as f64 / f64::from(STEPS);
        if half_width_rad > WIDEST_RAD {
            return None;
        }
        // What is half as far again is not in it.
        let around = rings.get(end + end / 2 + 1)?.mean;
        let of_ring = |ring: &Ring| (ring.mean - around).max(0.0) * ring.projected_sr;
        let share = rings[..end].iter().map(of_ring).sum();
        Some(StraightPeak { share, half_width_rad })
    }
}

/// Directions at one angle from straight on.
struct Ring {
    /// Mean of f, in sr^-1.
    mean: f64,
    projected_sr: f64,
}

impl Ring {
    fn new(distribution: &Distribution, step: u32) -> Self {
        let angle = |steps: f64| FRAC_PI_2 * steps / f64::from(STEPS);
        let (sine, cosine) = libm::sincos(angle(f64::from(step) + 0.5));
        let value = |i: u32| {
            let (y, x) = libm::sincos(TAU * (f64::from(i) + 0.5) / f64::from(AROUND));
            distribution.evaluate(DVec3::Z, DVec3::new(sine * x, sine * y, cosine))[1]
        };
        let mean = (0..AROUND).map(value).sum::<f64>() / f64::from(AROUND);
        let [low, high] = [step, step + 1].map(|it| libm::sin(angle(f64::from(it))));
        Self { mean, projected_sr: PI * (high * high - low * low) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::facts::{BsdfFacts, BsdfFormat};
    use crate::klems::{AngleBasis, KlemsTable};
    use crate::measured::SheetDistribution;

    /// A sheet that sends `straight` of what comes square to it on straight, and scatters
    /// `scattered` evenly.
    fn sheet(straight: f64, scattered: f64) -> MeasuredBsdf {
        let basis = || AngleBasis::known("LBNL/Klems Full").unwrap();
        let patches = basis().patches();
        // The first patch reaches to 5 degrees.
        let patch_sr = PI * libm::pow(libm::sin(5.0_f64.to_radians()), 2.0);
        let mut values = vec![scattered / PI; patches * patches];
        values[0] += straight / patch_sr;
        let distribution = KlemsTable::new(basis(), basis(), values).unwrap();
        let (side, mode) = (Side::Front, ScatteringMode::Transmission);
        let distribution = Distribution::Klems(distribution);
        let table = SheetDistribution { side, mode, distribution };
        let facts = BsdfFacts {
            format: BsdfFormat::WindowKlems,
            name: String::new(),
            manufacturer: String::new(),
            thickness_m: None,
        };
        MeasuredBsdf::from_tables(facts, [table])
    }

    #[test]
    fn what_goes_straight_is_a_peak_of_one_patch() {
        for (straight, scattered) in [(0.6, 0.0), (0.02, 0.3), (0.3, 0.3)] {
            let peak = sheet(straight, scattered).straight_peak(Side::Front).unwrap();
            assert!((peak.share / straight - 1.0).abs() < 0.01, "{straight}: {peak:?}");
            assert!((peak.half_width_rad.to_degrees() - 5.0).abs() < 0.2, "{peak:?}");
        }
        assert_eq!(sheet(0.0, 0.5).straight_peak(Side::Front), None);
        assert_eq!(sheet(0.6, 0.0).straight_peak(Side::Back), None);
    }
}
