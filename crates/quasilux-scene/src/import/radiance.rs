//! A Radiance scene as a project: lights, luminaires, sky and sun, points and views.

use super::names::Names;
use super::text::{Text, number, quoted, vector};
use super::{Imported, ImportedFile};
use crate::geometry::look_over_radiance;
use crate::radiance::{Findings, Ground, Lamp, Look, Outside, Scene, SkyKind, View, points, views};
use crate::{Camera, FileKind, Files, LoadError, Warning, files as reading};
use glam::DVec3;
use quasilux_sky::{CieType, Distribution, Sky, SkyLevel, SkyPoint};
use std::collections::{HashMap, HashSet};
use std::f64::consts::PI;

/// How a scene becomes a project. Files are named as the project names them.
#[derive(Clone, Copy, Debug)]
pub struct RadianceTerms<'t> {
    /// Name of the scene in messages.
    pub model: &'t str,
    /// Files of the scene, in the order in which `oconv` takes them.
    pub scene: &'t [String],
    /// Files of sensor points.
    pub points: &'t [String],
    /// Files of views.
    pub views: &'t [String],
    /// The weather file of a year.
    pub weather: Option<&'t str>,
    /// The beginning of the names of all other files.
    pub stem: &'t str,
}

/// Pixels along the longer edge of a picture.
const LONGER_EDGE: f64 = 800.0;

/// A project of a scene, whose files are reached by `files`.
///
/// # Errors
/// When a file is no part of a scene, or one that there can be no project of.
pub fn import_radiance(
    files: &dyn Files,
    terms: &RadianceTerms<'_>,
) -> Result<Imported, LoadError> {
    let names: Vec<&str> = terms.scene.iter().map(String::as_str).collect();
    // Told when the project is loaded.
    let mut of_geometry = Findings::default();
    let scene = Scene::read(files, &names, &HashSet::new(), &mut of_geometry)?;
    let mut writer = Writer {
        terms,
        text: Text::default(),
        names: Names::default(),
        file_names: Names::default(),
        files: Vec::new(),
        findings: Findings::default(),
    };
    writer.head(&scene);
    let lamps = writer.luminaires(&scene.lamps) + writer.lights(&scene);
    writer.outside(&scene.outside, lamps > 0);
    let mut measures = false;
    for file in terms.points {
        writer.points(file, &read(files, file)?)?;
        measures = true;
    }
    for file in terms.views {
        measures |= writer.views(file, &read(files, file)?)?;
    }
    let Writer { text, files, findings, .. } = writer;
    let mut findings: Vec<Warning> = findings.into_warnings(terms.model).collect();
    if !measures {
        let note = "no points and no view that can be taken: give --points or --view, or add \
                    [[sensors]] or [[cameras]] to the project";
        findings.push(Warning::new(terms.model, None, note));
        findings.extend(look_over_radiance(terms.model, scene, &mut of_geometry)?);
        findings.extend(of_geometry.into_warnings(terms.model));
    }
    Ok(Imported { text: text.0, files, findings, measures })
}

fn read(files: &dyn Files, name: &str) -> Result<Vec<u8>, LoadError> {
    reading::read(files, name, FileKind::Radiance).map_err(|error| {
        let reason = reading::reason(&error);
        LoadError::new(name, None, format!("cannot be read: {reason}; expected a readable file"))
    })
}

struct Writer<'w> {
    terms: &'w RadianceTerms<'w>,
    text: Text,
    /// Of sensors and cameras.
    names: Names,
    file_names: Names,
    files: Vec<ImportedFile>,
    findings: Findings,
}

