//! Rooms at random in their own frame, turned and moved into the world: furniture, screens, lamps,
//! a workplane, and in some a window with its opening, a deep reveal and a house across the street.

use crate::room::{Case, Face, LAMP, body, plate, shell};
use glam::{DMat3, DVec3};
use quasilux_stats::SplitMix64;
use std::fmt::Write;

const SKY: &str = "[sky]\nmodel = \"cie\"\ntype = 1\nhorizontal_illuminance_lx = 10000\n";

pub(crate) fn v(x: f64, y: f64, z: f64) -> DVec3 {
    DVec3::new(x, y, z)
}

/// A parallelogram of the project: a grid or an opening.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Patch {
    pub(crate) origin: DVec3,
    pub(crate) u: DVec3,
    pub(crate) v: DVec3,
}

/// A luminaire, with more of its keys.
#[derive(Clone, Debug)]
pub(crate) struct Lamp {
    pub(crate) position: DVec3,
    pub(crate) keys: String,
}

/// A window in the wall at y = 0.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Window {
    /// Left, right, bottom and top.
    pub(crate) hole: [f64; 4],
    /// From the inside of the wall to the pane.
    pub(crate) reveal_m: f64,
}

/// A room in its own frame.
#[derive(Clone, Debug)]
pub(crate) struct Furnished {
    pub(crate) size: DVec3,
    pub(crate) faces: Vec<Face>,
    /// Low and high corners of table tops, and of cabinets.
    pub(crate) tops: Vec<[DVec3; 2]>,
    pub(crate) cabinets: Vec<[DVec3; 2]>,
    pub(crate) lamps: Vec<Lamp>,
    pub(crate) grid: Patch,
    /// More of its keys.
    pub(crate) grid_keys: String,
    pub(crate) spacing_m: f64,
    pub(crate) window: Option<Window>,
    pub(crate) opening: Option<Patch>,
    /// Of a room with an opening.
    pub(crate) sky: String,
    /// More sections of the project, and keys of the scene.
    pub(crate) sections: String,
    pub(crate) scene_keys: String,
    pub(crate) lamp_file: String,
    turn: DMat3,
    pub(crate) offset: DVec3,
    /// In which unit geometry and positions are, as parts of a metre.
    pub(crate) geometry_unit: f64,
    pub(crate) position_unit: f64,
}

impl Furnished {
    /// Without a window.
    pub(crate) fn new(dice: &mut SplitMix64) -> Self {
        let size = v(dice.within(2.0, 30.0), dice.within(2.0, 15.0), dice.within(2.3, 6.0));
        let angle_deg = match dice.below(3) {
            0 => 90.0 * dice.below(4) as f64,
            _ => dice.within(0.0, 360.0),
        };
        let level = dice.within(-1.0, 4.0).floor() * 3.5;
        let margin = 0.5_f64.min(0.15 * size.x.min(size.y));
        let height = dice.within(0.74, 0.85);
        let mut room = Self {
            size,
            faces: shell(DVec3::ZERO, size),
            tops: Vec::new(),
            cabinets: Vec::new(),
            lamps: Vec::new(),
            grid: Patch {
                origin: v(margin, margin, height),
                u: DVec3::X * (size.x - 2.0 * margin),
                v: DVec3::Y * (size.y - 2.0 * margin),
            },
            grid_keys: String::new(),
            spacing_m: dice.within(0.15, 0.4),
            window: None,
            opening: None,
            sky: SKY.to_owned(),
            sections: String::new(),
            scene_keys: String::new(),
            lamp_file: LAMP.to_owned(),
            turn: DMat3::from_rotation_z(angle_deg.to_radians()),
            offset: v(dice.within(-40.0, 40.0), dice.within(-40.0, 40.0), level),
            geometry_unit: 1.0,
            position_unit: 1.0,
        };
        room.hang_lamps(dice);
        room.furnish(dice, margin);
        room
    }

    /// With a window in the wall at y = 0.
    pub(crate) fn with_window(dice: &mut SplitMix64) -> Self {
        let mut room = Self::new(dice);
        let width = dice.within(0.25, 0.6) * room.size.x;
        let left = dice.within(0.05, 0.95) * (room.size.x - width);
        let bottom = dice.within(0.1, 1.0);
        let top = bottom + dice.within(0.4, 0.9) * (room.size.z - bottom);
        let reveal_m = if dice.below(2) == 0 { 0.0 } else { dice.within(0.1, 0.5) };
        let window = Window { hole: [left, left + width, bottom, top], reveal_m };
        room.glaze(window);
        let [frame, depth] = [dice.within(0.0, 0.1), dice.within(-0.02, 0.02)];
        room.opening = Some(Patch {
            origin: v(left - frame, depth - reveal_m, bottom - frame),
            u: DVec3::X * (width + 2.0 * frame),
            v: DVec3::Z * (top - bottom + 2.0 * frame),
        });
        if dice.below(2) == 0 {
            let street = reveal_m + dice.within(4.0, 15.0);
            let [low, high] = [-dice.within(0.0, 20.0), room.size.x + dice.within(0.0, 20.0)];
            let house = body("house", v(low, -street - 9.0, 0.0), v(high, -street, 14.0));
            room.faces.extend(house);
        }
        room
    }

    /// Rows of lamps in the upper part, at least two.
    fn hang_lamps(&mut self, dice: &mut SplitMix64) {
        let columns = 2 + dice.below(3);
        let rows = 1 + dice.below(2);
        let z = self.size.z - dice.within(0.01, 0.2 * self.size.z);
        for number in 0..columns * rows {
            let across = [number % columns, number / columns].map(|n| n as f64 + 0.5);
            let x = self.size.x * across[0] / columns as f64;
            let y = self.size.y * across[1] / rows as f64;
            self.lamps.push(Lamp { position: v(x, y, z), keys: String::new() });
        }
    }

