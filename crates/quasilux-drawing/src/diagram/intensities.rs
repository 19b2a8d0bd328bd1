//! A luminaire's intensities over gamma: the polar diagram of data sheets, and a Cartesian one.

use super::curve::IntensityCurve;
use super::head::Head;
use super::legend::{LegendEntry, Rows};
use super::polar::{Extent, Polar, Zero};
use super::{Axis, Line, Panel, Scale};
use crate::drawing::{Drawing, Frame};

/// Intensities to be drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Intensities<'a> {
    /// What stands above the diagrams.
    pub title: &'a str,
    /// What stands below the title, smaller.
    pub subtitle: &'a str,
    /// The planes, the last on top.
    pub curves: &'a [IntensityCurve],
    /// The factor from candela to candela per 1000 lm, the scale of the polar diagram; without it,
    /// that is in candela too.
    pub per_klm: Option<f64>,
    /// The half-planes on the left (negative gamma) and on the right.
    pub sides: [&'a str; 2],
    /// Which diagrams.
    pub diagram: Diagram,
}

/// Which diagrams are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Diagram {
    /// The polar one.
    Polar,
    /// Intensity over gamma, on straight axes.
    Cartesian,
    /// Both, side by side.
    Both,
}

pub(super) const HEAD_PX: f64 = 58.0;
pub(super) const LEGEND_PX: f64 = 40.0;
pub(super) const MARGIN_PX: f64 = 14.0;
const PANEL_PX: [f64; 2] = [440.0, 250.0];

/// Draws the diagrams of a luminaire.
#[must_use]
pub fn intensities(intensities: &Intensities<'_>) -> Drawing {
    let Intensities { curves, sides, diagram, .. } = *intensities;
    let (factor, unit) = intensities.per_klm.map_or((1.0, "cd"), |factor| (factor, "cd/klm"));
    let polar = Polar { curves, factor, unit, sides, zero: Zero::Nadir };
    let [polar_width, polar_height] = polar.size_px();
    let [left, top, right, bottom] = Panel::MARGINS_PX;
    let panel_size = |height: f64| [PANEL_PX[0], height.max(PANEL_PX[1])];
    let (width, height) = match diagram {
        Diagram::Polar => (polar_width, polar_height),
        Diagram::Cartesian => (PANEL_PX[0] + left + right, PANEL_PX[1] + top + bottom),
        Diagram::Both => {
            (polar_width + PANEL_PX[0] + left + right, polar_height.max(PANEL_PX[1] + top + bottom))
        }
    };
    let title = format!("{}, {}", intensities.title, intensities.subtitle);
    let entries = legend_entries(curves);
    let legend = Rows::within(width, &entries);
    let head = Head::within(width, [intensities.title, intensities.subtitle]);
    let top_px = HEAD_PX + head.more_px();
    let below = top_px + height + LEGEND_PX + legend.more_px();
    let mut drawing = Drawing::new(&title, [width + 2.0 * MARGIN_PX, below + MARGIN_PX]);
    head.draw(&mut drawing, MARGIN_PX + 4.0);
    let mut x = MARGIN_PX;
    if diagram != Diagram::Cartesian {
        polar.draw(&mut drawing, [x, top_px + 0.5 * (height - polar_height)]);
        x += polar_width;
    }
    if diagram != Diagram::Polar {
        let size_px = panel_size(height - top - bottom);
        panel(curves).draw(&mut drawing, Frame { corner_px: [x + left, top_px + top], size_px });
    }
    legend.draw(&mut drawing, [MARGIN_PX + 4.0, below - 10.0]);
    drawing
}

fn panel(curves: &[IntensityCurve]) -> Panel {
    let end_deg = if Extent::from_curves(curves) == Extent::Down { 90.0 } else { 180.0 };
    let values = curves.iter().flat_map(|curve| &curve.points).map(|[_, value]| *value);
    let max_value = values.filter(|value| value.is_finite()).fold(0.0, f64::max);
    let high = if max_value > 0.0 { 1.05 * max_value } else { 1.0 };
    let line = |curve: &IntensityCurve| Line { points: curve.points.clone(), stroke: curve.stroke };
    Panel {
        title: "intensity / cd".to_owned(),
        x: Axis::new("gamma / \u{b0}", Scale::Linear, [-end_deg, end_deg]).with_step(end_deg / 3.0),
        y: Axis::new("", Scale::Linear, [0.0, high]),
        lines: curves.iter().map(line).collect(),
    }
}

/// The entry of each curve.
pub(super) fn legend_entries<'a>(
    curves: impl IntoIterator<Item = &'a IntensityCurve>,
) -> Vec<LegendEntry> {
    let entry = |curve: &IntensityCurve| LegendEntry {
        text: curve.name.clone(),
        stroke: Some(curve.stroke),
    };
    curves.into_iter().map(entry).collect()
}
