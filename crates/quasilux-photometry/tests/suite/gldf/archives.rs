//! Archives: names and code pages, tricks and bombs, damage, files that are elsewhere.

use super::{close, container, kinds, read, refused};
use crate::container::{Entry, Zip, crc_32, fixed, ldt, photometries, product, simple, variant};
use miniz_oxide::deflate::compress_to_vec;
use quasilux_photometry::WarningKind;

/// A product with the photometry `a.ldt`, as text.
fn text() -> String {
    text_with(&photometries(&["a.ldt"]))
}

fn text_with(files: &str) -> String {
    let lights = fixed("a.ldt", "", "");
    let definitions = format!("{files}<Emitters><Emitter id=\"e\">{lights}</Emitter></Emitters>");
    product(&definitions, &variant("v", "e"))
}

fn with_product(product: &[u8]) -> Vec<u8> {
    let file = ldt(1, 1000.0);
    Zip::default().file("product.xml", product).file("ldc/a.ldt", file.as_bytes()).finish()
}

#[test]
fn products_come_in_several_encodings() {
    let umlaut = text().replace("quasilux tests", "Lüm \u{a7}");
    let utf_16 = |unit: fn(u16) -> [u8; 2], mark: [u8; 2]| {
        mark.into_iter().chain(umlaut.encode_utf16().flat_map(unit)).collect::<Vec<u8>>()
    };
    let undeclared = umlaut.split_once("?>").unwrap().1.trim().to_owned();
    let latin: Vec<u8> = umlaut.chars().map(|c| c as u8).collect();
    let mut dos: Vec<u8> = umlaut.replace("utf-8", "IBM850").into_bytes();
    let at = dos.windows(2).position(|pair| pair == "ü".as_bytes()).unwrap();
    dos.splice(at..at + 2, [0x81]);
    let at = dos.windows(2).position(|pair| pair == "\u{a7}".as_bytes()).unwrap();
    dos.splice(at..at + 2, [0xF5]);
    for bytes in [
        umlaut.clone().into_bytes(),
        [b"\xEF\xBB\xBF", umlaut.as_bytes()].concat(),
        utf_16(u16::to_be_bytes, [0xFE, 0xFF]),
        utf_16(u16::to_le_bytes, [0xFF, 0xFE]),
        latin,
        dos,
        // The mark counts before the declaration, and only a declaration declares.
        [b"\xEF\xBB\xBF", umlaut.replace("utf-8", "IBM850").as_bytes()].concat(),
        undeclared.replace("<Root>", "<Root><!-- not ibm850 -->").into_bytes(),
    ] {
        let luminaire = read(&with_product(&bytes), &[]);
        let is_told = bytes.contains(&0xFC) && bytes.starts_with(b"<");
        assert_eq!(kinds(&luminaire), vec![WarningKind::Encoding; usize::from(is_told)]);
        close(luminaire.photometry.flux_lm(), 1000.0);
        assert_eq!(luminaire.photometry.facts().keyword("MANUFAC"), Some("Lüm \u{a7}"));
        assert_eq!(luminaire.photometry.facts().keyword("LUMINAIRE"), Some("Name of v"));
    }
}

