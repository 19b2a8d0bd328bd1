//! About what lights give to a place, several at a time in single precision, to choose among them.
//!
//! Intensities come from tables that are read at once: directions are the cells of a square by the
//! octahedral map (E. Praun and H. Hoppe, "Spherical parametrization and remeshing", ACM Trans.
//! Graph. 22(3), 2003). The table of a file is made when it is first asked for. No weight needs to
//! be right: one is 0 only where the light gives nothing.

use super::selection::{Asking, DEFENSIVE_SHARE, LANES};
use glam::{DVec3, Mat3};
use quasilux_photometry::Photometry;
use quasilux_scene::Light;
use quasilux_scene::light::{Luminaire, PointLight};
use std::array;
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;
use std::sync::{Arc, OnceLock};

/// Cells along each side of the square: of about 2 degrees in the middle of a face of the
/// octahedron.
const SIDE: usize = 64;
/// Directions along each side of a cell.
const PER_CELL: usize = 2;
/// More than the rounding of cosines.
const SLACK: f32 = 1e-4;
/// The least square of a distance: weights are numbers at a light, too.
const MIN_SQUARE_M2: f32 = 1e-12;

/// Approximate positions, extents and intensities of some lights.
pub(super) struct CoarseLights<'a> {
    /// The mean intensity of all lights together, in cd: weights are relative to it, so that they
    /// are numbers in single precision, the same for lights that are all dimmed.
    mean_cd: f64,
    lights: Vec<CoarseLight>,
    tables: Vec<Table<'a>>,
}

/// A light whose intensities have a table.
struct CoarseLight {
    /// Of its centre.
    position: DVec3,
    radius_m: f32,
    luminaire_from_world: Mat3,
    /// Its mean intensity.
    mean: f32,
    /// Intensity added for what it has beside its centre, in the unit of `mean`.
    spread: f32,
    table: usize,
}

/// About the intensities of a file over their mean, or the same on all sides.
enum Table<'a> {
    Point,
    File(&'a Photometry, OnceLock<Box<[f32]>>),
}

impl<'a> CoarseLights<'a> {
    pub(super) fn points(lights: &[&'a Light]) -> Self {
        let mut all = Self::new(lights.iter().map(|light| light.flux_lm()));
        let mut table_of = BTreeMap::new();
        for light in lights {
            match light {
                Light::Point(point) => all.push_point(point),
                Light::Luminaire(luminaire) => all.push(luminaire, SLACK, &mut table_of),
                Light::Area(_) => unreachable!("area lights are not point-like"),
            }
        }
        all
    }

    /// With a share for what their shapes have beside their centres.
    pub(super) fn with_areas(luminaires: impl Iterator<Item = &'a Luminaire> + Clone) -> Self {
        let mut all = Self::new(luminaires.clone().map(Luminaire::flux_lm));
        let mut table_of = BTreeMap::new();
        for luminaire in luminaires {
            all.push(luminaire, DEFENSIVE_SHARE as f32, &mut table_of);
        }
        all
    }

    /// None yet.
    fn new(fluxes_lm: impl Iterator<Item = f64>) -> Self {
        let mean_cd = fluxes_lm.sum::<f64>() / (4.0 * PI);
        let mean_cd = if mean_cd > 0.0 { mean_cd } else { 1.0 };
        Self { mean_cd, lights: Vec::new(), tables: vec![Table::Point] }
    }

    fn push_point(&mut self, &PointLight { position, intensity_cd }: &PointLight) {
        let mean = (intensity_cd / self.mean_cd) as f32;
        self.lights.push(CoarseLight {
            position,
            radius_m: 0.0,
            luminaire_from_world: Mat3::IDENTITY,
            mean,
            spread: SLACK * mean,
            table: 0,
        });
    }

    /// Luminaires of one file share its table. `spread` is told over the mean intensity.
    fn push(
        &mut self,
        luminaire: &'a Luminaire,
        spread: f32,
        table_of: &mut BTreeMap<*const Photometry, usize>,
    ) {
        let Self { mean_cd, lights, tables } = self;
        let photometry = &*luminaire.photometry;
        let table = *table_of.entry(photometry).or_insert_with(|| {
            tables.push(Table::File(photometry, OnceLock::new()));
            tables.len() - 1
        });
        let mean = (luminaire.flux_lm() / (4.0 * PI) / *mean_cd) as f32;
        lights.push(CoarseLight {
            position: luminaire.position,
            radius_m: luminaire.shape.radius_m() as f32,
            luminaire_from_world: luminaire.world_from_luminaire.transpose().as_mat3(),
            mean,
            spread: spread * mean,
            table,
        });
    }

    /// About what up to [`LANES`] lights give to a place up to a factor, each its intensity times
    /// cosine over squared distance; 0 only from behind, with all of its shape. Where both sides
    /// count, no cosine is taken.
    pub(super) fn weights(&self, numbers: &[usize], place: Asking) -> [f64; LANES] {
        let (mut toward, mut local) = ([[0.0_f32; LANES]; 3], [[0.0_f32; LANES]; 3]);
        let mut radii_m = [1.0_f32; LANES];
        for (lane, number) in numbers.iter().enumerate() {
            let light = &self.lights[*number];
            let way = (light.position - place.position).as_vec3();
            let turned = light.luminaire_from_world * -way;
            for axis in 0..3 {
                toward[axis][lane] = way[axis];
                local[axis][lane] = turned[axis];
            }
            radii_m[lane] = light.radius_m;
        }
        let cells = cells_along(&local);
        let geometry = Geometry::new(&toward, &radii_m, place.side);
        array::from_fn(|lane| {
            let Some(&number) = numbers.get(lane) else { return 0.0 };
            let light = &self.lights[number];
            let intensity = light.mean * self.tables[light.table].at(cells[lane] as usize);
            let facing = intensity * geometry.cosines[lane] + light.spread;
            f64::from(facing * geometry.per_m2[lane])
        })
    }
}

impl Table<'_> {
    #[inline]
    fn at(&self, cell: usize) -> f32 {
        match self {
            Self::Point => 1.0,
            Self::File(photometry, cells) => cells.get_or_init(|| table(photometry))[cell],
        }
    }
}

