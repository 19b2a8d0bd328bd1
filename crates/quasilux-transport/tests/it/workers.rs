//! Runs whose blocks are traced elsewhere: the bits are those of a run in one process.

use crate::adaptivity::screened;
use crate::agreement::coloured_room_with_mirror;
use crate::dozen_scenes::{closed, glass_ball};
use crate::scenes::{point_light, points};
use glam::DVec3;
use quasilux_scene::Scene;
use quasilux_transport::{
    EstimatorKind, Observer, Received, Settings, Switch, Workers, simulate, simulate_with_workers,
    trace_blocks,
};
use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::mpsc::{Receiver, Sender, channel};

/// A block for a process, and where what comes of it goes.
struct Task {
    frame: Vec<u8>,
    block: Range<u64>,
    number: usize,
    answer: Sender<Answer>,
}

struct Answer {
    number: usize,
    bytes: Vec<u8>,
}

/// Two threads for two processes, each with a tracer of its own, in no order that means anything:
/// blocks come to either, and a third of them to both.
struct Pair {
    tasks: [Sender<Task>; 2],
    numbers: u64,
    /// Blocks by the kind of their frame, which is behind the digest, and for paths by their role,
    /// which is behind that.
    kinds: BTreeMap<[u8; 2], usize>,
}

impl Pair {
    fn next(&mut self, bound: u64) -> u64 {
        self.numbers =
            self.numbers.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040);
        (self.numbers >> 33) % bound
    }
}

impl Workers for Pair {
    fn min_paths(&self) -> u64 {
        1 << 5
    }

    fn trace(
        &mut self,
        frame: &[u8],
        blocks: &[Range<u64>],
        done: &mut dyn FnMut(Received<'_>) -> bool,
    ) -> bool {
        let kind = if frame[32] == 0 { [0, frame[33]] } else { [frame[32], 0] };
        *self.kinds.entry(kind).or_default() += blocks.len();
        let mut order: Vec<usize> = (0..blocks.len()).collect();
        for i in (1..order.len()).rev() {
            let other = self.next(i as u64 + 1) as usize;
            order.swap(i, other);
        }
        let (answer, answers) = channel();
        for number in order {
            let first = self.next(2) as usize;
            let both = self.next(3) == 0;
            for worker in std::iter::once(first).chain(both.then_some(1 - first)) {
                let (frame, block) = (frame.to_vec(), blocks[number].clone());
                let task = Task { frame, block, number, answer: answer.clone() };
                self.tasks[worker].send(task).expect("the worker lives");
            }
        }
        drop(answer);
        let mut known: BTreeMap<usize, Vec<u8>> = BTreeMap::new();
        for Answer { number, bytes } in answers {
            match known.get(&number) {
                Some(before) => assert!(*before == bytes, "block {number} differs"),
                None => {
                    assert!(done(Received::Nothing));
                    done(Received::Block { number, bytes: &bytes });
                    known.insert(number, bytes);
                }
            }
        }
        known.len() == blocks.len()
    }
}

fn work(scene: &Scene, settings: &Settings, tasks: Receiver<Task>) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread starts");
    pool.install(move || {
        trace_blocks(scene, settings, |tracer| {
            for Task { frame, block, number, answer } in tasks {
                let bytes = tracer.trace(&frame, block).expect("a good block");
                let _ = answer.send(Answer { number, bytes });
            }
        });
    });
}

/// Keeps all states of a run.
struct Keeper(Vec<Vec<u8>>);

impl Observer for Keeper {
    fn piece(&self) -> Option<u64> {
        Some(700)
    }

    fn wants_state(&mut self) -> bool {
        true
    }

    fn state(&mut self, state: &[u8]) {
        self.0.push(state.to_vec());
    }
}

/// Goes on with two workers from states in the middle of a run that had none.
fn check_states(name: &str, scene: &Scene, settings: &Settings, pair: &mut Pair) {
    let mut keeper = Keeper(Vec::new());
    let whole = simulate(scene, settings, &mut keeper);
    let count = keeper.0.len();
    for number in [count / 3, count * 3 / 4] {
        let state = Some(keeper.0[number].as_slice());
        let again = simulate_with_workers(scene, settings, state, &mut (), pair);
        assert!(again.as_ref() == Ok(&Some(whole.clone())), "{name}: state {number} of {count}");
    }
}

/// Runs with two workers, and returns how many blocks of each kind there were.
fn check(name: &str, scene: &Scene, settings: &Settings) -> BTreeMap<[u8; 2], usize> {
    let whole = simulate(scene, settings, &mut ());
    std::thread::scope(|scope| {
        let tasks = [(); 2].map(|()| {
            let (send, tasks) = channel();
            scope.spawn(move || work(scene, settings, tasks));
            send
        });
        let mut pair = Pair { tasks, numbers: 5, kinds: BTreeMap::new() };
        let again = simulate_with_workers(scene, settings, None, &mut (), &mut pair);
        assert!(again == Ok(Some(whole)), "{name}");
        if matches!(name, "photon" | "path" | "connected") {
            check_states(name, scene, settings, &mut pair);
        }
        pair.kinds
    })
}

