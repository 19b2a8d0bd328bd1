//! A room in one state of its blinds: blocks of points, traced until the hours that it is in that
//! state are known well enough.

use super::coefficients::{Meshes, Sums};
use super::hours::HourTable;
use super::results::{PointOfYear, YearWork};
use super::sun_disks::{ShiningSun, SunDisks, SunLight};
use crate::context::Context;
use crate::lights::Suns;
use crate::path::daylight::DaylightSearch;
use crate::path::daylight_paths::TargetReplicate;
use crate::path::trace::outside::most_of_a_path_lx;
use crate::path::wave::PathWave;
use crate::settings::Settings;
use crate::spectrum::Spectrum;
use crate::stats::interval::t_quantile_for;
use crate::stats::targets::Target;
use crate::stats::unseen::unseen_lx;
use crate::stats::watch::split;
use quasilux_scene::Environment;
use quasilux_sky::{TabulatedSky, WeatherSky};
use rayon::prelude::*;

/// Paths of each point in each replicate at first, and at most where nobody says.
const FIRST: u64 = 128;
const MOST: u64 = 1 << 16;
/// Half-widths shrink about like N to this power.
const SLOPE: f64 = -0.6;
/// From one look to the next the number of paths grows by this factor at most.
const GROWTH: f64 = 16.0;
/// Paths between two questions whether to go on.
const AT_ONCE: u64 = 1 << 12;
/// Hours that say whether a point is known well enough.
const PROBED_HOURS: usize = 256;

/// The hours of a year as a state sees them.
#[derive(Clone, Copy)]
pub(super) struct StateHours<'h> {
    pub(super) environment: &'h Environment,
    /// All of the year.
    pub(super) skies: &'h [WeatherSky],
    /// Whether the room is in this state, by hour.
    pub(super) is_own: &'h [bool],
    /// Whether what comes straight from the sun counts in all hours, those of other states, too.
    pub(super) has_sun_of_all: bool,
}

/// What does not depend on the point.
pub(super) struct State<'y, S> {
    context: &'y Context<'y, S>,
    settings: &'y Settings,
    hours: StateHours<'y>,
    /// By replicate.
    meshes: Vec<Meshes>,
    /// Of its own hours.
    tables: Vec<HourTable>,
    /// The numbers of its own hours.
    own: Vec<usize>,
    /// Of some of them.
    probes: Vec<HourTable>,
    probed: Vec<usize>,
    suns: Vec<ShiningSun>,
    t: Option<f64>,
    /// The most in lx that one path finds of the sky or the ground, in its own hours and in those
    /// that are probed.
    most_lx: Vec<f32>,
    most_probed_lx: Vec<f32>,
}

/// A point while it is simulated.
pub(super) struct PointInWork<'t> {
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

impl<'y, S: Spectrum> State<'y, S> {
    pub(super) fn new(
        context: &'y Context<'y, S>,
        hours: StateHours<'y>,
        settings: &'y Settings,
        targets: &[Target],
    ) -> Self {
        let StateHours { environment, skies, is_own, has_sun_of_all } = hours;
        let counts = |hour: &usize| has_sun_of_all || is_own[*hour];
        let shining = (0..skies.len()).filter(counts);
        let suns: Vec<ShiningSun> =
            shining.filter_map(|hour| ShiningSun::new(hour, &skies[hour], environment)).collect();
        let replicates = settings.effective_replicates();
        let mesh = |replicate| {
            let own = suns.iter().filter(|sun| is_own[sun.hour]);
            Meshes::new(context, replicate, own.map(|sun| sun.direction))
        };
        let mut meshes: Vec<Meshes> = (0..replicates).map(mesh).collect();
        Meshes::learn(&mut meshes, context, targets);
        let own: Vec<usize> = (0..skies.len()).filter(|&hour| is_own[hour]).collect();
        let step = own.len().div_ceil(PROBED_HOURS).max(1);
        let to_probe = || (0..own.len()).skip(step / 2).step_by(step);
        let probed: Vec<usize> = to_probe().map(|it| own[it]).collect();
        let tables = |hours: &[usize]| -> Vec<HourTable> {
            let of_hours: Vec<WeatherSky> = hours.iter().map(|&hour| skies[hour].clone()).collect();
            let tabulated: Vec<TabulatedSky> =
                of_hours.par_iter().map(|hour| TabulatedSky::new(&hour.sky)).collect();
            let table = |mesh| HourTable::new(environment, &of_hours, &tabulated, mesh);
            meshes.iter().map(table).collect()
        };
        let (tables, probes) = (tables(&own), tables(&probed));
        let most_lx = most_lx(context, &tables);
        Self {
            context,
            settings,
            hours,
            most_probed_lx: to_probe().map(|it| most_lx[it]).collect(),
            most_lx,
            tables,
            probes,
            own,
            probed,
            meshes,
            suns,
            t: t_quantile_for(replicates as usize, 1.0 - settings.confidence),
        }
    }