impl Writer<'_> {
    fn head(&mut self, scene: &Scene) {
        let count = scene.surfaces.len();
        self.text.line(&format!("# A Radiance scene of {count} surfaces."));
        self.text.line("[scene]");
        let names: Vec<String> = self.terms.scene.iter().map(|name| quoted(name)).collect();
        self.text.key("geometry", &format!("[{}]", names.join(", ")));
    }

    /// Luminaires, and a file for each distribution; their number.
    fn luminaires(&mut self, lamps: &[Lamp]) -> usize {
        let mut known: HashMap<&str, String> = HashMap::new();
        for lamp in lamps {
            let file = match known.get(&*lamp.ies) {
                Some(file) => file.clone(),
                None => {
                    let wanted = format!("{}-{}", self.terms.stem, lamp.name);
                    let name = format!("{}.ies", self.file_names.new_name(&wanted, &[".ies"]));
                    let bytes = lamp.ies.as_bytes().to_vec();
                    self.files.push(ImportedFile { name: name.clone(), bytes });
                    known.insert(&lamp.ies, name.clone());
                    name
                }
            };
            self.text.section("[[luminaires]]");
            self.text.key("photometry", &quoted(&file));
            self.text.key("position", &vector(lamp.position));
            self.text.key("aim", &vector(lamp.aim));
            self.text.key("c0", &vector(lamp.c0));
            if lamp.is_area {
                self.text.key("as", &quoted("area"));
            }
        }
        lamps.len()
    }

    /// Materials that shine as area lights; their number.
    fn lights(&mut self, scene: &Scene) -> usize {
        let mut count = 0;
        for (index, (name, look)) in scene.materials.iter().enumerate() {
            let is_used = || scene.surfaces.iter().any(|surface| surface.material == index);
            let Look::Light(luminance_cd_m2) = look else { continue };
            if !is_used() {
                continue;
            }
            self.text.section("[[lights]]");
            self.text.key("kind", &quoted("area"));
            self.text.key("material", &quoted(name));
            self.text.key("luminance_cd_m2", &number(*luminance_cd_m2));
            count += 1;
        }
        count
    }

    fn outside(&mut self, outside: &Outside, has_lamps: bool) {
        if let Some(weather) = self.terms.weather {
            if outside.sky.is_some() || outside.sun.is_some() {
                let note = "its sky and sun are left out: those of the weather file shine";
                self.findings.note("the scene", note);
            }
            self.sky_model("weather");
            self.text.section("[weather]");
            self.text.key("file", &quoted(weather));
        } else if outside.sky.is_some() || outside.sun.is_some() {
            self.sky(outside);
        } else if !has_lamps {
            self.sky_model("cie");
            self.text.key("type", "16");
            self.text.key("horizontal_illuminance_lx", "10000");
        }
    }

    fn sky_model(&mut self, model: &str) {
        self.text.section("[sky]");
        self.text.key("model", &quoted(model));
    }

    fn sky(&mut self, outside: &Outside) {
        match outside.sky {
            Some(SkyKind::Uniform { luminance_cd_m2 }) => {
                self.sky_model("uniform");
                self.text.key("zenith_luminance_cd_m2", &number(luminance_cd_m2));
            }
            Some(SkyKind::Cie { number: cie, zenith_cd_m2 }) => {
                self.sky_model("cie");
                self.text.key("type", &cie.to_string());
                self.text.key("zenith_luminance_cd_m2", &number(zenith_cd_m2));
            }
            Some(SkyKind::Perez { direct_normal_w_m2, diffuse_horizontal_w_m2, .. }) => {
                self.sky_model("perez");
                self.text.key("direct_normal_w_m2", &number(direct_normal_w_m2));
                self.text.key("diffuse_horizontal_w_m2", &number(diffuse_horizontal_w_m2));
            }
            None => {
                self.sky_model("uniform");
                self.text.key("horizontal_illuminance_lx", "0");
            }
        }
        let is_direct = matches!(outside.sky, Some(SkyKind::Perez { has_sun: true, .. }));
        let is_perez = matches!(outside.sky, Some(SkyKind::Perez { .. }));
        if let Some(direction) = outside.sun.map(|sun| sun.direction).or(outside.sky_sun) {
            self.text.section("[sun]");
            let SkyPoint { altitude_deg, azimuth_deg } = sky_point(direction);
            self.text.key("altitude_deg", &number(altitude_deg));
            self.text.key("azimuth_deg", &number(azimuth_deg));
            match outside.sun.filter(|_| !is_perez) {
                Some(sun) => {
                    self.text.key("direct", "true");
                    self.text.key("normal_illuminance_lx", &number(sun.normal_illuminance_lx));
                }
                None if is_direct => self.text.key("direct", "true"),
                None => {}
            }
        }
        self.ground(outside);
    }

    /// The reflectance that gives the ground its luminance under this sky.
    fn ground(&mut self, outside: &Outside) {
        let mut reflectance = match outside.ground {
            None => 0.0,
            Some(Ground::Reflectance(reflectance)) => reflectance,
            Some(Ground::Luminance(luminance)) => {
                let illuminance_lx = horizontal_illuminance_lx(outside);
                if illuminance_lx > 0.0 { PI * luminance / illuminance_lx } else { 0.0 }
            }
        };
        if reflectance > 1.0 + 1e-3 {
            let note = "its ground is brighter than a white one under this sky, and white here";
            self.findings.note("the scene", note);
        }
        reflectance = reflectance.clamp(0.0, 1.0);
        self.text.section("[ground]");
        self.text.key("reflectance", &number((reflectance * 1e6).round() / 1e6));
    }

    fn points(&mut self, file: &str, bytes: &[u8]) -> Result<(), LoadError> {
        let points = points(file, bytes)?;
        let name = self.names.new_name(stem(file), &[""]);
        self.text.section("[[sensors]]");
        self.text.key("name", &quoted(&name));
        self.text.key("kind", &quoted("points"));
        self.text.list("points", points.iter().map(|point| vector(point.position)));
        self.text.list("normals", points.iter().map(|point| vector(point.direction)));
        Ok(())
    }

    /// Whether there is a view that a picture can be taken of.
    fn views(&mut self, file: &str, bytes: &[u8]) -> Result<bool, LoadError> {
        let mut has_one = false;
        for line in views(file, bytes)? {
            let place = format!("{file}:{}", line.line);
            if let Some(note) = line.note {
                self.findings.note(&place, note);
            }
            match line.view {
                Err(note) => self.findings.note(&place, note),
                Ok(view) => {
                    self.view(&view, stem(file));
                    has_one = true;
                }
            }
        }
        Ok(has_one)
    }

    fn view(&mut self, view: &View, wanted: &str) {
        let name = self.names.new_name(wanted, &["", Camera::FALSE_COLOUR_ENDING]);
        let half_tangent = |degrees: f64| libm::tan(0.5 * degrees.to_radians());
        let [width, height] = [view.horizontal_deg, view.vertical_deg].map(half_tangent);
        let pixels = |edge: f64| number((LONGER_EDGE * edge / width.max(height)).round().max(1.0));
        self.text.section("[[cameras]]");
        self.text.key("name", &quoted(&name));
        self.text.key("position", &vector(view.position));
        self.text.key("target", &vector(view.position + view.direction));
        self.text.key("up", &vector(view.up));
        self.text.key("vertical_fov_deg", &number(view.vertical_deg));
        self.text.key("resolution", &format!("[{}, {}]", pixels(width), pixels(height)));
    }
}

