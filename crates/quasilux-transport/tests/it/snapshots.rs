//! What an observer sees between checkpoints.

use crate::agreement::coloured_room_with_mirror;
use crate::scenes::points;
use glam::DVec3;
use quasilux_scene::Scene;
use quasilux_transport::{
    Control, Estimates, EstimatorKind, Observer, Progress, Reconstruction, Settings, Snapshot,
    simulate,
};

/// Keeps all snapshots of a run.
#[derive(Default)]
struct Album {
    /// Each with the indices per replicate of the checkpoint before.
    pictures: Vec<(u64, Snapshot)>,
    checkpoint: u64,
    /// The last snapshot before each checkpoint, and the checkpoint.
    ends: Vec<(Snapshot, Estimates)>,
}

impl Album {
    /// What came after the checkpoint at this many indices per replicate and before the next.
    fn between(&self, checkpoint: u64) -> Vec<&Snapshot> {
        let own = self.pictures.iter().filter(|(at, _)| *at == checkpoint);
        own.map(|(_, snapshot)| snapshot).collect()
    }
}

impl Observer for Album {
    fn wants_snapshot(&mut self) -> bool {
        true
    }

    fn snapshot(&mut self, snapshot: &Snapshot) {
        self.pictures.push((self.checkpoint, snapshot.clone()));
    }

    fn progress(&mut self, progress: &Progress) -> Control {
        assert_eq!(progress.samples, self.checkpoint);
        Control::Continue
    }

    fn checkpoint(&mut self, estimates: &Estimates) -> Control {
        let (_, last) = self.pictures.last().expect("somebody looked before the checkpoint");
        self.ends.push((last.clone(), estimates.clone()));
        self.checkpoint = estimates.samples;
        Control::Continue
    }
}

/// Means over the replicates, sensor by sensor.
fn means(estimates: &Estimates) -> Vec<Vec<f64>> {
    let mean = |rows: &[Vec<f64>], point: usize| {
        rows.iter().map(|row| row[point]).sum::<f64>() / rows.len() as f64
    };
    let sensors = estimates.sensors.iter().map(|sensor| &sensor.replicate_lx);
    sensors.map(|rows| (0..rows[0].len()).map(|point| mean(rows, point)).collect()).collect()
}

/// The room with points on its floor beside its grid.
fn room() -> Scene {
    let mut scene = coloured_room_with_mirror();
    let places = [0.7, 1.1, 1.6].map(|x| (DVec3::new(x, 0.8, 0.0), DVec3::Z));
    scene.sensors.push(points("floor", &places));
    scene
}

fn settings(estimator: EstimatorKind, samples: u64) -> Settings {
    let max_samples = Some(samples);
    Settings { estimator, replicates: 8, rel_tol: 0.0, max_samples, ..Settings::default() }
}

/// They come between the last two checkpoints, whose samples take several rounds; the last one
/// before a checkpoint is the mean over the replicates there, but for rounding; and those that look
/// get the same bits as those that do not. Values on the way to the last checkpoint, of half the
/// samples or more, are within 5 % of it: their standard errors are below 1 %.
#[test]
fn snapshots_lead_to_the_checkpoints_and_disturb_nothing() {
    let scene = room();
    for (estimator, samples) in [
        (EstimatorKind::Photon, 1 << 17),
        (EstimatorKind::Path, 1 << 13),
        (EstimatorKind::Bidirectional, 1 << 13),
    ] {
        let mut album = Album::default();
        let settings = settings(estimator, samples);
        let watched = simulate(&scene, &settings, &mut album);
        assert_eq!(watched, simulate(&scene, &settings, &mut ()), "{estimator:?}");
        let close = |snapshot: &Snapshot, wanted: &Estimates, tolerance: f64| {
            for (shown, wanted) in
                snapshot.illuminance_lx.iter().flatten().zip(means(wanted).concat())
            {
                let shown = shown.expect("all points were traced");
                let found = format!("{estimator:?}: {shown}, wanted {wanted}");
                assert!((shown - wanted).abs() <= tolerance * wanted, "{found}");
            }
        };
        for (snapshot, estimates) in &album.ends {
            close(snapshot, estimates, 1e-12);
        }
        let on_the_way = album.between(samples / 2);
        assert!(on_the_way.len() > 1, "{estimator:?}: {}", on_the_way.len());
        on_the_way.into_iter().for_each(|snapshot| close(snapshot, &watched, 0.05));
    }
}

/// While photons of maps fly, points on the floor show what the maps have there and others what
/// they had. 2^16 photons in all leave some 7 % of noise on an element of half a metre, and its
/// light varies by as much.
#[test]
fn growing_maps_can_be_read() {
    let scene = room();
    let mut album = Album::default();
    let settings = Settings {
        map_element_m: Some(0.5),
        map_adaptive: false,
        map_reconstruction: Reconstruction::Constant,
        ..settings(EstimatorKind::BidirectionalMap, 1 << 13)
    };
    let watched = simulate(&scene, &settings, &mut album);
    let wanted = means(&watched);
    let coming = album.between(1 << 12);
    let (first, last) = (coming[0], coming[coming.len() - 1]);
    assert_eq!(first.illuminance_lx[0], album.ends[album.ends.len() - 2].0.illuminance_lx[0]);
    assert_ne!(first.illuminance_lx[1], last.illuminance_lx[1]);
    for snapshot in coming {
        for (shown, wanted) in snapshot.illuminance_lx.iter().flatten().zip(wanted.concat()) {
            let shown = shown.expect("all points were traced");
            assert!((shown / wanted - 1.0).abs() < 0.2, "{shown}, wanted {wanted}");
        }
    }
}
