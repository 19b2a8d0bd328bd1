//! How well a sensor point is known, and what it waits for.

use serde::{Deserialize, Serialize};

/// Evidence that the samples of a point give for its interval.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Evidence {
    /// Light was found wherever it was looked for, or a bound says what may be missing.
    #[default]
    Sound,
    /// No path or photon found light where some may be: there is no interval.
    Dark,
    /// Too few paths met light that is rare and bright, so their spread says nothing: there is no
    /// interval, but more paths are sure to help.
    RareLight,
}

impl Evidence {
    /// Whether there is an interval.
    #[must_use]
    pub fn is_sound(self) -> bool {
        self == Self::Sound
    }
}

/// Whether a sensor point is known as well as was asked for, and what is missing if it is not: the
/// first that applies. Where averages alone are held to the tolerance, the first two are of those.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum PointStatus {
    /// The half-width is larger than the tolerance, or there is none.
    HalfWidth,
    /// The bound on light that no sample met is larger than is little enough.
    Unseen,
    /// The average of the sensor is not known well enough.
    Average,
    /// No light was found where some may be.
    Dark,
    /// Too few paths met light that is rare and bright.
    RareLight,
    /// Too few samples to rely on half-widths.
    FewSamples,
    /// Nothing is missing.
    Done,
}

impl PointStatus {
    /// All of them, what nothing is missing of last.
    pub const ALL: [Self; 7] = [
        Self::HalfWidth,
        Self::Unseen,
        Self::Average,
        Self::Dark,
        Self::RareLight,
        Self::FewSamples,
        Self::Done,
    ];

    /// The name in results.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::HalfWidth => "half_width",
            Self::Unseen => "unseen",
            Self::Average => "average",
            Self::Dark => "dark",
            Self::RareLight => "rare_light",
            Self::FewSamples => "few_samples",
            Self::Done => "done",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::PointStatus;

    #[test]
    fn results_have_the_names() {
        for status in PointStatus::ALL {
            assert_eq!(serde_json::to_value(status).unwrap(), status.name());
        }
    }
}
