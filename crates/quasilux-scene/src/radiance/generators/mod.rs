//! Programs that write scenes, evaluated here: boxes, blinds and skies.

mod blinds;
mod boxes;
mod daylight;
mod sky;

use super::document::{Primitive, shown};
use super::refusal::not_run;
use glam::DVec3;

pub(super) use daylight::FILE as FILE_OF_GENDAYLIT;

/// A generator with its arguments.
#[derive(Clone, Debug)]
pub(super) enum Generator {
    Box(boxes::Genbox),
    Blinds(blinds::Genblinds),
    Sky(sky::Gensky),
    Daylight(daylight::Gendaylit),
}

impl Generator {
    /// A program by its name; others are refused by it.
    pub(super) fn parse(name: &str, words: &[String]) -> Result<Self, String> {
        Ok(match name {
            "genbox" => Self::Box(boxes::Genbox::parse(words)?),
            "genblinds" => Self::Blinds(blinds::Genblinds::parse(words)?),
            "gensky" => Self::Sky(sky::Gensky::parse(words)?),
            "gendaylit" => Self::Daylight(daylight::Gendaylit::parse(words)?),
            _ => return Err(not_run(name)),
        })
    }

    /// Remarks on arguments that are otherwise here.
    pub(super) fn remarks(&self) -> &[&'static str] {
        match self {
            Self::Box(_) | Self::Blinds(_) => &[],
            Self::Sky(it) => &it.remarks,
            Self::Daylight(it) => &it.remarks,
        }
    }

    /// Primitives that the program prints.
    pub(super) fn primitives(&self) -> Vec<Primitive> {
        match self {
            Self::Box(it) => it.primitives(),
            Self::Blinds(it) => it.primitives(),
            Self::Sky(it) => it.primitives(),
            Self::Daylight(it) => it.primitives(),
        }
    }
}

/// The number in an argument.
fn number(words: &[String], at: usize, of: &str) -> Result<f64, String> {
    let word = words.get(at).ok_or_else(|| format!("{of} lacks an argument"))?;
    let number = word.parse().ok().filter(|number: &f64| number.abs() <= 1e9);
    number.ok_or_else(|| format!("{of} has {}; expected a number", shown(word)))
}

fn polygon(modifier: &str, name: String, corners: impl Iterator<Item = DVec3>) -> Primitive {
    Primitive {
        modifier: modifier.into(),
        kind: "polygon".into(),
        name: name.into(),
        strings: Vec::new(),
        reals: corners.flat_map(|corner| corner.to_array()).collect(),
    }
}
