//! The polar diagram of luminous intensities, as European data sheets have it (EN 13032-2): gamma =
//! 0 points down, distance from the centre is the intensity.

use super::curve::IntensityCurve;
use crate::drawing::Drawing;
use crate::style::{Anchor, GREY, INK, Stroke, TEXT_PX, TextStyle, WHITE};
use crate::ticks::Ticks;
use std::f64::consts::PI;

/// Which directions are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Extent {
    /// Below the horizon.
    Down,
    /// Above it.
    Up,
    /// All around.
    Full,
}

/// Where angles are counted from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Zero {
    /// From nadir alone, up to 180 degrees.
    Nadir,
    /// From nadir and from zenith, up to 90 degrees.
    BothPoles,
}

/// A polar diagram to be drawn.
pub(super) struct Polar<'a> {
    pub(super) curves: &'a [IntensityCurve],
    /// Factor from the curves' values to the scale's.
    pub(super) factor: f64,
    /// Unit of the scale.
    pub(super) unit: &'static str,
    /// What lies on the left and on the right side.
    pub(super) sides: [&'a str; 2],
    /// Where the angles that are written start.
    pub(super) zero: Zero,
}

const RADIUS_PX: f64 = 205.0;
/// Room for the angles around the outermost ring.
const RIM_PX: f64 = 34.0;
/// Room beyond the horizon, where it is a straight border, for the scale.
const SCALE_PX: f64 = 26.0;
/// Light below this share of the greatest intensity does not show.
const VISIBLE: f64 = 0.005;
const MAX_RINGS: usize = 6;
const RAYS_DEG: u32 = 30;
/// Curves are straight in gamma, so bent in the diagram: drawn in steps of a degree.
const STEP_DEG: f64 = 1.0;
const GRID: Stroke = Stroke::solid([0xcc; 3], 0.9);

impl Extent {
    pub(super) fn from_curves(curves: &[IntensityCurve]) -> Self {
        let max_value = |is_below: bool| {
            let points = curves.iter().flat_map(|curve| refined(&curve.points));
            let side = points.filter(|[gamma_deg, _]| {
                if is_below { gamma_deg.abs() < 89.0 } else { gamma_deg.abs() > 91.0 }
            });
            side.map(|[_, value]| value).fold(0.0, f64::max)
        };
        let (below, above) = (max_value(true), max_value(false));
        match (above > VISIBLE * below, below > VISIBLE * above) {
            (false, _) => Self::Down,
            (true, false) => Self::Up,
            (true, true) => Self::Full,
        }
    }

    /// Room above and below the centre.
    fn heights_px(self) -> [f64; 2] {
        let round = RADIUS_PX + RIM_PX;
        match self {
            Self::Down => [SCALE_PX, round],
            Self::Up => [round, SCALE_PX],
            Self::Full => [round, round],
        }
    }

    /// Gamma at both ends of a ring, in degrees.
    fn ends_deg(self) -> [f64; 2] {
        match self {
            Self::Down => [-90.0, 90.0],
            Self::Up => [90.0, 270.0],
            Self::Full => [-180.0, 180.0],
        }
    }
}

