//! What a hard room is: polygons, lamps, what is outside, places and where to look.

use crate::dice::{Dice, Parameter};
use glam::DVec3;

/// A room of the gauntlet, lengths in m.
#[derive(Clone, Debug, PartialEq)]
pub struct Room {
    /// Its number in the family.
    pub number: u64,
    /// The name of its family.
    pub family: &'static str,
    /// What was drawn for it.
    pub parameters: Vec<Parameter>,
    /// Surfaces.
    pub faces: Vec<Face>,
    /// Point lights.
    pub lamps: Vec<Lamp>,
    /// Sky, ground and sun.
    pub outside: Option<Outside>,
    /// Openings as a project file may name them; they change no light.
    pub openings: Vec<Parallelogram>,
    /// Sensor points and cells.
    pub places: Vec<SensorPlace>,
    /// Where light comes from that is hard to find: for a reference that is told, nothing else.
    pub hints: Vec<Lookout>,
    /// The shares of directions that such a reference sends there, at first and after bounces.
    pub hint_shares: [f64; 2],
    /// Where its walks from the lights are sent.
    pub aims: Vec<Lookout>,
    /// The share of their directions that go there.
    pub aim_share: f64,
    /// All ways in for walks from sky and sun, `u x v` outward; none where they come from around.
    pub ways_in: Vec<Parallelogram>,
    /// How the reference finds the light of faces that shine.
    pub emitters_found: FoundBy,
    /// The same of the sky and the ground.
    pub sky_found: FoundBy,
    /// The same of the sun.
    pub sun_found: FoundBy,
}

/// A flat polygon, its front where its corners run counter-clockwise.
#[derive(Clone, Debug, PartialEq)]
pub struct Face {
    /// The corners, of a convex polygon.
    pub corners: Vec<DVec3>,
    /// What it is made of, on both sides.
    pub surface: Surface,
    /// Luminance of the front in cd/m^2; 0 where it does not shine.
    pub luminance_cd_m2: f64,
}

/// What a face is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Surface {
    /// Diffuse with this reflectance.
    Grey(f64),
    /// A perfect mirror with this reflectance.
    Mirror(f64),
    /// Of a closed body of clear glass with this index of refraction, its fronts outward.
    Glass(f64),
    /// A sheet of clear glass with this index of refraction.
    Pane(f64),
    /// A sheet that scatters light to both sides.
    Translucent {
        /// Reflected over incident flux.
        reflectance: f64,
        /// Transmitted over incident flux.
        transmittance: f64,
    },
    /// Rough metal: GGX facets by Schlick.
    Metal {
        /// Reflected over incident flux of one facet at normal incidence.
        reflectance: f64,
        /// The square root of the width of the distribution of slopes.
        roughness: f64,
    },
}

/// A point light.
#[derive(Clone, Debug, PartialEq)]
pub struct Lamp {
    /// Where it is.
    pub position: DVec3,
    /// How it shines.
    pub shine: Shine,
    /// How the reference finds its light.
    pub found: FoundBy,
}

/// How a point light shines.
#[derive(Clone, Debug, PartialEq)]
pub enum Shine {
    /// This many cd in all directions.
    Everywhere(f64),
    /// The same all round an aim.
    Table {
        /// Unit direction of gamma = 0.
        aim: DVec3,
        /// Gamma in degrees, from 0 to 90, and cd; linear between.
        rows: Vec<[f64; 2]>,
    },
}

/// What shines from infinitely far away; north is along y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outside {
    /// How the luminance of the sky is distributed.
    pub sky: SkyKind,
    /// Luminance of its zenith.
    pub zenith_cd_m2: f64,
    /// Reflectance of the ground, an endless plane below everything, lit by all of the sky and sun.
    pub ground_reflectance: f64,
    /// The sun, where it shines.
    pub sun: Option<SunPlace>,
}

/// How the luminance of a sky is distributed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SkyKind {
    /// Evenly.
    Uniform,
    /// CIE 1 of ISO 15469:2004, the standard overcast sky by its formula for type 1.
    Overcast,
}

/// The sun, a disk of half a degree.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SunPlace {
    /// Degrees above the horizon.
    pub altitude_deg: f64,
    /// Degrees clockwise from north, which is along y.
    pub azimuth_deg: f64,
    /// Illuminance in lx on a plane across its rays.
    pub normal_illuminance_lx: f64,
}

/// A sensor point, or a cell whose mean is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SensorPlace {
    /// Where it is; the corner of a cell.
    pub position: DVec3,
    /// Unit normal.
    pub normal: DVec3,
    /// Edges of the cell.
    pub cell: Option<[DVec3; 2]>,
    /// Of a point, the radius of the disc that light is counted on which only photons can bring, so
    /// that its mean over the disc is what a reference has.
    pub disc_radius_m: f64,
}

