//! Options of runs and years, as the dataclasses of `quasilux._options` have them.

use pyo3::exceptions::PyOverflowError;
use pyo3::prelude::*;
use quasilux::embedded;
use std::path::PathBuf;

/// A share, as a number or as text.
#[derive(FromPyObject)]
enum Share {
    Number(f64),
    Text(String),
}

/// A whole number; the least and the largest stand for all beyond them.
struct Whole(i128);

/// Options of a run.
#[derive(FromPyObject)]
pub(crate) struct RunOptions {
    rel_tol: Option<Share>,
    abs_tol_lx: Option<f64>,
    unseen_tol: Option<Share>,
    tolerance_on: Option<String>,
    interval: Option<String>,
    confidence: Option<Share>,
    samples: Option<Whole>,
    rays: Option<Whole>,
    time_s: Option<f64>,
    estimator: Option<String>,
    sequence: Option<String>,
    seed: Option<Whole>,
    threads: Option<Whole>,
    strict: bool,
    checkpoint: Option<PathBuf>,
    checkpoint_every_s: Option<f64>,
}

/// Options of a run that goes on.
#[derive(FromPyObject)]
pub(crate) struct ResumeOptions {
    time_s: Option<f64>,
    threads: Option<Whole>,
    checkpoint_every_s: Option<f64>,
}

/// Options of a year.
#[derive(FromPyObject)]
pub(crate) struct YearOptions {
    rel_tol: Option<Share>,
    abs_tol_lx: Option<f64>,
    confidence: Option<Share>,
    samples: Option<Whole>,
    occupied_h: Option<(f64, f64)>,
    seed: Option<Whole>,
    threads: Option<Whole>,
}

impl FromPyObject<'_, '_> for Whole {
    type Error = PyErr;

    fn extract(number: Borrowed<'_, '_, PyAny>) -> PyResult<Self> {
        match number.extract() {
            Ok(number) => Ok(Self(number)),
            Err(error) if error.is_instance_of::<PyOverflowError>(number.py()) => {
                Ok(Self(if number.lt(0)? { i128::MIN } else { i128::MAX }))
            }
            Err(error) => Err(error),
        }
    }
}

impl From<Share> for embedded::Share {
    fn from(share: Share) -> Self {
        match share {
            Share::Number(number) => Self::Number(number),
            Share::Text(text) => Self::Text(text),
        }
    }
}

impl From<Whole> for i128 {
    fn from(Whole(number): Whole) -> Self {
        number
    }
}

impl From<RunOptions> for embedded::RunOptions {
    fn from(options: RunOptions) -> Self {
        Self {
            rel_tol: options.rel_tol.map(Into::into),
            abs_tol_lx: options.abs_tol_lx,
            unseen_tol: options.unseen_tol.map(Into::into),
            tolerance_on: options.tolerance_on,
            interval: options.interval,
            confidence: options.confidence.map(Into::into),
            samples: options.samples.map(Into::into),
            rays: options.rays.map(Into::into),
            time_s: options.time_s,
            estimator: options.estimator,
            sequence: options.sequence,
            seed: options.seed.map(Into::into),
            threads: options.threads.map(Into::into),
            strict: options.strict,
            checkpoint: options.checkpoint,
            checkpoint_every_s: options.checkpoint_every_s,
        }
    }
}

impl From<ResumeOptions> for embedded::ResumeOptions {
    fn from(options: ResumeOptions) -> Self {
        let ResumeOptions { time_s, threads, checkpoint_every_s } = options;
        Self { time_s, threads: threads.map(Into::into), checkpoint_every_s }
    }
}

impl From<YearOptions> for embedded::YearOptions {
    fn from(options: YearOptions) -> Self {
        Self {
            rel_tol: options.rel_tol.map(Into::into),
            abs_tol_lx: options.abs_tol_lx,
            confidence: options.confidence.map(Into::into),
            samples: options.samples.map(Into::into),
            occupied_h: options.occupied_h.map(|(start, end)| start..end),
            seed: options.seed.map(Into::into),
            threads: options.threads.map(Into::into),
        }
    }
}
