//! What a reader has to say: errors that stop it, and oddities that it lived with.

use crate::Photometry;
use std::fmt;

/// A file that was read, with what was odd about it.
#[derive(Clone, Debug)]
pub struct Read {
    /// The luminaire.
    pub photometry: Photometry,
    /// Deviations from the standard that were tolerated; each rule at most once, at its first
    /// place.
    pub warnings: Vec<Warning>,
}

/// Why a file cannot be read, and where. Shown as `line:column: found ...; expected ...`,
/// for callers to put the file's name in front.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{line}:{column}: {}", self.message())]
pub struct ReadError {
    line: usize,
    column: usize,
    found: String,
    expected: String,
}

/// A tolerated deviation, and where it is. Shown as `line:column: found ...; expected ...`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    deviation: Deviation,
    position: Position,
    count: usize,
    found: String,
    expected: String,
}

/// A rule by which a reader tolerates what the standard does not allow, or a defect of a surface's table that it states.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Deviation {
    /// The text is not ASCII or UTF-8. UTF-16 is read by its byte order mark, anything else as
    /// Latin-1.
    Encoding,
    /// A byte order mark stands before the first line. It is skipped.
    ByteOrderMark,
    /// Empty lines stand before the identifying line. They are skipped.
    LeadingBlankLine,
    /// The identifying line has blanks or spelling of its own. The edition is taken from its
    /// number.
    IdentifyingLine,
    /// The identifying line names no known edition. The file is read as LM-63-2002. TM-33: the root
    /// element is none of the standard's. The file is read as ATLA S001 if the root is
    /// `LuminaireOpticalData`, else as TM-33-23.
    UnknownStandard,
    /// A header line has no keyword, in an edition that asks for one. It is kept as a label.
    LabelWithoutKeyword,
    /// The `TILT=` line is in small letters or has blanks inside. It is read all the same.
    TiltSpelling,
    /// The tilt angles do not run from 0 to 90 or 180 degrees. Outside them the factor of the
    /// nearest one holds.
    TiltFactors,
    /// `TILT=` names a file. Until it is read ([`read_tilt`](crate::read_tilt),
    /// [`Photometry::with_tilt`]) the factor is 1.
    TiltFile,
    /// Semicolons separate numbers. They count as blanks.
    Semicolon,
    /// A record starts on the line where the one before it ends. Line ends inside the numbers have
    /// no meaning.
    RecordStart,
    /// A count is written with a decimal point. It is read as the integer it is.
    CountWithPoint,
    /// The lumens of a lamp are negative, but not -1. The photometry counts as absolute.
    NegativeLumens,
    /// The reserved field behind the ballast factor is zero. It counts as 1.
    ZeroBallastLampFactor,
    /// The reserved field behind the ballast factor is not 1, in an edition where it must be. It has
    /// no meaning there and is not applied.
    BallastLampFactor,
    /// The vertical angles do not start at 0 or 90 or do not end at 90 or 180; those of types A and B
    /// do not start at -90 or 0 or do not end at 90. Outside them the intensity is zero.
    VerticalRange,
    /// Types A and B: the vertical angles start at 0. The half below mirrors the half above.
    VerticalMirror,
    /// Types A and B: the horizontal angles do not start at -90 or 0 or do not end at 90. Outside them
    /// the intensity is zero.
    HorizontalRange,
    /// The only horizontal plane is not at 0. The distribution is rotationally symmetric all the
    /// same.
    SinglePlane,
    /// The horizontal planes span a quarter, half or full turn from an unusual first plane. The
    /// symmetry is that of the span.
    FirstPlane,
    /// The closing plane at 360 is missing. It is taken to equal the first one.
    MissingClosingPlane,
    /// The planes at 0 and at 360 differ. Both are kept: the intensity jumps there.
    ClosingPlaneDiffers,
    /// Candela values are negative. They count as zero.
    NegativeCandela,
    /// Text follows the last candela value, other than the word END. It is ignored.
    TrailingText,
    /// All candela values are zero: the luminaire gives no light.
    NoLight,
    /// The integrated flux differs from that of the lamps (with the ballast factor) by more than 1
    /// %. Below it, this is the normal loss of a luminaire; the candela values count. In EULUMDAT
    /// it is compared with the lamps' flux times the light output ratio, in TM-33 with the luminous
    /// flux of each emitter where that is given.
    FluxDiffers,
    /// The signs of the luminous dimensions stand for a shape in another edition only. It is read as
    /// that shape.
    OpeningOfOtherEdition,
    /// The signs of the luminous dimensions stand for no shape. It is read as a point.
    UnknownOpening,
    /// EULUMDAT: numbers are written with a decimal comma. It counts as a point.
    DecimalComma,
    /// EULUMDAT: the line of a number that no intensity depends on is empty. It counts as zero.
    /// TM-33: the element of a number is empty. It counts as missing.
    EmptyNumber,
    /// EULUMDAT: a distance between planes or angles is not that of the angles listed. The listed
    /// angles count.
    AngleDistance,
    /// EULUMDAT: a single plane is said to have no symmetry. It is read as rotationally symmetric.
    SinglePlaneWithoutSymmetry,
    /// EULUMDAT: the planes listed without symmetry include the closing one at 360. It is kept.
    ClosingPlaneGiven,
    /// EULUMDAT: the planes listed without symmetry leave a gap much wider than those between them. It
    /// is filled by interpolation.
    PlanesMissing,
    /// EULUMDAT: there are several sets of lamps. The first one is taken.
    SeveralLampSets,
    /// EULUMDAT and TM-33: the number of lamps is zero. It counts as one.
    ZeroLampCount,
    /// EULUMDAT: the conversion factor of the intensities is zero or empty. It counts as 1.
    ZeroConversionFactor,
    /// EULUMDAT: the light output ratio is zero or empty. The flux is not compared with it.
    ZeroLightOutputRatio,
    /// EULUMDAT: the luminaire was tilted while it was measured. It is taken in the position it
    /// was measured in: the tilt is kept as a fact and turns nothing.
    MeasurementTilt,
    /// TM-33: an element that the standard requires, and that no intensity depends on, is missing or
    /// empty. The file is read without it.
    MissingElement,
    /// TM-33: an element or attribute has the name that another writer uses, such as
    /// `IntensityData` with `horz` and `vert` for `IntData` with `h` and `v`. It is read as the one
    /// that is meant.
    ForeignElement,
    /// TM-33: a word of a list is spelt with blanks, small letters or without its prefix, such as
    /// `Symm _ Full` or `C`. It is read as the word that is meant.
    WordSpelling,
    /// TM-33: the symmetry is not that of the planes. The planes count.
    SymmetryDiffers,
    /// TM-33: a number of intensities or angles is not that of those given. Those given count.
    CountDiffers,
    /// TM-33: there are several emitters. Their intensities are added, as if they stood in one
    /// place.
    SeveralEmitters,
    /// TM-33: an emitter beside others has no luminous intensities. It is left out.
    EmitterWithoutLight,
    /// TM-33: a ballast factor other than 1 stands with absolute photometry. It is not applied: the
    /// intensities were measured with the ballast.
    AbsoluteBallastFactor,
    /// TM-33: the luminous opening is an element `LuminousOpening` of the luminaire, which the
    /// standard has not. It is read in millimetres, as its writers mean it.
    OpeningInMillimetres,
    /// WINDOW: text stands before the XML, such as the messages of a program. It is left out.
    Foreword,
    /// WINDOW: there are several optical layers. The first is read.
    SeveralLayers,
    /// WINDOW: the thickness has no known unit, or is no number from 0 on. It is left out: nothing depends on it.
    UnknownThickness,
    /// WINDOW: there are data of the solar spectrum alone. They are read as if they were visible.
    SolarOnly,
    /// WINDOW: there are data of the colour besides the luminance. They are left out.
    ColourLeftOut,
    /// WINDOW: a block is for none of the four directions. It is left out.
    UnknownDirection,
    /// WINDOW: a direction is given twice. The last one is read.
    RepeatedBlock,
    /// Surfaces: values follow after the last one. They are left out.
    TrailingValues,
    /// Surfaces: values are negative. They count as zero.
    NegativeScattering,
    /// Surfaces: transmission is given from one side only. That from the other side is taken from it by
    /// reciprocity.
    ByReciprocity,
    /// Surfaces: transmission is given from one side only, in a table that is not turned round.
    /// Nothing passes from the other side.
    OneWayTransmission,
    /// Surfaces: values are given in angles that samples cannot be drawn in. They are resampled; the warning says how
    /// far that is off.
    Resampled,
    /// MERL: values are negative, which means that nothing was measured. Their neighbours stand for them.
    MissingValues,
    /// ASTM E1392: polar angles or azimuths are too large for radians. All angles are read as degrees.
    AnglesInDegrees,
    /// ASTM E1392: a pair of directions is given several times, with other values. The first one is read.
    RepeatedDirection,
    /// ASTM E1392: a colour is more saturated than BT.709 can be. It is made less so, its luminance is kept.
    OutOfGamut,
    /// Surfaces: measured azimuths leave a gap wider than 90 degrees, exits of ASTM E1392 one wider than 45. Values are interpolated across it.
    AzimuthGap,
    /// Surfaces: light was measured from one polar angle alone. What comes from elsewhere is scattered like it.
    OneIncidence,
    /// DDR: the first angle from the specular direction is not 0. Up to there f is as at that angle.
    SpecularMissing,
    /// DDR and DDT: the name does not tell whether it is reflection or transmission. It is read as reflection.
    UnknownWay,
    /// WINDOW: a side that light passes has no reflection. It reflects nothing.
    MissingReflection,
    /// WINDOW: data of single layers stand beside those of the system. They are left out.
    LayersLeftOut,
    /// WINDOW: an angular basis ends before the horizon. Light beyond is neither taken nor sent.
    BasisEndsEarly,
    /// Surfaces: more light is scattered than arrives. The table is used as it is.
    EnergyNotConserved,
    /// Surfaces: exchanging both directions changes the value by more than 1 % in the mean. The table is used
    /// as it is.
    NotReciprocal,
}

