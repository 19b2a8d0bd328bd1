//! EULUMDAT files as manufacturers and other programs publish them.

use crate::corpus::{name, published_files_of};
use quasilux_photometry::read_ldt;

#[test]
fn published_eulumdat_files_load() {
    let Some(files) = published_files_of("ldt") else {
        return;
    };
    for file in &files {
        let name = name(file);
        // None is refused: each follows the format, or deviates by a documented rule.
        let read = read_ldt(&std::fs::read(file).unwrap());
        assert!(read.is_ok(), "{name}:{read:?}");
    }
    println!("{} published EULUMDAT files load, none is refused", files.len());
    assert!(files.len() > 70);
}
