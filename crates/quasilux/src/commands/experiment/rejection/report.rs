//! The figures as a table for programs and as one for people, with what is seen in them.

use super::floor::Floor;
use super::{Curve, FIT_FROM, REPLICATES};
use crate::commands::experiment::batwing::Luminaire;
use crate::commands::experiment::claim::Claim;
use quasilux_measure::number::exact;
use std::fmt::Write;

const COLUMNS: &str = "method,sequence,replicates,n,rms_error,slope,mean_dimension";

/// One line for each setup and number of photons.
pub(super) fn csv(curves: &[Curve]) -> String {
    let mut text = format!("{COLUMNS}\n");
    for curve in curves {
        let slope = curve.slope.map(exact).unwrap_or_default();
        for [n, error] in &curve.points {
            writeln!(
                text,
                "{},{},{REPLICATES},{n},{},{slope},{}",
                curve.setup.method.name(),
                curve.setup.sequence.name(),
                exact(*error),
                exact(curve.dimensions.mean()),
            )
            .expect("strings grow");
        }
    }
    text
}

/// The table, and what it says.
pub(super) fn markdown(curves: &[Curve], luminaire: &Luminaire, floor: &Floor) -> String {
    let mut text = format!(
        "# Inverse transform against rejection\n\n\
         A batwing luminaire of {:.0} lm lights {}, {:.0} lx on average.\n\
         The error of a cell's illuminance, root mean square over cells and {REPLICATES} randomisations, over that\n\
         average. Rejection accepts {:.1} % of its trials. Slopes are fitted from N = {FIT_FROM} on.\n\n",
        luminaire.photometry.flux_lm(),
        floor.description(),
        floor.mean_lx,
        100.0 * luminaire.acceptance(),
    );
    text.push_str(&table(curves));
    text.push_str(&Claim::markdown(&claims(curves)));
    text
}

/// A row for every second power of four, and the last.
fn table(curves: &[Curve]) -> String {
    let header = curves.iter().fold("| N |".to_owned(), |header, curve| {
        format!("{header} {}, {} |", curve.setup.method.name(), curve.setup.sequence.name())
    });
    let mut text = format!("{header}\n|---:|{}\n", "---:|".repeat(curves.len()));
    let mut row = |name: String, cell: &dyn Fn(&Curve) -> String| {
        let cells: Vec<String> = curves.iter().map(cell).collect();
        writeln!(text, "| {name} | {} |", cells.join(" | ")).expect("strings grow");
    };
    let last = curves[0].points.len() - 1;
    for k in (0..=last).filter(|k| (last - k).is_multiple_of(2)) {
        row(format!("{}", curves[0].points[k][0]), &|curve| {
            format!("{:.3} %", 100.0 * curve.points[k][1])
        });
    }
    row("slope".to_owned(), &|curve| match curve.slope {
        Some(slope) => format!("{slope:.2}"),
        None => "-".to_owned(),
    });
    row("coordinates a photon".to_owned(), &|curve| format!("{:.2}", curve.dimensions.mean()));
    text
}

/// What the methods and the points gain, at the largest N. Root mean squares over cells and randomisations scatter
/// by about 2 % each, so that limits 10 % and more away are not crossed by chance.
pub(super) fn claims(curves: &[Curve]) -> Vec<Claim> {
    let last = |curve: &Curve| curve.points.last().map_or(f64::NAN, |point| point[1]);
    let [rejection_random, inverse_random, rejection_sobol, inverse_sobol] = curves else {
        return Vec::new();
    };
    let n = inverse_sobol.points.last().map_or(f64::NAN, |point| point[0]);
    let gain = |worse: &Curve, better: &Curve| last(worse) / last(better);
    let of_inverse = gain(inverse_random, inverse_sobol);
    let of_rejection = gain(rejection_random, rejection_sobol);
    let random = gain(rejection_random, inverse_random);
    let sobol = gain(rejection_sobol, inverse_sobol);
    vec![
        Claim {
            text: format!(
                "At N = {n} Sobol' points divide the error of random ones by {of_inverse:.1} with inverse transform, by \
                 {of_rejection:.1} with rejection, which is less"
            ),
            holds: of_inverse > 1.1 * of_rejection,
        },
        Claim {
            text: format!(
                "Inverse transform divides the error of rejection by {sobol:.1} with Sobol' points, by {random:.2} with \
                 random ones, which is 1 but for chance"
            ),
            holds: sobol > 1.1 && (random - 1.0).abs() < 0.1,
        },
    ]
}
