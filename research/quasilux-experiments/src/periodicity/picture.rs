//! Width of groups against their number.

use super::Width;
use quasilux_drawing::diagram::{Axis, Figure, LegendEntry, Line, Panel, Scale, figure};
use quasilux_drawing::{Dash, PALETTE, Stroke};
use quasilux_sampling::Randomization;

/// The plot as an SVG file.
pub(super) fn svg(widths: &[Width]) -> String {
    let mut names: Vec<(&str, Randomization)> = Vec::new();
    for width in widths {
        if !names.contains(&(width.sequence, width.randomization)) {
            names.push((width.sequence, width.randomization));
        }
    }
    let mut lines = Vec::new();
    let mut legend = Vec::new();
    for (place, (sequence, randomization)) in names.into_iter().enumerate() {
        let own = || {
            let is_own = move |width: &&Width| {
                (width.sequence, width.randomization) == (sequence, randomization)
            };
            widths.iter().filter(is_own)
        };
        let solid = Stroke::solid(PALETTE[place], 2.5);
        let dashed = Stroke { dash: Dash::Dashed, ..Stroke::solid(PALETTE[place], 1.5) };
        let groups = |width: &Width| width.groups as f64;
        let consecutive = own().map(|w| [groups(w), w.consecutive]).collect();
        lines.push(Line { points: consecutive, stroke: dashed });
        lines.push(Line { points: own().map(|w| [groups(w), w.mean]).collect(), stroke: solid });
        let name = format!("{sequence}, {}", randomization.name());
        let consecutive = format!("{name}: consecutive");
        legend.push(vec![LegendEntry { text: format!("{name}: groups"), stroke: Some(solid) }]);
        legend.push(vec![LegendEntry { text: consecutive, stroke: Some(dashed) }]);
    }
    let values = |pick: fn(&Width) -> [f64; 2], k: usize| widths.iter().map(move |w| pick(w)[k]);
    let groups = |w: &Width| [w.groups as f64; 2];
    let both = |w: &Width| [w.mean, w.consecutive];
    let y = values(both, 0).chain(values(both, 1));
    let panel = Panel {
        title: "photons of a group start close together".to_owned(),
        x: Axis::around("number of groups", Scale::Log(2), values(groups, 0)),
        y: Axis::around("mean width of a coordinate", Scale::Log(10), y),
        lines,
    };
    figure(&Figure { title: "Coherent groups".to_owned(), panels: vec![panel], columns: 1, legend })
        .to_svg()
}
