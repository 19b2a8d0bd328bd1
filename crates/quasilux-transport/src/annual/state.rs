//! A room in one state of its blinds: blocks of points, traced until the hours that it is in that
//! state are known well enough.

use super::coefficients::{Meshes, Sums};
use super::hours::HourTable;
use super::results::{PointOfYear, YearWork, intervals_lx};
use super::sun_disks::{ShiningSun, SunDisks, SunLight};
use crate::context::Context;
use crate::control::watch::split;
use crate::lights::Suns;
use crate::path::daylight::DaylightSearch;
use crate::path::daylight_paths::TargetReplicate;
use crate::path::trace::outside::most_of_a_path_lx;
use crate::path::wave::PathWave;
use crate::sensors::Target;
use crate::settings::Settings;
use crate::spectrum::Spectrum;
use crate::stats::interval::{Interval, t_quantile_for};
use crate::stats::sequential::Stopping;
use crate::stats::unseen::unseen_lx;
use quasilux_scene::Environment;
use quasilux_sky::{TabulatedSky, WeatherSky};
use rayon::prelude::*;
use std::borrow::Borrow;

/// Paths of each point in each replicate at most where no limit is set.
const MOST: u64 = 1 << 16;
/// Paths between two questions whether to go on.
const AT_ONCE: u64 = 1 << 12;
/// Paths grow with this power of the width that they take off: between the 2 of random points and
/// the 1 of smooth integrands.
const PATHS_FOR_WIDTH: f64 = 1.5;
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

/// A room in one state of its blinds: all that does not depend on the point.
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
    stopping: Stopping,
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
    relative_half_width: Option<f64>,
    is_done: bool,
}