/// A place in a text, line and column counted from 1, columns in characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Position {
    pub(crate) line: usize,
    pub(crate) column: usize,
}

/// Collects warnings: one for each rule, counting its further cases.
#[derive(Debug, Default)]
pub(crate) struct Warnings(Vec<Warning>);

impl ReadError {
    pub(crate) fn new(at: Position, found: impl fmt::Display, expected: impl fmt::Display) -> Self {
        Self { line: at.line, column: at.column, found: shown(&found), expected: shown(&expected) }
    }

    /// The same error, where something else was expected.
    pub(crate) fn expecting(self, expected: impl fmt::Display) -> Self {
        Self { expected: expected.to_string(), ..self }
    }

    /// The line, counted from 1.
    pub fn line(&self) -> usize {
        self.line
    }

    /// The column in characters, counted from 1.
    pub fn column(&self) -> usize {
        self.column
    }

    /// What stands there.
    pub fn found(&self) -> &str {
        &self.found
    }

    /// What should stand there, or what would mend it.
    pub fn expected(&self) -> &str {
        &self.expected
    }

    /// What is wrong, without the place.
    pub fn message(&self) -> String {
        format!("found {}; expected {}", self.found, self.expected)
    }
}

impl Warning {
    /// The rule that was applied.
    pub fn deviation(&self) -> Deviation {
        self.deviation
    }

