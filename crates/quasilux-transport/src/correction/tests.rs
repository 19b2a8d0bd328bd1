//! What a trial foretells of paths that end by chance, against such paths.

use super::*;
use crate::choice::{Promise, SAMPLES, Sample, Trial, Wanted};
use crate::gathering::exact;
use crate::path_end::Rest;
use crate::path_wave::PathWave;
use crate::sections::{Section, trace_sections};
use crate::settings::Settings;
use crate::stage::{Stage, Stream};
use crate::tally::Quantum;
use crate::targets::targets;
use crate::watch::Watch;
use quasilux_sampling::{Randomization, Sequence};
use scenes::diffuse_cube;

#[expect(dead_code, reason = "other scenes are for other tests")]
#[path = "../../tests/it/scenes.rs"]
mod scenes;

#[test]
fn light_on_the_map_fits_into_the_bounces_that_are_left() {
    assert_eq!(bounces_left(None, 7), Some(u32::MAX));
    assert_eq!([0, 1, 2].map(|b| bounces_left(Some(3), b)), [Some(2), Some(1), None]);
    assert_eq!([0, 1].map(|b| bounces_left(Some(100), b)), [Some(99), None]);
    assert_eq!(bounces_left(Some(1), 0), None);
}

/// How paths go.
#[derive(Clone, Copy)]
enum Paths<'m> {
    Noted,
    Alone,
    OnMap(&'m FrozenMap<f64>),
}

/// Means over so many replicates know variances to 8 %.
const REPLICATES: u32 = 300;

/// Random points, whose variance falls with the number of paths and by nothing else. A trial of a few hundred paths is
/// itself only good to some tens of percent in variances, which have long tails, and to a few percent in rays.
#[test]
fn a_trial_foretells_what_paths_cost() {
    let scene = diffuse_cube(&[(0.0, 0.0), (0.5, 0.5), (0.9, 0.2)]);
    let settings = Settings {
        sequence: Sequence::Random,
        randomization: Randomization::None,
        ..Settings::default()
    };
    let stage = Stage::<f64>::new(&scene, &settings);
    let quantum = Quantum::for_reference(stage.lights.reference_lx(&stage.world));
    let targets = targets(&scene);
    let sample = Sample::new(&targets, &exact(&stage, &targets, &mut 0));
    let (trial, walks) = Trial::of_noted_paths(&stage, &sample, quantum);
    let found_lx = |target: usize| sample.exact_lx[target] + trial.moments(target).mean;
    let wanted = Wanted::new(&settings, (0..targets.len()).map(found_lx).collect());
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;

    // What chances add is told apart from the spread of the paths themselves.
    let variance_and_rays = |paths: Paths<'_>| {
        let (mut variances, mut rays) = (Vec::new(), 0);
        for (number, &target) in targets.iter().enumerate() {
            let values: Vec<f64> = (0..REPLICATES)
                .map(|r| {
                    let points = stage.points(r, Stream::Paths(number as u64));
                    let indices = 0..SAMPLES;
                    let rest = match paths {
                        Paths::Noted => Rest::Noted,
                        Paths::Alone => Rest::Path,
                        Paths::OnMap(map) => Rest::Frozen(map.end(number)),
                    };
                    let (hidden, joining) = (None, None);
                    let section =
                        Section { number, target, points, rest, hidden, joining, indices };
                    let piece =
                        trace_sections(&stage, &[section], quantum, &mut PathWave::default());
                    rays += piece.work.rays;
                    let lx = quantum.value(piece.sums[0].indirect) / SAMPLES as f64;
                    lx * wanted.worth_per_lx(number)
                })
                .collect();
            let middle = mean(&values);
            let squares = values.iter().map(|v| (v - middle) * (v - middle)).sum::<f64>();
            variances.push(squares / f64::from(REPLICATES - 1));
        }
        let trials = f64::from(REPLICATES) / crate::choice::REPLICATES.len() as f64;
        (mean(&variances), rays as f64 / trials)
    };
    let (of_noted, rays_noted) = variance_and_rays(Paths::Noted);
    let assert_foretold = |foretold: (f64, f64), found: (f64, f64), what: &str| {
        let ratios = [foretold.0 / (found.0 - of_noted), foretold.1 / found.1];
        println!("{what}: {ratios:?}");
        assert!((0.6..1.6).contains(&ratios[0]), "{what}: {foretold:?} {found:?} {of_noted}");
        assert!((0.93..1.07).contains(&ratios[1]), "{what}: {foretold:?} {found:?}");
    };
    assert!((rays_noted / trial.rays - 1.0).abs() < 0.1);

    let alone = walks.alone(trial.rays, &wanted);
    let found = variance_and_rays(Paths::Alone);
    assert_foretold((mean(&alone.of_chances), alone.rays), found, "alone");

    let nothing = vec![0.0; targets.len()];
    let noted = Promise::of_paths(&nothing, trial.rays);
    let plain: Vec<f64> = alone.of_chances.clone();
    let plain = Promise::of_paths(&plain, alone.rays);
    let mut observer = ();
    let mut watch = Watch::new(&mut observer);
    let promises = (&walks, &noted, &plain);
    let choice = Choice::new(&stage, &settings, promises, &wanted, &mut watch).unwrap();
    let foretold = (mean(&choice.variances), choice.rays);
    let worth = (0..targets.len()).map(|target| wanted.worth_per_lx(target)).collect();
    let (map, _) = choice.freeze(&stage, worth, &mut watch);
    let found = variance_and_rays(Paths::OnMap(&map));
    assert_foretold(foretold, found, "on a map");
}
