//! Draws one view: the geometry, then sensors, cameras and lights, and remarks and texts on top.

use super::bounds::Outside;
use super::contents::Contents;
use super::ink;
use super::labels::{Box, Labels};
use super::model::PlanLuminaire;
use super::pieces::pieces;
use super::region;
use super::scope::Scope;
use super::symbols::{self, Ink};
use super::thin::thinned;
use super::view::{Pin, View};
use super::windows::WindowView;
use crate::drawing::Drawing;
use crate::style::{Anchor, Colour, INK, Stroke, TextStyle};
use crate::text::width_px;
use glam::{DVec2, DVec3};
use std::collections::BTreeMap;

/// Most lines of a kind in one view.
const MAX_LINES: usize = 12_000;
/// Most symbols of a kind in one view.
const MAX_SYMBOLS: usize = 2000;
/// Most texts of a kind in one view.
const MAX_TEXTS: usize = 300;
/// Sensor points shown along each edge of a grid.
const SAMPLE: u32 = 11;
/// A balloon's radius.
const BALLOON_PX: f64 = 9.5;

/// Draws view number `index`.
pub(crate) fn draw(drawing: &mut Drawing, contents: &Contents<'_>, index: usize) {
    let view = contents.layout.views[index];
    let labels = Labels::new(view.frame);
    let scope = contents.scope(index);
    let mut painter = Painter { contents, view, index, scope, labels };
    drawing.clipped(view.frame, |drawing| {
        painter.surfaces(drawing);
        painter.grids(drawing);
        painter.points(drawing);
        painter.cameras(drawing);
        painter.lights(drawing);
        painter.marks(drawing);
        painter.light_texts(drawing);
        painter.sensor_texts(drawing);
    });
}

struct Painter<'a> {
    contents: &'a Contents<'a>,
    view: View,
    index: usize,
    scope: Scope,
    labels: Labels,
}

/// What luminaires with a common label have in common.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct GroupKey {
    is_right: bool,
    /// On the sheet, in steps of a few pixels.
    place: [i64; 2],
    words: String,
}

/// Luminaires that are drawn at one place, and their common label.
struct Group {
    centre: DVec2,
    reach: DVec2,
    numbers: Vec<usize>,
    is_seen_along_aim: bool,
    is_fault: bool,
    outside: Option<Outside>,
    beyond: Option<String>,
}

