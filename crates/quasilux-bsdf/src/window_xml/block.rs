//! The blocks of scattering data that are read: one spectrum, each side and mode once.

use crate::side::ScatteringMode;
use crate::side::Side;
use crate::warning::WarningKind;
use crate::warning::Warnings;
use quasilux_text::xml::Element;
use quasilux_text::{ParseError, quoted};

/// One element `WavelengthDataBlock`.
pub(super) struct Block<'e, 't> {
    pub(super) light: SideAndMode,
    pub(super) element: &'e Element<'t>,
}

/// The light that a block is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct SideAndMode {
    pub(super) side: Side,
    pub(super) mode: ScatteringMode,
}

/// One element `WavelengthData` and its spectrum.
#[derive(Clone, Copy)]
struct SpectralData<'e, 't> {
    spectrum: Spectrum,
    element: &'e Element<'t>,
}

/// A spectrum that a block is measured over.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Spectrum {
    Visible,
    Solar,
    /// CIE X and Z, or u and v, beside a visible Y.
    Colour,
    Other,
}

impl Spectrum {
    fn from_element(element: &Element<'_>) -> Self {
        let word = element.child("Wavelength").map_or("", |wavelength| wavelength.text());
        let words = [
            ("Visible", Self::Visible),
            ("Solar", Self::Solar),
            ("CIE-X", Self::Colour),
            ("CIE-Z", Self::Colour),
            ("CIE-u", Self::Colour),
            ("CIE-v", Self::Colour),
        ];
        let known = words.into_iter().find(|(known, _)| known.eq_ignore_ascii_case(word));
        known.map_or(Self::Other, |(_, spectrum)| spectrum)
    }
}

/// The blocks of the visible spectrum, or else of the solar one; at least one.
pub(super) fn select<'e, 't>(
    layer: &'e Element<'t>,
    warnings: &mut Warnings,
) -> Result<Vec<Block<'e, 't>>, ParseError> {
    let with_spectrum =
        |element| SpectralData { spectrum: Spectrum::from_element(element), element };
    let data: Vec<SpectralData<'_, '_>> =
        data_of_one_layer(layer, warnings).into_iter().map(with_spectrum).collect();
    let first_of = |wanted: Spectrum| {
        data.iter().find(|data| data.spectrum == wanted).map(|data| data.element)
    };
    if let Some(colour) = first_of(Spectrum::Colour) {
        let expected = "Visible alone (the colour is left out)";
        warnings.push(WarningKind::ColourLeftOut, colour.at, "data of the colour", expected);
    }
    let spectrum = match (first_of(Spectrum::Visible), first_of(Spectrum::Solar)) {
        (Some(_), _) => Spectrum::Visible,
        (None, Some(solar)) => {
            let expected = "Visible (read as if it were)";
            warnings.push(WarningKind::SolarOnly, solar.at, "Solar data alone", expected);
            Spectrum::Solar
        }
        (None, None) => return Err(no_data(layer, &data)),
    };
    let mut blocks: Vec<Block<'e, 't>> = Vec::new();
    for data in data.iter().filter(|data| data.spectrum == spectrum) {
        for element in data.element.all("WavelengthDataBlock") {
            let Some(light) = side_and_mode(element, warnings) else {
                continue;
            };
            let block = Block { light, element };
            match blocks.iter_mut().find(|known| known.light == light) {
                Some(known) => {
                    let found = format!("another {} {}", light.mode.name(), light.side.name());
                    let expected = "each direction once (the last one is read)";
                    warnings.push(WarningKind::RepeatedBlock, element.at, found, expected);
                    *known = block;
                }
                None => blocks.push(block),
            }
        }
    }
    if blocks.is_empty() { Err(no_data(layer, &data)) } else { Ok(blocks) }
}

/// The data of the system, or of the first layer that has any.
fn data_of_one_layer<'e, 't>(
    layer: &'e Element<'t>,
    warnings: &mut Warnings,
) -> Vec<&'e Element<'t>> {
    let number =
        |data: &&'e Element<'t>| data.child("LayerNumber").map_or("", |number| number.text());
    let is_system = |data: &&'e Element<'t>| number(data).eq_ignore_ascii_case("System");
    let mut data: Vec<&'e Element<'t>> = layer.all("WavelengthData").collect();
    let Some(read) = data.iter().find(|data| is_system(data)).or(data.first()).map(number) else {
        return data;
    };
    let is_read = |data: &&'e Element<'t>| number(data).eq_ignore_ascii_case(read);
    if let Some(other) = data.iter().find(|data| !is_read(data)) {
        let found = format!("LayerNumber {}", quoted(number(other)));
        let expected = format!("{} alone (the data of other layers are left out)", quoted(read));
        warnings.push(WarningKind::LayersLeftOut, other.at, found, expected);
    }
    data.retain(is_read);
    data
}

/// Tells where light that arrives on a side can pass, but no reflection is known. An opaque sample
/// measured from one side lacks nothing.
pub(super) fn warn_of_missing_reflection(blocks: &[Block<'_, '_>], warnings: &mut Warnings) {
    let passes = |block: &&Block<'_, '_>| block.light.mode == ScatteringMode::Transmission;
    let Some(passing) = blocks.iter().find(passes) else {
        return;
    };
    for side in Side::ALL {
        let reflected = SideAndMode { side, mode: ScatteringMode::Reflection };
        if blocks.iter().all(|block| block.light != reflected) {
            let found = format!("no Reflection {}", side.name());
            let expected = "the reflection of both sides (nothing is reflected)";
            warnings.push(WarningKind::MissingReflection, passing.element.at, found, expected);
        }
    }
}

/// `Transmission Front` and the like; others are left out.
fn side_and_mode(element: &Element<'_>, warnings: &mut Warnings) -> Option<SideAndMode> {
    let direction = element.child("WavelengthDataDirection");
    let text = direction.map_or("", |direction| direction.text());
    let mut words = text.split_whitespace();
    let mode = words.next().and_then(ScatteringMode::from_word);
    let side = words.next().and_then(Side::from_word);
    let known = side.zip(mode).filter(|_| words.next().is_none());
    if known.is_none() {
        let expected = "Transmission or Reflection, Front or Back (left out)";
        warnings.push(WarningKind::UnknownDirection, element.at, quoted(text), expected);
    }
    known.map(|(side, mode)| SideAndMode { side, mode })
}

fn no_data(layer: &Element<'_>, data: &[SpectralData<'_, '_>]) -> ParseError {
    let expected = "WavelengthData with Wavelength Visible and a WavelengthDataBlock";
    match data.first() {
        Some(SpectralData { element: first, .. }) => {
            let word = first.child("Wavelength").map_or("", |wavelength| wavelength.text());
            let found = format!("data for {} without a usable block", quoted(word));
            ParseError::new(first.at, found, expected)
        }
        None => ParseError::new(layer.at, "no element WavelengthData", expected),
    }
}
