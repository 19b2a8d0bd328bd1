//! The deviations from the formats that the readers of measured surfaces tolerate, and the defects
//! of tables that they state.

use quasilux_text::TextWarning;

/// A tolerated deviation of a file or a defect of its table, with its position.
pub type Warning = quasilux_text::Warning<WarningKind>;

/// Collects the warnings of a reader.
pub(crate) type Warnings = quasilux_text::Warnings<WarningKind>;

/// A rule by which a reader tolerates what a format does not allow, or a defect of a table that
/// is used as it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum WarningKind {
    /// The text is not ASCII or UTF-8. UTF-16 is read by its byte order mark, anything else as
    /// Latin-1.
    Encoding,
    /// A byte order mark stands before the first line. It is skipped.
    ByteOrderMark,
    /// WINDOW: text stands before the XML, such as the messages of a program. It is left out.
    Foreword,
    /// WINDOW: there are several optical layers. The first is read.
    SeveralLayers,
    /// WINDOW: the thickness has no known unit, or is no number from 0 on. It is left out: nothing
    /// depends on it.
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
    /// Surfaces: transmission is given from one side only. That from the other side is taken from
    /// it by reciprocity.
    ByReciprocity,
    /// Surfaces: transmission is given from one side only, in a table that is not turned round.
    /// Nothing passes from the other side.
    OneWayTransmission,
    /// Surfaces: values are given in angles that samples cannot be drawn in. They are resampled;
    /// the warning says how far that is off.
    Resampled,
    /// MERL: values are negative, which means that nothing was measured. Their neighbours stand for
    /// them.
    MissingValues,
    /// ASTM E1392: polar angles or azimuths are too large for radians. All angles are read as
    /// degrees.
    AnglesInDegrees,
    /// ASTM E1392: a pair of directions is given several times, with other values. The first one is
    /// read.
    RepeatedDirection,
    /// ASTM E1392: a colour is more saturated than BT.709 can be. It is made less so, its luminance
    /// is kept.
    OutOfGamut,
    /// Surfaces: measured azimuths leave a gap wider than 90 degrees, exits of ASTM E1392 one wider
    /// than 45. Values are interpolated across it.
    AzimuthGap,
    /// Surfaces: light was measured from one polar angle alone. What comes from elsewhere is
    /// scattered like it.
    OneIncidence,
    /// DDR: the first angle from the specular direction is not 0. Up to there f is as at that
    /// angle.
    SpecularMissing,
    /// DDR and DDT: the name does not tell whether it is reflection or transmission. It is read as
    /// reflection.
    UnknownScatteringMode,
    /// WINDOW: a side that light passes has no reflection. It reflects nothing.
    MissingReflection,
    /// WINDOW: data of single layers stand beside those of the system. They are left out.
    LayersLeftOut,
    /// WINDOW: an angular basis ends before the horizon. Light beyond is neither taken nor sent.
    BasisEndsEarly,
    /// IGSDB: transmittance and reflectance of a wavelength add up to more than 1. They are scaled
    /// down.
    SharesExceedOne,
    /// IGSDB: the spectrum does not reach from 380 to 780 nm. Beyond, values are as at its ends.
    ShortSpectrum,
    /// IGSDB: transmittances of both sides differ, which no sheet allows. Their mean is read.
    TransmittancesDiffer,
    /// IGSDB: values are given for several incidences. Those at normal incidence are read.
    OtherIncidences,
    /// IGSDB: a sheet that is called uncoated does not look so. Its angles are read as those of a
    /// coated one.
    UnlikeUncoated,
    /// IGSDB: stated visible values differ from those of the spectrum. The spectrum counts.
    StatedOtherwise,
    /// Surfaces: more light is scattered than arrives. The table is used as it is.
    EnergyNotConserved,
    /// Surfaces: exchanging both directions changes the value by more than 1 % in the mean. The
    /// table is used as it is.
    NotReciprocal,
}

impl From<TextWarning> for WarningKind {
    fn from(kind: TextWarning) -> Self {
        match kind {
            TextWarning::ByteOrderMark => Self::ByteOrderMark,
            _ => Self::Encoding,
        }
    }
}
