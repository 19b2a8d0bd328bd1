//! Containers of GLDF's own library: which load, and why the others do not.

use super::{close, kinds, read, refused};
use quasilux_photometry::WarningKind;
use std::path::Path;

fn bytes(folder: &Path, name: &str) -> Vec<u8> {
    std::fs::read(folder.join(name)).unwrap()
}

#[test]
fn containers_of_the_reference_library_load_or_say_why_not() {
    let Some(folder) = quasilux_corpus::find("gldf") else { return };
    for (name, reason) in [
        ("GldfWithCodepage850.gldf", "such as \"ldc/Äöü°§.ldt\""),
        ("GldfWithEncodingUtf8.gldf", "such as \"ldc/Äöü°§.ldt\""),
        ("GldfWithFiles.gldf", "a product without variants"),
        ("GldfWithFilesComplete.gldf", "\"variant-1\" (\"Variant name 1\"), \"variant-2\""),
        ("GldfWithHeaderMandatory.gldf", "nothing is fetched"),
        ("GldfWithInvalidRoot.gldf", "a photometry of the content type \"invalid\""),
        ("GldfWithLargeFiles.gldf", "nothing is fetched"),
        ("GldfWithMetaInfo.gldf", "a variant without emitters"),
        ("GldfWithMissingFiles.gldf", "\"ldc/file.ldt\", which the container has not"),
        ("GldfWithMissingProduct.gldf", "no product.xml"),
        ("GldfWithNoFiles.gldf", "nothing is fetched"),
        ("GldfWithOrphanedFiles.gldf", "ldc/file.ldt:1:1: found the end of the file"),
    ] {
        let message = refused(&bytes(&folder, name), &[]);
        assert!(message.contains(reason), "{name}: {message}");
    }
}

#[test]
fn the_complete_container_gives_its_lamp_s_light() {
    let Some(folder) = quasilux_corpus::find("gldf") else { return };
    let bytes = bytes(&folder, "GldfWithFilesComplete.gldf");
    let luminaire = read(&bytes, &["variant=variant-1", "light_source=equipment-1"]);
    // A lamp of 800 lm in a luminaire whose file states an output ratio of 64.25 %.
    let output = luminaire.photometry.flux_lm() / 800.0;
    assert!((output - 0.6425).abs() < 0.002, "{output}");
    assert_eq!(luminaire.photometry.facts().input_watts, 110.0);
    let told = kinds(&luminaire);
    assert!(told.contains(&WarningKind::ContainerFlux), "{told:?}");
    assert_eq!(told.iter().filter(|it| **it == WarningKind::DescriptionDiffers).count(), 5);
    let other = read(&bytes, &["variant=variant-2", "light_source=2"]);
    close(other.photometry.flux_lm(), luminaire.photometry.flux_lm());
    assert_eq!(other.photometry.facts().input_watts, 115.0);
}
