//! How far a run has come: the schedule of its checkpoints, how half-widths shrank, and what it knew at the last one.

use super::{Reader, StateError, Stored, Writer};
use crate::convergence::{Convergence, History};
use crate::estimates::{Dimensions, Estimates, FluxBalance, SensorEstimates, TermEstimates};
use crate::schedule::Schedule;
use crate::settings::Settings;
use quasilux_scene::Scene;

/// The course of a run from checkpoint to checkpoint.
#[derive(Clone, Debug)]
pub(crate) struct Course {
    pub(crate) schedule: Schedule,
    /// Whether the last checkpoint ended it.
    pub(crate) over: bool,
    /// Whether targets that are done get no more samples.
    pub(crate) is_adaptive: bool,
    pub(crate) history: History,
    /// What was known at the last checkpoint.
    pub(crate) last: Option<Estimates>,
}

impl Course {
    pub(crate) fn new(schedule: Schedule) -> Self {
        let history = History::default();
        Self { schedule, over: false, is_adaptive: false, history, last: None }
    }

    pub(crate) fn put(&self, out: &mut Writer) {
        let Self { schedule, over, is_adaptive, history, last } = self;
        schedule.put(out);
        out.bool(*over);
        out.bool(*is_adaptive);
        out.bool(last.is_some());
        if let Some(estimates) = last {
            put_estimates(estimates, out);
            history.put(out);
        }
    }

    /// Goes on where another course of the same run was.
    pub(crate) fn read(
        &mut self,
        scene: &Scene,
        settings: &Settings,
        from: &mut Reader<'_>,
    ) -> Result<(), StateError> {
        self.schedule.read(from)?;
        self.over = from.bool()?;
        self.is_adaptive = from.bool()?;
        self.last = from.bool()?.then(|| read_estimates(scene, from)).transpose()?;
        if let Some(last) = &self.last {
            self.history = History::read(last, settings, from)?;
        }
        if self.over && self.last.is_none() { Err(StateError::Unfit("the course")) } else { Ok(()) }
    }
}

/// Cameras have no place in it: pictures come after the last checkpoint.
fn put_estimates(estimates: &Estimates, out: &mut Writer) {
    let Estimates {
        sensors,
        cameras: _,
        samples,
        rays,
        flux,
        dimensions,
        invalid_contributions,
        confidence,
        miss_probability,
        tolerance_reached,
        convergence,
        unresolved_points,
        biased,
        warnings,
    } = estimates;
    let FluxBalance { emitted_lm, absorbed_lm, lost_lm, cut_lm } = flux;
    let Dimensions { photon, path } = dimensions;
    sensors.iter().for_each(|sensor| put_sensor(sensor, out));
    for count in [samples, rays, invalid_contributions, unresolved_points] {
        out.u64(*count);
    }
    for number in [emitted_lm, absorbed_lm, lost_lm, cut_lm, confidence, miss_probability] {
        out.f64(*number);
    }
    out.bool(*tolerance_reached);
    out.bool(*biased);
    let Convergence { slope, samples, rays, against_prediction } = convergence;
    out.option(*slope, Writer::f64);
    out.option(*samples, Writer::u64);
    out.option(*rays, Writer::u64);
    out.option(*against_prediction, Writer::f64);
    photon.put(out);
    path.put(out);
    out.u64(warnings.len() as u64);
    warnings.iter().for_each(|warning| out.text(warning));
}

fn read_estimates(scene: &Scene, from: &mut Reader<'_>) -> Result<Estimates, StateError> {
    let points = scene.sensors.iter().map(|sensor| sensor.points().len());
    let sensors = points.map(|points| read_sensor(points, from)).collect::<Result<_, _>>()?;
    let mut estimates = Estimates { sensors, ..Estimates::default() };
    let Estimates { samples, rays, invalid_contributions, unresolved_points, .. } = &mut estimates;
    for count in [samples, rays, invalid_contributions, unresolved_points] {
        *count = from.u64()?;
    }
    let FluxBalance { emitted_lm, absorbed_lm, lost_lm, cut_lm } = &mut estimates.flux;
    for flux_lm in [emitted_lm, absorbed_lm, lost_lm, cut_lm] {
        *flux_lm = from.f64()?;
    }
    estimates.confidence = from.f64()?;
    estimates.miss_probability = from.f64()?;
    estimates.tolerance_reached = from.bool()?;
    estimates.biased = from.bool()?;
    estimates.convergence = Convergence {
        slope: from.option(Reader::f64)?,
        samples: from.option(Reader::u64)?,
        rays: from.option(Reader::u64)?,
        against_prediction: from.option(Reader::f64)?,
    };
    estimates.dimensions.photon.take_in(from)?;
    estimates.dimensions.path.take_in(from)?;
    let warnings = from.length(size_of::<u64>())?;
    estimates.warnings = (0..warnings).map(|_| from.text()).collect::<Result<_, _>>()?;
    Ok(estimates)
}

fn put_sensor(sensor: &SensorEstimates, out: &mut Writer) {
    let SensorEstimates { replicate_lx, direct_lx, resolved, samples, terms } = sensor;
    put_rows(replicate_lx, out);
    out.f64s(direct_lx);
    resolved.iter().for_each(|resolved| out.bool(*resolved));
    samples.iter().for_each(|samples| out.u64(*samples));
    out.u64(terms.len() as u64);
    for TermEstimates { replicate_lx, resolved } in terms {
        put_rows(replicate_lx, out);
        resolved.iter().for_each(|resolved| out.bool(*resolved));
    }
}

fn read_sensor(points: usize, from: &mut Reader<'_>) -> Result<SensorEstimates, StateError> {
    let flags = |from: &mut Reader<'_>| (0..points).map(|_| from.bool()).collect();
    let replicate_lx = read_rows(points, from)?;
    let direct_lx = read_row(points, from)?;
    let resolved: Result<Vec<bool>, StateError> = flags(from);
    let resolved = resolved?;
    let samples = (0..points).map(|_| from.u64()).collect::<Result<_, _>>()?;
    let terms = 0..from.length(points)?;
    let term = |from: &mut Reader<'_>| {
        Ok(TermEstimates { replicate_lx: read_rows(points, from)?, resolved: flags(from)? })
    };
    let terms = terms.map(|_| term(from)).collect::<Result<_, _>>()?;
    Ok(SensorEstimates { replicate_lx, direct_lx, resolved, samples, terms })
}

fn put_rows(rows: &[Vec<f64>], out: &mut Writer) {
    out.u64(rows.len() as u64);
    rows.iter().for_each(|row| out.f64s(row));
}

fn read_rows(points: usize, from: &mut Reader<'_>) -> Result<Vec<Vec<f64>>, StateError> {
    let rows = from.length(size_of::<u64>())?;
    (0..rows).map(|_| read_row(points, from)).collect()
}

fn read_row(points: usize, from: &mut Reader<'_>) -> Result<Vec<f64>, StateError> {
    let row = from.f64s()?;
    if row.len() == points { Ok(row) } else { Err(StateError::Unfit("a row of estimates")) }
}