    /// Tables below the workplane, cabinets along a wall and screens.
    fn furnish(&mut self, dice: &mut SplitMix64, margin: f64) {
        for _ in 0..dice.below(5) {
            let edge = v(dice.within(0.7, 1.6), dice.within(0.6, 0.9), dice.within(0.02, 0.05));
            let room = self.size - edge;
            let top = self.grid.origin.z - dice.within(0.002, 0.05);
            let low = v(dice.within(0.1, room.x - 0.1), dice.within(0.1, room.y - 0.1), 0.0);
            let low = low.with_z(top - edge.z);
            let is_free = |other: &[DVec3; 2]| {
                (low + edge).cmplt(other[0]).any() || low.cmpgt(other[1]).any()
            };
            if self.tops.iter().all(is_free) {
                self.tops.push([low, low + edge]);
                self.faces.extend(body("table", low, low + edge));
            }
        }
        if margin > 0.4 && dice.below(2) == 0 {
            let x = dice.within(0.1, self.size.x - 1.1);
            let low = v(x, self.size.y - 0.4, 0.05);
            let high = v(x + 0.9, self.size.y - 0.02, dice.within(0.9, 2.1));
            self.cabinets.push([low, high]);
            self.faces.extend(body("cabinet", low, high));
        }
        if dice.below(3) == 0 {
            let [x, y] = [self.size.x, self.size.y].map(|edge| dice.within(0.2, 0.7) * edge);
            let [low, high] = [v(x, y, 0.4), v(x, y + 0.2 * self.size.y, 1.4)];
            let corners = vec![low, low.with_y(high.y), high, high.with_y(low.y)];
            self.faces.push(Face { object: "screen", material: "wall", corners });
        }
    }

    /// Puts a hole with a pane and its reveal in the wall at y = 0.
    fn glaze(&mut self, window: Window) {
        let DVec3 { x, z, .. } = self.size;
        let ([left, right, bottom, top], outer) = (window.hole, -window.reveal_m);
        let upright = |[x0, x1, z0, z1]: [f64; 4], y: f64, material| Face {
            object: "south",
            material,
            corners: [[x0, z0], [x0, z1], [x1, z1], [x1, z0]].map(|[x, z]| v(x, y, z)).to_vec(),
        };
        self.faces.retain(|face| face.object != "south");
        let wall = [
            [0.0, x, 0.0, bottom],
            [0.0, x, top, z],
            [0.0, left, bottom, top],
            [right, x, bottom, top],
        ];
        self.faces.extend(wall.map(|piece| upright(piece, 0.0, "wall")));
        self.faces.push(upright(window.hole, outer, "glass"));
        if window.reveal_m > 0.0 {
            self.faces.extend(wall.map(|piece| upright(piece, outer, "wall")));
            let flat = |z: f64| [v(left, outer, z), v(right, 0.0, z)];
            self.faces.push(plate("south", "wall", flat(bottom), true));
            self.faces.push(plate("south", "wall", flat(top), false));
            for side in [left, right] {
                let corner = |y: f64, z: f64| v(side, y, z);
                let corners = vec![
                    corner(outer, bottom),
                    corner(0.0, bottom),
                    corner(0.0, top),
                    corner(outer, top),
                ];
                self.faces.push(Face { object: "south", material: "wall", corners });
            }
        }
        self.window = Some(window);
    }

    /// The frame of the world.
    fn world(&self, at: DVec3) -> DVec3 {
        self.turn * at + self.offset
    }

    /// A position as the project writes it.
    pub(crate) fn at(&self, at: DVec3) -> String {
        format!("{:?}", (self.world(at) / self.position_unit).to_array())
    }

    /// The project and its files.
    pub(crate) fn case(&self) -> Case {
        let unit = self.position_unit;
        let at = |p: DVec3| self.at(p);
        let along = |p: DVec3| format!("{:?}", (self.turn * p / unit).to_array());
        let patch = |patch: &Patch| {
            let Patch { origin, u, v } = *patch;
            format!("origin = {}\nu = {}\nv = {}\n", at(origin), along(u), along(v))
        };
        let mut text = format!("[scene]\ngeometry = [\"room.obj\"]\n{}", self.scene_keys);
        for (material, reflectance) in [("floor", 0.3), ("ceiling", 0.8), ("wall", 0.6)] {
            writeln!(text, "[materials.{material}]\nreflectance = {reflectance}").unwrap();
        }
        if self.faces.iter().any(|face| face.material == "glass") {
            text += "[materials.glass]\nkind = \"pane\"\n";
        }
        for Lamp { position, keys } in &self.lamps {
            let position = at(*position);
            text += &format!(
                "[[luminaires]]\nphotometry = \"lamp.ies\"\nposition = {position}\n{keys}"
            );
        }
        text += &format!(
            "[[sensors]]\nname = \"workplane\"\nkind = \"grid\"\n{}spacing = {}\n{}",
            patch(&self.grid),
            self.spacing_m / unit,
            self.grid_keys
        );
        if let Some(opening) = &self.opening {
            text += &self.sky;
            text += &format!("[[openings]]\n{}", patch(opening));
        }
        let case = Case {
            project: text + &self.sections,
            faces: self.faces.clone(),
            lamp: self.lamp_file.clone(),
        };
        case.moved(|corner| self.world(corner) / self.geometry_unit)
    }
}
