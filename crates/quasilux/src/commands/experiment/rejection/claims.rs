//! What the methods and the points gain at the largest N, each tested over randomisations.

use super::Curve;
use super::contrast::Contrast;
use crate::commands::experiment::claim::Claim;
use quasilux_measure::number::count;

/// The probability that any of the tests is passed by chance.
const SIGNIFICANCE: f64 = 0.01;
/// Tests in all; the one of likeness has two sides, of which only one can be passed by chance.
const TESTS: f64 = 5.0;
/// What the text says of them.
const TESTED: &str = "significance 1 % for all five together";
/// Errors are alike if they differ by less than this factor.
const ALIKE: f64 = 1.1;

/// Five statements, all of them tested.
pub(super) fn claims(curves: &[Curve]) -> Vec<Claim> {
    let [rejection_random, inverse_random, rejection_sobol, inverse_sobol] = curves else {
        return Vec::new();
    };
    let gain = |worse: &Curve, better: &Curve| better.last().under(worse.last());
    let of_rejection = gain(rejection_random, rejection_sobol);
    let of_inverse = gain(inverse_random, inverse_sobol);
    let of_both = Contrast::of(&[
        (1.0, &inverse_random.last().squares),
        (-1.0, &inverse_sobol.last().squares),
        (-1.0, &rejection_random.last().squares),
        (1.0, &rejection_sobol.last().squares),
    ]);
    let random = gain(rejection_random, inverse_random);
    let sobol = gain(rejection_sobol, inverse_sobol);
    let n = count(inverse_sobol.last().photons);
    let level = -libm::expm1(libm::log1p(-SIGNIFICANCE) / TESTS);
    let more = |what: String, gain: Contrast| Claim {
        text: format!("{what} {}, by more than 1 (t = {:.1}; {TESTED})", gain.text(), gain.t()),
        holds: gain.is_above(1.0, level),
    };
    vec![
        more(
            format!(
                "At N = {n} Sobol' points divide the error of random ones with inverse transform by"
            ),
            of_inverse,
        ),
        more("With rejection they divide it by".to_owned(), of_rejection),
        more("With inverse transform they gain more than with rejection, by".to_owned(), of_both),
        more(
            "Inverse transform divides the error of rejection with Sobol' points by".to_owned(),
            sobol,
        ),
        Claim {
            text: format!(
                "With random points it divides it by {}, which is within a tenth of 1 (two one-sided tests; {TESTED})",
                random.text()
            ),
            holds: random.is_below(ALIKE, level) && random.is_above(ALIKE.recip(), level),
        },
    ]
}
