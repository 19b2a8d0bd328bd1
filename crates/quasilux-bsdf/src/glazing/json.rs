//! The JSON of product files, as far as it is used.
//!
//! Two layouts of the database: that of its first interface (`spectral_data`), and that of its
//! second (`physical_properties`), where numbers are strings. What is not used is skipped whatever
//! it is.

use serde::Deserialize;
use serde::de::{Deserializer, Error, IgnoredAny, MapAccess, SeqAccess, Visitor};
use std::fmt;
use std::marker::PhantomData;

/// More elements than any list of a product has.
const MAX_ELEMENTS: usize = 20_000;

/// The whole file.
#[derive(Deserialize)]
pub(super) struct File {
    #[serde(default)]
    pub(super) name: Text,
    #[serde(default)]
    pub(super) product_name: Text,
    pub(super) product_description: Option<ProductDescription>,
    #[serde(default, rename = "type")]
    pub(super) kind: Text,
    #[serde(default)]
    pub(super) subtype: Text,
    #[serde(default)]
    pub(super) coated_side: Text,
    #[serde(default)]
    pub(super) coating_name: Text,
    pub(super) measured_data: Option<MeasuredData>,
    pub(super) spectral_data: Option<SpectralData>,
    pub(super) integrated_results_summary: Option<List<Summary>>,
    pub(super) physical_properties: Option<PhysicalProperties>,
}

#[derive(Deserialize)]
pub(super) struct ProductDescription {
    #[serde(default)]
    pub(super) name: Text,
}

#[derive(Deserialize)]
pub(super) struct MeasuredData {
    pub(super) is_specular: Option<bool>,
}

#[derive(Deserialize)]
pub(super) struct SpectralData {
    pub(super) spectral_data: Option<List<Sample>>,
}

/// Shares of one wavelength.
#[derive(Deserialize)]
pub(super) struct Sample {
    /// In micrometres.
    pub(super) wavelength: Number,
    #[serde(rename = "T")]
    pub(super) transmitted: Number,
    #[serde(rename = "Rf")]
    pub(super) front: Number,
    #[serde(rename = "Rb")]
    pub(super) back: Number,
}

/// Visible values at normal incidence.
#[derive(Deserialize)]
pub(super) struct Summary {
    pub(super) tfvis: Option<Number>,
    pub(super) rfvis: Option<Number>,
    pub(super) rbvis: Option<Number>,
}

#[derive(Deserialize)]
pub(super) struct PhysicalProperties {
    pub(super) is_specular: Option<bool>,
    pub(super) optical_properties: Option<OpticalProperties>,
}

#[derive(Deserialize)]
pub(super) struct OpticalProperties {
    pub(super) optical_data: Option<OpticalData>,
}

#[derive(Deserialize)]
pub(super) struct OpticalData {
    pub(super) angle_blocks: Option<List<AngleBlock>>,
}

#[derive(Deserialize)]
pub(super) struct AngleBlock {
    /// In degrees.
    pub(super) incidence_angle: Number,
    pub(super) wavelength_data: List<BlockSample>,
}

#[derive(Deserialize)]
pub(super) struct BlockSample {
    /// In micrometres.
    pub(super) w: Number,
    pub(super) specular: Specular,
    pub(super) diffuse: Option<IgnoredAny>,
}

#[derive(Deserialize)]
pub(super) struct Specular {
    pub(super) tf: Number,
    pub(super) tb: Number,
    pub(super) rf: Number,
    pub(super) rb: Number,
}

/// A string; nothing where something else stands.
#[derive(Default)]
pub(super) struct Text(pub(super) Option<String>);

/// A finite number, also in quotation marks.
#[derive(Clone, Copy)]
pub(super) struct Number(pub(super) f64);

/// A list of bounded length.
pub(super) struct List<T>(pub(super) Vec<T>);

impl<'de> Deserialize<'de> for Text {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(TextVisitor)
    }
}

struct TextVisitor;

impl<'de> Visitor<'de> for TextVisitor {
    type Value = Text;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a text")
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Text, E> {
        Ok(Text(Some(text.to_owned())))
    }

    fn visit_unit<E: Error>(self) -> Result<Text, E> {
        Ok(Text(None))
    }

    fn visit_bool<E: Error>(self, _: bool) -> Result<Text, E> {
        Ok(Text(None))
    }

    fn visit_f64<E: Error>(self, _: f64) -> Result<Text, E> {
        Ok(Text(None))
    }

    fn visit_u64<E: Error>(self, _: u64) -> Result<Text, E> {
        Ok(Text(None))
    }

    fn visit_i64<E: Error>(self, _: i64) -> Result<Text, E> {
        Ok(Text(None))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Text, A::Error> {
        while list.next_element::<IgnoredAny>()?.is_some() {}
        Ok(Text(None))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Text, A::Error> {
        while map.next_entry::<IgnoredAny, IgnoredAny>()?.is_some() {}
        Ok(Text(None))
    }
}

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(NumberVisitor)
    }
}

struct NumberVisitor;

impl Visitor<'_> for NumberVisitor {
    type Value = Number;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a finite number")
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Number, E> {
        let number = text.trim().parse().ok().filter(|number: &f64| number.is_finite());
        let quoted = || E::invalid_value(serde::de::Unexpected::Str(text), &self);
        number.map(Number).ok_or_else(quoted)
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<Number, E> {
        Ok(Number(number))
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<Number, E> {
        Ok(Number(number as f64))
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<Number, E> {
        Ok(Number(number as f64))
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for List<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_seq(ListVisitor(PhantomData))
    }
}

struct ListVisitor<T>(PhantomData<T>);

impl<'de, T: Deserialize<'de>> Visitor<'de> for ListVisitor<T> {
    type Value = List<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a list")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<List<T>, A::Error> {
        let mut elements = Vec::new();
        while let Some(element) = list.next_element()? {
            if elements.len() == MAX_ELEMENTS {
                let message = format!("a longer list, expected at most {MAX_ELEMENTS} elements");
                return Err(A::Error::custom(message));
            }
            elements.push(element);
        }
        Ok(List(elements))
    }
}