/// The name of a file without folder and ending.
fn stem(file: &str) -> &str {
    let name = file.rsplit(['/', '\\']).next().unwrap_or(file);
    name.rsplit_once('.').map_or(name, |(stem, _)| stem)
}

/// Altitude, and azimuth from north over east, where north is +y; without the last digits.
fn sky_point(direction: DVec3) -> SkyPoint {
    let DVec3 { x, y, z } = direction;
    let rounded = |angle_rad: f64| (angle_rad.to_degrees() * 1e9).round() / 1e9;
    let altitude_deg = rounded(libm::atan2(z, (x * x + y * y).sqrt()));
    let azimuth_deg = rounded(libm::atan2(x, y)).rem_euclid(360.0);
    SkyPoint { altitude_deg, azimuth_deg }
}

/// Illuminance of a free horizontal plane by sky and sun.
fn horizontal_illuminance_lx(outside: &Outside) -> f64 {
    let sun = outside.sun.map_or(0.0, |sun| sun.normal_illuminance_lx * sun.direction.z);
    let sky = match outside.sky {
        Some(SkyKind::Uniform { luminance_cd_m2 }) => PI * luminance_cd_m2,
        Some(SkyKind::Cie { number, zenith_cd_m2 }) => {
            let zenith = SkyPoint { altitude_deg: 90.0, azimuth_deg: 0.0 };
            let point = outside.sky_sun.map_or(zenith, sky_point);
            let level = SkyLevel::ZenithLuminance { cd_m2: zenith_cd_m2 };
            let cie = CieType::new(i64::from(number)).ok();
            let sky = cie.and_then(|cie| Sky::new(Distribution::cie(cie, point), level).ok());
            sky.map_or(0.0, |sky| sky.horizontal_illuminance_lx())
        }
        _ => 0.0,
    };
    sun + sky
}
