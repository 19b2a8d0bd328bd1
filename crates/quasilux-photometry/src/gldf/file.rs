//! The photometric file of a light emitter or channel, read from the archive.

use super::GldfError;
use super::archive::Archive;
use super::product::{Product, Reference};
use super::texts::{attribute, in_quotes};
use super::told::Told;
use crate::ldt::read_ldt_of_any_flux;
use crate::{Format, Parsed, Photometry, Tilt, WarningKind, read_tilt};
use quasilux_text::xml::Element;

/// Bytes that a photometric file may have.
const MAX_FILE_BYTES: usize = 8 << 20;
/// Bytes that a TM-33 file may have: the tree of its elements takes a multiple of it.
const MAX_XML_BYTES: usize = 2 << 20;
/// Bytes that a file of tilt factors may have.
const MAX_TILT_BYTES: usize = 64 << 10;

/// References to a photometry.
const PHOTOMETRY: Reference<'static> = Reference {
    child: "PhotometryReference",
    attributes: &["photometryId"],
    list: "Photometries",
    names: &["Photometry"],
};
/// References of a photometry to its file.
const FILE: Reference<'static> = Reference {
    child: "PhotometryFileReference",
    attributes: &["fileId"],
    list: "Files",
    names: &["File"],
};

/// A photometry of a product.
pub(super) struct FromFile<'e> {
    pub(super) photometry: Photometry,
    /// The name of its file in the container.
    pub(super) part: String,
    /// The element that declares it.
    pub(super) declared: &'e Element<'e>,
    /// Whether its lamps have 0 lm: its intensities are those for 1000 lm.
    pub(super) lacks_flux: bool,
}

/// Reads the photometry that a light emitter or a channel refers to.
pub(super) fn read<'e>(
    product: Product<'e>,
    from: &'e Element<'e>,
    archive: &mut Archive<'_>,
    told: &mut Told,
) -> Result<FromFile<'e>, GldfError> {
    let Some(declared) = product.refer(from, &PHOTOMETRY)? else {
        let found = format!("{} without a PhotometryReference", from.name);
        return Err(GldfError::at(from, found, "a photometry of each light"));
    };
    let Some(file) = product.refer(declared, &FILE)? else {
        let found = "a Photometry without a PhotometryFileReference";
        return Err(GldfError::at(declared, found, "an EULUMDAT, IES or TM-33 file"));
    };
    let part = part_of(file, archive)?;
    let bytes = archive.unpack(&part, MAX_FILE_BYTES)?;
    let promised = match attribute(file, "contentType") {
        Some("ldc/ies") => Format::Lm63,
        Some("ldc/iesxml") => Format::Tm33,
        _ => Format::Eulumdat,
    };
    let format = Format::from_content(&bytes).unwrap_or(promised);
    if format == Format::Tm33 && bytes.len() > MAX_XML_BYTES {
        let found = format!("a TM-33 file of {} bytes", bytes.len());
        let expected = format!("no more than {MAX_XML_BYTES} in a container");
        return Err(GldfError::without_place(&part, found, expected));
    }
    let read = match format {
        Format::Eulumdat => read_ldt_of_any_flux(&bytes),
        _ => format.read(&bytes),
    };
    let read = read.map_err(|error| GldfError::in_part(&part, &error))?;
    let Parsed { photometry, mut warnings } = with_tilt(read, &part, archive, told)?;
    let lacks_flux = warnings.iter().any(|it| it.kind() == WarningKind::ZeroLampFlux);
    warnings.retain(|warning| match warning.kind() {
        WarningKind::FluxDiffers => !photometry.has_usual_losses() && !lacks_flux,
        _ => true,
    });
    told.pass_on(&part, warnings);
    Ok(FromFile { photometry, part, declared, lacks_flux })
}

/// The luminaire with the tilt factors that its file names, where they are in the same folder.
fn with_tilt(
    read: Parsed,
    part: &str,
    archive: &mut Archive<'_>,
    told: &mut Told,
) -> Result<Parsed, GldfError> {
    let Tilt::File(name) = &read.photometry.facts().tilt else {
        return Ok(read);
    };
    let folder = part.rsplit_once('/').map_or("", |(folder, _)| folder);
    let Some(tilt_part) = archive.find(&format!("{folder}/{name}"))?.map(str::to_owned) else {
        return Ok(read);
    };
    let bytes = archive.unpack(&tilt_part, MAX_TILT_BYTES)?;
    let tilt = read_tilt(&bytes).map_err(|error| GldfError::in_part(&tilt_part, &error))?;
    told.pass_on(&tilt_part, tilt.warnings);
    let Parsed { photometry, mut warnings } = read;
    warnings.retain(|warning| warning.kind() != WarningKind::TiltFile);
    Ok(Parsed { photometry: photometry.with_tilt(tilt.tilt), warnings })
}

/// The entry of a file in the archive: its name in the folder that its content type begins with.
fn part_of(file: &Element<'_>, archive: &Archive<'_>) -> Result<String, GldfError> {
    let name = file.text().replace('\\', "/");
    let content_type = attribute(file, "contentType").unwrap_or_default();
    let folder = content_type.split('/').next().unwrap_or_default();
    if folder != "ldc" {
        let found = format!("a photometry of the content type {}", in_quotes(content_type));
        return Err(GldfError::at(file, found, "ldc/eulumdat, ldc/ies or ldc/iesxml"));
    }
    let is_elsewhere = attribute(file, "type") == Some("url") || name.contains("://");
    if is_elsewhere {
        let found = format!("a photometry at {}", in_quotes(&name));
        let expected = "a file in the container (nothing is fetched: download it, and name it \
                        instead of the container)";
        return Err(GldfError::at(file, found, expected));
    }
    if name.split('/').any(|folder| folder == "..") {
        let found = format!("a photometry in {}, outside its folder", in_quotes(&name));
        return Err(GldfError::at(file, found, "the name of a file in the container's folder ldc"));
    }
    let candidates = [format!("{folder}/{name}"), name];
    for candidate in &candidates {
        if let Some(part) = archive.find(candidate)? {
            return Ok(part.to_owned());
        }
    }
    let there = archive.files_in("ldc/");
    let found =
        format!("a photometry in {}, which the container has not", in_quotes(&candidates[0]));
    let expected = match there.first() {
        Some(first) => format!(
            "one of its {} files there, such as {} (its maker has to correct the name; the file, \
             unpacked, can be named instead of the container)",
            there.len(),
            in_quotes(first)
        ),
        None => "the file in the container (its folder ldc is empty)".to_owned(),
    };
    Err(GldfError::at(file, found, expected))
}
