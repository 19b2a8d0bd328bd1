//! How far a run has come: the schedule of its checkpoints, how half-widths shrank, and what it
//! knew at the last one.

use crate::codec::{Reader, StateError, Stored, Writer};
use crate::settings::Settings;
use crate::stats::convergence::History;
use crate::stats::estimates::{
    Convergence, Dimensions, Estimates, FluxBalance, SensorEstimates, TermEstimates,
};
use crate::stats::schedule::Schedule;
use crate::stats::tolerance::Standing;
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

    /// Records a checkpoint, and predicts the end from all so far.
    pub(crate) fn record(
        &mut self,
        estimates: &mut Estimates,
        standing: &Standing,
        settings: &Settings,
    ) {
        let Self { history, schedule, is_adaptive, .. } = self;
        estimates.convergence =
            history.record(estimates, (standing, *is_adaptive), schedule, settings);
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

    /// Whether a course of any run is over, of which only the beginning is read.
    pub(crate) fn is_over(from: &mut Reader<'_>) -> Result<bool, StateError> {
        let _next = from.u64()?;
        from.bool()
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
        self.last = from.bool()?.then(|| read_estimates(scene, settings, from)).transpose()?;
        if let Some(last) = &self.last {
            self.history = History::read(last, settings, from)?;
        }
        if self.over && self.last.is_none() { Err(StateError::Unfit("the course")) } else { Ok(()) }
    }
}

/// Cameras have no place in it: pictures come after the last checkpoint. Decisions are made again.
fn put_estimates(estimates: &Estimates, out: &mut Writer) {
    let Estimates {
        sensors,
        cameras: _,
        samples,
        rays,
        decisions: _,
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
    let Dimensions { photon, photons, photon_events, path } = dimensions;
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
    out.u64(*photons);
    out.u64(*photon_events);
    path.put(out);
    out.u64(warnings.len() as u64);
    warnings.iter().for_each(|warning| out.text(warning));
}

fn read_estimates(
    scene: &Scene,
    settings: &Settings,
    from: &mut Reader<'_>,
) -> Result<Estimates, StateError> {
    let points = scene.sensors.iter().map(|sensor| sensor.points().len());
    let replicates = settings.effective_replicates() as usize;
    let terms = settings.list_terms as usize;
    let terms = if terms == 0 { 0 } else { terms + 1 };
    let shape = |points| Shape { points, replicates, terms };
    let sensors =
        points.map(|points| read_sensor(&shape(points), from)).collect::<Result<_, _>>()?;
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
    estimates.dimensions.photon.merge_from(from)?;
    estimates.dimensions.photons = from.u64()?;
    estimates.dimensions.photon_events = from.u64()?;
    estimates.dimensions.path.merge_from(from)?;
    let warnings = from.length(size_of::<u64>())?;
    estimates.warnings = (0..warnings).map(|_| from.text()).collect::<Result<_, _>>()?;
    Ok(estimates)
}

/// What estimates of one sensor have to have.
struct Shape {
    points: usize,
    replicates: usize,
    terms: usize,
}

fn put_sensor(sensor: &SensorEstimates, out: &mut Writer) {
    let SensorEstimates { replicate_lx, direct_lx, resolved, missed_lobes, samples, terms } =
        sensor;
    put_rows(replicate_lx, out);
    out.f64s(direct_lx);
    [resolved, missed_lobes].into_iter().flatten().for_each(|flag| out.bool(*flag));
    samples.iter().for_each(|samples| out.u64(*samples));
    out.u64(terms.len() as u64);
    for TermEstimates { replicate_lx, resolved } in terms {
        put_rows(replicate_lx, out);
        resolved.iter().for_each(|resolved| out.bool(*resolved));
    }
}

fn read_sensor(shape: &Shape, from: &mut Reader<'_>) -> Result<SensorEstimates, StateError> {
    let Shape { points, replicates: _, terms } = *shape;
    let flags = |from: &mut Reader<'_>| -> Result<Vec<bool>, StateError> {
        (0..points).map(|_| from.bool()).collect()
    };
    let replicate_lx = read_rows(shape, from)?;
    let direct_lx = read_row(points, from)?;
    let (resolved, missed_lobes) = (flags(from)?, flags(from)?);
    let samples = (0..points).map(|_| from.u64()).collect::<Result<_, _>>()?;
    from.expect_length(terms)?;
    let term = |from: &mut Reader<'_>| {
        Ok(TermEstimates { replicate_lx: read_rows(shape, from)?, resolved: flags(from)? })
    };
    let terms = (0..terms).map(|_| term(from)).collect::<Result<_, _>>()?;
    Ok(SensorEstimates { replicate_lx, direct_lx, resolved, missed_lobes, samples, terms })
}

fn put_rows(rows: &[Vec<f64>], out: &mut Writer) {
    out.u64(rows.len() as u64);
    rows.iter().for_each(|row| out.f64s(row));
}

fn read_rows(shape: &Shape, from: &mut Reader<'_>) -> Result<Vec<Vec<f64>>, StateError> {
    from.expect_length(shape.replicates)?;
    (0..shape.replicates).map(|_| read_row(shape.points, from)).collect()
}

fn read_row(points: usize, from: &mut Reader<'_>) -> Result<Vec<f64>, StateError> {
    let row = from.f64s()?;
    if row.len() == points { Ok(row) } else { Err(StateError::Unfit("a row of estimates")) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use quasilux_scene::{Sensor, SensorPoint, SensorShape};

    /// Bytes that a resealed file may hold: all is well with them but the number of rows or of
    /// terms.
    #[test]
    fn rows_and_terms_are_those_of_the_settings() {
        let point = SensorPoint { position: glam::DVec3::ZERO, normal: glam::DVec3::Z };
        let shape = SensorShape::Points(vec![point; 2]);
        let scene =
            Scene { sensors: vec![Sensor { name: "two".to_owned(), shape }], ..Scene::default() };
        let state = |rows: usize, terms: usize| {
            let term =
                TermEstimates { replicate_lx: vec![vec![0.5; 2]; rows], resolved: vec![true; 2] };
            let sensor = SensorEstimates {
                replicate_lx: vec![vec![1.0; 2]; rows],
                direct_lx: vec![0.5; 2],
                resolved: vec![true; 2],
                missed_lobes: vec![false; 2],
                samples: vec![16; 2],
                terms: vec![term; terms],
            };
            let mut out = Writer::default();
            put_estimates(&Estimates { sensors: vec![sensor], ..Estimates::default() }, &mut out);
            out.finish()
        };
        let settings = Settings { replicates: 3, list_terms: 1, ..Settings::default() };
        let read = |bytes: &[u8]| read_estimates(&scene, &settings, &mut Reader::new(bytes));
        assert!(read(&state(3, 2)).is_ok());
        for (rows, terms) in [(0, 2), (2, 2), (4, 2), (3, 0), (3, 1), (3, 3)] {
            assert!(read(&state(rows, terms)).is_err(), "{rows} rows, {terms} terms");
        }
    }
}
