//! Pieces of the JSON document: points, lists that may be `null`, and bytes to a value whose errors
//! say where.

use crate::LoadError;
use glam::DVec3;
use quasilux_text::Position;
use serde::de::{DeserializeOwned, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use std::fmt;

/// Three finite numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Point(pub(crate) DVec3);

/// Three or four numbers of vertices.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Facet {
    corners: [u32; 4],
    count: u8,
}

impl Facet {
    pub(crate) fn corners(&self) -> &[u32] {
        &self.corners[..usize::from(self.count)]
    }
}

/// Most elements of a list, since small ones in a file are large in memory.
const MAX_ELEMENTS: usize = 1_000_000;

/// A list of at most so many elements; none where the key is missing or `null`.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct List<T, const MOST: usize = MAX_ELEMENTS>(pub(crate) Vec<T>);

impl<T, const MOST: usize> Default for List<T, MOST> {
    fn default() -> Self {
        Self(Vec::new())
    }
}

impl<T, const MOST: usize> std::ops::Deref for List<T, MOST> {
    type Target = [T];
    fn deref(&self) -> &[T] {
        &self.0
    }
}

struct ListVisitor<T, const MOST: usize>(std::marker::PhantomData<T>);

impl<'de, T: Deserialize<'de>, const MOST: usize> Visitor<'de> for ListVisitor<T, MOST> {
    type Value = List<T, MOST>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a list of at most {MOST} elements")
    }

    fn visit_none<E>(self) -> Result<Self::Value, E> {
        Ok(List::default())
    }

    fn visit_some<D: Deserializer<'de>>(self, list: D) -> Result<Self::Value, D::Error> {
        list.deserialize_seq(self)
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Self::Value, A::Error> {
        let mut elements = Vec::new();
        while let Some(element) = list.next_element()? {
            if elements.len() == MOST {
                return Err(serde::de::Error::invalid_length(MOST + 1, &self));
            }
            elements.push(element);
        }
        Ok(List(elements))
    }
}

impl<'de, T: Deserialize<'de>, const MOST: usize> Deserialize<'de> for List<T, MOST> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_option(ListVisitor(std::marker::PhantomData))
    }
}

/// A value that `null` leaves out.
pub(super) fn or_default<'de, D, T>(deserializer: D) -> Result<T, D::Error>
where
    D: Deserializer<'de>,
    T: Default + Deserialize<'de>,
{
    Ok(Option::deserialize(deserializer)?.unwrap_or_default())
}

struct PointVisitor;

impl<'de> Visitor<'de> for PointVisitor {
    type Value = Point;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("three numbers [x, y, z]")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Point, A::Error> {
        let mut point = [0.0; 3];
        for (number, coordinate) in point.iter_mut().enumerate() {
            let next = list.next_element::<f64>()?;
            *coordinate = next.ok_or_else(|| serde::de::Error::invalid_length(number, &self))?;
        }
        match list.next_element::<serde::de::IgnoredAny>()? {
            None => Ok(Point(DVec3::from_array(point))),
            Some(_) => Err(serde::de::Error::custom("more than three numbers [x, y, z]")),
        }
    }
}

impl<'de> Deserialize<'de> for Point {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(PointVisitor)
    }
}

struct FacetVisitor;

impl<'de> Visitor<'de> for FacetVisitor {
    type Value = Facet;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("three or four numbers of vertices")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Facet, A::Error> {
        let mut facet = Facet { corners: [0; 4], count: 0 };
        while let Some(corner) = list.next_element::<u32>()? {
            let free = facet.corners.get_mut(usize::from(facet.count));
            *free.ok_or_else(|| serde::de::Error::invalid_length(5, &self))? = corner;
            facet.count += 1;
        }
        match facet.count {
            3 | 4 => Ok(facet),
            count => Err(serde::de::Error::invalid_length(usize::from(count), &self)),
        }
    }
}

impl<'de> Deserialize<'de> for Facet {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(FacetVisitor)
    }
}

/// The value that a whole file is; the error has the place and the key.
pub(super) fn parse<T: DeserializeOwned>(file: &str, bytes: &[u8]) -> Result<T, LoadError> {
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let mut reader = serde_json::Deserializer::from_slice(bytes);
    let refuse = |error: &serde_json::Error, path: &str| {
        let place = Position { line: error.line().max(1), column: error.column().max(1) };
        let text = error.to_string();
        // The place stands before the message.
        let text = text.rsplit_once(" at line ").map_or(text.as_str(), |(message, _)| message);
        let message = if error.is_data() {
            format!("{path}: {text}")
        } else {
            format!("not valid JSON: {text}; expected a Honeybee model (HBJSON)")
        };
        LoadError::new(file, Some(place), message.replace('\n', "; "))
    };
    let value = serde_path_to_error::deserialize(&mut reader)
        .map_err(|error| refuse(error.inner(), &error.path().to_string()))?;
    reader.end().map_err(|error| refuse(&error, "."))?;
    Ok(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug, Deserialize)]
    struct Outline {
        #[serde(default)]
        corners: List<Point>,
    }

    fn corners(text: &str) -> Result<Vec<Point>, String> {
        let read = parse::<Outline>("a.hbjson", text.as_bytes());
        read.map(|outline| outline.corners.0).map_err(|error| error.to_string())
    }

    #[test]
    fn points_are_three_numbers() {
        let point = |x| Point(DVec3::new(x, 0.0, -2.5e3));
        assert_eq!(corners("{\"corners\": [[1, 0, -2.5e3]]}"), Ok(vec![point(1.0)]));
        assert_eq!(corners("\u{feff}{\"corners\": null, \"other\": [{}]}"), Ok(vec![]));
        assert_eq!(corners("{}"), Ok(vec![]));
    }

    #[test]
    fn lists_are_bounded() {
        let list = |text: &str| parse::<List<u8, 2>>("a", text.as_bytes());
        assert_eq!(list("[1, 2]").unwrap().0, [1, 2]);
        let error = list("[1, 2, 3]").unwrap_err().to_string();
        assert!(error.ends_with("length 3, expected a list of at most 2 elements"), "{error}");
    }

    #[test]
    fn errors_say_where() {
        let refusal = |text: &str| corners(text).unwrap_err();
        assert_eq!(
            refusal("{\"corners\": [[0, 0, 0],\n [1, 2]]}"),
            "a.hbjson:2:7: corners[1]: invalid length 2, expected three numbers [x, y, z]"
        );
        assert!(refusal("{\"corners\": [[0, 0, 0, 0]]}").contains("corners[0]: more than three"));
        assert!(refusal("{\"corners\": [[0, \"1\", 0]]}").contains("corners[0][1]: invalid type"));
        assert!(refusal("{\"corners\": 7}").contains("corners: invalid type"));
        for text in ["", "{", "[1e999]", "{\"corners\": [[0, 0, 1e999]]}", "{} {}", "{\"a\": NaN}"]
        {
            assert!(refusal(text).contains("a.hbjson:1:"), "{}", refusal(text));
        }
        let deep = "[".repeat(1 << 20);
        assert!(refusal(&format!("{{\"a\": {deep}")).contains("not valid JSON: EOF"));
    }
}
