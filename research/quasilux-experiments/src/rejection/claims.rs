//! What the methods and the points gain at the largest N, each tested over randomisations.

use super::Curve;
use crate::claim::Claim;
use crate::contrast::{Contrast, Factor};
use crate::significance::{ALIKE, each_of};
use quasilux_report::number::count;

/// Tests in all; the one of likeness has two sides, of which only one can be passed by chance.
const TESTS: usize = 5;
/// What the text says of them.
const TESTED: &str = "significance 1 % for all five together";

/// Five statements, all of them tested.
pub(super) fn claims(curves: &[Curve]) -> Vec<Claim> {
    let [rejection_random, inverse_random, rejection_sobol, inverse_sobol] = curves else {
        return Vec::new();
    };
    let gain = |worse: &Curve, better: &Curve| better.last().under(worse.last());
    let of_rejection = gain(rejection_random, rejection_sobol);
    let of_inverse = gain(inverse_random, inverse_sobol);
    let of_both = Contrast::product(&[
        Factor { power: 1.0, squares: &inverse_random.last().squares },
        Factor { power: -1.0, squares: &inverse_sobol.last().squares },
        Factor { power: -1.0, squares: &rejection_random.last().squares },
        Factor { power: 1.0, squares: &rejection_sobol.last().squares },
    ]);
    let random = gain(rejection_random, inverse_random);
    let sobol = gain(rejection_sobol, inverse_sobol);
    let n = count(inverse_sobol.last().photons);
    let level = each_of(TESTS);
    let more = |what: String, gain: Contrast| {
        Claim::new(
            format!("{what} {}, by more than 1 (t = {:.1}; {TESTED})", gain.text(), gain.t()),
            [gain.ratio, gain.t()],
            gain.is_above(1.0, level),
        )
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
        Claim::new(
            format!(
                "With random points it divides it by {}, which is within a tenth of 1 (two \
                 one-sided tests; {TESTED})",
                random.text()
            ),
            [random.ratio, random.t()],
            random.is_within(ALIKE, level),
        ),
    ]
}
