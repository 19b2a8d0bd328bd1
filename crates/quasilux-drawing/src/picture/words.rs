//! The words around a picture in lines that fit its width: a title that is too long becomes smaller
//! and then takes more lines, and so does all that stands above and below the picture.

use super::caption::Caption;
use crate::text::{fits_at, width_px, wrapped};

/// Font sizes of the title, the largest that fits is taken.
const TITLE_PX: [f64; 3] = [28.0, 22.0, 17.0];
/// Font size of the figures under it.
pub(crate) const SUMMARY_PX: f64 = 15.5;
/// Font size of numbers on axes and legend, and of what stands below.
pub(crate) const SMALL_PX: f64 = 12.6;
/// The largest share of the width for the name of what a picture belongs to.
const MAX_PROJECT_SHARE: f64 = 0.4;
/// Clear space between title and project.
const BETWEEN_PX: f64 = 30.0;
/// Most lines of one text.
const MAX_LINES: usize = 4;
/// From the base line of one line to that of the next, in the font size.
const LINE_EM: f64 = 1.25;
const GAP: &str = "     ";

/// The words around a picture, in lines.
pub(crate) struct Words {
    pub(crate) title_px: f64,
    pub(crate) title: Vec<String>,
    pub(crate) project: Vec<String>,
    pub(crate) facts: Vec<String>,
    /// How the values were made.
    pub(crate) method: Vec<String>,
    /// What restricts their use.
    pub(crate) caution: Vec<String>,
}

impl Words {
    pub(crate) fn new(caption: &Caption<'_>, most_px: f64) -> Self {
        let project = wrapped(caption.project, SUMMARY_PX, MAX_PROJECT_SHARE * most_px, MAX_LINES);
        let widest = project.iter().map(|line| width_px(line, SUMMARY_PX)).fold(0.0, f64::max);
        let for_title = if project.is_empty() { most_px } else { most_px - widest - BETWEEN_PX };
        let title_px = fits_at(caption.title, &TITLE_PX, for_title);
        let small = |text: &str| {
            let lines = wrapped(text, SMALL_PX, most_px, MAX_LINES);
            if lines.is_empty() { vec![String::new()] } else { lines }
        };
        Self {
            title_px,
            title: wrapped(caption.title, title_px, for_title, MAX_LINES),
            project,
            facts: joined(caption.facts, most_px),
            method: small(caption.method),
            caution: small(caption.caution),
        }
    }

    /// Distance between the base lines of the title.
    pub(crate) fn title_line_px(&self) -> f64 {
        (LINE_EM * self.title_px).round()
    }

    /// Distance between the base lines of the project.
    pub(crate) fn project_line_px() -> f64 {
        (LINE_EM * SUMMARY_PX).round()
    }

    /// Height that title and project need below the base line of their first lines.
    pub(crate) fn head_more_px(&self) -> f64 {
        let more = |lines: &[String], line_px: f64| lines.len().saturating_sub(1) as f64 * line_px;
        more(&self.title, self.title_line_px()).max(more(&self.project, Self::project_line_px()))
    }

    /// Lines below the picture.
    pub(crate) fn footer_lines(&self) -> usize {
        self.method.len() + self.caution.len()
    }
}

/// Joins facts into lines of at most a width; one that is longer is broken between its words.
fn joined(facts: &[String], most_px: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for fact in facts {
        if let Some(last) = lines.last_mut() {
            let longer = format!("{last}{GAP}{fact}");
            if width_px(&longer, SUMMARY_PX) <= most_px {
                *last = longer;
                continue;
            }
        }
        lines.extend(wrapped(fact, SUMMARY_PX, most_px, MAX_LINES));
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    fn facts(texts: &[&str]) -> Vec<String> {
        texts.iter().map(|text| (*text).to_owned()).collect()
    }

    #[test]
    fn facts_wrap_between_them() {
        let pieces = facts(&["average 500 lx", "minimum 200 lx"]);
        assert_eq!(joined(&pieces, 520.0).len(), 1);
        let many = vec![pieces; 6].concat();
        let lines = joined(&many, 520.0);
        assert_eq!(lines.len(), 3);
        assert!(lines.iter().all(|line| width_px(line, SUMMARY_PX) <= 520.0));
        assert_eq!(lines.join(GAP), many.join(GAP));
    }

    /// No word is lost of a title, a project and a footer that need more than one line.
    #[test]
    fn nothing_is_cut_off() {
        let words = |n: usize| (0..n).map(|k| format!("word{k}")).collect::<Vec<_>>().join(" ");
        let all = facts(&[&words(12)]);
        let caption = Caption {
            title: &words(14),
            project: "a_file_name_that_has_no_spaces_in_it_and_is_long",
            facts: &all,
            method: &words(20),
            caution: &words(18),
        };
        let found = Words::new(&caption, 520.0);
        for (lines, text) in [(&found.title, 14), (&found.facts, 12), (&found.method, 20)] {
            assert!(lines.len() > 1);
            assert_eq!(lines.join(" "), words(text));
        }
        assert_eq!(found.caution.join(" "), words(18));
        assert_eq!(found.project.concat(), caption.project);
        let width = |lines: &[String], px: f64| {
            lines.iter().map(|line| width_px(line, px)).fold(0.0, f64::max)
        };
        let head = width(&found.title, found.title_px) + width(&found.project, SUMMARY_PX);
        assert!(head + BETWEEN_PX <= 520.0 + 1e-9, "{head}");
        assert!(width(&found.method, SMALL_PX) <= 520.0);
    }
}
