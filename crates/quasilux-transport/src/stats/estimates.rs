//! What a simulation knows at a checkpoint: figures of each replicate, and the confidence intervals
//! of points, averages and pictures that follow from them.

use crate::settings::Settings;
use crate::stats::caveat::Caveat;
use crate::stats::certified::{CertifiedInterval, Measured, miss_at_a_checkpoint};
use crate::stats::decisions::Decisions;
use crate::stats::even_average::EvenAverage;
use crate::stats::interval::{Interval, t_quantile_for};
use crate::stats::minimum::{interval_of_minimum, ratios};
use crate::stats::picture::CameraEstimates;
use crate::stats::point_status::Evidence;
use crate::stats::unseen::{UnseenLight, factor_of_all};
use quasilux_sampling::DimensionHistogram;
use quasilux_scene::{Scene, Sensor};
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// The state of a simulation at a checkpoint that all replicates have completed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Estimates {
    /// One entry a sensor, in the order of the scene.
    pub sensors: Vec<SensorEstimates>,
    /// One entry a camera, in the order of the scene; none before the sensors are done.
    #[serde(skip)]
    pub cameras: Vec<CameraEstimates>,
    /// Indices used so far by each replicate: photons, and paths for each sensor point; without
    /// sensors those of a pixel.
    pub samples: u64,
    /// Rays traced so far, all kinds and replicates together.
    pub rays: u64,
    /// Decisions made before the first sample.
    #[serde(skip)]
    pub decisions: Decisions,
    /// Where the photons' flux went.
    pub flux: FluxBalance,
    /// Numbers of coordinates that photons and paths used.
    pub dimensions: Dimensions,
    /// Contributions that were not finite, negative, or out of the tally's range; not in the sums.
    pub invalid_contributions: u64,
    /// Nominal confidence level of the intervals.
    pub confidence: f64,
    /// Two-sided miss probability that intervals of this checkpoint are made for, at most
    /// `1 - confidence`: less where the run may stop at a good look.
    pub miss_probability: f64,
    /// Whether every sensor point, or what else was asked for, reached the wanted tolerance, and
    /// every picture what was wanted of it; never with fewer than 128 samples of sensors.
    pub tolerance_reached: bool,
    /// Whether the sensors alone reached their tolerance, once the pictures are taken.
    #[serde(skip)]
    pub sensors_reached: bool,
    /// How half-widths shrank so far, and what follows from that.
    pub convergence: Convergence,
    /// Sensor points where light may be that no path or photon has found: their value is what was
    /// found, and nothing is known of its error.
    pub unresolved_points: u64,
    /// Whether values may be biased beyond what their intervals say.
    pub biased: bool,
    /// Classes of light paths in the scene that the estimator cannot make, such as "lamp, mirror,
    /// point": values are without their light, or have it blurred. Empty where there are none.
    pub cannot_see: Vec<String>,
    /// Warnings that a reader of the results must know.
    pub caveats: Vec<Caveat>,
}

/// The figures of one sensor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SensorEstimates {
    /// Illuminance in lx: one row a replicate, one column a sensor point.
    pub replicate_lx: Vec<Vec<f64>>,
    /// The part of it that comes straight from the lights, mean over the replicates, in lx.
    pub direct_lx: Vec<f64>,
    /// Whether the samples of each point tell how well it is known; points where they do not have
    /// no interval.
    pub evidence: Vec<Evidence>,
    /// Indices per replicate behind each point: fewer than of others where it reached its tolerance
    /// before.
    pub samples: Vec<u64>,
    /// The average over the points where these numbers differ: that of the last checkpoint before
    /// they did. `None` where they are equal.
    pub average: Option<EvenAverage>,
    /// The terms of the Neumann series, by bounces, and the rest; empty where none were to be
    /// listed.
    pub terms: Vec<TermEstimates>,
    /// Bounds on light that no sample met; `None` of estimators without a bound. Points with one
    /// have sound evidence: it says what may be missing.
    pub unseen: Option<UnseenLight>,
}

