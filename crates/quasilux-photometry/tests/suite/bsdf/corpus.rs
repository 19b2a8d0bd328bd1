//! Files of measured surfaces as laboratories and programs publish them.

use quasilux_photometry::bsdf::read_bsdf;

#[test]
fn show() {
    for entry in std::fs::read_dir("/work/shared/data/bsdf").unwrap() {
        let p = entry.unwrap().path();
        if p.is_dir() {
            continue;
        }
        let t = std::time::Instant::now();
        match read_bsdf(&std::fs::read(&p).unwrap()) {
            Ok(r) => {
                println!("{p:?} {:?} {:?}", r.bsdf.facts(), t.elapsed());
                println!("{:#?}", quasilux_photometry::bsdf::BsdfAnalysis::of(&r.bsdf));
                for w in r.warnings {
                    println!("   {w}");
                }
            }
            Err(e) => println!("{p:?} {e}"),
        }
    }
}
