//! The texts below the views: remarks first, then what each number and name stands for.

use super::bounds::Bounds;
use super::contents::Contents;
use super::draw::{balloon, ranges};
use super::ink;
use super::model::PlanLuminaire;
use super::words;
use crate::drawing::Drawing;
use crate::style::{Anchor, Colour, GREY, INK, TextStyle};
use crate::text::{fitted, width_px};
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;

/// Height of a line.
const LINE_PX: f64 = 22.0;
/// Clear space above a heading.
const ABOVE_PX: f64 = 12.0;
/// Lines of one table.
const MAX_LINES: usize = 24;
/// Where columns begin.
const COLUMNS_PX: [f64; 6] = [0.0, 95.0, 280.0, 370.0, 565.0, 705.0];
/// Room between columns.
const BETWEEN_PX: f64 = 12.0;

/// One line.
struct Remark {
    cells: Vec<String>,
    colour: Colour,
    is_heading: bool,
    /// The number in a balloon before it.
    balloon: Option<u32>,
}

/// The lines below the views.
pub(crate) struct Notes {
    notes: Vec<Remark>,
}

impl Notes {
    /// The lines for a width.
    pub(crate) fn new(contents: &Contents<'_>, width_px: f64) -> Self {
        let mut notes = Self { notes: Vec::new() };
        notes.marks(contents, width_px);
        notes.luminaires(contents);
        notes.other_lights(contents);
        notes.sensors(contents);
        notes.cameras(contents);
        notes
    }

    pub(crate) fn height_px(&self) -> f64 {
        self.notes.iter().map(Remark::height_px).sum()
    }

    pub(crate) fn draw(&self, drawing: &mut Drawing, corner: DVec2, width_px: f64) {
        let mut top = corner.y;
        for note in &self.notes {
            top += note.height_px();
            note.draw(drawing, DVec2::new(corner.x, top - 6.0), width_px);
        }
    }

    fn table(&mut self, heading: &[&str], rows: Vec<Remark>) {
        if rows.is_empty() {
            return;
        }
        let cells = heading.iter().map(|&cell| cell.to_owned()).collect();
        self.notes.push(Remark { cells, colour: GREY, is_heading: true, balloon: None });
        let rest = rows.len().saturating_sub(MAX_LINES);
        self.notes.extend(rows.into_iter().take(MAX_LINES));
        if rest > 0 {
            self.notes.push(Remark::plain(vec![format!("and {rest} more")]));
        }
    }

    fn marks(&mut self, contents: &Contents<'_>, width_px: f64) {
        let mut texts: BTreeMap<u32, &str> = BTreeMap::new();
        for mark in contents.picture.marks {
            texts.entry(mark.number).or_insert(&mark.text);
        }
        let rest = texts.len().saturating_sub(MAX_LINES);
        for (number, text) in texts.into_iter().take(MAX_LINES) {
            for (line, text) in wrapped(text, width_px - 32.0).into_iter().enumerate() {
                self.notes.push(Remark {
                    cells: vec![text],
                    colour: ink::FAULT,
                    is_heading: false,
                    balloon: (line == 0).then_some(number),
                });
            }
        }
        if rest > 0 {
            self.notes.push(Remark::plain(vec![format!("and {rest} more")]).coloured(ink::FAULT));
        }
    }

    /// Luminaires of one kind that hang and aim alike share a line; those that hang wrong come
    /// first.
    fn luminaires(&mut self, contents: &Contents<'_>) {
        let mut groups: BTreeMap<LuminaireLine, Vec<usize>> = BTreeMap::new();
        for (index, luminaire) in contents.picture.luminaires.iter().enumerate() {
            let line = LuminaireLine::new(luminaire, contents);
            groups.entry(line).or_default().push(index + 1);
        }
        let mut groups: Vec<(LuminaireLine, Vec<usize>)> = groups.into_iter().collect();
        groups.sort_by(|a, b| {
            (a.0.fault.is_empty(), a.1.first()).cmp(&(b.0.fault.is_empty(), b.1.first()))
        });
        let rows = groups.into_iter().map(|(line, numbers)| line.note(&numbers));
        let heading = ["Luminaires", "file", "z", "aim", "C0", ""];
        self.table(&heading, rows.collect());
    }

    fn other_lights(&mut self, contents: &Contents<'_>) {
        let picture = contents.picture;
        let points = picture.point_lights_m.iter().enumerate().map(|(index, &position_m)| {
            let text = fault(contents, position_m);
            let colour = if text.is_empty() { INK } else { ink::FAULT };
            let cells = vec![format!("P{}", index + 1), words::place(position_m), text];
            Remark::plain(cells).coloured(colour)
        });
        self.table(&["Point lights", "place", ""], points.take(1000).collect());
        let areas = picture.area_lights.iter().map(|light| {
            let corners = light.triangles.iter();
            let corners = corners.filter_map(|&t| picture.surfaces.triangle(t as usize)).flatten();
            let at = Bounds::around(corners).map_or(String::new(), |bounds| {
                let [low, high] = [bounds.low.z, bounds.high.z].map(words::metres);
                if low == high { format!("{low} m") } else { format!("{low} to {high} m") }
            });
            Remark::plain(vec![
                light.name.to_owned(),
                format!("{} triangles", light.triangles.len()),
                at,
            ])
        });
        self.table(&["Luminous surfaces", "", "z"], areas.collect());
    }

