//! The run over a year: block by block of points, in each state of the blinds.

use super::results::{PointOfYear, YearProgress, YearWork};
use super::state::{State, StateHours};
use crate::context::Context;
use crate::control::observer::Control;
use crate::sensors::targets;
use crate::settings::Settings;
use crate::spectrum::{Spectrum, is_grey};
use quasilux_scene::{Environment, Rgb, Scene};
use quasilux_sky::{Distribution, Sky, SkyLevel, WeatherSky};
use rayon::prelude::*;
use std::f64::consts::PI;
use std::ops::Range;

/// Points of a block: with 16 replicates they take some tens of megabytes.
const BLOCK: usize = 64;

/// The hours of a year.
#[derive(Clone, Copy, Debug)]
pub struct YearHours<'h> {
    /// Sky and sun, hour by hour.
    pub skies: &'h [WeatherSky],
    /// Rooms that blinds make of the scene where they are not all open, no two of them in one hour.
    pub other_rooms: &'h [OtherRoom<'h>],
}

/// Hours in which blinds make another room of a scene.
#[derive(Clone, Copy, Debug)]
pub struct OtherRoom<'h> {
    /// The room, with the same sensors and the same environment.
    pub scene: &'h Scene,
    /// Whether it is the room, by hour.
    pub is_own: &'h [bool],
}

/// A year of hours at sensor points of a scene, with daylight alone: its lights are off.
pub struct YearRun<'y, T> {
    /// Its environment says where north is, what the ground reflects and where the openings are;
    /// its sky and its sun do not count.
    pub scene: &'y Scene,
    /// The hours.
    pub hours: YearHours<'y>,
    /// Numbers of points through all sensors; those behind the last do not count. What a point gets
    /// does not depend on which others are simulated with it, so that a year can be spread and put
    /// together again.
    pub points: Range<usize>,
    /// Each point gets paths until the root mean square over the hours of half-width over value is
    /// within `rel_tol`, or up to `max_samples`: in each of the rooms. Where
    /// `abs_tol_lx` is more than that tolerance of a value, it is what the hour is held to.
    pub settings: &'y Settings,
    /// Makes of each point what is to be kept, in the threads of the rayon pool that the run is
    /// made in.
    pub digest: &'y (dyn Fn(PointOfYear) -> T + Sync),
    /// Told many times a second, in the same threads, what share of the work seems to be over:
    /// where it says no, the run ends without the block that it is at.
    pub goes_on: &'y (dyn Fn(f64) -> bool + Sync),
}

/// Who follows a year.
pub trait YearObserver<T> {
    /// Gets what was made of each point, in their order.
    fn keep(&mut self, kept: T);

    /// Says whether to go on after a block of points, all of which are kept.
    fn progress(&mut self, progress: YearProgress) -> Control;
}

/// Keeps all, and goes on to the end.
impl<T> YearObserver<T> for Vec<T> {
    fn keep(&mut self, kept: T) {
        self.push(kept);
    }

    fn progress(&mut self, _progress: YearProgress) -> Control {
        Control::Continue
    }
}

/// Simulates a year, block by block. The result is a function of scene, hours and settings.
pub fn simulate_year<T: Send>(run: YearRun<'_, T>, observer: &mut dyn YearObserver<T>) -> YearWork {
    let YearRun { scene, hours, .. } = run;
    let Some(environment) = &scene.environment else { return YearWork::default() };
    let others = hours.other_rooms.iter().filter(|room| room.is_own.contains(&true));
    let others: Vec<(Scene, &[bool])> =
        others.map(|room| (lit(room.scene, environment), room.is_own)).collect();
    let mut is_open = vec![true; hours.skies.len()];
    for (_, is_own) in &others {
        is_open.iter_mut().zip(*is_own).for_each(|(open, own)| *open &= !own);
    }
    let open = lit(scene, environment);
    let rooms: Vec<Room<'_>> = [Room { scene: &open, is_own: &is_open }]
        .into_iter()
        .chain(others.iter().map(|(scene, is_own)| Room { scene, is_own }))
        .collect();
    if rooms.iter().all(|room| is_grey(room.scene)) {
        simulate::<f64, T>(environment, &rooms, run, observer)
    } else {
        simulate::<Rgb, T>(environment, &rooms, run, observer)
    }
}

/// A scene under an even sky, without lights: 1 cd/m2 everywhere, an illuminance of pi, which a
/// white ground turns into 1 cd/m2 again.
pub(super) fn lit(scene: &Scene, environment: &Environment) -> Scene {
    let level = SkyLevel::HorizontalIlluminance { lx: PI };
    let sky = Sky::new(Distribution::uniform(), level).expect("a level that a sky may have");
    let environment =
        Environment { sky, sun: None, ground_reflectance: 1.0, ..environment.clone() };
    Scene { lights: Vec::new(), environment: Some(environment), ..scene.clone() }
}

/// A room as blinds make it, and its hours.
#[derive(Clone, Copy)]
struct Room<'r> {
    scene: &'r Scene,
    is_own: &'r [bool],
}

/// The first of the rooms is the one with open blinds.
fn simulate<S: Spectrum, T: Send>(
    environment: &Environment,
    rooms: &[Room<'_>],
    run: YearRun<'_, T>,
    observer: &mut dyn YearObserver<T>,
) -> YearWork {
    let YearRun { scene, hours, points, settings, digest, goes_on } = run;
    let skies = hours.skies;
    let targets = targets(scene);
    let points = points.start.min(targets.len())..points.end.min(targets.len());
    let contexts: Vec<Context<'_, S>> =
        rooms.iter().map(|room| Context::new(room.scene, settings)).collect();
    let state = |(number, context)| {
        let Room { is_own, .. } = rooms[number];
        let hours = StateHours { environment, skies, is_own, has_sun_of_all: number == 0 };
        State::new(context, hours, settings, &targets)
    };
    let states: Vec<State<'_, S>> = contexts.iter().enumerate().map(state).collect();
    let mut work = YearWork { is_complete: points.is_empty(), ..YearWork::default() };
    for first in points.clone().step_by(BLOCK) {
        let own = &targets[first..(first + BLOCK).min(points.end)];
        let blank = |number| PointOfYear::blank(first + number, settings, skies.len());
        let mut years: Vec<PointOfYear> = (0..own.len()).map(blank).collect();
        let share = |of_block: f64| {
            let over = (first - points.start) as f64 + of_block * own.len() as f64;
            over / points.len().max(1) as f64
        };
        for (number, state) in states.iter().enumerate() {
            let share = |of_state: f64| share((number as f64 + of_state) / states.len() as f64);
            let goes_on = |of_state: f64| goes_on(share(of_state));
            let points = state.simulate(first, own, &mut work, &goes_on);
            if !goes_on(1.0) {
                return work;
            }
            state.add_to(&points, &mut years);
        }
        let kept: Vec<T> = years.into_par_iter().map(digest).collect();
        kept.into_iter().for_each(|kept| observer.keep(kept));
        let over = first + own.len();
        work.is_complete = over == points.end;
        let said = observer.progress(YearProgress { over, of: points.end, work });
        if said == Control::Stop || !goes_on(share(1.0)) {
            break;
        }
    }
    work
}
