//! The comparison as a table for people and as one for programs.

use super::curve::{Curve, FIT_FROM};
use super::setup::{Measure, REPLICATES};
use quasilux_report::number::exact;
use std::fmt::Write;

const COLUMNS: &str =
    "measure,roughness,dimensions,sequence,randomization,replicates,n,value,slope";

/// A block for each measure, a line for each setup.
pub(super) fn table(curves: &[Curve]) -> String {
    let mut text = format!(
        "Root mean squares over {REPLICATES} randomisations; unrandomised sequences once. Slopes \
         are fitted from N = {FIT_FROM} on.\n"
    );
    for block in curves.chunk_by(|a, b| a.measure == b.measure) {
        write!(text, "\n{}\n{:<12}{:<10}", heading(block[0].measure), "sequence", "")
            .expect("strings grow");
        for [n, _] in &block[0].points {
            write!(text, "{:>10}", format!("N={n}")).expect("strings grow");
        }
        writeln!(text, "{:>9}", "slope").expect("strings grow");
        for curve in block {
            text.push_str(&line(curve));
        }
    }
    text
}

fn heading(measure: Measure) -> String {
    let (name, dimensions) = (measure.name(), measure.dimensions());
    match measure {
        Measure::Integration(_) => {
            format!("{name}: relative error ({}, {dimensions} dimensions)", measure.roughness())
        }
        _ => format!("{name} ({dimensions} dimensions)"),
    }
}

fn line(curve: &Curve) -> String {
    let name = curve.setup.sequence.name();
    let mut text = format!("{name:<12}{:<10}", curve.setup.randomization_name());
    for [_, value] in &curve.points {
        write!(text, "{value:>10.2e}").expect("strings grow");
    }
    match curve.slope {
        Some(slope) => writeln!(text, "{slope:>9.2}"),
        None => writeln!(text, "{:>9}", "-"),
    }
    .expect("strings grow");
    text
}

/// One line for each measure, setup and number of points.
pub(super) fn csv(curves: &[Curve]) -> String {
    let mut text = format!("{COLUMNS}\n");
    for curve in curves {
        let (measure, setup) = (curve.measure, &curve.setup);
        let slope = curve.slope.map(exact).unwrap_or_default();
        for [n, value] in &curve.points {
            writeln!(
                text,
                "{},{},{},{},{},{},{n},{},{slope}",
                measure.name(),
                measure.roughness(),
                measure.dimensions(),
                setup.sequence.name(),
                setup.randomization_name(),
                setup.replicates(),
                exact(*value),
            )
            .expect("strings grow");
        }
    }
    text
}