    fn sensors(&mut self, contents: &Contents<'_>) {
        let picture = contents.picture;
        let grids = picture.grids.iter().map(|grid| {
            let [columns, rows] = grid.counts;
            let [u, v] = grid.edges_m.map(|edge| words::metres(edge.length()));
            let z = super::symbols::corners_of(grid).map(|corner| corner.z);
            let [low, high] =
                [z.iter().copied().reduce(f64::min), z.iter().copied().reduce(f64::max)]
                    .map(|z| words::metres(z.unwrap_or(0.0)));
            let z = if low == high { format!("{low} m") } else { format!("{low}\u{2013}{high} m") };
            let extent = format!("{columns} x {rows} on {u} m x {v} m");
            Remark::plain(vec![grid.name.to_owned(), extent, z, words::facing(grid.normal)])
        });
        let points = picture.points.iter().filter_map(|named| {
            let first = named.points.first()?;
            let same = named.points.iter().all(|point| point.normal == first.normal);
            let facing =
                if same { words::facing(first.normal) } else { "facing various ways".to_owned() };
            let z = Bounds::around(named.points.iter().map(|point| point.position_m))?;
            let [low, high] = [z.low.z, z.high.z].map(words::metres);
            let z = if low == high { format!("{low} m") } else { format!("{low}\u{2013}{high} m") };
            let count = format!("{} points", named.points.len());
            Some(Remark::plain(vec![named.name.to_owned(), count, z, facing]))
        });
        let rows = grids.chain(points).collect();
        self.table(&["Sensors", "points", "z", "normal"], rows);
    }

    fn cameras(&mut self, contents: &Contents<'_>) {
        let rows = contents.picture.cameras.iter().map(|camera| {
            let ahead = camera.corners.iter().sum::<DVec3>().normalize_or_zero();
            Remark::plain(vec![
                camera.name.to_owned(),
                format!("at {}", words::place(camera.position_m)),
                String::new(),
                words::facing(ahead).replace("facing", "looking"),
            ])
        });
        self.table(&["Cameras"], rows.collect());
    }
}

/// What luminaires of one line have in common.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct LuminaireLine {
    name: String,
    z: String,
    aim: String,
    c0: String,
    fault: String,
}

/// What is wrong with something at a place: how far it is outside, and the remark on it.
fn fault(contents: &Contents<'_>, place_m: DVec3) -> String {
    match (contents.remark_at(place_m), contents.geometry.outside(place_m)) {
        (Some(number), Some(outside)) => format!("remark {number}: {}", outside.brief_text()),
        (Some(number), None) => format!("remark {number}"),
        (None, Some(outside)) => outside.text(),
        (None, None) => String::new(),
    }
}

impl LuminaireLine {
    fn new(luminaire: &PlanLuminaire, contents: &Contents<'_>) -> Self {
        Self {
            name: luminaire.name.clone(),
            z: format!("{} m", words::metres(luminaire.position_m.z)),
            aim: words::aim(luminaire.aim),
            c0: format!("toward {}", words::toward(luminaire.c0)),
            fault: fault(contents, luminaire.position_m),
        }
    }

    fn note(self, numbers: &[usize]) -> Remark {
        let colour = if self.fault.is_empty() { INK } else { ink::FAULT };
        let cells = vec![ranges(numbers), self.name, self.z, self.aim, self.c0, self.fault];
        Remark::plain(cells).coloured(colour)
    }
}

impl Remark {
    fn plain(cells: Vec<String>) -> Self {
        Self { cells, colour: INK, is_heading: false, balloon: None }
    }

    fn coloured(self, colour: Colour) -> Self {
        Self { colour, ..self }
    }

    fn height_px(&self) -> f64 {
        LINE_PX + if self.is_heading { ABOVE_PX } else { 0.0 }
    }

    fn draw(&self, drawing: &mut Drawing, base: DVec2, width_px: f64) {
        let style = TextStyle::new(ink::NOTE_PX, self.colour, Anchor::Start);
        if let [text] = self.cells.as_slice()
            && self.colour == ink::FAULT
        {
            if let Some(number) = self.balloon {
                balloon(drawing, base + DVec2::new(10.0, -4.5), &number.to_string());
            }
            drawing.text([base.x + 32.0, base.y], style, text);
            return;
        }
        for (column, text) in self.cells.iter().enumerate() {
            let left = COLUMNS_PX.get(column).copied().unwrap_or(0.0);
            let next = (column + 1..self.cells.len()).find(|&next| !self.cells[next].is_empty());
            let right = next.and_then(|next| COLUMNS_PX.get(next)).map_or(width_px, |x| *x);
            let text = fitted(text, ink::NOTE_PX, right - left - BETWEEN_PX);
            drawing.text([base.x + left, base.y], style, &text);
        }
    }
}

/// A text in lines of at most a width, broken between words; a word that is too long is cut.
fn wrapped(text: &str, most_px: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        if let Some(last) = lines.last_mut() {
            let longer = format!("{last} {word}");
            if width_px(&longer, ink::NOTE_PX) <= most_px {
                *last = longer;
                continue;
            }
        }
        if lines.len() == 4 {
            break;
        }
        lines.push(fitted(word, ink::NOTE_PX, most_px));
    }
    lines
}
