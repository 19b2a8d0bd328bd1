//! Watches a run: shows how far it is, and ends it when time is up or the user says so.

#![allow(clippy::disallowed_methods, reason = "runs are watched by the clock")]

use crate::checkpoint::CheckpointWriter;
use crate::forecast::Forecast;
use crate::heartbeat::Heartbeat;
use crate::interrupt;
use crate::print::tell;
use crate::time_left::{self, seconds_left};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use quasilux_report::number::{brief, count, memory};
use quasilux_transport::{Control, Estimates, Observer, PictureProgress, Progress, Snapshot};
use std::time::{Duration, Instant};

/// Steps of the progress bar.
const STEPS: u64 = 1000;
/// How often it shows the time, whatever else it has to show.
const TICK: Duration = Duration::from_millis(500);

/// Sensors that are shown while a run goes, the first ones.
const SHOWN_SENSORS: usize = 3;
/// Photons or paths after which the run can be kept: about a second's.
const PIECE: u64 = 1 << 19;
/// Between two looks at them is so much time at least, and this many times what a look takes.
const BETWEEN_LOOKS: Duration = Duration::from_millis(250);
const LOOK_SHARE: u32 = 50;
/// The same for keeping the run.
const KEEPING_SHARE: u32 = 30;
/// A run that is told to stop before it has any value gets so much longer.
const GRACE: Duration = Duration::from_millis(250);
/// Of the time that a run may take, sensors get this share where there are cameras too.
const SENSORS_SHARE: f64 = 0.5;

/// The observer of the command line.
pub(crate) struct Watcher<'a> {
    /// What it will take.
    pub(crate) forecast: Forecast<'a>,
    bar: ProgressBar,
    /// Where no bar can be drawn and the user has not asked for silence.
    heartbeat: Option<Heartbeat>,
    /// Names of the sensors that are shown.
    sensors: Vec<String>,
    /// What they show.
    values: String,
    next_look: Instant,
    look_asked: Instant,
    start: Instant,
    deadline: Option<Instant>,
    /// When the picture was begun that is taken, and when it has to end.
    picture: Option<Sitting>,
    /// Where the run is kept, and when it is next.
    kept: Option<Checkpoints>,
    /// Why the run was told to stop, if it was.
    pub(crate) stopped: Option<Stopped>,
    /// Since when.
    told: Option<Instant>,
    /// Whoever listens in place of the terminal.
    listener: Option<Listener<'a>>,
    /// What could not be told at once, for there is no terminal.
    pub(crate) remarks: Vec<String>,
    /// Rays that were traced before the clock was started.
    pub(crate) earlier_rays: u64,
    /// What the run took before that, in s.
    pub(crate) earlier_seconds: f64,
}

/// A picture that is taken.
#[derive(Clone, Copy, Debug)]
struct Sitting {
    camera: usize,
    begin: Instant,
    end: Option<Instant>,
}

/// A run that is kept on disk.
struct Checkpoints {
    writer: CheckpointWriter,
    every: Duration,
    next: Instant,
    asked: Instant,
    has_failed: bool,
}

/// Why a run was told to stop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stopped {
    /// Its time was up.
    Time,
    /// The user interrupted it.
    Interrupt,
    /// Its listener said so.
    Listener,
}

/// What the listener of a run is told.
#[derive(Clone, Copy, Debug)]
pub enum Event<'a> {
    /// How far it is, many times a second.
    Progress(&'a Progress),
    /// What it knows at a checkpoint.
    Checkpoint(&'a Estimates),
}

/// The end of the time that a run may take, if there is one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Clock {
    end: Option<Instant>,
}

impl Clock {
    pub(crate) fn is_late(self) -> bool {
        self.end.is_some_and(|end| Instant::now() >= end)
    }
}

/// Follows a run, on one of its threads, and may stop it: then it ends at its last checkpoint.
pub type Listener<'a> = Box<dyn FnMut(Event<'_>) -> Control + Send + 'a>;

impl<'a> Watcher<'a> {
    /// Prints something, the bar out of the way.
    pub(crate) fn say(&self, print: impl FnOnce()) {
        self.bar.suspend(print);
    }

