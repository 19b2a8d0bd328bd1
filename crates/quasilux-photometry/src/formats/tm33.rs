//! TM-33 files, element by element.
//!
//! ANSI/IES TM-33-18 and TM-33-23, *Standard Format for the Electronic Transfer of Luminaire
//! Optical Data*, describe a luminaire in XML; both come from ATLA S001 (All Things Lighting
//! Association 2018, Ashdown). [`read_tm33`](crate::read_tm33) takes the luminous intensities and
//! what scales them; spectra, radiant and photon quantities and colours are read over. Elements may
//! have any order, and a prefix.
//!
//! | element | meaning here |
//! |---|---|
//! | root | `IESTM33-22`: TM-33-23; `IESTM33`: TM-33-18; `ATLA_S001`, `ATLA_S001_A`: ATLA S001 |
//! | `Version` | required, not used |
//! | `Header` / `Manufacturer`, `CatalogNumber`, `Description`, `Laboratory`, `ReportNumber`, `ReportDate`, `Comment` | keywords `MANUFAC`, `LUMCAT`, `LUMINAIRE`, `TESTLAB`, `TEST`, `ISSUEDATE`, `OTHER` |
//! | `Luminaire` / `Dimensions` | the housing in m; not used |
//! | `Equipment` / `Gonioradiometer` / `Type` | `IES_C` or `CIE_C`, type C, also if missing; `IES_A`, `IES_B`: see [`Web`](crate::Web); others are refused |
//! | `Emitter` | one or more; their intensities are added |
//! | .. `Quantity` | lamps of the emitter; scales nothing |
//! | .. `RatedLumens` | lumens of all these lamps; serve the flux check alone |
//! | .. `InputWattage`, `Description`, `CatalogNumber`, `ColorTemperature` / `FixedCCT`, `ColorRendering` / `CIE_CRI` / `Ra` | watts; keywords `LAMP`, `LAMPCAT`, `COLORTEMP`, `CRI` |
//! | .. `BallastFactor` | a factor in relative photometry |
//! | .. `TiltAngles` / `Tilt` | not applied |
//! | .. `LuminousData` / `LuminousFlux` | lumens of the emitter in the luminaire, for the flux check |
//! | .. `EmissionAreas` | areas of six faces in m: the luminous opening is the box around them |
//! | `LuminousData` / `LuminousIntensity` | the intensities in cd |
//! | .. `AbsolutePhotometry` | `true`, `false`; if missing, false where `RatedLumens` is above 0 |
//! | .. `Symm` | `Symm_None`, `Symm_Bi_0` (C0 to C180), `Symm_Bi_90` (C90 to C270), `Symm_Quad`, `Symm_Full`, `Symm_Arbitrary`; what counts are the angles |
//! | .. `Multiplier` | a factor, 1 if missing (TM-33-23) |
//! | .. `NumberMeasured`, `NumberHorz`, `NumberVert` | intensities, planes, angles of a plane |
//! | .. `IntData`, attributes `h` and `v` | one intensity at azimuth C = `h` and gamma = `v`, in degrees; any order, each pair of an `h` and a `v` once |
//!
//! TM-33-23 adds `Multiplier`, spectra over angles, colours over angles, and several elements
//! `CustomData`.
//!
//! Intensity = value x multiplier, x ballast factor unless the photometry is absolute. Planes span
//! a symmetry as in LM-63: one plane, 0 to 90, 0 to 180, 90 to 270 or 0 to 360 degrees. Types A and
//! B have the ranges and mirror images of LM-63 too, and `Symm` says nothing about them.
//!
//! *Our reading, where the schema leaves it open:* `RatedLumens` and `InputWattage` are those of
//! the emitter, not of one of its `Quantity` lamps, as the wattage in the examples shows; the
//! default of `AbsolutePhotometry`; and the length of an emission area along C90-C270, its width
//! along C0-C180, since the faces towards C0 and C180 have a length and those towards C90 and C270
//! a width.
//!
//! # Several emitters
//! On one grid their values are added. On different grids all tables are evaluated at the angles of
//! all, where a bilinear function stays what it is: the sum is exact. Refused is an emitter that
//! ends with light at a vertical angle beyond which others go on, and types A and B on different
//! grids. `EmitterCenter` is not used: all
//! stand in one place. Where planes at 0 and 360 differ, the one at 0 counts in such a sum.
//!
//! # XML
//! Well-formed XML 1.0 or 1.1 in UTF-8, UTF-16 or Latin-1, no document type, no entities but the
//! five of XML, no more than 64 levels of elements and 64 attributes of one.
//!
//! # Tolerated deviations
//! | rule | what is made of it | for example |
//! |---|---|---|
//! | `UnknownStandard` | read as ATLA S001 if the root is `LuminaireOpticalData`, else as TM-33-23 | `2:1: found "IESTM33-30"; expected IESTM33-22, IESTM33 or ATLA_S001 (...)` |
//! | [`MissingElement`] | read without it; no intensity depends on it | `3:1: found Header without Laboratory; expected all that TM-33 requires` |
//! | [`ForeignElement`] | read as the one that is meant: see below | `9:1: found the element "IntensityData"; expected IntData (read as that)` |
//! | [`WordSpelling`] | read as the word that is meant | `8:7: found "C"; expected IES_C or CIE_C (read as that)` |
//! | [`SymmetryDiffers`] | the planes count | `8:7: found Symm_Full with planes from 0 to 90; expected the symmetry that they span (the planes count)` |
//! | [`CountDiffers`] | those given count | `8:3: found a NumberVert of 5; expected 3, as many as there are` |
//! | [`SeveralEmitters`] | added: see above | `20:1: found 2 emitters; expected one emitter (their intensities are added, as if from one place)` |
//! | [`EmitterWithoutLight`] | left out | `20:1: found an emitter without luminous intensities; expected LuminousData in each emitter (this one is left out)` |
//! | [`AbsoluteBallastFactor`] | not applied | `6:1: found a BallastFactor of 0.9; expected 1 with absolute photometry (not applied: measured with the ballast)` |
//! | [`OpeningInMillimetres`] | read in millimetres | `5:1: found LuminousOpening; expected EmissionAreas in the emitter, in m (read, as its writers mean it, in mm)` |
//!
//! As in LM-63: `CountWithPoint`, `VerticalRange`, `SinglePlane`, `FirstPlane`, `HorizontalRange`,
//! `VerticalMirror`, `MissingClosingPlane`, `ClosingPlaneDiffers`, `NegativeCandela`, `NoLight`,
//! `FluxDiffers`, `TiltFactors`, `Encoding`; as in EULUMDAT: `EmptyNumber`, `ZeroLampCount`.
//!
//! Names that other writers use and that are read as the standard's:
//!
//! | standard | also read |
//! |---|---|
//! | `LuminousData` / `LuminousIntensity` | `LuminousData` or `IntensityDistribution` alone, `Metric` `Luminous`, `Units` `cd` |
//! | `IntData`, `h`, `v` | `IntensityData`, `horz` or `horizontal`, `vert` or `vertical` |
//! | `Symm` | `SymmType` |
//! | `Gonioradiometer` / `Type` | `Goniometer`, `GoniometerType`, `PhotometryType` beside the intensities |
//! | `InputWattage` | `InputWatts` |
//! | `LuminousFlux` | `MeasuredLumens` of the emitter |
//!
//! [`MissingElement`]: crate::WarningKind::MissingElement
//! [`ForeignElement`]: crate::WarningKind::ForeignElement
//! [`WordSpelling`]: crate::WarningKind::WordSpelling
//! [`SymmetryDiffers`]: crate::WarningKind::SymmetryDiffers
//! [`CountDiffers`]: crate::WarningKind::CountDiffers
//! [`SeveralEmitters`]: crate::WarningKind::SeveralEmitters
//! [`EmitterWithoutLight`]: crate::WarningKind::EmitterWithoutLight
//! [`AbsoluteBallastFactor`]: crate::WarningKind::AbsoluteBallastFactor
//! [`OpeningInMillimetres`]: crate::WarningKind::OpeningInMillimetres
