//! A luminaire's intensities over gamma: the polar diagram of data sheets, and a Cartesian one.

use super::curve::IntensityCurve;
use super::drawing::{Drawing, Frame};
use super::polar::{Extent, Polar, Zero};
use super::style::{Anchor, GREY, TextStyle, room_px, shortened};
use super::{Axis, Line, Panel, Scale};

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
const LEGEND_LINE_PX: f64 = 34.0;
pub(super) const MARGIN_PX: f64 = 14.0;
const PANEL_PX: [f64; 2] = [440.0, 250.0];

/// The diagrams as an SVG file.
#[must_use]
pub fn intensities(intensities: &Intensities<'_>) -> String {
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
    let mut drawing =
        Drawing::new([width + 2.0 * MARGIN_PX, HEAD_PX + height + LEGEND_PX + MARGIN_PX]);
    draw_head(&mut drawing, [intensities.title, intensities.subtitle], width);
    let mut x = MARGIN_PX;
    if diagram != Diagram::Cartesian {
        polar.draw(&mut drawing, [x, HEAD_PX + 0.5 * (height - polar_height)]);
        x += polar_width;
    }
    if diagram != Diagram::Polar {
        let size_px = panel_size(height - top - bottom);
        panel(curves).draw(&mut drawing, Frame { corner_px: [x + left, HEAD_PX + top], size_px });
    }
    draw_legend(&mut drawing, curves, HEAD_PX + height + LEGEND_PX - 10.0);
    drawing.finish(&format!("{}, {}", intensities.title, intensities.subtitle))
}

fn panel(curves: &[IntensityCurve]) -> Panel {
    let end_deg = if Extent::of(curves) == Extent::Down { 90.0 } else { 180.0 };
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

/// A title, and what stands below it, smaller.
pub(super) fn draw_head(drawing: &mut Drawing, [title, subtitle]: [&str; 2], width_px: f64) {
    for (y, size_px, colour, text) in
        [(26.0, 16.0, None, title), (46.0, 12.0, Some(GREY), subtitle)]
    {
        let plain = TextStyle::plain(Anchor::Start);
        let style = TextStyle { size_px, colour: colour.unwrap_or(plain.colour), ..plain };
        drawing.text([MARGIN_PX + 4.0, y], style, &shortened(text, size_px, width_px));
    }
}

pub(super) fn draw_legend(drawing: &mut Drawing, curves: &[IntensityCurve], y: f64) {
    let style = TextStyle::plain(Anchor::Start);
    let mut x = MARGIN_PX + 4.0;
    for curve in curves {
        drawing.line(&[[x, y - 4.0], [x + LEGEND_LINE_PX, y - 4.0]], curve.stroke);
        x += LEGEND_LINE_PX + 6.0;
        drawing.text([x, y], style, &curve.name);
        x += room_px(&curve.name, style.size_px) + 24.0;
    }
}
