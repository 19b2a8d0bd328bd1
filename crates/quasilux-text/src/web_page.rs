//! Web pages that were saved in place of the file that they show.

use crate::{ParseError, Position};

/// A web page says what it is within this many bytes.
const SEARCHED: usize = 1024;

/// Refuses a web page: what is saved from the page about a file is that page, whatever its name.
///
/// # Errors
/// For HTML.
pub fn refuse_web_page(bytes: &[u8]) -> Result<(), ParseError> {
    let start = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes).trim_ascii_start();
    let start = start[..start.len().min(SEARCHED)].to_ascii_lowercase();
    let is_html = start.starts_with(b"<!doctype html")
        || [&b"<html>"[..], b"<html ", b"<html\n"].iter().any(|tag| start.starts_with(tag))
        || start.starts_with(b"<?xml") && start.windows(5).any(|part| part == b"<html");
    if is_html {
        let expected = "the file itself, without the page that shows it (save the raw file)";
        return Err(ParseError::new(Position::START, "a web page (HTML)", expected));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pages_are_told_from_files() {
        for page in [
            "<!DOCTYPE html>\n<html><body>not found</body></html>",
            "\u{FEFF}\n <!doctype HTML PUBLIC \"-//W3C//DTD HTML 4.01//EN\">",
            "<HTML lang=\"en\">",
            "<?xml version=\"1.0\"?>\n<!DOCTYPE html PUBLIC \"x\">\n<html xmlns=\"y\">",
        ] {
            assert!(refuse_web_page(page.as_bytes()).is_err(), "{page}");
        }
        for file in
            ["", "IESNA:LM-63-2002\n", "<?xml version=\"1.0\"?>\n<IESTM33-22>", "<html5>", "<"]
        {
            assert!(refuse_web_page(file.as_bytes()).is_ok(), "{file}");
        }
    }
}
