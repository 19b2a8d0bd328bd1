//! Rough metal: facets of the distribution GGX (Walter et al. 2007) with Smith's height-correlated
//! shadowing (Heitz 2014), Schlick's reflectance (1994), and light that is reflected several times
//! (Kulla and Conty 2017).
//!
//! With `Lambda(cos) = (sqrt(1 + alpha^2 tan^2) - 1) / 2`, reflection by one facet is
//! `F D / (4 cos_o cos_i (1 + Lambda_o + Lambda_i))`. `E(cos)` is its integral over directions for
//! `F = 1`; what is missing from 1 is reflected again, in the form
//! `R (1 - E(cos_o)) (1 - E(cos_i)) / (pi (1 - E_mean))` with
//! `R = F_mean^2 E_mean / (1 - F_mean (1 - E_mean))`, `F_mean = F0 + (1 - F0) / 21`.

use crate::random::Xoshiro;
use glam::DVec3;
use std::f64::consts::{FRAC_1_PI, PI, TAU};

/// Steps of the table of `E`, at the cubes of even steps from 0 to 1.
const STEPS: usize = 160;
/// Midpoints of each of two coordinates behind a value of the table.
const MIDPOINTS: u32 = 112;
/// Least share of directions that are drawn by the cosine, whatever the facets do.
const MIN_COSINE_SHARE: f64 = 0.02;

/// One kind of rough metal.
#[derive(Clone, Debug)]
pub(crate) struct Metal {
    reflectance: f64,
    alpha: f64,
    /// `E` by step.
    single: Vec<f64>,
    single_mean: f64,
    /// `R` of the module.
    repeated: f64,
}

fn schlick(reflectance: f64, cos: f64) -> f64 {
    let left = (1.0 - cos).max(0.0);
    reflectance + (1.0 - reflectance) * left * left * left * left * left
}

impl Metal {
    pub(crate) fn new(reflectance: f64, alpha: f64) -> Self {
        let mut metal =
            Self { reflectance, alpha, single: Vec::new(), single_mean: 0.0, repeated: 0.0 };
        let cos_of = |step: usize| {
            let x = step as f64 / STEPS as f64;
            x * x * x
        };
        metal.single = (0..=STEPS).map(|step| metal.integrated(cos_of(step).max(1e-9))).collect();
        // The mean of 2 cos E, Simpson's rule in each step with the middle on the straight line.
        let value = |x: f64| 2.0 * x * x * x * metal.single(x * x * x) * 3.0 * x * x;
        let simpson = |step: usize| {
            let at = |way: f64| value((step as f64 + way) / STEPS as f64);
            (at(0.0) + 4.0 * at(0.5) + at(1.0)) / (6.0 * STEPS as f64)
        };
        metal.single_mean = (0..STEPS).map(simpson).sum();
        let mean = reflectance + (1.0 - reflectance) / 21.0;
        let escapes = metal.single_mean;
        metal.repeated = mean * mean * escapes / (1.0 - mean * (1.0 - escapes));
        metal
    }

    /// Whether it was made of these numbers.
    pub(crate) fn is(&self, reflectance: f64, alpha: f64) -> bool {
        self.reflectance == reflectance && self.alpha == alpha
    }

    /// Reflected over incident flux, never less: facets at the reflectance of their worst angle
    /// would be more; this is what roulette asks for.
    pub(crate) const fn most_kept(&self) -> f64 {
        self.reflectance
    }

    /// The scattered light from `wo` to `wi` with the cosine of `wi`, in sr^-1; both unit vectors
    /// point away from the surface of the unit normal `n`.
    pub(crate) fn value(&self, n: DVec3, wo: DVec3, wi: DVec3) -> f64 {
        let [cos_o, cos_i] = [wo.dot(n), wi.dot(n)];
        if cos_o <= 0.0 || cos_i <= 0.0 {
            return 0.0;
        }
        let half = (wo + wi).normalize();
        let shadowing = 1.0 + self.lambda(cos_o) + self.lambda(cos_i);
        let fresnel = schlick(self.reflectance, wi.dot(half));
        let once = fresnel * self.facets(half, n) / (4.0 * cos_o * shadowing);
        once + self.again(cos_o) * (1.0 - self.single(cos_i)) * cos_i * FRAC_1_PI
    }

    /// A direction for light from `wo`; below the surface where it gets lost.
    pub(crate) fn sample(&self, n: DVec3, wo: DVec3, random: &mut Xoshiro) -> DVec3 {
        let (s, t) = n.any_orthonormal_pair();
        let choice = random.uniform();
        let uv = [random.uniform(), random.uniform()];
        if choice < self.cosine_share(wo.dot(n)) {
            let radius = uv[0].sqrt();
            let (sin, cos) = libm::sincos(TAU * uv[1]);
            let height = (1.0 - uv[0]).max(0.0).sqrt();
            return s * (radius * cos) + t * (radius * sin) + n * height;
        }
        let local = DVec3::new(wo.dot(s), wo.dot(t), wo.dot(n));
        let m = self.visible_normal(local, uv);
        let m = s * m.x + t * m.y + n * m.z;
        (m * (2.0 * wo.dot(m)) - wo).normalize()
    }

