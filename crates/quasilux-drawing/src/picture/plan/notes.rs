//! The texts below the views: remarks first, then what each number and name stands for.

use super::bounds::Bounds;
use super::contents::Contents;
use super::draw::{balloon, ranges};
use super::ink;
use super::model::PlanLuminaire;
use super::words;
use crate::drawing::Drawing;
use crate::style::{Anchor, Colour, GREY, INK, TextStyle};
use crate::text::{width_px, wrapped};
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;

/// Height of a line.
const LINE_PX: f64 = 22.0;
/// Clear space above a heading.
const ABOVE_PX: f64 = 12.0;
/// Lines of one table.
const MAX_LINES: usize = 24;
/// Where columns begin, if what stands before leaves them their places.
const COLUMNS_PX: [f64; 6] = [0.0, 95.0, 280.0, 370.0, 565.0, 705.0];
/// Most lines of a cell.
const MAX_CELL_LINES: usize = 4;
/// Most lines of a remark.
const MAX_REMARK_LINES: usize = 6;
/// Room between columns.
const BETWEEN_PX: f64 = 12.0;

/// One row of a table, or one line of a remark.
struct Remark {
    cells: Vec<String>,
    /// The lines of each cell, where they are known, and where each begins.
    columns: Vec<Column>,
    colour: Colour,
    is_heading: bool,
    /// The number in a balloon before it.
    balloon: Option<u32>,
}

/// A cell of a row.
struct Column {
    left_px: f64,
    lines: Vec<String>,
}

/// The lines below the views.
pub(crate) struct Notes {
    notes: Vec<Remark>,
    width_px: f64,
}

impl Notes {
    /// The lines for a width.
    pub(crate) fn new(contents: &Contents<'_>, width_px: f64) -> Self {
        let mut notes = Self { notes: Vec::new(), width_px };
        notes.marks(contents);
        notes.luminaires(contents);
        notes.other_lights(contents);
        notes.sensors(contents);
        notes.cameras(contents);
        notes
    }

    pub(crate) fn height_px(&self) -> f64 {
        self.notes.iter().map(Remark::height_px).sum()
    }

    pub(crate) fn draw(&self, drawing: &mut Drawing, corner: DVec2) {
        let mut top = corner.y;
        for note in &self.notes {
            note.draw(drawing, DVec2::new(corner.x, top + note.first_px() - 6.0));
            top += note.height_px();
        }
    }

    fn table(&mut self, heading: &[&str], rows: Vec<Remark>) {
        if rows.is_empty() {
            return;
        }
        let cells = heading.iter().map(|&cell| cell.to_owned()).collect();
        let heading = Remark { is_heading: true, ..Remark::plain(cells).coloured(GREY) };
        let rest = rows.len().saturating_sub(MAX_LINES);
        let mut table: Vec<Remark> =
            std::iter::once(heading).chain(rows.into_iter().take(MAX_LINES)).collect();
        lay_out(&mut table, self.width_px);
        self.notes.extend(table);
        if rest > 0 {
            self.notes.push(Remark::plain(vec![format!("and {rest} more")]));
        }
    }

