//! The run over a year: blocks of points, each traced until its hours are known well enough.

use super::coefficients::{Meshes, Sums};
use super::hours::HourTable;
use super::paths::TargetReplicate;
use super::sun_disks::{ShiningSun, SunDisks, SunLight};
use crate::context::Context;
use crate::path::wave::PathWave;
use crate::settings::Settings;
use crate::spectrum::{Spectrum, is_grey};
use crate::stats::interval::t_quantile_for;
use crate::stats::observer::Control;
use crate::stats::targets::{Target, targets};
use crate::world::frame::Frame;
use quasilux_scene::{Environment, Rgb, Scene};
use quasilux_sky::{Distribution, Sky, SkyLevel, TabulatedSky, WeatherSky};
use rayon::prelude::*;
use std::f64::consts::PI;

/// Points of a block: with 16 replicates they take some tens of megabytes.
const BLOCK: usize = 64;
/// Paths of each point in each replicate at first, and at most where nobody says.
const FIRST: u64 = 128;
const MOST: u64 = 1 << 16;
/// Half-widths shrink about like N to this power.
const SLOPE: f64 = -0.6;
/// From one look to the next the number of paths grows by this factor at most.
const GROWTH: f64 = 16.0;
/// Hours that say whether a point is known well enough.
const PROBED_HOURS: usize = 256;

/// What the hours of one sensor point are, in all replicates.
#[derive(Clone, Debug)]
pub struct PointOfYear {
    /// The number of the point, through all sensors.
    pub number: usize,
    /// Illuminances in lx by replicate and hour, in the order of the hours that were given.
    pub illuminance_lx: Vec<Vec<f32>>,
    /// The part of them that comes straight from the sun.
    pub sun_lx: Vec<Vec<f32>>,
    /// Paths in each replicate.
    pub samples: u64,
    /// The root mean square over hours of half-width over value; `None` with fewer than two
    /// replicates.
    pub relative_half_width: Option<f64>,
    /// Whether that is within the tolerance.
    pub is_done: bool,
    /// Contributions that could not be added.
    pub invalid: u64,
}

/// How far a run is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct YearProgress {
    /// Points that are over, of how many.
    pub points: [usize; 2],
    /// Rays so far.
    pub rays: u64,
}

/// What a run took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct YearWork {
    /// Rays of all kinds.
    pub rays: u64,
    /// Paths of all points in all replicates.
    pub paths: u64,
    /// Whether it came to its end.
    pub is_complete: bool,
}

/// Simulates hours for all sensor points of a scene, with daylight alone: its lights are off.
///
/// `scene.environment` says where north is, what the ground reflects and where the openings are;
/// its sky and its sun do not count. Each point gets paths until the root mean square over the
/// hours of half-width over value is within `settings.rel_tol`, or up to `settings.max_samples`.
///
/// `digest` makes of each point what is to be kept, in the threads of the rayon pool that the call
/// is made in; `keep` gets that in the order of the points. `progress` says whether to go on after
/// a block. The result is a function of scene, hours and settings.
pub fn simulate_year<T: Send>(
    scene: &Scene,
    hours: &[WeatherSky],
    settings: &Settings,
    progress: &mut dyn FnMut(YearProgress) -> Control,
    digest: impl Fn(PointOfYear) -> T + Sync,
    keep: impl FnMut(T),
) -> YearWork {
    let Some(environment) = &scene.environment else { return YearWork::default() };
    let lit = Scene {
        lights: Vec::new(),
        environment: Some(Environment {
            sky: even_sky(),
            sun: None,
            ground_reflectance: 1.0,
            ..environment.clone()
        }),
        ..scene.clone()
    };
    let hours = Hours { environment, hours };
    if is_grey(scene) {
        run(&Context::<f64>::new(&lit, settings), hours, scene, settings, progress, digest, keep)
    } else {
        run(&Context::<Rgb>::new(&lit, settings), hours, scene, settings, progress, digest, keep)
    }
}

