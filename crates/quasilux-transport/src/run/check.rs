//! Whether settings make sense for a scene, and what a reader of the results must know.

use crate::settings::{EstimatorKind, IntervalKind, Settings, Switch, UnseenTolerance};
use crate::stats::caveat::Caveat;
use quasilux_scene::{Quantity, Scene, SensorShape};

/// Settings that cannot work for this scene.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CheckError {
    /// A setting that means nothing.
    #[error("{setting} is out of range: expected {expected}")]
    OutOfRange {
        /// Name of the setting.
        setting: &'static str,
        /// Values that it can have.
        expected: &'static str,
    },
    /// The points of a sequence that must know how many there are have to be those of the run.
    #[error("{sequence} needs the number of points in advance: set max_samples to the same number")]
    OtherNumberOfPoints {
        /// Name of the sequence.
        sequence: &'static str,
    },
    /// Photon counting needs the flux through a grid's own plane.
    #[error(
        "sensor \"{sensor}\": the estimator \"photon\" needs a grid whose normal is perpendicular \
         to it"
    )]
    TiltedNormal {
        /// Name of the sensor.
        sensor: String,
    },
    /// Photons never meet a pinhole.
    #[error(
        "camera \"{camera}\": the estimator \"photon\" takes no pictures; use another estimator"
    )]
    CameraOfPhotons {
        /// Name of the camera.
        camera: String,
    },
    /// These photons are counted from their first flight on, or there are none.
    #[error(
        "first_shot = \"on\" needs illumination maps, which the estimator \"{estimator}\" does \
         not have; use \"bidirectional-map\""
    )]
    FirstShotWithoutMap {
        /// Name of the estimator.
        estimator: &'static str,
    },
    /// No photon of these is split or ended.
    #[error(
        "importance = \"on\" needs photons that sensors count or that fill illumination maps, \
         which the estimator \"{estimator}\" does not have; use \"photon\" or \"bidirectional-map\""
    )]
    NothingToGuide {
        /// Name of the estimator.
        estimator: &'static str,
    },
    /// Nothing can be left out of a map that is not there.
    #[error(
        "map_dimensions needs illumination maps, which the estimator \"{estimator}\" does not \
         have; use \"bidirectional-map\""
    )]
    NoMapToLeaveOutOf {
        /// Name of the estimator.
        estimator: &'static str,
    },
    /// Nothing is known of single contributions.
    #[error(
        "interval = \"certified\" needs bounds, which the estimator \"{estimator}\" does not \
         have; use \"auto\""
    )]
    NothingCertified {
        /// Name of the estimator.
        estimator: &'static str,
    },
    /// There is nothing to compare.
    #[error(
        "interval = \"certified\" needs at least 2 randomised replicates: their number bounds how \
         near a lower limit comes"
    )]
    NoReplicates,
    /// There is no light at all.
    #[error("the lights of the scene emit nothing")]
    Dark,
}

/// Checks that a simulation with these settings means something in this scene.
///
/// # Errors
/// See [`CheckError`].
pub fn check(scene: &Scene, settings: &Settings) -> Result<(), CheckError> {
    check_ranges(settings)?;
    let flux_lm = scene.flux_lm();
    if !((flux_lm > 0.0 || scene.environment.is_some()) && flux_lm.is_finite()) {
        return Err(CheckError::Dark);
    }
    check_switches(settings)?;
    check_interval(settings)?;
    if settings.estimator == EstimatorKind::Photon { check_photon_sensors(scene) } else { Ok(()) }
}