/// Illuminance by light of one number of bounces, or of that many and more, at one sensor.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TermEstimates {
    /// Illuminance in lx: one row a replicate, one column a sensor point.
    pub replicate_lx: Vec<Vec<f64>>,
    /// Whether such light was found, or there can be none; points without have no interval.
    pub resolved: Vec<bool>,
}

/// Where the flux of the photons went, all in lm. Emitted is the sum of the other three.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FluxBalance {
    /// Emitted by all lights.
    pub emitted_lm: f64,
    /// Absorbed by surfaces, tallied at each absorption.
    pub absorbed_lm: f64,
    /// Left the scene.
    pub lost_lm: f64,
    /// Cut by `max_bounces`.
    pub cut_lm: f64,
}

/// How many coordinates samples used, the constructive dimension; empty where nothing was traced.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Dimensions {
    /// Of the photons, those that weight windows split off by themselves.
    #[serde(with = "crate::codec::histogram")]
    pub photon: DimensionHistogram,
    /// Photons that began, for estimate, map, energy balance and what decided over them together;
    /// those that were split off are not among them, nor those that look for what paths cannot
    /// find.
    pub photons: u64,
    /// Surfaces that all these photons came to.
    pub photon_events: u64,
    /// Of the paths from sensors.
    #[serde(with = "crate::codec::histogram")]
    pub path: DimensionHistogram,
}

impl SensorEstimates {
    /// Points at which no replicate found light.
    #[must_use]
    pub fn dark_points(&self) -> Vec<usize> {
        let points = 0..self.direct_lx.len();
        points.filter(|&point| self.replicate_lx.iter().all(|row| row[point] == 0.0)).collect()
    }
}

impl Estimates {
    /// Of a run that was stopped before its first checkpoint: no value is a number.
    pub(crate) fn nothing(scene: &Scene, settings: &Settings) -> Self {
        let of_sensor = |sensor: &Sensor| {
            let points = sensor.len();
            let replicates = settings.effective_replicates() as usize;
            let unknown_lx = vec![vec![f64::NAN; points]; replicates];
            let terms = if settings.list_terms > 0 { settings.list_terms + 1 } else { 0 };
            let term =
                TermEstimates { replicate_lx: unknown_lx.clone(), resolved: vec![false; points] };
            SensorEstimates {
                replicate_lx: unknown_lx,
                direct_lx: vec![f64::NAN; points],
                evidence: vec![Evidence::Dark; points],
                samples: vec![0; points],
                average: None,
                terms: vec![term; terms as usize],
                unseen: settings.estimator.is_bounded().then(|| UnseenLight::unknown(points)),
            }
        };
        Self {
            sensors: scene.sensors.iter().map(of_sensor).collect(),
            confidence: settings.confidence,
            miss_probability: 1.0 - settings.confidence,
            unresolved_points: scene.sensors.iter().map(|it| it.len() as u64).sum(),
            caveats: vec![Caveat::NoValues],
            ..Self::default()
        }
    }

    /// The interval of an average or another figure that is linear in the values of one sensor, in
    /// lx: `statistic` maps them to it. No half-width where nothing was found at a point, here and
    /// in the other figures of all points: how much is missing there is unknown.
    #[must_use]
    pub fn interval_of(&self, sensor: usize, statistic: impl Fn(&[f64]) -> f64) -> Interval {
        self.where_resolved(sensor, self.found_interval_of(sensor, statistic))
    }

    /// The interval of an average or another linear figure of what was found, with its half-width
    /// even where nothing was found at a point.
    fn found_interval_of(&self, sensor: usize, statistic: impl Fn(&[f64]) -> f64) -> Interval {
        let rows = &self.sensors[sensor].replicate_lx;
        let figures: Vec<f64> = rows.iter().map(|row| statistic(row)).collect();
        self.interval_of_replicates(&figures)
    }

    fn interval_of_replicates(&self, figures: &[f64]) -> Interval {
        let t = t_quantile_for(figures.len(), self.miss_probability);
        Interval::of_mean(figures.iter().copied(), t)
    }

