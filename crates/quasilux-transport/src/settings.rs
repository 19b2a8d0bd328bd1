//! What a simulation is asked to do.

use quasilux_sampling::{Randomization, Sequence};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// How illuminance is estimated: a closed set.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum EstimatorKind {
    /// [`Self::Bidirectional`].
    Auto,
    /// Photons from the lights are counted by the sensors.
    Photon,
    /// Paths from the sensors with next-event estimation.
    Path,
    /// Paths from the sensors and light subpaths that all of them share, connected, joined and
    /// counted, weighed so that no sample adds more than any technique alone would: what no sample
    /// met has a bound.
    Bidirectional,
    /// The form of Voloboy, Dmitriev and Kopylov (2003): paths end on the map, whose finite
    /// elements leave a bias.
    BidirectionalMap,
}

impl EstimatorKind {
    /// All of them.
    pub const ALL: [Self; 5] =
        [Self::Auto, Self::Photon, Self::Path, Self::Bidirectional, Self::BidirectionalMap];

    /// Whether it bounds the light that no sample met.
    #[must_use]
    pub fn is_bounded(self) -> bool {
        matches!(self, Self::Auto | Self::Bidirectional)
    }

    /// The name in project files, on the command line and in results.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::Photon => "photon",
            Self::Path => "path",
            Self::Bidirectional => "bidirectional",
            Self::BidirectionalMap => "bidirectional-map",
        }
    }
}

/// Whether a measure is taken that may lower the error and never changes the mean: a closed set.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Switch {
    /// Where pilot photons or a survey of the scene say that it pays.
    #[default]
    Auto,
    /// Wherever it can be.
    On,
    /// Never.
    Off,
}

impl Switch {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Auto, Self::On, Self::Off];

    /// The name in project files and results.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Auto => "auto",
            Self::On => "on",
            Self::Off => "off",
        }
    }
}

/// Quantities that have to reach the tolerance: a closed set.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ToleranceOn {
    /// The illuminance at every sensor point.
    #[default]
    Points,
    /// The average of every sensor.
    Summary,
}

impl ToleranceOn {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Points, Self::Summary];

    /// The name in project files, on the command line and in results.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Points => "points",
            Self::Summary => "summary",
        }
    }
}

/// Which intervals are reported beside values: a closed set.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum IntervalKind {
    /// Student's t over replicates, which decides when a run ends.
    #[default]
    StudentT,
    /// Student's t, and limits that hold for any number of samples ([`crate::certified`]).
    Certified,
}

impl IntervalKind {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::StudentT, Self::Certified];

    /// The name in project files, on the command line and in results.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::StudentT => "student-t",
            Self::Certified => "certified",
        }
    }
}

/// How much light that no sample met a value may be done with: a closed set.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum UnseenTolerance {
    /// At most this share of the value, or `rel_tol` of it where that is larger.
    Share(f64),
    /// Any: the bound is reported, and not waited for.
    Off,
}

impl UnseenTolerance {
    /// The name of [`Self::Off`] in project files, on the command line and in results.
    pub const OFF: &str = "off";
}

impl Default for UnseenTolerance {
    fn default() -> Self {
        Self::Share(0.05)
    }
}

/// A number or a name, as users write it.
impl Serialize for UnseenTolerance {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Share(share) => share.serialize(serializer),
            Self::Off => Self::OFF.serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for UnseenTolerance {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        #[serde(untagged)]
        enum Either {
            Share(f64),
            Name(String),
        }
        match Either::deserialize(deserializer)? {
            Either::Share(share) => Ok(Self::Share(share)),
            Either::Name(name) if name == Self::OFF => Ok(Self::Off),
            Either::Name(name) => Err(D::Error::custom(format_args!(
                "unknown tolerance \"{name}\"; expected a share or \"{}\"",
                Self::OFF
            ))),
        }
    }
}

/// Reconstruction of the illuminance in an element of the illumination map from its photons.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Reconstruction {
    /// It is the same all over the element.
    Constant,
    /// It is linear in the element; neighbours need not meet.
    Linear,
}

impl Reconstruction {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Constant, Self::Linear];

    /// The name in project files and in results.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Constant => "constant",
            Self::Linear => "linear",
        }
    }
}

