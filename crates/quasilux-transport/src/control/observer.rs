//! How a running simulation talks to the outside, and how the outside stops it.

use crate::stats::estimates::Estimates;

/// Whether a simulation goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Control {
    /// Go on.
    Continue,
    /// Stop; the last completed checkpoint is the result.
    Stop,
}

/// Progress of a running simulation between checkpoints.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Photons traced so far.
    pub photons: u64,
    /// Paths traced so far, all sensor points together.
    pub paths: u64,
    /// Rays traced so far.
    pub rays: u64,
    /// How many of them the run had traced before it was gone on with.
    pub earlier_rays: u64,
    /// Indices per replicate of the last completed checkpoint, 0 before the first.
    pub samples: u64,
    /// Largest half-width over value among all sensor points at the last checkpoint.
    pub largest_relative_half_width: Option<f64>,
    /// Measured exponent of N in half-widths at the last checkpoint.
    pub slope: Option<f64>,
    /// Indices per replicate at which the tolerance should be reached.
    pub expected_samples: Option<u64>,
    /// Rays of the whole run up to there.
    pub expected_rays: Option<u64>,
    /// Share in [0, 1] of the expected work that is done, `None` while nothing is known; where a
    /// picture is taken, of the work at it.
    pub done: Option<f64>,
    /// Share in [0, 1] that is done of the work up to the first checkpoint, before which no value
    /// is known; `None` while surveys and pilots run, and past it.
    pub done_of_first: Option<f64>,
    /// The picture that is taken, once the sensors are done.
    pub picture: Option<PictureProgress>,
}

/// How far a picture is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PictureProgress {
    /// Number of the camera in the scene.
    pub camera: usize,
    /// Paths of each pixel in each replicate in the pass that is made.
    pub samples: u64,
    /// Paths of each pixel in each replicate in the last complete pass; 0 before the first.
    pub complete_samples: u64,
    /// How well that one knows the picture ([`crate::CameraEstimates::relative_half_width`]).
    pub relative_half_width: Option<f64>,
    /// Relative half-width that is wanted of it; `None` where a number of paths is.
    pub rel_tol: Option<f64>,
}

/// Illuminances of the sensors at a moment between two checkpoints: the tallies as they are. Taking
/// one disturbs nothing; it has no interval, and is no result.
#[derive(Clone, Debug, PartialEq)]
pub struct Snapshot {
    /// Illuminance in lx, one row a sensor, one column a sensor point; `None` where nothing is
    /// known yet. Of all photons or paths so far, whichever replicate they belong to. While photons
    /// of maps fly, points on surfaces show what the maps have there, others what they had before.
    pub illuminance_lx: Vec<Vec<Option<f64>>>,
}

/// The one way out of a running simulation: progress, snapshots, states, checkpoints, cancellation.
pub trait Observer {
    /// After how many photons or paths, about, it may want a state; `None` where it never does.
    /// Work is then done in such pieces, each of them whole before the run stops, to the same bits.
    /// Asked once, before the run.
    fn piece(&self) -> Option<u64> {
        None
    }

    /// Whether it wants the state now: asked after each piece, and after what it ended itself.
    fn wants_state(&mut self) -> bool {
        false
    }

    /// Gets the state that it wanted, for [`crate::resume`]; and the last one of a run whose
    /// checkpoints are over ([`crate::is_over`]).
    fn state(&mut self, _state: &[u8]) {}

    /// Whether it wants a snapshot now: asked many times a second, before [`Self::progress`].
    fn wants_snapshot(&mut self) -> bool {
        false
    }

    /// Gets the snapshot that it wanted, where there is one.
    fn snapshot(&mut self, _snapshot: &Snapshot) {}

    /// Called many times a second. While a picture is taken, [`Control::Stop`] ends that picture
    /// with its last complete pass, and the next one begins.
    fn progress(&mut self, _progress: &Progress) -> Control {
        Control::Continue
    }

    /// Called at each checkpoint that all replicates have completed.
    fn checkpoint(&mut self, _estimates: &Estimates) -> Control {
        Control::Continue
    }
}

/// Watches nothing, stops nothing.
impl Observer for () {}
