//! One room with one kind of points, with and without first shot.

use super::Effort;
use super::rooms::Room;
use crate::claim::largest;
use crate::contrast::Contrast;
use crate::course::{Course, Snapshot};
use crate::significance::each_of;
use crate::timing::{SHORT_RAYS, seconds_of_a_ray};
use quasilux_sampling::Sequence;
use quasilux_sampling::quality::fit_power_law;
use quasilux_transport::interval::t_quantile_for;
use quasilux_transport::{EstimatorKind, Settings, Switch};

/// The points that are compared.
pub(super) const SEQUENCES: [Sequence; 2] = [Sequence::Independent, Sequence::Sobol];
/// Longest edge of an element of the map.
const ELEMENT_M: f64 = 0.5;
/// Light of no and of one bounce is found by paths alone; photons bring the rest, which is the
/// third term then.
const TERMS_OF_PATHS: u32 = 2;
/// Slopes are fitted from here on.
pub(super) const FIT_FROM: u64 = 256;

/// What is looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    /// The illuminance.
    Whole,
    /// Of it, what photons bring: light of two bounces and more.
    OfPhotons,
}

/// Two runs.
pub(super) struct Trial {
    pub(super) room: &'static str,
    pub(super) why: &'static str,
    pub(super) sequence: Sequence,
    pub(super) off: Course,
    pub(super) on: Course,
}

/// A run with the setting of first shot.
pub(super) struct NamedCourse<'a> {
    pub(super) switch: &'static str,
    pub(super) course: &'a Course,
}

/// Whether means of two runs agree.
pub(super) struct Agreement {
    /// The largest distance at a point, in standard errors of the difference.
    pub(super) worst: f64,
    /// What it may be, the points of all trials together at a significance of 1 %.
    pub(super) allowed: f64,
    /// The largest distance over the value.
    pub(super) relative: f64,
}

impl Trial {
    pub(super) fn new(room: &Room, sequence: Sequence, effort: &Effort) -> Self {
        let run =
            |switch| Course::run(&room.scene, &settings(switch, sequence, effort), effort.limit);
        let (off, on) = (run(Switch::Off), run(Switch::On));
        Self { room: room.name, why: room.why, sequence, off, on }
    }

    /// Times all runs by short ones: from what a ray of each takes follows what all checkpoints
    /// take.
    pub(super) fn time(trials: &mut [Self], rooms: &[Room], effort: &Effort) {
        let of_a_ray = seconds_of_a_ray(2 * trials.len(), |k| {
            let trial = &trials[k / 2];
            let (switch, course) =
                if k % 2 == 0 { (Switch::Off, &trial.off) } else { (Switch::On, &trial.on) };
            let replicates = f64::from(effort.replicates);
            let is_short = |snapshot: &&Snapshot| snapshot.rays * replicates <= SHORT_RAYS;
            let samples =
                course.snapshots.iter().rfind(is_short).map_or(1, |snapshot| snapshot.samples);
            let short = Effort { samples, ..*effort };
            let room = rooms.iter().find(|room| room.name == trial.room).expect("its own room");
            let settings = settings(switch, trial.sequence, &short);
            let course = Course::run(&room.scene, &settings, None);
            course.last().seconds / course.last().rays
        });
        for (trial, seconds) in trials.iter_mut().zip(of_a_ray.chunks_exact(2)) {
            for (course, seconds) in [&mut trial.off, &mut trial.on].into_iter().zip(seconds) {
                course
                    .snapshots
                    .iter_mut()
                    .for_each(|snapshot| snapshot.seconds = seconds * snapshot.rays);
            }
        }
    }

    /// Both runs with their names.
    pub(super) fn runs(&self) -> [NamedCourse<'_>; 2] {
        [
            NamedCourse { switch: "off", course: &self.off },
            NamedCourse { switch: "on", course: &self.on },
        ]
    }

    /// The last checkpoint that both have.
    pub(super) fn last(&self) -> [&Snapshot; 2] {
        let last = self.off.snapshots.len().min(self.on.snapshots.len()) - 1;
        [&self.off.snapshots[last], &self.on.snapshots[last]]
    }

    /// By how much first shot divides the error when N is largest.
    pub(super) fn gain(&self, part: Part) -> Contrast {
        let [off, on] = self.last().map(|snapshot| squares(snapshot, part));
        Contrast::gain(&off, &on)
    }

    /// For what photons bring.
    pub(super) fn gain_of_photons(&self) -> Contrast {
        self.gain(Part::OfPhotons)
    }