#[test]
fn names_of_entries_come_in_several_code_pages() {
    let file = ldt(1, 1000.0);
    let product = text().replace("a.ldt", "Äöü§.ldt");
    let dos: &[u8] = b"ldc/\x8e\x94\x81\xf5.ldt";
    let utf_8 = "ldc/Äöü§.ldt".as_bytes();
    // The extra field 0x7075: version, CRC-32 of the name in the header, the name.
    let unicode = |crc: u32| {
        let data = [&[1], &crc.to_le_bytes()[..], utf_8].concat();
        [&0x7075_u16.to_le_bytes()[..], &(data.len() as u16).to_le_bytes(), &data].concat()
    };
    let own = unicode(crc_32(b"ldc/?.ldt"));
    let of_another = unicode(1);
    for (name, flags, extra) in [
        (utf_8, 1 << 11, &[][..]),
        (utf_8, 0, &[]),
        (dos, 0, &[]),
        (b"ldc/?.ldt", 0, &own),
        (dos, 0, &of_another),
        (b"LDC/\x8e\x94\x81\xf5.LDT", 0, &[]),
        (b"ldc\\\x8e\x94\x81\xf5.ldt", 0, &[]),
        (b"./ldc/\x8e\x94\x81\xf5.ldt", 0, &[]),
    ] {
        let entry = Entry { flags, extra, ..Entry::stored(name, file.as_bytes()) };
        let bytes = Zip::default().file("Product.XML", product.as_bytes()).with(&entry).finish();
        close(read(&bytes, &[]).photometry.flux_lm(), 1000.0);
    }
}

#[test]
fn deflated_entries_are_read_and_damaged_ones_refused() {
    let file = ldt(1, 1000.0);
    let text = text();
    let packed = compress_to_vec(file.as_bytes(), 9);
    let good = Entry { packed: &packed, method: 8, ..Entry::stored(b"ldc/a.ldt", file.as_bytes()) };
    let bytes_of = |entry: &Entry<'_>| {
        Zip::default().file("product.xml", text.as_bytes()).with(entry).finish()
    };
    close(read(&bytes_of(&good), &[]).photometry.flux_lm(), 1000.0);
    let cut = &packed[..packed.len() / 2];
    for (entry, expected) in [
        (Entry { crc: good.crc ^ 1, ..good }, "another length or check sum"),
        (Entry { size: good.size + 1, ..good }, "another length or check sum"),
        (Entry { packed: cut, ..good }, "damaged compressed data"),
        (Entry { method: 12, ..good }, "the compression method 12"),
        (Entry { flags: 1, ..good }, "an encrypted entry"),
    ] {
        let message = refused(&bytes_of(&entry), &[]);
        assert!(message.contains(expected) && message.starts_with("ldc/a.ldt: "), "{message}");
    }
    let bytes = bytes_of(&good);
    for length in (0..bytes.len()).step_by(7) {
        refused(&bytes[..length], &[]);
    }
}

#[test]
fn bombs_are_not_unpacked() {
    let zeros = vec![b' '; 40 << 20];
    let bomb = compress_to_vec(&zeros, 6);
    let entry =
        |name: &'static [u8], packed| Entry { packed, method: 8, ..Entry::stored(name, &zeros) };
    let text = text();
    let of_file = Zip::default()
        .file("product.xml", text.as_bytes())
        .with(&entry(b"ldc/a.ldt", &bomb))
        .finish();
    let file = ldt(1, 1000.0);
    let of_product = Zip::default()
        .with(&entry(b"product.xml", &bomb))
        .file("ldc/a.ldt", file.as_bytes())
        .finish();
    for bytes in [of_file, of_product] {
        let mut message = String::new();
        let allocated = allocation_counter::measure(|| message = refused(&bytes, &[]));
        assert!(message.contains("bytes; expected a file of a usual size"), "{message}");
        // Nothing like the 40 MiB: room for bytes that double as they grow.
        assert!(allocated.bytes_max < 24 << 20, "{} bytes", allocated.bytes_max);
    }
    // It harms nobody where it is not read.
    let beside = Zip::default()
        .file("product.xml", text.as_bytes())
        .file("ldc/a.ldt", file.as_bytes())
        .with(&entry(b"geo/model.l3d", &bomb))
        .finish();
    close(read(&beside, &[]).photometry.flux_lm(), 1000.0);
    let many = (0..10_001).fold(Zip::default(), |zip, i| zip.file(&format!("other/{i}"), b""));
    assert!(refused(&many.finish(), &[]).contains("no more than 10000 entries"));
    let deep = "<a>".repeat(100_000);
    assert!(refused(&with_product(deep.as_bytes()), &[]).contains("64 levels"));
    let entities = "<!DOCTYPE a [<!ENTITY b \"c\">]><Root>&b;</Root>";
    assert!(refused(&with_product(entities.as_bytes()), &[]).contains("DOCTYPE"));
}

