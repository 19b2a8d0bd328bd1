//! Views (`.vf`): options of `rpict` and `rvu`, one view in each line.

use crate::LoadError;
use glam::DVec3;
use quasilux_text::Position;

/// A view that a camera has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct View {
    pub(crate) position: DVec3,
    pub(crate) direction: DVec3,
    pub(crate) up: DVec3,
    /// Full angles in degrees.
    pub(crate) horizontal_deg: f64,
    pub(crate) vertical_deg: f64,
}

/// A line of a file: a view, or why there is no camera like it.
pub(crate) struct ViewLine {
    pub(crate) line: usize,
    pub(crate) view: Result<View, &'static str>,
    /// Parts of it that a camera has not.
    pub(crate) note: Option<&'static str>,
}

/// Options of a view, as far as they are told.
#[derive(Default)]
struct Options {
    kind: Option<char>,
    position: Option<DVec3>,
    direction: Option<DVec3>,
    up: Option<DVec3>,
    horizontal: Option<f64>,
    vertical: Option<f64>,
    is_moved: bool,
    is_clipped: bool,
}

/// The views of a file.
pub(crate) fn views(file: &str, bytes: &[u8]) -> Result<Vec<ViewLine>, LoadError> {
    let text = String::from_utf8_lossy(bytes);
    let mut views = Vec::new();
    for (line, text) in (1..).zip(text.lines()) {
        let mut words = text.split_whitespace().map(|word| word.trim_start_matches("VIEW="));
        let mut options = Options::default();
        let mut is_view = false;
        while let Some(word) = words.next() {
            let Some(option) = word.strip_prefix("-v") else { continue };
            is_view = true;
            options.take(option, &mut words).ok_or_else(|| {
                let place = Some(Position { line, column: 1 });
                let option = super::document::shown(word);
                let message = format!(
                    "{option} lacks its numbers, or is no option of a view; expected -vt, -vp, \
                     -vd, -vu, -vh, -vv, -vs, -vl, -vo or -va"
                );
                LoadError::new(file, place, message)
            })?;
        }
        if is_view {
            let note = "its fore and aft planes (-vo, -va) are left out";
            let note = options.is_clipped.then_some(note);
            views.push(ViewLine { line, view: options.view(), note });
        }
    }
    if views.is_empty() {
        let message = "no view; expected a line with options such as -vp and -vd";
        return Err(LoadError::new(file, None, message));
    }
    Ok(views)
}

impl Options {
    fn take<'t>(&mut self, option: &str, words: &mut impl Iterator<Item = &'t str>) -> Option<()> {
        let mut number = || {
            let number: f64 = words.next()?.parse().ok()?;
            (number.abs() <= 1e9).then_some(number)
        };
        if let Some(kind) = option.strip_prefix('t') {
            self.kind = kind.chars().next();
            return Some(());
        }
        match option {
            "p" => self.position = Some(DVec3::new(number()?, number()?, number()?)),
            "d" => self.direction = Some(DVec3::new(number()?, number()?, number()?)),
            "u" => self.up = Some(DVec3::new(number()?, number()?, number()?)),
            "h" => self.horizontal = Some(number()?),
            "v" => self.vertical = Some(number()?),
            "s" | "l" => self.is_moved |= number()? != 0.0,
            "o" | "a" => self.is_clipped |= number()? != 0.0,
            _ => return None,
        }
        Some(())
    }

    fn view(&self) -> Result<View, &'static str> {
        if self.kind.unwrap_or('v') != 'v' {
            return Err("only perspective views (-vtv) become cameras: left out");
        }
        if self.is_moved {
            return Err("a view with shift or lift is left out");
        }
        let direction = self.direction.unwrap_or(DVec3::Y);
        let up = self.up.unwrap_or(DVec3::Z);
        let angle = |angle: Option<f64>| angle.unwrap_or(45.0);
        let (horizontal_deg, vertical_deg) = (angle(self.horizontal), angle(self.vertical));
        if [horizontal_deg, vertical_deg].iter().any(|it| !(*it > 0.0 && *it < 180.0)) {
            return Err("angles of a perspective view lie between 0 and 180: left out");
        }
        if direction.normalize_or_zero().cross(up.normalize_or_zero()).length() < 1e-6 {
            return Err("a view whose direction is along -vu is left out");
        }
        let position = self.position.unwrap_or(DVec3::ZERO);
        Ok(View { position, direction, up, horizontal_deg, vertical_deg })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_of_programs_are_views() {
        let text = b"rvu -vtv -vp 1 2 3 -vd 0 1 -.5 -vu 0 0 1 -vh 60 -vv 40 -vo 0 -va 0\n\
            # nothing\nVIEW= -vtl -vp 1 1 1\n-vd 0 0 1\n";
        let read = views("a.vf", text).unwrap();
        let View { position, direction, horizontal_deg, vertical_deg, .. } = read[0].view.unwrap();
        assert_eq!(position, DVec3::new(1.0, 2.0, 3.0));
        assert_eq!(direction, DVec3::new(0.0, 1.0, -0.5));
        assert_eq!((horizontal_deg, vertical_deg, read[0].line), (60.0, 40.0, 1));
        assert!(read[1].view.is_err() && read[2].view.is_err());
        assert!(read[0].note.is_none());
        assert!(views("a.vf", b"-vtv -vo 0.5").unwrap()[0].note.is_some());
        assert!(views("a.vf", b"-vtv -vx 1").is_err());
        assert!(views("a.vf", b"-vp 1 2").is_err() && views("a.vf", b"x").is_err());
    }
}
