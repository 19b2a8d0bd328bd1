//! Rules that end a run at the first look at which its interval is narrow enough.

use super::MISS;
use super::kinds::betting::{Bets, Horizon};
use super::kinds::{Limits, standard_deviation, student};
use super::pool::Pool;

/// Of independent indices.
const REPLICATES: usize = 16;
/// Indices of a replicate at the looks.
const LOOKS: [usize; 5] = [128, 256, 512, 1024, 2048];
/// The look at which about half of the intervals of Student's t are narrow enough.
const WANTED_AT: f64 = 512.0;
/// What each look may miss with where 16 replicates are looked at again and again, over what all
/// may: the exponent of `stats/sequential.rs` in quasilux-transport.
const EXPONENT: f64 = 1.0 + 1.25 / 15.0;

/// A closed set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rule {
    /// Student's t at each look as if it were the only one.
    Unpaid,
    /// Student's t as the program does.
    Paid,
    /// Intervals of a betting sequence, which hold at all looks at once.
    Betting,
}

/// Where a run ended.
pub(super) struct End {
    pub(super) limits: Limits,
    /// Indices of all replicates.
    pub(super) samples: usize,
    /// Whether it was its interval that ended it.
    pub(super) is_narrow: bool,
}

impl Rule {
    pub(super) const ALL: [Self; 3] = [Self::Unpaid, Self::Paid, Self::Betting];

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Unpaid => "Student t, looks not paid for",
            Self::Paid => "Student t, looks paid for",
            Self::Betting => "betting sequence",
        }
    }

    /// A run that ends.
    pub(super) fn end(self, pool: &Pool, run: u32) -> End {
        let trials = pool.trials.draw(run, REPLICATES * LOOKS[LOOKS.len() - 1]);
        let tolerance = tolerance(pool);
        let bets = (self == Self::Betting)
            .then(|| Bets::new(&trials, pool.range_lx, MISS, Horizon::Always));
        let limits = |samples: usize| match (&bets, self) {
            (Some(bets), _) => bets.limits(samples),
            (None, Self::Paid) => student_limits(&trials, samples, libm::pow(MISS, EXPONENT)),
            (None, _) => student_limits(&trials, samples, MISS),
        };
        let mut ends = LOOKS.map(|look| REPLICATES * look).into_iter().map(|samples| {
            let limits = limits(samples);
            End { limits, samples, is_narrow: limits.half_width() <= tolerance }
        });
        let last = ends.next().expect("there are looks");
        ends.fold(last, |end, next| if end.is_narrow { end } else { next })
    }
}

/// Half-width that is wanted, in lx.
fn tolerance(pool: &Pool) -> f64 {
    2.131 * standard_deviation(pool.trials.all()) / (REPLICATES as f64 * WANTED_AT).sqrt()
}

/// Of the first indices, dealt to replicates in turn.
fn student_limits(trials: &[f64], samples: usize, miss: f64) -> Limits {
    let mut means = [0.0; REPLICATES];
    for own in trials[..samples].chunks(REPLICATES) {
        means.iter_mut().zip(own).for_each(|(mean, x)| *mean += x);
    }
    let indices = (samples / REPLICATES) as f64;
    student::limits(&means.map(|sum| sum / indices), miss)
}