/// 1 cd/m2 everywhere: an illuminance of pi, which a white ground turns into 1 cd/m2 again.
fn even_sky() -> Sky {
    let level = SkyLevel::HorizontalIlluminance { lx: PI };
    Sky::new(Distribution::uniform(), level).expect("a level that a sky may have")
}

#[derive(Clone, Copy)]
struct Hours<'h> {
    environment: &'h Environment,
    hours: &'h [WeatherSky],
}

/// What does not depend on the point.
struct Year<'y, S> {
    context: &'y Context<'y, S>,
    settings: &'y Settings,
    /// By replicate.
    meshes: Vec<Meshes>,
    tables: Vec<HourTable>,
    probes: Vec<HourTable>,
    probed: Vec<usize>,
    suns: Vec<ShiningSun>,
    hours: usize,
    t: Option<f64>,
}

/// A point while it is simulated.
struct PointInWork<'t> {
    number: usize,
    target: &'t Target,
    /// By replicate.
    sums: Vec<Sums>,
    disks: SunDisks,
    /// Paths of each replicate that it is to have next.
    goal: u64,
    relative_half_width: Option<f64>,
    is_done: bool,
}

/// The paths of a point in a replicate.
struct Unit<'t, 's> {
    place: TargetReplicate<'t>,
    sums: &'s mut Sums,
    goal: u64,
}

impl PointInWork<'_> {
    /// Whether it wants more paths, and may have them.
    fn is_open(&self) -> bool {
        !self.is_done && self.sums.first().is_some_and(|sums| sums.paths < self.goal)
    }
}

fn run<S: Spectrum, T: Send>(
    context: &Context<'_, S>,
    hours: Hours<'_>,
    scene: &Scene,
    settings: &Settings,
    progress: &mut dyn FnMut(YearProgress) -> Control,
    digest: impl Fn(PointOfYear) -> T + Sync,
    mut keep: impl FnMut(T),
) -> YearWork {
    let targets = targets(scene);
    let year = Year::new(context, hours, settings, &targets);
    let mut work = YearWork::default();
    for (block, own) in targets.chunks(BLOCK).enumerate() {
        let points = year.simulate(BLOCK * block, own, &mut work);
        let kept: Vec<T> = year.over(&points).into_par_iter().map(&digest).collect();
        kept.into_iter().for_each(&mut keep);
        let over = (BLOCK * block + own.len()).min(targets.len());
        let at = YearProgress { points: [over, targets.len()], rays: work.rays };
        work.is_complete = over == targets.len();
        if progress(at) == Control::Stop {
            break;
        }
    }
    work
}

impl<'y, S: Spectrum> Year<'y, S> {
    fn new(
        context: &'y Context<'y, S>,
        hours: Hours<'_>,
        settings: &'y Settings,
        targets: &[Target],
    ) -> Self {
        let Hours { environment, hours } = hours;
        let shines = |(hour, it): (usize, &WeatherSky)| {
            (it.sun_normal_illuminance_lx > 0.0).then(|| {
                let direction = environment.towards(it.sun);
                ShiningSun {
                    hour,
                    frame: Frame::around(direction),
                    direction,
                    normal_illuminance_lx: it.sun_normal_illuminance_lx,
                }
            })
        };
        let suns: Vec<ShiningSun> = hours.iter().enumerate().filter_map(shines).collect();
        let replicates = settings.effective_replicates();
        let mesh = |replicate| {
            let directions = suns.iter().map(|sun: &ShiningSun| sun.direction);
            Meshes::new(context, replicate, directions)
        };
        let mut meshes: Vec<Meshes> = (0..replicates).map(mesh).collect();
        Meshes::learn(&mut meshes, context, targets);
        let step = hours.len().div_ceil(PROBED_HOURS).max(1);
        let probed: Vec<usize> = (step / 2..hours.len()).step_by(step).collect();
        let probed_hours: Vec<WeatherSky> =
            probed.iter().map(|&hour| hours[hour].clone()).collect();
        let tables = |hours: &[WeatherSky]| -> Vec<HourTable> {
            let skies: Vec<TabulatedSky> =
                hours.par_iter().map(|hour| TabulatedSky::new(&hour.sky)).collect();
            let table = |mesh| HourTable::new(environment, hours, &skies, mesh);
            meshes.iter().map(table).collect()
        };
        Self {
            context,
            settings,
            tables: tables(hours),
            probes: tables(&probed_hours),
            probed,
            meshes,
            suns,
            hours: hours.len(),
            t: t_quantile_for(replicates as usize, 1.0 - settings.confidence),
        }
    }