    /// Starts the clock. The bar goes to stderr, and only where that is a terminal.
    pub(crate) fn new(forecast: Forecast<'a>, time: Option<Duration>, quiet: bool) -> Self {
        let start = Instant::now();
        let target = if quiet {
            ProgressDrawTarget::hidden()
        } else {
            ProgressDrawTarget::stderr_with_hz(8)
        };
        let style = ProgressStyle::with_template("{bar:24} {elapsed} {msg}")
            .expect("the template is well formed")
            .progress_chars("=> ");
        let bar = ProgressBar::with_draw_target(Some(STEPS), target).with_style(style);
        // A deadline too far away to be told is none.
        let deadline = time.and_then(|time| start.checked_add(time));
        let sensors = forecast.scene.sensors.iter().take(SHOWN_SENSORS);
        // Before the first sample, and so of as many as there may be.
        let most = memory(forecast.bytes(forecast.settings.max_samples));
        let before = format!("up to {most} of memory");
        let heartbeat = (!quiet && bar.is_hidden()).then(|| Heartbeat::new(&before));
        bar.set_message(before);
        if !bar.is_hidden() {
            // Surveys and pilots may have nothing to say for a while.
            bar.enable_steady_tick(TICK);
        }
        Self {
            forecast,
            bar,
            heartbeat,
            sensors: sensors.map(|sensor| sensor.name.clone()).collect(),
            values: String::new(),
            next_look: start,
            look_asked: start,
            start,
            deadline,
            picture: None,
            kept: None,
            stopped: None,
            told: None,
            listener: None,
            remarks: Vec::new(),
            earlier_rays: 0,
            earlier_seconds: 0.0,
        }
    }

    /// For a run that took this many seconds already.
    pub(crate) fn going_on(self, earlier_seconds: f64) -> Self {
        Self { earlier_seconds, ..self }
    }

    /// For a run that whoever listens may stop, and not the terminal.
    pub(crate) fn listened_to(self, listener: Option<Listener<'a>>) -> Self {
        Self { listener, ..self }
    }

    /// Keeps the run on disk: at once, every so often, and when it is told to stop.
    pub(crate) fn checkpoints(mut self, writer: CheckpointWriter, every: Duration) -> Self {
        let (next, asked) = (self.start, self.start);
        self.kept = Some(Checkpoints { writer, every, next, asked, has_failed: false });
        self
    }

    /// Takes the bar away and says how many seconds the run took in all.
    pub(crate) fn finish(&mut self) -> f64 {
        self.heartbeat = None;
        self.bar.finish_and_clear();
        self.seconds()
    }

    /// When its time is up.
    pub(crate) fn clock(&self) -> Clock {
        Clock { end: self.deadline }
    }

    fn seconds(&self) -> f64 {
        self.earlier_seconds + self.start.elapsed().as_secs_f64()
    }

    /// When what is done now has to end: pictures share what sensors leave of the time.
    fn end_of_step(&self) -> Option<Instant> {
        let (deadline, scene) = (self.deadline?, self.forecast.scene);
        match self.picture {
            Some(sitting) => sitting.end,
            None if scene.sensors.is_empty() || scene.cameras.is_empty() => Some(deadline),
            None => Some(self.start + (deadline - self.start).mul_f64(SENSORS_SHARE)),
        }
    }

    /// Notes that a picture is taken.
    fn sit(&mut self, picture: &PictureProgress) -> Sitting {
        let camera = picture.camera;
        let known = self.picture.filter(|sitting| sitting.camera == camera);
        let sitting = known.unwrap_or_else(|| {
            let begin = Instant::now();
            let pictures = self.forecast.scene.cameras.len().saturating_sub(camera).max(1);
            let share =
                |end: Instant| begin + end.saturating_duration_since(begin) / pictures as u32;
            Sitting { camera, begin, end: self.deadline.map(share) }
        });
        self.picture = Some(sitting);
        sitting
    }

    fn show_picture(&self, progress: &Progress, picture: &PictureProgress, sitting: Sitting) {
        let now = Instant::now();
        let whole = sitting.end.map(|end| end.saturating_duration_since(sitting.begin));
        let elapsed_s = (now - sitting.begin).as_secs_f64();
        let of_time = whole.map_or(0.0, |whole| elapsed_s / whole.as_secs_f64().max(1e-3));
        let done = progress.done.unwrap_or(0.0).max(of_time).min(1.0);
        self.bar.set_position((done * STEPS as f64) as u64);
        let name = &self.forecast.scene.cameras[picture.camera].name;
        let bytes = memory(self.forecast.bytes(Some(progress.samples)));
        let left_s = seconds_left(done, elapsed_s, sitting.end.map(seconds_until));
        self.show(picture_message(name, picture, left_s) + ", " + &bytes, "");
    }

    /// Shows how far the run is, and behind the bar what sensors show.
    fn show(&self, course: String, values: &str) {
        if let Some(heartbeat) = &self.heartbeat {
            heartbeat.set(&course);
        }
        self.bar.set_message(course + values);
    }

