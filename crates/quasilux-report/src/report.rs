//! The result of a run, built once; all forms of output are read from it.
//!
//! A number that leaves the program carries its interval, the replicates behind it and the settings
//! that made it. Nothing in a [`Report`] is infinite or not a number: such a figure is `None`, and
//! a warning says so.

use crate::CameraReport;
use crate::caveat::Caveat;
use crate::certified::{self, CertifiedFigure, CertifiedFigures};
use crate::figure::{Figure, finite};
use crate::outside::{DaylightFactor, Outside};
use crate::unseen::{self, PointUnseen, SummaryUnseen};
use glam::DVec3;
use quasilux_inspection::Finding;
use quasilux_scene::{Grid, Scene, SensorShape};
use quasilux_transport::{
    Convergence, DaylightComponents, Decisions, Dimensions, Estimates, Explanation, FluxBalance,
    PointStatus, SensorEstimates, Settings,
};

/// What the program that ran the simulation knows and the simulation does not.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RunFacts {
    /// Version of the program.
    pub version: String,
    /// What it was built of, where builds of one version are told apart.
    pub build: String,
    /// SHA-256 of the files that the scene was read from; empty where nobody knows.
    pub scene_sha256: String,
    /// Duration of the run in s, with what it took before it was gone on with.
    pub seconds: f64,
    /// What of them it took before it was gone on with.
    pub earlier_seconds: f64,
    /// Rays that were traced before that.
    pub earlier_rays: u64,
    /// Threads that worked on it.
    pub threads: usize,
    /// Memory in bytes that the whole program should take up to the tolerance, as far as anybody
    /// can say.
    pub expected_bytes: Option<u64>,
    /// What the lights give in use over what they give when new, if the project says so.
    pub maintenance_factor: Option<f64>,
    /// What is known of daylight at the points, sensor by sensor, if anything.
    pub daylight: Option<Vec<DaylightComponents>>,
    /// Warnings of the loaders.
    pub warnings: Vec<String>,
    /// What is probably wrong with the scene.
    pub findings: Vec<Finding>,
}

/// A run and its results.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// One entry a sensor, in the order of the scene.
    pub sensors: Vec<SensorReport>,
    /// One entry a camera, in the order of the scene.
    pub cameras: Vec<CameraReport>,
    /// What shines from outside.
    pub outside: Option<Outside>,
    /// How the results were made.
    pub run: Run,
    /// Where the variance comes from, if that was asked for; [`Self::new`] leaves it to its caller.
    pub explanation: Option<Explanation>,
    /// Whether values may be biased beyond what their intervals say; a warning says why.
    pub biased: bool,
    /// What is probably wrong with the scene.
    pub findings: Vec<Finding>,
    /// What a reader of the results must know of them, for programs.
    pub caveats: Vec<Caveat>,
    /// All that a reader of the results must know, in words: from loading, what is probably wrong
    /// with the scene, and the caveats.
    pub warnings: Vec<String>,
}

/// The results of one sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct SensorReport {
    /// The sensor's name.
    pub name: String,
    /// The rectangle and its cells, where the sensor is a grid.
    pub grid: Option<Grid>,
    /// The points, u fastest in a grid.
    pub points: Vec<PointReport>,
    /// Figures of all points together.
    pub summary: Summary,
    /// The terms of the Neumann series, by bounces, and the rest; empty where none were to be
    /// listed.
    pub terms: Vec<TermReport>,
}

/// What light of one number of bounces gives to a sensor, or of more than all listed ones.
#[derive(Clone, Debug, PartialEq)]
pub struct TermReport {
    /// The number of bounces; `None` for the rest.
    pub bounces: Option<u32>,
    /// Mean of the points in lx.
    pub average_lx: Figure,
    /// At each point, in lx.
    pub points_lx: Vec<Figure>,
}

/// The results at one point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointReport {
    /// World position in m.
    pub position_m: DVec3,
    /// Unit normal.
    pub normal: DVec3,
    /// Illuminance in lx.
    pub illuminance_lx: Figure,
    /// The part of it that comes straight from the lights, in lx.
    pub direct_lx: Option<f64>,
    /// What its samples leave open.
    pub unseen: PointUnseen,
    /// Limits that hold for any number of samples, where they were asked for.
    pub certified_lx: Option<CertifiedFigure>,
    /// The share of the light outside, where only the sky shines.
    pub daylight_factor: Option<DaylightFactor>,
    /// Indices used by each replicate for this point.
    pub samples: u64,
    /// Whether it is known as well as was asked for, and what is missing if not; `None` without a
    /// tolerance.
    pub status: Option<PointStatus>,
}

