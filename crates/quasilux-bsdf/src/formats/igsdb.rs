//! Product files of the IGSDB, key by key.
//!
//! JSON of the International Glazing and Shading Database (LBNL), as its first interface
//! (`igsdb.lbl.gov/api/v1`) and its second give it. [`read_glazing`](crate::read_glazing) reads one
//! sheet of clear glass; [`Glazing`](crate::Glazing) puts several behind one another.
//!
//! | key | meaning here |
//! |---|---|
//! | `name`, `product_name`, `product_description.name` | the name; the first one that is there |
//! | `type` | `glazing` or `material`; others are refused, such as `shading` |
//! | `subtype`, `coated_side`, `coating_name` | `monolithic` or `laminate` without a coating: an uncoated sheet. Anything else: a coated one |
//! | `measured_data.is_specular`, `physical_properties.is_specular` | `false` is refused |
//! | `spectral_data.spectral_data` | for each `wavelength` in micrometres `T`, `Rf` and `Rb`, shares of light at normal incidence |
//! | `physical_properties.optical_properties.optical_data.angle_blocks` | the same of the second interface: `w`, and in `specular` `tf`, `tb`, `rf`, `rb`, of the block with `incidence_angle` 0; `diffuse` is refused |
//! | `integrated_results_summary` | `tfvis`, `rfvis`, `rbvis`: compared with the mean of the spectra |
//!
//! Numbers may stand in quotation marks. Other keys are skipped. No list has more than 20 000
//! elements.
//!
//! # Visible values
//! Means over 380 to 780 nm, weighted by the CIE illuminant D65 and V (ISO 9050:2003, EN 410:2011),
//! in steps of 5 nm; between the wavelengths of the file values lie on straight lines.
//!
//! # Angles
//! An uncoated sheet is a slab: refractive index and absorption follow from T and the mean of Rf
//! and Rb for each wavelength, and Fresnel's equations and all inner reflections give the shares at
//! any angle, for each polarisation. A coated sheet follows the mean curves of clear or bronze
//! glass (Finlayson et al. 1993). Between sheets light goes to and fro for ever, for each
//! wavelength and polarisation. Deviation: LBNL WINDOW combines sheets by means of both
//! polarisations, which gives less away from the normal: for two clear sheets 0.7 % at 40 degrees,
//! 4 % at 60 and 7 % at 70.
//!
//! # Tolerated deviations
//! | rule | what is made of it | for example |
//! |---|---|---|
//! | [`SharesExceedOne`] | scaled down to 1 | `1:1: found transmittance and reflectance of 1.0020 together in spectral_data[30]; expected at most 1 (scaled down)` |
//! | [`ShortSpectrum`] | beyond, values are as at the ends; 410 to 700 nm are needed | `1:1: found wavelengths from 400 to 700 nm; expected 380 to 780 nm (beyond, values are as at the ends)` |
//! | [`TransmittancesDiffer`] | their mean is read | `1:1: found tf = 0.6 and tb = 0.61 in wavelength_data[3]; expected the same from both sides (their mean is read)` |
//! | [`OtherIncidences`] | left out | `1:1: found 3 angle_blocks; expected normal incidence alone (others are left out)` |
//! | [`UnlikeUncoated`] | its angles are read as those of a coated sheet | `1:1: found reflectances of 0.0800 and 0.1200; expected an uncoated sheet, as the file says (...)` |
//! | [`StatedOtherwise`] | the spectrum counts | `1:1: found a visible transmittance of 0.8000, but 0.7000 by the spectrum; expected the same (the spectrum counts)` |
//!
//! As in WINDOW files: `NegativeScattering` (down to -0.02). Text that is not UTF-8 is read as
//! Latin-1 (`Encoding`), a byte order mark is skipped (`ByteOrderMark`).
//!
//! [`SharesExceedOne`]: crate::WarningKind::SharesExceedOne
//! [`ShortSpectrum`]: crate::WarningKind::ShortSpectrum
//! [`TransmittancesDiffer`]: crate::WarningKind::TransmittancesDiffer
//! [`OtherIncidences`]: crate::WarningKind::OtherIncidences
//! [`UnlikeUncoated`]: crate::WarningKind::UnlikeUncoated
//! [`StatedOtherwise`]: crate::WarningKind::StatedOtherwise