/// Whether each number is one that a setting can have.
fn check_ranges(settings: &Settings) -> Result<(), CheckError> {
    let expect = |setting, in_range: bool, expected| {
        if in_range { Ok(()) } else { Err(CheckError::OutOfRange { setting, expected }) }
    };
    let is_tolerance = |x: f64| x >= 0.0 && x.is_finite();
    let is_length = |x: f64| x > 0.0 && x.is_finite();
    let at_least_1 = "a number of at least 1";
    let confidence = settings.confidence;
    expect("rel_tol", is_tolerance(settings.rel_tol), "a share of at least 0")?;
    expect("abs_tol_lx", is_tolerance(settings.abs_tol_lx), "an illuminance of at least 0")?;
    let is_share = match settings.unseen_tol {
        UnseenTolerance::Share(share) => is_tolerance(share),
        UnseenTolerance::Off => true,
    };
    expect("unseen_tol", is_share, "a share of at least 0")?;
    expect("confidence", confidence > 0.0 && confidence < 1.0, "a share between 0 and 1")?;
    expect("replicates", settings.replicates > 0, at_least_1)?;
    expect("max_samples", settings.max_samples != Some(0), at_least_1)?;
    expect("max_rays", settings.max_rays != Some(0), at_least_1)?;
    expect("map_element_m", settings.map_element_m.is_none_or(is_length), "a length above 0")?;
    expect("map_elements", settings.map_elements > 0, at_least_1)?;
    expect("map_photons", settings.map_photons > 0, at_least_1)?;
    let sequence = settings.sequence;
    if sequence.points().is_some() && sequence.points() != settings.max_samples {
        return Err(CheckError::OtherNumberOfPoints { sequence: sequence.name() });
    }
    Ok(())
}

/// Whether each switch that is on has something to switch.
fn check_switches(settings: &Settings) -> Result<(), CheckError> {
    let ends_on_map = settings.estimator == EstimatorKind::BidirectionalMap;
    if settings.first_shot == Switch::On && !ends_on_map {
        return Err(CheckError::FirstShotWithoutMap { estimator: settings.estimator.name() });
    }
    if settings.map_dimensions.is_some() && !ends_on_map {
        return Err(CheckError::NoMapToLeaveOutOf { estimator: settings.estimator.name() });
    }
    let guides_photons = ends_on_map || settings.estimator == EstimatorKind::Photon;
    if settings.importance == Switch::On && !guides_photons {
        return Err(CheckError::NothingToGuide { estimator: settings.estimator.name() });
    }
    Ok(())
}

/// Whether intervals of this kind can be had.
fn check_interval(settings: &Settings) -> Result<(), CheckError> {
    let estimator = settings.estimator;
    if settings.interval != IntervalKind::Certified {
        return Ok(());
    }
    if !estimator.is_bounded() {
        return Err(CheckError::NothingCertified { estimator: estimator.name() });
    }
    if settings.effective_replicates() < 2 { Err(CheckError::NoReplicates) } else { Ok(()) }
}

/// Whether photons can be counted at all sensors, and for no camera.
fn check_photon_sensors(scene: &Scene) -> Result<(), CheckError> {
    if let Some(camera) = scene.cameras.first() {
        return Err(CheckError::CameraOfPhotons { camera: camera.name.clone() });
    }
    for sensor in &scene.sensors {
        if let SensorShape::Grid(grid) = &sensor.shape {
            let cos = grid.normal.dot(grid.u.cross(grid.v).normalize());
            if cos.abs() < 1.0 - 1e-9 {
                return Err(CheckError::TiltedNormal { sensor: sensor.name.clone() });
            }
        }
    }
    Ok(())
}

/// Whether values may be biased beyond what their intervals say.
pub(crate) fn is_biased(scene: &Scene, settings: &Settings) -> bool {
    !caveats_of_values(scene, settings).is_empty()
}

/// All that a reader of the results must know.
pub(crate) fn caveats(scene: &Scene, settings: &Settings) -> Vec<Caveat> {
    let mut caveats = caveats_of_values(scene, settings);
    if settings.effective_replicates() < 2 {
        caveats.push(Caveat::OneReplicate);
    }
    caveats
}

/// Warnings about biased values.
fn caveats_of_values(scene: &Scene, settings: &Settings) -> Vec<Caveat> {
    let mut caveats = Vec::new();
    match settings.estimator {
        EstimatorKind::Photon => {
            let reads_points = |shape: &SensorShape| match shape {
                SensorShape::Points(_) => true,
                SensorShape::Grid(grid) => grid.quantity == Quantity::Centre,
            };
            if scene.sensors.iter().any(|sensor| reads_points(&sensor.shape)) {
                caveats.push(Caveat::MeansAtPoints);
            }
        }
        EstimatorKind::BidirectionalMap => {
            caveats.push(Caveat::MeansOverMapElements);
            let left_out = |map_dimensions| Caveat::MapDimensions { map_dimensions };
            caveats.extend(settings.map_dimensions.map(left_out));
        }
        EstimatorKind::Auto | EstimatorKind::Path | EstimatorKind::Bidirectional => {}
    }
    caveats
}