/// Figures of all points of a sensor, their intervals from the replicates.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Summary {
    /// Mean of the points in lx; the cells of a grid are equal in area.
    pub average_lx: Figure,
    /// Smallest value in lx.
    pub minimum_lx: Figure,
    /// Largest value in lx.
    pub maximum_lx: Figure,
    /// Minimum over average.
    pub uniformity: Figure,
    /// What the samples leave open; `None` of estimators without a bound.
    pub unseen: Option<SummaryUnseen>,
    /// Limits of the average that hold for any number of samples, where they were asked for.
    pub certified_average_lx: Option<CertifiedFigure>,
}

/// How the results were made.
#[derive(Clone, Debug, PartialEq)]
pub struct Run {
    /// Version of the program.
    pub version: String,
    /// What it was built of; empty where nobody knows.
    pub build: String,
    /// SHA-256 of the files that the scene was read from; empty where nobody knows.
    pub scene_sha256: String,
    /// What was asked for.
    pub settings: Settings,
    /// Independent replicates behind each interval; 1 where nothing is randomised.
    pub replicates: u32,
    /// Indices used by each replicate: photons, and paths for each sensor point that needed the
    /// most.
    pub samples: u64,
    /// Rays traced.
    pub rays: u64,
    /// Duration of the run in s, with what it took before it was gone on with.
    pub seconds: f64,
    /// What of them it took before it was gone on with; 0 where nothing stopped it.
    pub earlier_seconds: f64,
    /// Rays that were traced before that.
    pub earlier_rays: u64,
    /// Threads that worked on it.
    pub threads: usize,
    /// Memory in bytes that the whole program should take up to the tolerance.
    pub expected_bytes: Option<u64>,
    /// Factor that is in all light of the run: what lights give in use over what they give when
    /// new. 1 where the project says nothing.
    pub maintenance_factor: f64,
    /// Whether every sensor point, or every average, reached the wanted tolerance, and every
    /// picture is what was wanted.
    pub tolerance_reached: bool,
    /// The same of the sensors alone.
    pub sensors_reached: bool,
    /// Classes of light paths in the scene that the estimator cannot make.
    pub cannot_see: Vec<String>,
    /// What surveys and pilots decided before the first sample.
    pub decisions: Decisions,
    /// How half-widths shrank, and the cost that this predicts.
    pub convergence: Convergence,
    /// Numbers of coordinates that photons and paths used.
    pub dimensions: Dimensions,
    /// Where the photons' flux went.
    pub flux: FluxBalance,
    /// Contributions that were not finite, negative or out of range; they are not in the results.
    pub invalid_contributions: u64,
}

impl Report {
    /// Gathers the results of a simulation.
    ///
    /// # Panics
    /// If `estimates` do not belong to `scene`.
    #[must_use]
    pub fn new(scene: &Scene, settings: &Settings, estimates: &Estimates, facts: RunFacts) -> Self {
        assert_eq!(scene.sensors.len(), estimates.sensors.len(), "estimates of another scene");
        let outside = Outside::new(scene);
        let mut sensors = SensorReport::all(scene, estimates, settings);
        add_daylight_factors(&mut sensors, outside, facts.daylight.as_deref());
        assert_eq!(scene.cameras.len(), estimates.cameras.len(), "estimates of another scene");
        let cameras =
            (0..scene.cameras.len()).map(|c| CameraReport::new(scene, estimates, c)).collect();
        let mut warnings = facts.warnings;
        warnings.extend(facts.findings.iter().map(ToString::to_string));
        let caveats = caveats(scene, settings, estimates, &sensors);
        warnings.extend(caveats.iter().map(ToString::to_string));
        Self {
            sensors,
            cameras,
            outside,
            run: Run {
                version: facts.version,
                build: facts.build,
                scene_sha256: facts.scene_sha256,
                settings: settings.clone(),
                replicates: settings.effective_replicates(),
                samples: estimates.samples,
                rays: estimates.rays,
                seconds: facts.seconds,
                earlier_seconds: facts.earlier_seconds,
                earlier_rays: facts.earlier_rays,
                threads: facts.threads,
                expected_bytes: facts.expected_bytes,
                maintenance_factor: facts.maintenance_factor.unwrap_or(1.0),
                tolerance_reached: estimates.tolerance_reached,
                sensors_reached: estimates.sensors_reached,
                cannot_see: estimates.cannot_see.clone(),
                decisions: estimates.decisions.clone(),
                convergence: estimates.convergence,
                dimensions: estimates.dimensions.clone(),
                flux: estimates.flux,
                invalid_contributions: estimates.invalid_contributions,
            },
            explanation: None,
            biased: estimates.biased,
            findings: facts.findings,
            caveats,
            warnings,
        }
    }
}

