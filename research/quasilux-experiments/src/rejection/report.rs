//! The figures as a table for programs and as one for people, with what is seen in them.

use super::floor::Floor;
use super::{Curve, FIT_FROM, Method, REPLICATES, Setup};
use crate::batwing::Luminaire;
use crate::claim::Claim;
use quasilux_report::number::{count, exact};
use quasilux_sampling::Sequence;
use std::fmt::Write;

const COLUMNS: &str = "method,sequence,replicates,n,rms_error,slope,mean_dimension,\
    random_over_this,random_over_this_t,rejection_over_this,rejection_over_this_t";

/// One line for each setup and number of photons. Errors over this one are those of random points
/// with the same method, and those of rejection with the same points; t is of their logarithms.
pub(super) fn csv(curves: &[Curve]) -> String {
    let mut text = format!("{COLUMNS}\n");
    for curve in curves {
        let slope = curve.slope.map(exact).unwrap_or_default();
        for (k, error) in curve.errors.iter().enumerate() {
            let [n, rms] = error.point();
            let over = |method: Method, sequence: Sequence| {
                let own = Setup { method, sequence };
                let other = curves.iter().find(|other| other.setup == own && own != curve.setup);
                other.map_or(",".to_owned(), |other| {
                    let gain = error.under(&other.errors[k]);
                    format!("{},{}", exact(gain.ratio), exact(gain.t()))
                })
            };
            writeln!(
                text,
                "{},{},{REPLICATES},{n},{},{slope},{},{},{}",
                curve.setup.method.name(),
                curve.setup.sequence.name(),
                exact(rms),
                exact(curve.dimensions.mean()),
                over(curve.setup.method, Sequence::Independent),
                over(Method::Rejection, curve.setup.sequence),
            )
            .expect("strings grow");
        }
    }
    text
}

/// The table, and what it says.
pub(super) fn markdown(
    curves: &[Curve],
    luminaire: &Luminaire,
    floor: &Floor,
    claims: &[Claim],
) -> String {
    let mut text = format!(
        "# Inverse transform against rejection\n\n\
         A batwing luminaire of {:.0} lm lights {}, {:.0} lx on average.\n\
         The error of a cell's illuminance, root mean square over cells and {REPLICATES} \
         randomisations, over that\n\
         average. Rejection accepts {:.1} % of its trials. Slopes are fitted from N = {FIT_FROM} \
         on.\n\n",
        luminaire.photometry.flux_lm(),
        floor.description(),
        floor.mean_lx,
        100.0 * luminaire.acceptance(),
    );
    text.push_str(&table(curves));
    text.push_str(&gains(curves));
    text + &Claim::markdown(claims)
}

/// Every second number of photons, and the last.
fn shown(curves: &[Curve]) -> impl Iterator<Item = usize> {
    let last = curves[0].errors.len() - 1;
    (0..=last).filter(move |k| (last - k).is_multiple_of(2))
}

/// A row for each of these, and what belongs to the whole curve.
fn table(curves: &[Curve]) -> String {
    let header = curves.iter().fold("| N |".to_owned(), |header, curve| {
        format!("{header} {}, {} |", curve.setup.method.name(), curve.setup.sequence.name())
    });
    let mut text = format!("{header}\n|---:|{}\n", "---:|".repeat(curves.len()));
    let mut row = |name: String, cell: &dyn Fn(&Curve) -> String| {
        let cells: Vec<String> = curves.iter().map(cell).collect();
        writeln!(text, "| {name} | {} |", cells.join(" | ")).expect("strings grow");
    };
    for k in shown(curves) {
        row(count(curves[0].errors[k].photons), &|curve| {
            let [_, rms] = curve.errors[k].point();
            format!("{:.3} %", 100.0 * rms)
        });
    }
    row("slope".to_owned(), &|curve| match curve.slope {
        Some(slope) => format!("{slope:.2}"),
        None => "-".to_owned(),
    });
    row("coordinates a photon".to_owned(), &|curve| format!("{:.2}", curve.dimensions.mean()));
    text
}

/// What points and methods gain, with intervals.
fn gains(curves: &[Curve]) -> String {
    let mut text = format!(
        "\nHow many times smaller errors are, with 95 % intervals by Student's t over the \
         {REPLICATES} randomisations, which all\n\
         columns have in common: by Sobol' points instead of random ones, and by inverse transform \
         instead of rejection.\n\n\
         | N | Sobol', rejection | Sobol', inverse transform | inverse transform, random | inverse \
         transform, Sobol' |\n\
         |---:|---:|---:|---:|---:|\n"
    );
    let [rejection_random, inverse_random, rejection_sobol, inverse_sobol] = curves else {
        return String::new();
    };
    for k in shown(curves) {
        let gain = |worse: &Curve, better: &Curve| better.errors[k].under(&worse.errors[k]).text();
        writeln!(
            text,
            "| {} | {} | {} | {} | {} |",
            count(curves[0].errors[k].photons),
            gain(rejection_random, rejection_sobol),
            gain(inverse_random, inverse_sobol),
            gain(rejection_random, inverse_random),
            gain(rejection_sobol, inverse_sobol),
        )
        .expect("strings grow");
    }
    text
}
