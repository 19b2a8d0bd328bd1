//! Which points are compared, and what is measured of them.

use crate::meter::Meter;
use quasilux_sampling::quality::{
    Integrand, L2Measure, PointsView, l2_discrepancy, star_discrepancy,
};
use quasilux_sampling::{PointSet, Randomization, Sequence, stream_key};

/// Randomisations of each randomised sequence.
pub(super) const REPLICATES: u32 = 16;
/// Discrepancies take N^2 steps: of more points than this they are not computed.
pub(super) const MAX_MEASURED: u64 = 1 << 10;
/// The smallest number of points compared; the others are this times powers of 4, the counts that
/// suit nets in base 2 and 4 alike.
const MIN: u64 = 1 << 4;

/// Points between two words of how far the work is.
const TOLD: u64 = 1 << 12;

/// A seed, and which of its randomisations.
#[derive(Clone, Copy, Debug)]
pub(super) struct Stream {
    pub(super) seed: u64,
    pub(super) number: u32,
}

/// A sequence under a randomisation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Setup {
    /// Place in the list of sequences.
    pub(super) number: usize,
    pub(super) sequence: Sequence,
    pub(super) randomization: Randomization,
}

impl Setup {
    /// All of them; random points are randomised as they are.
    pub(super) fn all() -> Vec<Self> {
        let sequences = Sequence::all_for(MIN).into_iter().enumerate();
        sequences
            .flat_map(|(number, sequence)| {
                Randomization::ALL
                    .into_iter()
                    .filter(move |kind| {
                        sequence != Sequence::Independent || *kind == Randomization::None
                    })
                    .map(move |randomization| Self { number, sequence, randomization })
            })
            .collect()
    }

    pub(super) fn replicates(&self) -> u32 {
        let fixed =
            self.sequence != Sequence::Independent && self.randomization == Randomization::None;
        if fixed { 1 } else { REPLICATES }
    }

    /// What the randomisation is called; nothing where there is none to choose.
    pub(super) fn randomization_name(&self) -> &'static str {
        if self.sequence == Sequence::Independent { "" } else { self.randomization.name() }
    }

    fn points(&self, count: u64, Stream { seed, number }: Stream) -> PointSet {
        let sequence = Sequence::all_for(count)[self.number];
        PointSet::new(sequence, self.randomization, stream_key(seed, number, 0))
    }

    /// The counts that one set of points serves: all, but where a set must know its count.
    fn runs<'a>(&self, counts: &'a [u64]) -> Vec<&'a [u64]> {
        let needs_count = self.sequence.points().is_some();
        if needs_count { counts.chunks(1).collect() } else { vec![counts] }
    }

    /// Points of one replicate, all sets together.
    pub(super) fn points_of(&self, counts: &[u64]) -> u64 {
        self.runs(counts).iter().filter_map(|run| run.last()).sum()
    }
}

/// What is measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Measure {
    /// The star discrepancy in two dimensions.
    Star,
    /// The centred discrepancy in this many dimensions.
    Centred(usize),
    /// The relative error of a mean.
    Integration(Integrand),
}

impl Measure {
    /// Three discrepancies, then the integrands: rows of three, for 2, 8 and 32 dimensions.
    pub(super) fn all() -> Vec<Self> {
        let discrepancies = [Self::Star, Self::Centred(8), Self::Centred(32)];
        discrepancies.into_iter().chain(Integrand::ALL.map(Self::Integration)).collect()
    }

    pub(super) fn dimensions(self) -> usize {
        match self {
            Self::Star => 2,
            Self::Centred(dimensions) => dimensions,
            Self::Integration(integrand) => integrand.dimensions(),
        }
    }

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Star => "star-discrepancy",
            Self::Centred(_) => "centred-discrepancy",
            Self::Integration(integrand) => integrand.name(),
        }
    }

    /// smooth, kink or jump.
    pub(super) fn roughness(self) -> &'static str {
        match self {
            Self::Star | Self::Centred(_) => "",
            Self::Integration(integrand) => integrand.roughness().name(),
        }
    }
}

/// The numbers of points to compare, up to `most`.
pub(super) fn counts(most: u64) -> Vec<u64> {
    std::iter::successors(Some(MIN), |count| Some(4 * count))
        .take_while(|count| *count <= most)
        .collect()
}

/// One replicate: the measures, each for each number of points where it is computed. Errors are
/// signed.
pub(super) fn replicate(
    setup: &Setup,
    counts: &[u64],
    stream: Stream,
    meter: &Meter,
) -> Vec<Vec<f64>> {
    let measures = Measure::all();
    let mut values = vec![Vec::new(); measures.len()];
    for run in setup.runs(counts) {
        let last = run.last().copied().unwrap_or(0);
        let points = setup.points(last, stream);
        for (measure, values) in measures.iter().zip(&mut values) {
            if !matches!(measure, Measure::Integration(_)) {
                let few = run.iter().filter(|count| **count <= MAX_MEASURED);
                values.extend(few.map(|count| discrepancy(*measure, &points, *count)));
            }
        }
        let errors = integration_errors(&points, run, meter);
        let discrepancies = measures.len() - Integrand::ALL.len();
        for (values, errors) in values[discrepancies..].iter_mut().zip(errors) {
            values.extend(errors);
        }
    }
    values
}

fn discrepancy(measure: Measure, points: &PointSet, count: u64) -> f64 {
    let dimensions = measure.dimensions();
    let coordinates: Vec<f64> = (0..count)
        .flat_map(|index| (0..dimensions as u32).map(move |j| points.coordinate(index, j)))
        .collect();
    let view = PointsView::new(&coordinates, dimensions).expect("points of the unit cube");
    match measure {
        Measure::Star => star_discrepancy(view).expect("few points in two dimensions"),
        _ => l2_discrepancy(view, L2Measure::Centred),
    }
}

/// Relative errors of the means of the first points, for each integrand and each count.
fn integration_errors(points: &PointSet, counts: &[u64], meter: &Meter) -> Vec<Vec<f64>> {
    let mut sums = [0.0; Integrand::ALL.len()];
    let mut errors = vec![Vec::new(); sums.len()];
    let mut u = [0.0; Integrand::MAX_DIMENSIONS];
    let mut next = 0;
    for count in counts {
        for index in next..*count {
            for (j, u) in (0_u32..).zip(&mut u) {
                *u = points.coordinate(index, j);
            }
            for (sum, integrand) in sums.iter_mut().zip(Integrand::ALL) {
                *sum += integrand.value(&u);
            }
            if (index + 1).is_multiple_of(TOLD) {
                meter.add(TOLD);
            }
        }
        next = *count;
        for ((sum, integrand), errors) in sums.iter().zip(Integrand::ALL).zip(&mut errors) {
            errors.push(sum / *count as f64 / integrand.integral() - 1.0);
        }
    }
    errors
}
