//! The terms, one by one: how fast they fall, and what they sum to.

use super::terms::Terms;
use crate::course::mean_interval;
use quasilux_drawing::diagram::{Axis, Figure, LegendEntry, Line, Panel, Scale, figure};
use quasilux_drawing::{Dash, PALETTE, Stroke};

const LANDING: Stroke = Stroke::solid(PALETTE[0], 2.5);
const PATHS: Stroke = Stroke::solid(PALETTE[2], 4.0);
const PHOTONS: Stroke = Stroke { colour: PALETTE[1], width_px: 2.0, dash: Dash::Dashed };
const SUMS: Stroke = Stroke::solid(PALETTE[6], 1.5);

/// The plot as an SVG file.
pub(super) fn svg(terms: &Terms) -> String {
    let listed = terms.landing_lm.len() - 1;
    let line = |values: Vec<f64>, stroke: Stroke| Line {
        points: values.into_iter().enumerate().map(|(k, y)| [k as f64, y]).collect(),
        stroke,
    };
    let means = |terms: &[Vec<f64>]| -> Vec<f64> {
        terms.iter().map(|values| mean_interval(values).value).collect()
    };
    let landing = means(&terms.landing_lm);
    // The last of the others is the rest of all terms.
    let (paths, photons) =
        (means(&terms.by_paths_lx[..listed]), means(&terms.by_photons_lx[..listed]));
    let sums: Vec<f64> = (0..listed).map(|k| paths[..=k].iter().sum()).collect();
    let x = || Axis::new("bounces", Scale::Linear, [0.0, listed as f64]).with_step(1.0);
    let panels = vec![
        Panel {
            title: "flux that lands on all surfaces".to_owned(),
            x: x(),
            y: Axis::around("lm", Scale::Log(10), landing.clone()),
            lines: vec![line(landing, LANDING)],
        },
        Panel {
            title: "illuminance of the plane".to_owned(),
            x: x(),
            y: Axis::around("lx", Scale::Log(10), paths.iter().chain(&sums).copied()),
            lines: vec![line(sums, SUMS), line(paths, PATHS), line(photons, PHOTONS)],
        },
    ];
    let entry = |text: &str, stroke| LegendEntry { text: text.to_owned(), stroke: Some(stroke) };
    figure(&Figure {
        title: "Terms of the Neumann series".to_owned(),
        panels,
        columns: 2,
        legend: vec![
            vec![entry("landing flux of a term, by photons", LANDING), entry("sum of terms", SUMS)],
            vec![entry("a term by paths", PATHS), entry("a term by photons", PHOTONS)],
        ],
    })
    .to_svg()
}
