//! Cases 5.9 to 5.14 of the standard: skies through roof and facade openings, open and glazed,
//! under overhangs and behind outside walls.
//!
//! The room is black, so that a place gets what it sees of the sky and the ground through the
//! opening, in % of the horizontal illuminance outside. The sun stands at 60 degrees and does not
//! shine. Overhangs and outside walls are black and wider than any view from the room; the ground
//! is black in these cases, which leaves the sky component.

use super::factors::{Point, minus};
use super::geometry::{Quad, ROOM_M, file};
use super::project::{Case, Expectation, Material, Project, Sensor, Tolerance};
use super::sky::{self, SKIES, View};
use crate::generated::File;
use std::fmt::Write;

/// A hole in the room, and what it is called in file names.
struct Opening {
    label: &'static str,
    /// Numbers of the cases without and with glass.
    numbers: [&'static str; 2],
    low: Point,
    high: Point,
}

const OPENINGS: [Opening; 4] = [
    Opening {
        label: "roof_1",
        numbers: ["5_9", "5_10"],
        low: [1.5, 1.5, 3.0],
        high: [2.5, 2.5, 3.0],
    },
    Opening {
        label: "roof_4",
        numbers: ["5_9", "5_10"],
        low: [0.0, 0.0, 3.0],
        high: [4.0, 4.0, 3.0],
    },
    Opening {
        label: "facade_2",
        numbers: ["5_11", "5_12"],
        low: [1.0, 0.0, 1.0],
        high: [3.0, 0.0, 2.0],
    },
    Opening {
        label: "facade_4",
        numbers: ["5_11", "5_12"],
        low: [0.0, 0.0, 0.0],
        high: [4.0, 0.0, 3.0],
    },
];

/// What stands outside.
#[derive(Clone, Copy)]
enum Shade {
    /// An overhang at the height of the roof, so deep.
    Overhang(f64),
    /// A wall 6 m before the facade, so high.
    Wall(f64),
}

const SHADES: [Shade; 6] = [
    Shade::Overhang(0.5),
    Shade::Overhang(1.0),
    Shade::Overhang(2.0),
    Shade::Wall(3.0),
    Shade::Wall(6.0),
    Shade::Wall(9.0),
];

/// How far the outside wall stands from the facade.
const WALL_M: f64 = 6.0;
/// How far overhangs and walls reach to either side of the room's middle.
const WIDE_M: f64 = 60.0;
/// Of the ground in cases 5.9 to 5.12.
const GROUND: f64 = 0.3;
/// Degrees between two nodes of the table of the glass.
const GLASS_STEP_DEG: usize = 2;

/// One case: a sky behind an opening.
struct Setting {
    opening: &'static Opening,
    is_glazed: bool,
    shade: Option<Shade>,
    /// Type of the sky.
    sky: usize,
}

impl Opening {
    fn is_roof(&self) -> bool {
        self.low[2] == self.high[2]
    }
}

impl Shade {
    fn label(self) -> String {
        match self {
            Self::Overhang(depth_m) => format!("5_13_{:02}", (10.0 * depth_m).round()),
            Self::Wall(height_m) => format!("5_14_{height_m}"),
        }
    }

    /// Its corners.
    fn corners(self) -> [Point; 4] {
        let [left, right] = [0.5 * ROOM_M[0] - WIDE_M, 0.5 * ROOM_M[0] + WIDE_M];
        match self {
            Self::Overhang(d) => {
                let z = ROOM_M[2];
                [[left, -d, z], [right, -d, z], [right, 0.0, z], [left, 0.0, z]]
            }
            Self::Wall(h) => {
                let y = -WALL_M;
                [[left, y, 0.0], [right, y, 0.0], [right, y, h], [left, y, h]]
            }
        }
    }

