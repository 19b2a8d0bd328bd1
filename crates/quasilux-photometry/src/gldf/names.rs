//! Names of the entries of a zip archive: their code page, and which ones are tricks.
//!
//! An entry without the flag for UTF-8 has a name in the code page of the system that wrote it.
//! As GLDF's own library does, bytes that are no UTF-8 are read as code page 850. The extra field
//! 0x7075 (APPNOTE.TXT 6.3.9, section 4.6.9) has the name in UTF-8 where it was made for these
//! bytes.

use rawzip::ZipFileHeaderRecord;

/// Identifier of the extra field with the name in UTF-8.
const UNICODE_PATH: u16 = 0x7075;

/// Bytes that a name may have; paths are shorter.
pub(super) const MAX_NAME_BYTES: usize = 1024;

/// Characters 0x80 to 0xFF of code page 850 (Unicode Consortium, CP850.TXT).
const CODE_PAGE_850: &str = "ÇüéâäàåçêëèïîìÄÅÉæÆôöòûùÿÖÜø£Ø×ƒáíóúñÑªº¿®¬½¼¡«»░▒▓│┤ÁÂÀ©╣║╗╝¢¥┐\
    └┴┬├─┼ãÃ╚╔╩╦╠═╬¤ðÐÊËÈıÍÎÏ┘┌█▄¦Ì▀ÓßÔÒõÕµþÞÚÛÙýÝ¯´\u{ad}±‗¾¶§÷¸°¨·¹³²■\u{a0}";

/// The name of an entry, with forward slashes and without `./`; `.` for the root folder.
pub(super) fn name_of(entry: &ZipFileHeaderRecord<'_>) -> String {
    let raw = entry.file_path().as_bytes();
    let name = unicode_path(entry, raw)
        .or_else(|| std::str::from_utf8(raw).ok().map(str::to_owned))
        .unwrap_or_else(|| from_code_page_850(raw));
    let name = name.replace('\\', "/");
    match name.trim_start_matches("./") {
        "" if name.starts_with("./") => ".".to_owned(),
        name => name.to_owned(),
    }
}

/// The name in UTF-8 that an extra field gives for these bytes: version 1, CRC-32 of the bytes,
/// the name.
fn unicode_path(entry: &ZipFileHeaderRecord<'_>, raw: &[u8]) -> Option<String> {
    let mut fields = entry.extra_fields();
    let (_, data) = fields.find(|(id, _)| id.as_u16() == UNICODE_PATH)?;
    let (&version, rest) = data.split_first()?;
    let (crc, name) = rest.split_first_chunk::<4>()?;
    let is_short = name.len() <= MAX_NAME_BYTES;
    let is_of_these = is_short && version == 1 && u32::from_le_bytes(*crc) == rawzip::crc32(raw);
    is_of_these.then(|| std::str::from_utf8(name).ok().map(str::to_owned)).flatten()
}

/// Text of code page 850.
pub(super) fn from_code_page_850(bytes: &[u8]) -> String {
    let high: Vec<char> = CODE_PAGE_850.chars().collect();
    let character = |&byte: &u8| match byte {
        0..0x80 => char::from(byte),
        _ => high.get(usize::from(byte - 0x80)).copied().unwrap_or(char::REPLACEMENT_CHARACTER),
    };
    bytes.iter().map(character).collect()
}

/// Whether a name is that of the folder which all entries lie in.
pub(super) fn is_root(name: &str) -> bool {
    name == "."
}

/// Whether a name would lead out of the folder that an archive is unpacked to, or is none.
pub(super) fn is_trick(name: &str) -> bool {
    let has_drive = name.as_bytes().get(1) == Some(&b':');
    let climbs = name.split('/').any(|part| part == "..");
    name.is_empty()
        || name.starts_with('/')
        || has_drive
        || climbs
        || name.chars().any(char::is_control)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn code_page_850_has_all_characters() {
        assert_eq!(CODE_PAGE_850.chars().count(), 128);
        assert_eq!(from_code_page_850(b"ldc/\x8e\x94\x81\xf8\xf5.ldt"), "ldc/Äöü°§.ldt");
        assert_eq!(from_code_page_850(b"\x80\xe1\xff"), "Çß\u{a0}");
    }

    #[test]
    fn names_that_lead_elsewhere_are_tricks() {
        for name in ["../a", "ldc/../../a", "/etc/a", "C:/a", "c:a", "", "a\0b", ".."] {
            assert!(is_trick(name), "{name:?}");
        }
        for name in ["product.xml", "ldc/a.ldt", "ldc/a..b.ldt", "ldc/", "other/custom file 1.txt"]
        {
            assert!(!is_trick(name), "{name:?}");
        }
    }
}
