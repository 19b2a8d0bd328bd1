//! Coordinates handed out in order, with shared ones for events, against the fixed assignment.

use quasilux_sampling::{Sampler, assignment};

use crate::support::{SampleMean, assert_mean, random, sample_mean};

const SURVIVAL: f64 = 2.0 / 3.0;

/// A photon in a closed room: a direction from the lamp; at each hit an event, and a direction
/// where it survives. Gives the coordinates used.
fn walk(mut sampler: Sampler<'_>, is_fixed: bool) -> f64 {
    let go_to = |sampler: &mut Sampler<'_>, dimension| {
        if is_fixed {
            sampler.skip_to(dimension);
        }
    };
    go_to(&mut sampler, assignment::EMISSION);
    sampler.next_2d();
    for hit in 0.. {
        go_to(&mut sampler, assignment::event(hit));
        if !sampler.choose_bool(SURVIVAL) {
            break;
        }
        go_to(&mut sampler, assignment::scattering(hit));
        sampler.next_2d();
    }
    f64::from(sampler.used())
}

/// Events are 3 on average, 1 / (1 - 2/3), each but the last with a direction: 2 + 3 + 4 = 9
/// coordinates where each event has its own. Shared, one lasts until m survivals have taken its
/// bits, and the mean number of them is 1 + (2/3)^m + (2/3)^2m + ..: 7.003 coordinates in all.
///
/// 2^16 walks, seeds 1 and 2: finds means that are off by 0.15.
#[test]
fn sharing_saves_two_coordinates_of_nine() {
    let spent = power(0.5, Sampler::SHARED_BITS);
    let shared_by = (1..).find(|m| power(SURVIVAL, *m) <= spent).expect("powers fall");
    let shared = 6.0 + 1.0 / (1.0 - power(SURVIVAL, shared_by));
    assert!((7.0..7.01).contains(&shared), "{shared}");
    for (is_fixed, seed, expected) in [(true, 1, 9.0), (false, 2, shared)] {
        let points = random(seed);
        let used: Vec<f64> =
            (0..1 << 16).map(|index| walk(Sampler::new(&points, index), is_fixed)).collect();
        let SampleMean { mean, standard_error } = sample_mean(&used);
        assert_mean(mean, expected, standard_error, "coordinates of a walk");
    }
}

fn power(base: f64, exponent: u32) -> f64 {
    (0..exponent).map(|_| base).product()
}
