//! GLDF containers for tests: a zip archive written byte by byte, and the pieces of a product.
//!
//! It shares no code with the reader: what is wrong with an archive can be written as well.

/// A zip archive that is being written (APPNOTE.TXT 6.3.9, sections 4.3.7 and 4.3.12).
#[derive(Default)]
pub(crate) struct Zip {
    bytes: Vec<u8>,
    directory: Vec<u8>,
    entries: u16,
}

/// An entry, as its headers are to claim it.
pub(crate) struct Entry<'a> {
    pub(crate) name: &'a [u8],
    pub(crate) packed: &'a [u8],
    pub(crate) method: u16,
    pub(crate) flags: u16,
    pub(crate) crc: u32,
    pub(crate) size: u32,
    pub(crate) extra: &'a [u8],
}

impl<'a> Entry<'a> {
    /// A stored entry with a name in UTF-8.
    pub(crate) fn stored(name: &'a [u8], data: &'a [u8]) -> Self {
        let (crc, size) = (crc_32(data), data.len() as u32);
        Self { name, packed: data, method: 0, flags: 1 << 11, crc, size, extra: &[] }
    }
}

impl Zip {
    pub(crate) fn file(mut self, name: &str, data: &[u8]) -> Self {
        self.add(&Entry::stored(name.as_bytes(), data));
        self
    }

    pub(crate) fn with(mut self, entry: &Entry<'_>) -> Self {
        self.add(entry);
        self
    }

    fn add(&mut self, entry: &Entry<'_>) {
        let offset = self.bytes.len() as u32;
        let mut common = Vec::new();
        for value in [20, entry.flags, entry.method, 0, 0] {
            common.extend(value.to_le_bytes());
        }
        for value in [entry.crc, entry.packed.len() as u32, entry.size] {
            common.extend(value.to_le_bytes());
        }
        common.extend((entry.name.len() as u16).to_le_bytes());
        common.extend((entry.extra.len() as u16).to_le_bytes());
        self.bytes.extend(b"PK\x03\x04");
        self.bytes.extend(&common);
        self.bytes.extend([entry.name, entry.extra, entry.packed].concat());
        self.directory.extend(b"PK\x01\x02\x14\x00");
        self.directory.extend(&common);
        self.directory.extend([0; 10]);
        self.directory.extend(offset.to_le_bytes());
        self.directory.extend([entry.name, entry.extra].concat());
        self.entries = self.entries.wrapping_add(1);
    }

    pub(crate) fn finish(self) -> Vec<u8> {
        let Self { mut bytes, directory, entries } = self;
        let offset = bytes.len() as u32;
        bytes.extend(&directory);
        bytes.extend(b"PK\x05\x06\0\0\0\0");
        bytes.extend(entries.to_le_bytes());
        bytes.extend(entries.to_le_bytes());
        bytes.extend((directory.len() as u32).to_le_bytes());
        bytes.extend(offset.to_le_bytes());
        bytes.extend([0, 0]);
        bytes
    }
}

/// CRC-32 (ISO 3309), bit by bit.
pub(crate) fn crc_32(data: &[u8]) -> u32 {
    let mut crc = u32::MAX;
    for byte in data {
        crc ^= u32::from(*byte);
        for _ in 0..8 {
            crc = if crc & 1 == 1 { (crc >> 1) ^ 0xEDB8_8320 } else { crc >> 1 };
        }
    }
    !crc
}

/// The text of a product with these definitions and variants.
pub(crate) fn product(definitions: &str, variants: &str) -> String {
    format!(
        "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<Root>\n<Header><Manufacturer>quasilux tests\
         </Manufacturer><FormatVersion major=\"1\" minor=\"0\" pre-release=\"3\"/></Header>\n\
         <GeneralDefinitions>{definitions}</GeneralDefinitions>\n<ProductDefinitions>\
         <ProductMetaData><ProductNumber><Locale language=\"en\">T 1</Locale></ProductNumber>\
         <Name><Locale language=\"de\">Leuchte</Locale><Locale language=\"en\">Luminaire</Locale>\
         </Name></ProductMetaData>\n<Variants>{variants}</Variants></ProductDefinitions>\n</Root>"
    )
}

