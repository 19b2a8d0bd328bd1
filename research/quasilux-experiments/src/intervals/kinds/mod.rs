//! Kinds of confidence intervals: each from the same number of indices.

pub(super) mod bernstein;
pub(super) mod betting;
mod bootstrap;
mod order;
pub(super) mod student;

use super::MISS;
use super::pool::{OF_A_LARGE_NET, OF_A_NET, Pool};
use quasilux_transport::certified::{lower_limit, upper_limit};

/// Indices behind each interval.
pub(super) const INDICES: usize = 4096;

/// A confidence interval.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Limits {
    pub(super) lower: f64,
    pub(super) upper: f64,
}

impl Limits {
    /// Half of its width.
    pub(super) fn half_width(&self) -> f64 {
        0.5 * (self.upper - self.lower)
    }

    pub(super) fn covers(&self, truth: f64) -> bool {
        self.lower <= truth && truth <= self.upper
    }
}

/// A closed set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    StudentT,
    BootstrapT,
    OrderStatistics,
    Bernstein,
    BettingOnTrials,
    BettingOnNets,
    Certified,
}

impl Kind {
    pub(super) const ALL: [Self; 7] = [
        Self::StudentT,
        Self::BootstrapT,
        Self::OrderStatistics,
        Self::Bernstein,
        Self::BettingOnTrials,
        Self::BettingOnNets,
        Self::Certified,
    ];

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::StudentT => "Student t",
            Self::BootstrapT => "bootstrap t",
            Self::OrderStatistics => "order statistics",
            Self::Bernstein => "empirical Bernstein",
            Self::BettingOnTrials => "hedged betting on trials",
            Self::BettingOnNets => "hedged betting on nets",
            Self::Certified => "certified",
        }
    }

    /// What it is made of.
    pub(super) fn what(self) -> &'static str {
        match self {
            Self::StudentT => "mean of 16 nets of 256 Sobol' points, 15 degrees of freedom",
            Self::BootstrapT => "the same nets, drawn again 999 times with their own spread",
            Self::OrderStatistics => {
                "the 4th and the 13th of the same 16 means (Pan 2025): holds their median with \
                 97.9 %, by the binomial law"
            }
            Self::Bernstein => {
                "4096 independent indices with the range K W (Maurer and Pontil 2009)"
            }
            Self::BettingOnTrials => {
                "the same indices, bets for and against the mean (Waudby-Smith and Ramdas 2024)"
            }
            Self::BettingOnNets => {
                "256 nets of 16 Sobol' points, the same range (Jain and others 2025)"
            }
            Self::Certified => {
                "what `interval = \"certified\"` gives: bets on 256 means of 16 independent \
                 indices below, roots above"
            }
        }
    }

    /// The interval of a run.
    pub(super) fn limits(self, pool: &Pool, run: u32) -> Limits {
        let nets = || pool.nets.draw(run, INDICES / OF_A_NET as usize);
        let large_nets = || pool.large_nets.draw(run, INDICES / OF_A_LARGE_NET as usize);
        let trials = || pool.trials.draw(run, INDICES);
        match self {
            Self::StudentT => student::limits(&large_nets(), MISS),
            Self::BootstrapT => bootstrap::limits(&large_nets(), MISS, run),
            Self::OrderStatistics => order::limits(&large_nets(), MISS),
            Self::Bernstein => bernstein::limits(&trials(), pool.range_lx, MISS),
            Self::BettingOnTrials => betting::limits(&trials(), pool.range_lx, MISS),
            Self::BettingOnNets => betting::limits(&nets(), pool.range_lx, MISS),
            Self::Certified => {
                let trials = trials();
                let means: Vec<f64> = trials.chunks(OF_A_NET as usize).map(mean).collect();
                let upper =
                    upper_limit(mean(&trials), pool.most_lx, trials.len() as f64, 0.5 * MISS);
                Limits { lower: lower_limit(&means, 0.5 * MISS), upper }
            }
        }
    }
}

pub(super) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// The square root of the unbiased variance.
pub(super) fn standard_deviation(values: &[f64]) -> f64 {
    let mean = mean(values);
    let squares: f64 = values.iter().map(|x| (x - mean) * (x - mean)).sum();
    (squares / (values.len() as f64 - 1.0)).sqrt()
}
