//! What a callback is told of a run.

#![allow(clippy::disallowed_methods, reason = "runs are watched by the clock")]

use crate::arrays::read_only;
use crate::outcome::unseen_lx;
use pyo3::IntoPyObjectExt;
use pyo3::exceptions::PyStopIteration;
use pyo3::prelude::*;
use pyo3::types::PyDict;
use quasilux::embedded::{Event, Project};
use quasilux_scene::{Sensor, SensorShape};
use quasilux_transport::{Control, Estimates, Progress as Counts};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// Adds the class to the module.
pub(crate) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add_class::<YearProgress>()?;
    module.add_class::<Progress>()
}

/// Between two calls, checkpoints left out.
const EVERY: Duration = Duration::from_millis(100);

/// Messages from the thread of a run.
pub(crate) enum News {
    Progress(Box<Standing>),
    /// The run waits for an answer.
    Checkpoint(Box<Standing>),
    /// How far a year is.
    Year(YearProgress),
}

/// The worker's end: where its news go, and answers come from.
pub(crate) struct Line {
    pub(crate) news: Sender<News>,
    pub(crate) answers: Receiver<Control>,
    /// Whether it is to end.
    pub(crate) stop: Arc<AtomicBool>,
    /// Whether anybody is called back.
    pub(crate) is_heard: bool,
}

/// How far a run is.
pub(crate) struct Standing {
    counts: Counts,
    seconds: f64,
    /// Name of the camera whose picture is taken.
    camera: Option<String>,
    /// At a checkpoint, the figures of each sensor.
    sensors: Vec<SensorFigures>,
}

/// Figures of a sensor so far.
struct SensorFigures {
    name: String,
    shape: Vec<usize>,
    illuminance_lx: Vec<f64>,
    half_width_lx: Vec<f64>,
    unseen_lx: Vec<f64>,
}

/// Tells the caller's thread of a run.
pub(crate) struct Reporter {
    news: Sender<News>,
    answers: Receiver<Control>,
    project: Arc<Project>,
    start: Instant,
    told: Option<Instant>,
    counts: Option<Counts>,
}

impl Reporter {
    pub(crate) fn new(line: Line, project: Arc<Project>) -> Self {
        let start = Instant::now();
        let Line { news, answers, .. } = line;
        Self { news, answers, project, start, told: None, counts: None }
    }

    /// Passes progress on now and then, and every checkpoint, at which the run waits for the
    /// answer: so it stops where it is told to.
    pub(crate) fn tell(&mut self, event: Event<'_>) -> Control {
        match event {
            Event::Progress(counts) => {
                self.counts = Some(*counts);
                if self.told.is_none_or(|told| told.elapsed() >= EVERY) {
                    self.told = Some(Instant::now());
                    let standing = Box::new(self.standing(*counts, Vec::new()));
                    _ = self.news.send(News::Progress(standing));
                }
                Control::Continue
            }
            Event::Checkpoint(estimates) => {
                let Some(counts) = self.counts else { return Control::Continue };
                let figures = self.figures(estimates);
                let widths = figures.iter().map(SensorFigures::largest_relative_half_width);
                let counts = Counts {
                    samples: estimates.samples,
                    rays: counts.rays.max(estimates.rays),
                    largest_relative_half_width: widths.fold(None, largest),
                    slope: estimates.convergence.slope,
                    expected_samples: estimates.convergence.samples,
                    expected_rays: estimates.convergence.rays,
                    ..counts
                };
                let standing = Box::new(self.standing(counts, figures));
                let is_heard = self.news.send(News::Checkpoint(standing)).is_ok();
                let answer = is_heard.then(|| self.answers.recv().ok()).flatten();
                answer.unwrap_or(Control::Stop)
            }
        }
    }

    fn standing(&self, counts: Counts, sensors: Vec<SensorFigures>) -> Standing {
        let cameras = &self.project.loaded().scene.cameras;
        let camera = counts.picture.map(|picture| cameras[picture.camera].name.clone());
        Standing { counts, seconds: self.start.elapsed().as_secs_f64(), camera, sensors }
    }

    fn figures(&self, estimates: &Estimates) -> Vec<SensorFigures> {
        let sensors = self.project.loaded().scene.sensors.iter().enumerate();
        sensors.map(|(index, sensor)| SensorFigures::new(sensor, estimates, index)).collect()
    }
}

impl SensorFigures {
    fn new(sensor: &Sensor, estimates: &Estimates, index: usize) -> Self {
        let intervals = estimates.point_intervals(index);
        let shape = match &sensor.shape {
            SensorShape::Grid(grid) => grid.counts.iter().rev().map(|&n| n as usize).collect(),
            SensorShape::Points(points) => vec![points.len()],
        };
        let half_width = |x: Option<f64>| x.unwrap_or(f64::NAN);
        Self {
            name: sensor.name.clone(),
            shape,
            illuminance_lx: intervals.iter().map(|interval| interval.value).collect(),
            half_width_lx: intervals.iter().map(|it| half_width(it.half_width)).collect(),
            unseen_lx: unseen_lx(estimates, index),
        }
    }

    /// Of the points that have an interval and are not dark.
    fn largest_relative_half_width(&self) -> Option<f64> {
        let points = self.illuminance_lx.iter().zip(&self.half_width_lx);
        let shares = points.map(|(lx, half_width)| half_width / lx).filter(|x| x.is_finite());
        shares.reduce(f64::max)
    }
}

