//! cargo run --release -p quasilux-benches --bin points
//!
//! Coordinates a second on one core: blocks of 4096 points and single random access of every
//! sequence, against `sobol_burley` and, where python3 and numpy are, numpy's PCG64. All take turns
//! in rounds of 2^16 coordinates each; the figures are medians over the rounds, and medians of the
//! ratio to Owen-scrambled Sobol' in blocks within a round.

mod numpy;

use numpy::Numpy;
use quasilux_benches::median;
use quasilux_sampling::{PointSet, Randomization, Sequence, stream_key};
use std::hint::black_box;
use std::time::Instant;

const ROUNDS: u64 = 101;
const COUNT: usize = 1 << 16;
const BLOCK: usize = 4096;

/// One that takes turns: its name, and what it does in a round, in s.
struct Contestant {
    name: String,
    seconds: Box<dyn FnMut(u64) -> f64>,
}

fn main() {
    let mut contestants = contestants();
    let mut seconds = vec![Vec::new(); contestants.len()];
    for round in 0..ROUNDS {
        for (contestant, seconds) in contestants.iter_mut().zip(&mut seconds) {
            seconds.push((contestant.seconds)(round));
        }
    }
    println!("medians of {ROUNDS} rounds, one core");
    println!("{:<36}{:>22}{:>18}", "", "million coordinates/s", "ratio to first");
    for (contestant, own) in contestants.iter().zip(&seconds) {
        let rate = median(own.iter().map(|s| COUNT as f64 / s / 1e6));
        let ratio = median(own.iter().zip(&seconds[0]).map(|(s, first)| first / s));
        println!("{:<36}{rate:>22.1}{ratio:>18.3}", contestant.name);
    }
}

/// All of them, Owen-scrambled Sobol' in blocks first.
fn contestants() -> Vec<Contestant> {
    let kinds = [
        (Sequence::Sobol, Randomization::Owen),
        (Sequence::Sobol, Randomization::None),
        (Sequence::Sobol, Randomization::CranleyPattersonRotation),
        (Sequence::Sobol, Randomization::DigitalShift),
        (Sequence::Faure4, Randomization::Owen),
        (Sequence::Independent, Randomization::None),
        (Sequence::Halton, Randomization::None),
        (Sequence::Halton, Randomization::CranleyPattersonRotation),
        (Sequence::Halton, Randomization::DigitalShift),
        (Sequence::Halton, Randomization::Owen),
    ];
    let mut contestants = Vec::new();
    for (sequence, randomization) in kinds {
        let points = PointSet::new(sequence, randomization, stream_key(1, 0, 0));
        let name = format!("{} {}", sequence.name(), randomization.name());
        let mut block = vec![0.0; BLOCK];
        contestants.push(Contestant {
            name: format!("{name}, blocks"),
            seconds: Box::new(move |round| time(|| blocks(&points, round, &mut block))),
        });
        contestants.push(Contestant {
            name: format!("{name}, single"),
            seconds: Box::new(move |round| time(|| single(&points, round))),
        });
    }
    contestants.push(Contestant {
        name: "sobol_burley 0.5 (f32), four at once".to_owned(),
        seconds: Box::new(|round| time(|| burley_lanes(round))),
    });
    contestants.push(Contestant {
        name: "sobol_burley 0.5 (f32), single".to_owned(),
        seconds: Box::new(|round| time(|| burley_single(round))),
    });
    match Numpy::start(COUNT, BLOCK) {
        Some(mut numpy) => contestants.push(Contestant {
            name: "numpy PCG64, blocks".to_owned(),
            seconds: Box::new(move |_| numpy.seconds()),
        }),
        None => println!("left out: numpy PCG64, since python3 with numpy is missing"),
    }
    contestants
}

/// The first four dimensions of consecutive points in turn.
fn blocks(points: &PointSet, round: u64, block: &mut [f64]) {
    for number in 0..(COUNT / BLOCK) as u64 {
        let first_index = (16 * round + number) / 4 * BLOCK as u64;
        points.fill((number % 4) as u32, first_index, black_box(block));
    }
}

/// Coordinates of indices all over [0, 2^40), the first four dimensions of each.
fn single(points: &PointSet, round: u64) {
    let mut sum = 0.0;
    for number in 0..COUNT as u64 / 4 {
        let index = (round << 20 | number).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 24;
        sum += (0..4).map(|dimension| points.coordinate(index, dimension)).sum::<f64>();
    }
    black_box(sum);
}

/// Four dimensions at once, the fastest form of the crate.
fn burley_lanes(round: u64) {
    for number in 0..COUNT as u32 / 4 {
        black_box(sobol_burley::sample_4d(number, 0, round as u32));
    }
}

fn burley_single(round: u64) {
    for number in 0..COUNT as u32 {
        black_box(sobol_burley::sample(number >> 2, number & 3, round as u32));
    }
}

#[expect(clippy::disallowed_methods, reason = "a benchmark reads the clock")]
fn time(work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_secs_f64()
}