    /// Without its half-width where nothing was found at a point of the sensor.
    fn where_resolved(&self, sensor: usize, interval: Interval) -> Interval {
        let is_resolved = self.sensors[sensor].evidence.iter().all(|own| own.is_sound());
        Interval { half_width: interval.half_width.filter(|_| is_resolved), ..interval }
    }

    /// The interval of the mean of the points of one sensor, in lx: of the last checkpoint at which
    /// all of them had the same number of samples.
    #[must_use]
    pub fn average(&self, sensor: usize) -> Interval {
        self.where_resolved(sensor, self.found_average(sensor))
    }

    /// The average of what was found, whatever is missing: what decides whether a run goes on.
    pub(crate) fn found_average(&self, sensor: usize) -> Interval {
        self.interval_of_replicates(&self.sensors[sensor].average_lx())
    }

    /// The interval of the smallest value of one sensor, in lx: that of the point where it truly is
    /// smallest, which need not be the one that seems to be.
    #[must_use]
    pub fn minimum(&self, sensor: usize) -> Interval {
        let interval_of_minimum =
            interval_of_minimum(&self.sensors[sensor].replicate_lx, self.miss_probability);
        self.where_resolved(sensor, interval_of_minimum)
    }

    /// The interval of the largest value of one sensor, in lx.
    #[must_use]
    pub fn maximum(&self, sensor: usize) -> Interval {
        let rows = &self.sensors[sensor].replicate_lx;
        let negative: Vec<Vec<f64>> =
            rows.iter().map(|row| row.iter().map(|lx| -lx).collect()).collect();
        let Interval { value, half_width } = interval_of_minimum(&negative, self.miss_probability);
        self.where_resolved(sensor, Interval { value: -value, half_width })
    }

    /// The interval of the smallest value over the mean of one sensor.
    #[must_use]
    pub fn uniformity(&self, sensor: usize) -> Interval {
        let own = &self.sensors[sensor];
        let ratios = ratios(&own.replicate_lx, &own.average_lx());
        let interval_of_minimum = interval_of_minimum(&ratios, self.miss_probability);
        self.where_resolved(sensor, interval_of_minimum)
    }

    /// The intervals of all points of one sensor, in lx; no half-width where nothing was found.
    #[must_use]
    pub fn point_intervals(&self, sensor: usize) -> Vec<Interval> {
        let SensorEstimates { replicate_lx, evidence, .. } = &self.sensors[sensor];
        self.intervals(replicate_lx, |point| evidence[point].is_sound())
    }

    /// The intervals of one term of the Neumann series at all points of one sensor, in lx; no
    /// half-width where nothing was found that might be.
    #[must_use]
    pub fn term_intervals(&self, sensor: usize, term: usize) -> Vec<Interval> {
        let TermEstimates { replicate_lx, resolved } = &self.sensors[sensor].terms[term];
        self.intervals(replicate_lx, |point| resolved[point])
    }

    /// The interval of the mean of one term over the points of one sensor, in lx.
    #[must_use]
    pub fn term_average(&self, sensor: usize, term: usize) -> Interval {
        let own = &self.sensors[sensor];
        let interval = self.interval_of_replicates(&own.average_of_term_lx(term));
        let is_resolved = own.terms[term].resolved.iter().all(|resolved| *resolved);
        Interval { half_width: interval.half_width.filter(|_| is_resolved), ..interval }
    }

    fn intervals(
        &self,
        replicate_lx: &[Vec<f64>],
        is_sound: impl Fn(usize) -> bool,
    ) -> Vec<Interval> {
        let t = t_quantile_for(replicate_lx.len(), self.miss_probability);
        let values = |point: usize| replicate_lx.iter().map(move |row| row[point]);
        let t_at = |point: usize| t.filter(|_| is_sound(point));
        let points = replicate_lx.first().map_or(0, Vec::len);
        (0..points).map(|p| Interval::of_mean(values(p), t_at(p))).collect()
    }
}

/// The mean of each row.
fn means(rows: &[Vec<f64>]) -> Vec<f64> {
    rows.iter().map(|row| mean(row)).collect()
}

