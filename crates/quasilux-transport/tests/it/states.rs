//! Runs that are kept, gone on with, cut and put together: the bits are always those of one run.

use crate::adaptivity::screened;
use crate::agreement::coloured_room_with_mirror;
use crate::dozen_scenes::{closed, glass_ball};
use crate::images::add_panel;
use crate::scenes::{mirror, point_light, points};
use glam::DVec3;
use quasilux_scene::{Camera, Scene};
use quasilux_transport::{
    Control, Estimates, EstimatorKind, MergeError, Observer, Progress, Settings, Switch, decide,
    merge, resume, simulate, trace_part,
};
use std::ops::Range;

/// Keeps all states of a run, or stops it after one.
struct Keeper {
    piece: u64,
    states: Vec<Vec<u8>>,
    /// How many progresses are waited for, once there is a state, before the run is stopped.
    patience: Option<u64>,
}

impl Keeper {
    fn new(piece: u64) -> Self {
        Self { piece, states: Vec::new(), patience: None }
    }
}

impl Observer for Keeper {
    fn piece(&self) -> Option<u64> {
        Some(self.piece)
    }

    fn wants_state(&mut self) -> bool {
        true
    }

    fn state(&mut self, state: &[u8]) {
        self.states.push(state.to_vec());
    }

    fn progress(&mut self, _: &Progress) -> Control {
        match &mut self.patience {
            None => Control::Continue,
            Some(0) => Control::Stop,
            // Before that the run is made ready.
            Some(_) if self.states.is_empty() => Control::Continue,
            Some(patience) => {
                *patience -= 1;
                Control::Continue
            }
        }
    }
}

/// Numbers that look random (Knuth's MMIX generator).
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, bound: usize) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % bound
    }

    fn shuffle<T>(&mut self, things: &mut [T]) {
        for i in (1..things.len()).rev() {
            things.swap(i, self.below(i + 1));
        }
    }
}

/// Its survey is most of the time of these tests.
const GUIDED: &str = "photon, guided";

/// A run of each kind: its name, scene and settings.
fn runs() -> Vec<(&'static str, Scene, Settings)> {
    let mut coloured = coloured_room_with_mirror();
    coloured.lights.push(point_light(DVec3::new(2.5, 1.2, 1.5), 400.0));
    coloured.cameras.push(Camera {
        name: "view".to_owned(),
        position: DVec3::new(0.5, 0.5, 1.0),
        target: DVec3::new(3.0, 2.0, 1.0),
        up: DVec3::Z,
        vertical_fov_rad: 1.0,
        resolution: [4, 3],
        samples: None,
        rel_tol: None,
    });
    let mut with_points = coloured.clone();
    with_points.sensors.push(points("points", &[(DVec3::new(1.0, 2.0, 0.7), DVec3::Z)]));
    let bidirectional = with_points.clone();
    let mut caustics = glass_ball();
    caustics.lights.push(point_light(DVec3::new(1.3, 1.1, 1.9), 300.0));
    let settings = |estimator| Settings {
        estimator,
        replicates: 3,
        max_samples: Some(32),
        rel_tol: 1e-9,
        ..Settings::default()
    };
    let photon = Settings {
        max_samples: Some(900),
        list_terms: 2,
        map_element_m: Some(1.0),
        importance: Switch::Off,
        ..settings(EstimatorKind::Photon)
    };
    let guided = Settings { importance: Switch::On, ..photon.clone() };
    let listing = |estimator| Settings { list_terms: 2, ..settings(estimator) };
    let grown = Settings {
        map_adaptive: false,
        map_element_m: Some(0.5),
        map_photons: 3,
        importance: Switch::Off,
        ..settings(EstimatorKind::BidirectionalMap)
    };
    let of_hidden = Settings { max_bounces: Some(3), ..settings(EstimatorKind::Path) };
    vec![
        ("photon", coloured.clone(), photon),
        (GUIDED, coloured, guided),
        ("path", with_points.clone(), listing(EstimatorKind::Path)),
        ("on maps that grow", with_points, grown),
        ("hidden light", caustics, of_hidden),
        ("bidirectional", bidirectional, listing(EstimatorKind::Bidirectional)),
    ]
}

/// Every state of every phase leads to the same end, and none of them disturbs the run.
#[test]
fn a_run_goes_on_from_any_of_its_states() {
    for (name, scene, settings) in runs() {
        let whole = simulate(&scene, &settings, &mut ());
        let mut keeper = Keeper::new(100);
        assert_eq!(simulate(&scene, &settings, &mut keeper), whole, "{name}");
        let count = keeper.states.len();
        assert!(count > 8, "{name}: {count} states");
        // All kinds of places, the first and the last among them.
        let steps = if name == GUIDED { 1 } else { 4 };
        for number in (0..count).step_by((count / steps).max(1)).chain([count - 1]) {
            let again = resume(&scene, &settings, &keeper.states[number], &mut ());
            assert_eq!(again.as_ref(), Ok(&whole), "{name}: state {number} of {count}");
        }
    }
}

