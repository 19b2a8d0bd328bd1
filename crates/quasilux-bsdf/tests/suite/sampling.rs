//! Sample, density, inverse and albedo of measured surfaces belong together, and to the values.
//!
//! Chi-square: 2^20 pseudo-random samples for each incidence in some 200 boxes, 0.1 % for the whole
//! family (Sidak). Boxes are made of parts that lie along the edges of the table's cells and finer,
//! so that what is expected in them is a sum of values times projected solid angles: it shares
//! nothing with the sums that sampling uses. A density that is 2 % wrong on half of the light is
//! rejected. Lobes are bilinear: for them a part is a midpoint of a quadrature, finer by four a
//! side, and azimuths of trees turned round are cut finely.

use super::{analytic, ddr, direction, merl, surface};
use glam::DVec3;
use quasilux_bsdf::{Distribution, GriddedTable, ScatteringMode, Side, read_merl};
use quasilux_sampling::warp::{invert_disk, sample_disk};
use quasilux_sampling::{PointSet, Randomization, Sequence, stream_key};
use quasilux_stats::SplitMix64;
use quasilux_stats::{CellCount, chi_square_test, sidak, sphere_jacobian};
use std::f64::consts::{PI, TAU};

const SIGNIFICANCE: f64 = 1e-3;
const FAMILY: usize = 50;
const SAMPLES: u64 = 1 << 20;

/// Files and what is taken from them: all kinds of tables, smooth and peaked, isotropic and not.
const SURFACES: [(&str, Side, ScatteringMode); 8] = [
    ("klems-2011-SA1.xml", Side::Front, ScatteringMode::Transmission),
    ("klems-frads-aniso_high.xml", Side::Back, ScatteringMode::Reflection),
    ("klems-room-DiffuseGlass.xml", Side::Front, ScatteringMode::Reflection),
    ("klems-room-blinds.xml", Side::Front, ScatteringMode::Transmission),
    ("tt-pyradiance-t3.xml", Side::Back, ScatteringMode::Transmission),
    // A tree turned round.
    ("tt-pyradiance-t3.xml", Side::Front, ScatteringMode::Transmission),
    ("tt-room-blindsT3.xml", Side::Back, ScatteringMode::Reflection),
    ("radiance-testBSDF.xml", Side::Back, ScatteringMode::Reflection),
];

/// Incidences: near the normal, in between, grazing.
fn incidences() -> [DVec3; 3] {
    [direction(2.0, 13.0), direction(33.0, 47.0), direction(79.0, 311.0)]
}

