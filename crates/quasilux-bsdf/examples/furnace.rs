//! cargo run --example furnace
//!
//! The furnace test of a tabulated surface: under a sky of radiance 1 from all sides a surface
//! reflects its albedo. Estimated by sampling the table, whose density leaves no noise in a grey
//! table, and by uniform directions, for comparison.

use glam::DVec3;
use quasilux_bsdf::{AngleBasis, Distribution, KlemsTable};
use quasilux_sampling::{PointSet, Randomization, Sequence, stream_key, warp};

const SAMPLES: u64 = 4096;

/// A Phong lobe about the mirror direction with its albedo of 0.8 at normal incidence, in sr^-1.
fn glossy(wi: DVec3, wo: DVec3) -> f64 {
    let mirrored = DVec3::new(-wi.x, -wi.y, wi.z);
    let exponent = 40.0;
    let cosine = mirrored.dot(wo).max(0.0);
    0.8 * (exponent + 2.0) / std::f64::consts::TAU * libm::pow(cosine, exponent)
}

fn main() {
    let basis = || AngleBasis::known("LBNL/Klems Full").expect("a basis of WINDOW");
    let table = KlemsTable::from_function(basis(), basis(), glossy).expect("f is not negative");
    let surface = Distribution::Klems(table);
    let points = PointSet::new(Sequence::Sobol, Randomization::Owen, stream_key(1, 0, 0));
    let wi = DVec3::new(0.5, 0.0, 0.75_f64.sqrt());

    let (mut from_table, mut uniform) = (0.0, 0.0);
    for index in 0..SAMPLES {
        let u = [points.coordinate(index, 0), points.coordinate(index, 1)];
        // The cosine is part of the integrand, not of f.
        if let Some(sample) = surface.sample(wi, u) {
            from_table += surface.evaluate(wi, sample.wo)[0] * sample.wo.z / sample.pdf_sr;
        }
        let [x, y, z] = warp::sample_uniform_hemisphere(u);
        let wo = DVec3::new(x, y, z);
        uniform += surface.evaluate(wi, wo)[0] * wo.z * std::f64::consts::TAU;
    }
    println!("albedo, exact       {:.9}", surface.albedo(wi)[0]);
    println!("table's own density {:.9}", from_table / SAMPLES as f64);
    println!("uniform directions  {:.9}", uniform / SAMPLES as f64);
}
