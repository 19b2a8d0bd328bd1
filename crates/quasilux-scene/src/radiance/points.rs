//! Sensor points as `rtrace` reads them: a position and a direction in each line.

use crate::LoadError;
use glam::DVec3;
use quasilux_text::Position;

/// A point, and where it faces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct PointSensor {
    pub(crate) position: DVec3,
    pub(crate) direction: DVec3,
}

/// Largest coordinate, as in project files.
const MAX_COORDINATE: f64 = 1e9;

/// The points of a file: lines of six numbers, between them empty lines and comments.
pub(crate) fn points(file: &str, bytes: &[u8]) -> Result<Vec<PointSensor>, LoadError> {
    let text = String::from_utf8_lossy(bytes);
    let mut points = Vec::new();
    for (line, text) in (1..).zip(text.lines()) {
        let text = text.trim_start_matches('\u{feff}').trim();
        if text.is_empty() || text.starts_with('#') {
            continue;
        }
        let place = Position { line, column: 1 };
        let error = |message: &str| LoadError::new(file, Some(place), message);
        let words = text.split(|c: char| c.is_whitespace() || c == ',').filter(|it| !it.is_empty());
        let numbers: Option<Vec<f64>> = words.map(|word| word.parse().ok()).collect();
        let is_fine = |it: &&[f64]| it.iter().all(|it| it.abs() <= MAX_COORDINATE);
        let numbers = numbers.as_deref().filter(is_fine);
        let Some(&[x, y, z, dx, dy, dz]) = numbers else {
            return Err(error("expected six numbers: a position and a direction"));
        };
        let direction = DVec3::new(dx, dy, dz);
        if direction.try_normalize().is_none() {
            return Err(error("the direction has no length; expected where the sensor faces"));
        }
        points.push(PointSensor { position: DVec3::new(x, y, z), direction });
    }
    if points.is_empty() {
        return Err(LoadError::new(file, None, "no points; expected lines of six numbers"));
    }
    Ok(points)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_read_line_by_line() {
        let read = points("a.pts", b"# x y z\n1 2 3 0 0 1\r\n\n4,5,6\t1e0 0 -1\n").unwrap();
        assert_eq!(read.len(), 2);
        assert_eq!(read[1].position, DVec3::new(4.0, 5.0, 6.0));
        assert_eq!(read[1].direction, DVec3::new(1.0, 0.0, -1.0));
        for wrong in [&b""[..], b"1 2 3", b"1 2 3 0 0 0", b"1 2 3 0 0 nan", b"1 2 3 0 0 1e99"] {
            assert!(points("a.pts", wrong).is_err());
        }
        assert_eq!(points("a", b"\n1 2").unwrap_err().place().unwrap().line, 2);
    }
}
