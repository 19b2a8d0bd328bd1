//! EULUMDAT (`.ldt`), the exchange format of European luminaire makers.
//!
//! A. W. Stockmar, "EULUMDAT: ein Leuchtendatenformat fuer den europaeischen Beleuchtungsplaner",
//! Licht '90, 641-644 (1990). The format has no clauses; its numbered fields are cited. Read by
//! [`read_ldt`](crate::read_ldt), written by [`write_ldt`](crate::write_ldt).
//!
//! # Line by line
//!
//! One field a line, lines ended by carriage return and line feed. The length is the number of
//! characters that the format allows.
//!
//! | field | content | length |
//! |---|---|---|
//! | 1 | company, databank, version or format | 78 |
//! | 2 | type Ityp: 1 point source with rotational symmetry, 2 linear luminaire, 3 any other | 1 |
//! | 3 | symmetry Isym: 0 none, 1 rotational, 2 in C0-C180, 3 in C90-C270, 4 in both | 1 |
//! | 4, 5 | number of C-planes Mc; their distance Dc in degrees, 0 if unequal | 2, 5 |
//! | 6, 7 | number of angles gamma Ng; their distance Dg in degrees, 0 if unequal | 2, 5 |
//! | 8 | measurement report | 78 |
//! | 9, 10 | luminaire's name; its number | 78 |
//! | 11 | file name | 8 |
//! | 12 | date and user | 78 |
//! | 13 to 15 | luminaire in mm: length or diameter, width (0: round), height | 4 |
//! | 16, 17 | luminous area in mm: length or diameter, width (0: round) | 4 |
//! | 18 to 21 | height of the luminous area in mm at C0, C90, C180, C270 | 4 |
//! | 22 | downward flux fraction in % | 4 |
//! | 23 | light output ratio of the luminaire in % | 4 |
//! | 24 | conversion factor of the intensities | 6 |
//! | 25 | tilt during the measurement in degrees | 6 |
//! | 26 | number of lamp sets; for each of them: | 4 |
//! | 26a | number of lamps; negative for absolute photometry | 4 |
//! | 26b | type of lamps | 24 |
//! | 26c | total flux of these lamps in lm | 12 |
//! | 26d, 26e | colour of the light; colour rendering | 16, 6 |
//! | 26f | power in W, with the ballast | 8 |
//! | 27 | direct ratios for room indices 0.6, 0.8, 1, 1.25, 1.5, 2, 2.5, 3, 4, 5: ten lines | 7 |
//! | 28 | Mc angles C, from 0 on, one a line | 6 |
//! | 29 | Ng angles gamma, from 0 on, one a line | 6 |
//! | 30 | intensities in cd/klm, all gamma of one plane, then the next | 6 |
//!
//! Field 28 lists the planes all around. Field 30 holds those that the symmetry leaves: all (Isym
//! 0), one (1), C0 to C180 (2), C270 over C0 to C90 (3), C0 to C90 (4).
//!
//! # What the numbers mean
//!
//! Intensity = value x conversion factor (24) x total flux of the first lamp set (26c) / 1000 lm.
//! In absolute photometry the flux is that of the luminaire, and the same product holds. The length
//! runs along C90-C270, the width along C0-C180: the width and the length of LM-63.
//!
//! # Direct ratios
//!
//! Field 27 gives the part of the luminaire's flux that falls on the working plane directly, for
//! the utilisation factor method. It is not read. The writer computes it for luminaires that cover
//! the ceiling of a square room evenly: a ray at (gamma, C) moves h tan gamma, so that of all
//! luminaires the share (1 - |tan gamma cos C| / 2k) (1 - |tan gamma sin C| / 2k) sends it to the
//! plane, in a room of index k. Of 21 published files with ratios of their own, 11 are within 0.04
//! of this in all ten, and 15 within 0.1; tables of the method put a finite number of luminaires at
//! stated places. A formula that public programs share, a sum of the fluxes below 41.4, 60, 75.5
//! and 90 degrees with tabulated weights, is within 0.1 for one of them, misses most by 0.2 to 0.3
//! in small rooms, and is not used.
//!
//! # What is tolerated
//!
//! [`Encoding`], [`ByteOrderMark`], [`CountWithPoint`], [`VerticalRange`], [`NegativeCandela`],
//! [`TrailingText`], [`NoLight`] and [`FluxDiffers`] as in [LM-63](super::lm63); the last compares
//! with the lamps' flux times the light output ratio. And:
//!
//! | rule | what is made of it | for example |
//! |---|---|---|
//! | [`DecimalComma`] | a decimal point | `23:1: found "125,66"; expected a decimal point (read as one)` |
//! | [`EmptyNumber`] | zero, where no intensity depends on it | `14:1: found an empty line; expected the luminaire's width (field 14), in mm` |
//! | [`AngleDistance`] | the angles listed count | `5:1: found a distance of 30 degrees; expected the distance of all planes, or 0 if unequal (the list counts)` |
//! | [`SinglePlaneWithoutSymmetry`] | rotational symmetry | `3:1: found Isym = 0 with a single plane; expected Isym = 1 for a single plane (read as rotationally symmetric)` |
//! | [`ClosingPlaneGiven`] | kept | `47:1: found a plane at 360; expected planes below 360, the closing one left out (it is kept)` |
//! | [`PlanesMissing`] | the gap is filled by interpolation | `3:1: found Isym = 0 with planes from 0 to 180; expected planes all around (the gap is interpolated; check Isym)` |
//! | [`SeveralLampSets`] | the first set is taken | `26:1: found 2 sets of lamps; expected one set of lamps (the first one is taken)` |
//! | [`ZeroLampCount`] | one lamp | `27:1: found 0; expected at least one lamp, or a negative number for absolute photometry` |
//! | [`ZeroConversionFactor`] | 1 | `24:1: found 0; expected a conversion factor above 0 (read as 1)` |
//! | [`ZeroLightOutputRatio`] | the flux is not compared | `23:1: found 0; expected a light output ratio in % (the flux is not compared with it)` |
//! | [`DownwardFluxDiffers`] | the intensities count | `22:1: found a downward flux fraction of 90 %; expected 50.0 %, as the intensities have it (they count)` |
//! | [`MeasurementTilt`] | kept as a fact, turns nothing | `25:1: found a tilt of 15 degrees during measurement; expected 0 (the tilt is not applied: the luminaire is taken as measured)` |
//!
//! [`Encoding`]: crate::WarningKind::Encoding
//! [`ByteOrderMark`]: crate::WarningKind::ByteOrderMark
//! [`CountWithPoint`]: crate::WarningKind::CountWithPoint
//! [`VerticalRange`]: crate::WarningKind::VerticalRange
//! [`NegativeCandela`]: crate::WarningKind::NegativeCandela
//! [`TrailingText`]: crate::WarningKind::TrailingText
//! [`NoLight`]: crate::WarningKind::NoLight
//! [`FluxDiffers`]: crate::WarningKind::FluxDiffers
//! [`DecimalComma`]: crate::WarningKind::DecimalComma
//! [`EmptyNumber`]: crate::WarningKind::EmptyNumber
//! [`AngleDistance`]: crate::WarningKind::AngleDistance
//! [`SinglePlaneWithoutSymmetry`]: crate::WarningKind::SinglePlaneWithoutSymmetry
//! [`ClosingPlaneGiven`]: crate::WarningKind::ClosingPlaneGiven
//! [`PlanesMissing`]: crate::WarningKind::PlanesMissing
//! [`SeveralLampSets`]: crate::WarningKind::SeveralLampSets
//! [`ZeroLampCount`]: crate::WarningKind::ZeroLampCount
//! [`ZeroConversionFactor`]: crate::WarningKind::ZeroConversionFactor
//! [`ZeroLightOutputRatio`]: crate::WarningKind::ZeroLightOutputRatio
//! [`DownwardFluxDiffers`]: crate::WarningKind::DownwardFluxDiffers
//! [`MeasurementTilt`]: crate::WarningKind::MeasurementTilt
