//! ASTM E1392 files, line by line.
//!
//! ASTM E1392, *Standard Practice for Angle Resolved Optical Scatter Measurements on Specular or Diffuse Surfaces*
//! (1996, withdrawn), describes a text file of scattering; E2387 has taken its place without one. No published file
//! was at hand: [`read_astm`](crate::bsdf::read_astm) follows the reader of libbsdf (Kimura 2014), and the tests make theirs
//! from analytic surfaces.
//!
//! | line | meaning |
//! |---|---|
//! | header | keywords such as `NUM_POINTS`, not used |
//! | `VARS theta_i,phi_i,theta_s,phi_s,`... | names the columns: four angles, then one of any name, or `R,G,B`, or `X,Y,Z` |
//! | each further line | as many numbers, with commas or blanks between them; empty lines and those from `#` on are skipped |
//!
//! Angles are in radians, polar ones from the normal; light is reflected like by a mirror where `phi_s` is half a turn from `phi_i`.
//! Values are f in sr^-1, without a cosine. Lines may have any order, but each incident direction needs a full
//! grid of exits; if several azimuths `phi_i` occur, each needs the same polar angles, else the surface is isotropic.
//! Exit azimuths over half a turn from `phi_i` stand for both halves. f is linear between polar angles, and goes on to the
//! normal and to the horizon as at the nearest one. XYZ becomes linear RGB of ITU-R BT.709, cut at zero. Light is scattered by the front.
//!
//! # Tolerated deviations
//! | rule | what is made of it | for example |
//! |---|---|---|
//! | [`AnglesInDegrees`] | all angles are read as degrees | `9:1: found a polar angle of 80; expected radians, pi/2 at most (all angles are read as degrees)` |
//!
//! As in WINDOW files: `NegativeScattering`, `EnergyNotConserved`, `NotReciprocal`; as in LM-63: `Encoding`.
//!
//! [`AnglesInDegrees`]: crate::Deviation::AnglesInDegrees