impl SensorEstimates {
    /// Keeps the average of the checkpoint before where points have ended since.
    pub(crate) fn keep_average(&mut self, before: &Self) {
        let are_equal = self.samples.iter().all(|samples| *samples == self.samples[0]);
        if !are_equal {
            self.average = Some(before.average.clone().unwrap_or_else(|| EvenAverage {
                replicate_lx: before.average_lx(),
                terms_lx: (0..before.terms.len()).map(|it| before.average_of_term_lx(it)).collect(),
                unseen_lx: before.unseen_of_average_lx(),
            }));
        }
    }

    /// The average of equal numbers of samples in lx, by replicate.
    fn average_lx(&self) -> Vec<f64> {
        match &self.average {
            Some(kept) => kept.replicate_lx.clone(),
            None => means(&self.replicate_lx),
        }
    }

    /// That of a term of the Neumann series.
    fn average_of_term_lx(&self, term: usize) -> Vec<f64> {
        match &self.average {
            Some(kept) => kept.terms_lx[term].clone(),
            None => means(&self.terms[term].replicate_lx),
        }
    }

    /// The bound in lx on light that no sample met in that average.
    fn unseen_of_average_lx(&self) -> Option<f64> {
        match &self.average {
            Some(kept) => kept.unseen_lx,
            None => self.unseen.as_ref().map(|unseen| unseen.average_lx),
        }
    }

    /// The figures of some of its points.
    pub(crate) fn part(&self, points: Range<usize>) -> Self {
        let columns = |rows: &[Vec<f64>]| -> Vec<Vec<f64>> {
            rows.iter().map(|row| row[points.clone()].to_vec()).collect()
        };
        let term = |term: &TermEstimates| TermEstimates {
            replicate_lx: columns(&term.replicate_lx),
            resolved: term.resolved[points.clone()].to_vec(),
        };
        Self {
            replicate_lx: columns(&self.replicate_lx),
            direct_lx: self.direct_lx[points.clone()].to_vec(),
            evidence: self.evidence[points.clone()].to_vec(),
            samples: self.samples[points.clone()].to_vec(),
            average: None,
            terms: self.terms.iter().map(term).collect(),
            unseen: self.unseen.as_ref().map(|unseen| unseen.part(points)),
        }
    }
}

/// How half-widths shrank so far, and what follows from that.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Convergence {
    /// The measured exponent of N in half-widths; `None` before there are enough checkpoints, or
    /// where nothing has a half-width above 0. About -0.5 says that the points are no better than
    /// random ones.
    pub slope: Option<f64>,
    /// Indices per replicate at which the tolerance should be reached, whatever limit may come
    /// first; `None` where nothing says when.
    pub samples: Option<u64>,
    /// Rays of the whole run up to there.
    pub rays: Option<u64>,
    /// Half-widths over what was predicted for them two checkpoints before with a measured slope:
    /// the geometric mean over checkpoints, each as often as it had targets with one before and
    /// after that grew.
    pub against_prediction: Option<f64>,
}

impl Estimates {
    /// The interval of the mean luminance of a picture, in cd/m^2. Pictures are not looked at
    /// before their end, so it has the nominal confidence.
    #[must_use]
    pub fn picture_mean(&self, camera: usize) -> Interval {
        let means = &self.cameras[camera].replicate_mean_cd_m2;
        let t = t_quantile_for(means.len(), 1.0 - self.confidence);
        Interval::of_mean(means.iter().copied(), t)
    }
}

impl Estimates {
    /// The certified intervals of all points of one sensor; `None` where they were not
    /// asked for, and of runs without replicates that differ.
    #[must_use]
    pub fn certified_points(&self, sensor: usize) -> Option<Vec<CertifiedInterval>> {
        let SensorEstimates { samples, .. } = &self.sensors[sensor];
        (0..samples.len()).map(|point| self.certified(sensor, point..point + 1)).collect()
    }

