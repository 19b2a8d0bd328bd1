//! Glazing products: small undamaged files, and what must hold of the reader's answer to any bytes.

use super::published;
use quasilux_bsdf::{Glazing, GlazingLayer, SheetShares, read_glazing};
use quasilux_stats::damage::{Outcome, Seeds, check_message};
use std::sync::Arc;

/// What the documentation of the reader states: bytes for each byte of a file, and besides.
const BYTES_PER_BYTE: usize = 8;
const BYTES_BESIDES: usize = 4 << 20;

/// A file of each interface.
pub(crate) fn samples() -> Seeds {
    let line = |nm: f64| {
        let um = nm / 1000.0;
        format!("{{\"T\": 0.7, \"Rf\": 0.08, \"Rb\": 0.08, \"wavelength\": {um}}}")
    };
    let block = |nm: f64| {
        let um = nm / 1000.0;
        let shares = "\"tf\": \"0.5\", \"tb\": \"0.5\", \"rf\": \"0.1\", \"rb\": \"0.2\"";
        format!("{{\"w\": \"{um}\", \"specular\": {{{shares}}}}}")
    };
    let list =
        |line: &dyn Fn(f64) -> String| [300.0, 380.0, 550.0, 700.0, 900.0].map(line).join(",\n");
    let first = format!(
        "{{\"name\": \"a\", \"type\": \"glazing\", \"subtype\": \"monolithic\", \"coated_side\": \
         \"Neither\", \"coating_name\": null, \"measured_data\": {{\"is_specular\": true}},\n\
         \"integrated_results_summary\": [{{\"tfvis\": 0.7, \"rfvis\": 0.08, \"rbvis\": null}}],\n\
         \"spectral_data\": {{\"spectral_data\": [{}]}}}}\n",
        list(&line)
    );
    let second = format!(
        "{{\"type\": \"GLAZING\", \"product_description\": {{\"name\": \"b\"}}, \
         \"physical_properties\": {{\"is_specular\": true, \"optical_properties\": {{\n\
         \"optical_data\": {{\"angle_blocks\": [{{\"incidence_angle\": 0, \"wavelength_data\": \
         [{}]}}]}}}}}}}}\n",
        list(&block)
    );
    Seeds::new(vec![first.into_bytes(), second.into_bytes()])
}

/// The same with the published files; without them where `QUASILUX_CORPUS=none` says so.
pub(crate) fn seeds() -> Seeds {
    let folder = quasilux_corpus::find("daylight");
    samples().with_files(folder.map_or_else(Vec::new, |folder| published(&folder, "json")))
}

/// Reads any bytes and checks the answer: no more memory than stated, messages with a position in
/// the file, and shares of light within 0 to 1 that make none.
pub(crate) fn examine(bytes: &[u8]) -> Outcome {
    let mut answer = None;
    let allocated = allocation_counter::measure(|| answer = Some(read_glazing(bytes)));
    let answer = answer.expect("the reader was called");
    let peak_bytes = allocated.bytes_max as usize;
    let max = BYTES_PER_BYTE * bytes.len() + BYTES_BESIDES;
    assert!(peak_bytes <= max, "{peak_bytes} bytes for a file of {}, over {max}", bytes.len());
    let is_read = answer.is_ok();
    match answer {
        Ok(read) => {
            for warning in &read.warnings {
                check_message(warning.line(), warning.column(), &warning.to_string(), bytes);
            }
            let product = Arc::new(read.product);
            let layer = |is_flipped| GlazingLayer { product: Arc::clone(&product), is_flipped };
            for layers in [vec![layer(false)], vec![layer(false), layer(true), layer(true)]] {
                let glazing = Glazing::new(layers);
                for cos in [0.0, 1e-9, 0.01, 0.3, 0.8, 1.0] {
                    check_shares(glazing.visible(cos));
                }
            }
        }
        Err(error) => check_message(error.line(), error.column(), &error.to_string(), bytes),
    }
    Outcome { is_read, peak_bytes }
}

fn check_shares(shares: SheetShares) {
    let SheetShares { transmittance, front_reflectance, back_reflectance } = shares;
    for share in [transmittance, front_reflectance, back_reflectance] {
        assert!((0.0..=1.0).contains(&share), "{shares:?}");
    }
    assert!(transmittance + front_reflectance.max(back_reflectance) <= 1.0, "{shares:?}");
}