    fn control(&mut self, event: Event<'_>) -> Control {
        let heard = self.listener.as_mut().map(|listener| listener(event));
        let is_late = || self.end_of_step().is_some_and(|end| Instant::now() >= end);
        let reason = match heard {
            Some(Control::Stop) => Some(Stopped::Listener),
            Some(_) if self.stopped == Some(Stopped::Listener) => self.stopped,
            None if interrupt::requested() => Some(Stopped::Interrupt),
            _ => is_late().then_some(Stopped::Time),
        };
        self.stopped = reason.or(self.stopped);
        if reason.is_none() {
            return Control::Continue;
        }
        let told = *self.told.get_or_insert_with(Instant::now);
        let has_values = match event {
            Event::Progress(progress) => progress.samples > 0,
            Event::Checkpoint(_) => true,
        };
        if has_values || told.elapsed() >= GRACE { Control::Stop } else { Control::Continue }
    }
}

impl Observer for Watcher<'_> {
    fn piece(&self) -> Option<u64> {
        self.kept.is_some().then_some(PIECE)
    }

    fn wants_state(&mut self) -> bool {
        let Some(kept) = &mut self.kept else { return false };
        kept.asked = Instant::now();
        self.stopped.is_some() || kept.asked >= kept.next
    }

    fn state(&mut self, state: &[u8]) {
        let seconds = self.seconds();
        let Some(kept) = &mut self.kept else { return };
        if let Err(error) = kept.writer.write(state, seconds)
            && !kept.has_failed
        {
            kept.has_failed = true;
            let name = kept.writer.path().display();
            let warning = format!("{name}: cannot keep the run: {error}");
            if self.listener.is_none() {
                self.bar.suspend(|| tell(format_args!("warning: {warning}")));
            } else {
                self.remarks.push(warning);
            }
        }
        // A large state takes no more than a small share of the time.
        kept.next = Instant::now() + kept.every.max(kept.asked.elapsed() * KEEPING_SHARE);
    }

    fn wants_snapshot(&mut self) -> bool {
        self.look_asked = Instant::now();
        !self.bar.is_hidden() && self.look_asked >= self.next_look
    }

    fn snapshot(&mut self, snapshot: &Snapshot) {
        let shown = self.sensors.iter().zip(&snapshot.illuminance_lx);
        self.values = shown.filter_map(|(name, values)| value(name, values)).collect();
        self.next_look = Instant::now() + BETWEEN_LOOKS.max(self.look_asked.elapsed() * LOOK_SHARE);
    }

    fn progress(&mut self, progress: &Progress) -> Control {
        self.earlier_rays = progress.earlier_rays;
        if let Some(picture) = &progress.picture {
            let sitting = self.sit(picture);
            self.show_picture(progress, picture, sitting);
            return self.control(Event::Progress(progress));
        }
        let elapsed_s = self.start.elapsed().as_secs_f64();
        let of_time = self.deadline.map(|end| elapsed_s / (end - self.start).as_secs_f64());
        // Past its time a run goes on to its first checkpoint for a moment.
        let done = match of_time.filter(|of_time| *of_time < 1.0) {
            Some(of_time) => Some(progress.done.unwrap_or(0.0).max(of_time)),
            None => progress.done,
        };
        self.bar.set_position((done.unwrap_or(0.0) * STEPS as f64) as u64);
        let limit_s = self.deadline.map(seconds_until);
        let course = message(progress, done, elapsed_s, limit_s);
        let bytes =
            self.forecast.bytes(progress.expected_samples.or(self.forecast.settings.max_samples));
        self.show(course + ", " + &memory(bytes), &self.values);
        self.control(Event::Progress(progress))
    }

    fn checkpoint(&mut self, estimates: &Estimates) -> Control {
        interrupt::keep_results();
        self.control(Event::Checkpoint(estimates))
    }
}

fn seconds_until(end: Instant) -> f64 {
    end.saturating_duration_since(Instant::now()).as_secs_f64()
}

/// Photons, paths, rays a second, the largest relative half-width and how it shrinks, the time left
/// to the end, and that of the whole run to the tolerance.
fn message(progress: &Progress, done: Option<f64>, elapsed_s: f64, limit_s: Option<f64>) -> String {
    let rays = progress.rays as f64;
    let own_rays = progress.rays.saturating_sub(progress.earlier_rays).max(1) as f64;
    let rays_per_s = own_rays / elapsed_s.max(1e-3);
    let width = progress
        .largest_relative_half_width
        .map_or_else(|| "±?".to_owned(), |width| format!("±{:.2} %", 100.0 * width));
    let slope = progress.slope.map_or_else(String::new, |slope| format!(" ~ N^{slope:.2}"));
    // What a run that was gone on with took before is told at the pace of now.
    let pace_s = elapsed_s * rays.max(1.0) / own_rays;
    let left = match progress.done_of_first.map(|done| seconds_left(done, pace_s, limit_s)) {
        Some(Some(left_s)) => format!("{} s to the first values", brief(left_s, 2)),
        _ => time_left::in_words(seconds_left(done.unwrap_or(0.0), pace_s, limit_s)),
    };
    let whole = progress.expected_rays.map_or_else(String::new, |expected| {
        format!(
            ", the tolerance after about {} s",
            brief(pace_s * expected as f64 / rays.max(1.0), 2)
        )
    });
    format!(
        "{} photons, {} paths, {:.2} M rays/s, {width}{slope}, {left}{whole}",
        count(progress.photons),
        count(progress.paths),
        rays_per_s * 1e-6,
    )
}