/// A parallelogram with edges from a corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parallelogram {
    /// The corner.
    pub corner: DVec3,
    /// One edge.
    pub u: DVec3,
    /// The other edge.
    pub v: DVec3,
}

/// Where to look, and from where it helps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lookout {
    /// What to look at.
    pub shape: Parallelogram,
    /// The low corner of the box that it is for.
    pub low: DVec3,
    /// The high one.
    pub high: DVec3,
}

/// How the reference finds the light of a source: a closed set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FoundBy {
    /// By paths from the sensors, which miss light of point lights over mirrors and through glass.
    Paths,
    /// By walks from the lights that are joined to the sensors; what comes over mirrors or through
    /// glass to a sensor is counted on its cell or disc.
    Joins,
    /// The same, and light that comes straight to a cell is counted as well.
    BeamsAndJoins,
    /// As by walks that are joined, and through aims by paths from the sensors.
    KeyholesAndJoins,
    /// By walks that are counted on cells and discs alone.
    Photons,
}

impl FoundBy {
    /// All ways.
    pub const ALL: [Self; 5] =
        [Self::Paths, Self::Joins, Self::BeamsAndJoins, Self::KeyholesAndJoins, Self::Photons];

    /// In a few words.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Paths => "paths",
            Self::Joins => "walks joined to sensors",
            Self::BeamsAndJoins => "walks joined and counted",
            Self::KeyholesAndJoins => "walks joined, paths through keyholes",
            Self::Photons => "walks counted",
        }
    }
}

impl Room {
    /// A room with nothing in it.
    pub(super) fn empty() -> Self {
        Self {
            number: 0,
            family: "",
            parameters: Vec::new(),
            faces: Vec::new(),
            lamps: Vec::new(),
            outside: None,
            openings: Vec::new(),
            places: Vec::new(),
            hints: Vec::new(),
            hint_shares: [0.5, 0.1],
            aims: Vec::new(),
            aim_share: 0.0,
            ways_in: Vec::new(),
            emitters_found: FoundBy::Paths,
            sky_found: FoundBy::Paths,
            sun_found: FoundBy::Paths,
        }
    }

    pub(super) fn add_place(&mut self, position: DVec3, normal: DVec3) {
        self.places.push(SensorPlace { position, normal, cell: None, disc_radius_m: 0.0 });
    }

    /// Adds a square cell whose mean is asked for, around a place.
    pub(super) fn add_cell(&mut self, middle: DVec3, normal: DVec3, side_m: f64) {
        let (s, t) = normal.any_orthonormal_pair();
        let position = middle - 0.5 * side_m * (s + t);
        let cell = Some([s * side_m, t * side_m]);
        self.places.push(SensorPlace { position, normal, cell, disc_radius_m: 0.0 });
    }

    /// Adds sensor points in the air of a box, and one of three on its floor.
    pub(super) fn scatter(&mut self, dice: &mut Dice, low: DVec3, high: DVec3, count: u32) {
        for number in 0..count {
            let mut position = dice.within(low, high);
            let mut normal = dice.normal();
            if number.is_multiple_of(3) {
                (position.z, normal) = (low.z.min(0.0), DVec3::Z);
            }
            self.add_place(position, normal);
        }
    }

    pub(super) fn add_lamp(&mut self, position: DVec3, intensity_cd: f64) {
        let shine = Shine::Everywhere(intensity_cd);
        self.lamps.push(Lamp { position, shine, found: FoundBy::Paths });
    }

    /// A lamp with the intensity of a flat panel, in steps of 10 degrees.
    pub(super) fn add_downlight(&mut self, position: DVec3, intensity_cd: f64) {
        let row = |step: u32| {
            let gamma_deg = 10.0 * f64::from(step);
            let cos = if step == 9 { 0.0 } else { libm::cos(gamma_deg.to_radians()) };
            [gamma_deg, intensity_cd * cos]
        };
        let rows = (0..10).map(row).collect();
        let shine = Shine::Table { aim: DVec3::NEG_Z, rows };
        self.lamps.push(Lamp { position, shine, found: FoundBy::Paths });
    }