    /// Heights in the facade between which a place sees past it.
    fn open_between(self, [_, y, z]: Point) -> [f64; 2] {
        let edge = |height_m: f64, away_m: f64| z + (height_m - z) * y / (y + away_m);
        match self {
            Self::Overhang(depth_m) => [f64::NEG_INFINITY, edge(ROOM_M[2], depth_m)],
            Self::Wall(height_m) => [edge(height_m, WALL_M), f64::INFINITY],
        }
    }
}

/// All settings.
fn settings() -> impl Iterator<Item = Setting> {
    let glass = OPENINGS.iter().flat_map(|opening| [false, true].map(|glass| (opening, glass)));
    let open = glass.map(|(opening, is_glazed)| (opening, is_glazed, None));
    let shaded = SHADES.map(|shade| (&OPENINGS[2], false, Some(shade)));
    let all = open.chain(shaded);
    all.flat_map(|(opening, is_glazed, shade)| {
        (1..=SKIES).map(move |sky| Setting { opening, is_glazed, shade, sky })
    })
}

/// Name below `validation/` and content of each file.
pub(super) fn files() -> Vec<File> {
    let mut files: Vec<File> = Vec::new();
    for opening in &OPENINGS {
        let named = |part: &str| format!("scenes/cie171_{part}{}.obj", opening.label);
        files.push((named(""), file(room_around(opening))));
        let pane = Quad { material: "glass", corners: corners(opening.low, opening.high) };
        files.push((named("glass_"), file([pane])));
    }
    for shade in SHADES {
        let quad = Quad { material: "outside", corners: shade.corners() };
        files.push((format!("scenes/cie171_{}.obj", shade.label()), file([quad])));
    }
    for setting in settings() {
        files.push((format!("scenes/{}.toml", setting.name()), setting.project().text()));
        files.push((format!("cases/{}.toml", setting.name()), setting.case().text()));
    }
    files
}

/// The faces of the room, one of them in parts around the opening.
fn room_around(opening: &Opening) -> Vec<Quad> {
    let [x, y, z] = ROOM_M;
    let black = |low, high| Quad { material: "black", corners: corners(low, high) };
    let mut quads = vec![
        black([0.0, 0.0, 0.0], [x, y, 0.0]),
        black([0.0, 0.0, 0.0], [0.0, y, z]),
        black([x, 0.0, 0.0], [x, y, z]),
        black([0.0, y, 0.0], [x, y, z]),
    ];
    // Along the second axis of the face: y of the ceiling, z of the facade.
    let (axis, whole) = if opening.is_roof() {
        quads.push(black([0.0, 0.0, 0.0], [x, 0.0, z]));
        (1, [[0.0, 0.0, z], [x, y, z]])
    } else {
        quads.push(black([0.0, 0.0, z], [x, y, z]));
        (2, [[0.0, 0.0, 0.0], [x, 0.0, z]])
    };
    let [low, high] = whole;
    let mut part = |x: [f64; 2], along: [f64; 2]| {
        if x[0] < x[1] && along[0] < along[1] {
            let (mut from, mut to) = (low, high);
            (from[0], to[0]) = (x[0], x[1]);
            (from[axis], to[axis]) = (along[0], along[1]);
            quads.push(black(from, to));
        }
    };
    let hole = [opening.low, opening.high];
    part([low[0], hole[0][0]], [low[axis], high[axis]]);
    part([hole[1][0], high[0]], [low[axis], high[axis]]);
    part([hole[0][0], hole[1][0]], [low[axis], hole[0][axis]]);
    part([hole[0][0], hole[1][0]], [hole[1][axis], high[axis]]);
    quads
}

/// Of a rectangle along two axes.
fn corners(low: Point, high: Point) -> [Point; 4] {
    let [first, second] = match [0, 1, 2].map(|axis| low[axis] == high[axis]) {
        [true, ..] => [1, 2],
        [_, true, _] => [0, 2],
        _ => [0, 1],
    };
    let (mut b, mut d) = (low, low);
    b[first] = high[first];
    d[second] = high[second];
    [low, b, high, d]
}

/// Places on a surface of the room.
struct Places {
    name: &'static str,
    places: Vec<Point>,
    normal: Point,
}

impl Setting {
    fn name(&self) -> String {
        let number = self.opening.numbers[usize::from(self.is_glazed)];
        let what = match self.shade {
            Some(shade) => shade.label(),
            None => format!("{number}_{}", self.opening.label),
        };
        format!("cie171_{what}_sky_{:02}", self.sky)
    }

    /// The azimuth of the sun: over the far side of the roof, and before the facade.
    fn sun_azimuth_deg(&self) -> u32 {
        if self.opening.is_roof() { 0 } else { 180 }
    }

    /// As the standard names them: A to F on a wall, G to N on the floor, and on the ceiling.
    fn places(&self) -> Vec<Places> {
        let [x, y, z] = [0.5 * ROOM_M[0], ROOM_M[1], ROOM_M[2]];
        let (wall_y, facing) = if self.opening.is_roof() { (0.0, 1.0) } else { (y, -1.0) };
        let wall = (0..6).map(|n| [x, wall_y, 2.75 - 0.5 * f64::from(n)]).collect();
        let along = |z: f64| (0..8).map(|n| [x, 0.25 + 0.5 * f64::from(n), z]).collect();
        let mut all = vec![
            Places { name: "wall", places: wall, normal: [0.0, facing, 0.0] },
            Places { name: "floor", places: along(0.0), normal: [0.0, 0.0, 1.0] },
        ];
        if !self.opening.is_roof() {
            all.push(Places { name: "ceiling", places: along(z), normal: [0.0, 0.0, -1.0] });
        }
        all
    }

