//! The most memory that reading a large file of a measured surface takes, the bytes of the file
//! included, for each format. Files have 200 MB, or as many as the first argument says:
//!
//!     cargo run --release -p quasilux-bsdf --example surface_memory -- 200
//!
//! With a folder as the second argument the files are also written there, for `/usr/bin/time -v
//! quasilux bsdf FILE`.

#[path = "../tests/damage/large.rs"]
mod large;

use quasilux_bsdf::read_bsdf_named;
use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let megabytes = arguments.first().map_or(Ok(200), |text| text.parse::<usize>());
    let Ok(megabytes) = megabytes else {
        eprintln!("usage: surface_memory [MEGABYTES [FOLDER]]");
        return ExitCode::from(2);
    };
    println!("| file | MB | peak, GiB | bytes a byte, without the file |\n|---|---|---|---|");
    for (name, make) in large::KINDS {
        let bytes = make(megabytes * 1_000_000);
        if let Some(folder) = arguments.get(1) {
            std::fs::write(Path::new(folder).join(name), &bytes).expect("a folder to write to");
        }
        let allocated = allocation_counter::measure(|| {
            read_bsdf_named(name, &bytes).expect("a surface");
        });
        let (peak, size) = (allocated.bytes_max as f64, bytes.len() as f64);
        println!(
            "| {name} | {:.1} | {:.2} | {:.1} |",
            size / 1e6,
            (size + peak) / f64::from(1 << 30),
            peak / size,
        );
    }
    ExitCode::SUCCESS
}
