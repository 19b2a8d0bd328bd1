//! The run over a year: block by block of points, in each state of the blinds.

use super::results::{PointOfYear, YearProgress, YearWork};
use super::state::{State, StateHours};
use crate::context::Context;
use crate::settings::Settings;
use crate::spectrum::{Spectrum, is_grey};
use crate::stats::observer::Control;
use crate::stats::targets::targets;
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
    /// What shines, hour by hour.
    pub skies: &'h [WeatherSky],
    /// `None` where blinds are never closed.
    pub closed: Option<ClosedHours<'h>>,
}

/// Hours in which blinds are closed.
#[derive(Clone, Copy, Debug)]
pub struct ClosedHours<'h> {
    /// The scene then, with the same sensors and the same environment.
    pub scene: &'h Scene,
    /// Whether they are, by hour.
    pub is_closed: &'h [bool],
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
    /// within `rel_tol`, or up to `max_samples`: both with open and with closed blinds. Where
    /// `abs_tol_lx` is more than that tolerance of a value, it is what the hour is held to.
    pub settings: &'y Settings,
    /// Makes of each point what is to be kept, in the threads of the rayon pool that the run is
    /// made in.
    pub digest: &'y (dyn Fn(PointOfYear) -> T + Sync),
    /// Asked many times a second, in the same threads: where it says no, the run ends without the
    /// block that it is at.
    pub goes_on: &'y (dyn Fn() -> bool + Sync),
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
    let closed = hours.closed.filter(|closed| closed.is_closed.contains(&true));
    let open = lit(scene, environment);
    let closed_scene = closed.map(|closed| lit(closed.scene, environment));
    let room = Room { environment, open: &open, closed: closed_scene.as_ref() };
    let run = YearRun { hours: YearHours { closed, ..hours }, ..run };
    if is_grey(&open) && closed_scene.as_ref().is_none_or(is_grey) {
        simulate::<f64, T>(room, run, observer)
    } else {
        simulate::<Rgb, T>(room, run, observer)
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

/// A room in its states.
#[derive(Clone, Copy)]
struct Room<'r> {
    environment: &'r Environment,
    open: &'r Scene,
    closed: Option<&'r Scene>,
}

fn simulate<S: Spectrum, T: Send>(
    room: Room<'_>,
    run: YearRun<'_, T>,
    observer: &mut dyn YearObserver<T>,
) -> YearWork {
    let Room { environment, open, closed } = room;
    let YearRun { hours, points, settings, digest, goes_on, .. } = run;
    let YearHours { skies, closed: closed_hours } = hours;
    let is_closed = closed_hours.map_or(vec![false; skies.len()], |it| it.is_closed.to_vec());
    let is_open: Vec<bool> = is_closed.iter().map(|is_closed| !is_closed).collect();
    let targets = targets(open);
    let points = points.start.min(targets.len())..points.end.min(targets.len());
    let [open, closed] =
        [Some(open), closed].map(|it| it.map(|it| Context::<S>::new(it, settings)));
    let of_open = StateHours { environment, skies, is_own: &is_open, has_sun_of_all: true };
    let of_closed = StateHours { is_own: &is_closed, has_sun_of_all: false, ..of_open };
    let open = open.as_ref().map(|context| State::new(context, of_open, settings, &targets));
    let closed = closed.as_ref().map(|context| State::new(context, of_closed, settings, &targets));
    let states: Vec<State<'_, S>> = open.into_iter().chain(closed).collect();
    let mut work = YearWork { is_complete: points.is_empty(), ..YearWork::default() };
    for first in points.clone().step_by(BLOCK) {
        let own = &targets[first..(first + BLOCK).min(points.end)];
        let blank = |number| PointOfYear::blank(first + number, settings, skies.len());
        let mut years: Vec<PointOfYear> = (0..own.len()).map(blank).collect();
        for state in &states {
            let points = state.simulate(first, own, &mut work, goes_on);
            if !goes_on() {
                return work;
            }
            state.add_to(&points, &mut years);
        }
        let kept: Vec<T> = years.into_par_iter().map(digest).collect();
        kept.into_iter().for_each(|kept| observer.keep(kept));
        let over = first + own.len();
        work.is_complete = over == points.end;
        let said = observer.progress(YearProgress { over, of: points.end, work });
        if said == Control::Stop || !goes_on() {
            break;
        }
    }
    work
}