/// Stopped again and again, with a state each time, a run comes to the same end; stopped right
/// after it has gone on, it has the results of its last checkpoint.
#[test]
fn a_run_that_is_stopped_loses_nothing() {
    for (name, scene, settings) in runs() {
        if name == GUIDED {
            continue;
        }
        let whole = simulate(&scene, &settings, &mut ());
        let mut keeper = Keeper { patience: Some(3), ..Keeper::new(200) };
        let mut estimates = simulate(&scene, &settings, &mut keeper);
        let (mut rounds, mut stopped_at) = (0, 0);
        while estimates.samples < whole.samples || !keeper.states.is_empty() && rounds == 0 {
            assert!(estimates.samples >= stopped_at, "{name}");
            stopped_at = estimates.samples;
            let state = keeper.states.last().expect("a state is kept before a run stops").clone();
            keeper = Keeper { patience: Some(7), ..Keeper::new(200) };
            estimates = resume(&scene, &settings, &state, &mut keeper).expect("a good state");
            rounds += 1;
            assert!(rounds < 1000, "{name}: no progress");
        }
        let state = keeper.states.last().expect("a state of the end");
        assert_eq!(resume(&scene, &settings, state, &mut ()).as_ref(), Ok(&whole), "{name}");
    }
}

/// Points that were done before the run was stopped stay as they are, the others go on; and what is
/// predicted, and where a limit on rays ends the run, hangs on all that came before.
#[test]
fn points_that_are_done_stay_done() {
    let mut mirrored = screened();
    add_panel(&mut mirrored, DVec3::new(0.0, 2.9, 0.5), DVec3::X, DVec3::Z, mirror(0.9));
    let settings = |estimator| Settings {
        estimator,
        rel_tol: 0.2,
        replicates: 8,
        list_terms: 1,
        image_depth: Some(0),
        ..Settings::default()
    };
    let of_map = settings(EstimatorKind::BidirectionalMap);
    for (name, scene, settings) in [
        ("hidden light", mirrored, settings(EstimatorKind::Path)),
        ("on maps that grow", screened(), Settings { rel_tol: 0.1, ..of_map }),
        ("auto", screened(), Settings { rel_tol: 0.05, ..settings(EstimatorKind::Auto) }),
    ] {
        let whole = simulate(&scene, &settings, &mut ());
        let samples: Vec<u64> = whole.sensors.iter().flat_map(|s| s.samples.clone()).collect();
        let some_are_done = samples.iter().any(|samples| *samples < whole.samples);
        let has_slope = whole.convergence.slope.is_some();
        assert!(some_are_done && has_slope, "{name}: {samples:?}");
        goes_on_to(&whole, &scene, &settings, name);
        let limited = Settings { max_rays: Some(whole.rays - 1), ..settings };
        let before = simulate(&scene, &limited, &mut ());
        assert!(before.samples < whole.samples, "{name}");
        goes_on_to(&before, &scene, &limited, name);
    }
}

/// From some states of its last third, where most of the work is that follows the last checkpoints.
fn goes_on_to(whole: &Estimates, scene: &Scene, settings: &Settings, name: &str) {
    let mut keeper = Keeper::new((whole.rays / 64).max(64));
    assert_eq!(&simulate(scene, settings, &mut keeper), whole, "{name}");
    let count = keeper.states.len();
    assert!(count > 8, "{name}: {count} states");
    for number in [count * 3 / 4, count - 2] {
        let again = resume(scene, settings, &keeper.states[number], &mut ());
        assert_eq!(again.as_ref(), Ok(whole), "{name}: state {number} of {count}");
    }
}

fn parts_of(scene: &Scene, settings: &Settings, samples: u64, bounds: &[u64]) -> Vec<Vec<u8>> {
    let range = |pair: &[u64]| -> Range<u64> { pair[0]..pair[1] };
    bounds
        .windows(2)
        .map(|pair| {
            trace_part(scene, settings, samples, range(pair), &mut ()).expect("not stopped")
        })
        .collect()
}

fn merged(
    scene: &Scene,
    settings: &Settings,
    samples: u64,
    parts: &[Vec<u8>],
) -> Result<Estimates, MergeError> {
    let parts: Vec<&[u8]> = parts.iter().map(Vec::as_slice).collect();
    merge(scene, settings, samples, &parts, &mut ())
}

