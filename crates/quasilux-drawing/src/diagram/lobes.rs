//! Where a surface sends light: polar diagrams of scattering lobes in the plane of incidence, the
//! side of the light up.

use super::curve::IntensityCurve;
use super::head::Head;
use super::intensities::{HEAD_PX, LEGEND_PX, MARGIN_PX, legend_entries};
use super::legend::Rows;
use super::polar::{Polar, Zero};
use crate::drawing::Drawing;
use crate::style::{Anchor, Dash, GREY, Stroke, TextStyle};

const SUBTITLE: &str = "f cos in the plane of incidence; dotted: where light comes from; \
    up: reflected, down: transmitted";
/// Room for what a diagram shows.
const TITLE_PX: f64 = 18.0;

/// The lobes of light that arrives on one side.
#[derive(Clone, Debug, PartialEq)]
pub struct LobeDiagram {
    /// What stands above it.
    pub title: String,
    /// One for each direction that light comes from.
    pub lobes: Vec<Lobe>,
}

/// Where light from one direction goes.
#[derive(Clone, Debug, PartialEq)]
pub struct Lobe {
    /// The angle between that direction and the normal, in degrees; it is drawn to the left of the
    /// normal.
    pub incidence_deg: f64,
    /// f times the cosine, in sr^-1, over the angle from the normal that points down, -180 to 180
    /// degrees, negative to the left.
    pub curve: IntensityCurve,
}

/// Draws diagrams side by side; lobes of one incidence have the same names and strokes in all of
/// them.
#[must_use]
pub fn lobes(title: &str, diagrams: &[LobeDiagram]) -> Drawing {
    let curves: Vec<Vec<IntensityCurve>> = diagrams.iter().map(curves_and_rays).collect();
    let polars: Vec<Polar<'_>> = curves.iter().map(|curves| polar(curves)).collect();
    let sizes: Vec<[f64; 2]> = polars.iter().map(Polar::size_px).collect();
    let width = sizes.iter().map(|[width, _]| width).sum::<f64>();
    let height = sizes.iter().map(|[_, height]| *height).fold(0.0, f64::max);
    let entries = match diagrams.first() {
        Some(diagram) => legend_entries(diagram.lobes.iter().map(|lobe| &lobe.curve)),
        None => vec![],
    };
    let legend = Rows::within(width, &entries);
    let head = Head::within(width, [title, SUBTITLE]);
    let top_px = HEAD_PX + head.more_px();
    let below = top_px + TITLE_PX + height + LEGEND_PX + legend.more_px();
    let size_px = [width.max(1.0) + 2.0 * MARGIN_PX, below + MARGIN_PX];
    let mut drawing = Drawing::new(&format!("{title}: {SUBTITLE}"), size_px);
    head.draw(&mut drawing, MARGIN_PX + 4.0);
    let style = TextStyle { colour: GREY, ..TextStyle::plain(Anchor::Middle) };
    let mut x = MARGIN_PX;
    for ((diagram, polar), [width, own_height]) in diagrams.iter().zip(&polars).zip(sizes) {
        let top = top_px + TITLE_PX + 0.5 * (height - own_height);
        drawing.text([x + 0.5 * width, top_px + 8.0], style, &diagram.title);
        polar.draw(&mut drawing, [x, top]);
        x += width;
    }
    legend.draw(&mut drawing, [MARGIN_PX + 4.0, below - 10.0]);
    drawing
}

fn polar(curves: &[IntensityCurve]) -> Polar<'_> {
    Polar { curves, factor: 1.0, unit: "sr^{-1}", sides: ["", ""], zero: Zero::BothPoles }
}

/// The lobes, and thin lines to where their light comes from, as long as the largest of the lobes.
fn curves_and_rays(diagram: &LobeDiagram) -> Vec<IntensityCurve> {
    let values = diagram.lobes.iter().flat_map(|lobe| &lobe.curve.points).map(|[_, value]| *value);
    let largest = values.fold(0.0, f64::max);
    let ray = |lobe: &Lobe| {
        let gamma_deg = lobe.incidence_deg - 180.0;
        let stroke = Stroke { width_px: 1.0, dash: Dash::Dotted, ..lobe.curve.stroke };
        let points = vec![[gamma_deg, 0.0], [gamma_deg, largest]];
        IntensityCurve { name: String::new(), points, stroke }
    };
    let lobes = diagram.lobes.iter().map(|lobe| lobe.curve.clone());
    diagram.lobes.iter().map(ray).chain(lobes).collect()
}
