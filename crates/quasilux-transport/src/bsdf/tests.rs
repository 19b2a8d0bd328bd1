//! What holds for all surfaces: energy, reciprocity, and that samples follow their density.

use super::{Bsdf, BsdfSample, TransportMode};
use glam::DVec3;
use quasilux_sampling::{PointSet, Randomization, Sampler, Sequence};
use quasilux_scene::bsdf::{Conductor, Dielectric, Diffuse, Mirror, Pane, Plastic, Translucent};
use quasilux_scene::{Bsdf as Material, Rgb};
use quasilux_stats::{CellCount, chi_square_test, sidak};
use std::f64::consts::{PI, TAU};

const COSINES: [f64; 7] = [0.002, 0.03, 0.15, 0.4, 0.7, 0.93, 1.0];
const ALPHAS: [f64; 5] = [0.0004, 0.01, 0.1, 0.36, 1.0];

fn diffuse(reflectance: f64) -> Material {
    Material::Diffuse(Diffuse { reflectance: Rgb::grey(reflectance) })
}

fn translucent(reflectance: f64, transmittance: f64) -> Material {
    let [reflectance, transmittance] = [reflectance, transmittance].map(Rgb::grey);
    Material::Translucent(Translucent { reflectance, transmittance })
}

fn conductor(reflectance: f64, alpha: f64) -> Material {
    Material::Conductor(Conductor { reflectance: Rgb::grey(reflectance), alpha })
}

fn plastic(reflectance: f64, alpha: f64) -> Material {
    Material::Plastic(Plastic { reflectance: Rgb::grey(reflectance), eta: 1.5, alpha })
}

/// Surfaces without deltas, of every kind.
fn spread() -> Vec<Material> {
    let rough = ALPHAS.into_iter().flat_map(|alpha| {
        [conductor(1.0, alpha), conductor(0.6, alpha), plastic(1.0, alpha), plastic(0.3, alpha)]
    });
    let smooth = [diffuse(0.7), translucent(0.3, 0.5), translucent(0.0, 1.0)];
    smooth.into_iter().chain(rough).collect()
}

/// A direction at this cosine, turned so that nothing is special about it.
fn direction(cos: f64, azimuth: f64) -> DVec3 {
    let r = ((1.0 - cos) * (1.0 + cos)).sqrt();
    let (sin, cos_azimuth) = libm::sincos(azimuth);
    DVec3::new(r * cos_azimuth, r * sin, cos)
}

fn evaluate(bsdf: &Bsdf<f64>, wo: DVec3, wi: DVec3) -> f64 {
    bsdf.evaluate(wo, wi, true, TransportMode::Radiance)
}

/// The hemisphere by the normals half-way between `wo` and the reflected direction, in logarithmic
/// steps of the tangent: fine around mirror directions, coarse elsewhere.
#[derive(Clone, Copy)]
struct Halfway {
    wo: DVec3,
    scale: f64,
    range: f64,
}

impl Halfway {
    fn new(wo: DVec3, scale: f64) -> Self {
        Self { wo, scale, range: libm::log(1.0 + 1e4 / scale) }
    }

    /// The direction at these coordinates of the unit square, and the solid angle that a unit of
    /// their area has there; `None` below the surface.
    fn direction(self, [v, turn]: [f64; 2]) -> Option<(DVec3, f64)> {
        let grown = libm::exp(self.range * v);
        let tan = self.scale * (grown - 1.0);
        let z = 1.0 / (1.0 + tan * tan).sqrt();
        let (sin, cos) = libm::sincos(TAU * turn);
        let m = DVec3::new(tan * z * cos, tan * z * sin, z);
        let across = self.wo.dot(m);
        let wi = m * (2.0 * across) - self.wo;
        let solid_of_m = tan * z * z * z * self.scale * grown * self.range * TAU;
        (across > 0.0 && wi.z > 0.0).then_some((wi, 4.0 * across * solid_of_m))
    }

    /// The coordinates of a direction above the surface.
    fn coordinates(self, wi: DVec3) -> [f64; 2] {
        let m = (self.wo + wi).normalize();
        let tan = (m.x * m.x + m.y * m.y).sqrt() / m.z;
        let turn = libm::atan2(m.y, m.x) / TAU;
        [(libm::log1p(tan / self.scale) / self.range).min(1.0), turn - turn.floor()]
    }

    /// The integral of `g` over solid angle in the cell from `low` to `high`.
    fn integrate(
        self,
        low: [f64; 2],
        high: [f64; 2],
        steps: [u32; 2],
        g: impl Fn(DVec3) -> f64,
    ) -> f64 {
        let at = |axis: usize, i: u32| {
            low[axis] + (high[axis] - low[axis]) * (f64::from(i) + 0.5) / f64::from(steps[axis])
        };
        let mut sum = 0.0;
        for i in 0..steps[0] {
            for j in 0..steps[1] {
                if let Some((wi, solid)) = self.direction([at(0, i), at(1, j)]) {
                    sum += g(wi) * solid;
                }
            }
        }
        let area = (high[0] - low[0]) * (high[1] - low[1]);
        sum * area / f64::from(steps[0] * steps[1])
    }
}

