//! One run of one estimator in one room, looked at when its limits pass.

use crate::project::Slot;
use crate::record::{LookRecord, PointRecord, RunOutcome};
use crate::room::Room;
use quasilux_scene::Scene;
use quasilux_transport::{Control, Estimates, Observer, Progress, Settings, check, simulate};
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

/// A room made ready to be run in.
pub struct RunSettings {
    scene: Scene,
    slots: Vec<Slot>,
}

/// Keeps the last checkpoint before each limit.
struct Watch<'a> {
    start: Instant,
    limits_s: &'a [f64],
    slots: &'a [Slot],
    last: Option<LookRecord>,
    looks: Vec<LookRecord>,
}

impl RunSettings {
    /// The room as quasilux loads it.
    ///
    /// # Errors
    /// When it is refused.
    pub fn new(room: &Room) -> Result<Self, String> {
        let loaded = room.load().map_err(|error| error.to_string())?;
        Ok(Self { scene: loaded.scene, slots: room.slots() })
    }

    /// Runs until the last of the limits, which rise.
    #[must_use]
    #[expect(clippy::disallowed_methods, reason = "runs are looked at by the clock")]
    pub fn run(&self, settings: &Settings, limits_s: &[f64]) -> RunOutcome {
        if let Err(error) = check(&self.scene, settings) {
            return RunOutcome::Refused(error.to_string());
        }
        let (start, slots) = (Instant::now(), &self.slots);
        let mut watch = Watch { start, limits_s, slots, last: None, looks: Vec::new() };
        let run = || {
            let estimates = simulate(&self.scene, settings, &mut watch);
            watch.end(&estimates)
        };
        match catch_unwind(AssertUnwindSafe(run)) {
            Ok(looks) => RunOutcome::Done(looks),
            Err(panic) => RunOutcome::Crashed(message(&*panic)),
        }
    }
}

impl Observer for Watch<'_> {
    fn progress(&mut self, _progress: &Progress) -> Control {
        // Before the first checkpoint there is nothing to end with.
        if self.last.is_some() { self.verdict() } else { Control::Continue }
    }

    fn checkpoint(&mut self, estimates: &Estimates) -> Control {
        self.take_past();
        self.last = Some(self.look(estimates));
        self.verdict()
    }
}

impl Watch<'_> {
    fn seconds(&self) -> f64 {
        self.start.elapsed().as_secs_f64()
    }

    fn verdict(&self) -> Control {
        let end_s = self.limits_s.last().copied().unwrap_or(0.0);
        if self.seconds() > end_s { Control::Stop } else { Control::Continue }
    }

    /// Limits that have passed see the last checkpoint; before the first one they wait for it.
    fn take_past(&mut self) {
        let Some(last) = &self.last else { return };
        let now_s = self.seconds();
        while let Some(&limit_s) = self.limits_s.get(self.looks.len())
            && limit_s < now_s
        {
            self.looks.push(LookRecord { limit_s, ..last.clone() });
        }
    }

    fn look(&self, estimates: &Estimates) -> LookRecord {
        let intervals: Vec<_> =
            (0..estimates.sensors.len()).map(|sensor| estimates.point_intervals(sensor)).collect();
        let point = |slot: &Slot| {
            let interval = intervals[slot.sensor][slot.point];
            let unseen = estimates.sensors[slot.sensor].unseen.as_ref();
            PointRecord {
                lx: interval.value,
                half_width_lx: interval.half_width.filter(|half_width| half_width.is_finite()),
                // The file knows no infinity.
                unseen_lx: unseen.map(|unseen| unseen.point_lx[slot.point].min(f64::MAX)),
                merged_lx: unseen.map_or(0.0, |unseen| unseen.merged_lx[slot.point]),
                disc_radius_m: unseen.and_then(|unseen| unseen.disc_radius_m[slot.point]),
            }
        };
        LookRecord {
            limit_s: 0.0,
            seconds: self.seconds(),
            samples: estimates.samples,
            is_done: estimates.tolerance_reached,
            is_repeated: false,
            points: self.slots.iter().map(point).collect(),
        }
    }

    /// What is left of the limits sees the end.
    fn end(&mut self, estimates: &Estimates) -> Vec<LookRecord> {
        self.take_past();
        let last = self.look(estimates);
        for &limit_s in &self.limits_s[self.looks.len()..] {
            self.looks.push(LookRecord { limit_s, ..last.clone() });
        }
        let mut before = None;
        for look in &mut self.looks {
            look.is_repeated = before == Some(look.samples);
            before = Some(look.samples);
        }
        std::mem::take(&mut self.looks)
    }
}

fn message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    text.or(panic.downcast_ref::<&str>().copied()).unwrap_or("a panic without a text").to_owned()
}
