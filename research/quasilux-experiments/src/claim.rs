//! What an experiment asserts: a sentence with the figures behind it, and whether it holds.

use std::fmt::Write;

/// A statement that the figures of this run bear out or refute.
pub(super) struct Claim {
    text: String,
    holds: bool,
}

impl Claim {
    /// With the figures in the text, and the significance where chance plays a part. What it rests
    /// on is given again as numbers: where one of them is none, or not finite, nothing was found,
    /// and the claim does not hold.
    pub(super) fn new(
        text: String,
        evidence: impl IntoIterator<Item = f64>,
        is_borne_out: bool,
    ) -> Self {
        let is_known = evidence.into_iter().all(f64::is_finite);
        Self { text, holds: is_known && is_borne_out }
    }

    #[cfg(test)]
    pub(super) fn text(&self) -> &str {
        &self.text
    }

    pub(super) fn holds(&self) -> bool {
        self.holds
    }

    /// A list under a heading, those that fail in bold.
    pub(super) fn markdown(claims: &[Self]) -> String {
        let mut text = "\n## What is claimed\n\n".to_owned();
        for Self { text: claim, holds } in claims {
            let verdict = if *holds { "holds" } else { "**FAILS**" };
            writeln!(text, "- {claim}: {verdict}.").expect("strings grow");
        }
        text
    }

    /// Whether all of them hold.
    pub(super) fn all_hold(claims: &[Self]) -> bool {
        claims.iter().all(Self::holds)
    }
}

/// The largest value. No number where one of them is none, which `f64::max` would pass over, or
/// where there are none.
pub(super) fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    let larger = |a: f64, b: f64| if a.is_nan() || a > b { a } else { b };
    values.into_iter().reduce(larger).unwrap_or(f64::NAN)
}

/// The smallest one, likewise.
pub(super) fn smallest(values: impl IntoIterator<Item = f64>) -> f64 {
    -largest(values.into_iter().map(|value| -value))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_number_is_no_evidence() {
        let holds = |evidence: &[f64]| Claim::new(String::new(), evidence.to_vec(), true).holds();
        assert!(holds(&[]) && holds(&[1.0, 0.0]));
        for nothing in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(!holds(&[1.0, nothing]) && !holds(&[nothing, 1.0]));
        }
        assert!(!Claim::new(String::new(), [1.0], false).holds());
    }

    #[test]
    fn what_is_no_number_is_not_passed_over() {
        assert_eq!((largest([1.0, 3.0, 2.0]), smallest([2.0, 1.0, 3.0])), (3.0, 1.0));
        for values in [vec![f64::NAN, 1.0], vec![1.0, f64::NAN, 2.0], vec![1.0, f64::NAN], vec![]] {
            assert!(largest(values.clone()).is_nan() && smallest(values).is_nan());
        }
    }
}