/// The paths of a point in a replicate.
struct Unit<'t, 's> {
    place: TargetReplicate<'t>,
    sums: &'s mut Sums,
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
        let stopping = Stopping::new(settings);
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
            stopping,
            t: t_quantile_for(replicates as usize, stopping.miss_probability),
        }
    }

    /// Traces the points of a block until all are done, or until the caller, who is told what share
    /// of that seems to be over, stops it: then they are of no use.
    pub(super) fn simulate<'t>(
        &self,
        first: usize,
        targets: &'t [Target],
        work: &mut YearWork,
        goes_on: &(dyn Fn(f64) -> bool + Sync),
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
                relative_half_width: None,
                is_done: false,
            }
        };
        let mut points: Vec<PointInWork<'t>> = targets.par_iter().enumerate().map(begin).collect();
        work.rays += points.iter().map(|point| point.disks.deciding_rays).sum::<u64>();
        let mut schedule = self.stopping.looks(self.settings.max_samples.unwrap_or(MOST));
        let mut share = 0.0;
        while goes_on(share) {
            let mut open: Vec<_> = points.iter_mut().filter(|point| !point.is_done).collect();
            self.trace(&mut open, schedule.next_checkpoint(), work, &|| goes_on(share));
            self.look(&mut open, schedule.is_look());
            let of_points = points.iter().map(|point| self.share_of(point)).sum::<f64>();
            share = of_points / points.len().max(1) as f64;
            if points.iter().all(|point| point.is_done) || !schedule.advance() {
                break;
            }
        }
        points
    }

    /// Traces points up to this many paths of each replicate.
    fn trace(
        &self,
        points: &mut [&mut PointInWork<'_>],
        goal: u64,
        work: &mut YearWork,
        goes_on: &(dyn Fn() -> bool + Sync),
    ) {
        let look_at_suns = |point: &mut &mut PointInWork<'_>| {
            let PointInWork { number, target, disks, .. } = &mut **point;
            let replicates = 0..self.meshes.len() as u32;
            let place = |replicate| TargetReplicate { number: *number, target, replicate };
            let mut look = |place| disks.trace(self.context, place, &self.suns, goal);
            replicates.map(place).map(&mut look).sum::<u64>()
        };
        work.rays += points.par_iter_mut().map(look_at_suns).sum::<u64>();
        let mut units: Vec<Unit<'_, '_>> = points
            .iter_mut()
            .flat_map(|point| {
                let PointInWork { number, target, sums, .. } = &mut **point;
                let place = |replicate| TargetReplicate { number: *number, target, replicate };
                let unit = |(replicate, sums)| Unit { place: place(replicate), sums };
                (0..).zip(sums).map(unit).collect::<Vec<_>>()
            })
            .collect();
        let trace = |wave: &mut PathWave<S>, Unit { place, sums }: &mut Unit<'_, '_>| {
            let mesh = &self.meshes[place.replicate as usize];
            let mut counts = [0; 2];
            for indices in split(sums.paths..goal, AT_ONCE).take_while(|_| goes_on()) {
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

    /// Share of its needed paths that a point has by now, as far as its interval tells.
    fn share_of(&self, point: &PointInWork<'_>) -> f64 {
        let known = point.relative_half_width.filter(|known| *known > self.settings.rel_tol);
        match known {
            _ if point.is_done => 1.0,
            Some(known) => libm::pow(self.settings.rel_tol / known, PATHS_FOR_WIDTH),
            None => 0.0,
        }
    }

    /// Finds out how well the probed hours of points are known, and which points are done where
    /// they may be.
    fn look(&self, points: &mut [&mut PointInWork<'_>], may_be_done: bool) {
        let mut values = self.values(points, &self.probes);
        let mut place = vec![None; self.hours.skies.len()];
        self.probed.iter().enumerate().for_each(|(own, &hour)| place[hour] = Some(own));
        for (point, all) in points.iter_mut().zip(&mut values) {
            for (replicate, values) in all.iter_mut().enumerate() {
                for SunLight { hour, lx } in point.disks.illuminances_lx(&self.suns, replicate) {
                    place[hour].into_iter().for_each(|own: usize| values[own] += lx);
                }
            }
            let tolerance = self.settings.rel_tol;
            let floor_lx = if tolerance > 0.0 { self.settings.abs_tol_lx / tolerance } else { 0.0 };
            let unseen = self.unseen_of_a_path(point.sums[0].paths);
            let unseen_lx: Vec<f32> = self.most_probed_lx.iter().map(|lx| unseen * lx).collect();
            let known = relative_half_width(&intervals_lx(all, &unseen_lx, self.t), floor_lx);
            let is_within = tolerance > 0.0 && known.is_some_and(|known| known <= tolerance);
            point.relative_half_width = known;
            point.is_done = is_within && may_be_done;
        }
    }

    /// After this many paths of each replicate: how many times what one path finds at most may come
    /// by ways on which none lay. A path that finds something outside has left, so it has one
    /// sample there; what vertices ask for beside that makes no trials (`docs/unseen.md`).
    fn unseen_of_a_path(&self, paths: u64) -> f32 {
        let trials = paths as f64 * self.meshes.len() as f64;
        unseen_lx(1.0, trials) as f32
    }

    /// The hours of tables, by point and replicate, but for what comes straight from the sun.
    fn values<'t, P>(&self, points: &[P], tables: &[HourTable]) -> Vec<Vec<Vec<f32>>>
    where
        P: Borrow<PointInWork<'t>> + Sync,
    {
        let of_replicate = |(replicate, table): (usize, &HourTable)| {
            let coefficients = |point: &P| point.borrow().sums[replicate].coefficients();
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
        let values = self.values(points, &self.tables);
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

/// The root mean square over hours with light of half-width over value, or over a floor where that
/// is more; `None` without half-widths.
fn relative_half_width(hours: &[Interval], floor_lx: f64) -> Option<f64> {
    let is_lit = |it: &&Interval| it.value > 0.0 || it.half_width != Some(0.0);
    let relative = |it: &Interval| Some(it.half_width? / it.value.max(floor_lx));
    let all: Vec<f64> = hours.iter().filter(is_lit).map(relative).collect::<Option<_>>()?;
    Some((all.iter().map(|width| width * width).sum::<f64>() / all.len().max(1) as f64).sqrt())
}