/// The larger of two numbers, as far as there are any.
fn largest(a: Option<f64>, b: Option<f64>) -> Option<f64> {
    a.map_or(b, |a| Some(b.map_or(a, |b| a.max(b))))
}

/// Tells the caller's thread of a year; any thread may ask it whether to go on.
pub(crate) struct YearReporter {
    news: Mutex<Told>,
    stop: Arc<AtomicBool>,
    start: Instant,
}

/// Progress that the caller was told of last, if it listens.
struct Told {
    news: Option<Sender<News>>,
    next: Instant,
}

impl YearReporter {
    pub(crate) fn new(line: Line) -> Self {
        let start = Instant::now();
        let told = Told { news: Some(line.news).filter(|_| line.is_heard), next: start };
        Self { news: Mutex::new(told), stop: line.stop, start }
    }

    /// Passes on what share is over, now and then, and says whether to go on.
    pub(crate) fn tell(&self, done: f64) -> Control {
        if self.stop.load(Ordering::Relaxed) {
            return Control::Stop;
        }
        // Whoever finds another thread at it has nothing to add.
        if let Ok(mut told) = self.news.try_lock()
            && Instant::now() >= told.next
        {
            told.next = Instant::now() + EVERY;
            let seconds = self.start.elapsed().as_secs_f64();
            let news = told.news.as_ref();
            _ = news.map(|news| news.send(News::Year(YearProgress { done, seconds })));
        }
        Control::Continue
    }
}

/// How far a year is: what a callback gets.
#[pyclass(frozen, get_all, module = "quasilux._native")]
pub(crate) struct YearProgress {
    done: f64,
    seconds: f64,
}

#[pymethods]
impl YearProgress {
    fn __repr__(&self) -> String {
        let Self { done, seconds } = self;
        format!("<quasilux.YearProgress {:.0} % done, {seconds:.1} s>", 100.0 * done)
    }
}

/// Calls back with news; an answer that is true, and `StopIteration`, stop the run.
pub(crate) fn answer(py: Python<'_>, callback: &Py<PyAny>, news: News) -> PyResult<Control> {
    let progress = match news {
        News::Progress(standing) => Progress::new(py, *standing, false)?.into_bound_py_any(py)?,
        News::Checkpoint(standing) => Progress::new(py, *standing, true)?.into_bound_py_any(py)?,
        News::Year(progress) => progress.into_bound_py_any(py)?,
    };
    match callback.bind(py).call1((progress,)).and_then(|answer| answer.is_truthy()) {
        Ok(false) => Ok(Control::Continue),
        Ok(true) => Ok(Control::Stop),
        Err(error) if error.is_instance_of::<PyStopIteration>(py) => Ok(Control::Stop),
        Err(error) => Err(error),
    }
}

/// How far a run is: what a callback gets.
#[pyclass(frozen, get_all, module = "quasilux._native")]
pub(crate) struct Progress {
    photons: u64,
    paths: u64,
    rays: u64,
    samples: u64,
    seconds: f64,
    largest_relative_half_width: Option<f64>,
    slope: Option<f64>,
    expected_samples: Option<u64>,
    expected_rays: Option<u64>,
    done: Option<f64>,
    camera: Option<String>,
    is_checkpoint: bool,
    illuminance_lx: Py<PyDict>,
    half_width_lx: Py<PyDict>,
    unseen_lx: Py<PyDict>,
}

impl Progress {
    fn new(py: Python<'_>, standing: Standing, is_checkpoint: bool) -> PyResult<Self> {
        let Standing { counts, seconds, camera, sensors } = standing;
        let [illuminance_lx, half_width_lx, unseen_lx] = [(); 3].map(|()| PyDict::new(py));
        for SensorFigures {
            name,
            shape,
            illuminance_lx: lx,
            half_width_lx: widths,
            unseen_lx: unseen,
        } in sensors
        {
            illuminance_lx.set_item(&name, read_only(py, lx, &shape))?;
            half_width_lx.set_item(&name, read_only(py, widths, &shape))?;
            unseen_lx.set_item(&name, read_only(py, unseen, &shape))?;
        }
        Ok(Self {
            photons: counts.photons,
            paths: counts.paths,
            rays: counts.rays,
            samples: counts.samples,
            seconds,
            largest_relative_half_width: counts.largest_relative_half_width,
            slope: counts.slope,
            expected_samples: counts.expected_samples,
            expected_rays: counts.expected_rays,
            done: counts.done,
            camera,
            is_checkpoint,
            illuminance_lx: illuminance_lx.unbind(),
            half_width_lx: half_width_lx.unbind(),
            unseen_lx: unseen_lx.unbind(),
        })
    }
}

#[pymethods]
impl Progress {
    fn __repr__(&self) -> String {
        let done =
            self.done.map_or_else(|| "?".to_owned(), |done| format!("{:.0} %", 100.0 * done));
        let width = self.largest_relative_half_width;
        let width = width.map_or_else(|| "?".to_owned(), |width| format!("{:.2} %", 100.0 * width));
        let Self { samples, rays, seconds, .. } = self;
        format!(
            "<quasilux.Progress {done} done, samples={samples}, rays={rays}, \
             largest half-width {width}, {seconds:.1} s>"
        )
    }
}