/// The width of the sharpest lobe.
fn scale_of(material: &Material) -> f64 {
    match material {
        Material::Conductor(conductor) => conductor.alpha,
        Material::Plastic(plastic) => plastic.alpha,
        _ => 1.0,
    }
}

/// All of `f cos` on both sides.
fn quadrature(material: &Material, bsdf: &Bsdf<f64>, wo: DVec3) -> f64 {
    let halfway = Halfway::new(wo, scale_of(material));
    let below = |wi: DVec3| DVec3::new(wi.x, wi.y, -wi.z);
    let both = |wi: DVec3| evaluate(bsdf, wo, wi) + evaluate(bsdf, wo, below(wi));
    halfway.integrate([0.0; 2], [1.0; 2], [400, 240], |wi| both(wi) * wi.z)
}

#[test]
fn white_surfaces_give_all_light_back() {
    let rough = ALPHAS.into_iter().flat_map(|alpha| [conductor(1.0, alpha), plastic(1.0, alpha)]);
    let smooth = [diffuse(1.0), translucent(0.25, 0.75)];
    for material in smooth.into_iter().chain(rough) {
        let bsdf = Bsdf::<f64>::new(&material);
        for cos in COSINES {
            let wo = direction(cos, 0.4);
            let (albedo, sum) =
                (bsdf.albedo(wo, true, TransportMode::Radiance), quadrature(&material, &bsdf, wo));
            let found = format!("{material:?} at {cos}: {albedo} {sum}");
            assert!((albedo - 1.0).abs() < 1e-9 && (sum - 1.0).abs() < 5e-4, "{found}");
        }
    }
    for material in [
        Material::Mirror(Mirror { reflectance: Rgb::WHITE }),
        Material::Dielectric(Dielectric { eta: 1.5 }),
        Material::Pane(Pane::Clear { eta: 1.5 }),
    ] {
        let bsdf = Bsdf::<f64>::new(&material);
        for cos in COSINES {
            for front in [true, false] {
                let wo = direction(cos, 0.4);
                assert!(
                    (bsdf.albedo(wo, front, TransportMode::Radiance) - 1.0).abs() < 1e-14,
                    "{material:?}"
                );
                let points = PointSet::new(Sequence::Sobol, Randomization::Owen, 1);
                for index in 0..64 {
                    let mut sampler = Sampler::new(&points, index);
                    let next =
                        bsdf.sample(wo, front, TransportMode::Importance, &mut sampler).unwrap();
                    assert!((next.weight - 1.0).abs() < 1e-12 && next.pdf_sr.is_none());
                }
            }
        }
    }
}

#[test]
fn albedo_is_the_integral_of_f_cos() {
    for material in spread() {
        let bsdf = Bsdf::<f64>::new(&material);
        for cos in COSINES {
            let wo = direction(cos, 2.0);
            let (albedo, sum) =
                (bsdf.albedo(wo, true, TransportMode::Radiance), quadrature(&material, &bsdf, wo));
            assert!((albedo - sum).abs() < 5e-4, "{material:?} at {cos}: {albedo} {sum}");
            assert!(albedo <= 1.0 + 1e-12, "{material:?} at {cos}: {albedo}");
        }
    }
}

#[test]
fn both_directions_are_alike() {
    let points = PointSet::new(Sequence::Sobol, Randomization::Owen, 2);
    for material in spread() {
        let bsdf = Bsdf::<f64>::new(&material);
        for index in 0..256 {
            let u = [0, 1, 2, 3].map(|dimension| points.coordinate(index, dimension));
            let (a, b) = (direction(u[0], TAU * u[1]), direction(u[2], TAU * u[3]));
            let (there, back) = (evaluate(&bsdf, a, b), evaluate(&bsdf, b, a));
            assert!((there - back).abs() <= 1e-12 * there, "{material:?}: {there} {back}");
            // Seen from below, both change sides.
            let below = |w: DVec3| DVec3::new(w.x, w.y, -w.z);
            let through = [evaluate(&bsdf, a, below(b)), evaluate(&bsdf, b, below(a))];
            assert!((through[0] - through[1]).abs() <= 1e-12, "{material:?}: {through:?}");
        }
    }
}