/// What a reader must know: from the simulation, and of the figures.
fn caveats(
    scene: &Scene,
    settings: &Settings,
    estimates: &Estimates,
    sensors: &[SensorReport],
) -> Vec<Caveat> {
    let mut caveats: Vec<Caveat> = estimates.caveats.iter().cloned().map(Caveat::from).collect();
    let is_explained = estimates.caveats.iter().any(quasilux_transport::Caveat::is_bias);
    if estimates.biased && !is_explained {
        caveats.push(Caveat::Biased { estimator: settings.estimator });
    }
    caveats.extend(sensors.iter().filter_map(SensorReport::missing_figures));
    caveats.extend(unseen::caveats(scene, estimates, settings));
    caveats.extend(sensors.iter().flat_map(SensorReport::certified_caveats));
    caveats
}

/// Says at all points what share of the light outside they get, where only the sky shines.
fn add_daylight_factors(
    sensors: &mut [SensorReport],
    outside: Option<Outside>,
    components: Option<&[DaylightComponents]>,
) {
    let Some(outside) = outside else { return };
    let points = sensors.iter_mut().flat_map(|sensor| &mut sensor.points);
    for (number, point) in points.enumerate() {
        let components = components.and_then(|components| components.get(number));
        point.daylight_factor = outside.daylight_factor(point.illuminance_lx, components);
    }
}

impl Run {
    /// Duration in s of the whole run up to the tolerance, at the pace of this one. A run that was
    /// gone on with knows its pace from its own rays, if it had any.
    #[must_use]
    pub fn expected_seconds(&self) -> Option<f64> {
        let own_rays = self.rays.saturating_sub(self.earlier_rays);
        let rays = self.convergence.rays.filter(|_| own_rays > 0)?;
        let own_seconds = self.seconds - self.earlier_seconds;
        Some(own_seconds * rays as f64 / own_rays as f64).filter(|seconds| seconds.is_finite())
    }
}

impl SensorReport {
    fn all(scene: &Scene, estimates: &Estimates, settings: &Settings) -> Vec<Self> {
        let new = |sensor| Self::new(scene, estimates, sensor, settings);
        let mut all: Vec<Self> = (0..scene.sensors.len()).map(new).collect();
        let statuses = estimates.point_statuses(settings).into_iter().flatten();
        for (sensor, statuses) in all.iter_mut().zip(statuses) {
            let points = sensor.points.iter_mut().zip(statuses);
            points.for_each(|(point, status)| point.status = Some(status));
        }
        all
    }

    fn new(scene: &Scene, estimates: &Estimates, index: usize, settings: &Settings) -> Self {
        let sensor = &scene.sensors[index];
        let certified = CertifiedFigures::new(estimates, index, settings);
        let intervals = estimates.point_intervals(index);
        let SensorEstimates { direct_lx, samples, unseen, .. } = &estimates.sensors[index];
        let points = sensor
            .points()
            .into_iter()
            .enumerate()
            .map(|(i, point)| PointReport {
                position_m: point.position,
                normal: point.normal,
                illuminance_lx: intervals.get(i).map(|&x| x.into()).unwrap_or_default(),
                direct_lx: direct_lx.get(i).and_then(|&x| finite(x)),
                unseen: unseen.as_ref().map(|own| PointUnseen::new(own, i)).unwrap_or_default(),
                certified_lx: certified.points.as_ref().and_then(|all| all.get(i).copied()),
                daylight_factor: None,
                samples: samples.get(i).copied().unwrap_or_default(),
                status: None,
            })
            .collect();
        Self {
            name: sensor.name.clone(),
            grid: match &sensor.shape {
                SensorShape::Grid(grid) => Some(*grid),
                SensorShape::Points(_) => None,
            },
            points,
            summary: Summary {
                average_lx: estimates.average(index).into(),
                minimum_lx: estimates.minimum(index).into(),
                maximum_lx: estimates.maximum(index).into(),
                uniformity: estimates.uniformity(index).into(),
                unseen: SummaryUnseen::new(estimates, index),
                certified_average_lx: certified.average,
            },
            terms: TermReport::all(estimates, index),
        }
    }