/// Geometric factors of the light from several lights.
struct Geometry {
    /// At least 0.
    cosines: [f32; LANES],
    /// Over squared distances; 0 from behind.
    per_m2: [f32; LANES],
}

impl Geometry {
    #[inline]
    fn new([x, y, z]: &[[f32; LANES]; 3], radii_m: &[f32; LANES], side: Option<DVec3>) -> Self {
        let (mut cosines, mut per_m2) = ([1.0; LANES], [0.0; LANES]);
        let n = side.unwrap_or(DVec3::ZERO).as_vec3();
        for lane in 0..LANES {
            let (x, y, z, radius_m) = (x[lane], y[lane], z[lane], radii_m[lane]);
            let way_m2 = (x * x + y * y + z * z).max(f32::MIN_POSITIVE);
            let height_m = n.x * x + n.y * y + n.z * z;
            let distance_m = way_m2.sqrt();
            let cos = (height_m / distance_m).max(0.0);
            let square_m2 = (way_m2 + radius_m * radius_m).max(MIN_SQUARE_M2);
            let is_before = height_m + radius_m > -SLACK * (distance_m + radius_m);
            cosines[lane] = cos;
            per_m2[lane] = if is_before { 1.0 / square_m2 } else { 0.0 };
        }
        if side.is_none() {
            cosines = [1.0; LANES];
        }
        Self { cosines, per_m2 }
    }
}

/// Root mean squares of what the directions of each cell get, over the mean of all, with a share of
/// that: the variance of a choice is least where the probabilities are in proportion to them.
fn table(photometry: &Photometry) -> Box<[f32]> {
    let mean_cd = (photometry.flux_lm() / (4.0 * PI)).max(f64::MIN_POSITIVE);
    let parts = SIDE * PER_CELL;
    let place = |part: usize| 2.0 * (part as f64 + 0.5) / parts as f64 - 1.0;
    let cell = |number: usize| {
        let (row, column) = (number / SIDE, number % SIDE);
        let squares = (0..PER_CELL * PER_CELL).map(|part| {
            let [u, v] = [(column, part % PER_CELL), (row, part / PER_CELL)]
                .map(|(cell, part)| place(PER_CELL * cell + part));
            let cd = photometry.intensity_cd(direction_at(u, v));
            cd * cd
        });
        let mean_square = squares.sum::<f64>() / (PER_CELL * PER_CELL) as f64;
        (mean_square.sqrt() / mean_cd + DEFENSIVE_SHARE) as f32
    };
    (0..SIDE * SIDE).map(cell).collect()
}

/// The numbers of the cells that directions of any length lie in.
#[inline]
fn cells_along([x, y, z]: &[[f32; LANES]; 3]) -> [u32; LANES] {
    /// Added to a number below 2^22, leaves it rounded in the last digits.
    const ROUNDS: f32 = 12_582_912.0;
    const LAST: f32 = SIDE as f32 - 0.75;
    let mut cells = [0; LANES];
    for lane in 0..LANES {
        let (x, y, z) = (x[lane], y[lane], z[lane]);
        let length = (x.abs() + y.abs() + z.abs()).max(f32::MIN_POSITIVE);
        let (u, v) = (x / length, y / length);
        let below = [(1.0 - v.abs()).copysign(u), (1.0 - u.abs()).copysign(v)];
        let [u, v] = if z < 0.0 { below } else { [u, v] };
        let cell = |place: f32| {
            let steps = (0.5 * SIDE as f32) * (place + 1.0) - 0.5;
            (steps.clamp(0.0, LAST) + ROUNDS).to_bits() & (SIDE as u32 - 1)
        };
        cells[lane] = cell(v) * SIDE as u32 + cell(u);
    }
    cells
}