impl Painter<'_> {
    fn surfaces(&mut self, drawing: &mut Drawing) {
        let (contents, projection, frame) = (self.contents, self.view.projection, self.view.frame);
        let (surfaces, plane) = (contents.picture.surfaces, contents.plane(self.index));
        let scope = self.scope;
        let on_sheet = |ends: [DVec3; 2]| ends.map(|end| projection.place(end));
        let glowing = || {
            let lights = contents.picture.area_lights.iter();
            let all = lights.flat_map(|light| light.triangles);
            all.filter_map(move |&t| surfaces.triangle(t as usize))
                .flat_map(move |corners| scope.triangles(corners))
                .map(move |corners| corners.map(|corner| projection.place(corner)))
        };
        let windows = contents.windows.seen(&WindowView { projection, frame, scope });
        windows.draw_faces(drawing, frame, None);
        let outlines = region::outlines(glowing());
        drawing.region(&outlines, ink::GLOW);
        let seen = contents.edges.iter().filter(|edge| edge.is_seen(self.index));
        let seen = seen.filter_map(|edge| plane.part_below(edge.ends_m));
        drawing.lines(&thinned(seen.map(on_sheet), frame, MAX_LINES), ink::EDGE);
        let cut = surfaces.cut(plane).map(on_sheet);
        let cut = thinned(cut, frame, MAX_LINES);
        drawing.lines(&cut, ink::CUT);
        windows.draw_lines(drawing);
        self.labels.keep_off(cut);
        let sides = outlines
            .iter()
            .flat_map(|ring| (0..ring.len()).map(move |k| [ring[k], ring[(k + 1) % ring.len()]]));
        let on_edge = glowing().filter(|[a, b, c]| (*b - *a).perp_dot(*c - *a).abs() < 1.0);
        let on_edge = on_edge.flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]);
        drawing.lines(&thinned(sides.chain(on_edge), frame, MAX_LINES), ink::GLOW_LINE);
        self.glow_directions(drawing);
    }

    /// An arrow along the mean normal of each piece of the luminous surfaces, from its middle.
    fn glow_directions(&self, drawing: &mut Drawing) {
        let surfaces = self.contents.picture.surfaces;
        let lights = self.contents.picture.area_lights.iter();
        let pieces = lights.flat_map(|light| pieces(surfaces, light.triangles));
        let seen = pieces
            .filter(|piece| piece.mean_normal.length() > 0.5 && self.scope.holds(piece.middle_m));
        for piece in seen.take(MAX_TEXTS) {
            let at = self.view.projection.place(piece.middle_m);
            let across = self.view.projection.direction(piece.mean_normal.normalize());
            symbols::arrow(drawing, at, across, ink::GLOW_LINE);
        }
    }

    fn grids(&mut self, drawing: &mut Drawing) {
        let projection = self.view.projection;
        for grid in self.contents.picture.grids.iter().take(MAX_TEXTS) {
            let corners = symbols::corners_of(grid);
            let middle_m = middle_of(&corners);
            let scope = self.scope_of(middle_m);
            let inside = |p: &DVec2| self.view.holds(*p);
            // Dashes are counted: only what the frame shows is drawn.
            let sides = (0..4).filter_map(|k| scope.segment([corners[k], corners[(k + 1) % 4]]));
            let sides = sides.map(|ends| ends.map(|end| projection.place(end)));
            for ends in thinned(sides, self.view.frame, 4) {
                drawing.lines(&[ends], ink::SENSOR_EDGE);
            }
            let sample = symbols::sample_of(grid, SAMPLE).into_iter().filter(|p| scope.holds(*p));
            for place in sample.map(|p| projection.place(p)).filter(inside) {
                drawing.disk(place.to_array(), 1.3, ink::SENSOR);
            }
            if !scope.holds(middle_m) {
                continue;
            }
            let pin = self.view.pin(middle_m);
            symbols::normal(drawing, pin.place_px, grid.normal, &projection);
            self.point_out(drawing, &pin, ink::SENSOR_LINE);
            self.labels.take(Box::around(pin.place_px, DVec2::splat(8.0)));
        }
    }

    fn points(&mut self, drawing: &mut Drawing) {
        let projection = self.view.projection;
        for named in self.contents.picture.points.iter().take(MAX_TEXTS) {
            let step = named.points.len().div_ceil(MAX_SYMBOLS / 5).max(1);
            for point in named.points.iter().step_by(step) {
                if !self.is_shown(point.position_m) {
                    continue;
                }
                let pin = self.view.pin(point.position_m);
                drawing.disk(pin.place_px.to_array(), 2.6, ink::SENSOR);
                let across = projection.direction(point.normal);
                symbols::arrow(drawing, pin.place_px, across * 0.6, ink::SENSOR_LINE);
                self.point_out(drawing, &pin, ink::SENSOR_LINE);
                self.labels.take(Box::around(pin.place_px, DVec2::splat(4.0)));
            }
        }
    }

    fn cameras(&mut self, drawing: &mut Drawing) {
        for camera in self.contents.picture.cameras.iter().take(MAX_TEXTS) {
            if !self.is_shown(camera.position_m) {
                continue;
            }
            let pin = self.view.pin(camera.position_m);
            let place = pin.place_px;
            let reach = symbols::camera(drawing, place, camera, &self.view.projection);
            self.point_out(drawing, &pin, ink::CAMERA_LINE);
            self.labels.take(reach);
        }
    }

    fn lights(&mut self, drawing: &mut Drawing) {
        let (picture, projection) = (self.contents.picture, self.view.projection);
        // Wrong ones on top.
        for is_fault in [false, true] {
            let ink = if is_fault { Ink::FAULT } else { Ink::LAMP };
            for luminaire in picture.luminaires.iter().take(MAX_SYMBOLS) {
                let at_m = luminaire.position_m;
                if self.contents.is_fault(at_m) != is_fault || !self.is_shown(at_m) {
                    continue;
                }
                let pin = self.view.pin(luminaire.position_m);
                let shown = self.shown(luminaire, &pin);
                symbols::luminaire(drawing, pin.place_px, &shown, &projection, ink);
                self.point_out(drawing, &pin, ink.line);
                self.labels.take(Box::around(pin.place_px, self.reach(&shown)));
                let tip = symbols::arrow_tip(projection.direction(luminaire.aim));
                self.labels.take(Box::between(pin.place_px, pin.place_px + tip));
            }
        }
        for &position_m in picture.point_lights_m.iter().take(MAX_SYMBOLS) {
            if !self.is_shown(position_m) {
                continue;
            }
            let ink = if self.contents.is_fault(position_m) { Ink::FAULT } else { Ink::LAMP };
            let pin = self.view.pin(position_m);
            symbols::star(drawing, pin.place_px, ink);
            self.point_out(drawing, &pin, ink.line);
            self.labels.take(Box::around(pin.place_px, DVec2::splat(11.0)));
        }
    }

    /// Whether a thing at a place is drawn: before the viewer, and also behind where it is wrong.
    fn is_shown(&self, place_m: DVec3) -> bool {
        self.scope_of(place_m).holds(place_m)
    }

    /// What is shown of a thing around a place; all of what is wrong.
    fn scope_of(&self, place_m: DVec3) -> Scope {
        let cut = self.scope.cut.filter(|_| !self.contents.is_fault(place_m));
        Scope { cut, ..self.scope }
    }

    /// A luminaire as it is drawn: small beyond the frame, and where it would hide the room.
    fn shown(&self, luminaire: &PlanLuminaire, pin: &Pin) -> PlanLuminaire {
        let most_m = self.contents.geometry.size_m().max_element();
        let is_small = pin.beyond.is_some() || luminaire.opening_m.max_element() > most_m;
        let opening_m = if is_small { DVec3::ZERO } else { luminaire.opening_m };
        PlanLuminaire { opening_m, ..luminaire.clone() }
    }

    /// An arrow toward what lies beyond the frame.
    fn point_out(&self, drawing: &mut Drawing, pin: &Pin, stroke: Stroke) {
        if let Some(beyond) = &pin.beyond {
            let tip = pin.place_px + beyond.direction * 15.0;
            symbols::pointer(drawing, pin.place_px, tip, stroke);
        }
    }

    fn outside(&self, point_m: DVec3) -> Option<Outside> {
        self.contents.geometry.outside(point_m)
    }

    fn marks(&mut self, drawing: &mut Drawing) {
        let marks = self.contents.picture.marks.iter();
        let marks = marks.filter_map(|mark| Some((mark.number, self.view.pin(mark.position_m?))));
        let marks: Vec<(u32, DVec2)> =
            marks.take(MAX_SYMBOLS).map(|(number, pin)| (number, pin.place_px)).collect();
        for &(_, place) in &marks {
            let ring: Vec<[f64; 2]> = (0..=16)
                .map(|k| {
                    let (sin, cos) = libm::sincos(std::f64::consts::TAU * f64::from(k) / 16.0);
                    (place + DVec2::new(cos, sin) * 5.0).to_array()
                })
                .collect();
            drawing.line(&ring, ink::FAULT_LINE);
            self.labels.take(Box::around(place, DVec2::splat(5.0)));
        }
        for (number, place) in marks.into_iter().take(MAX_TEXTS) {
            let text = number.to_string();
            let size =
                DVec2::new(width_px(&text, 12.0) + 9.0, 0.0).max(DVec2::splat(2.0 * BALLOON_PX));
            if let Some(at) = self.labels.beside(place, DVec2::splat(9.0), size) {
                let way = (at.centre() - place).normalize_or_zero();
                drawing.lines(&[[place + way * 5.0, at.centre()]], ink::FAULT_LINE);
                balloon(drawing, at.centre(), &text);
            }
        }
    }

    fn light_texts(&mut self, drawing: &mut Drawing) {
        let mut groups = self.groups();
        groups.sort_by_key(|group| !group.is_fault);
        for group in groups.into_iter().take(MAX_TEXTS) {
            let numbers = ranges(&group.numbers);
            if self.number_inside(drawing, &group, &numbers) {
                continue;
            }
            let (text, colour) = match (&group.outside, &group.beyond) {
                (Some(_), Some(beyond)) => (format!("{numbers}: {beyond} away"), ink::FAULT),
                (Some(outside), None) if self.index > 0 => {
                    (format!("{numbers}: {}", outside.brief_text()), ink::FAULT)
                }
                (Some(_), None) => (numbers, ink::FAULT),
                (None, _) if group.is_fault => (numbers, ink::FAULT),
                (None, _) => (numbers, ink::LAMP_LINE.colour),
            };
            self.text(drawing, group.centre, group.reach + 3.0, &text, colour);
        }
        let lights = self.contents.picture.point_lights_m.iter().take(MAX_TEXTS);
        let lights = lights.enumerate().filter(|(_, place_m)| self.is_shown(**place_m));
        for (number, &position_m) in lights.collect::<Vec<_>>() {
            let pin = self.view.pin(position_m);
            let away = pin.beyond.map_or(String::new(), |beyond| format!(": {} away", beyond.text));
            let is_fault = self.contents.is_fault(position_m);
            let colour = if is_fault { ink::FAULT } else { ink::LAMP_LINE.colour };
            let text = format!("P{}{away}", number + 1);
            self.text(drawing, pin.place_px, DVec2::splat(11.0), &text, colour);
        }
    }

    /// Writes numbers onto a symbol without an arrow that has room for them.
    fn number_inside(&self, drawing: &mut Drawing, group: &Group, numbers: &str) -> bool {
        let room = group.reach * 2.0;
        let size = DVec2::new(width_px(numbers, ink::LABEL_PX) + 4.0, 0.9 * ink::LABEL_PX);
        let fits = size.cmple(room).all() && group.is_seen_along_aim && group.beyond.is_none();
        if fits {
            let colour = if group.is_fault { ink::FAULT } else { INK };
            let style = TextStyle::new(ink::LABEL_PX, colour, Anchor::Middle);
            let base = group.centre + DVec2::Y * 0.36 * ink::LABEL_PX;
            drawing.text(base.to_array(), style, numbers);
        }
        fits
    }

    /// Luminaires that are drawn on top of each other.
    fn groups(&self) -> Vec<Group> {
        let mut groups: BTreeMap<GroupKey, Group> = BTreeMap::new();
        let luminaires = self.contents.picture.luminaires.iter().enumerate();
        for (index, luminaire) in luminaires.filter(|(_, it)| self.is_shown(it.position_m)) {
            let pin = self.view.pin(luminaire.position_m);
            let outside = self.outside(luminaire.position_m);
            let [x, y] = (pin.place_px / 4.0).to_array().map(|x| x.round() as i64);
            let words = outside.map_or(String::new(), |outside| outside.text());
            let is_fault = self.contents.is_fault(luminaire.position_m);
            let key = GroupKey { is_right: !is_fault, place: [x, y], words };
            let reach = self.reach(&self.shown(luminaire, &pin));
            let group = groups.entry(key).or_insert_with(|| Group {
                centre: pin.place_px,
                reach,
                numbers: Vec::new(),
                is_seen_along_aim: true,
                is_fault,
                outside,
                beyond: pin.beyond.map(|beyond| beyond.text),
            });
            group.reach = group.reach.max(reach);
            group.numbers.push(index + 1);
            let across = self.view.projection.direction(luminaire.aim);
            group.is_seen_along_aim &= across.length() < 0.1;
        }
        groups.into_values().collect()
    }

    fn reach(&self, luminaire: &PlanLuminaire) -> DVec2 {
        symbols::reach(&symbols::opening(luminaire, &self.view.projection))
    }

    fn sensor_texts(&mut self, drawing: &mut Drawing) {
        let picture = self.contents.picture;
        for camera in picture.cameras.iter().take(MAX_TEXTS) {
            if !self.is_shown(camera.position_m) {
                continue;
            }
            let pin = self.view.pin(camera.position_m);
            self.name(drawing, camera.name, &pin, ink::CAMERA);
        }
        for grid in picture.grids.iter().take(MAX_TEXTS) {
            if let Some(pin) = self.name_of_grid(&symbols::corners_of(grid)) {
                self.name(drawing, grid.name, &pin, ink::SENSOR);
            }
        }
        for named in picture.points.iter().take(MAX_TEXTS) {
            if let Some(first) = named.points.iter().find(|it| self.is_shown(it.position_m)) {
                let pin = self.view.pin(first.position_m);
                self.name(drawing, named.name, &pin, ink::SENSOR);
            }
        }
    }

    /// Where the name of a grid stands: at its upper left corner, of what is shown of it.
    fn name_of_grid(&self, corners: &[DVec3; 4]) -> Option<Pin> {
        let middle_m = middle_of(corners);
        let scope = self.scope_of(middle_m);
        let sides = (0..4).filter_map(|k| scope.segment([corners[k], corners[(k + 1) % 4]]));
        let ends: Vec<DVec3> = sides.flatten().collect();
        let places = ends.iter().map(|end| self.view.projection.place(*end));
        let corner = places
            .filter(|place| self.view.holds(*place))
            .min_by(|a, b| (a.x + a.y).total_cmp(&(b.x + b.y)));
        match corner {
            Some(place_px) => Some(Pin { place_px, beyond: None }),
            None => (!ends.is_empty()).then(|| self.view.pin(middle_m)),
        }
    }

    fn name(&mut self, drawing: &mut Drawing, name: &str, pin: &Pin, colour: Colour) {
        let text = match &pin.beyond {
            Some(beyond) => format!("{name}: {} away", beyond.text),
            None => name.to_owned(),
        };
        self.text(drawing, pin.place_px, DVec2::splat(6.0), &text, colour);
    }

    fn text(
        &mut self,
        drawing: &mut Drawing,
        centre: DVec2,
        reach: DVec2,
        text: &str,
        colour: Colour,
    ) {
        let text = crate::text::fitted(text, ink::LABEL_PX, 260.0);
        if let Some(place) = self.labels.text(centre, reach, ink::LABEL_PX, &text) {
            let at = place.centre() + DVec2::Y * 0.35 * ink::LABEL_PX;
            let style = TextStyle {
                halo: Some([255; 3]),
                ..TextStyle::new(ink::LABEL_PX, colour, Anchor::Middle)
            };
            drawing.text(at.to_array(), style, &text);
        }
    }
}

