//! Hedged betting: intervals and sequences of them (I. Waudby-Smith and A. Ramdas, "Estimating
//! means of bounded random variables by betting", 2024, sections 4 and 5; A. Jain, F. J.
//! Hickernell, A. B. Owen and A. G. Sorokin, arXiv 2504.18677, 2025, on means of nets).
//!
//! Half of the money is bet on a mean above m and half on one below, `1 + l_t (x_t - m)` and `1 -
//! l_t (x_t - m)` a value; l_t follows from the values before, and no bet loses more than a half. A
//! mean m is out where either half has become `1 / miss`.

use super::Limits;

/// The most of the money that a bet may lose.
const MAX_LOST: f64 = 0.5;
/// Halvings of the range in which a limit lies.
const STEPS: u32 = 34;
/// Factors that are multiplied before their logarithm is taken.
const TOGETHER: usize = 8;

/// When bets are made for.
#[derive(Clone, Copy)]
pub(in super::super) enum Horizon {
    /// All values, looked at once.
    End,
    /// Any time.
    Always,
}

/// Values over their range, with what is bet on each.
pub(in super::super) struct Bets {
    values: Vec<f64>,
    parts: Vec<f64>,
    range: f64,
    miss: f64,
}

/// Of independent values in `[0, range]`: larger ones count as `range`.
pub(super) fn limits(values: &[f64], range: f64, miss: f64) -> Limits {
    Bets::new(values, range, miss, Horizon::End).limits(values.len())
}

impl Bets {
    pub(in super::super) fn new(values: &[f64], range: f64, miss: f64, horizon: Horizon) -> Self {
        let values: Vec<f64> = values.iter().map(|value| (value / range).min(1.0)).collect();
        let log = 2.0 * libm::log(2.0 / miss);
        let n = values.len() as f64;
        // Mean and variance so far, begun with one value of 1/2 and a variance of 1/4.
        let (mut sum, mut squares) = (0.5, 0.25);
        let mut parts = Vec::with_capacity(values.len());
        for (value, t) in values.iter().zip(1_u32..) {
            let t = f64::from(t);
            let times = match horizon {
                Horizon::End => n,
                Horizon::Always => t * libm::log1p(t),
            };
            parts.push((log / (squares / t * times)).sqrt());
            sum += value;
            let off = value - sum / (t + 1.0);
            squares += off * off;
        }
        Self { values, parts, range, miss }
    }

    /// The interval after the first values.
    pub(in super::super) fn limits(&self, count: usize) -> Limits {
        let mean = super::mean(&self.values[..count]);
        let wanted = libm::log(2.0 / self.miss);
        let search = |mut inside: f64, mut outside: f64, sign: f64| {
            for _ in 0..STEPS {
                let middle = 0.5 * (inside + outside);
                match self.log_capital(count, middle, sign) >= wanted {
                    true => outside = middle,
                    false => inside = middle,
                }
            }
            outside * self.range
        };
        Limits { lower: search(mean, 0.0, 1.0), upper: search(mean, 1.0, -1.0) }
    }

    /// The logarithm of what has become of 1 that was bet on a mean above m, or below it where
    /// `sign` is -1.
    fn log_capital(&self, count: usize, m: f64, sign: f64) -> f64 {
        let most = MAX_LOST / if sign > 0.0 { m } else { 1.0 - m };
        let pairs = self.values[..count].chunks(TOGETHER).zip(self.parts.chunks(TOGETHER));
        let of_chunk = |(values, parts): (&[f64], &[f64])| {
            let factors = values.iter().zip(parts);
            let product: f64 =
                factors.map(|(value, part)| 1.0 + sign * part.min(most) * (value - m)).product();
            libm::log(product)
        };
        pairs.map(of_chunk).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use quasilux_sampling::{PointSet, Randomization, Sequence};

    /// All values are 0: a bet below m makes `prod (1 + l_t m)`, and the limit is where that is 2 /
    /// miss. Every part is at its most, `1 / (2 (1 - m))`, where the variance has become small.
    #[test]
    fn of_nothing() {
        let Limits { lower, upper } = limits(&[0.0; 1000], 1.0, 0.05);
        assert_eq!(lower, 0.0);
        let most = 1000.0 * libm::log1p(0.5 * upper / (1.0 - upper));
        assert!(most >= libm::log(40.0) && most < 1.5 * libm::log(40.0), "{upper}");
    }

    /// 400 runs of 300 coins with a mean of 0.1, seed 8: an interval of 95 % may miss in 20, and
    /// so may a sequence of them at any of ten looks. One for a single look would miss more often
    /// if it were looked at so often; a mean that is 0.05 off is missed by most.
    #[test]
    fn coins_are_covered_at_all_looks() {
        let points = PointSet::new(Sequence::Independent, Randomization::None, 8);
        let (mut missed, mut missed_ever, mut far) = (0, 0, 0);
        for run in 0..400 {
            let coin = |dimension| f64::from(u8::from(points.coordinate(run, dimension) < 0.1));
            let coins: Vec<f64> = (0..300).map(coin).collect();
            let limits = limits(&coins, 1.0, 0.05);
            missed += u32::from(!limits.covers(0.1));
            far += u32::from(!limits.covers(0.2));
            let bets = Bets::new(&coins, 1.0, 0.05, Horizon::Always);
            let is_missed = |look: usize| !bets.limits(30 * look).covers(0.1);
            missed_ever += u32::from((1..=10).any(is_missed));
        }
        assert!(missed <= 20 && missed_ever <= 20, "{missed} {missed_ever}");
        assert!(far > 200, "{far}");
    }
}