    /// The line of the first case, counted from 1.
    pub fn line(&self) -> usize {
        self.position.line
    }

    /// The column of the first case in characters, counted from 1.
    pub fn column(&self) -> usize {
        self.position.column
    }

    /// How many times the rule was applied.
    pub fn count(&self) -> usize {
        self.count
    }

    /// What stands at the first place.
    pub fn found(&self) -> &str {
        &self.found
    }

    /// What was expected, and what was made of it.
    pub fn expected(&self) -> &str {
        &self.expected
    }

    /// What was found and expected, and how often, without the place.
    pub fn message(&self) -> String {
        let Self { count, found, expected, .. } = self;
        let more = if *count > 1 { format!(" (and {} more)", count - 1) } else { String::new() };
        format!("found {found}; expected {expected}{more}")
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}", self.line(), self.column(), self.message())
    }
}

impl Warnings {
    pub(crate) fn push(
        &mut self,
        deviation: Deviation,
        position: Position,
        found: impl fmt::Display,
        expected: impl fmt::Display,
    ) {
        match self.0.iter_mut().find(|warning| warning.deviation == deviation) {
            Some(warning) => warning.count += 1,
            None => self.0.push(Warning {
                deviation,
                position,
                count: 1,
                found: shown(&found),
                expected: shown(&expected),
            }),
        }
    }

    /// Takes over the warnings of one rule, and drops the others.
    pub(crate) fn keep(&mut self, others: Self, deviation: Deviation) {
        self.0.extend(others.0.into_iter().filter(|warning| warning.deviation == deviation));
    }

    pub(crate) fn into_vec(self) -> Vec<Warning> {
        self.0
    }
}

/// The text of a part of a message. Numbers such as 1e300 are written with all their digits: cut.
fn shown(part: &impl fmt::Display) -> String {
    const LONGEST: usize = 200;
    let mut text = part.to_string();
    if let Some((end, _)) = text.char_indices().nth(LONGEST) {
        text.truncate(end);
        text.push_str("...");
    }
    text
}

/// A piece of the file in quotation marks, cut to a length that fits a message.
pub(crate) fn quoted(text: &str) -> String {
    format!("\"{}\"", shortened(text, 40))
}

/// A text without control characters, cut after so many characters.
pub(crate) fn shortened(text: &str, longest: usize) -> String {
    let mut shown: String = text.chars().take(longest).flat_map(char::escape_debug).collect();
    if text.chars().nth(longest).is_some() {
        shown.push_str("...");
    }
    shown
}
