//! What a reader of results must know of them.
//!
//! A [`Caveat`] is a fact with its figures: programs decide by the variant, or by [`Caveat::kind`]
//! in documents, and people read the sentence.

use crate::cutoff::{MAX_EVENTS, MAX_GAIN};
use crate::lights::images::UnshownWay;
use crate::stats::schedule::MIN_SAMPLES;
use serde::{Deserialize, Serialize};

/// A reason to read values with care. It fails nothing; an error is only what gives its sentence.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, thiserror::Error)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Caveat {
    /// The run was stopped before its first checkpoint.
    #[error(
        "no value is known: the run was stopped before every sensor point had a sample in each \
         replicate"
    )]
    NoValues,
    /// Sensor points without an interval: light may be there that no path or photon has found.
    #[error(
        "no interval at {}: no light was found there, or too little to tell its error. They may be \
         dark, or lit by rare paths only",
        count(*points, "sensor point")
    )]
    NoInterval {
        /// How many.
        points: u64,
    },
    /// There is one replicate, which has no spread.
    #[error("no intervals, and no tolerance to reach: both need at least 2 randomised replicates")]
    OneReplicate,
    /// Half-widths are within the tolerance, but few samples stand behind them.
    #[error(
        "too few samples to call the run done: {samples} of at least {MIN_SAMPLES}, though \
         half-widths are within the tolerance"
    )]
    FewSamples {
        /// Indices of each replicate.
        samples: u64,
    },
    /// Contributions that are in no sum.
    #[error(
        "contributions are missing from the results: {contributions} were NaN, infinite, negative \
         or too large"
    )]
    InvalidContributions {
        /// How many.
        contributions: u64,
    },
    /// Means over cells, map elements and small squares are read as values at points.
    #[error(
        "values at points are biased: the estimator \"photon\" gives means over cells, map \
         elements and small squares. Set quantity = \"mean\" for grids"
    )]
    MeansAtPoints,
    /// Means over the elements of the map that paths end on are in the values.
    #[error(
        "values are biased beyond their intervals: the estimator \"bidirectional-map\" reads means \
         over map elements"
    )]
    MeansOverMapElements,
    /// Photons of many coordinates are on no map.
    #[error(
        "values may be too low: photons that used more than {map_dimensions} coordinates are left \
         out of maps"
    )]
    MapDimensions {
        /// Coordinates that those on maps may have used.
        map_dimensions: u32,
    },
    /// Light over specular surfaces that is known from photon density.
    #[error(
        "caustics ({}) are approximate: blurred over about one map element, missing on surfaces \
         that are not diffuse, and not covered by the intervals",
        in_words(ways)
    )]
    Caustics {
        /// How it comes.
        ways: Vec<UnshownWay>,
    },
    /// Luminaires whose light starts behind a surface that passes through their shape.
    #[error(
        "light is lost at {}: surfaces pass through the luminous shape, and light that starts \
         behind them stays there. A shape is centred on `position`: under a ceiling, move it down \
         by half its height",
        count(*luminaires, "luminaire")
    )]
    CutShapes {
        /// How many.
        luminaires: u64,
    },
    /// Photons that did not end by themselves.
    #[error("{}", terminated("values", *photons, "photons"))]
    PhotonsTerminated {
        /// How many.
        photons: u64,
    },
    /// Paths from sensors that did not end by themselves.
    #[error("{}", terminated("values", *paths, "paths"))]
    PathsTerminated {
        /// How many.
        paths: u64,
    },
    /// Paths through pixels that did not end by themselves.
    #[error("{}", terminated("luminances of pictures", *paths, "paths"))]
    PicturePathsTerminated {
        /// How many.
        paths: u64,
    },
    /// A camera whose first pass was not completed.
    #[error("no picture of camera \"{camera}\": the run was stopped before every pixel had a path")]
    NoPicture {
        /// Its name.
        camera: String,
    },
    /// A picture that ended above its tolerance.
    #[error(
        "the picture of camera \"{camera}\" is above its tolerance: error {}, goal {:.2} %, after \
         {samples} paths per pixel and replicate",
        relative_half_width.map_or("unknown".to_owned(), |known| format!("{:.2} %", 100.0 * known)),
        100.0 * rel_tol
    )]
    PictureAboveTolerance {
        /// Name of its camera.
        camera: String,
        /// Paths of each pixel in each replicate.
        samples: u64,
        /// Half-width over value; `None` where there is none.
        relative_half_width: Option<f64>,
        /// Relative half-width that was wanted.
        rel_tol: f64,
    },
    /// A picture that was stopped before it had the wanted number of paths.
    #[error(
        "the picture of camera \"{camera}\" is unfinished: stopped at {samples} of \
         {wanted_samples} paths per pixel and replicate"
    )]
    PictureUnfinished {
        /// Name of its camera.
        camera: String,
        /// Paths of each pixel in each replicate.
        samples: u64,
        /// How many were wanted.
        wanted_samples: u64,
    },
    /// A picture with light from photon density.
    #[error(
        "the picture of camera \"{camera}\" is blurred: {:.1} % of its light comes from photons, \
         over mirrors or through glass, and is spread over {radius_m:.2} m",
        100.0 * share
    )]
    PictureBlurred {
        /// Name of its camera.
        camera: String,
        /// The share of its light that is.
        share: f64,
        /// Over what radius, in m.
        radius_m: f64,
    },
}