/// Settings of a simulation. No field refers to threads or time: the result is a function of the
/// scene and this.
///
/// As a document (serde) they have the names of their fields, their values the names that users
/// write. A sequence is there by its name alone: the number of points that Hammersley's must know
/// is `max_samples`, which a reader has to fill in ([`Sequence::with_points`]).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Settings {
    /// How illuminance is estimated.
    pub estimator: EstimatorKind,
    /// The point set behind all coordinates. One with a fixed number of points needs the same
    /// number in `max_samples`, and only that ends the run.
    #[serde(with = "sequence_by_name")]
    pub sequence: Sequence,
    /// How replicates are made independent.
    pub randomization: Randomization,
    /// Wanted half-width of the interval over the value; 0 where none is wanted.
    pub rel_tol: f64,
    /// Half-width in lx that is enough whatever the value; 0 where none is. Without either
    /// tolerance nothing but a limit ends the run.
    pub abs_tol_lx: f64,
    /// How much light that no sample met is little enough, of estimators that bound it.
    pub unseen_tol: UnseenTolerance,
    /// Quantities that have to reach the tolerances.
    pub tolerance_on: ToleranceOn,
    /// Which intervals are reported.
    pub interval: IntervalKind,
    /// Confidence level of all intervals, in (0, 1).
    pub confidence: f64,
    /// Number of independent randomisations; 1 leaves results without intervals.
    pub replicates: u32,
    /// Seed of all randomisations.
    pub seed: u64,
    /// Bounces after which light is cut: `Some(0)` leaves the direct light, `None` cuts nothing.
    pub max_bounces: Option<u32>,
    /// How many terms of the Neumann series are listed, light of 0, 1, .. bounces, beside the rest;
    /// 0 lists none. An illumination map gets one layer for each but the first two, and one for the
    /// rest: its memory grows this many times.
    pub list_terms: u32,
    /// Limit on the number of indices per replicate: photons, and paths for each sensor point. A
    /// pixel of a camera gets this many paths, or 16 without a limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_samples: Option<u64>,
    /// Limit on the number of rays: the run ends with the last checkpoint, past the first, that
    /// takes no more.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub max_rays: Option<u64>,
    /// Whether photons for the illumination map leave lit places instead of point-like lights,
    /// where there are any and not too many facets times lights.
    pub first_shot: Switch,
    /// Longest edge of an illumination map element in m before any is split; `None` derives it from
    /// the scene's size.
    pub map_element_m: Option<f64>,
    /// Most elements of the illumination map, both sides of a facet counted once; each diffuse
    /// triangle has one at least. In each replicate, an element side where photons land takes 4
    /// bytes, times 3 if it is linear, times 3 in a scene with colours.
    pub map_elements: u64,
    /// Whether elements are split where pilot photons show that the illumination varies in them.
    pub map_adaptive: bool,
    /// Reconstruction of the illuminance in an element from its photons.
    pub map_reconstruction: Reconstruction,
    /// Photons of each map that grows for every path of a sensor point, at least 1: with many
    /// sensor points, one each is few beside the paths.
    pub map_photons: u32,
    /// Coordinates that a photon may have used when it lands on a map that paths end on, the
    /// balance of Voloboy, Dmitriev and Kopylov (2003): later events, which quasi-random points do
    /// least for, are left out, with their light; `None` leaves nothing out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub map_dimensions: Option<u32>,
    /// How many plane mirrors, one after the other, images of lights are followed through; `None`
    /// goes on while a chain of mirrors reflects 1e-4 at least, and the images stay few.
    pub image_depth: Option<u32>,
    /// Whether photons that sensors count, and those of maps that grow, are split and ended where
    /// that helps the sensors, light subpaths of the default go on in copies there, and its eye
    /// paths are led through openings; else they keep equal flux, and none is led.
    pub importance: Switch,
}

impl Settings {
    /// Whether there is a tolerance to reach.
    #[must_use]
    pub fn has_tolerance(&self) -> bool {
        self.rel_tol > 0.0 || self.abs_tol_lx > 0.0
    }

    /// The half-width in lx that is enough for this value.
    #[must_use]
    pub fn tolerance_lx(&self, value_lx: f64) -> f64 {
        (self.rel_tol * value_lx.abs()).max(self.abs_tol_lx)
    }

