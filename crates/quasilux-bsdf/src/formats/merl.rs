//! MERL files, byte by byte.
//!
//! The database of isotropic reflection of Matusik, Pfister, Brand and McMillan (2003), binary,
//! little-endian. [`read_merl`](crate::read_merl) reads it. The tests make a file from an analytic
//! surface.
//!
//! | bytes | meaning |
//! |---|---|
//! | 0 to 11 | three counts as 32-bit integers: half angles (90), difference angles (90), difference azimuths (180) |
//! | then | red, green, blue: a 64-bit float for each half angle, difference angle and, innermost, difference azimuth |
//!
//! Angles are those of Rusinkiewicz (1998). Half angle i of n is 90 (i / n)^2 degrees, difference
//! angle i is 90 i / n degrees, azimuth i is 180 i / n degrees: half a turn, the other half is the
//! same by reciprocity. f is a value times 1/1500 (red), 1.15/1500 (green) or 1.66/1500 (blue), in
//! linear RGB.
//!
//! *Our reading:* a value is that at its angles, and between them f is linear; the program of the
//! authors takes the value of the cell. Light is scattered by the front.
//!
//! Lobes are kept for each second degree of incidence, on grids that are densest around the mirror
//! direction. Errors have the byte, counted from 1, as the column of line 1.
//!
//! # Tolerated deviations
//! | rule | what is made of it | for example |
//! |---|---|---|
//! | [`MissingValues`] | the neighbours stand for them; 0 where there are none | `1:1: found 1090800 of 4374000 values below 0; expected a measurement (those count as missing, ...)` |
//!
//! As in DDR files: `Resampled`; as in WINDOW files: `EnergyNotConserved`, `NotReciprocal`.
//!
//! [`MissingValues`]: crate::WarningKind::MissingValues