    fn marks(&mut self, contents: &Contents<'_>) {
        let mut texts: BTreeMap<u32, &str> = BTreeMap::new();
        for mark in contents.picture.marks {
            texts.entry(mark.number).or_insert(&mark.text);
        }
        let rest = texts.len().saturating_sub(MAX_LINES);
        for (number, text) in texts.into_iter().take(MAX_LINES) {
            let lines = wrapped(text, ink::NOTE_PX, self.width_px - 32.0, MAX_REMARK_LINES);
            for (line, text) in lines.into_iter().enumerate() {
                let balloon = (line == 0).then_some(number);
                let remark = Remark::plain(vec![text]).coloured(ink::FAULT);
                self.notes.push(Remark { balloon, ..remark });
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
            let extent = format!("{columns} \u{d7} {rows} on {u} m \u{d7} {v} m");
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
        Self { cells, columns: Vec::new(), colour: INK, is_heading: false, balloon: None }
    }

    fn coloured(self, colour: Colour) -> Self {
        Self { colour, ..self }
    }

    /// From its top to below its first line.
    fn first_px(&self) -> f64 {
        LINE_PX + if self.is_heading { ABOVE_PX } else { 0.0 }
    }

    fn height_px(&self) -> f64 {
        let lines = self.columns.iter().map(|column| column.lines.len()).max().unwrap_or(1);
        self.first_px() + LINE_PX * lines.saturating_sub(1) as f64
    }

    fn draw(&self, drawing: &mut Drawing, base: DVec2) {
        let style = TextStyle::new(ink::NOTE_PX, self.colour, Anchor::Start);
        if let [text] = self.cells.as_slice()
            && self.columns.is_empty()
        {
            let is_remark = self.colour == ink::FAULT;
            if let Some(number) = self.balloon {
                balloon(drawing, base + DVec2::new(10.0, -4.5), &number.to_string());
            }
            let left = if is_remark { 32.0 } else { 0.0 };
            drawing.text([base.x + left, base.y], style, text);
            return;
        }
        for Column { left_px, lines } in &self.columns {
            for (k, line) in lines.iter().enumerate() {
                drawing.text([base.x + left_px, base.y + k as f64 * LINE_PX], style, line);
            }
        }
    }
}

/// Finds the columns of a table: at their usual places, or as wide as their cells need, or, where
/// they have not the room for that, as wide as there is room, with cells in several lines.
fn lay_out(table: &mut [Remark], most_px: f64) {
    let columns = table.iter().map(|row| row.cells.len()).max().unwrap_or(0);
    let width = |column: usize| {
        let cells = table.iter().filter_map(|row| row.cells.get(column));
        cells.map(|cell| width_px(cell, ink::NOTE_PX)).fold(0.0, f64::max)
    };
    let natural: Vec<f64> = (0..columns).map(width).collect();
    let room_px = most_px - BETWEEN_PX * columns.saturating_sub(1) as f64;
    let widths = shared_out(&natural, room_px);
    let begin = |spread: bool| {
        let mut left_px: f64 = 0.0;
        let begins = widths.iter().enumerate().map(|(column, width)| {
            let usual_px = COLUMNS_PX.get(column).copied().unwrap_or(0.0);
            let own_px = if spread { left_px.max(usual_px) } else { left_px };
            left_px = own_px + width + BETWEEN_PX;
            own_px
        });
        begins.collect::<Vec<f64>>()
    };
    let usual = begin(true);
    let fits = usual.last().zip(widths.last()).is_none_or(|(left, width)| left + width <= most_px);
    let begins = if fits { usual } else { begin(false) };
    for row in table {
        let cells = row.cells.iter().zip(begins.iter().zip(&widths));
        let column = |(cell, (left_px, width)): (&String, (&f64, &f64))| Column {
            left_px: *left_px,
            lines: wrapped(cell, ink::NOTE_PX, width + 1e-6, MAX_CELL_LINES),
        };
        row.columns = cells.map(column).collect();
    }
}

/// What each gets of a room: what it wants, but none more than a common bound.
fn shared_out(wanted: &[f64], room: f64) -> Vec<f64> {
    let mut ascending = wanted.to_vec();
    ascending.sort_unstable_by(f64::total_cmp);
    let (mut left, mut bound) = (room, f64::INFINITY);
    for (k, want) in ascending.iter().enumerate() {
        let share = left / (ascending.len() - k) as f64;
        if *want > share {
            bound = share.max(0.0);
            break;
        }
        left -= want;
    }
    wanted.iter().map(|want| want.min(bound)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_stand_side_by_side_and_lose_nothing() {
        let name = "METAL ENCLOSURE, WHITE PAINTED".to_owned();
        let row = |cells: &[&str]| Remark::plain(cells.iter().map(|it| (*it).into()).collect());
        for most_px in [250.0, 400.0, 700.0] {
            let mut table =
                vec![row(&["Luminous surfaces", "", "z"]), row(&[&name, "12 triangles", "2.6 m"])];
            lay_out(&mut table, most_px);
            let columns = &table[1].columns;
            assert_eq!(columns[0].lines.join(" "), name);
            assert_eq!(table[1].height_px(), LINE_PX * columns[0].lines.len() as f64);
            for pair in columns.windows(2) {
                let width = |line: &String| width_px(line, ink::NOTE_PX);
                let widest = pair[0].lines.iter().map(width).fold(0.0, f64::max);
                assert!(pair[0].left_px + widest + BETWEEN_PX <= pair[1].left_px + 1e-3);
            }
        }
        assert_eq!(shared_out(&[10.0, 50.0, 90.0], 90.0), [10.0, 40.0, 40.0]);
        assert_eq!(shared_out(&[10.0, 20.0], 90.0), [10.0, 20.0]);
    }
}