    /// The light that no sample met, in lx, that is little enough beside this value; `None` where
    /// it is not waited for.
    #[must_use]
    pub fn unseen_tolerance_lx(&self, value_lx: f64) -> Option<f64> {
        match self.unseen_tol {
            UnseenTolerance::Share(share) => {
                Some((share.max(self.rel_tol) * value_lx.abs()).max(self.abs_tol_lx))
            }
            UnseenTolerance::Off => None,
        }
    }

    /// The number of replicates that differ: one where nothing is randomised.
    #[must_use]
    pub fn effective_replicates(&self) -> u32 {
        match self.randomization {
            Randomization::None if self.sequence != Sequence::Independent => 1,
            _ => self.replicates.max(1),
        }
    }
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            estimator: EstimatorKind::Auto,
            sequence: Sequence::Sobol,
            randomization: Randomization::Owen,
            rel_tol: 0.01,
            abs_tol_lx: 0.0,
            unseen_tol: UnseenTolerance::default(),
            tolerance_on: ToleranceOn::Points,
            interval: IntervalKind::StudentT,
            confidence: 0.95,
            replicates: 16,
            seed: 1,
            max_bounces: None,
            list_terms: 0,
            max_samples: None,
            max_rays: None,
            first_shot: Switch::Auto,
            map_element_m: None,
            map_elements: 1 << 22,
            map_adaptive: true,
            map_reconstruction: Reconstruction::Linear,
            map_photons: 1,
            map_dimensions: None,
            image_depth: None,
            importance: Switch::Auto,
        }
    }
}

/// A sequence as its name, read back without a number of points.
mod sequence_by_name {
    use quasilux_sampling::Sequence;
    use serde::de::{Deserialize, Deserializer, Error};
    use serde::ser::{Serialize, Serializer};
    use std::borrow::Cow;

    pub(super) fn serialize<S: Serializer>(
        sequence: &Sequence,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        sequence.name().serialize(serializer)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Sequence, D::Error> {
        let name = Cow::<str>::deserialize(deserializer)?;
        let all = Sequence::all_for(0);
        all.into_iter().find(|sequence| sequence.name() == name).ok_or_else(|| {
            let expected = all.map(Sequence::name).join(", ");
            D::Error::custom(format_args!("unknown sequence \"{name}\"; expected {expected}"))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::{from_str, to_string, to_value};

    #[test]
    fn settings_come_back() {
        let settings = Settings {
            sequence: Sequence::Hammersley { points: 77 },
            max_samples: Some(77),
            seed: u64::MAX,
            rel_tol: 0.1 + 0.2,
            abs_tol_lx: 0.7,
            unseen_tol: UnseenTolerance::Off,
            tolerance_on: ToleranceOn::Summary,
            interval: IntervalKind::Certified,
            confidence: 0.99,
            max_rays: Some(1 << 60),
            map_element_m: Some(1.0 / 3.0),
            map_photons: 7,
            map_dimensions: Some(9),
            ..Settings::default()
        };
        for settings in [settings, Settings::default()] {
            let text = to_string(&settings).unwrap();
            let read: Settings = from_str(&text).unwrap();
            let sequence = read.sequence.with_points(settings.max_samples.unwrap_or(0));
            assert_eq!(Settings { sequence, ..read }, settings);
            let unknown = text.replacen('{', "{\"no_setting\":1,", 1);
            assert!(from_str::<Settings>(&unknown).is_err());
            let unknown = text.replace("\"hammersley\"", "\"halten\"").replace("sobol", "sobel");
            assert!(from_str::<Settings>(&unknown).is_err(), "{unknown}");
        }
    }

    #[test]
    fn documents_have_the_names_that_users_write() {
        assert!(EstimatorKind::ALL.into_iter().all(|it| to_value(it).unwrap() == it.name()));
        assert!(Switch::ALL.into_iter().all(|it| to_value(it).unwrap() == it.name()));
        assert!(IntervalKind::ALL.into_iter().all(|it| to_value(it).unwrap() == it.name()));
        assert!(ToleranceOn::ALL.into_iter().all(|it| to_value(it).unwrap() == it.name()));
        assert!(Reconstruction::ALL.into_iter().all(|it| to_value(it).unwrap() == it.name()));
        for randomization in Randomization::ALL {
            assert_eq!(to_value(randomization).unwrap(), randomization.name());
        }
    }
}
