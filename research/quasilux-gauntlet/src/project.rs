//! A room as a project of quasilux: a project file, its geometry and its photometry, in memory.

use crate::room::{Room, SensorPlace, Shine, SkyKind, Surface};
use glam::DVec3;
use quasilux_scene::{FileKind, Files, LoadError, Loaded, load};
use std::fmt::Write;
use std::io;

/// The files of a project, by name.
pub struct ProjectFiles {
    /// The project file.
    pub project: String,
    /// The others: their names and what is in them.
    pub others: Vec<NamedFile>,
}

/// A file in memory.
pub struct NamedFile {
    /// Its name, as the project file has it.
    pub name: String,
    /// What is in it.
    pub text: String,
}

/// Where a scene has what a place of the room asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Slot {
    /// The number of the sensor.
    pub sensor: usize,
    /// The number of its point or cell.
    pub point: usize,
}

/// What the project file is called in messages.
const NAME: &str = "room.toml";

impl Room {
    /// The project of the room: sensor points in one sensor, each cell a sensor of its own.
    #[must_use]
    pub fn project(&self) -> ProjectFiles {
        let mut project = "[scene]\ngeometry = [\"room.obj\"]\nup = \"z\"\n".to_owned();
        let mut geometry = String::new();
        self.write_faces(&mut project, &mut geometry);
        let mut others = vec![NamedFile { name: "room.obj".to_owned(), text: geometry }];
        self.write_lamps(&mut project, &mut others);
        self.write_outside(&mut project);
        self.write_places(&mut project);
        ProjectFiles { project, others }
    }

    /// The room as quasilux loads it.
    ///
    /// # Errors
    /// When the project is refused.
    pub fn load(&self) -> Result<Loaded, LoadError> {
        let files = self.project();
        load(NAME, files.project.as_bytes(), &files)
    }

    /// Where the scene has each place of the room.
    #[must_use]
    pub fn slots(&self) -> Vec<Slot> {
        let points = self.places.iter().filter(|place| place.cell.is_none()).count();
        let (mut next_point, mut next_sensor) = (0, usize::from(points > 0));
        let mut slot = |place: &SensorPlace| {
            let next = if place.cell.is_some() { &mut next_sensor } else { &mut next_point };
            let number = *next;
            *next += 1;
            match place.cell {
                Some(_) => Slot { sensor: number, point: 0 },
                None => Slot { sensor: 0, point: number },
            }
        };
        self.places.iter().map(&mut slot).collect()
    }

    fn write_faces(&self, project: &mut String, geometry: &mut String) {
        let mut known: Vec<Surface> = Vec::new();
        let mut vertices = 0;
        for (number, face) in self.faces.iter().enumerate() {
            let name = if face.luminance_cd_m2 > 0.0 {
                let name = format!("shining{number}");
                put(project, format_args!("\n[materials.{name}]\n{}", keys(face.surface)));
                put(project, format_args!("[[lights]]\nkind = \"area\"\nmaterial = \"{name}\"\n"));
                put(project, format_args!("luminance_cd_m2 = {:?}\n", face.luminance_cd_m2));
                name
            } else {
                let seen = known.iter().position(|surface| *surface == face.surface);
                let number = seen.unwrap_or(known.len());
                let name = format!("surface{number}");
                if seen.is_none() {
                    known.push(face.surface);
                    put(project, format_args!("\n[materials.{name}]\n{}", keys(face.surface)));
                }
                name
            };
            put(geometry, format_args!("usemtl {name}\n"));
            for DVec3 { x, y, z } in &face.corners {
                put(geometry, format_args!("v {x:?} {y:?} {z:?}\n"));
            }
            let numbers = (1..=face.corners.len()).map(|corner| (vertices + corner).to_string());
            let numbers: Vec<String> = numbers.collect();
            put(geometry, format_args!("f {}\n", numbers.join(" ")));
            vertices += face.corners.len();
        }
    }

    fn write_lamps(&self, project: &mut String, others: &mut Vec<NamedFile>) {
        for (number, lamp) in self.lamps.iter().enumerate() {
            let position = vector(lamp.position);
            match &lamp.shine {
                Shine::Everywhere(intensity_cd) => put(
                    project,
                    format_args!(
                        "\n[[lights]]\nkind = \"point\"\nposition = {position}\n\
                         intensity_cd = {intensity_cd:?}\n"
                    ),
                ),
                Shine::Table { aim, rows } => {
                    let c0 = if aim.x.abs() < 0.8 { DVec3::X } else { DVec3::Y };
                    let name = format!("lamp{number}.ies");
                    put(
                        project,
                        format_args!(
                            "\n[[luminaires]]\nphotometry = \"{name}\"\nposition = {position}\n\
                             aim = {}\nc0 = {}\n",
                            vector(*aim),
                            vector(c0)
                        ),
                    );
                    others.push(NamedFile { name, text: photometry(rows) });
                }
            }
        }
    }

