//! What a photometric file says about its luminaire beside the intensities.

use crate::standard::Standard;
use quasilux_sampling::ParseNameError;
use std::fmt;
use std::str::FromStr;

/// The web of angles that a luminaire was measured in: where its poles are (see
/// [`Web`](crate::Web)).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PhotometricType {
    /// Poles along the vertical axis, angles (C, gamma): indoor and road lighting.
    C,
    /// Poles along the horizontal axis across C0, angles (H, V): floodlights.
    B,
    /// Poles along the vertical axis, angles (H, V) from a level beam along C0: vehicle lamps.
    A,
}

/// One `[NAME] value` line of a header, with its `[MORE]` lines joined by line feeds.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Keyword {
    /// The name between the brackets, in capitals; empty for a label line without a keyword.
    pub name: String,
    /// The text behind the brackets, trimmed.
    pub value: String,
    /// The line of the file, counted from 1.
    pub line: usize,
}

/// The luminous opening as the file gives it, in metres. The *signs* carry the shape (a negative
/// width is a diameter, and so on;
/// [`LuminousShape::from_opening`](crate::LuminousShape::from_opening)): they are kept.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LuminousOpening {
    /// Across the C90-C270 plane, along the local y axis.
    pub width_m: f64,
    /// Along the C0-C180 plane, along the local x axis.
    pub length_m: f64,
    /// Along the local z axis.
    pub height_m: f64,
}

/// What the file says about the lamp's output in tilted luminaires.
#[derive(Clone, Debug, PartialEq)]
pub enum Tilt {
    /// `TILT=NONE`: the output does not depend on the tilt.
    None,
    /// `TILT=INCLUDE`: factors by tilt angle, in the file itself.
    Include {
        /// Lamp-to-luminaire geometry, 1 to 3: see [`Tilt::factor`].
        lamp_geometry: u8,
        /// Tilt angles in radians.
        angles_rad: Vec<f64>,
        /// Output relative to the untilted lamp, one for each angle.
        factors: Vec<f64>,
    },
    /// `TILT=NAME`: factors in another file, which has not been read.
    File(String),
}

/// The facts of a file's header that the intensities do not show.
#[derive(Clone, Debug, PartialEq)]
pub struct LuminaireFacts {
    /// The format, and the edition that the file claims.
    pub standard: Standard,
    /// The web of angles that the file's intensities are given in.
    pub photometric_type: PhotometricType,
    /// Keywords and labels in the order of the file; the texts of EULUMDAT and TM-33
    /// files stand under the keywords of LM-63 that mean the same.
    pub keywords: Vec<Keyword>,
    /// The tilt block.
    pub tilt: Tilt,
    /// Number of lamps; in TM-33 of all emitters together.
    pub lamp_count: f64,
    /// Luminous flux of one lamp; `None` for absolute photometry.
    pub lumens_per_lamp: Option<f64>,
    /// The ballast factor; 1 in EULUMDAT, which has none; of the first emitter in TM-33.
    pub ballast_factor: f64,
    /// The field behind the ballast factor, as written: ballast-lamp photometric factor (1986,
    /// 1991), reserved (1995, 2002), or file generation type (2019); 1 in EULUMDAT and
    /// TM-33.
    pub ballast_lamp_field: f64,
    /// Electrical input power in watts, as written.
    pub input_watts: f64,
    /// Product of all factors that the file's candela values were multiplied by; of the first
    /// emitter in TM-33.
    pub candela_factor: f64,
    /// The luminous opening.
    pub opening: LuminousOpening,
    /// Flux of the luminaire over that of its lamps, as an EULUMDAT file claims it.
    pub light_output_ratio: Option<f64>,
    /// Tilt of the luminaire while it was measured, as an EULUMDAT file gives it.
    pub measurement_tilt_rad: f64,
    /// What only an EULUMDAT file says; `None` for other formats.
    pub eulumdat: Option<EulumdatFacts>,
}

/// Fields of an EULUMDAT file that other formats have not got, kept for writing it again.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EulumdatFacts {
    /// `Ityp` (field 2): 1 point source with rotational symmetry, 2 linear luminaire, 3 any other;
    /// as written.
    pub type_indicator: String,
    /// Length or diameter, width (0: round) and height of the luminaire itself (fields 13 to 15).
    pub housing_m: [f64; 3],
    /// Heights of the luminous area at C0, C90, C180 and C270 (fields 18 to 21).
    pub opening_heights_m: [f64; 4],
    /// Factor of the intensities (field 24).
    pub conversion_factor: f64,
    /// Flux of all lamps of the first set (field 26c): that of the luminaire, in absolute
    /// photometry.
    pub lamps_flux_lm: f64,
    /// The sets of lamps behind the first one, field by field (26a to 26f), as written.
    pub further_lamp_sets: Vec<[String; 6]>,
}

impl PhotometricType {
    /// All types.
    pub const ALL: [Self; 3] = [Self::A, Self::B, Self::C];

    /// `A`, `B` or `C`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::A => "A",
            Self::B => "B",
            Self::C => "C",
        }
    }
}

impl fmt::Display for PhotometricType {
    /// Its [name](Self::name).
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for PhotometricType {
    type Err = ParseNameError;

    /// The type of that [name](Self::name).
    ///
    /// # Errors
    /// [`ParseNameError`] for any other text.
    fn from_str(name: &str) -> Result<Self, ParseNameError> {
        let known = Self::ALL.into_iter().find(|kind| kind.name() == name);
        known.ok_or_else(|| ParseNameError::new("photometric type", name, "A, B, C"))
    }
}

impl LuminaireFacts {
    /// Lamp lumens times number of lamps; `None` for absolute photometry, and where either is not
    /// positive.
    pub fn rated_flux_lm(&self) -> Option<f64> {
        let rated_flux_lm = self.lumens_per_lamp? * self.lamp_count;
        (rated_flux_lm > 0.0 && rated_flux_lm.is_finite()).then_some(rated_flux_lm)
    }

    /// The same with the ballast factor: what the lamps gave in the luminaire, were nothing lost.
    pub fn lamps_flux_lm(&self) -> Option<f64> {
        self.rated_flux_lm().map(|rated_flux_lm| rated_flux_lm * self.ballast_factor)
    }

    /// The value of the first keyword of that name (in capitals, without brackets).
    pub fn keyword(&self, name: &str) -> Option<&str> {
        self.keywords.iter().find(|keyword| keyword.name == name).map(|k| k.value.as_str())
    }
}
