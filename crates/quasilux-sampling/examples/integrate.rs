//! cargo run --release -p quasilux-sampling --example integrate
//!
//! Integrates a smooth function of four variables with independent and with Owen-scrambled Sobol'
//! points. The standard error comes from replicates, each under its own key: the points of one
//! randomised sequence depend on each other, so their spread says nothing about the error.

use quasilux_sampling::{PointSet, Randomization, Sequence, stream_key};

const REPLICATES: u32 = 16;

/// The product of sines over one period, plus one: its integral over the unit cube is 1.
fn integrand(x: [f64; 4]) -> f64 {
    1.0 + x.into_iter().map(|x| libm::sin(std::f64::consts::TAU * x)).product::<f64>()
}

/// The mean of the integrand over the first `count` points of one replicate.
fn mean(sequence: Sequence, count: u64, replicate: u32) -> f64 {
    let points = PointSet::new(sequence, Randomization::Owen, stream_key(7, replicate, 0));
    let value = |index| integrand([0, 1, 2, 3].map(|d| points.coordinate(index, d)));
    (0..count).map(value).sum::<f64>() / count as f64
}

fn main() {
    println!("{:>8}  {:>12}  {:>12}", "points", "independent", "Sobol'");
    // Powers of two: other counts cut the last aligned block of the sequence.
    for m in (4..=14).step_by(2) {
        let [independent, sobol] = [Sequence::Independent, Sequence::Sobol].map(|sequence| {
            let means: Vec<f64> = (0..REPLICATES).map(|r| mean(sequence, 1 << m, r)).collect();
            let centre = means.iter().sum::<f64>() / f64::from(REPLICATES);
            let squares: f64 = means.iter().map(|mean| (mean - centre) * (mean - centre)).sum();
            (squares / f64::from(REPLICATES * (REPLICATES - 1))).sqrt()
        });
        println!("{:>8}  {independent:>12.2e}  {sobol:>12.2e}", 1 << m);
    }
}