    fn write_outside(&self, project: &mut String) {
        let Some(outside) = &self.outside else { return };
        let model = match outside.sky {
            SkyKind::Uniform => "model = \"uniform\"",
            SkyKind::Overcast => "model = \"cie\"\ntype = 1",
        };
        put(
            project,
            format_args!(
                "\n[sky]\n{model}\nzenith_luminance_cd_m2 = {:?}\n\n[ground]\nreflectance = {:?}\n",
                outside.zenith_cd_m2, outside.ground_reflectance
            ),
        );
        if let Some(sun) = &outside.sun {
            put(
                project,
                format_args!(
                    "\n[sun]\naltitude_deg = {:?}\nazimuth_deg = {:?}\ndirect = true\n\
                     normal_illuminance_lx = {:?}\n",
                    sun.altitude_deg, sun.azimuth_deg, sun.normal_illuminance_lx
                ),
            );
        }
        for opening in &self.openings {
            let [origin, u, v] = [opening.corner, opening.u, opening.v].map(vector);
            put(project, format_args!("\n[[openings]]\norigin = {origin}\nu = {u}\nv = {v}\n"));
        }
    }

    fn write_places(&self, project: &mut String) {
        let points = || self.places.iter().filter(|place| place.cell.is_none());
        if points().next().is_some() {
            let list = |of: fn(&SensorPlace) -> DVec3| {
                let all: Vec<String> = points().map(|place| vector(of(place))).collect();
                all.join(", ")
            };
            put(
                project,
                format_args!(
                    "\n[[sensors]]\nname = \"points\"\nkind = \"points\"\npoints = [{}]\n\
                     normals = [{}]\n",
                    list(|place| place.position),
                    list(|place| place.normal)
                ),
            );
        }
        for (number, place) in self.places.iter().enumerate() {
            let Some([u, v]) = place.cell else { continue };
            let [origin, u, v, normal] = [place.position, u, v, place.normal].map(vector);
            put(
                project,
                format_args!(
                    "\n[[sensors]]\nname = \"cell{number}\"\nkind = \"grid\"\norigin = {origin}\n\
                     u = {u}\nv = {v}\ncounts = [1, 1]\nnormal = {normal}\nquantity = \"mean\"\n"
                ),
            );
        }
    }
}

impl Files for ProjectFiles {
    fn read(&self, path: &str, _kind: FileKind) -> io::Result<Vec<u8>> {
        let file = self.others.iter().find(|file| file.name == path);
        file.map(|file| file.text.clone().into_bytes())
            .ok_or_else(|| io::ErrorKind::NotFound.into())
    }
}

/// The keys of a material.
fn keys(surface: Surface) -> String {
    match surface {
        Surface::Grey(reflectance) => format!("reflectance = {reflectance:?}\n"),
        Surface::Mirror(reflectance) => {
            format!("kind = \"mirror\"\nreflectance = {reflectance:?}\n")
        }
        Surface::Glass(eta) => format!("kind = \"dielectric\"\neta = {eta:?}\n"),
        Surface::Pane(eta) => format!("kind = \"pane\"\neta = {eta:?}\n"),
        Surface::Translucent { reflectance, transmittance } => {
            format!("reflectance = {reflectance:?}\ntransmittance = {transmittance:?}\n")
        }
        Surface::Metal { reflectance, roughness } => format!(
            "kind = \"conductor\"\nreflectance = {reflectance:?}\nroughness = {roughness:?}\n"
        ),
    }
}

/// One half-plane, which stands for all.
fn photometry(rows: &[[f64; 2]]) -> String {
    let joined = |k: usize| {
        let column: Vec<String> = rows.iter().map(|row| row[k].to_string()).collect();
        column.join("\n")
    };
    format!(
        "IESNA:LM-63-2002\n[TEST] Lamp of the gauntlet\nTILT=NONE\n\
         1 -1 1 {} 1 1 2 0 0 0\n1 1 0\n{}\n0\n{}\n",
        rows.len(),
        joined(0),
        joined(1),
    )
}

fn vector(DVec3 { x, y, z }: DVec3) -> String {
    format!("[{x:?}, {y:?}, {z:?}]")
}

fn put(text: &mut String, what: std::fmt::Arguments<'_>) {
    text.write_fmt(what).expect("strings grow");
}