#[test]
fn tricks_with_names_are_refused() {
    let file = ldt(1, 1000.0);
    for name in ["../a.ldt", "ldc/../../b", "/etc/passwd", "C:/a", "c:a", "..\\a", "a\nb"] {
        let bytes = Zip::default()
            .file("product.xml", text().as_bytes())
            .file("ldc/a.ldt", file.as_bytes())
            .file(name, b"x")
            .finish();
        let message = refused(&bytes, &[]);
        assert!(message.contains("names inside the container"), "{name:?}: {message}");
    }
    let twice = Zip::default()
        .file("product.xml", text().as_bytes())
        .file("ldc/a.ldt", file.as_bytes())
        .file("ldc/a.ldt", ldt(1, 2000.0).as_bytes())
        .finish();
    assert!(refused(&twice, &[]).contains("two entries with the name \"ldc/a.ldt\""));
    // A file of the product leads nowhere either.
    let climbs = text_with(&photometries(&["a.ldt"]).replace(">a.ldt<", ">../a.ldt<"));
    let message = refused(&with_product(climbs.as_bytes()), &[]);
    assert!(message.contains("outside its folder"), "{message}");
    // Nor is the file of that name in another folder meant.
    let elsewhere = text_with(&photometries(&["a.ldt"]).replace(">a.ldt<", ">warm/a.ldt<"));
    let message = refused(&with_product(elsewhere.as_bytes()), &[]);
    assert!(message.contains("\"ldc/warm/a.ldt\", which the container has not"), "{message}");
    let absolute = text_with(&photometries(&["a.ldt"]).replace(">a.ldt<", ">/etc/passwd<"));
    assert!(refused(&with_product(absolute.as_bytes()), &[]).contains("the container has not"));
}

#[test]
fn files_that_are_not_in_the_container_are_refused() {
    let files = photometries(&["a.ldt"]);
    let url = files.replace("localFileName", "url").replace(">a.ldt<", ">https://x.org/a.ldt<");
    let message = refused(&with_product(text_with(&url).as_bytes()), &[]);
    assert!(message.contains("https://x.org/a.ldt") && message.contains("nothing is fetched"));
    let other = files.replace(">a.ldt<", ">b.ldt<");
    let message = refused(&with_product(text_with(&other).as_bytes()), &[]);
    assert!(message.contains("one of its 1 files there, such as \"ldc/a.ldt\""), "{message}");
    let picture = files.replace("ldc/eulumdat", "image/png");
    let message = refused(&with_product(text_with(&picture).as_bytes()), &[]);
    assert!(message.contains("the content type \"image/png\""), "{message}");
    let dangling = files.replace("fileId=\"f-a.ldt\"", "fileId=\"none\"");
    let message = refused(&with_product(text_with(&dangling).as_bytes()), &[]);
    assert!(message.contains("a reference to \"none\"; expected File that is"), "{message}");
    let message = refused(&simple("a.ldt", "1\n2\n3\n", ""), &[]);
    assert!(message.starts_with("ldc/a.ldt:"), "{message}");
    assert!(refused(&container("", ""), &[]).starts_with("product.xml:"));
    assert!(refused(&Zip::default().finish(), &[]).contains("no product.xml"));
    assert!(refused(b"PK\x03\x04", &[]).contains("a zip archive"));
    assert!(refused(b"maker\n1\n", &[]).contains("a zip archive"));
    let root = with_product(b"<Luminaire/>");
    assert!(refused(&root, &[]).contains("the root element \"Luminaire\""));
}