    fn certified_caveats(&self) -> Vec<Caveat> {
        let points: Option<Vec<CertifiedFigure>> =
            self.points.iter().map(|point| point.certified_lx).collect();
        let average = self.summary.certified_average_lx;
        let points = points.filter(|points| !points.is_empty());
        certified::caveats(&self.name, &CertifiedFigures { points, average })
    }

    /// The figures without a value, if there are any.
    fn missing_figures(&self) -> Option<Caveat> {
        let summary = [
            ("average", self.summary.average_lx),
            ("minimum", self.summary.minimum_lx),
            ("maximum", self.summary.maximum_lx),
            ("uniformity", self.summary.uniformity),
        ];
        let missing = summary.iter().filter(|(_, figure)| figure.value.is_none());
        let figures: Vec<&str> = missing.map(|(name, _)| *name).collect();
        let points = self
            .points
            .iter()
            .filter(|p| p.illuminance_lx.value.is_none() || p.direct_lx.is_none())
            .count();
        let of_points = self.points.len();
        (points > 0 || !figures.is_empty()).then(|| Caveat::NoFiniteValue {
            sensor: self.name.clone(),
            figures,
            points,
            of_points,
        })
    }
}

impl TermReport {
    fn all(estimates: &Estimates, sensor: usize) -> Vec<Self> {
        let terms = estimates.sensors[sensor].terms.len();
        let term = |term: usize| Self {
            bounces: (term + 1 < terms).then_some(term as u32),
            average_lx: estimates.term_average(sensor, term).into(),
            points_lx: estimates
                .term_intervals(sensor, term)
                .into_iter()
                .map(Figure::from)
                .collect(),
        };
        (0..terms).map(term).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example;

    #[test]
    fn summary_of_noiseless_replicates_is_exact() {
        let report = example::noiseless(&[100.0, 400.0, 150.0, 150.0]);
        let summary = report.sensors[0].summary;
        let exactly = |value| Figure { value: Some(value), half_width: Some(0.0) };
        assert_eq!(summary.average_lx, exactly(200.0));
        assert_eq!(summary.minimum_lx, exactly(100.0));
        assert_eq!(summary.maximum_lx, exactly(400.0));
        assert_eq!(summary.uniformity, exactly(0.5));
        assert!(report.warnings.is_empty());
    }

    #[test]
    fn undefined_figures_are_none_and_named() {
        let dark = example::noiseless(&[0.0, 0.0]);
        assert_eq!(dark.sensors[0].summary.uniformity, Figure::default());
        assert_eq!(dark.warnings, ["sensor \"desk\": no finite value for uniformity"]);
        let broken = example::noiseless(&[f64::NAN, 1.0]);
        assert_eq!(broken.sensors[0].points[0].illuminance_lx, Figure::default());
        assert_eq!(
            broken.warnings,
            ["sensor \"desk\": no finite value for average, minimum, maximum, uniformity, 1 of \
                 2 points"]
        );
    }

    #[test]
    fn bias_is_never_without_a_warning() {
        let report = example::biased();
        assert!(report.biased);
        let expected = Caveat::Biased { estimator: report.run.settings.estimator };
        assert_eq!(report.warnings, [expected.to_string()]);
        assert_eq!(report.caveats, [expected]);
    }

    /// What already says why values are biased is enough.
    #[test]
    fn bias_is_told_once() {
        let (scene, mut estimates) = example::bounded();
        estimates.biased = true;
        let of_simulation = quasilux_transport::Caveat::PathsTerminated { paths: 3 };
        estimates.caveats.push(of_simulation.clone());
        let report = Report::new(&scene, &Settings::default(), &estimates, RunFacts::default());
        assert_eq!(report.caveats[0], of_simulation.into());
        let is_unexplained = |it: &Caveat| matches!(it, Caveat::Biased { .. });
        assert!(!report.caveats.iter().any(is_unexplained), "{:?}", report.caveats);
    }
}
