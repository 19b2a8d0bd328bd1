//! What a run said at each limit, and the file that it is kept in.

use quasilux_transport::EstimatorKind;
use serde::{Deserialize, Serialize};
use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::Path;

/// What makes a run the one that it is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RunKey {
    /// Digest of the program that ran, so that results of two of them never mix.
    pub program: String,
    /// The room's family.
    pub family: String,
    /// Its number in the family.
    pub number: u64,
    /// Its digest.
    pub digest: String,
    /// How light was estimated.
    pub estimator: EstimatorKind,
    /// Half-width over value that the run went for.
    pub rel_tol: f64,
    /// The limits that it was looked at, in s.
    pub limits_s: Vec<f64>,
    /// Its seed.
    pub seed: u64,
}

/// A run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RunRecord {
    /// What makes it the one that it is.
    pub key: RunKey,
    /// What came of it.
    pub outcome: RunOutcome,
}

/// What came of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum RunOutcome {
    /// The room or the settings were refused, and why.
    Refused(String),
    /// It panicked, and how.
    Crashed(String),
    /// What it said at each limit.
    Done(Vec<LookRecord>),
}

/// What a run said at a limit: its last complete checkpoint before, or its first.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LookRecord {
    /// The limit in s.
    pub limit_s: f64,
    /// When the checkpoint was complete.
    pub seconds: f64,
    /// Samples of each replicate.
    pub samples: u64,
    /// Whether everything that was wanted was reached.
    pub is_done: bool,
    /// Whether an earlier limit shows the same checkpoint: it then counts there alone.
    pub is_repeated: bool,
    /// In the order of the room's places.
    pub points: Vec<PointRecord>,
}

/// What a run said of one place.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PointRecord {
    /// The estimate.
    pub lx: f64,
    /// `None` where the point was withdrawn.
    pub half_width_lx: Option<f64>,
    /// Light that may come by ways on which no sample lay; `None` where nothing is said of it.
    pub unseen_lx: Option<f64>,
    /// The part of the estimate that is a mean over the disc.
    pub merged_lx: f64,
    /// The radius of the disc, where there is one.
    pub disc_radius_m: Option<f64>,
}

/// The runs of a file, which may not exist yet; a line that was cut off is passed over.
///
/// # Errors
/// When the file is there and cannot be read.
pub fn read(path: &Path) -> io::Result<Vec<RunRecord>> {
    if !path.exists() {
        return Ok(Vec::new());
    }
    let text = fs::read_to_string(path)?;
    Ok(text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect())
}

/// Adds a run to a file, on a line of its own.
///
/// # Errors
/// When the file cannot be written.
pub fn append(path: &Path, record: &RunRecord) -> io::Result<()> {
    let mut file: File = OpenOptions::new().create(true).append(true).open(path)?;
    let line = serde_json::to_string(record)?;
    // A line before it may have been cut off: an empty one is passed over.
    file.write_all(format!("\n{line}\n").as_bytes())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_come_back_and_what_was_cut_off_is_passed_over() {
        let path = std::env::temp_dir().join(format!("gauntlet-runs-{}", std::process::id()));
        let _ = fs::remove_file(&path);
        assert_eq!(read(&path).unwrap(), []);
        let key = RunKey {
            program: "p".to_owned(),
            family: "plain box".to_owned(),
            number: 3,
            digest: "d".to_owned(),
            estimator: EstimatorKind::Path,
            rel_tol: 0.03,
            limits_s: vec![1.0, 3.0],
            seed: 7,
        };
        let point = PointRecord {
            lx: 0.1 + 0.2,
            half_width_lx: None,
            unseen_lx: Some(0.25),
            merged_lx: 0.0,
            disc_radius_m: Some(0.1),
        };
        let look = LookRecord {
            limit_s: 1.0,
            seconds: 0.9,
            samples: 128,
            is_done: true,
            is_repeated: false,
            points: vec![point],
        };
        let done = RunRecord { key: key.clone(), outcome: RunOutcome::Done(vec![look]) };
        let refused = RunRecord { key, outcome: RunOutcome::Refused("no".to_owned()) };
        append(&path, &done).unwrap();
        fs::write(&path, fs::read_to_string(&path).unwrap() + "{\"key\":{").unwrap();
        append(&path, &refused).unwrap();
        assert_eq!(read(&path).unwrap(), [done, refused]);
        fs::remove_file(&path).unwrap();
    }
}
