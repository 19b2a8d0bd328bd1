//! How far a run has come: the schedule of its checkpoints, how half-widths shrank, and what it
//! knew at the last one.

use crate::codec::{Reader, StateError};
use crate::settings::Settings;
use crate::stats::convergence::{Finding, History};
use crate::stats::estimates::{Estimates, SensorEstimates, TermEstimates};
use crate::stats::schedule::Schedule;
use crate::stats::tolerance::Standing;
use quasilux_scene::Scene;
use serde::{Deserialize, Serialize};

/// The course of a run from checkpoint to checkpoint.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Course {
    /// Whether the last checkpoint ended it. The first field: [`Self::is_over`] reads no other.
    pub(crate) over: bool,
    /// Whether converged targets get no more samples.
    pub(crate) is_adaptive: bool,
    pub(crate) schedule: Schedule,
    pub(crate) history: History,
    /// Estimates of the last checkpoint. Cameras have no place in them: pictures come after it.
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
        let finding = Finding { estimates, standing, is_adaptive: *is_adaptive };
        estimates.convergence = history.record(finding, schedule, settings);
    }

    /// Whether a course of any run is over, of which only the beginning is read.
    pub(crate) fn is_over(from: &mut Reader<'_>) -> Result<bool, StateError> {
        from.value()
    }

    /// Continues where a stored course of the same run stands.
    pub(crate) fn read(
        &mut self,
        scene: &Scene,
        settings: &Settings,
        from: &mut Reader<'_>,
    ) -> Result<(), StateError> {
        let Self { over, is_adaptive, schedule, history, last } = from.value()?;
        self.schedule.advance_to(schedule)?;
        match &last {
            Some(last) if has_shape(last, scene, settings) => {
                self.history = history.resumed(last, settings);
            }
            Some(_) => return Err(StateError::Unfit("a row of estimates")),
            None if over => return Err(StateError::Unfit("the course")),
            None => {}
        }
        (self.over, self.is_adaptive, self.last) = (over, is_adaptive, last);
        Ok(())
    }
}

/// Whether estimates have the points of the scene, and the replicates and terms of the settings.
fn has_shape(estimates: &Estimates, scene: &Scene, settings: &Settings) -> bool {
    let replicates = settings.effective_replicates() as usize;
    let listed = settings.list_terms as usize;
    let terms = if listed == 0 { 0 } else { listed + 1 };
    let fits = |sensor: &SensorEstimates, points: usize| {
        let SensorEstimates {
            replicate_lx,
            direct_lx,
            evidence,
            samples,
            average,
            terms: own,
            unseen,
        } = sensor;
        let are_rows = |rows: &[Vec<f64>]| {
            rows.len() == replicates && rows.iter().all(|row| row.len() == points)
        };
        let is_term =
            |term: &TermEstimates| are_rows(&term.replicate_lx) && term.resolved.len() == points;
        are_rows(replicate_lx)
            && [direct_lx.len(), samples.len(), evidence.len()] == [points; 3]
            && unseen.as_ref().is_none_or(|unseen| unseen.has_points(points))
            && own.len() == terms
            && average.as_ref().is_none_or(|average| average.has_shape(replicates, terms))
            && own.iter().all(is_term)
    };
    let points = scene.sensors.iter().map(|sensor| sensor.points().len());
    estimates.sensors.len() == scene.sensors.len()
        && estimates.sensors.iter().zip(points).all(|(sensor, points)| fits(sensor, points))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::point_status::Evidence;
    use crate::stats::unseen::UnseenLight;
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
                evidence: vec![Evidence::Sound; 2],
                samples: vec![16; 2],
                average: None,
                terms: vec![term; terms],
                unseen: Some(UnseenLight::unknown(2)),
            };
            Estimates { sensors: vec![sensor], ..Estimates::default() }
        };
        let settings = Settings { replicates: 3, list_terms: 1, ..Settings::default() };
        let fits = |rows, terms| has_shape(&state(rows, terms), &scene, &settings);
        assert!(fits(3, 2));
        for (rows, terms) in [(0, 2), (2, 2), (4, 2), (3, 0), (3, 1), (3, 3)] {
            assert!(!fits(rows, terms), "{rows} rows, {terms} terms");
        }
    }
}
