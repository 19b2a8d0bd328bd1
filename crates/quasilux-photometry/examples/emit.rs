//! cargo run --example emit
//!
//! Draws directions from a luminaire with density proportional to its intensity, and estimates the
//! illuminance on the floor below it, which the inverse square law gives exactly.
//!
//! Each direction stands for the same flux, because intensity over density is the flux itself.

use quasilux_photometry::read_ies;
use quasilux_sampling::{PointSet, Randomization, Sequence, stream_key};

/// 100 cd in all directions.
const FILE: &[u8] = b"IESNA:LM-63-2002\n[TEST] example\nTILT=NONE\n\
    1 -1 1 2 1 1 2 0 0 0\n1 1 10\n0 180\n0\n100 100\n";
const RAYS: u64 = 1 << 16;
const HEIGHT_M: f64 = 2.0;
/// A disk below the luminaire counts the light that lands on it.
const RADIUS_M: f64 = 0.2;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let luminaire = read_ies(FILE)?.photometry;
    let points = PointSet::new(Sequence::Sobol, Randomization::Owen, stream_key(1, 0, 0));
    let ray_flux_lm = luminaire.flux_lm() / RAYS as f64;
    let mut landed_lm = 0.0;
    for index in 0..RAYS {
        let u = [points.coordinate(index, 0), points.coordinate(index, 1)];
        let sample = luminaire.sample(u).ok_or("a luminaire without light")?;
        // The luminaire frame has nadir along -z.
        let direction = sample.direction;
        if direction.z < 0.0 {
            let at_floor = direction * (HEIGHT_M / -direction.z);
            if at_floor.truncate().length() < RADIUS_M {
                landed_lm += ray_flux_lm;
            }
        }
    }
    let area_m2 = std::f64::consts::PI * RADIUS_M * RADIUS_M;
    println!("from {RAYS} rays       {:.2} lx", landed_lm / area_m2);
    let distance_m = (HEIGHT_M * HEIGHT_M + RADIUS_M * RADIUS_M).sqrt();
    let solid_angle_sr = std::f64::consts::TAU * (1.0 - HEIGHT_M / distance_m);
    println!("by the solid angle    {:.2} lx", 100.0 * solid_angle_sr / area_m2);
    Ok(())
}
