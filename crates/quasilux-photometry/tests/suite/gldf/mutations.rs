//! Any bytes in a container give a luminaire or an error, in memory bounded by their number.

use super::choice;
use crate::container::{Zip, fixed, ies, ldt, photometries, product, variant};
use quasilux_photometry::{GldfChoice, max_read_memory_bytes, read_gldf};
use quasilux_stats::damage::{Outcome, Outcomes, Seeds, examine_damaged};
use quasilux_stats::deep;

/// Damaged files of each kind: what one in 1000 does is found in 19 of 20 choices of them, in the
/// deep variant, a million of them together, one in 83 000.
fn files() -> u64 {
    if deep() { 250_000 } else { 3_000 }
}

/// The most memory for a container of that size whose entries are stored: what a file of its size
/// may take, and an entry of 1 MiB that damage makes a deflated one, in a list that doubles.
fn max_bytes(file_bytes: usize) -> usize {
    max_read_memory_bytes(file_bytes) + (3 << 20)
}

fn examine(bytes: &[u8], choice: &GldfChoice) -> Outcome {
    let mut answer = None;
    let allocated = allocation_counter::measure(|| answer = Some(read_gldf(bytes, choice)));
    let peak_bytes = allocated.bytes_max as usize;
    assert!(peak_bytes <= max_bytes(bytes.len()), "{peak_bytes} for {}", bytes.len());
    let answer = answer.expect("the reader was called");
    match &answer {
        Ok(read) => {
            let flux_lm = read.photometry.flux_lm();
            assert!(flux_lm.is_finite() && flux_lm >= 0.0, "{flux_lm} lm");
            let turn = read.luminaire_from_photometry;
            assert!((turn.determinant() - 1.0).abs() < 1e-9, "{turn}");
        }
        Err(error) => assert!(!error.to_string().contains('\n'), "{error}"),
    }
    Outcome { is_read: answer.is_ok(), peak_bytes }
}

fn text() -> String {
    let light = fixed(
        "a.ldt",
        "<Rotation><X>90</X><G0>5</G0></Rotation><LightSourceReference fixedLightSourceId=\"s\"/>\
         <RatedLuminousFlux>900</RatedLuminousFlux>",
        "emergencyBehaviour=\"Combined\"",
    );
    let definitions = photometries(&["a.ldt", "b.ies"])
        + "<LightSources><FixedLightSource id=\"s\"><RatedInputPower>9</RatedInputPower>\
           </FixedLightSource><MultiChannelLightSource id=\"m\"><Channels><Channel>\
           <PhotometryReference photometryId=\"a.ldt\"/><RatedLuminousFlux>5</RatedLuminousFlux>\
           </Channel><Channel><PhotometryReference photometryId=\"b.ies\"/></Channel></Channels>\
           </MultiChannelLightSource></LightSources>"
        + &format!(
            "<Emitters><Emitter id=\"e\">{light}</Emitter><Emitter id=\"f\">\
             <MultiChannelLightEmitter><LightSourceReference multiChannelLightSourceId=\"m\"/>\
             </MultiChannelLightEmitter></Emitter></Emitters><Geometries><SimpleGeometry id=\"g\">\
             <CircularEmitter><Diameter>90</Diameter></CircularEmitter></SimpleGeometry>\
             </Geometries>"
        );
    let variants = "<Variant id=\"w\"><Geometry><SimpleGeometryReference geometryId=\"g\" \
        emitterId=\"e\"/></Geometry></Variant>";
    product(&definitions, &(variant("v", "f") + variants))
}

fn packed(product: &[u8]) -> Vec<u8> {
    Zip::default()
        .file("product.xml", product)
        .file("ldc/a.ldt", ldt(1, 1000.0).as_bytes())
        .file("ldc/b.ies", ies(2, 500.0).as_bytes())
        .finish()
}

#[test]
fn damaged_containers_never_panic() {
    let choices = [choice(&["variant=v"]), choice(&["variant=w"])];
    let archives = Seeds::new(vec![packed(text().as_bytes())]);
    let products = Seeds::new(vec![text().into_bytes()]);
    for choice in &choices {
        assert!(examine(&archives.files()[0], choice).is_read);
        let Outcomes { read, .. } =
            examine_damaged(&archives, 0..files(), |bytes| examine(bytes, choice));
        println!("{read} of {} damaged archives load", files());
        // Check sums find most of the damage; in the text of a product it goes further.
        let damaged = |bytes: &[u8]| examine(&packed(bytes), choice);
        let Outcomes { read, .. } = examine_damaged(&products, 0..files(), damaged);
        println!("{read} of {} damaged products load", files());
        assert!(read > files() / 20 && read < files() - files() / 20, "{read} load");
    }
}