    /// Traces the points of a block until all are done.
    fn simulate<'t>(
        &self,
        first: usize,
        targets: &'t [Target],
        work: &mut YearWork,
    ) -> Vec<PointInWork<'t>> {
        let replicates = self.meshes.len() as u32;
        let begin = |(number, target): (usize, &'t Target)| {
            let disks = SunDisks::new(self.context, target, &self.suns, replicates);
            let sums = self.meshes.iter().map(Meshes::no_sums).collect();
            PointInWork {
                number: first + number,
                target,
                sums,
                disks,
                goal: FIRST.min(self.limit()),
                relative_half_width: None,
                is_done: false,
            }
        };
        let mut points: Vec<PointInWork<'t>> = targets.par_iter().enumerate().map(begin).collect();
        work.rays += points.iter().map(|point| point.disks.deciding_rays).sum::<u64>();
        while points.iter().any(PointInWork::is_open) {
            self.trace(&mut points, work);
            self.look(&mut points);
        }
        points
    }

    /// Paths up to which a point that is known so well is traced next: the next power of two that
    /// should do.
    fn next(&self, samples: u64, known: f64) -> u64 {
        let excess = (known / self.settings.rel_tol).max(1.0);
        let factor = libm::pow(excess, -1.0 / SLOPE).clamp(2.0, GROWTH);
        let next = samples.saturating_mul(1 << (libm::log2(factor).floor() as u32).max(1));
        next.min(self.limit())
    }

    /// Most paths of a point in a replicate.
    fn limit(&self) -> u64 {
        self.settings.max_samples.unwrap_or(MOST)
    }

    /// Traces the points that are open up to their goals.
    fn trace(&self, points: &mut [PointInWork<'_>], work: &mut YearWork) {
        let look_at_suns = |point: &mut PointInWork<'_>| {
            let PointInWork { number, target, disks, goal, .. } = point;
            let replicates = 0..self.meshes.len() as u32;
            let place = |replicate| TargetReplicate { number: *number, target, replicate };
            let mut look = |place| disks.trace(self.context, place, &self.suns, *goal);
            replicates.map(place).map(&mut look).sum::<u64>()
        };
        let open = points.par_iter_mut().filter(|point| point.is_open());
        work.rays += open.map(look_at_suns).sum::<u64>();
        let open = points.iter_mut().filter(|point| point.is_open());
        let mut units: Vec<Unit<'_, '_>> = open
            .flat_map(|PointInWork { number, target, sums, goal, .. }| {
                let place = |replicate| TargetReplicate { number: *number, target, replicate };
                let unit = |(replicate, sums)| Unit { place: place(replicate), sums, goal: *goal };
                (0..).zip(sums).map(unit).collect::<Vec<_>>()
            })
            .collect();
        let trace = |wave: &mut PathWave<S>, Unit { place, sums, goal }: &mut Unit<'_, '_>| {
            let mesh = &self.meshes[place.replicate as usize];
            let indices = sums.paths..*goal;
            let paths = indices.end - indices.start;
            [sums.trace(self.context, mesh, *place, indices, wave), paths]
        };
        let counts: Vec<[u64; 2]> =
            units.par_iter_mut().map_init(PathWave::default, trace).collect();
        for [rays, paths] in counts {
            work.rays += rays;
            work.paths += paths;
        }
    }

    /// Finds out how well the probed hours of the points that are open are known, and how many
    /// paths should do.
    fn look(&self, points: &mut [PointInWork<'_>]) {
        let open: Vec<&PointInWork<'_>> = points.iter().filter(|point| !point.is_done).collect();
        let mut values = self.values(&open, &self.probes);
        let mut place = vec![None; self.hours];
        self.probed.iter().enumerate().for_each(|(own, &hour)| place[hour] = Some(own));
        let open = points.iter_mut().filter(|point| !point.is_done);
        for (point, all) in open.zip(&mut values) {
            for (replicate, values) in all.iter_mut().enumerate() {
                for SunLight { hour, lx } in point.disks.illuminances_lx(&self.suns, replicate) {
                    place[hour].into_iter().for_each(|own: usize| values[own] += lx);
                }
            }
            let known = self.t.map(|t| relative_half_width(all, t));
            let tolerance = self.settings.rel_tol;
            point.relative_half_width = known;
            point.is_done = tolerance > 0.0 && known.is_some_and(|known| known <= tolerance);
            point.goal = self.next(point.goal, known.unwrap_or(f64::INFINITY));
        }
    }

    /// The hours of tables, by point and replicate, but for what comes straight from the sun.
    fn values(&self, points: &[&PointInWork<'_>], tables: &[HourTable]) -> Vec<Vec<Vec<f32>>> {
        let of_replicate = |(replicate, table): (usize, &HourTable)| {
            let coefficients = |point: &&PointInWork<'_>| point.sums[replicate].coefficients();
            table.illuminances_lx(&points.iter().map(coefficients).collect::<Vec<_>>())
        };
        let by_replicate: Vec<Vec<Vec<f32>>> =
            tables.par_iter().enumerate().map(of_replicate).collect();
        let mut by_point = vec![Vec::with_capacity(tables.len()); points.len()];
        for of_replicate in by_replicate {
            by_point.iter_mut().zip(of_replicate).for_each(|(all, hours)| all.push(hours));
        }
        by_point
    }

    /// All hours of points that are over.
    fn over(&self, points: &[PointInWork<'_>]) -> Vec<PointOfYear> {
        let values = self.values(&points.iter().collect::<Vec<_>>(), &self.tables);
        points.iter().zip(values).map(|(point, values)| self.point(point, values)).collect()
    }

    fn point(&self, point: &PointInWork<'_>, mut illuminance_lx: Vec<Vec<f32>>) -> PointOfYear {
        let mut sun_lx = vec![vec![0.0; self.hours]; self.meshes.len()];
        for (replicate, of_sun) in sun_lx.iter_mut().enumerate() {
            for SunLight { hour, lx } in point.disks.illuminances_lx(&self.suns, replicate) {
                of_sun[hour] = lx;
                illuminance_lx[replicate][hour] += lx;
            }
        }
        PointOfYear {
            number: point.number,
            illuminance_lx,
            sun_lx,
            samples: point.sums[0].paths,
            relative_half_width: point.relative_half_width,
            is_done: point.is_done,
            invalid: point.sums.iter().map(|sums| sums.invalid).sum(),
        }
    }
}

/// The root mean square over hours of half-width over value, of hours that have one.
fn relative_half_width(by_replicate: &[Vec<f32>], t: f64) -> f64 {
    let n = by_replicate.len() as f64;
    let hours = by_replicate.first().map_or(0, Vec::len);
    let square = |hour: usize| {
        let values = by_replicate.iter().map(|values| f64::from(values[hour]));
        let mean = values.clone().sum::<f64>() / n;
        let squares: f64 = values.map(|x| (x - mean) * (x - mean)).sum();
        (mean > 0.0).then(|| t * t * squares / ((n - 1.0) * n * mean * mean))
    };
    let (sum, count) = (0..hours)
        .filter_map(square)
        .fold((0.0, 0), |(sum, count), square| (sum + square, count + 1));
    (sum / f64::from(count.max(1))).sqrt()
}