    /// That of the average over a sensor's points; `None` where some of them ended before others,
    /// too: means over points of different age are no sum over indices.
    #[must_use]
    pub fn certified_average(&self, sensor: usize) -> Option<CertifiedInterval> {
        self.certified(sensor, 0..self.sensors[sensor].samples.len())
    }

    /// That of the mean of some points with equally many samples.
    fn certified(&self, sensor: usize, points: Range<usize>) -> Option<CertifiedInterval> {
        let SensorEstimates { replicate_lx, samples, unseen, .. } = &self.sensors[sensor];
        let totals = unseen.as_ref()?.totals.as_ref()?;
        let samples = samples[points.clone()].iter().copied();
        let samples = samples.clone().min().filter(|least| samples.max() == Some(*least))?;
        let computed_lx = mean(&totals.computed_lx[points.clone()]);
        let sampled_lx = |row: &Vec<f64>| (mean(&row[points.clone()]) - computed_lx).max(0.0);
        let replicates_lx: Vec<f64> = replicate_lx.iter().map(sampled_lx).collect();
        let is_whole = !self.biased && self.invalid_contributions == 0;
        let most = |lx: &[f64]| lx[points.clone()].iter().copied().fold(0.0, f64::max);
        let measured = Measured {
            replicates_lx: &replicates_lx,
            computed_lx,
            most_lx: if is_whole { most(&totals.most_lx) } else { f64::INFINITY },
            beyond_lx: most(&totals.beyond_lx),
            samples,
        };
        // Each of both limits may miss with a half.
        let miss = 0.5 * (1.0 - self.confidence);
        let has_looks = self.miss_probability < 1.0 - self.confidence;
        let miss = if has_looks { miss_at_a_checkpoint(miss, samples) } else { miss };
        (replicates_lx.len() > 1).then(|| CertifiedInterval::new(&measured, miss))
    }

    /// The illuminance in lx at most that no sample met in the average over a sensor's points, with
    /// [`UNSEEN_CONFIDENCE`](crate::unseen::UNSEEN_CONFIDENCE); `None` of estimators without a
    /// bound.
    #[must_use]
    pub fn unseen_of_average(&self, sensor: usize) -> Option<f64> {
        self.sensors[sensor].unseen_of_average_lx()
    }

    /// How much larger in lx the smallest value of one sensor may be by light that no sample met:
    /// with bounds that hold at all m points at once, `u'_t = u_t ln(m / 0.05) / ln(1 / 0.05)`,
    /// it is `min(v_t + u'_t) - min(v_t)`.
    #[must_use]
    pub fn unseen_of_minimum(&self, sensor: usize) -> Option<f64> {
        self.unseen_of_extreme(sensor, f64::INFINITY, f64::min)
    }

    /// How much larger in lx the largest value of one sensor may be by light that no sample met;
    /// see [`Self::unseen_of_minimum`].
    #[must_use]
    pub fn unseen_of_maximum(&self, sensor: usize) -> Option<f64> {
        self.unseen_of_extreme(sensor, f64::NEG_INFINITY, f64::max)
    }

    fn unseen_of_extreme(
        &self,
        sensor: usize,
        start: f64,
        of: impl Fn(f64, f64) -> f64,
    ) -> Option<f64> {
        let SensorEstimates { replicate_lx, unseen, .. } = &self.sensors[sensor];
        let bounds_lx = &unseen.as_ref()?.point_lx;
        let factor = factor_of_all(bounds_lx.len());
        let value_lx = |point: usize| {
            replicate_lx.iter().map(|row| row[point]).sum::<f64>() / replicate_lx.len() as f64
        };
        let points = bounds_lx.iter().enumerate();
        let [without, with] = points.fold([start; 2], |[without, with], (point, bound_lx)| {
            let value_lx = value_lx(point);
            [of(without, value_lx), of(with, value_lx + factor * bound_lx)]
        });
        let more_lx = with - without;
        // NaN is not known at all.
        Some(if more_lx.is_nan() { f64::INFINITY } else { more_lx.max(0.0) })
    }
}

fn mean(lx: &[f64]) -> f64 {
    lx.iter().sum::<f64>() / lx.len() as f64
}