/// The unit direction of a place in the square from -1 to 1: the lower half of the octahedron fills
/// its corners.
fn direction_at(u: f64, v: f64) -> DVec3 {
    let z = 1.0 - u.abs() - v.abs();
    let below = ((1.0 - v.abs()).copysign(u), (1.0 - u.abs()).copysign(v));
    let (x, y) = if z < 0.0 { below } else { (u, v) };
    DVec3::new(x, y, z).normalize()
}

/// Bytes of the tables of all files that some lights have.
pub(crate) fn coarse_tables_bytes(lights: &[Light]) -> u64 {
    let photometry = |light: &Light| match light {
        Light::Luminaire(luminaire) => Some(Arc::as_ptr(&luminaire.photometry)),
        Light::Point(_) | Light::Area(_) => None,
    };
    let files: BTreeSet<*const Photometry> = lights.iter().filter_map(photometry).collect();
    // One of points, one of luminous areas.
    (2 * files.len() * SIDE * SIDE * size_of::<f32>()) as u64
}

#[cfg(test)]
mod tests {
    use super::*;
    use quasilux_sampling::warp::sample_uniform_sphere;

    fn place_of(cell: u32) -> f64 {
        2.0 * (f64::from(cell) + 0.5) / SIDE as f64 - 1.0
    }

    fn cell_along(direction: DVec3) -> u32 {
        let lanes = direction.as_vec3().to_array().map(|of_axis| [of_axis; LANES]);
        let cells = cells_along(&lanes);
        assert_eq!(cells, [cells[0]; LANES]);
        cells[0]
    }

    #[test]
    fn cells_are_found_again() {
        let side = SIDE as u32;
        for number in 0..side * side {
            let direction = direction_at(place_of(number % side), place_of(number / side));
            assert!((direction.length() - 1.0).abs() < 1e-12);
            assert_eq!(cell_along(direction * 7.0), number);
        }
        assert!([DVec3::NAN, DVec3::ZERO].iter().all(|it| cell_along(*it) < side * side));
    }

    /// Neighbours in the square are neighbours on the sphere, over the folds too.
    #[test]
    fn directions_of_a_cell_are_close() {
        for i in 0..4000 {
            let u = [f64::from(i) / 4000.0, (f64::from(i) * 0.618_034).fract()];
            let direction = DVec3::from_array(sample_uniform_sphere(u));
            let number = cell_along(direction);
            let centre =
                direction_at(place_of(number % SIDE as u32), place_of(number / SIDE as u32));
            assert!(direction.angle_between(centre) < 0.08, "{direction}: {centre}");
        }
    }

    /// Point lights around places on surfaces, near and far: weights are illuminances to the share
    /// that is added, 0 only from behind, and numbers at the light itself.
    #[test]
    fn weights_are_illuminances() {
        let number = |i: u32, by: f64| (f64::from(i) * by).fract() - 0.5;
        let light = |i: u32| {
            let position = 8.0 * DVec3::new(number(i, 0.618_034), number(i, 0.754_878), 0.2);
            Light::Point(PointLight { position, intensity_cd: f64::from(1 + i) })
        };
        let lights: Vec<Light> = (0..64).map(light).collect();
        let coarse = CoarseLights::points(&lights.iter().collect::<Vec<&Light>>());
        for i in 0..200 {
            let position = 9.0 * DVec3::new(number(i, 0.569_84), number(i, 0.324_718), 0.1);
            let n = DVec3::from_array(sample_uniform_sphere([number(i, 0.3) + 0.5, 0.1]));
            let numbers: [usize; LANES] = array::from_fn(|lane| (i as usize + 7 * lane) % 64);
            let weights = coarse.weights(&numbers, Asking { position, side: Some(n), own: None });
            for (weight, number) in weights.iter().zip(numbers) {
                let weight = &(weight * coarse.mean_cd);
                let Light::Point(point) = &lights[number] else { unreachable!() };
                let way = point.position - position;
                let lx_of_cos = |cos: f64| point.intensity_cd * cos / way.length_squared();
                let lx = lx_of_cos(n.dot(way.normalize()));
                assert!(*weight >= 0.999 * lx, "{weight} for {lx}");
                assert!(*weight <= lx.max(0.0) * 1.001 + lx_of_cos(2e-4), "{weight} for {lx}");
            }
            let Light::Point(point) = &lights[i as usize % 64] else { unreachable!() };
            let at_light = Asking { position: point.position, side: None, own: None };
            assert!(coarse.weights(&[i as usize % 64], at_light)[0].is_finite());
        }
    }
}