impl Polar<'_> {
    /// Width and height of the diagram.
    pub(super) fn size_px(&self) -> [f64; 2] {
        let [above, below] = Extent::from_curves(self.curves).heights_px();
        [2.0 * (RADIUS_PX + RIM_PX), above + below]
    }

    /// Draws the diagram with its top left corner at `corner_px`.
    pub(super) fn draw(&self, drawing: &mut Drawing, [left, top]: [f64; 2]) {
        let extent = Extent::from_curves(self.curves);
        let centre = [left + RADIUS_PX + RIM_PX, top + extent.heights_px()[0]];
        let rings = self.rings();
        let outermost = rings.values.last().copied().unwrap_or(1.0);
        self.draw_rays(drawing, centre, extent);
        for value in rings.values.iter().filter(|value| **value > 0.0) {
            let stroke = if *value < outermost { GRID } else { Stroke::solid(GREY, 1.0) };
            drawing.line(&arc(centre, RADIUS_PX * value / outermost, extent.ends_deg()), stroke);
        }
        self.draw_scale(drawing, centre, extent, &rings);
        self.draw_sides(drawing, [left, top], extent);
        for curve in self.curves {
            let scale_px = self.factor * RADIUS_PX / outermost;
            drawing.line(&bent(centre, scale_px, &curve.points, extent), curve.stroke);
        }
    }

    /// Round values from 0 to the first one that no curve passes.
    fn rings(&self) -> Ticks {
        let values = self.curves.iter().flat_map(|curve| &curve.points).map(|[_, value]| *value);
        let max_value = values.fold(0.0, f64::max) * self.factor;
        let max_value = if max_value > 0.0 && max_value.is_finite() { max_value } else { 1.0 };
        let step = Ticks::within(0.0, max_value, MAX_RINGS, 0.0).step;
        let last = (max_value / step - 1e-9).ceil() * step;
        Ticks::within(0.0, last, MAX_RINGS + 1, step)
    }

    fn draw_rays(&self, drawing: &mut Drawing, centre: [f64; 2], extent: Extent) {
        let [first, last] = extent.ends_deg();
        let style = TextStyle { size_px: TEXT_PX - 1.0, ..TextStyle::plain(Anchor::Middle) };
        let count = (last - first) as u32 / RAYS_DEG;
        // The ray to zenith is both the first and the last one of a full turn.
        let start = u32::from(extent == Extent::Full);
        for i in start..=count {
            let gamma_deg = first + f64::from(i * RAYS_DEG);
            drawing.line(&[centre, place(centre, RADIUS_PX, gamma_deg)], GRID);
            let [x, y] = place(centre, RADIUS_PX + 16.0, gamma_deg);
            let from_nadir = if gamma_deg > 180.0 { 360.0 - gamma_deg } else { gamma_deg.abs() };
            let named = match self.zero {
                Zero::BothPoles => from_nadir.min(180.0 - from_nadir),
                Zero::Nadir => from_nadir,
            };
            drawing.text([x, y + 4.0], style, &format!("{named}\u{b0}"));
        }
    }

    /// The rings' values along the horizon, and their unit.
    fn draw_scale(&self, drawing: &mut Drawing, [x, y]: [f64; 2], extent: Extent, rings: &Ticks) {
        let outermost = rings.values.last().copied().unwrap_or(1.0);
        let style = TextStyle::new(TEXT_PX - 1.0, INK, Anchor::Middle);
        let base = match extent {
            Extent::Down => y - 7.0,
            Extent::Up => y + 17.0,
            Extent::Full => y + 4.0,
        };
        for value in rings.values.iter().filter(|value| **value > 0.0 && **value < outermost) {
            let label = rings.label(*value);
            let x = x + RADIUS_PX * value / outermost;
            let halo = (extent == Extent::Full).then_some(WHITE);
            let style = TextStyle { halo, ..style };
            drawing.text([x, base], style, &label);
        }
        let style = TextStyle { colour: GREY, ..style };
        match extent {
            Extent::Down | Extent::Up => drawing.text([x, base], style, self.unit),
            Extent::Full => {
                let [right, _] = place([x, y], RADIUS_PX, 90.0);
                let style = TextStyle { anchor: Anchor::End, ..style };
                drawing.text([right - 6.0, base - 10.0], style, self.unit);
            }
        }
    }

    fn draw_sides(&self, drawing: &mut Drawing, [left, top]: [f64; 2], extent: Extent) {
        let [width, height] = self.size_px();
        let y = if extent == Extent::Up { top + 12.0 } else { top + height - 6.0 };
        for (anchor, x, text) in [
            (Anchor::Start, left + 4.0, self.sides[0]),
            (Anchor::End, left + width - 4.0, self.sides[1]),
        ] {
            let style = TextStyle { colour: GREY, ..TextStyle::plain(anchor) };
            drawing.text([x, y], style, text);
        }
    }
}

/// Gamma = 0 is down, positive gamma to the right.
fn place([x, y]: [f64; 2], radius_px: f64, gamma_deg: f64) -> [f64; 2] {
    let (sin, cos) = libm::sincos(gamma_deg / 180.0 * PI);
    [x + radius_px * sin, y + radius_px * cos]
}

fn arc(centre: [f64; 2], radius_px: f64, [first, last]: [f64; 2]) -> Vec<[f64; 2]> {
    let steps = (last - first) as u32;
    (0..=steps).map(|i| place(centre, radius_px, first + f64::from(i))).collect()
}

/// The curve's places; where it lies outside the extent it is left out.
fn bent(centre: [f64; 2], scale_px: f64, points: &[[f64; 2]], extent: Extent) -> Vec<[f64; 2]> {
    let is_shown = |gamma_deg: f64| match extent {
        Extent::Down => gamma_deg.abs() <= 90.0,
        Extent::Up => gamma_deg.abs() >= 90.0,
        Extent::Full => true,
    };
    let shown = |[gamma_deg, value]: [f64; 2]| {
        if is_shown(gamma_deg) { place(centre, scale_px * value, gamma_deg) } else { [f64::NAN; 2] }
    };
    refined(points).into_iter().map(shown).collect()
}

/// Points of a curve that is linear in gamma, so close that straight lines between their places
/// show how it is bent.
fn refined(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut refined: Vec<[f64; 2]> = points.first().copied().into_iter().collect();
    for pair in points.windows(2) {
        let [[from_deg, from], [to_deg, to]] = [pair[0], pair[1]];
        let steps = ((to_deg - from_deg) / STEP_DEG).ceil().clamp(1.0, 360.0) as u32;
        for i in 1..=steps {
            let share = f64::from(i) / f64::from(steps);
            let gamma_deg = from_deg + share * (to_deg - from_deg);
            refined.push([gamma_deg, (1.0 - share) * from + share * to]);
        }
    }
    refined
}
