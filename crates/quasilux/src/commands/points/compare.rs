//! `quasilux points --compare`: root mean squares over randomisations, and their slopes.

use super::curve::{Curve, FIT_FROM};
use super::setup::{Measure, Setup, Stream, counts, replicate};
use super::{comparison_plot, comparison_table};
use crate::arguments::PointsArguments;
use crate::exit::CliError;
use crate::meter::Meter;
use crate::print::print;
use crate::results;
use quasilux_sampling::quality::fit_power_law;
use rayon::prelude::*;

/// Compares, prints the table, and writes the files that were asked for.
pub(super) fn compare(arguments: &PointsArguments) -> Result<(), CliError> {
    let curves = curves(arguments.max_n, arguments.seed);
    if let Some(path) = &arguments.csv {
        let csv = comparison_table::csv(&curves);
        results::write_atomic(path, csv.as_bytes())?;
    }
    if let Some(path) = &arguments.svg {
        let svg = comparison_plot::svg(&curves);
        results::write_atomic(path, svg.as_bytes())?;
    }
    print(&comparison_table::table(&curves))
}

fn curves(max_n: u64, seed: u64) -> Vec<Curve> {
    let (setups, counts) = (Setup::all(), counts(max_n));
    let tasks: Vec<(usize, u32)> = setups
        .iter()
        .enumerate()
        .flat_map(|(i, setup)| (0..setup.replicates()).map(move |number| (i, number)))
        .collect();
    let steps = tasks.iter().map(|(i, _)| setups[*i].points_of(&counts)).sum();
    let meter = Meter::new(steps);
    let measured: Vec<Vec<Vec<f64>>> = tasks
        .par_iter()
        .map(|(i, number)| {
            replicate(&setups[*i], &counts, Stream { seed, number: *number }, &meter)
        })
        .collect();
    drop(meter);
    let mut curves = Vec::new();
    for (m, measure) in Measure::all().into_iter().enumerate() {
        for (i, setup) in setups.iter().enumerate() {
            let own = tasks.iter().zip(&measured).filter(|((task, _), _)| *task == i);
            let replicates: Vec<&[f64]> = own.map(|(_, values)| values[m].as_slice()).collect();
            let points: Vec<[f64; 2]> = (0..replicates[0].len())
                .map(|k| [counts[k] as f64, root_mean_square(replicates.iter().map(|r| r[k]))])
                .collect();
            let fitted: Vec<[f64; 2]> =
                points.iter().copied().filter(|[n, _]| *n >= FIT_FROM).collect();
            let slope = fit_power_law(&fitted).map(|law| law.exponent);
            curves.push(Curve { measure, setup: *setup, points, slope });
        }
    }
    curves
}

fn root_mean_square(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len() as f64;
    (values.map(|x| x * x).sum::<f64>() / count).sqrt()
}
