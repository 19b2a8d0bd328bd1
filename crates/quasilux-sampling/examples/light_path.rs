//! cargo run -p quasilux-sampling --example light_path
//!
//! Follows photons between two lamps and grey walls without geometry: chooses a lamp by its flux,
//! a direction by the cosine, and lets Russian roulette end the path. Discrete choices share
//! coordinates, which the histogram of used dimensions shows.

use quasilux_sampling::{
    DimensionHistogram, Discrete, PointSet, Randomization, Sampler, Sequence, stream_key, warp,
};

const FLUX_LM: [f64; 2] = [3000.0, 1000.0];
const REFLECTANCE: f64 = 0.5;

fn main() {
    let lamps = Discrete::new(&FLUX_LM).expect("positive fluxes are a distribution");
    let points = PointSet::new(Sequence::Sobol, Randomization::Owen, stream_key(1, 0, 0));
    let mut from_lamp = [0_u64; 2];
    let mut down = 0.0;
    let mut dimensions = DimensionHistogram::new();
    const PHOTONS: u64 = 1 << 12;
    for index in 0..PHOTONS {
        let mut sampler = Sampler::new(&points, index);
        // The remapped coordinate of the choice goes on to the direction.
        from_lamp[sampler.choose_leading(&lamps).index] += 1;
        let mut u = [sampler.remapped_1d(), sampler.next_1d()];
        loop {
            down += warp::sample_cosine_hemisphere(u)[2];
            if !sampler.choose_bool(REFLECTANCE) {
                break;
            }
            u = [sampler.remapped_1d(), sampler.next_1d()];
        }
        dimensions.record(sampler.used());
    }
    println!("photons from each lamp: {from_lamp:?} (3 to 1 by flux)");
    println!("sum of cosines a photon: {:.3} (2/3 times 2 flights)", down / PHOTONS as f64);
    println!("mean coordinates a photon: {:.3}", dimensions.mean());
    println!("at most {} for 99 % of the photons", dimensions.quantile(0.99));
}
