//! The sheet: heading, plan, elevations, the key of symbols, and the texts below.

use super::contents::Contents;
use super::key::{self, Key};
use super::layout::{LEFT_PX, RIGHT_PX};
use super::model::PlanPicture;
use super::notes::Notes;
use super::words::metres;
use super::{axes, draw};
use crate::drawing::Drawing;
use crate::style::{Anchor, GREY, INK, TextStyle};
use crate::text::{fits_at, fitted, width_px, wrapped};
use glam::DVec2;

/// Font sizes of the title, the largest that fits is taken.
const TITLE_PX: [f64; 3] = [26.0, 21.0, 17.0];
const MAX_TITLE_LINES: usize = 4;
const TITLE_BASE_PX: f64 = 48.0;
const FACTS_BASE_PX: f64 = 74.0;
/// Where the views begin.
const TOP_PX: f64 = 118.0;
const BOTTOM_PX: f64 = 24.0;

/// Draws a room in plan and two elevations at one scale, with what is in it, and remarks at their
/// places.
///
/// The plan is cut at the height of the sensors, the elevations in the middle of the geometry: they
/// show what is before the viewer, and of what is behind only what is wrong. Views show the
/// geometry; what lies far outside of it stands at their border with its distance.
#[must_use]
pub fn plan(picture: &PlanPicture<'_>) -> Drawing {
    let mut contents = Contents::new(picture, TOP_PX);
    let content_px = contents.layout.width_px - LEFT_PX - RIGHT_PX;
    let title_px = fits_at(picture.title, &TITLE_PX, content_px);
    let title = wrapped(picture.title, title_px, content_px, MAX_TITLE_LINES);
    let title_line_px = (1.25 * title_px).round();
    let more_px = title.len().saturating_sub(1) as f64 * title_line_px;
    contents.layout.move_down(more_px);
    let layout = &contents.layout;
    let key = Key::new(&contents, content_px);
    let notes = Notes::new(&contents, content_px);
    let notes_top = layout.bottom_px + key.height_px() + 8.0;
    let size_px = [layout.width_px, notes_top + notes.height_px() + BOTTOM_PX];
    let mut drawing = Drawing::new(picture.title, size_px.map(f64::ceil));
    let style = TextStyle::new(title_px, INK, Anchor::Start);
    for (k, line) in title.iter().enumerate() {
        drawing.text([LEFT_PX, TITLE_BASE_PX + k as f64 * title_line_px], style, line);
    }
    let style = TextStyle::new(15.0, GREY, Anchor::Start);
    let facts = fitted(&facts(&contents), 15.0, content_px);
    drawing.text([LEFT_PX, FACTS_BASE_PX + more_px], style, &facts);
    let [x, y, _] = contents.geometry.centre_m().to_array();
    let headings = [
        ["Plan", "", "z", &metres(contents.cut_m)],
        ["Front", " (toward +y)", "y", &metres(y)],
        ["Side", " (toward \u{2212}x)", "x", &metres(x)],
    ];
    let names = [["x", "y"], ["x", "z"], ["y", "z"]];
    for (index, (words, names)) in headings.into_iter().zip(names).enumerate() {
        let view = &layout.views[index];
        draw::draw(&mut drawing, &contents, index);
        axes::draw(&mut drawing, view, &heading(words, view.frame.size_px[0]), names);
    }
    key::compass_and_scale(&mut drawing, layout, picture.north_deg);
    key.draw(&mut drawing, layout);
    notes.draw(&mut drawing, DVec2::new(LEFT_PX, notes_top));
    drawing
}

/// What a view is, which way it looks, and where it is cut; as much as has room.
fn heading([name, way, axis, place]: [&str; 4], most_px: f64) -> String {
    let cut = format!("cut at {axis} = {place} m");
    let all = [format!("{name}{way}, {cut}"), format!("{name}, {cut}")];
    let fits = |text: &&String| width_px(text, axes::HEADING_PX) <= most_px;
    all.iter().find(fits).cloned().unwrap_or_else(|| name.to_owned())
}

/// Size and place of the geometry.
fn facts(contents: &Contents<'_>) -> String {
    let triangles = contents.picture.surfaces.triangles.len();
    if triangles == 0 {
        return "no geometry".to_owned();
    }
    let bounds = contents.geometry;
    let [x, y, z] = bounds.size_m().to_array().map(metres);
    let range = |axis: usize| [bounds.low, bounds.high].map(|p| metres(p[axis])).join(" to ");
    let [along_x, along_y, along_z] = [0, 1, 2].map(range);
    let size = format!("{x} m \u{d7} {y} m \u{d7} {z} m");
    format!("{size}, {triangles} triangles (x {along_x}, y {along_y}, z {along_z} m)")
}

#[cfg(test)]
mod tests;
