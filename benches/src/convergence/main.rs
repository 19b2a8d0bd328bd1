//! cargo run --release -p quasilux-benches --bin convergence [WORD...]
//!
//! Words: `cube`, `office`, `spotlights`, `wall`; names of estimators; `2^N` indices; `random`;
//! `bounces=N`; `element=METRES`; `first_shot=auto`, `on` or `off`.
//!
//! How the error falls, and at what price. At each checkpoint: indices per replicate, rays,
//! processor seconds so far, the relative error of one replicate (from the spread of 16, root mean
//! square over all sensor points) and of their mean, the slope of the former since four checkpoints
//! before, and the efficiency 1 / (squared error of the mean x processor seconds).
//!
//! `cube` is the diffuse cube of Voloboy, Dmitriev and Kopylov (2003) with nine points on each
//! face, `office` the example with 68 points, `spotlights` and `wall` a small room with two narrow
//! beams, or with a bare lamp 2 cm from a wall.

use quasilux_benches::scenes;
use quasilux_foreign::all_processors_seconds;
use quasilux_sampling::Sequence;
use quasilux_scene::Scene;
use quasilux_transport::{Control, Estimates, EstimatorKind, Observer, Settings, Switch, simulate};

/// Checkpoints that a slope spans.
const SPAN: usize = 4;

/// Writes a line at each checkpoint.
struct Table {
    start: f64,
    errors: Vec<(u64, f64)>,
}

/// The measurements that the words of the command line ask for.
struct Request {
    scenes: Vec<&'static str>,
    estimators: Vec<EstimatorKind>,
    settings: Settings,
}

impl Request {
    fn new(words: &[String]) -> Self {
        let given = |name: &str| words.iter().any(|word| word == name);
        let number = |key: &str| words.iter().find_map(|word| word.strip_prefix(key));
        let switch = |key: &str| {
            let mut all = Switch::ALL.into_iter();
            let named = all.find(|switch| given(&format!("{key}={}", switch.name())));
            named.unwrap_or_default()
        };
        let all = EstimatorKind::ALL.into_iter();
        let mut estimators: Vec<EstimatorKind> = all.filter(|kind| given(kind.name())).collect();
        if estimators.is_empty() {
            estimators = vec![EstimatorKind::Path, EstimatorKind::Auto];
        }
        let names = ["cube", "office", "spotlights", "wall"];
        let all = !names.iter().any(|name| given(name));
        let log_samples = number("2^").and_then(|word| word.parse().ok()).unwrap_or(12_u32);
        let settings = Settings {
            sequence: if given("random") { Sequence::Independent } else { Sequence::Sobol },
            max_bounces: number("bounces=").and_then(|word| word.parse().ok()),
            map_element_m: number("element=").and_then(|word| word.parse().ok()),
            first_shot: switch("first_shot"),
            rel_tol: 0.0,
            max_samples: Some(1 << log_samples),
            ..Settings::default()
        };
        let scenes = names.into_iter().filter(|name| all || given(name)).collect();
        Self { scenes, estimators, settings }
    }
}

fn main() {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let request = Request::new(&words);
    for name in request.scenes {
        let scene = scene(name);
        for &estimator in &request.estimators {
            let settings = Settings { estimator, ..request.settings.clone() };
            println!(
                "{name}, {}, {}, first shot {}",
                estimator.name(),
                settings.sequence.name(),
                settings.first_shot.name()
            );
            println!(
                "{:>9}{:>14}{:>10}{:>14}{:>14}{:>8}{:>12}",
                "indices", "rays", "seconds", "one, %", "mean, %", "slope", "efficiency"
            );
            let mut table = Table { start: all_processors_seconds(), errors: Vec::new() };
            let _ = simulate(&scene, &settings, &mut table);
        }
    }
}

fn scene(name: &'static str) -> Scene {
    match name {
        "spotlights" => return scenes::spotlights().scene,
        "wall" => return scenes::lamp_near_a_wall().scene,
        _ => {}
    }
    let mut scene = scenes::example(name).scene;
    scene.sensors = match name {
        "cube" => scenes::cube_sensors(),
        _ => scenes::office_sensors(),
    };
    scene
}

impl Observer for Table {
    fn checkpoint(&mut self, estimates: &Estimates) -> Control {
        let seconds = all_processors_seconds() - self.start;
        let one = spread(estimates);
        let replicates = estimates.sensors[0].replicate_lx.len() as f64;
        let mean = one / replicates.sqrt();
        self.errors.push((estimates.samples, one));
        let before = self.errors.len().checked_sub(SPAN + 1).map(|place| self.errors[place]);
        let slope = before.map_or(f64::NAN, |(samples, error)| {
            libm::log(one / error) / libm::log(estimates.samples as f64 / samples as f64)
        });
        println!(
            "{:>9}{:>14}{seconds:>10.2}{:>14.4}{:>14.4}{slope:>8.2}{:>12.0}",
            estimates.samples,
            estimates.rays,
            100.0 * one,
            100.0 * mean,
            1.0 / (mean * mean * seconds)
        );
        Control::Continue
    }
}

/// The relative standard deviation of replicates, root mean square over all points.
fn spread(estimates: &Estimates) -> f64 {
    let (mut sum, mut points) = (0.0, 0);
    for sensor in &estimates.sensors {
        let rows = &sensor.replicate_lx;
        for point in 0..rows[0].len() {
            let mean = rows.iter().map(|row| row[point]).sum::<f64>() / rows.len() as f64;
            let squares =
                rows.iter().map(|row| (row[point] / mean - 1.0) * (row[point] / mean - 1.0));
            sum += squares.sum::<f64>() / (rows.len() - 1) as f64;
            points += 1;
        }
    }
    (sum / f64::from(points)).sqrt()
}
