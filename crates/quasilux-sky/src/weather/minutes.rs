//! When the intervals of lines of an EPW file end: by their minutes, or by their order in an hour.
//!
//! The format says that the minute is that of the end. Programs also write the minute of the
//! beginning, 0 for the end of an hour, or the same minute everywhere; EnergyPlus itself counts the
//! lines of an hour.

use std::collections::BTreeMap;

/// What a line says of its time.
#[derive(Clone, Copy)]
pub(super) struct LineTime {
    pub(super) date: [u32; 2],
    /// 1 to 24.
    pub(super) hour_of_day: f64,
    /// 0 to 60.
    pub(super) minute: f64,
}

impl LineTime {
    fn is_of_the_hour_of(&self, other: &Self) -> bool {
        self.date == other.date && self.hour_of_day == other.hour_of_day
    }
}

/// The end of each line's interval, in h from midnight.
pub(super) fn ends_h(lines: &[LineTime], declared: f64) -> Vec<f64> {
    let runs = || lines.chunk_by(LineTime::is_of_the_hour_of);
    let an_hour = usual_length(runs().map(<[LineTime]>::len));
    let stamp = Stamp::new(lines, declared, an_hour);
    let ends = runs().flat_map(|run| {
        (1..).zip(run).map(move |(number, line)| {
            let LineTime { hour_of_day, minute, .. } = *line;
            let part = match stamp {
                Stamp::Hour => 1.0,
                Stamp::Order => f64::from(number).min(an_hour) / an_hour,
                Stamp::End => minute / 60.0,
                Stamp::EndOfHourIsZero if minute == 0.0 => 1.0,
                Stamp::EndOfHourIsZero => minute / 60.0,
                Stamp::Begin => minute / 60.0 + 1.0 / an_hour,
            };
            hour_of_day - 1.0 + part
        })
    });
    ends.collect()
}

/// What minutes mean.
#[derive(Clone, Copy)]
enum Stamp {
    /// Nothing: one line an hour.
    Hour,
    /// Nothing: the order of lines tells.
    Order,
    /// When an interval ends.
    End,
    /// The same, and 0 is 60.
    EndOfHourIsZero,
    /// When an interval begins.
    Begin,
}

impl Stamp {
    fn new(lines: &[LineTime], declared: f64, an_hour: f64) -> Self {
        let vary = match lines {
            [] => false,
            [_] => declared > 1.0,
            [first, others @ ..] => {
                others.iter().any(|line| line.minute % 60.0 != first.minute % 60.0)
            }
        };
        if !vary {
            return if an_hour > 1.0 { Self::Order } else { Self::Hour };
        }
        if lines.iter().any(|line| line.minute == 60.0) {
            return Self::End;
        }
        let runs = || lines.chunk_by(LineTime::is_of_the_hour_of).filter(|run| run.len() > 1);
        let is_zero = |line: Option<&LineTime>| line.is_some_and(|line| line.minute == 0.0);
        let begin = runs().filter(|run| is_zero(run.first())).count();
        let end = runs().filter(|run| is_zero(run.last())).count();
        match begin.cmp(&end) {
            std::cmp::Ordering::Greater => Self::Begin,
            std::cmp::Ordering::Less => Self::EndOfHourIsZero,
            std::cmp::Ordering::Equal => Self::End,
        }
    }
}

/// The length of the runs that most lines are in.
fn usual_length(lengths: impl Iterator<Item = usize>) -> f64 {
    let mut lines = BTreeMap::<usize, usize>::new();
    for length in lengths {
        *lines.entry(length).or_default() += length;
    }
    let usual = lines.into_iter().max_by_key(|(_, count)| *count);
    usual.map_or(1.0, |(length, _)| length as f64)
}
