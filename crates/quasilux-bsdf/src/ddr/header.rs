//! The head of a DDR file: what the values are and over which angles.

use super::Words;
use crate::gridded::MAX_INCIDENCES;
use quasilux_text::{ParseError, Position, Token, quoted};
use std::f64::consts::{PI, TAU};

/// What stands before the values.
#[derive(Debug)]
pub(super) struct Header {
    /// Where the angles around the specular direction are given.
    pub(super) at: Position,
    pub(super) symmetry: SpecularSymmetry,
    pub(super) colours: Colours,
    pub(super) unit: Unit,
    /// Incident azimuths; one alone where the surface is isotropic.
    pub(super) psi_rad: Vec<f64>,
    /// Incident polar angles.
    pub(super) sigma_rad: Vec<f64>,
    /// Polar angle of the specular direction, for each of `sigma_rad`.
    pub(super) specular_rad: Vec<f64>,
    /// Azimuths about the specular direction.
    pub(super) phi_rad: Vec<f64>,
    /// Angles from the specular direction.
    pub(super) theta_rad: Vec<f64>,
}

/// How values repeat about the specular direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum SpecularSymmetry {
    /// About the direction itself.
    Axis,
    /// In the plane of incidence.
    Plane,
    /// Not at all.
    None,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Colours {
    Grey,
    Rgb,
}

/// What the scale of an incidence means.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Unit {
    /// Values are multiplied by it.
    Absolute,
    /// It is the albedo.
    Relative,
}

impl Header {
    /// Incident azimuths without the closing one at a whole turn.
    pub(super) fn planes(&self) -> usize {
        let is_closed = self.psi_rad[self.psi_rad.len() - 1] > TAU - 1e-9;
        self.psi_rad.len() - usize::from(is_closed && self.psi_rad.len() > 1)
    }

    pub(super) fn incidences(&self) -> usize {
        self.psi_rad.len() * self.sigma_rad.len()
    }
}

/// The head of a file up to the first block.
pub(super) struct Head<'t> {
    pub(super) header: Header,
    /// The word behind the head, which begins the first block.
    pub(super) first_block: Token<'t>,
}

/// A word of a closed list.
struct Keyword<T> {
    name: &'static str,
    meaning: T,
}

/// Reads up to the first block.
pub(super) fn read<'t>(words: &mut Words<'t>) -> Result<Head<'t>, ParseError> {
    let mut header = Header {
        at: Position { line: 1, column: 1 },
        symmetry: SpecularSymmetry::Plane,
        colours: Colours::Rgb,
        unit: Unit::Absolute,
        psi_rad: vec![],
        sigma_rad: vec![],
        specular_rad: vec![],
        phi_rad: vec![],
        theta_rad: vec![],
    };
    loop {
        let word = words.next("the head of a DDR file")?;
        match word.text.to_ascii_lowercase().as_str() {
            "source" => {
                words.next("a source")?;
            }
            "typesym" => header.symmetry = symmetry(words)?,
            // Four dimensions, after "ASymmetrical": so psi follows.
            "4d" => {}
            "typecolormodel" => header.colours = colours(words)?,
            "typedata" => header.unit = unit(words)?,
            "psi" => header.psi_rad = angles(words, "psi", TAU)?,
            "sigma" => header.sigma_rad = angles(words, "sigma", 0.5 * PI)?,
            "sigmat" => {
                let count = header.sigma_rad.len();
                header.specular_rad = list(words, "sigmat", count, 0.5 * PI)?;
            }
            "phi" => {
                header.at = word.at;
                header.phi_rad = angles(words, "phi", TAU)?;
            }
            "theta" => header.theta_rad = angles(words, "theta", PI)?,
            "bw" | "red" | "gre" | "green" | "blu" | "blue" => return finish(header, word),
            _ => {
                let expected =
                    "TypeSym, TypeColorModel, TypeData, psi, sigma, phi, theta or a block";
                return Err(ParseError::new(word.at, quoted(word.text), expected));
            }
        }
    }
}

