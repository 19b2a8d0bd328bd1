//! What a trial predicts of paths that end by chance, against such paths.

use super::*;
use crate::context::{Context, Stream};
use crate::estimator::exact::exact;
use crate::estimator::pilot::{ErrorTarget, PilotCost, SAMPLES, Sample, Trial};
use crate::path::end::Rest;
use crate::path::frozen_map::{FrozenMap, bounces_left, layers};
use crate::path::sections::{Section, trace_sections};
use crate::path::wave::PathWave;
use crate::scenes::{all_walls_emit, diffuse, diffuse_cube, level_grid, mirror, point_light, room};
use crate::settings::Settings;
use crate::stats::tally::Quantum;
use crate::stats::targets::{Target, targets};
use crate::stats::watch::Watch;
use glam::DVec3;
use quasilux_sampling::{Randomization, Sequence};
use quasilux_scene::{Material, Scene};

/// Means over so many replicates know variances to 8 %.
const REPLICATES: u32 = 300;

#[test]
fn light_on_the_map_fits_into_the_bounces_that_are_left() {
    assert_eq!(bounces_left(None, 7, 8), Some(u32::MAX));
    assert_eq!([0, 1, 2].map(|b| bounces_left(Some(3), b, 8)), [Some(2), Some(1), None]);
    assert_eq!([0, 1].map(|b| bounces_left(Some(100), b, 8)), [Some(99), None]);
    assert_eq!([0, 1].map(|b| bounces_left(Some(3), b, 1 << 40)), [Some(2), None]);
    assert_eq!(bounces_left(Some(1), 0, 8), None);
    let layers = |most, listed| [8, 1 << 40].map(|sides| layers(most, listed, sides));
    assert_eq!(
        [layers(None, 5), layers(Some(3), 0), layers(Some(100), 5)],
        [[4; 2], [2, 1], [4; 2]]
    );
}

/// How paths go.
#[derive(Clone, Copy)]
enum Paths<'m> {
    Noted,
    Alone,
    OnMap(&'m FrozenMap<f64>),
}

/// Paths of random points, whose variance falls with their number and by nothing else.
struct Bench<'s> {
    context: &'s Context<'s, f64>,
    targets: Vec<Target>,
    wanted: ErrorTarget,
    quantum: Quantum,
}

impl Bench<'_> {
    /// Mean variance of trials of all targets, by what light counts there, and the rays of such a
    /// trial.
    fn variance_and_rays(&self, paths: Paths<'_>) -> (f64, f64) {
        let (mut variances, mut rays) = (Vec::new(), 0);
        for (number, &target) in self.targets.iter().enumerate() {
            let mut value = |replicate: u32| {
                let points = self.context.points(replicate, Stream::Paths(number as u64));
                let rest = match paths {
                    Paths::Noted => Rest::Recorded,
                    Paths::Alone => Rest::Path,
                    Paths::OnMap(map) => Rest::Frozen(map.end(number)),
                };
                let (caustics, partition, indices) = (None, None, 0..SAMPLES);
                let section =
                    Section { number, target, points, rest, caustics, partition, indices };
                let wave = &mut PathWave::default();
                let piece = trace_sections(self.context, &[section], self.quantum, wave);
                rays += piece.work.rays;
                let sums = &piece.sums[0];
                let lx = self.quantum.value(sums.direct) + self.quantum.value(sums.indirect);
                lx / SAMPLES as f64 * self.wanted.importance_per_lx(number)
            };
            let values: Vec<f64> = (0..REPLICATES).map(&mut value).collect();
            let middle = mean(&values);
            let squares = values.iter().map(|v| (v - middle) * (v - middle)).sum::<f64>();
            variances.push(squares / f64::from(REPLICATES - 1));
        }
        let trials = f64::from(REPLICATES) / crate::estimator::pilot::REPLICATES.len() as f64;
        (mean(&variances), rays as f64 / trials)
    }
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// A trial of a few hundred paths is itself only good to some tens of percent in variances, which
/// have long tails, and to a few percent in rays.
fn assert_predicted(what: &str, scene: &Scene, max_bounces: Option<u32>) {
    let (sequence, randomization) = (Sequence::Independent, Randomization::None);
    let settings = Settings { sequence, randomization, max_bounces, ..Settings::default() };
    let context = Context::<f64>::new(scene, &settings);
    let quantum = Quantum::for_reference(context.lights.reference_lx(&context.world));
    let targets = targets(scene);
    let sample = Sample::new(&targets, &exact(&context, &targets, &mut 0));
    let PathTrial { trial, records, finds_light } = PathTrial::new(&context, &sample, quantum);
    assert!(finds_light);
    let found_lx = |target: usize| sample.exact_lx[target] + trial.moments(target).mean;
    let wanted = ErrorTarget::new(&settings, &sample, (0..targets.len()).map(found_lx).collect());
    let bench = Bench { context: &context, targets, wanted, quantum };
    let (of_noted, rays_noted) = bench.variance_and_rays(Paths::Noted);
    assert!((rays_noted / trial.rays - 1.0).abs() < 0.07, "{what}: {rays_noted} {}", trial.rays);

    let assert_found = |who: &str, predicted: (f64, f64), (variance, rays): (f64, f64)| {
        // What chances add, apart from the spread of the paths themselves.
        let ratios = [predicted.0 / (variance - of_noted), predicted.1 / rays];
        println!("{what}, {who}: {ratios:?}");
        assert!((0.55..1.8).contains(&ratios[0]), "{what}, {who}: {ratios:?}");
        assert!((0.9..1.1).contains(&ratios[1]), "{what}, {who}: {ratios:?}");
    };
    let alone = records.alone(&bench.wanted);
    let (variance, rays) = bench.variance_and_rays(Paths::Alone);
    if context.shows_emitters_past_specular() {
        // They ask for more than was recorded, and are tried as they are.
        let trial = Trial::of_paths(&context, &sample, None, quantum);
        assert!((0.9..1.1).contains(&(trial.rays / rays)), "{what}: {} of {rays}", trial.rays);
    } else {
        assert_found("alone", (mean(&alone.variances), alone.rays), (variance, rays));
    }

    let nothing = vec![0.0; bench.targets.len()];
    let noted = PilotCost::of_paths(&nothing, trial.rays);
    let plain = PilotCost::of_paths(&alone.variances, alone.rays);
    let mut observer = ();
    let mut watch = Watch::new(&mut observer);
    let paths = PathPilot { records: &records, recorded: &noted, alone: &plain };
    let choice = MapPilot::new(&context, &settings, &paths, &bench.wanted, &mut watch).unwrap();
    assert!(!choice.misses_light);
    let pilot_cost = choice.pilot_cost();
    let predicted = (mean(pilot_cost.variances), pilot_cost.of_paths);
    let importance =
        (0..bench.targets.len()).map(|target| bench.wanted.importance_per_lx(target)).collect();
    let map = choice.freeze(&context, importance, &mut watch).map;
    assert_found("on a map", predicted, bench.variance_and_rays(Paths::OnMap(&map)));
}