/// One part, three, sixteen at random bounds, merged in random order; and the values are those of a
/// plain run, whose intervals are wider for having been looked at before.
#[test]
fn parts_make_the_same_run_however_it_is_cut() {
    let mut numbers = Numbers(7);
    for (name, scene, settings) in runs() {
        if name == GUIDED {
            continue;
        }
        let samples = settings.max_samples.expect("a number of samples");
        let whole = merged(
            &scene,
            &settings,
            samples,
            &parts_of(&scene, &settings, samples, &[0, samples]),
        );
        let whole = whole.expect("a good part");
        assert_eq!((whole.samples, whole.miss_probability), (samples, 1.0 - settings.confidence));
        // Surveys and pilots are most of the time of so small parts.
        let many = matches!(name, "photon" | "path" | "connected");
        for count in if many { vec![3, 16] } else { vec![3] } {
            let mut inner: Vec<u64> = (1..samples).collect();
            numbers.shuffle(&mut inner);
            let mut bounds = [&[0, samples], &inner[..count - 1]].concat();
            bounds.sort_unstable();
            let mut parts = parts_of(&scene, &settings, samples, &bounds);
            numbers.shuffle(&mut parts);
            let again = merged(&scene, &settings, samples, &parts);
            assert_eq!(again.as_ref(), Ok(&whole), "{name}: {count} parts");
        }
        let plain = simulate(&scene, &settings, &mut ());
        let mut values = whole.sensors.iter().zip(&plain.sensors);
        // Caustic light is read from photons so far: a run that stops on its way reads fewer. And
        // in parts bidirectional paths take nothing over.
        let differs = matches!(name, "hidden light" | "auto");
        assert!(differs || values.all(|(a, b)| a == b), "{name}");
    }
}

#[test]
fn a_part_is_a_function_of_its_range_whoever_computes_it() {
    for (name, scene, settings) in runs() {
        let part = || trace_part(&scene, &settings, 40, 7..23, &mut ()).expect("not stopped");
        let [one, seven] = [1, 7].map(|threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            pool.expect("threads start").install(part)
        });
        assert!(one == seven, "{name}");
        assert_eq!(decide(&scene, &settings), decide(&scene, &settings), "{name}");
        let mut stopped = Keeper { patience: Some(0), ..Keeper::new(100) };
        assert_eq!(trace_part(&scene, &settings, 40, 7..23, &mut stopped), None, "{name}");
    }
}

#[test]
fn parts_and_states_of_other_runs_are_refused() {
    let runs = runs();
    for (name, scene, settings) in runs.iter().filter(|(name, ..)| *name != GUIDED) {
        let other = Settings { seed: 2, ..settings.clone() };
        let parts = parts_of(scene, settings, 40, &[0, 20, 40]);
        let foreign = parts_of(scene, &other, 40, &[20, 40]);
        let mixed = [parts[0].clone(), foreign[0].clone()];
        let refused = merged(scene, settings, 40, &mixed).map(|_| ());
        assert_eq!(refused, Err(MergeError::Foreign { part: 1 }), "{name}");
    }
    let (_, scene, settings) = &runs[2];
    let mut keeper = Keeper::new(1000);
    let _ = simulate(scene, settings, &mut keeper);
    let state = keeper.states.last().expect("a state");
    for (name, scene, settings) in &runs[3..6] {
        let refused = resume(scene, settings, state, &mut ()).is_err();
        assert!(refused, "{name}");
    }
}

