//! A photon's emission: four coordinates, two for the place on a square lamp and two for its cosine
//! direction; counted where it first hits the box below. The question is which sequence is best.

use quasilux_sampling::{PointSet, Randomization, Sequence, stream_key, warp};

/// Whether the photon falls onto the patch on the floor of a box with walls: a jump, as in every
/// count of photons.
fn hits_patch(u: [f64; 4]) -> f64 {
    let floor = on_floor(u);
    f64::from(u8::from((0.9..1.6).contains(&floor[0]) && (0.4..1.3).contains(&floor[1])))
}

/// A smooth reading of the same photon: what a sensor with a soft edge would count.
fn smooth_reading(u: [f64; 4]) -> f64 {
    let [x, y] = on_floor(u);
    1.0 / (1.0 + (x - 1.25) * (x - 1.25) + (y - 0.85) * (y - 0.85))
}

/// Where the ray from the lamp, a square of 1 m at a height of 2 m, meets the plane of the floor.
fn on_floor([u, v, s, t]: [f64; 4]) -> [f64; 2] {
    let [x, y, z] = warp::sample_cosine_hemisphere([s, t]);
    let distance = 2.0 / z.max(1e-9);
    [u + x * distance, v + y * distance]
}

/// Root mean square error of 64 replicates of 4^6 photons against the mean of a run of Owen-scrambled
/// Sobol' that is 256 times as long.
fn error(sequence: Sequence, randomization: Randomization, reading: fn([f64; 4]) -> f64) -> f64 {
    let mean = |sequence, randomization, replicate, count: u64| {
        let points = PointSet::new(sequence, randomization, stream_key(11, replicate, 0));
        let value = |index| reading([0, 1, 2, 3].map(|d| points.coordinate(index, d)));
        (0..count).map(value).sum::<f64>() / count as f64
    };
    let truth = mean(Sequence::Sobol, Randomization::Owen, 1 << 20, 1 << 20);
    let squares = (0..64).map(|replicate| {
        let error = mean(sequence, randomization, replicate, 1 << 12) - truth;
        error * error
    });
    (squares.sum::<f64>() / 64.0).sqrt()
}

/// The standard error of a root mean square of 64 is 9 %, of a ratio 13 %: a bound of a factor of
/// two is five of them away from equality.
#[test]
fn sequences_on_a_photons_emission() {
    for (what, reading) in
        [("patch", hits_patch as fn([f64; 4]) -> f64), ("smooth", smooth_reading)]
    {
        let sobol = error(Sequence::Sobol, Randomization::Owen, reading);
        let relative = |sequence, randomization| error(sequence, randomization, reading) / sobol;
        let random = relative(Sequence::Random, Randomization::None);
        let faure4 = relative(Sequence::Faure4, Randomization::Owen);
        let halton = relative(Sequence::Halton, Randomization::Owen);
        let hammersley = relative(Sequence::Hammersley { points: 1 << 12 }, Randomization::Owen);
        println!(
            "{what}: Owen-Sobol' {sobol:.2e}; relative to it: base-4 {faure4:.2}, Halton \
             {halton:.2}, Hammersley {hammersley:.2}, pseudo-random {random:.2}"
        );
        assert!(random > 2.0, "{what}: pseudo-random {random}");
        assert!((0.5..2.0).contains(&faure4), "{what}: base 4 {faure4}");
    }
}