    fn project(&self) -> Project {
        let Self { opening, is_glazed, shade, sky } = *self;
        let mut geometry = vec![format!("cie171_{}.obj", opening.label)];
        geometry.extend(is_glazed.then(|| format!("cie171_glass_{}.obj", opening.label)));
        geometry.extend(shade.map(|shade| format!("cie171_{}.obj", shade.label())));
        let mut materials = vec![Material { name: "black", reflectance: 0.0 }];
        materials.extend(shade.map(|_| Material { name: "outside", reflectance: 0.0 }));
        let ground = if shade.is_some() { 0.0 } else { GROUND };
        let mut light = String::new();
        if is_glazed {
            let nodes = (0..=90).step_by(GLASS_STEP_DEG);
            let nodes = nodes.map(|deg| format!("[{deg}, {:.6}]", sky::glass_at_deg(deg)));
            let nodes = nodes.collect::<Vec<_>>().join(", ");
            write!(light, "[materials.glass]\nkind = \"pane\"\ntransmittance = [{nodes}]\n\n")
                .expect("strings grow");
        }
        write!(
            light,
            "[sky]\nmodel = \"cie\"\ntype = {sky}\nhorizontal_illuminance_lx = 100\n\n[sun]\n\
             altitude_deg = {}\nazimuth_deg = {}\n\n[ground]\nreflectance = {ground}\n\n\
             [[openings]]\norigin = {:?}\nu = {:?}\nv = {:?}\n",
            sky::SUN_ALTITUDE_DEG,
            self.sun_azimuth_deg(),
            opening.low,
            minus(corners(opening.low, opening.high)[1], opening.low),
            minus(corners(opening.low, opening.high)[3], opening.low),
        )
        .expect("strings grow");
        let sensor = |Places { name, places, normal }| Sensor::Points { name, places, normal };
        Project {
            what: self.title(),
            geometry,
            materials,
            light,
            sensors: self.places().into_iter().map(sensor).collect(),
            tolerance: Tolerance::Points(0.005),
        }
    }

    fn title(&self) -> String {
        let glass = if self.is_glazed { " with glass" } else { "" };
        let number = self.opening.numbers[usize::from(self.is_glazed)].replace('_', ".");
        let what = match self.shade {
            Some(Shade::Overhang(depth_m)) => format!("5.13 overhang of {depth_m} m"),
            Some(Shade::Wall(height_m)) => format!("5.14 outside wall of {height_m} m"),
            None => format!("{number} opening {}{glass}", self.opening.label.replace('_', " ")),
        };
        format!("CIE 171:2006, {what}, sky type {}", self.sky)
    }

    fn case(&self) -> Case {
        let expect = self.places().into_iter().map(|Places { name, places, normal }| {
            let values = places.iter().map(|place| self.expected_lx(*place, normal)).collect();
            Expectation::of_points(name, values, "integral over what is seen through the opening")
        });
        Case {
            file: self.name(),
            name: self.title(),
            source: "own quadrature of the sky that is seen",
            project: self.name(),
            estimators: &["path"],
            expect: expect.collect(),
        }
    }

    /// The illuminance at a place, where 100 lx fall on a plane outside.
    fn expected_lx(&self, at: Point, normal: Point) -> f64 {
        let Opening { low, high, .. } = *self.opening;
        let axis = if self.opening.is_roof() { 1 } else { 2 };
        // The luminance leaps at the horizon, and to nothing at the edge of what shades.
        let open = self.shade.map_or([f64::NEG_INFINITY, f64::INFINITY], |it| it.open_between(at));
        let from = low[axis].max(open[0]);
        let to = high[axis].min(open[1]);
        let horizon = if axis == 2 { at[2].clamp(from.min(to), to) } else { from };
        let ground = if self.shade.is_some() { 0.0 } else { GROUND };
        let view = View {
            at,
            normal,
            sky: self.sky,
            sun_azimuth_deg: f64::from(self.sun_azimuth_deg()),
            ground,
            is_glazed: self.is_glazed,
        };
        let parts = [[from, horizon], [horizon, to]];
        let parts = parts.into_iter().filter(|[from, to]| from < to);
        let through = parts.map(|[from, to]| {
            let (mut first, mut last) = (low, high);
            (first[axis], last[axis]) = (from, to);
            view.through([first, last], axis)
        });
        through.sum()
    }
}
