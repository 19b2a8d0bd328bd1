//! Luminaire files that make no sense.

use super::{Case, LAMP_IES, check};

#[test]
fn luminaire_files() {
    let lamp = |from: &str, to: &str| {
        assert!(LAMP_IES.contains(from), "no {from} in the file");
        LAMP_IES.replacen(from, to, 1)
    };
    check(
        "photometry",
        &[
            Case::new("missing").remove("lamp.ies").says(&["project.toml:8:14:", "lamp.ies"]),
            Case::new("empty").file("lamp.ies", "").says(&["lamp.ies:1:1:", "expected"]),
            Case::new("binary junk").file("lamp.ies", junk()).says(&["lamp.ies:", "expected"]),
            Case::new("too few numbers")
                .file("lamp.ies", lamp("100 80 20", "100 80"))
                .says(&["lamp.ies:14:", "expected"]),
            Case::new("cut off in the header")
                .file("lamp.ies", &LAMP_IES[..40])
                .says(&["lamp.ies:", "TILT"]),
            Case::new("a word for a number")
                .file("lamp.ies", lamp("100 80 20", "100 eighty 20"))
                .says(&["lamp.ies:14:5:", "eighty"]),
            Case::new("type B with one plane")
                .file("lamp.ies", lamp("1 -1 1 3 1 1 2", "1 -1 1 3 1 2 2"))
                .says(&["lamp.ies:13:1:", "two or more, as types A and B"]),
            Case::new("angles that descend")
                .file("lamp.ies", lamp("0 45 90", "0 90 45"))
                .says(&["lamp.ies:12:", "45"]),
            Case::new("a billion angles")
                .file("lamp.ies", lamp("1 -1 1 3 1 1 2", "1 -1 1 1000000000 1 1 2"))
                .says(&["lamp.ies:1", "expected"]),
            Case::new("EULUMDAT of one line")
                .replace("lamp.ies", "lamp.LDT")
                .file("lamp.LDT", "made-up")
                .says(&["lamp.LDT:2:1:", "the end of the file", "Ityp"]),
            Case::new("XML that is no luminaire")
                .replace("lamp.ies", "lamp.XML")
                .file("lamp.XML", "<?xml version=\"1.0\"?>\n<svg/>\n")
                .says(&["lamp.XML:2:1:", "\"svg\"", "TM-33"]),
            Case::new("TM-33 for plants only")
                .replace("lamp.ies", "lamp.xml")
                .file("lamp.xml", "<IESTM33-22>\n <Emitter><PhotonData/></Emitter></IESTM33-22>")
                .says(&["lamp.xml:2:2:", "PhotonData", "LuminousData"]),
            Case::new("XML with a document type")
                .replace("lamp.ies", "lamp.xml")
                .file("lamp.xml", "<!DOCTYPE a [<!ENTITY b \"&b;&b;\">]>\n<a>&b;</a>\n")
                .says(&["lamp.xml:1:1:", "DOCTYPE"]),
            Case::new("a web page")
                .file("lamp.ies", "<!DOCTYPE html>\n<html><body>not found</body></html>\n")
                .says(&["lamp.ies:1:1:", "a web page", "raw file"]),
            Case::new("neither")
                .replace("lamp.ies", "lamp.png")
                .says(&["project.toml:8:14:", ".ies"]),
        ],
    );
}

fn junk() -> Vec<u8> {
    (0..=255).cycle().take(5000).collect()
}
