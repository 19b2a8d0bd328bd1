//! The counts as CSV and as tables, and what is chosen by them.

use super::kinds::{INDICES, Kind};
use super::pool::Pool;
use super::runs::STOP;
use super::stopping::Rule;
use super::{Count, ENOUGH};
use quasilux_report::number::{brief, exact};
use std::fmt::Write;

/// One line a room and kind.
pub(super) fn csv(counts: &[Count]) -> String {
    let mut text = "room,kind,moment,runs,covered,coverage,too_high,half_width_over_truth,\
                    over_student_t,median_indices,stopped\n"
        .to_owned();
    for count in counts {
        let optional = |x: Option<f64>| x.map(exact).unwrap_or_default();
        writeln!(
            text,
            "{},{},{},{},{},{},{},{},{},{},{}",
            count.room,
            count.kind.replace(',', ""),
            count.moment,
            count.runs,
            count.covered,
            exact(count.coverage()),
            count.too_high,
            optional(count.half_width),
            optional(over_student(counts, count)),
            count.samples,
            count.stopped,
        )
        .expect("strings grow");
    }
    text
}

/// All counts, and the pools that they are from.
pub(super) struct Judged<'c> {
    pub(super) counts: &'c [Count],
    pub(super) pools: &'c [Pool],
}

impl Judged<'_> {
    /// The tables, and what they say.
    pub(super) fn markdown(&self, runs: u32) -> String {
        let mut text = format!(
            "# Kinds of intervals\n\n\
             How often 95 % intervals cover the truth, in %, and their median half-widths over \
             those of Student's t, over {runs} runs of {INDICES} indices in rooms with jumps and \
             heavy tails.\n\n"
        );
        text += &self.fixed();
        text += "\nRuns of independent indices that end at the first of five looks, from 16 x 128 \
                 to 16 x 2048, at which their interval is as narrow as Student's t is after 16 x \
                 512: coverage in %, median number of indices, and how many in 100 ended so.\n\n";
        text += &self.header();
        for rule in Rule::ALL {
            self.row(&mut text, rule.name(), |pool| {
                let count = found(self.counts, pool.room, rule.name());
                let stopped = 100.0 * count.stopped as f64 / count.runs as f64;
                format!("{:.1}, {}, {stopped:.0}", 100.0 * count.coverage(), count.samples)
            });
        }
        text.push('\n');
        for kind in Kind::ALL {
            writeln!(text, "- {}: {}", kind.name(), kind.what()).expect("strings grow");
        }
        for pool in self.pools {
            writeln!(text, "- {}: {}", pool.room, pool.what).expect("strings grow");
        }
        text + &self.choice()
    }

    /// The table of a fixed number of indices.
    fn fixed(&self) -> String {
        let mut text = self.header();
        for kind in Kind::ALL {
            self.row(&mut text, kind.name(), |pool| {
                let count = found(self.counts, pool.room, kind.name());
                let width =
                    over_student(self.counts, count).map_or("-".to_owned(), |x| brief(x, 3));
                format!("{:.1}, {width}", 100.0 * count.coverage())
            });
        }
        self.row(&mut text, "half-width of Student t over truth", |pool| {
            let own = found(self.counts, pool.room, Kind::StudentT.name()).half_width;
            own.map_or("-".to_owned(), |share| format!("{} %", brief(100.0 * share, 2)))
        });
        self.row(&mut text, "K W over truth", |pool| brief(pool.range_lx / pool.trials.mean, 2));
        self.row(&mut text, "largest total of an index over K W", |pool| {
            brief(pool.trials.most() / pool.range_lx, 2)
        });
        self.row(&mut text, "light that no sample met, at most, over truth", |pool| {
            format!("{} %", brief(100.0 * pool.unseen_share(INDICES), 2))
        });
        text
    }

    /// What the default keeps.
    fn choice(&self) -> String {
        let left_out: Vec<&str> =
            self.pools.iter().filter(|it| !is_judged(it)).map(|it| it.room).collect();
        let mut text = format!(
            "\nStudent's t covers {:.1} % in the mean over rooms (left out, for more light than \
             was found may have been met by no sample: {}). **The default keeps it** if that is \
             {:.1} % at least and each kind that covers as much is wider in the mean over rooms: \
             {}.\n",
            100.0 * self.mean_coverage(Kind::StudentT),
            if left_out.is_empty() { "none".to_owned() } else { left_out.join(", ") },
            100.0 * ENOUGH,
            if self.keeps_student() { "holds" } else { "**FAILS**" }
        );
        for kind in Kind::ALL.into_iter().skip(1) {
            let width = self.mean_width(kind).map_or("without end in some".to_owned(), |it| {
                format!("{} times as wide in the geometric mean", brief(it, 3))
            });
            let coverage = 100.0 * self.mean_coverage(kind);
            writeln!(text, "- {}: covers {coverage:.1} %, {width}", kind.name())
                .expect("strings grow");
        }
        text
    }

    /// Whether Student's t covers enough, and what covers as much is wider.
    pub(super) fn keeps_student(&self) -> bool {
        let student = self.mean_coverage(Kind::StudentT);
        let is_no_better = |kind: &Kind| {
            let covers_less = self.mean_coverage(*kind) < student;
            covers_less || self.mean_width(*kind).is_none_or(|width| width > 1.0)
        };
        student >= ENOUGH && Kind::ALL.iter().skip(1).all(is_no_better)
    }

    fn of_kind(&self, kind: Kind) -> impl Iterator<Item = &Count> {
        let judged = self.pools.iter().filter(|pool| is_judged(pool));
        judged.map(move |pool| found(self.counts, pool.room, kind.name()))
    }

    fn mean_coverage(&self, kind: Kind) -> f64 {
        let own: Vec<f64> = self.of_kind(kind).map(Count::coverage).collect();
        own.iter().sum::<f64>() / own.len() as f64
    }

    /// The geometric mean over rooms of half-widths over those of Student's t; `None` where one of
    /// them has no end.
    fn mean_width(&self, kind: Kind) -> Option<f64> {
        let log = |count: &Count| over_student(self.counts, count).map(libm::log);
        let logs: Option<Vec<f64>> = self.of_kind(kind).map(log).collect();
        let logs = logs?;
        Some(libm::exp(logs.iter().sum::<f64>() / logs.len() as f64))
    }

    fn header(&self) -> String {
        let rooms: Vec<&str> = self.pools.iter().map(|pool| pool.room).collect();
        format!("| kind | {} |\n|---|{}\n", rooms.join(" | "), "---:|".repeat(rooms.len()))
    }

    fn row(&self, text: &mut String, name: &str, cell: impl Fn(&Pool) -> String) {
        let cells: Vec<String> = self.pools.iter().map(cell).collect();
        writeln!(text, "| {name} | {} |", cells.join(" | ")).expect("strings grow");
    }
}

/// Whether the choice follows a room.
fn is_judged(pool: &Pool) -> bool {
    pool.unseen_share(INDICES) < 1.0
}

impl Count {
    pub(super) fn coverage(&self) -> f64 {
        self.covered as f64 / self.runs as f64
    }
}

/// Its half-width over that of Student's t in the same room after a fixed number of indices.
fn over_student(counts: &[Count], count: &Count) -> Option<f64> {
    let student = found(counts, count.room, Kind::StudentT.name()).half_width?;
    count.half_width.filter(|_| count.moment != STOP).map(|own| own / student)
}

fn found<'c>(counts: &'c [Count], room: &str, kind: &str) -> &'c Count {
    let own = counts.iter().find(|count| count.room == room && count.kind == kind);
    own.expect("each kind was counted in each room")
}
