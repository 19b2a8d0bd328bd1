//! Integra DDR and DDT files, word by word.
//!
//! Text files of Integra's Inspirer and Lumicept for measured reflection (`.ddr`) and transmission
//! (`.ddt`). No description by their makers is public; [`read_ddr`](crate::read_ddr) follows the
//! reader and the writer of libbsdf (Kimura 2014), and no published file was at hand: the tests
//! make theirs from analytic surfaces. The content does not tell whether it is reflection or
//! transmission, the extension does.
//!
//! Words are read in letters of any case; a semicolon begins a comment to the end of the line.
//!
//! | words | meaning here |
//! |---|---|
//! | `Source` *word* | not used |
//! | `TypeSym` | `AxiSymmetrical`: about the specular direction; `PlaneSymmetrical`: in the plane of incidence; `ASymmetrical`, also followed by `4D` |
//! | `TypeColorModel` | `BW` or `RGB`; `spectral` is refused |
//! | `TypeData` | `Luminance Absolute` (also if missing): `kbdf` is a factor; `Luminance Relative`: it is the albedo; intensities are refused |
//! | `psi` *n angles* | incident azimuths; without it the surface is isotropic; one at 360 is that at 0 |
//! | `sigma` *n angles* | incident polar angles |
//! | `sigmat` *angles* | polar angle of the specular direction for each `sigma`; without it the same angle |
//! | `phi` *n angles* | azimuths about the specular direction, 0 towards the normal, in the sense of a right hand whose thumb points along it |
//! | `theta` *n angles* | angles from the specular direction |
//! | `bw`, or `red`, `gre` or `green`, `blu` or `blue` | a block of one colour, in this order |
//! | .. `kbdf` *values* | one for each `psi` and, inside, `sigma`; 1 if missing |
//! | .. `def` *values* `enddef` | pi times f; `psi` outermost, then `sigma`, `phi`, and `theta` innermost |
//!
//! Angles are in degrees and ascend. The specular direction of reflection is the mirror direction,
//! that of transmission straight on. Between angles of exit f is bilinear; beyond the last `theta`
//! it is zero. Between incident angles lobes move with the specular direction and keep their light,
//! see [`GriddedTable`](crate::GriddedTable); so does the lobe of a file of one incident polar
//! angle, for light from anywhere. Light is scattered by the front.
//!
//! # Tolerated deviations
//! | rule | what is made of it | for example |
//! |---|---|---|
//! | [`Resampled`] | always: f is taken to a grid about the normal, with nodes where those of the file are | `9:1: found values around the specular direction, 37 by 91; expected spherical angles (resampled; off by 0.21 % in the mean at incidences of the file, by about 1.30 % between them)` |
//! | [`AzimuthGap`] | linear across the gap; `PlaneSymmetrical` goes on beyond its ends as there | `9:1: found azimuths phi that leave a gap of 180 degrees; expected 0 to 180 with gaps of 90 degrees at most (...)` |
//! | [`SpecularMissing`] | f is constant up to the first angle | `9:1: found theta from 5.0 degrees on; expected angles from 0 on, the specular direction (f is as at the first one)` |
//! | [`OneIncidence`](crate::WarningKind::OneIncidence) | the lobe follows the specular direction | `9:1: found one incident polar angle, 0.0 degrees; expected several (the lobe follows the specular direction and keeps its light)` |
//! | [`UnknownScatteringMode`] | reflection, such as from standard input | `1:1: found the name "stdin"; expected a name in .ddr for reflection, or .ddt for transmission (read as reflection)` |
//!
//! As in WINDOW files: `OneWayTransmission`, `NegativeScattering`, `TrailingValues`,
//! `EnergyNotConserved`, `NotReciprocal`; as in ASTM E1392 files: `Encoding`, `ByteOrderMark`.
//!
//! [`Resampled`]: crate::WarningKind::Resampled
//! [`AzimuthGap`]: crate::WarningKind::AzimuthGap
//! [`SpecularMissing`]: crate::WarningKind::SpecularMissing
//! [`UnknownScatteringMode`]: crate::WarningKind::UnknownScatteringMode