    /// Its density in solid angle.
    pub(crate) fn pdf(&self, n: DVec3, wo: DVec3, wi: DVec3) -> f64 {
        let [cos_o, cos_i] = [wo.dot(n), wi.dot(n)];
        if cos_o <= 0.0 || cos_i <= 0.0 {
            return 0.0;
        }
        let share = self.cosine_share(cos_o);
        let half = (wo + wi).normalize();
        // Visible normals: G1 D max(0, wo m) / cos_o, over 4 (wo m) for the reflected ray.
        let facets = self.facets(half, n) / ((1.0 + self.lambda(cos_o)) * 4.0 * cos_o);
        share * cos_i * FRAC_1_PI + (1.0 - share) * facets
    }

    /// `R (1 - E(cos)) / (1 - E_mean)`.
    fn again(&self, cos: f64) -> f64 {
        let missing = 1.0 - self.single_mean;
        if missing <= 0.0 { 0.0 } else { self.repeated * (1.0 - self.single(cos)) / missing }
    }

    fn cosine_share(&self, cos: f64) -> f64 {
        (self.repeated * (1.0 - self.single(cos))).max(MIN_COSINE_SHARE)
    }

    /// `E` on straight lines between the steps.
    pub(crate) fn single(&self, cos: f64) -> f64 {
        let x = libm::cbrt(cos.clamp(0.0, 1.0)) * STEPS as f64;
        let step = (x as usize).min(STEPS - 1);
        let share = x - step as f64;
        self.single[step] + share * (self.single[step + 1] - self.single[step])
    }

    fn lambda(&self, cos: f64) -> f64 {
        let tan_squared = ((1.0 - cos) * (1.0 + cos)).max(0.0) / (cos * cos);
        0.5 * ((1.0 + self.alpha * self.alpha * tan_squared).sqrt() - 1.0)
    }

    /// Density of facet normals `m`, in sr^-1: `alpha^2 / (pi (cos^2 (alpha^2 - 1) + 1)^2)`, with
    /// the sine from a cross product, so that nothing cancels.
    fn facets(&self, m: DVec3, n: DVec3) -> f64 {
        let cos = m.dot(n);
        if cos <= 0.0 {
            return 0.0;
        }
        let square = self.alpha * self.alpha;
        let sum = m.cross(n).length_squared() + square * cos * cos;
        square / (PI * sum * sum)
    }

    /// A facet normal in proportion to the area seen from `wo` (Heitz 2018), `n` along z.
    fn visible_normal(&self, wo: DVec3, uv: [f64; 2]) -> DVec3 {
        let stretched = DVec3::new(self.alpha * wo.x, self.alpha * wo.y, wo.z).normalize();
        let (s, t) = stretched.any_orthonormal_pair();
        // The pair of any orientation will do only if `s` is horizontal.
        let flat = DVec3::new(-stretched.y, stretched.x, 0.0);
        let s = if flat.length_squared() > 1e-24 { flat.normalize() } else { s };
        let t = if flat.length_squared() > 1e-24 { stretched.cross(s) } else { t };
        let radius = uv[0].sqrt();
        let (sin, cos) = libm::sincos(TAU * uv[1]);
        let a = radius * cos;
        let lean = 0.5 * (1.0 + stretched.z);
        let b = (1.0 - lean) * (1.0 - a * a).max(0.0).sqrt() + lean * radius * sin;
        let c = (1.0 - a * a - b * b).max(0.0).sqrt();
        let m = s * a + t * b + stretched * c;
        DVec3::new(self.alpha * m.x, self.alpha * m.y, m.z.max(1e-12)).normalize()
    }

    /// `E` at a cosine: the mean of `G2 / G1` over visible normals. The first coordinate is
    /// `1 - x^4`, as few normals lean far over and are those whose rays get lost.
    fn integrated(&self, cos: f64) -> f64 {
        let wo = DVec3::new(((1.0 - cos) * (1.0 + cos)).sqrt(), 0.0, cos);
        let middle = |i: u32| (f64::from(i) + 0.5) / f64::from(MIDPOINTS);
        let lambda = self.lambda(cos);
        let value = |i, j| {
            let x = middle(i);
            let m = self.visible_normal(wo, [1.0 - x * x * x * x, middle(j)]);
            let z = 2.0 * wo.dot(m) * m.z - wo.z;
            if z <= 0.0 {
                return 0.0;
            }
            4.0 * x * x * x * (1.0 + lambda) / (1.0 + lambda + self.lambda(z.min(1.0)))
        };
        let row = |i| (0..MIDPOINTS).map(|j| value(i, j)).sum::<f64>();
        (0..MIDPOINTS).map(row).sum::<f64>() / f64::from(MIDPOINTS * MIDPOINTS)
    }
}
