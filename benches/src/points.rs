//! cargo run --release -p quasilux-benches --bin points
//!
//! Coordinates a second on one core: blocks of 4096 points and single random access of every
//! sequence, against `sobol_burley` and, where python3 and numpy are, numpy's PCG64. Each figure is
//! the best of 300 runs of 2^16 coordinates, short enough that most runs are not interrupted.

use quasilux_sampling::{PointSet, Randomization, Sequence, stream_key};
use std::hint::black_box;
use std::process::Command;

const RUNS: u64 = 300;
const COUNT: usize = 1 << 16;
const BLOCK: usize = 4096;

fn main() {
    println!("million coordinates a second, one core, best of {RUNS}");
    println!("{:<28}{:>10}{:>10}", "", "blocks", "single");
    let kinds = [
        (Sequence::Sobol, Randomization::None),
        (Sequence::Sobol, Randomization::Rotation),
        (Sequence::Sobol, Randomization::Shift),
        (Sequence::Sobol, Randomization::Owen),
        (Sequence::Faure4, Randomization::Owen),
        (Sequence::Random, Randomization::None),
        (Sequence::Halton, Randomization::None),
        (Sequence::Halton, Randomization::Shift),
        (Sequence::Halton, Randomization::Owen),
    ];
    for (sequence, randomization) in kinds {
        let points = PointSet::new(sequence, randomization, stream_key(1, 0, 0));
        let name = format!("{} {}", sequence.name(), randomization.name());
        println!("{name:<28}{:>10.0}{:>10.1}", blocks(&points), single(&points));
    }
    println!("{:<28}{:>10.0}{:>10.1}", "sobol_burley 0.5 (f32)", burley_lanes(), burley_single());
    println!("{:<28}{:>10}", "numpy PCG64", numpy());
}

/// The first four dimensions of consecutive points in turn.
fn blocks(points: &PointSet) -> f64 {
    let mut block = vec![0.0; BLOCK];
    best(|run| {
        for number in 0..(COUNT / BLOCK) as u64 {
            let first_index = (16 * run + number) / 4 * BLOCK as u64;
            points.fill((number % 4) as u32, first_index, black_box(&mut block));
        }
    })
}

/// Coordinates of indices all over [0, 2^40), the first four dimensions of each.
fn single(points: &PointSet) -> f64 {
    best(|run| {
        let mut sum = 0.0;
        for number in 0..COUNT as u64 / 4 {
            let index = (run << 20 | number).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 24;
            sum += (0..4).map(|dimension| points.coordinate(index, dimension)).sum::<f64>();
        }
        black_box(sum);
    })
}

/// Four dimensions at once, the fastest form of the crate.
fn burley_lanes() -> f64 {
    best(|run| {
        for number in 0..COUNT as u32 / 4 {
            black_box(sobol_burley::sample_4d(number, 0, run as u32));
        }
    })
}

fn burley_single() -> f64 {
    best(|run| {
        for number in 0..COUNT as u32 {
            black_box(sobol_burley::sample(number >> 2, number & 3, run as u32));
        }
    })
}

fn numpy() -> String {
    let script = "
import time, numpy
generator = numpy.random.Generator(numpy.random.PCG64(1))
block = numpy.empty(4096)
def seconds():
    start = time.perf_counter()
    for _ in range(16):
        generator.random(out=block)
    return time.perf_counter() - start
print('%.0f' % (2**16 / min(seconds() for _ in range(300)) / 1e6))";
    match Command::new("python3").args(["-c", script]).output() {
        Ok(output) if output.status.success() => {
            String::from_utf8_lossy(&output.stdout).trim().to_owned()
        }
        _ => "absent".to_owned(),
    }
}

/// Millions a second, from the fastest of some runs of `COUNT` coordinates.
#[expect(clippy::disallowed_methods, reason = "a benchmark reads the clock")]
fn best(mut run: impl FnMut(u64)) -> f64 {
    let seconds = (0..RUNS).map(|number| {
        let start = std::time::Instant::now();
        run(number);
        start.elapsed().as_secs_f64()
    });
    COUNT as f64 / seconds.fold(f64::INFINITY, f64::min) / 1e6
}