    /// A beam of a flux within a half angle, from which it falls to nothing within a tenth of it;
    /// the reference finds it by walks.
    pub(super) fn add_beam(&mut self, from: DVec3, to: DVec3, half_deg: f64, flux_lm: f64) {
        let sin = libm::sin(0.525 * half_deg.to_radians());
        let intensity_cd = flux_lm / (4.0 * std::f64::consts::PI * sin * sin);
        let rows =
            vec![[0.0, intensity_cd], [half_deg, intensity_cd], [1.1 * half_deg, 0.0], [90.0, 0.0]];
        let aim = (to - from).normalize();
        let shine = Shine::Table { aim, rows };
        self.lamps.push(Lamp { position: from, shine, found: FoundBy::Joins });
    }

    /// Has the reference find the light of all lamps, faces, sky and sun in one way.
    pub(super) fn find_all(&mut self, found: FoundBy) {
        self.lamps.iter_mut().for_each(|lamp| lamp.found = found);
        (self.emitters_found, self.sky_found, self.sun_found) = (found, found, found);
    }

    /// The same room with other discs about its points; `None` leaves one as it is.
    pub(crate) fn with_discs(&self, radii_m: &[Option<f64>]) -> Self {
        let mut room = self.clone();
        for (place, radius_m) in room.places.iter_mut().zip(radii_m) {
            place.disc_radius_m = radius_m.unwrap_or(place.disc_radius_m);
        }
        room
    }

    /// How the reference finds the light of this room.
    pub(crate) fn witness(&self) -> Vec<&'static str> {
        let mut ways: Vec<FoundBy> = self.lamps.iter().map(|lamp| lamp.found).collect();
        if self.faces.iter().any(|face| face.luminance_cd_m2 > 0.0) {
            ways.push(self.emitters_found);
        }
        if let Some(outside) = &self.outside {
            ways.push(self.sky_found);
            ways.extend(outside.sun.map(|_| self.sun_found));
        }
        let is_told = !self.hints.is_empty() || !self.aims.is_empty();
        let own = |way: FoundBy| ways.contains(&way).then(|| way.name());
        let told = is_told.then_some("told where to look");
        FoundBy::ALL.into_iter().filter_map(own).chain(told).collect()
    }

    /// Adds a panel with edges `u` and `v` that shines along `u x v`.
    pub(super) fn add_panel(&mut self, panel: Parallelogram, luminance_cd_m2: f64) {
        let corners = panel.corners();
        self.faces.push(Face { corners, surface: Surface::Grey(0.3), luminance_cd_m2 });
    }

    /// Adds a face that does not shine.
    pub(super) fn add_face(&mut self, face: Parallelogram, surface: Surface) {
        self.add_polygon(face.corners(), surface);
    }

    pub(super) fn add_polygon(&mut self, corners: Vec<DVec3>, surface: Surface) {
        self.faces.push(Face { corners, surface, luminance_cd_m2: 0.0 });
    }
}

impl Face {
    /// The triangles of the polygon.
    pub(crate) fn triangles(&self) -> impl Iterator<Item = [DVec3; 3]> + '_ {
        self.corners[1..].windows(2).map(|pair| [self.corners[0], pair[0], pair[1]])
    }
}

impl Parallelogram {
    pub(super) fn corners(&self) -> Vec<DVec3> {
        let Self { corner, u, v } = *self;
        vec![corner, corner + u, corner + u + v, corner + v]
    }

    /// A square of a side around a place, its front along a unit normal.
    pub(super) fn square(middle: DVec3, normal: DVec3, side_m: f64) -> Self {
        let (s, t) = normal.any_orthonormal_pair();
        let (u, v) = (s * side_m, t * side_m);
        Self { corner: middle - 0.5 * (u + v), u, v }
    }

    /// Its image in a mirror through `place` with the unit normal `n`.
    pub(super) fn image(&self, place: DVec3, n: DVec3) -> Self {
        let turned = |v: DVec3| v - n * (2.0 * v.dot(n));
        Self { corner: place + turned(self.corner - place), u: turned(self.u), v: turned(self.v) }
    }
}

impl Outside {
    /// A sky over ordinary ground.
    pub(crate) fn sky(sky: SkyKind, zenith_cd_m2: f64) -> Self {
        Self { sky, zenith_cd_m2, ground_reflectance: 0.2, sun: None }
    }
}

impl SunPlace {
    /// The unit direction to its middle.
    pub(crate) fn direction(&self) -> DVec3 {
        let (sin_altitude, cos_altitude) = libm::sincos(self.altitude_deg.to_radians());
        let (sin_azimuth, cos_azimuth) = libm::sincos(self.azimuth_deg.to_radians());
        let flat = DVec3::new(sin_azimuth, cos_azimuth, 0.0) * cos_altitude;
        (flat + DVec3::Z * sin_altitude).normalize()
    }
}