/// The passes of a picture, how well it is known, and the time left to its end.
fn picture_message(name: &str, picture: &PictureProgress, left_s: Option<f64>) -> String {
    let PictureProgress { samples, complete_samples, relative_half_width, rel_tol, .. } = *picture;
    let known = relative_half_width.map_or_else(|| "?".to_owned(), percent);
    let wanted = rel_tol.map_or_else(String::new, |share| format!(", goal {}", percent(share)));
    let left = time_left::in_words(left_s);
    format!(
        "picture {name}: pass with {} paths per pixel (previous {}), error {known}{wanted}, {left}",
        count(samples),
        count(complete_samples),
    )
}

fn percent(share: f64) -> String {
    format!("{:.2} %", 100.0 * share)
}

/// A line for what a sensor shows: its average, and the least and the most where they differ.
fn value(name: &str, illuminance_lx: &[Option<f64>]) -> Option<String> {
    let known: Vec<f64> = illuminance_lx.iter().copied().flatten().collect();
    let least = known.iter().copied().reduce(f64::min)?;
    let most = known.iter().copied().reduce(f64::max)?;
    let mean = known.iter().sum::<f64>() / known.len() as f64;
    let [mean, least, most] = [mean, least, most].map(|lx| brief(lx, 3));
    let range = if known.len() > 1 { format!(" ({least} to {most})") } else { String::new() };
    let part = if known.len() < illuminance_lx.len() {
        format!(" at {} of {} points", known.len(), illuminance_lx.len())
    } else {
        String::new()
    };
    Some(format!("\n{name}: about {mean} lx{range}{part}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From the first checkpoint on: a tenth is done after 2 s.
    #[test]
    fn time_left_and_time_to_the_tolerance_are_told_apart() {
        let progress = Progress {
            photons: 0,
            paths: 1000,
            rays: 1000,
            earlier_rays: 0,
            samples: 16,
            largest_relative_half_width: Some(0.1),
            slope: None,
            expected_samples: Some(1 << 16),
            expected_rays: Some(2_000_000),
            done: Some(0.1),
            done_of_first: None,
            picture: None,
        };
        let text = message(&progress, progress.done, 2.0, None);
        assert!(text.ends_with("±10.00 %, 18 s left, the tolerance after about 4000 s"), "{text}");
        let text = message(&Progress { expected_rays: None, ..progress }, None, 2.0, None);
        assert!(text.ends_with("±10.00 %, time left not known yet"), "{text}");
        let text =
            message(&Progress { done_of_first: Some(0.2), ..progress }, Some(0.9), 2.0, None);
        assert!(text.contains("±10.00 %, 8 s to the first values"), "{text}");
    }

    #[test]
    fn pictures_tell_their_passes_and_the_time_left() {
        let picture = PictureProgress {
            camera: 0,
            samples: 24,
            complete_samples: 4,
            relative_half_width: Some(0.0456),
            rel_tol: Some(0.02),
        };
        let text = picture_message("door", &picture, Some(9.0));
        let wanted = "picture door: pass with 24 paths per pixel (previous 4), error 4.56 %, goal \
                      2.00 %, 9 s left";
        assert_eq!(text, wanted);
        let first = PictureProgress { samples: 1, ..PictureProgress::default() };
        let text = picture_message("door", &first, None);
        let wanted = "picture door: pass with 1 paths per pixel (previous 0), error ?, time left \
                      not known yet";
        assert_eq!(text, wanted);
    }

    #[test]
    fn sensors_are_shown_as_far_as_they_are_known() {
        let text = |values: &[Option<f64>]| value("desk", values);
        assert_eq!(text(&[None, None]), None);
        assert_eq!(text(&[Some(512.34)]).unwrap(), "\ndesk: about 512 lx");
        let part = text(&[Some(100.0), None, Some(300.0)]).unwrap();
        assert_eq!(part, "\ndesk: about 200 lx (100 to 300) at 2 of 3 points");
    }
}