/// Lobes over incident directions, from closed forms: stored each ten degrees and more, so that
/// they mix.
fn gridded() -> [(&'static str, Distribution); 2] {
    let merl = read_merl(&merl::file(analytic::rough, [30, 30, 30])).unwrap().bsdf;
    let merl = merl.scattering(Side::Front, ScatteringMode::Reflection).unwrap().clone();
    [("DDR", ddr::table(analytic::glossy, 1.0)), ("MERL", merl)]
}

fn distributions() -> impl Iterator<Item = (&'static str, Distribution)> {
    published().chain(gridded())
}

fn published() -> impl Iterator<Item = (&'static str, Distribution)> {
    SURFACES.into_iter().filter_map(|(name, side, mode)| {
        let bsdf = surface(name)?;
        Some((name, bsdf.scattering(side, mode).unwrap().clone()))
    })
}

/// Boxes, and their parts along cell edges.
#[derive(Clone, Copy)]
enum Boxes {
    /// Each band of the full Klems basis in two halves of equal projected solid angle, the azimuth
    /// in 480 parts: patches are centred at azimuth 0.
    Klems,
    /// Squares, this many a side, in a frame turned by that azimuth.
    Squares { turn_rad: f64, side: usize },
    /// Rings of equal width in the sine, the azimuth in 2^17 parts: a tree turned round has edges
    /// between them.
    Rings,
}

/// Ends of the bands of the full basis, in degrees.
const KLEMS_DEG: [f64; 10] = [0.0, 5.0, 15.0, 25.0, 35.0, 45.0, 55.0, 65.0, 75.0, 90.0];
const KLEMS_PHIS: usize = 480;

/// Rings of a tree, and their parts.
const RINGS: usize = 32;
const RING_PHIS: usize = 1 << 17;

impl Boxes {
    fn new(distribution: &Distribution, wi: DVec3) -> Self {
        match distribution {
            Distribution::Klems(_) => Self::Klems,
            Distribution::AdjointTree(_) => Self::Rings,
            _ => {
                let side = if matches!(distribution, Distribution::Gridded(_)) { 256 } else { 64 };
                Self::Squares { turn_rad: libm::atan2(-wi.y, -wi.x), side }
            }
        }
    }

    /// The number of parts.
    fn count(self) -> usize {
        match self {
            Self::Klems => 18 * KLEMS_PHIS,
            Self::Squares { side, .. } => side * side,
            Self::Rings => RINGS * RING_PHIS,
        }
    }

    /// The box that a part belongs to: 18 by 12, or 16 by 16.
    fn whole(self, part: usize) -> usize {
        match self {
            Self::Klems => part / KLEMS_PHIS * 12 + part % KLEMS_PHIS / (KLEMS_PHIS / 12),
            Self::Squares { side, .. } => {
                part / side / (side / 16) * 16 + part % side / (side / 16)
            }
            Self::Rings => {
                part / RING_PHIS / (RINGS / 16) * 16 + part % RING_PHIS / (RING_PHIS / 16)
            }
        }
    }

    /// The part that holds a direction.
    fn place(self, wo: DVec3) -> usize {
        match self {
            Self::Klems => {
                let sin2 = wo.x * wo.x + wo.y * wo.y;
                let ends = klems_sin2();
                let row = ends.partition_point(|&end| end <= sin2).min(18) - 1;
                let turns = (libm::atan2(wo.y, wo.x) / TAU).rem_euclid(1.0);
                row * KLEMS_PHIS + (turns * KLEMS_PHIS as f64) as usize % KLEMS_PHIS
            }
            Self::Squares { turn_rad, side } => {
                let (sin, cos) = libm::sincos(turn_rad);
                let place = invert_disk([cos * wo.x + sin * wo.y, cos * wo.y - sin * wo.x]);
                let [i, j] = place.map(|x| ((x * side as f64) as usize).min(side - 1));
                i * side + j
            }
            Self::Rings => {
                let sine = (wo.x * wo.x + wo.y * wo.y).sqrt();
                let ring = ((sine * RINGS as f64) as usize).min(RINGS - 1);
                let turns = (libm::atan2(wo.y, wo.x) / TAU).rem_euclid(1.0);
                ring * RING_PHIS + (turns * RING_PHIS as f64) as usize % RING_PHIS
            }
        }
    }

    /// A direction inside a part, and its projected solid angle.
    fn middle(self, index: usize) -> (DVec3, f64) {
        match self {
            Self::Klems => {
                let (row, column) = (index / KLEMS_PHIS, index % KLEMS_PHIS);
                let ends = klems_sin2();
                let sine = (0.5 * (ends[row] + ends[row + 1])).sqrt();
                let (sin, cos) = libm::sincos(TAU * (column as f64 + 0.5) / KLEMS_PHIS as f64);
                let projected_sr = PI * (ends[row + 1] - ends[row]) / KLEMS_PHIS as f64;
                (upwards([sine * cos, sine * sin]), projected_sr)
            }
            Self::Squares { turn_rad, side } => {
                let middle = [index / side, index % side].map(|i| (i as f64 + 0.5) / side as f64);
                let [x, y] = sample_disk(middle);
                let (sin, cos) = libm::sincos(turn_rad);
                let projected_sr = PI / (side * side) as f64;
                (upwards([cos * x - sin * y, sin * x + cos * y]), projected_sr)
            }
            Self::Rings => {
                let (ring, part) = (index / RING_PHIS, index % RING_PHIS);
                let sine = (ring as f64 + 0.5) / RINGS as f64;
                let (sin, cos) = libm::sincos(TAU * (part as f64 + 0.5) / RING_PHIS as f64);
                let projected_sr = PI * (2 * ring + 1) as f64 / (RINGS * RINGS * RING_PHIS) as f64;
                (upwards([sine * cos, sine * sin]), projected_sr)
            }
        }
    }
}

/// Squared sines between boxes.
fn klems_sin2() -> [f64; 19] {
    let end = |band: usize| {
        let sine = libm::sin(KLEMS_DEG[band].to_radians());
        sine * sine
    };
    std::array::from_fn(|i| match i % 2 {
        0 => end(i / 2),
        _ => 0.5 * (end(i / 2) + end(i / 2 + 1)),
    })
}

fn upwards([x, y]: [f64; 2]) -> DVec3 {
    DVec3::new(x, y, (1.0 - x * x - y * y).sqrt())
}

/// What is expected in each part, as a share of the incident light.
fn shares(distribution: &Distribution, wi: DVec3, boxes: Boxes) -> Vec<f64> {
    let share = |index| {
        let (wo, projected_sr) = boxes.middle(index);
        distribution.evaluate(wi, wo)[1] * projected_sr
    };
    (0..boxes.count()).map(share).collect()
}

/// The probability of counts of samples under shares.
fn probability(distribution: &Distribution, wi: DVec3, shares: &[f64], key: u64) -> f64 {
    let points = PointSet::new(Sequence::Independent, Randomization::None, stream_key(9, 0, key));
    chi_square_test(&counts(distribution, wi, shares, &points))
}

/// Counts of samples in boxes beside those that shares let expect.
fn counts(
    distribution: &Distribution,
    wi: DVec3,
    shares: &[f64],
    points: &PointSet,
) -> Vec<CellCount> {
    let boxes = Boxes::new(distribution, wi);
    let mut cells = vec![CellCount { observed: 0, expected: 0.0 }; 256];
    for index in 0..SAMPLES {
        let u = [points.coordinate(index, 0), points.coordinate(index, 1)];
        let part = boxes.place(distribution.sample(wi, u).unwrap().wo);
        cells[boxes.whole(part)].observed += 1;
    }
    let total: f64 = shares.iter().sum();
    for (part, share) in shares.iter().enumerate() {
        cells[boxes.whole(part)].expected += share / total * SAMPLES as f64;
    }
    cells.retain(|cell| cell.observed > 0 || cell.expected > 0.0);
    cells
}

#[test]
fn samples_follow_the_values() {
    let level = sidak(SIGNIFICANCE, FAMILY);
    let mut tests = 0;
    for (name, distribution) in distributions() {
        for (key, wi) in incidences().into_iter().enumerate() {
            let shares = shares(&distribution, wi, Boxes::new(&distribution, wi));
            let total: f64 = shares.iter().sum();
            let albedo = distribution.albedo(wi)[1];
            let off = (total / albedo - 1.0).abs();
            let exact = match distribution {
                Distribution::Gridded(_) => 2e-3,
                Distribution::AdjointTree(_) => 1e-4,
                _ => 1e-12,
            };
            assert!(off < exact, "{name}: {albedo} for {total}");
            let probability = probability(&distribution, wi, &shares, key as u64);
            assert!(probability > level, "{name} at {wi}: {probability:e}");
            tests += 1;
        }
    }
    assert!(tests <= FAMILY);
}

/// Owen-scrambled Sobol' points fill boxes more evenly than chance, for which Pearson's statistic
/// is its degrees of freedom: the transform keeps strata. In tables of cells it is 0.0006 to 0.0016
/// of them; lobes share the unit square, and what is expected of them comes from quadrature.
#[test]
fn sobol_samples_fill_boxes_evenly() {
    let points = PointSet::new(Sequence::Sobol, Randomization::Owen, stream_key(9, 1, 0));
    for (name, distribution) in distributions() {
        let wi = incidences()[1];
        let shares = shares(&distribution, wi, Boxes::new(&distribution, wi));
        let counts = counts(&distribution, wi, &shares, &points);
        let filled: Vec<_> = counts.iter().filter(|cell| cell.expected >= 5.0).collect();
        let terms = filled.iter().map(|cell| {
            let difference = cell.observed as f64 - cell.expected;
            difference * difference / cell.expected
        });
        let evenness = terms.sum::<f64>() / (filled.len() - 1) as f64;
        println!("{name}: {evenness:.4}");
        let most = if matches!(distribution, Distribution::Gridded(_)) { 0.2 } else { 0.005 };
        assert!(evenness < most, "{name}: {evenness}");
    }
}

/// Where light is not mostly in few parts, so that half of it can be told apart.
const FLAT: [&str; 2] = ["klems-frads-aniso_high.xml", "radiance-testBSDF.xml"];

#[test]
fn a_density_two_percent_wrong_is_rejected() {
    for (name, distribution) in distributions().filter(|(name, _)| FLAT.contains(name)) {
        let wi = incidences()[1];
        let mut shares = shares(&distribution, wi, Boxes::new(&distribution, wi));
        let total: f64 = shares.iter().sum();
        let mut before = 0.0;
        for share in &mut shares {
            before += *share;
            *share *= if before < 0.5 * total { 1.02 } else { 1.0 };
        }
        let probability = probability(&distribution, wi, &shares, 9);
        assert!(probability < sidak(SIGNIFICANCE, FAMILY), "{name}: {probability:e} passed");
    }
}

/// Without randomness: the map stretches areas by one over the density, goes back to the same
/// coordinates, and each sample estimates the albedo without variance.
#[test]
fn sample_density_and_inverse_belong_together() {
    const STEP: f64 = 1e-7;
    for (name, distribution) in distributions() {
        let mut random = SplitMix64::new(7);
        for wi in incidences() {
            for _ in 0..500 {
                let mut u = || 2.0 * STEP + (1.0 - 4.0 * STEP) * random.uniform();
                let u = [u(), u()];
                let sample = distribution.sample(wi, u).unwrap();
                assert!((sample.wo.length() - 1.0).abs() < 1e-14, "{name} {u:?}");
                let pdf_sr = distribution.pdf_sr(wi, sample.wo);
                assert!((sample.pdf_sr / pdf_sr - 1.0).abs() < 1e-12, "{name} {u:?}");
                let f = distribution.evaluate(wi, sample.wo)[1];
                let estimate = f * sample.wo.z / pdf_sr;
                let albedo = distribution.albedo(wi)[1];
                assert!((estimate / albedo - 1.0).abs() < 1e-12, "{name} {u:?}: {estimate}");
                let back = distribution.invert(wi, sample.wo).unwrap();
                let again = distribution.sample(wi, back).unwrap().wo;
                assert!(again.distance(sample.wo) < 1e-6, "{name}: {u:?} became {back:?}");
                // Of a mixture the density is not that of one of its maps.
                if matches!(distribution, Distribution::Gridded(_)) {
                    continue;
                }
                let off = (back[0] - u[0]).abs().max((back[1] - u[1]).abs());
                assert!(off < 1e-8, "{name}: {u:?} became {back:?}");
                let map = |u| distribution.sample(wi, u).unwrap().wo.to_array();
                let stretch = sphere_jacobian(map, u, STEP) * pdf_sr;
                assert!((stretch - 1.0).abs() < 1e-4, "{name} at {u:?}: {stretch}");
            }
        }
    }
}

/// The same of lobes that are sampled by one map: at an incidence of the file, where no other mixes
/// with it, and of a surface with directions to which it gives nothing, so that Lambert has no
/// part.
#[test]
fn the_map_of_a_lobe_stretches_by_its_density() {
    const STEP: f64 = 1e-7;
    let theta_rad = [0.0, 0.6, 1.2];
    let peak = |wi: DVec3, wo: DVec3| {
        let mirrored = DVec3::new(-wi.x, -wi.y, wi.z);
        (wo.dot(mirrored) - 0.3).max(0.0) * (1.0 + 0.3 * wo.y * wo.y)
    };
    let table = GriddedTable::from_function(&theta_rad, &[0.1, 0.3], peak).unwrap();
    let distribution = Distribution::Gridded(table);
    let mut random = SplitMix64::new(5);
    for wi in distribution.incidences() {
        for _ in 0..500 {
            let mut u = || 2.0 * STEP + (1.0 - 4.0 * STEP) * random.uniform();
            let u = [u(), u()];
            let map = |u| distribution.sample(wi, u).unwrap().wo.to_array();
            let sample = distribution.sample(wi, u).unwrap();
            let stretch = sphere_jacobian(map, u, STEP) * sample.pdf_sr;
            assert!((stretch - 1.0).abs() < 1e-3, "{wi} at {u:?}: {stretch}");
        }
    }
}

/// No value is above the bound, and some samples come near it.
#[test]
fn the_bound_holds() {
    for (name, distribution) in distributions() {
        let mut random = SplitMix64::new(11);
        for wi in incidences() {
            let mut max_value = 0.0_f64;
            for _ in 0..20_000 {
                let u = [random.uniform(), random.uniform()];
                let wo = distribution.sample(wi, u).unwrap().wo;
                max_value = max_value.max(distribution.evaluate(wi, wo)[1] * wo.z);
            }
            let bound = distribution.max_value(wi);
            let ratio = max_value / bound;
            let least = if matches!(distribution, Distribution::Klems(_)) { 0.99 } else { 0.2 };
            assert!(ratio <= 1.0 + 1e-12 && ratio > least, "{name} at {wi}: {ratio}");
        }
    }
}

#[test]
fn corners_of_the_unit_square_have_light_too() {
    for (name, distribution) in distributions() {
        for wi in incidences().into_iter().chain([DVec3::Z, direction(90.0, 10.0)]) {
            for u in [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0], [0.5, 1.0], [1.0, 1e-300]] {
                let sample = distribution.sample(wi, u).unwrap();
                assert!(sample.pdf_sr > 0.0 && sample.pdf_sr.is_finite(), "{name} {u:?}");
                let pdf_sr = distribution.pdf_sr(wi, sample.wo);
                assert!((sample.pdf_sr / pdf_sr - 1.0).abs() < 1e-9, "{name} {u:?}: {pdf_sr}");
            }
        }
    }
}
