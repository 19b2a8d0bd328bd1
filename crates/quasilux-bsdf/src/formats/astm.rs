//! ASTM E1392 files, line by line.
//!
//! ASTM E1392, *Standard Practice for Angle Resolved Optical Scatter Measurements on Specular or
//! Diffuse Surfaces* (1996, withdrawn), describes a text file of scattering; E2387 has taken its
//! place without one. No published file was at hand: [`read_astm`](crate::read_astm) follows the
//! reader of libbsdf (Kimura 2014), and the tests make theirs from analytic surfaces.
//!
//! | line | meaning |
//! |---|---|
//! | header | keywords such as `NUM_POINTS`, not used |
//! | `VARS theta_i,phi_i,theta_s,phi_s,`... | names the columns: four angles, then one of any name, or `R,G,B`, or `X,Y,Z` |
//! | each further line | as many numbers, with commas or blanks between them; empty lines and those from `#` on are skipped |
//!
//! Angles are in radians, polar ones from the normal of the side of the incident light; light is
//! reflected like by a mirror where `phi_s` is half a turn from `phi_i`, and exits with `theta_s`
//! over a quarter turn have passed the sheet. `theta_i` of a quarter turn or less is all that is
//! read: light on the front. The header does not tell the unit: where a polar angle is over pi or
//! an azimuth over 2 pi (by more than 0.01) all angles are read as degrees. Values are f in sr^-1,
//! without a cosine, and are kept in 24 bits. Lines may have any order, but each incident direction
//! needs a full grid of exits; if several azimuths `phi_i` occur, each needs the same polar angles,
//! else the surface is isotropic. Exit azimuths over half a turn from `phi_i` stand for both
//! halves. f is linear between angles, and goes on to the normal and to the horizon as at the
//! nearest polar one. XYZ becomes linear RGB of ITU-R BT.709.
//!
//! # Azimuths of exits
//! Gaps between azimuths of exits over 90 degrees are refused, but along the normal of an isotropic
//! surface: how much light leaves the plane of incidence shows a quarter turn away from it, and is
//! unknown from a scan in that plane or in a quadrant. Filling such a gap would smear a lobe around
//! the normal, and reflectance would come out several times too high. At gaps over 45 degrees a
//! warning says how wide they are: narrow lobes are smeared there, too, and smooth ones are off by
//! some percent.
//!
//! # Tolerated deviations
//! | rule | what is made of it | for example |
//! |---|---|---|
//! | [`AnglesInDegrees`] | all angles are read as degrees | `9:1: found a polar angle of 80; expected radians, pi at most (all angles are read as degrees)` |
//! | [`RepeatedDirection`] | the first one is read; equal values, such as those at 0 and 360 degrees, need no word | `30:1: found other values for the directions of line 12; expected each pair of directions once (the first one is read)` |
//! | [`OutOfGamut`] | goes towards white until no channel is below 0; Y stays | `9:1: found X 0.016, Y 0.08, Z 0.006; expected a colour of BT.709 (made less saturated, its luminance is kept)` |
//! | [`AzimuthGap`] | linear across the gap; between incident azimuths it is told over 90 degrees | `9:1: found exit azimuths that leave a gap of 60 degrees; expected gaps of 45 degrees at most (f is linear across it)` |
//! | [`OneIncidence`] | light from elsewhere is scattered as from there | `9:1: found one incident polar angle, 5.0 degrees; expected several (light from elsewhere is scattered as from there)` |
//!
//! As in WINDOW files: `OneWayTransmission`, `NegativeScattering`, `EnergyNotConserved`,
//! `NotReciprocal`. Text that is not UTF-8 is read as Latin-1 ([`Encoding`]), a byte order mark is
//! skipped ([`ByteOrderMark`]).
//!
//! [`Encoding`]: crate::WarningKind::Encoding
//! [`ByteOrderMark`]: crate::WarningKind::ByteOrderMark
//! [`AnglesInDegrees`]: crate::WarningKind::AnglesInDegrees
//! [`RepeatedDirection`]: crate::WarningKind::RepeatedDirection
//! [`OutOfGamut`]: crate::WarningKind::OutOfGamut
//! [`AzimuthGap`]: crate::WarningKind::AzimuthGap
//! [`OneIncidence`]: crate::WarningKind::OneIncidence
