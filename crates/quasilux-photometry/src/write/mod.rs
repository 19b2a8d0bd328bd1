//! What writers share: their outcome, and decimals that read back.

mod decimal;
mod turn;

use crate::PhotometricType;
pub(crate) use decimal::{before, degrees, number};
use std::fmt;
pub(crate) use turn::{Half, aligned};

/// A file that was written, with what the format could not hold.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Encoded {
    /// The file. Lines end with carriage return and line feed, as both formats ask for.
    pub text: String,
    /// What was changed, left out or added on the way.
    pub notes: Vec<EncodingNote>,
}

/// What a writer changed, left out or added, because the format asks for it.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum EncodingNote {
    /// The table has poles of its own, or is a sector of type C. It was resampled to the whole
    /// sphere in type C, on the coarsest of three grids that keeps the flux to 0.1 %. Beams
    /// narrower than the steps of the finest fall between them, or fill them: compare the fluxes.
    Resampled {
        /// The type of the table.
        photometric_type: PhotometricType,
        /// Between planes.
        plane_step_deg: f64,
        /// Between angles gamma.
        angle_step_deg: f64,
        /// Of the table.
        flux_lm: f64,
        /// Of what was written.
        written_flux_lm: f64,
    },
    /// The axes of symmetry are not those of the luminaire: all planes around were written.
    Unfolded,
    /// No plane stood at C0. One was added by the table's own interpolation, which changes no
    /// intensity.
    FirstPlaneAdded,
    /// The planes at 0 and 360 differ, and the format has one place for both: that of 0 was kept.
    ClosingPlaneDropped {
        /// The greatest difference.
        difference_cd: f64,
    },
    /// The polar angles do not fill a hemisphere or the sphere, as LM-63 asks for. They were
    /// written as they are.
    PolarRange,
    /// An angle is so near to a multiple of 90 degrees that readers take it for that multiple.
    AngleNearAxis,
    /// A keyword that the edition requires was missing. It was added, without a fact.
    KeywordAdded(&'static str),
    /// A label without a keyword became `[OTHER]`, as the edition has no labels.
    LabelAsOther,
    /// A text longer than a line was continued by `[MORE]`.
    TextContinued,
    /// A text was cut to the length of its field.
    TextCut {
        /// The field of EULUMDAT.
        field: &'static str,
        /// The characters it has room for.
        length: usize,
    },
    /// EULUMDAT has no keywords: those that are no field of it were left out.
    KeywordsLeftOut(usize),
    /// EULUMDAT has no tilt block: it was left out.
    TiltLeftOut,
    /// LM-63-2019 has no tilt files: the line was written all the same.
    TiltFile,
    /// EULUMDAT has no ballast factor: it went into the intensities.
    BallastFactorIncluded,
    /// EULUMDAT knows boxes and disks: the luminous opening was written as the box around it.
    OpeningAsBox,
    /// The text has characters outside ASCII. They were written in UTF-8.
    NotAscii,
}

impl fmt::Display for EncodingNote {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Resampled {
                photometric_type,
                plane_step_deg,
                angle_step_deg,
                flux_lm,
                written_flux_lm,
            } => write!(
                f,
                "photometric type {photometric_type:?} was resampled to all of type C, planes in \
                 steps of {plane_step_deg} degrees, angles of {angle_step_deg}: {flux_lm:.5e} lm \
                 became {written_flux_lm:.5e} lm"
            ),
            Self::Unfolded => f.write_str(
                "the axes of symmetry are not those of the luminaire: all planes were written",
            ),
            Self::FirstPlaneAdded => {
                f.write_str("a plane at C0 was added by interpolation, no intensity changes")
            }
            Self::ClosingPlaneDropped { difference_cd } => write!(
                f,
                "the plane at 360 differs from that at 0 by up to {difference_cd} cd: left out"
            ),
            Self::PolarRange => f.write_str(
                "the vertical angles do not span 0 to 90, 90 to 180 or 0 to 180 degrees",
            ),
            Self::AngleNearAxis => f.write_str(
                "an angle within 0.001 degrees of a multiple of 90 will be read as that multiple",
            ),
            Self::KeywordAdded(name) => {
                write!(f, "the required keyword [{name}] was added without a fact")
            }
            Self::LabelAsOther => f.write_str("a label without keyword was written as [OTHER]"),
            Self::TextContinued => f.write_str("a text longer than a line was continued by [MORE]"),
            Self::TextCut { field, length } => {
                write!(f, "{field} was cut to {length} characters")
            }
            Self::KeywordsLeftOut(1) => {
                f.write_str("1 keyword that EULUMDAT has no field for was left out")
            }
            Self::KeywordsLeftOut(count) => {
                write!(f, "{count} keywords that EULUMDAT has no field for were left out")
            }
            Self::TiltLeftOut => f.write_str("the tilt factors were left out"),
            Self::TiltFile => f.write_str("LM-63-2019 knows no tilt files, the line was kept"),
            Self::BallastFactorIncluded => {
                f.write_str("the ballast factor went into the intensities")
            }
            Self::OpeningAsBox => {
                f.write_str("the luminous opening was written as the box around it")
            }
            Self::NotAscii => f.write_str("texts outside ASCII were written in UTF-8"),
        }
    }
}

/// Lines of a file, and notes.
#[derive(Debug, Default)]
pub(crate) struct Writer {
    text: String,
    notes: Vec<EncodingNote>,
}

impl Writer {
    /// Ends a line of the file.
    pub(crate) fn line(&mut self, line: &str) {
        self.text.push_str(line);
        self.text.push_str("\r\n");
    }

    /// Keeps a note, each one once.
    pub(crate) fn note(&mut self, note: EncodingNote) {
        if !self.notes.contains(&note) {
            self.notes.push(note);
        }
    }

    pub(crate) fn finish(mut self) -> Encoded {
        if !self.text.is_ascii() {
            self.note(EncodingNote::NotAscii);
        }
        Encoded { text: self.text, notes: self.notes }
    }
}