/// Each index has to be in one part and in one alone, all parts of one scene and one number of
/// samples.
#[test]
fn parts_with_gaps_and_overlaps_are_refused() {
    let scene = closed(0.5);
    let settings = Settings { replicates: 2, ..Settings::default() };
    let part = |range: Range<u64>| -> Vec<u8> {
        trace_part(&scene, &settings, 40, range, &mut ()).expect("not stopped")
    };
    let [first, middle, last] = [0..10, 10..25, 25..40].map(part);
    let refused = |parts: &[&Vec<u8>]| -> Result<(), MergeError> {
        let parts: Vec<&[u8]> = parts.iter().map(|part| part.as_slice()).collect();
        merge(&scene, &settings, 40, &parts, &mut ()).map(|_| ())
    };
    assert_eq!(refused(&[&last, &first, &middle]), Ok(()));
    assert_eq!(refused(&[&last, &part(10..10), &first, &middle]), Ok(()));
    let gap = |missing: Range<u64>| Err(MergeError::Gap { missing });
    assert_eq!(refused(&[]), gap(0..40));
    assert_eq!(refused(&[&first, &middle]), gap(25..40));
    assert_eq!(refused(&[&last, &middle]), gap(0..10));
    assert_eq!(refused(&[&last, &first]), gap(10..25));
    let overlap = |parts, index| Err(MergeError::Overlap { parts, index });
    assert_eq!(refused(&[&first, &middle, &last, &middle]), overlap([1, 3], 10));
    assert_eq!(refused(&[&first, &part(9..25), &last]), overlap([0, 1], 9));
    let longer = trace_part(&scene, &settings, 41, 10..25, &mut ()).expect("not stopped");
    assert_eq!(refused(&[&first, &longer, &last]), Err(MergeError::Foreign { part: 1 }));
    let brighter = closed(0.6);
    let other = trace_part(&brighter, &settings, 40, 25..40, &mut ()).expect("not stopped");
    assert_eq!(refused(&[&first, &middle, &other]), Err(MergeError::Foreign { part: 2 }));
    // A range that a changed file claims, a byte for each end, past the two digests.
    let mut claims = last.clone();
    assert_eq!(claims[64..66], [25, 40]);
    claims[65] = 41;
    let (range, samples) = (25..41, 40);
    let wrong = MergeError::Range { part: 2, range, samples };
    assert_eq!(refused(&[&first, &middle, &claims]), Err(wrong.clone()));
    assert_eq!(wrong.to_string(), "part 2 has the indices from 25 to before 41, of 40");
}

/// What a resealed file may say: the right decisions, and rows for another number of replicates or
/// of terms.
#[test]
fn states_whose_rows_do_not_fit_are_refused() {
    let (scene, settings) = runs()
        .into_iter()
        .find_map(|(name, scene, settings)| (name == "path").then_some((scene, settings)))
        .expect("a run of paths");
    let mut keeper = Keeper::new(1000);
    let whole = simulate(&scene, &settings, &mut keeper);
    let state = keeper.states.last().expect("a state after a checkpoint");
    assert_eq!(resume(&scene, &settings, state, &mut ()).as_ref(), Ok(&whole));
    for replicates in [1, 2, 4, 400].into_iter().filter(|count| *count != settings.replicates) {
        let other = Settings { replicates, ..settings.clone() };
        assert!(resume(&scene, &other, state, &mut ()).is_err(), "{replicates} replicates");
    }
    for list_terms in [0, 1, 3, 4].into_iter().filter(|terms| *terms != settings.list_terms) {
        let other = Settings { list_terms, ..settings.clone() };
        assert!(resume(&scene, &other, state, &mut ()).is_err(), "{list_terms} terms");
    }
}

/// Truncations and changed bits, without the digest over all bytes that files have: errors or other
/// numbers, never a panic, and no more memory than the bytes say.
#[test]
fn damage_is_no_panic() {
    let mut numbers = Numbers(11);
    let settings = |estimator| Settings {
        estimator,
        replicates: 2,
        max_samples: Some(4),
        map_element_m: Some(2.0),
        importance: Switch::Off,
        list_terms: 1,
        ..Settings::default()
    };
    for (estimator, times) in [
        (EstimatorKind::Photon, 45),
        (EstimatorKind::Path, 45),
        (EstimatorKind::Auto, 24),
        (EstimatorKind::BidirectionalMap, 9),
    ] {
        let (scene, settings) = (closed(0.5), settings(estimator));
        let mut keeper = Keeper::new(10);
        let _ = simulate(&scene, &settings, &mut keeper);
        let state = keeper.states.swap_remove(keeper.states.len() / 2);
        let part = trace_part(&scene, &settings, 4, 0..4, &mut ()).expect("not stopped");
        for number in 0..times {
            let damage = |bytes: &[u8], numbers: &mut Numbers| {
                let mut bytes = bytes.to_vec();
                // Past the digest of the decisions.
                let at = 32 + numbers.below(bytes.len() - 32);
                if number % 3 == 0 {
                    bytes.truncate(at);
                } else {
                    bytes[at] ^= 1 << numbers.below(8);
                }
                bytes
            };
            let damaged = damage(&state, &mut numbers);
            let is_cut = damaged.len() < state.len();
            let outcome = resume(&scene, &settings, &damaged, &mut ());
            assert!(!is_cut || outcome.is_err(), "{estimator:?}: {number}");
            let damaged = damage(&part, &mut numbers);
            let outcome = merge(&scene, &settings, 4, &[&damaged], &mut ());
            assert!(!is_cut || outcome.is_err(), "{estimator:?}: {number}");
        }
    }
}