/// Files and a photometry for each: `a.ldt` has the photometry `a.ldt`.
pub(crate) fn photometries(files: &[&str]) -> String {
    let kind = |name: &str| match name.rsplit_once('.') {
        Some((_, "ies")) => "ies",
        Some((_, "xml")) => "iesxml",
        _ => "eulumdat",
    };
    let file = |name: &&str| {
        let kind = kind(name);
        format!(
            "<File id=\"f-{name}\" contentType=\"ldc/{kind}\" type=\"localFileName\">{name}</File>"
        )
    };
    let photometry = |name: &&str| {
        format!(
            "<Photometry id=\"{name}\"><PhotometryFileReference fileId=\"f-{name}\"/></Photometry>"
        )
    };
    let files_text: String = files.iter().map(file).collect();
    let photometries: String = files.iter().map(photometry).collect();
    format!("<Files>{files_text}</Files><Photometries>{photometries}</Photometries>")
}

/// A variant with one emitter.
pub(crate) fn variant(id: &str, emitter: &str) -> String {
    format!(
        "<Variant id=\"{id}\"><Name><Locale language=\"en\">Name of {id}</Locale></Name><Geometry>\
         <EmitterReference emitterId=\"{emitter}\"/></Geometry></Variant>"
    )
}

/// A fixed light emitter: a photometry, more of its elements, and attributes.
pub(crate) fn fixed(photometry: &str, more: &str, attributes: &str) -> String {
    format!(
        "<FixedLightEmitter {attributes}><PhotometryReference photometryId=\"{photometry}\"/>{more}\
         </FixedLightEmitter>"
    )
}

/// An EULUMDAT file, rotationally symmetric, with a luminous area of 1200 mm by 100 mm: lamps of
/// `flux_lm` together, `count` of them (negative: absolute), from which all light leaves downward.
pub(crate) fn ldt(count: i32, flux_lm: f64) -> String {
    // 1000 lm spread as I0 (1 - gamma / 90 degrees) over the lower half.
    let i0 = 1000.0 / (2.0 * std::f64::consts::PI * (1.0 - 2.0 / std::f64::consts::PI));
    format!(
        "maker\n2\n1\n1\n0\n3\n90\nreport\nlamp\nnumber\nfile\ndate\n1210\n110\n50\n1200\n100\n0\n\
         0\n0\n0\n100\n100\n1\n0\n1\n{count}\nled\n{flux_lm}\n3000\n80\n20\n{}0\n0\n90\n180\n{i0}\n\
         0\n0\n",
        "0\n".repeat(10)
    )
}

/// An LM-63 file that shines along C0 more than along C90, with a luminous opening of 0.1 m
/// (C90) by 1.2 m (C0): `lumens` of one lamp, -1 for absolute photometry.
pub(crate) fn ies(lamps: u32, lumens: f64) -> String {
    format!(
        "IESNA:LM-63-2002\n[TEST] made up\nTILT=NONE\n{lamps} {lumens} 1 3 3 1 2 0.1 1.2 0\n\
         1 1 30\n0 45 90\n0 90 180\n300 250 0\n300 150 0\n300 100 0\n"
    )
}

/// The text of a product with one emitter of one fixed light emitter.
pub(crate) fn simple_product(file: &str, more: &str) -> String {
    let emitters = fixed(file, more, "");
    let definitions = photometries(&[file])
        + &format!("<Emitters><Emitter id=\"e\">{emitters}</Emitter></Emitters>");
    product(&definitions, &variant("v", "e"))
}

/// A container with a photometric file and the text of a product.
pub(crate) fn packed(product: &str, file: &str, content: &str) -> Vec<u8> {
    let name = format!("ldc/{file}");
    let zip = Zip::default().file("product.xml", product.as_bytes());
    zip.file(&name, content.as_bytes()).finish()
}

/// A container with one emitter of one fixed light emitter.
pub(crate) fn simple(file: &str, content: &str, more: &str) -> Vec<u8> {
    packed(&simple_product(file, more), file, content)
}