/// A white number on a red disk.
pub(crate) fn balloon(drawing: &mut Drawing, at: DVec2, number: &str) {
    let half = DVec2::X * (0.5 * width_px(number, 12.0) + 4.5 - BALLOON_PX).max(0.0);
    drawing.lines(&[[at - half, at + half]], Stroke::solid(ink::FAULT, 2.0 * BALLOON_PX));
    drawing.disk((at - half).to_array(), BALLOON_PX, ink::FAULT);
    drawing.disk((at + half).to_array(), BALLOON_PX, ink::FAULT);
    let style = TextStyle::new(12.0, [255; 3], Anchor::Middle);
    drawing.text([at.x, at.y + 4.3], style, number);
}

fn middle_of(corners: &[DVec3; 4]) -> DVec3 {
    corners.iter().sum::<DVec3>() * 0.25
}

/// Ascending numbers, neighbours joined: `1-4, 7`.
pub(crate) fn ranges(numbers: &[usize]) -> String {
    let runs = numbers.chunk_by(|a, b| a + 1 == *b).map(|run| match run {
        [first, .., last] if run.len() > 2 => format!("{first}\u{2013}{last}"),
        _ => run.iter().map(usize::to_string).collect::<Vec<_>>().join(", "),
    });
    runs.collect::<Vec<_>>().join(", ")
}