/// Every kind of block of every estimator, in scenes where parts of the estimators differ: terms,
/// colours, mirrors, maps that grow, converged points, points that bidirectional paths take over.
#[test]
fn workers_change_no_bit() {
    let mut coloured = coloured_room_with_mirror();
    coloured.lights.push(point_light(DVec3::new(2.5, 1.2, 1.5), 400.0));
    coloured.sensors.push(points("points", &[(DVec3::new(1.0, 2.0, 0.7), DVec3::Z)]));
    let mut caustics = glass_ball();
    caustics.lights.push(point_light(DVec3::new(1.3, 1.1, 1.9), 300.0));
    let settings = |estimator, max_samples| Settings {
        estimator,
        replicates: 4,
        max_samples: Some(max_samples),
        rel_tol: 0.004,
        list_terms: 1,
        importance: Switch::Off,
        ..Settings::default()
    };
    let mapped = Settings {
        map_element_m: Some(0.5),
        map_photons: 3,
        ..settings(EstimatorKind::BidirectionalMap, 1 << 11)
    };
    let long = |estimator, samples| Settings { rel_tol: 1e-9, ..settings(estimator, samples) };
    let runs = [
        ("photon", &coloured, settings(EstimatorKind::Photon, 1 << 14)),
        ("path", &coloured, settings(EstimatorKind::Path, 1 << 11)),
        ("connected", &coloured, settings(EstimatorKind::Bidirectional, 1 << 11)),
        ("on maps that grow", &coloured, mapped),
        ("hidden light", &caustics, settings(EstimatorKind::Path, 1 << 10)),
        ("converged", &screened(), settings(EstimatorKind::Auto, 1 << 13)),
        ("long photon", &closed(0.5), long(EstimatorKind::Photon, 1 << 15)),
    ];
    let mut kinds: BTreeMap<[u8; 2], usize> = BTreeMap::new();
    for (name, scene, settings) in runs {
        for (kind, blocks) in check(name, scene, &settings) {
            *kinds.entry(kind).or_default() += blocks;
        }
    }
    assert!(kinds.len() == 5 && kinds.values().all(|blocks| *blocks > 1), "{kinds:?}");
}

/// Workers that give up, and such that answer nonsense.
struct Broken {
    answers: bool,
}

impl Workers for Broken {
    fn trace(
        &mut self,
        _: &[u8],
        blocks: &[Range<u64>],
        done: &mut dyn FnMut(Received<'_>) -> bool,
    ) -> bool {
        self.answers
            && (0..blocks.len()).all(|number| done(Received::Block { number, bytes: &[7, 200, 1] }))
    }
}

#[test]
fn no_result_comes_from_workers_that_fail() {
    let scene = screened();
    let settings = Settings {
        estimator: EstimatorKind::Path,
        max_samples: Some(1 << 14),
        rel_tol: 1e-9,
        ..Settings::default()
    };
    for answers in [false, true] {
        let none = simulate_with_workers(&scene, &settings, None, &mut (), &mut Broken { answers });
        assert_eq!(none, Ok(None));
    }
}

/// Frames and ranges of any origin are refused or traced, and never end the worker.
#[test]
fn bad_blocks_are_refused() {
    struct Recorder(Vec<(Vec<u8>, Range<u64>)>);
    impl Workers for Recorder {
        fn trace(
            &mut self,
            frame: &[u8],
            blocks: &[Range<u64>],
            _: &mut dyn FnMut(Received<'_>) -> bool,
        ) -> bool {
            self.0.push((frame.to_vec(), blocks[0].clone()));
            false
        }
    }
    let scene = screened();
    let settings = Settings {
        estimator: EstimatorKind::Path,
        max_samples: Some(1 << 14),
        rel_tol: 1e-9,
        ..Settings::default()
    };
    let mut recorder = Recorder(Vec::new());
    let _ = simulate_with_workers(&scene, &settings, None, &mut (), &mut recorder);
    let (frame, block) = recorder.0.pop().expect("a frame");
    trace_blocks(&scene, &settings, |tracer| {
        for length in 0..frame.len() {
            assert!(tracer.trace(&frame[..length], block.clone()).is_err(), "{length}");
        }
        for range in [3..3, u64::MAX - 1..u64::MAX, 0..1 << 60] {
            assert!(tracer.trace(&frame, range.clone()).is_err(), "{range:?}");
        }
        // A few changed bytes: what comes of them is not said.
        for place in 32..frame.len() {
            for value in [0, 1, 0x7f, 0xff] {
                let mut changed = frame.clone();
                changed[place] = value;
                let _ = tracer.trace(&changed, 0..1);
            }
        }
        assert!(tracer.trace(&frame, block.clone()).is_ok());
    });
}