impl Caveat {
    /// Its name in documents.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match self {
            Self::NoValues => "no_values",
            Self::NoInterval { .. } => "no_interval",
            Self::OneReplicate => "one_replicate",
            Self::FewSamples { .. } => "few_samples",
            Self::InvalidContributions { .. } => "invalid_contributions",
            Self::MeansAtPoints => "means_at_points",
            Self::MeansOverMapElements => "means_over_map_elements",
            Self::MapDimensions { .. } => "map_dimensions",
            Self::Caustics { .. } => "caustics",
            Self::CutShapes { .. } => "cut_shapes",
            Self::PhotonsTerminated { .. } => "photons_terminated",
            Self::PathsTerminated { .. } => "paths_terminated",
            Self::PicturePathsTerminated { .. } => "picture_paths_terminated",
            Self::NoPicture { .. } => "no_picture",
            Self::PictureAboveTolerance { .. } => "picture_above_tolerance",
            Self::PictureUnfinished { .. } => "picture_unfinished",
            Self::PictureBlurred { .. } => "picture_blurred",
        }
    }

    /// Whether it says why values are biased beyond what their intervals say.
    #[must_use]
    pub fn is_bias(&self) -> bool {
        match self {
            Self::MeansAtPoints
            | Self::MeansOverMapElements
            | Self::MapDimensions { .. }
            | Self::Caustics { .. }
            | Self::PhotonsTerminated { .. }
            | Self::PathsTerminated { .. }
            | Self::PicturePathsTerminated { .. } => true,
            Self::NoValues
            | Self::NoInterval { .. }
            | Self::OneReplicate
            | Self::FewSamples { .. }
            | Self::InvalidContributions { .. }
            | Self::CutShapes { .. }
            | Self::NoPicture { .. }
            | Self::PictureAboveTolerance { .. }
            | Self::PictureUnfinished { .. }
            | Self::PictureBlurred { .. } => false,
        }
    }

    /// Caveat of terminated photons, if there are any.
    pub(crate) fn of_photons(photons: u64) -> Option<Self> {
        (photons > 0).then_some(Self::PhotonsTerminated { photons })
    }

    /// Caveat of terminated paths from sensors, if there are any.
    pub(crate) fn of_paths(paths: u64) -> Option<Self> {
        (paths > 0).then_some(Self::PathsTerminated { paths })
    }

    /// Caveat of terminated paths through pixels, if there are any.
    pub(crate) fn of_picture_paths(paths: u64) -> Option<Self> {
        (paths > 0).then_some(Self::PicturePathsTerminated { paths })
    }
}

