//! Settings as they stand in checkpoints and plans: every one of them, defaults too.

use crate::exit::CliError;
use crate::names;
use quasilux_sampling::Randomization;
use quasilux_transport::{EstimatorKind, Reconstruction, Settings, Switch, ToleranceOn};
use serde::{Deserialize, Serialize};

/// All settings, by the names and in the units of the project file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SettingsRecord {
    estimator: String,
    sequence: String,
    randomization: String,
    rel_tol: f64,
    abs_tol_lx: f64,
    tolerance_on: String,
    confidence: f64,
    replicates: u32,
    seed: u64,
    max_bounces: Option<u32>,
    list_terms: u32,
    samples: Option<u64>,
    rays: Option<u64>,
    first_shot: String,
    map_element_m: Option<f64>,
    map_elements: u64,
    map_adaptive: bool,
    map_reconstruction: String,
    map_photons: u32,
    map_dimensions: Option<u32>,
    image_depth: Option<u32>,
    importance: String,
    connections: String,
}

impl SettingsRecord {
    pub(crate) fn new(settings: &Settings) -> Self {
        let Settings {
            estimator,
            sequence,
            randomization,
            rel_tol,
            abs_tol_lx,
            tolerance_on,
            confidence,
            replicates,
            seed,
            max_bounces,
            list_terms,
            max_samples,
            max_rays,
            first_shot,
            map_element_m,
            map_elements,
            map_adaptive,
            map_reconstruction,
            map_photons,
            map_dimensions,
            image_depth,
            importance,
            connections,
        } = settings.clone();
        Self {
            estimator: estimator.name().to_owned(),
            sequence: sequence.name().to_owned(),
            randomization: randomization.name().to_owned(),
            rel_tol,
            abs_tol_lx,
            tolerance_on: tolerance_on.name().to_owned(),
            confidence,
            replicates,
            seed,
            max_bounces,
            list_terms,
            samples: max_samples,
            rays: max_rays,
            first_shot: first_shot.name().to_owned(),
            map_element_m,
            map_elements,
            map_adaptive,
            map_reconstruction: map_reconstruction.name().to_owned(),
            map_photons,
            map_dimensions,
            image_depth,
            importance: importance.name().to_owned(),
            connections: connections.name().to_owned(),
        }
    }

    /// The settings; `file` is what messages call the file that they stand in.
    pub(crate) fn settings(&self, file: &str) -> Result<Settings, CliError> {
        fn named<T: Copy>(file: &str, name: &str, known: &[(&str, T)]) -> Result<T, CliError> {
            names::on_command_line(&format!("{file}: settings"), name, known)
        }
        let is_share = |x: f64| x > 0.0 && x < 1.0;
        let is_length = |x: f64| x > 0.0 && x.is_finite();
        let in_range = is_share(self.confidence)
            && (0.0..=1.0).contains(&self.rel_tol)
            && self.abs_tol_lx >= 0.0
            && self.abs_tol_lx.is_finite()
            && self.replicates > 0
            && self.map_elements > 0
            && self.map_photons > 0
            && self.samples.is_none_or(|samples| samples > 0)
            && self.rays.is_none_or(|rays| rays > 0)
            && self.map_element_m.is_none_or(is_length);
        if !in_range {
            return Err(CliError::new(format!("{file}: its settings are out of range")));
        }
        Ok(Settings {
            estimator: named(file, &self.estimator, &EstimatorKind::NAMES)?,
            sequence: named(file, &self.sequence, &names::sequences(self.samples))?,
            randomization: named(file, &self.randomization, &Randomization::NAMES)?,
            rel_tol: self.rel_tol,
            abs_tol_lx: self.abs_tol_lx,
            tolerance_on: named(file, &self.tolerance_on, &ToleranceOn::NAMES)?,
            confidence: self.confidence,
            replicates: self.replicates,
            seed: self.seed,
            max_bounces: self.max_bounces,
            list_terms: self.list_terms,
            max_samples: self.samples,
            max_rays: self.rays,
            first_shot: named(file, &self.first_shot, &Switch::NAMES)?,
            map_element_m: self.map_element_m,
            map_elements: self.map_elements,
            map_adaptive: self.map_adaptive,
            map_reconstruction: named(file, &self.map_reconstruction, &Reconstruction::NAMES)?,
            map_photons: self.map_photons,
            map_dimensions: self.map_dimensions,
            image_depth: self.image_depth,
            importance: named(file, &self.importance, &Switch::NAMES)?,
            connections: named(file, &self.connections, &Switch::NAMES)?,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use quasilux_sampling::Sequence;

    #[test]
    fn settings_come_back() {
        let settings = Settings {
            sequence: Sequence::Hammersley { points: 77 },
            max_samples: Some(77),
            seed: u64::MAX,
            rel_tol: 0.1 + 0.2,
            abs_tol_lx: 0.7,
            tolerance_on: ToleranceOn::Summary,
            confidence: 0.99,
            max_rays: Some(1 << 60),
            map_element_m: Some(1.0 / 3.0),
            map_photons: 7,
            map_dimensions: Some(9),
            connections: Switch::Off,
            ..Settings::default()
        };
        for settings in [settings, Settings::default()] {
            let text = serde_json::to_string(&SettingsRecord::new(&settings)).unwrap();
            let record: SettingsRecord = serde_json::from_str(&text).unwrap();
            assert_eq!(record.settings("x").unwrap(), settings);
        }
        let mut bad = SettingsRecord::new(&Settings::default());
        bad.confidence = 1.0;
        assert!(bad.settings("x").is_err());
    }
}
