//! Which program this is: no run is finished by other code than began it.

/// Its version.
pub(crate) const VERSION: &str = env!("CARGO_PKG_VERSION");
/// The first 16 digits of the fingerprint of all code that decides results (`build/fingerprint/`).
pub(crate) const BUILD: &str = env!("QUASILUX_BUILD");

/// The first digits of the commit that the sources are of, or `unknown`.
pub(crate) const COMMIT: &str = env!("QUASILUX_COMMIT");

/// Refuses another version, and another build of the same.
pub(crate) fn expect(version: &str, build: &str) -> Result<(), String> {
    if version != VERSION {
        return Err(format!("was made by version {version}, and this is {VERSION}"));
    }
    if build != BUILD {
        return Err(format!(
            "was made by another build of version {VERSION}, {build}, and this is {BUILD}: \
             results may differ"
        ));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn others_are_refused() {
        assert_eq!(expect(VERSION, BUILD), Ok(()));
        assert!(BUILD.len() == 16 && BUILD.bytes().all(|digit| digit.is_ascii_hexdigit()));
        assert!(expect("9.0.0", BUILD).unwrap_err().contains("version 9.0.0"));
        assert!(expect(VERSION, "0123456789abcdef").unwrap_err().contains("build"));
    }
}