#[test]
fn weights_are_f_cos_over_pdf() {
    let points = PointSet::new(Sequence::Sobol, Randomization::Owen, 3);
    for material in spread() {
        let bsdf = Bsdf::<f64>::new(&material);
        for cos in COSINES {
            let wo = direction(cos, 5.0);
            for index in 0..256 {
                let mut sampler = Sampler::new(&points, index);
                let Some(BsdfSample { wi, weight, pdf_sr }) =
                    bsdf.sample(wo, true, TransportMode::Radiance, &mut sampler)
                else {
                    continue;
                };
                let (pdf, found) = (bsdf.pdf_sr(wo, wi, true), pdf_sr.unwrap());
                assert!((pdf / found - 1.0).abs() < 1e-9, "{material:?}: {pdf} {found}");
                let wanted = evaluate(&bsdf, wo, wi) * wi.z.abs() / pdf;
                assert!((weight - wanted).abs() < 1e-9 * wanted, "{material:?}: {weight} {wanted}");
                // Bounded: no direction is drawn far too seldom.
                assert!(weight < 4.0, "{material:?} at {cos}: {weight}");
            }
        }
    }
}

const CELLS: [u32; 2] = [24, 16];
/// Rings and sectors.
const CELLS_BELOW: [u32; 2] = [8, 16];

/// The probability that samples of `drawn` are as far from the density of `bsdf` as they are.
fn p_value(
    (material, bsdf): (&Material, &Bsdf<f64>),
    drawn: &Bsdf<f64>,
    wo: DVec3,
    samples: u32,
) -> f64 {
    let halfway = Halfway::new(wo, scale_of(material));
    let total = f64::from(samples);
    let mut cells = Vec::new();
    for i in 0..CELLS[0] {
        for j in 0..CELLS[1] {
            let corner = |i: u32, j: u32| {
                [(i, 0), (j, 1)].map(|(i, a): (u32, usize)| f64::from(i) / f64::from(CELLS[a]))
            };
            let density = |wi| bsdf.pdf_sr(wo, wi, true);
            let p = halfway.integrate(corner(i, j), corner(i + 1, j + 1), [24, 24], density);
            cells.push(CellCount { observed: 0, expected: p * total });
        }
    }
    // Transmitted ones are cosine-distributed about -z, or there are none: as many in all rings and
    // sectors.
    let below = bsdf.pdf_sr(wo, DVec3::NEG_Z, true) * PI;
    let above = cells.len();
    let parts = if below > 0.0 { CELLS_BELOW } else { [1, 1] };
    let part = below / f64::from(parts[0] * parts[1]);
    cells.resize(
        (parts[0] * parts[1]) as usize + above,
        CellCount { observed: 0, expected: part * total },
    );
    let left = total - cells.iter().map(|cell| cell.expected).sum::<f64>();
    cells.push(CellCount { observed: 0, expected: left.max(1e-9) });
    let points = PointSet::new(Sequence::Independent, Randomization::Owen, 4);
    for index in 0..u64::from(samples) {
        let mut sampler = Sampler::new(&points, index);
        let cell = match drawn.sample(wo, true, TransportMode::Radiance, &mut sampler) {
            None => cells.len() - 1,
            Some(BsdfSample { wi, .. }) if wi.z < 0.0 => {
                let ring = ((wi.x * wi.x + wi.y * wi.y) * f64::from(parts[0])) as u32;
                let turn = 0.5 + libm::atan2(wi.y, wi.x) / (2.0 * PI);
                let sector = (turn * f64::from(parts[1])) as u32;
                above + (ring.min(parts[0] - 1) * parts[1] + sector.min(parts[1] - 1)) as usize
            }
            Some(next) => {
                let [v, turn] = halfway.coordinates(next.wi);
                let row = ((v * f64::from(CELLS[0])) as u32).min(CELLS[0] - 1);
                let column = ((turn * f64::from(CELLS[1])) as u32).min(CELLS[1] - 1);
                (row * CELLS[1] + column) as usize
            }
        };
        cells[cell].observed += 1;
    }
    chi_square_test(&cells)
}

/// Seed 4, 2^16 samples, significance 1 % over the whole family; see the next test for what it
/// finds.
#[test]
fn samples_follow_their_density() {
    let cosines = [0.03, 0.4, 0.93];
    let materials = spread();
    let level = sidak(0.01, materials.len() * cosines.len());
    for material in materials {
        let bsdf = Bsdf::<f64>::new(&material);
        for cos in cosines {
            let p = p_value((&material, &bsdf), &bsdf, direction(cos, 1.0), 1 << 16);
            assert!(p > level, "{material:?} at {cos}: {p:e}");
        }
    }
}

/// The test above rejects lobes that are 10 % too wide, and with 2^20 samples 2 % too wide.
#[test]
fn wrong_densities_are_found() {
    for (factor, samples) in [(1.1, 1 << 16), (1.02, 1 << 20)] {
        let material = conductor(1.0, 0.1);
        let bsdf = Bsdf::<f64>::new(&material);
        let wide = Bsdf::<f64>::new(&conductor(1.0, 0.1 * factor));
        let p = p_value((&material, &bsdf), &wide, direction(0.4, 1.0), samples);
        assert!(p < 1e-6, "{factor}: {p:e}");
    }
}