fn finish(mut header: Header, word: Token<'_>) -> Result<Head<'_>, ParseError> {
    let lists = [
        ("sigma", header.sigma_rad.len()),
        ("phi", header.phi_rad.len()),
        ("theta", header.theta_rad.len()),
    ];
    if let Some((missing, _)) = lists.into_iter().find(|(_, count)| *count == 0) {
        let found = format!("the block {} before {missing}", quoted(word.text));
        return Err(ParseError::new(
            word.at,
            found,
            format_args!("the angles {missing} before it"),
        ));
    }
    if header.psi_rad.is_empty() {
        header.psi_rad.push(0.0);
    }
    if header.incidences() > MAX_INCIDENCES {
        let found = format!("{} incident directions", header.incidences());
        return Err(ParseError::new(word.at, found, format_args!("no more than {MAX_INCIDENCES}")));
    }
    if header.specular_rad.is_empty() {
        header.specular_rad = header.sigma_rad.clone();
    }
    Ok(Head { header, first_block: word })
}

fn symmetry(words: &mut Words<'_>) -> Result<SpecularSymmetry, ParseError> {
    let known = [
        Keyword { name: "AxiSymmetrical", meaning: SpecularSymmetry::Axis },
        Keyword { name: "PlaneSymmetrical", meaning: SpecularSymmetry::Plane },
        Keyword { name: "ASymmetrical", meaning: SpecularSymmetry::None },
    ];
    one_of(words, &known, "AxiSymmetrical, PlaneSymmetrical or ASymmetrical")
}

fn colours(words: &mut Words<'_>) -> Result<Colours, ParseError> {
    let known = [
        Keyword { name: "BW", meaning: Colours::Grey },
        Keyword { name: "RGB", meaning: Colours::Rgb },
    ];
    one_of(words, &known, "BW or RGB")
}

fn unit(words: &mut Words<'_>) -> Result<Unit, ParseError> {
    one_of(words, &[Keyword { name: "Luminance", meaning: () }], "Luminance")?;
    let known = [
        Keyword { name: "Absolute", meaning: Unit::Absolute },
        Keyword { name: "Relative", meaning: Unit::Relative },
    ];
    one_of(words, &known, "Absolute or Relative")
}

/// The meaning of a word of a list.
fn one_of<T: Copy>(
    words: &mut Words<'_>,
    known: &[Keyword<T>],
    expected: &str,
) -> Result<T, ParseError> {
    let word = words.next(expected)?;
    let found = known.iter().find(|keyword| keyword.name.eq_ignore_ascii_case(word.text));
    found
        .map(|keyword| keyword.meaning)
        .ok_or_else(|| ParseError::new(word.at, quoted(word.text), expected))
}

/// A count and this many ascending angles in degrees, from 0 to `last_rad`.
fn angles(words: &mut Words<'_>, name: &str, last_rad: f64) -> Result<Vec<f64>, ParseError> {
    let word = words.next("a count of angles")?;
    let count = word.number("a count of angles")?.value;
    if count.fract() != 0.0 || !(1.0..=1e6).contains(&count) {
        let expected = format!("a count of {name} from 1 to 1000000");
        return Err(ParseError::new(word.at, quoted(word.text), expected));
    }
    list(words, name, count as usize, last_rad)
}

fn list(
    words: &mut Words<'_>,
    name: &str,
    count: usize,
    last_rad: f64,
) -> Result<Vec<f64>, ParseError> {
    let mut angles: Vec<f64> = Vec::new();
    for _ in 0..count {
        let word = words.next("an angle")?;
        let angle_rad = word.number("an angle in degrees")?.value.to_radians();
        let ascends = angles.last().is_none_or(|&before| angle_rad > before + 1e-9);
        if !ascends || !(0.0..=last_rad + 1e-9).contains(&angle_rad) {
            let expected =
                format!("{name} ascending within 0 and {:.0} degrees", last_rad.to_degrees());
            return Err(ParseError::new(word.at, quoted(word.text), expected));
        }
        angles.push(angle_rad.min(last_rad));
    }
    Ok(angles)
}
