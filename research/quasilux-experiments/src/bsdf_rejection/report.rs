//! Coordinates and errors, as tables.

use super::walk::Glossy;
use super::{Claim, Setup};
use quasilux_report::number::{count, exact};
use std::fmt::Write;

/// One line for each setup and number of photons.
pub(super) fn csv(setups: &[Setup]) -> String {
    let mut text = "method,sequence,mean_coordinates,n,rms_error\n".to_owned();
    for Setup { method, flights } in setups {
        for error in &flights.errors {
            writeln!(
                text,
                "{},{},{},{},{}",
                method.name(),
                flights.sequence.name(),
                exact(flights.dimensions.mean()),
                error.photons,
                exact(error.rms()),
            )
            .expect("strings grow");
        }
    }
    text
}

/// The table, and what is claimed.
pub(super) fn markdown(
    setups: &[Setup],
    glossy: &Glossy,
    replicates: u32,
    claims: &[Claim],
) -> String {
    let mut text = format!(
        "# Directions of measured surfaces\n\n\
         A closed box lit by a point, its walls of one table: 145 by 145 Klems patches with a \
         glossy lobe, {:.0} % reflected along the normal. The error of the illuminance of a cell \
         (16 on each wall), root mean square over cells and {replicates} randomisations, over the \
         mean.\n\n|",
        100.0 * glossy.albedo(),
    );
    for Setup { method, flights } in setups {
        write!(text, " | {}, {}", method.name(), flights.sequence.name()).expect("strings grow");
    }
    writeln!(text, " |\n|---|{}", "---:|".repeat(setups.len())).expect("strings grow");
    text.push_str("| coordinates a photon |");
    for setup in setups {
        write!(text, " {:.2} |", setup.flights.dimensions.mean()).expect("strings grow");
    }
    for (k, error) in setups[0].flights.errors.iter().enumerate() {
        write!(text, "\n| N = {} |", count(error.photons)).expect("strings grow");
        for setup in setups {
            write!(text, " {:.3} % |", 100.0 * setup.flights.errors[k].rms())
                .expect("strings grow");
        }
    }
    text.push('\n');
    text + &Claim::markdown(claims)
}
