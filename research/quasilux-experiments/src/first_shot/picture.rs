//! Errors against the number of samples and against rays, with and without first shot.

use super::trial::{NamedCourse, Part, Trial, error};
use crate::course::Snapshot;
use quasilux_drawing::diagram::{Axis, Figure, LegendEntry, Line, Panel, Scale, figure};
use quasilux_drawing::{Dash, PALETTE, Stroke};
use quasilux_sampling::Sequence;

/// What stands along the lower axis: its name, its base, its values.
type Cost = (&'static str, u32, fn(&Snapshot) -> f64);

const COSTS: [Cost; 2] = [
    ("N", 2, |snapshot| snapshot.samples as f64),
    ("rays of a replicate", 10, |snapshot| snapshot.rays),
];

/// The plot as an SVG file.
pub(super) fn svg(trials: &[Trial]) -> String {
    let panels = trials.chunks(2).flat_map(|pair| COSTS.map(|cost| panel(pair, cost)));
    figure(&Figure {
        title: "Photons from the lights and from where light lands".to_owned(),
        panels: panels.collect(),
        columns: 2,
        legend: legend(&trials[..2]),
    })
    .to_svg()
}

fn panel(trials: &[Trial], (label, base, cost): Cost) -> Panel {
    let line = |trial: &Trial| {
        let sequence = trial.sequence;
        trial.runs().map(|NamedCourse { switch, course }| Line {
            points: course
                .snapshots
                .iter()
                .map(|snapshot| [cost(snapshot), error(snapshot, Part::OfPhotons)])
                .collect(),
            stroke: stroke(sequence, switch),
        })
    };
    let lines: Vec<Line> = trials.iter().flat_map(line).collect();
    let values =
        |axis: usize| lines.iter().flat_map(move |l| l.points.iter().map(move |p| p[axis]));
    Panel {
        title: format!("{}, by {label}", trials[0].room),
        x: Axis::around(label, Scale::Log(base), values(0)),
        y: Axis::around("error of what photons bring / mean", Scale::Log(10), values(1)),
        lines: lines.clone(),
    }
}

/// Colours are switches, dashes are points.
fn stroke(sequence: Sequence, switch: &str) -> Stroke {
    let colour = PALETTE[usize::from(switch == "off")];
    match sequence {
        Sequence::Independent => Stroke { colour, width_px: 2.0, dash: Dash::Dashed },
        _ => Stroke::solid(colour, 2.5),
    }
}

fn legend(trials: &[Trial]) -> Vec<Vec<LegendEntry>> {
    let row = |trial: &Trial| {
        let name = trial.sequence.name();
        let entry = |NamedCourse { switch, .. }| LegendEntry {
            text: format!("{name}, first shot {switch}"),
            stroke: Some(stroke(trial.sequence, switch)),
        };
        trial.runs().map(entry).to_vec()
    };
    trials.iter().map(row).collect()
}