#[test]
fn a_trial_predicts_what_paths_cost_in_a_cube() {
    let scene = diffuse_cube(&[(0.0, 0.0), (0.5, 0.5), (0.9, 0.2)]);
    assert_predicted("a cube", &scene, None);
    assert_predicted("a cube, five bounces", &scene, Some(5));
    assert_predicted("a cube, twenty bounces", &scene, Some(20));
}

/// Walls that emit are looked for where paths end, cells ask all lamps where paths start, and at
/// mirrors no path ends on a map.
#[test]
fn a_trial_predicts_what_paths_cost_among_lights_and_mirrors() {
    let mut scene = room(DVec3::new(3.0, 4.0, 2.5), diffuse(0.6));
    all_walls_emit(&mut scene, 5.0);
    scene.materials.push(Material { name: "mirror".to_owned(), bsdf: mirror(0.8) });
    scene.mesh.material_of[..2].fill(1);
    for number in 0..12 {
        let x = 0.5 + 0.18 * f64::from(number);
        scene.lights.push(point_light(DVec3::new(x, 2.0, 2.2), 20.0));
    }
    scene.sensors.push(level_grid(DVec3::new(0.5, 0.5, 0.7), [2.0, 3.0], [2, 2]));
    assert_predicted("lights and mirrors", &scene, None);
}

/// Where nothing is known of a map, paths go on as without: they end.
#[test]
fn paths_that_know_nothing_of_a_map_go_alone() {
    let scene = diffuse_cube(&[(0.0, 0.0)]);
    let settings = Settings { connections: crate::settings::Switch::Off, ..Settings::default() };
    let context = Context::<f64>::new(&scene, &settings);
    let mut observer = ();
    let mut watch = Watch::new(&mut observer);
    let sample = Sample::new(&targets(&scene), &exact(&context, &targets(&scene), &mut 0));
    let wanted = ErrorTarget::new(&settings, &sample, vec![1000.0]);
    let none = PilotCost::of_paths(&[], 0.0);
    let paths = PathPilot { records: &PathRecords::default(), recorded: &none, alone: &none };
    let choice = MapPilot::new(&context, &settings, &paths, &wanted, &mut watch);
    let map = choice.unwrap().freeze(&context, vec![0.0], &mut watch).map;
    let place =
        map.layout.locate(&context.world.facet_under(DVec3::new(0.0, 5.0, 5.0), DVec3::X).unwrap());
    assert_eq!(map.end(0).survival_probability(&place, 1.0, 1.0), None);
}
