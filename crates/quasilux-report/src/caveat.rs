//! What a reader of a report must know: what the simulation says, and what only figures show.

use crate::number::brief;
use quasilux_transport::{Caveat as OfSimulation, EstimatorKind};
use serde::Serialize;

/// A reason to read values with care. It fails nothing; an error is only what gives its sentence.
#[derive(Clone, Debug, PartialEq, Serialize, thiserror::Error)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Caveat {
    /// Values may be biased, and nothing else says why.
    #[error(
        "values of the estimator \"{}\" may be biased beyond what their intervals say",
        estimator.name()
    )]
    Biased {
        /// The estimator.
        estimator: EstimatorKind,
    },
    /// Figures of a sensor that are NaN or infinite, and missing therefore.
    #[error("sensor \"{sensor}\": no finite value for {}", missing(figures, *points, *of_points))]
    NoFiniteValue {
        /// The sensor.
        sensor: String,
        /// Which of its summary.
        figures: Vec<&'static str>,
        /// At how many of its points.
        points: usize,
        /// All its points.
        of_points: usize,
    },
    /// Points without a bound on the light that no sample met.
    #[error(
        "sensor \"{sensor}\": no bound on the light that no sample met at {points} of {of_points} \
         points"
    )]
    NoBound {
        /// The sensor.
        sensor: String,
        /// How many.
        points: usize,
        /// All its points.
        of_points: usize,
    },
    /// Points whose values are partly means over a disc.
    #[error(
        "sensor \"{sensor}\": blurred at {points} of {of_points} points, where up to {} lx is a \
         mean over a disc of {} m radius around the point",
        brief(*most_lx, 2),
        range(*least_radius_m, *most_radius_m)
    )]
    Blurred {
        /// The sensor.
        sensor: String,
        /// How many.
        points: usize,
        /// All its points.
        of_points: usize,
        /// The most that is such a mean at any of them, in lx.
        most_lx: f64,
        /// Radius of the smallest disc in m.
        least_radius_m: f64,
        /// Radius of the largest disc in m.
        most_radius_m: f64,
    },
    /// An average whose points have different numbers of samples.
    #[error(
        "sensor \"{sensor}\": no certified interval of the average, since points ended with \
         different numbers of samples. Run a plan (`quasilux plan`) to get one"
    )]
    NoCertifiedAverage {
        /// The sensor.
        sensor: String,
    },
    /// Points without a certified upper limit.
    #[error(
        "sensor \"{sensor}\": no certified upper limit at {points} of {of_points} points. It needs \
         sequence = \"random\", and a scene without mirrors, glass, measured surfaces and surfaces \
         that reflect all light"
    )]
    NoCertifiedLimit {
        /// The sensor.
        sensor: String,
        /// How many.
        points: usize,
        /// All its points.
        of_points: usize,
    },
    /// What the simulation says.
    #[error(transparent)]
    #[serde(untagged)]
    Simulation(#[from] OfSimulation),
}

impl Caveat {
    /// Its name in documents.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Biased { .. } => "biased",
            Self::NoFiniteValue { .. } => "no_finite_value",
            Self::NoBound { .. } => "no_bound",
            Self::Blurred { .. } => "blurred",
            Self::NoCertifiedAverage { .. } => "no_certified_average",
            Self::NoCertifiedLimit { .. } => "no_certified_limit",
            Self::Simulation(caveat) => caveat.kind(),
        }
    }
}

/// Figures and points, in words.
fn missing(figures: &[&str], points: usize, of_points: usize) -> String {
    let points = (points > 0).then(|| format!("{points} of {of_points} points"));
    let figures = figures.iter().map(ToString::to_string);
    figures.chain(points).collect::<Vec<String>>().join(", ")
}

/// Two lengths, or one where they are equal.
fn range(least_m: f64, most_m: f64) -> String {
    let [least, most] = [least_m, most_m].map(|length_m| brief(length_m, 2));
    if least == most { most } else { format!("{least} to {most}") }
}