fn terminated(values: &str, count: u64, what: &str) -> String {
    format!(
        "{values} are too low: {count} {what} were terminated after {MAX_EVENTS} bounces, or after \
         gaining a factor of {MAX_GAIN} from measured surfaces that reflect more than they receive"
    )
}

fn in_words(ways: &[UnshownWay]) -> String {
    let ways: Vec<String> = ways.iter().map(ToString::to_string).collect();
    ways.join(", ")
}

/// A number with its noun.
fn count(number: u64, noun: &str) -> String {
    format!("{number} {noun}{}", if number == 1 { "" } else { "s" })
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::{Value, to_value};

    /// Caveats without figures, with one, and with a list.
    #[test]
    fn documents_have_the_kinds() {
        let ways = vec![UnshownWay::ThroughBodies];
        for caveat in [
            Caveat::NoValues,
            Caveat::NoInterval { points: 3 },
            Caveat::OneReplicate,
            Caveat::FewSamples { samples: 64 },
            Caveat::InvalidContributions { contributions: 1 },
            Caveat::MeansAtPoints,
            Caveat::MeansOverMapElements,
            Caveat::MapDimensions { map_dimensions: 6 },
            Caveat::Caustics { ways },
            Caveat::CutShapes { luminaires: 1 },
            Caveat::PhotonsTerminated { photons: 1 },
            Caveat::PathsTerminated { paths: 1 },
            Caveat::PicturePathsTerminated { paths: 1 },
            Caveat::NoPicture { camera: "a".to_owned() },
            Caveat::PictureAboveTolerance {
                camera: "a".to_owned(),
                samples: 1,
                relative_half_width: None,
                rel_tol: 0.05,
            },
            Caveat::PictureUnfinished { camera: "a".to_owned(), samples: 1, wanted_samples: 2 },
            Caveat::PictureBlurred { camera: "a".to_owned(), share: 0.1, radius_m: 0.1 },
        ] {
            let tag = match to_value(&caveat).unwrap() {
                Value::String(tag) => tag,
                Value::Object(tagged) => tagged.keys().next().unwrap().clone(),
                other => panic!("{other}"),
            };
            assert_eq!(tag, caveat.kind());
        }
    }

    #[test]
    fn the_news_comes_first() {
        let told = Caveat::NoInterval { points: 1 }.to_string();
        assert!(told.starts_with("no interval at 1 sensor point: "), "{told}");
        let ways = vec![
            UnshownWay::ThroughBodies,
            UnshownWay::ByCurvedMirrors { facets: 12 },
            UnshownWay::OverManyMirrors { depth: 1 },
        ];
        let told = Caveat::Caustics { ways }.to_string();
        let expected = "caustics (through refracting bodies, by curved mirrors of 12 facets, over \
                        2 mirrors or more in a row) are approximate: ";
        assert!(told.starts_with(expected), "{told}");
        let relative_half_width = Some(0.0456);
        let told = Caveat::PictureAboveTolerance {
            camera: "door".to_owned(),
            samples: 24,
            relative_half_width,
            rel_tol: 0.02,
        };
        assert_eq!(
            told.to_string(),
            "the picture of camera \"door\" is above its tolerance: error 4.56 %, goal 2.00 %, \
             after 24 paths per pixel and replicate"
        );
    }

    /// Checkpoints hold them, in a format without names.
    #[test]
    fn states_hold_them() {
        let ways = vec![UnshownWay::FromShapes, UnshownWay::OverManyMirrors { depth: 2 }];
        let all = vec![Caveat::OneReplicate, Caveat::Caustics { ways }];
        let bytes = postcard::to_allocvec(&all).unwrap();
        assert_eq!(postcard::from_bytes(&bytes), Ok(all));
    }
}
