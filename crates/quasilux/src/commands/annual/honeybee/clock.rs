//! Hours as Honeybee counts them: from the beginning of a year without 29 February.

use quasilux_report::annual::{Calendar, Interval};

/// Days before a month of a year without 29 February.
const DAYS_BEFORE: [u32; 12] = [0, 31, 59, 90, 120, 151, 181, 212, 243, 273, 304, 334];

/// The hours of a weather file, and which of them have light.
pub(super) struct Clock {
    /// Intervals in an hour.
    pub(super) timestep: u32,
    /// When intervals begin, in h of the year.
    pub(super) study_h: Vec<f64>,
    /// Times of those with light: with one interval an hour their middle, or else when
    /// they begin, in h of the year.
    pub(super) sun_up_h: Vec<f64>,
    /// Their numbers in the weather file.
    pub(super) sun_up: Vec<usize>,
    /// How many intervals are left out: those of 29 February.
    pub(super) left_out: usize,
}

impl Clock {
    /// The clock of a weather file.
    ///
    /// # Errors
    /// In words, where intervals are longer than an hour or no whole part of one.
    pub(super) fn new(calendar: &Calendar) -> Result<Self, String> {
        let timestep = (1.0 / calendar.interval_h).round();
        if timestep < 1.0 || (timestep * calendar.interval_h - 1.0).abs() > 1e-6 {
            return Err(format!(
                "Honeybee's results are of hours or of whole parts of them, the weather has \
                 intervals of {} h; leave out --honeybee",
                calendar.interval_h
            ));
        }
        let timestep = timestep as u32;
        let mut clock =
            Self { timestep, study_h: vec![], sun_up_h: vec![], sun_up: vec![], left_out: 0 };
        for (number, interval) in calendar.intervals.iter().enumerate() {
            if (interval.month, interval.day) == (2, 29) {
                clock.left_out += 1;
                continue;
            }
            clock.add(number, interval, calendar.interval_h);
        }
        Ok(clock)
    }

    fn add(&mut self, number: usize, interval: &Interval, interval_h: f64) {
        let day = DAYS_BEFORE[interval.month as usize - 1] + interval.day - 1;
        let middle_h = f64::from(24 * day) + interval.middle_h;
        let parts = f64::from(self.timestep);
        let begin_h = ((middle_h - 0.5 * interval_h) * parts + 1e-6).floor().max(0.0) / parts;
        self.study_h.push(begin_h);
        if interval.sky.is_some() {
            self.sun_up_h.push(if self.timestep == 1 { begin_h + 0.5 } else { begin_h });
            self.sun_up.push(number);
        }
    }
}