#[test]
fn names_that_differ_in_capitals_alone_are_no_choice() {
    let entries = |names: [&str; 2]| {
        let zip = Zip::default().file("product.xml", text().as_bytes());
        let add = |zip: Zip, name: &str| zip.file(name, ldt(1, 1000.0).as_bytes());
        names.into_iter().fold(zip, add).finish()
    };
    let message = refused(&entries(["ldc/A.ldt", "LDC/a.ldt"]), &[]);
    assert!(message.contains("the entries \"ldc/A.ldt\" and \"LDC/a.ldt\""), "{message}");
    close(read(&entries(["ldc/A.ldt", "ldc/a.ldt"]), &[]).photometry.flux_lm(), 1000.0);
}

#[test]
fn folders_are_entries_and_long_names_are_refused() {
    let zip = |name: &str| {
        let zip = Zip::default().file(name, b"").file("product.xml", text().as_bytes());
        zip.file("ldc/a.ldt", ldt(1, 1000.0).as_bytes()).finish()
    };
    for name in ["./", ".\\", "ldc/", "./ldc/", &format!("other/{}", "x".repeat(1018))] {
        close(read(&zip(name), &[]).photometry.flux_lm(), 1000.0);
    }
    let message = refused(&zip(&format!("other/{}", "x".repeat(1019))), &[]);
    assert!(message.contains("a name of 1025 bytes; expected no more than 1024"), "{message}");
    let extra = [&[1], &crc_32(b"a").to_le_bytes()[..], "y".repeat(60_000).as_bytes()].concat();
    let length = (extra.len() as u16).to_le_bytes();
    let extra = [&0x7075_u16.to_le_bytes()[..], &length, &extra].concat();
    let entry = Entry { extra: &extra, ..Entry::stored(b"a", b"") };
    let bytes = Zip::default()
        .file("product.xml", text().as_bytes())
        .file("ldc/a.ldt", ldt(1, 1000.0).as_bytes())
        .with(&entry)
        .finish();
    // Its name is the short one.
    close(read(&bytes, &[]).photometry.flux_lm(), 1000.0);
}

#[test]
fn trees_of_xml_in_a_container_are_bounded() {
    // 3 MiB of elements, stored: their tree takes more than 30 times that.
    let xml = format!("<IESTM33-22>{}</IESTM33-22>", "<a/>".repeat(800_000));
    let text = text().replace("ldc/eulumdat", "ldc/iesxml");
    let of_file = Zip::default().file("product.xml", text.as_bytes());
    let of_file = of_file.file("ldc/a.ldt", xml.as_bytes()).finish();
    let of_product = Zip::default().file("product.xml", xml.as_bytes()).finish();
    for bytes in [of_file, of_product] {
        let mut message = String::new();
        let allocated = allocation_counter::measure(|| message = refused(&bytes, &[]));
        assert!(message.contains("bytes; expected"), "{message}");
        assert!(allocated.bytes_max < 12 << 20, "{} bytes: {message}", allocated.bytes_max);
    }
}

#[test]
fn sizes_that_lie_and_data_descriptors_do_not_mislead() {
    let file = ldt(1, 1000.0);
    let good = Entry::stored(b"ldc/a.ldt", file.as_bytes());
    let bytes_of = |entry: &Entry<'_>| {
        Zip::default().file("product.xml", text().as_bytes()).with(entry).finish()
    };
    // The size is in the data descriptor, which this one has not; the central directory counts.
    close(read(&bytes_of(&Entry { flags: 8, ..good }), &[]).photometry.flux_lm(), 1000.0);
    for size in [0, 1, u32::MAX] {
        refused(&bytes_of(&Entry { size, ..good }), &[]);
    }
    // Two entries over the same bytes are two files.
    let both = Zip::default().file("product.xml", text().as_bytes()).with(&good).finish();
    let at = both.windows(4).rposition(|four| four == b"PK\x01\x02").unwrap();
    let mut overlapping = both.clone();
    overlapping.splice(at + 42..at + 46, [0; 4]);
    refused(&overlapping, &[]);
}