    /// How many times as efficient it is by rays, for what photons bring.
    pub(super) fn gain_by_rays(&self) -> Contrast {
        let [off, on] = self.last();
        self.gain(Part::OfPhotons).efficiency(off.rays / on.rays)
    }

    /// The same by time.
    pub(super) fn gain_by_time(&self) -> Contrast {
        self.gain_of_part_by_time(Part::OfPhotons)
    }

    /// The same of a part of the light.
    pub(super) fn gain_of_part_by_time(&self, part: Part) -> Contrast {
        let [off, on] = self.last();
        self.gain(part).efficiency(off.seconds / on.seconds)
    }

    /// Welch's test of what photons bring at each point, by Student's t with the fewer degrees of
    /// freedom, which is careful; of this many trials.
    pub(super) fn agreement(&self, trials: usize) -> Agreement {
        let [off, on] = self.last();
        let columns = [off, on].map(|snapshot| columns(snapshot, Part::OfPhotons));
        let (mut worst, mut relative) = (0.0, 0.0);
        for (a, b) in columns[0].iter().zip(&columns[1]) {
            let [a, b] = [a, b].map(|column| moments(column));
            let distance = (a.mean - b.mean).abs();
            worst = largest([worst, distance / (a.squared_error + b.squared_error).sqrt()]);
            relative = largest([relative, distance / a.mean]);
        }
        let points = columns[0].len();
        let replicates = columns[0][0].len();
        let allowed = t_quantile_for(replicates, each_of(trials * points)).unwrap_or(f64::NAN);
        Agreement { worst, allowed, relative }
    }
}

/// What first shot is switched on or off in.
fn settings(first_shot: Switch, sequence: Sequence, effort: &Effort) -> Settings {
    Settings {
        estimator: EstimatorKind::BidirectionalMap,
        first_shot,
        sequence,
        importance: Switch::Off,
        map_adaptive: false,
        map_element_m: Some(ELEMENT_M),
        replicates: effort.replicates,
        list_terms: TERMS_OF_PATHS,
        max_samples: Some(effort.samples),
        // Other seeds: what the two have in common is light alone.
        seed: 2 * effort.seed + u64::from(first_shot == Switch::On),
        ..Settings::default()
    }
}

/// Root mean square over points and replicates of the distance from the mean, over the mean of all
/// points.
pub(super) fn error(snapshot: &Snapshot, part: Part) -> f64 {
    let squares = squares(snapshot, part);
    (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
}

/// The mean of all points.
pub(super) fn mean_lx(snapshot: &Snapshot, part: Part) -> f64 {
    let columns = columns(snapshot, part);
    columns.iter().map(|column| moments(column).mean).sum::<f64>() / columns.len() as f64
}

/// The order of convergence.
pub(super) fn slope(course: &Course, part: Part) -> Option<f64> {
    let fitted = course.snapshots.iter().filter(|snapshot| snapshot.samples >= FIT_FROM);
    let errors: Vec<[f64; 2]> =
        fitted.map(|snapshot| [snapshot.samples as f64, error(snapshot, part)]).collect();
    fit_power_law(&errors).map(|law| law.exponent)
}

/// Of each replicate: mean over the points of its squared distance from the mean of all, freed from
/// bias.
fn squares(snapshot: &Snapshot, part: Part) -> Vec<f64> {
    let columns = columns(snapshot, part);
    let means: Vec<f64> = columns.iter().map(|column| moments(column).mean).collect();
    let points = columns.len() as f64;
    let level = means.iter().sum::<f64>() / points;
    let n = columns[0].len() as f64;
    let square = |r: usize| {
        let distances = columns.iter().zip(&means).map(|(column, mean)| column[r] - mean);
        let sum: f64 = distances.map(|distance| distance * distance).sum();
        sum / points / (level * level) * n / (n - 1.0)
    };
    (0..columns[0].len()).map(square).collect()
}

/// The values of each point, one a replicate.
fn columns(snapshot: &Snapshot, part: Part) -> Vec<Vec<f64>> {
    let sensor = &snapshot.estimates.sensors[0];
    let rows = match part {
        Part::Whole => &sensor.replicate_lx,
        Part::OfPhotons => &sensor.terms[TERMS_OF_PATHS as usize].replicate_lx,
    };
    (0..rows[0].len()).map(|point| rows.iter().map(|row| row[point]).collect()).collect()
}

struct Moments {
    mean: f64,
    /// Of the mean.
    squared_error: f64,
}

fn moments(values: &[f64]) -> Moments {
    let n = values.len() as f64;
    let mean = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|x| (x - mean) * (x - mean)).sum();
    Moments { mean, squared_error: squares / (n * (n - 1.0)) }
}
