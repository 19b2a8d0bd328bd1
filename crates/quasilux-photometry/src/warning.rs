//! The deviations from the standards that the readers of luminaire files tolerate.

use quasilux_text::TextWarning;

/// A tolerated deviation of a luminaire file, with its position.
pub type Warning = quasilux_text::Warning<WarningKind>;

/// Collects the warnings of a reader.
pub(crate) type Warnings = quasilux_text::Warnings<WarningKind>;

/// A rule by which a reader tolerates what the standard does not allow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[non_exhaustive]
pub enum WarningKind {
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
    /// [`Photometry::with_tilt`](crate::Photometry::with_tilt)) the factor is 1.
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
    /// The reserved field behind the ballast factor is not 1, in an edition where it must be. It
    /// has no meaning there and is not applied.
    BallastLampFactor,
    /// The vertical angles do not start at 0 or 90 or do not end at 90 or 180; those of types A and
    /// B do not start at -90 or 0 or do not end at 90. Outside them the intensity is zero.
    VerticalRange,
    /// Types A and B: the vertical angles start at 0. The half below mirrors the half above.
    VerticalMirror,
    /// Types A and B: the horizontal angles do not start at -90 or 0 or do not end at 90. Outside
    /// them the intensity is zero.
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
    /// The signs of the luminous dimensions stand for a shape in another edition only. It is read
    /// as that shape.
    OpeningOfOtherEdition,
    /// The signs of the luminous dimensions stand for no shape. It is read as a point.
    UnknownOpening,
    /// Numbers are written with a decimal comma. It counts as a point; in LM-63, where commas
    /// separate numbers, in files that make no luminaire with separators.
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
    /// EULUMDAT: the planes listed without symmetry leave a gap much wider than those between them.
    /// It is filled by interpolation.
    PlanesMissing,
    /// EULUMDAT: there are several sets of lamps. The first one is taken.
    SeveralLampSets,
    /// EULUMDAT and TM-33: the number of lamps is zero. It counts as one.
    ZeroLampCount,
    /// EULUMDAT: the conversion factor of the intensities is zero or empty. It counts as 1.
    ZeroConversionFactor,
    /// EULUMDAT: the light output ratio is zero or empty. The flux is not compared with it.
    ZeroLightOutputRatio,
    /// EULUMDAT: the share of the flux below the horizon is not that of the intensities. These
    /// count; a share of 0 is taken for one that is not given.
    DownwardFluxDiffers,
    /// EULUMDAT: the luminaire was tilted while it was measured. It is taken in the position it
    /// was measured in: the tilt is kept as a fact and turns nothing.
    MeasurementTilt,
    /// TM-33 and GLDF: an element that the standard requires, and that no intensity depends on, is
    /// missing or empty. The file is read without it.
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
    /// GLDF: an EULUMDAT file in the container has lamps of 0 lm. The container's flux counts.
    ZeroLampFlux,
    /// GLDF: the rated flux of the light source is not that of the photometric file. The
    /// container's counts.
    ContainerFlux,
    /// GLDF: the opening of a simple geometry is not that of the photometric file, or cannot be
    /// given to it. The container's counts where it can be given.
    ContainerOpening,
    /// GLDF: the descriptive figures of a photometry contradict its intensities. These count.
    DescriptionDiffers,
    /// GLDF: an emitter shines in an emergency only. It stays dark unless it was asked for.
    EmergencyEmitter,
    /// GLDF: the photometry is turned in the luminaire. Who reads the container applies the turn.
    EmitterTurned,
    /// GLDF: several places of a 3D model shine with the emitter. The light is that of one.
    ModelPlaces,
    /// GLDF: the light source has several channels. All of them shine, unless one was asked for;
    /// those of 0 lm stay dark.
    SeveralChannels,
    /// GLDF: the variant names no emitter. One of the product is taken.
    VariantWithoutEmitter,
}

impl From<TextWarning> for WarningKind {
    fn from(kind: TextWarning) -> Self {
        match kind {
            TextWarning::ByteOrderMark => Self::ByteOrderMark,
            TextWarning::DecimalComma => Self::DecimalComma,
            TextWarning::CountWithPoint => Self::CountWithPoint,
            _ => Self::Encoding,
        }
    }
}
