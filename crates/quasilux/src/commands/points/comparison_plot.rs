//! The comparison as a figure: a plot for each measure, logarithmic both ways.

use super::curve::Curve;
use super::setup::{Measure, REPLICATES};
use quasilux_drawing::diagram::{Axis, Figure, LegendEntry, Line, Panel, Scale, figure};
use quasilux_drawing::{Colour, Dash, PALETTE, Stroke};
use quasilux_sampling::{Randomization, Sequence};

/// Plots side by side: 2, 8 and 32 dimensions.
const COLUMNS: usize = 3;
const GUIDE: Stroke = Stroke::solid([0xc4; 3], 1.0);
/// Slopes of the guides.
const GUIDES: [f64; 3] = [-0.5, -1.0, -1.5];
const GUIDES_NAME: &str = "guides: N^{−1/2}, N^{−1}, N^{−3/2}";

/// The figure as an SVG file.
pub(super) fn svg(curves: &[Curve]) -> String {
    let blocks: Vec<&[Curve]> = curves.chunk_by(|a, b| a.measure == b.measure).collect();
    let plots = blocks.len();
    let panels = blocks
        .into_iter()
        .enumerate()
        .map(|(i, block)| panel(block, i % COLUMNS == 0, i + COLUMNS >= plots))
        .collect();
    figure(&Figure {
        title: format!("Root mean square over {REPLICATES} randomisations against N"),
        panels,
        columns: COLUMNS,
        legend: legend(curves),
    })
    .to_svg()
}

fn panel(block: &[Curve], is_first: bool, is_lowest: bool) -> Panel {
    let measure = block[0].measure;
    let values =
        |axis: usize| block.iter().flat_map(move |c| c.points.iter().map(move |p| p[axis]));
    let y_label = match measure {
        Measure::Integration(_) => "relative error",
        Measure::Star | Measure::Centred(_) => "discrepancy",
    };
    let lines =
        block.iter().map(|curve| Line { points: curve.points.clone(), stroke: stroke(curve) });
    Panel {
        title: title(measure),
        x: Axis::around(
            if is_lowest { "number of points N" } else { "" },
            Scale::Log(2),
            values(0),
        ),
        y: Axis::around(if is_first { y_label } else { "" }, Scale::Log(10), values(1)),
        lines: guides(block).into_iter().chain(lines).collect(),
    }
}

fn title(measure: Measure) -> String {
    let dimensions = measure.dimensions();
    match measure {
        Measure::Star => format!("star discrepancy, d = {dimensions}"),
        Measure::Centred(_) => format!("centred discrepancy, d = {dimensions}"),
        Measure::Integration(integrand) => {
            format!("{}: {}, d = {dimensions}", measure.roughness(), integrand.name())
        }
    }
}

/// From the largest value at the smallest N.
fn guides(block: &[Curve]) -> Vec<Line> {
    let points = &block[0].points;
    let (Some([first, _]), Some([last, _])) = (points.first(), points.last()) else {
        return Vec::new();
    };
    let top = block.iter().filter_map(|c| c.points.first()).map(|p| p[1]).fold(0.0, f64::max);
    let guide = |slope: f64| {
        let end = top * libm::pow(last / first, slope);
        Line { points: vec![[*first, top], [*last, end]], stroke: GUIDE }
    };
    GUIDES.into_iter().map(guide).collect()
}

fn stroke(curve: &Curve) -> Stroke {
    let dash = dash(curve.setup.randomization, curve.setup.sequence);
    let width_px = if dash == Dash::Solid { 2.0 } else { 1.0 };
    Stroke { colour: colour(curve.setup.number, curve.setup.sequence), width_px, dash }
}

fn colour(number: usize, sequence: Sequence) -> Colour {
    if sequence == Sequence::Independent { [0; 3] } else { PALETTE[number % (PALETTE.len() - 1)] }
}

fn dash(randomization: Randomization, sequence: Sequence) -> Dash {
    match randomization {
        _ if sequence == Sequence::Independent => Dash::Solid,
        Randomization::Owen => Dash::Solid,
        Randomization::DigitalShift => Dash::Dashed,
        Randomization::CranleyPattersonRotation => Dash::DashDot,
        Randomization::None => Dash::Dotted,
    }
}

/// Colours are sequences, dashes are randomisations.
fn legend(curves: &[Curve]) -> Vec<Vec<LegendEntry>> {
    let heading = |text: &str| LegendEntry { text: text.to_owned(), stroke: None };
    let mut sequences = vec![heading("sequence")];
    for setup in curves.iter().map(|curve| curve.setup) {
        let text = setup.sequence.name().to_owned();
        if sequences.iter().all(|entry| entry.text != text) {
            let stroke = Stroke::solid(colour(setup.number, setup.sequence), 2.4);
            sequences.push(LegendEntry { text, stroke: Some(stroke) });
        }
    }
    let mut randomizations = vec![heading("randomisation")];
    randomizations.extend(Randomization::ALL.into_iter().map(|kind| {
        let dash = dash(kind, Sequence::Sobol);
        let stroke = Stroke { colour: [0x55; 3], width_px: 1.6, dash };
        LegendEntry { text: kind.name().to_owned(), stroke: Some(stroke) }
    }));
    randomizations.push(LegendEntry { text: GUIDES_NAME.to_owned(), stroke: Some(GUIDE) });
    vec![sequences, randomizations]
}