    /// Traces the points of a block until all are done, or somebody says that it does not go on:
    /// then they are no use.
    pub(super) fn simulate<'t>(
        &self,
        first: usize,
        targets: &'t [Target],
        work: &mut YearWork,
        goes_on: &(dyn Fn() -> bool + Sync),
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
        while points.iter().any(PointInWork::is_open) && goes_on() {
            self.trace(&mut points, work, goes_on);
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
    fn trace(
        &self,
        points: &mut [PointInWork<'_>],
        work: &mut YearWork,
        goes_on: &(dyn Fn() -> bool + Sync),
    ) {
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
            let mut counts = [0; 2];
            for indices in split(sums.paths..*goal, AT_ONCE).take_while(|_| goes_on()) {
                counts[1] += indices.end - indices.start;
                counts[0] += sums.trace(self.context, mesh, *place, indices, wave);
            }
            counts
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
        let mut place = vec![None; self.hours.skies.len()];
        self.probed.iter().enumerate().for_each(|(own, &hour)| place[hour] = Some(own));
        let open = points.iter_mut().filter(|point| !point.is_done);
        for (point, all) in open.zip(&mut values) {
            for (replicate, values) in all.iter_mut().enumerate() {
                for SunLight { hour, lx } in point.disks.illuminances_lx(&self.suns, replicate) {
                    place[hour].into_iter().for_each(|own: usize| values[own] += lx);
                }
            }
            let tolerance = self.settings.rel_tol;
            let floor_lx = if tolerance > 0.0 { self.settings.abs_tol_lx / tolerance } else { 0.0 };
            let unseen = self.unseen_of_a_path(point.sums[0].paths);
            let unseen_lx: Vec<f32> = self.most_probed_lx.iter().map(|lx| unseen * lx).collect();
            let known = self.t.map(|t| relative_half_width(all, &unseen_lx, t, floor_lx));
            point.relative_half_width = known;
            point.is_done = tolerance > 0.0 && known.is_some_and(|known| known <= tolerance);
            point.goal = self.next(point.goal, known.unwrap_or(f64::INFINITY));
        }
    }

    /// After so many paths of each replicate: how many times what one path finds at most may come
    /// by ways on which none lay. A path that finds something outside has left, so it has one
    /// sample there; what vertices ask for beside that makes no trials (`docs/unseen.md`).
    fn unseen_of_a_path(&self, paths: u64) -> f32 {
        let trials = paths as f64 * self.meshes.len() as f64;
        unseen_lx(1.0, trials) as f32
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

    /// Adds what is known of points that are over to their years.
    pub(super) fn add_to(&self, points: &[PointInWork<'_>], years: &mut [PointOfYear]) {
        let values = self.values(&points.iter().collect::<Vec<_>>(), &self.tables);
        let all = points.iter().zip(values).zip(years);
        all.for_each(|((point, values), year)| self.add_point(point, &values, year));
    }

    fn add_point(&self, point: &PointInWork<'_>, values: &[Vec<f32>], year: &mut PointOfYear) {
        let StateHours { is_own, has_sun_of_all, .. } = self.hours;
        for (replicate, values) in values.iter().enumerate() {
            let illuminance_lx = &mut year.illuminance_lx[replicate];
            for (&hour, lx) in self.own.iter().zip(values) {
                illuminance_lx[hour] = *lx;
            }
            for SunLight { hour, lx } in point.disks.illuminances_lx(&self.suns, replicate) {
                if is_own[hour] {
                    illuminance_lx[hour] += lx;
                }
                if has_sun_of_all {
                    year.sun_lx[replicate][hour] = lx;
                }
            }
        }
        let unseen = self.unseen_of_a_path(point.sums[0].paths);
        for (&hour, lx) in self.own.iter().zip(&self.most_lx) {
            year.unseen_lx[hour] = unseen * lx;
        }
        year.samples += point.sums[0].paths;
        year.is_done &= point.is_done;
        year.invalid += point.sums.iter().map(|sums| sums.invalid).sum::<u64>();
        let share = self.own.len() as f64 / is_own.len().max(1) as f64;
        let known = point.relative_half_width;
        year.relative_half_width = year.relative_half_width.zip(known).map(|(others, own)| {
            // Root mean squares, each of its share of the hours.
            (others * others + share * own * own).sqrt()
        });
    }
}

/// The most in lx that one path finds of the sky or the ground by tables of all replicates, hour by
/// hour.
fn most_lx<S: Spectrum>(context: &Context<'_, S>, tables: &[HourTable]) -> Vec<f32> {
    let search = DaylightSearch { suns: &Suns::default(), only_from_beyond: false };
    let outside = context.lights.outside.as_ref();
    let of_1_cd_m2 = outside.map_or(0.0, |it| most_of_a_path_lx(it, &search)) as f32;
    let larger = |a: Vec<f32>, b: Vec<f32>| a.iter().zip(b).map(|(a, b)| a.max(b)).collect();
    let brightest = tables.iter().map(HourTable::brightest_cd_m2).reduce(larger);
    brightest.unwrap_or_default().iter().map(|cd_m2| of_1_cd_m2 * cd_m2).collect()
}

/// The root mean square over hours of half-width over value, or over a floor where that is more. An
/// hour of which all replicates found nothing is known as well as its bound on unseen light says.
fn relative_half_width(by_replicate: &[Vec<f32>], unseen_lx: &[f32], t: f64, floor_lx: f64) -> f64 {
    let n = by_replicate.len() as f64;
    let hours = by_replicate.first().map_or(0, Vec::len);
    let square = |hour: usize| {
        let values = by_replicate.iter().map(|values| f64::from(values[hour]));
        let mean = values.clone().sum::<f64>() / n;
        let squares: f64 = values.map(|x| (x - mean) * (x - mean)).sum();
        let unseen_lx = f64::from(unseen_lx[hour]);
        if mean == 0.0 {
            return (unseen_lx > 0.0).then(|| unseen_lx * unseen_lx / (floor_lx * floor_lx));
        }
        let over = mean.max(floor_lx);
        Some(t * t * squares / ((n - 1.0) * n * over * over))
    };
    let (sum, count) = (0..hours)
        .filter_map(square)
        .fold((0.0, 0), |(sum, count), square| (sum + square, count + 1));
    (sum / f64::from(count.max(1))).sqrt()
}
