//! cargo run --release -p quasilux-benches --bin photons [SCENE...]
//!
//! Whole photons a second, all bounces, counted by sensors: one by one in the order of their
//! indices, in waves, and in waves of coherent groups, on one thread and two. All take turns in
//! rounds of 2^19 photons, 2^17 of each of four replicates of Owen-scrambled Sobol'; the figures
//! are medians over the rounds, of the time on the clock and of processor time, and of the ratio of
//! processor times within a round. Then what a wave spends its time on, on one thread.

use quasilux_benches::median;
use quasilux_benches::scenes::{self, Named};
use quasilux_foreign::{all_processors_seconds, processor_seconds};
use quasilux_transport::trial::{PhotonOrder, PhotonTrial, Step, Stopwatch, try_photons};
use quasilux_transport::{EstimatorKind, Settings};
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::ops::Range;
use std::sync::Mutex;
use std::time::Instant;

const ROUNDS: u64 = 9;
const REPLICATES: u32 = 4;
const INDICES: u64 = 1 << 17;

const STEPS: [Step; 5] =
    [Step::Sampling, Step::Emission, Step::Traversal, Step::Tally, Step::Scattering];

/// One that takes turns.
struct Contestant {
    name: &'static str,
    order: PhotonOrder,
    threads: usize,
    rounds: Vec<Round>,
}

/// What a round took.
struct Round {
    photons: u64,
    rays: u64,
    seconds: f64,
    processor_seconds: f64,
}

fn main() {
    let wanted: Vec<String> = std::env::args().skip(1).collect();
    let asked = |named: &Named| wanted.is_empty() || wanted.iter().any(|word| word == named.name);
    let pools = [1, 2].map(|threads| {
        ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool of threads")
    });
    println!(
        "{:<10}{:<26}{:>8}{:>10}{:>12}{:>14}{:>8}",
        "", "", "threads", "Mrays/s", "Mphotons/s", "processor s/M", "ratio"
    );
    let kitchen = scenes::kitchen();
    if kitchen.is_none() {
        println!("left out: kitchen, as QUASILUX_CORPUS=none asks");
    }
    let examples = ["cube", "office"].map(scenes::example);
    for named in examples.into_iter().chain(kitchen).filter(asked) {
        compare(&named, &pools);
        shares(&named, &pools[0]);
    }
}

fn settings() -> Settings {
    Settings { estimator: EstimatorKind::Photon, replicates: REPLICATES, ..Settings::default() }
}

/// The indices of one round.
fn indices(round: u64) -> Range<u64> {
    round * INDICES..(round + 1) * INDICES
}

fn compare(named: &Named, pools: &[ThreadPool; 2]) {
    let contestant = |name, order, threads| Contestant { name, order, threads, rounds: Vec::new() };
    let mut contestants = [
        contestant("one by one", PhotonOrder::OneByOne, 1),
        contestant("waves", PhotonOrder::Waves, 1),
        contestant("coherent waves", PhotonOrder::CoherentWaves, 1),
        contestant("one by one", PhotonOrder::OneByOne, 2),
        contestant("coherent waves", PhotonOrder::CoherentWaves, 2),
    ];
    try_photons(&named.scene, &settings(), None, |trial| {
        for round in 0..ROUNDS {
            for contestant in &mut contestants {
                let pool = &pools[contestant.threads - 1];
                contestant
                    .rounds
                    .push(pool.install(|| run(trial, contestant.order, indices(round))));
            }
        }
    });
    for Contestant { name, threads, rounds, .. } in &contestants {
        let rays = median(rounds.iter().map(|r| r.rays as f64 / r.seconds / 1e6));
        let photons = median(rounds.iter().map(|r| r.photons as f64 / r.seconds / 1e6));
        let processor = median(rounds.iter().map(|r| 1e6 * r.processor_seconds / r.photons as f64));
        let pairs = rounds.iter().zip(&contestants[0].rounds);
        let ratio = median(pairs.map(|(r, first)| first.processor_seconds / r.processor_seconds));
        println!(
            "{:<10}{name:<26}{threads:>8}{rays:>10.2}{photons:>12.2}{processor:>14.3}{ratio:>8.2}",
            named.name
        );
    }
}

#[expect(clippy::disallowed_methods, reason = "a benchmark reads the clock")]
fn run(trial: &mut dyn PhotonTrial, order: PhotonOrder, indices: Range<u64>) -> Round {
    let (start, processor) = (Instant::now(), all_processors_seconds());
    let traced = trial.trace(order, indices);
    Round {
        photons: traced.photons,
        rays: traced.rays,
        seconds: start.elapsed().as_secs_f64(),
        processor_seconds: all_processors_seconds() - processor,
    }
}

/// Processor seconds of one thread by step.
struct Laps(Mutex<(f64, [f64; STEPS.len()])>);

impl Stopwatch for Laps {
    fn lap(&self, step: Step) {
        let now = processor_seconds();
        let mut laps = self.0.lock().expect("one thread");
        let place = STEPS.iter().position(|other| *other == step).expect("a step");
        laps.1[place] += now - laps.0;
        laps.0 = now;
    }
}

/// What a wave spends its time on.
fn shares(named: &Named, pool: &ThreadPool) {
    let laps = Laps(Mutex::new((0.0, [0.0; STEPS.len()])));
    try_photons(&named.scene, &settings(), Some(&laps), |trial| {
        pool.install(|| {
            for round in 0..ROUNDS {
                laps.0.lock().expect("one thread").0 = processor_seconds();
                trial.trace(PhotonOrder::CoherentWaves, indices(round));
            }
        });
    });
    let seconds = laps.0.into_inner().expect("one thread").1;
    let total: f64 = seconds.iter().sum();
    let photons = (ROUNDS * INDICES * u64::from(REPLICATES)) as f64;
    for (step, seconds) in STEPS.iter().zip(seconds) {
        println!(
            "{:<10}{:<26}{:>8.1} %{:>38.3}",
            named.name,
            format!("{step:?}"),
            100.0 * seconds / total,
            1e6 * seconds / photons
        );
    }
}
