//! ANSI/IES LM-63 (`.ies`), editions 1986, 1991, 1995, 2002 and 2019.
//!
//! Read by [`read_ies`](crate::read_ies), written by [`write_ies`](crate::write_ies).
//!
//! # Lines and numbers
//!
//! A file is ASCII text. Lines end with carriage return and line feed; any line end is read. Up to
//! 1995 lines have at most 80 characters as far as `TILT=` and 132 behind it; in 2002 at most 256,
//! with the two that end it; in 2019 there is no limit (as the head comment of Radiance's
//! `ies2rad.c` compares the editions). Numbers are separated by blanks, a comma or line ends (2002,
//! clause 3, "Delimiter"). A record begins on a new line and goes on over as many as it needs.
//!
//! # Line by line
//!
//! Clauses are those of LM-63-2019 as public readers cite them; a dash says that none was found.
//!
//! | line | content | clause |
//! |---|---|---|
//! | 1 | `IESNA91`, `IESNA:LM-63-1995`, `IESNA:LM-63-2002` or `IES:LM-63-2019`; 1986 has no such line | - |
//! | labels | 1986: free text. Later: `[KEYWORD] text`, continued by `[MORE] text`; names with `_` in front are the user's own | - |
//! | | required: `[TEST]`, `[MANUFAC]` in 1991; `[TEST]`, `[TESTLAB]`, `[ISSUEDATE]`, `[MANUFAC]` from 2002 on | - |
//! | `TILT=` | `NONE`, `INCLUDE`, or up to 2002 the name of a file | - |
//! | with `INCLUDE` | lamp geometry: 1 vertical, 2 and 3 horizontal, at 0 and at 90 degrees | - |
//! | | number of pairs; next record the tilt angles; next record their factors | - |
//! | record 1 | number of lamps | - |
//! | | lumens of one lamp; -1 for absolute photometry | 5.5 |
//! | | candela multiplier | 5.6 |
//! | | number of vertical angles, number of horizontal angles | - |
//! | | photometric type: 1 C, 2 B, 3 A | 5.9 |
//! | | units of the dimensions: 1 feet, 2 metres | 5.10 |
//! | | width, length, height of the luminous opening; signs give its shape (table 1) | 5.11 |
//! | record 2 | ballast factor | 5.12 |
//! | | 1986, 1991: ballast-lamp photometric factor; 1995, 2002: reserved, 1; 2019: file generation type (table 2), which is no factor | 5.13 |
//! | | input watts | - |
//! | record 3 | vertical angles, ascending. Type C: 0 to 90, 90 to 180 or 0 to 180. Types A and B: -90 to 90 or 0 to 90 | 5.15 |
//! | record 4 | horizontal angles, ascending. Type C: 0 alone, or 0 to 90, 0 to 180, 0 to 360; in 1995 also 90 to 270. Types A and B: -90 to 90 or 0 to 90 | - |
//! | records 5 ... | candela values of all vertical angles, one record for each horizontal angle | - |
//!
//! # What the numbers mean
//!
//! Intensity = candela value x candela multiplier (5.6) x ballast factor (5.12), and in 1986 and
//! 1991 x ballast-lamp photometric factor. Lamp lumens scale nothing.
//!
//! One plane alone is a distribution that is the same all around. Planes from 0 to 90 are mirrored
//! into all quarters, 0 to 180 in the plane of C0 and C180, 90 to 270 in the plane of C90 and C270.
//! Width is measured along C90-C270, length along C0-C180.
//!
//! The file generation type is 1 with five decimals, in the order accredited laboratory,
//! interpolated angles, scaled lumens, simulation, undefined (2019, annex H). 1.00001 stands for
//! "Undefined", and is what the writer puts where it knows nothing.
//!
//! # What is tolerated
//!
//! | rule | what is made of it | for example |
//! |---|---|---|
//! | [`Encoding`] | UTF-8 is read as such, UTF-16 by its byte order mark, the rest as Latin-1 | `2:10: found byte 0xB0; expected ASCII or UTF-8 text (read as Latin-1)` |
//! | [`ByteOrderMark`] | skipped | `1:1: found a byte order mark; expected plain ASCII` |
//! | [`LeadingBlankLine`] | skipped | `1:1: found an empty line; expected the identifying line` |
//! | [`IdentifyingLine`] | the edition is taken from its number | `1:1: found " IESNA: LM-63-2002"; expected IESNA:LM-63-2002` |
//! | [`UnknownStandard`] | read as LM-63-2002 | `1:1: found "IESNA:LM-63-2031"; expected an edition between IESNA91 and IES:LM-63-2019 (read as LM-63-2002)` |
//! | [`LabelWithoutKeyword`] | kept as a label | `2:1: found "no keyword"; expected a keyword in brackets (kept as a label)` |
//! | [`TiltSpelling`] | read all the same | `2:1: found "Tilt = none"; expected TILT= in capitals, without blanks` |
//! | [`TiltFactors`] | outside, the nearest factor holds | `3:5: found tilt angles from 0 to 60; expected 0 to 90 or 0 to 180 degrees (...)` |
//! | [`TiltFile`] | factor 1 until [`read_tilt`](crate::read_tilt) has read it | `2:1: found a tilt file "lamp.tlt"; expected TILT=NONE or TILT=INCLUDE (...)` |
//! | [`Semicolon`] | counts as a blank | `4:2: found a semicolon; expected blanks or a comma between numbers (and 1 more)` |
//! | [`DecimalComma`] | a decimal point, in files that make no luminaire with commas as separators | `3:10: found "0,5"; expected a decimal point (read as one)` |
//! | [`RecordStart`] | line ends inside the numbers have no meaning | `3:22: found "1"; expected the ballast factor to begin on a new line` |
//! | [`CountWithPoint`] | the integer that it is | `3:8: found 2; expected the number of vertical angles without a decimal point` |
//! | [`OpeningOfOtherEdition`] | read by that edition's table ([`LuminousShape::from_opening`]) | `3:8: found a luminous width, length and height of -1, 0, 0 m; expected signs that stand for a shape in the file's edition (read as a disk, as in LM-63-1995)` |
//! | [`UnknownOpening`] | a point | `3:8: found a luminous width, length and height of 0, -1, 0 m; expected signs that stand for a shape in the file's edition (read as a point)` |
//! | [`NegativeLumens`] | absolute photometry | `3:3: found -2; expected -1 for absolute photometry (read as such)` |
//! | [`ZeroBallastLampFactor`] | counts as 1 | `4:3: found 0; expected 1 in the field behind the ballast factor (read as 1)` |
//! | [`BallastLampFactor`] | not applied | `4:3: found 1.1; expected 1 in the reserved field behind the ballast factor (...)` |
//! | [`VerticalRange`] | outside the angles given the intensity is zero | `5:1: found vertical angles from 0 to 170; expected 0 to 90, 90 to 180 or 0 to 180 degrees (outside, the intensity is zero)` |
//! | [`HorizontalRange`] | types A and B: outside the angles given the intensity is zero | `6:1: found horizontal angles from -40 to 40; expected -90 or 0 to 90 degrees (elsewhere, the intensity is zero)` |
//! | [`VerticalMirror`] | types A and B: the half below mirrors the half above | `5:1: found vertical angles that begin at 0; expected angles from -90 (the half below 0 is taken to mirror that above)` |
//! | [`SinglePlane`] | the same all around | `6:1: found a single plane at 30; expected a single plane at 0 (read as rotationally symmetric)` |
//! | [`FirstPlane`] | the symmetry is that of the span | `6:1: found planes from -90 to 90; expected planes from 0 to 90, 0 to 180, 90 to 270 or 0 to 360 (read by their span)` |
//! | [`MissingClosingPlane`] | taken to equal the first one | `6:10: found planes that end at 270; expected a closing plane at 360 (taken to equal the first one)` |
//! | [`ClosingPlaneDiffers`] | both are kept | `6:7: found a closing plane that differs by up to 1 cd; expected the values of the first plane (both are kept)` |
//! | [`NegativeCandela`] | zero | `7:5: found -0.1; expected candela values of 0 or more (read as 0)` |
//! | [`TrailingText`] | ignored; the word `END` is expected | `8:1: found "the"; expected the end of the file` |
//! | [`NoLight`] | a luminaire that is dark | `3:3: found an integrated flux of 0 lm; expected some light` |
//! | [`FluxDiffers`] | the candela values count | `3:3: found an integrated flux of 1256.6 lm (125.7 % of the lamps'); expected 1000.0 lm, the lamps' flux (check multiplier and lumens; candela values count)` |
//!
//! [`Encoding`]: crate::WarningKind::Encoding
//! [`ByteOrderMark`]: crate::WarningKind::ByteOrderMark
//! [`LeadingBlankLine`]: crate::WarningKind::LeadingBlankLine
//! [`IdentifyingLine`]: crate::WarningKind::IdentifyingLine
//! [`UnknownStandard`]: crate::WarningKind::UnknownStandard
//! [`LabelWithoutKeyword`]: crate::WarningKind::LabelWithoutKeyword
//! [`TiltSpelling`]: crate::WarningKind::TiltSpelling
//! [`TiltFactors`]: crate::WarningKind::TiltFactors
//! [`TiltFile`]: crate::WarningKind::TiltFile
//! [`Semicolon`]: crate::WarningKind::Semicolon
//! [`DecimalComma`]: crate::WarningKind::DecimalComma
//! [`RecordStart`]: crate::WarningKind::RecordStart
//! [`CountWithPoint`]: crate::WarningKind::CountWithPoint
//! [`LuminousShape::from_opening`]: crate::LuminousShape::from_opening
//! [`OpeningOfOtherEdition`]: crate::WarningKind::OpeningOfOtherEdition
//! [`UnknownOpening`]: crate::WarningKind::UnknownOpening
//! [`NegativeLumens`]: crate::WarningKind::NegativeLumens
//! [`ZeroBallastLampFactor`]: crate::WarningKind::ZeroBallastLampFactor
//! [`BallastLampFactor`]: crate::WarningKind::BallastLampFactor
//! [`VerticalRange`]: crate::WarningKind::VerticalRange
//! [`HorizontalRange`]: crate::WarningKind::HorizontalRange
//! [`VerticalMirror`]: crate::WarningKind::VerticalMirror
//! [`SinglePlane`]: crate::WarningKind::SinglePlane
//! [`FirstPlane`]: crate::WarningKind::FirstPlane
//! [`MissingClosingPlane`]: crate::WarningKind::MissingClosingPlane
//! [`ClosingPlaneDiffers`]: crate::WarningKind::ClosingPlaneDiffers
//! [`NegativeCandela`]: crate::WarningKind::NegativeCandela
//! [`TrailingText`]: crate::WarningKind::TrailingText
//! [`NoLight`]: crate::WarningKind::NoLight
//! [`FluxDiffers`]: crate::WarningKind::FluxDiffers
