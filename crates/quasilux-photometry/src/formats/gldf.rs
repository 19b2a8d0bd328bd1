//! GLDF containers, element by element.
//!
//! GLDF (Global Lighting Data Format, DIAL and RELUX; XSD 1.0.0-rc.3 of 2023) is a zip archive with
//! `product.xml`, photometric files in `ldc/`, and pictures, models and documents, which are not
//! read. [`read_gldf`](crate::read_gldf) follows this chain:
//!
//! | element | meaning here |
//! |---|---|
//! | `ProductDefinitions` / `Variants` / `Variant` | one of them: [`GldfChoice::variant`](crate::GldfChoice::variant) |
//! | .. `Geometry` / `EmitterReference`, `SimpleGeometryReference`, `ModelGeometryReference`, `GeometryReferences` | its emitters; all of them shine together, one of them is read: [`GldfChoice::emitter`](crate::GldfChoice::emitter) |
//! | `Emitters` / `Emitter` | light emitters that can be exchanged, of which one is in use: [`GldfChoice::light_source`](crate::GldfChoice::light_source); `SensorEmitter` is no light |
//! | .. `ChangeableLightEmitter`, `FixedLightEmitter`, `MultiChannelLightEmitter`; `LightEmitter` of format 0.9 | a photometry and a light source |
//! | .. `emergencyBehaviour` | `None`, `Combined`: shines in normal operation; `EmergencyOnly`: with [`GldfChoice::emergency`](crate::GldfChoice::emergency) or by name |
//! | .. `Rotation` | X, Y, Z about the axes of the luminaire, right-handed, order ZXY; G0 first, about gamma = 0 from C0 toward C90 (our reading) |
//! | `Equipments` / `Equipment` / `LightSourceReference` | its light source, `lightSourceCount` of them |
//! | `RatedLuminousFlux` | of the light emitter, else of its light sources together |
//! | `RatedInputPower` | of the equipment, else of its light sources together |
//! | `EmergencyBallastLumenFactor`, `EmergencyRatedLuminousFlux` | light in an emergency |
//! | `MultiChannelLightSource` / `Channels` / `Channel` | a photometry and a flux; all channels are added, or one: [`GldfChoice::channel`](crate::GldfChoice::channel) |
//! | `Photometries` / `Photometry` | a file, and figures that are compared with it |
//! | `Files` / `File` | content types `ldc/eulumdat`, `ldc/ies`, `ldc/iesxml`; a `url` is refused, nothing is fetched |
//! | `Geometries` / `SimpleGeometry` | `RectangularEmitter` or `CircularEmitter` with `C-Heights`: the luminous opening |
//! | `Header` / `Manufacturer`; `Name`, `ProductNumber` | keywords `MANUFAC`, `LUMINAIRE`, `LUMCAT` in place of the file's |
//! | `Mountings`, `ActivePowerTable`, `LightSourceMaintenance`, `ColorInformation` | told as facts; they scale nothing |
//!
//! A `TILT=` file is read where it lies beside its LM-63 file. Everything else is left out: 3D
//! models and what they say of places and turns of emitters, spectra, sensors, descriptive
//! attributes, UGR.
//!
//! # Flux
//! GLDF counts before the photometric file, in "all semantically identical values" (conventions,
//! "GLDF over Photometry", of its documentation). So relative photometry is scaled by the rated
//! flux over the lumens of the file's lamps, and absolute photometry, of any format, by the rated
//! flux over its integral. A rated flux that differs by more than 1 % is told. A rated flux of 0 lm
//! makes a channel dark; elsewhere that of the file is taken, and told. The power is unknown of a
//! part of the channels and in an emergency.
//!
//! # The archive
//! Entries are stored or deflated, with names in UTF-8 or code page 850, found whatever their
//! capitals where only one is meant. No other file is read in place of one that is not there.
//! Refused are names that lead out of a folder (`..`, absolute, with a drive) or have more than
//! 1024 bytes, two entries of one name, encryption, more than 10 000 entries, a `product.xml` or
//! TM-33 file of more than 2 MiB, other files of more than 8 MiB or all together of more than 16
//! MiB, entries of more than 1 MiB that are deflated more than 200 times, and bytes that do not
//! have their CRC-32. Sums of channels have no more than 2 000 000 values.
//!
//! # Tolerated deviations
//! | rule | what is made of it | for example |
//! |---|---|---|
//! | [`ContainerFlux`] | see above | `40:7: found a rated luminous flux of 7800 lm; expected 1600.0 lm, as the lamps of ldc/a.ldt have it (the container's is taken, as GLDF has it)` |
//! | [`ContainerOpening`] | the container's counts | `60:5: found a luminous rectangle of 0.100 x 1.200 x 0.000 m; expected a luminous rectangle of 0.060 x 1.450 x 0.000 m, as the photometric file has it (the container's counts)` |
//! | [`DescriptionDiffers`] | the intensities count | `22:9: found CIE-FluxCode "69 98 100 100 65"; expected 45 72 95 100 100, as the photometry has it (which counts)` |
//! | [`EmergencyEmitter`] | left out, unless it was asked for | `80:7: found emitters for emergencies only: "exit"; expected emitters for normal operation (these are not in this light; "emitter" chooses one)` |
//! | [`EmitterTurned`] | turned where it is placed, and by [`Photometry::turned`](crate::Photometry::turned) | `50:9: found a rotation of X 0, Y 0, Z 0, G0 90 degrees; expected a photometry in its position of use (GLDF does not define the angles: look at a picture)` |
//! | [`ModelPlaces`] | the light of one of them | `75:5: found 3 places of the 3D model that shine; expected a [[luminaires]] of its own for each (this is the light of one)` |
//! | [`SeveralChannels`] | all at full light | `30:7: found 2 channels: "warm", "cold"; expected "channel" with one of them, or all at full light (as they are now)` |
//! | [`ZeroLampFlux`] | EULUMDAT: the container's flux counts | `26:1: found lamps of 0 lm; expected a total flux above 0 lm (that of the container counts)` |
//! | [`MissingElement`] | the reference or opening is left out | `71:5: found EmitterReference without an emitter; expected an emitterId (the reference is left out)` |
//! | [`VariantWithoutEmitter`] | one of the product is taken | `70:5: found a variant without emitters; expected an EmitterReference in its Geometry (an emitter of the product is taken)` |
//!
//! Places are those of `product.xml`; deviations of the photometric file itself have places there.
//!
//! [`ContainerFlux`]: crate::WarningKind::ContainerFlux
//! [`ContainerOpening`]: crate::WarningKind::ContainerOpening
//! [`DescriptionDiffers`]: crate::WarningKind::DescriptionDiffers
//! [`EmergencyEmitter`]: crate::WarningKind::EmergencyEmitter
//! [`EmitterTurned`]: crate::WarningKind::EmitterTurned
//! [`MissingElement`]: crate::WarningKind::MissingElement
//! [`ModelPlaces`]: crate::WarningKind::ModelPlaces
//! [`SeveralChannels`]: crate::WarningKind::SeveralChannels
//! [`VariantWithoutEmitter`]: crate::WarningKind::VariantWithoutEmitter
//! [`ZeroLampFlux`]: crate::WarningKind::ZeroLampFlux
