//! Buffers written into a URI: base64 (RFC 4648, section 4) in a data URI (RFC 2397).

use base64::DecodeError;
use base64::alphabet::STANDARD;
use base64::engine::{DecodePaddingMode, Engine, GeneralPurpose, GeneralPurposeConfig};

/// Padding may be missing, and bits after the last byte are ignored, as by other readers of glTF.
const BASE64: GeneralPurpose = GeneralPurpose::new(
    &STANDARD,
    GeneralPurposeConfig::new()
        .with_decode_allow_trailing_bits(true)
        .with_decode_padding_mode(DecodePaddingMode::Indifferent),
);

/// Why a data URI cannot be decoded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub(super) enum DataUriError {
    #[error("the data URI is not base64; expected \"data:...;base64,...\"")]
    NotBase64,
    #[error("the base64 data is broken at character {0}")]
    BadCharacter(usize),
}

/// The bytes of a base64 data URI.
pub(super) fn decode(uri: &str) -> Result<Vec<u8>, DataUriError> {
    let (head, data) = uri.split_once(',').ok_or(DataUriError::NotBase64)?;
    if !head.ends_with(";base64") {
        return Err(DataUriError::NotBase64);
    }
    BASE64.decode(data).map_err(|error| match error {
        DecodeError::InvalidByte(at, _) | DecodeError::InvalidLastSymbol { offset: at, .. } => {
            DataUriError::BadCharacter(at + 1)
        }
        DecodeError::InvalidLength(length) => DataUriError::BadCharacter(length),
        DecodeError::InvalidPadding => DataUriError::BadCharacter(data.len()),
    })
}

/// A relative URI as a path: `%20` and the like become what they stand for (RFC 3986, 2.1).
pub(super) fn percent_decoded(uri: &str) -> String {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let [first, tail @ ..] = rest {
        let hex = tail.get(..2).and_then(|two| std::str::from_utf8(two).ok());
        let byte = hex.filter(|_| *first == b'%').and_then(|hex| u8::from_str_radix(hex, 16).ok());
        bytes.push(byte.unwrap_or(*first));
        rest = if byte.is_some() { &tail[2..] } else { tail };
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vectors_of_rfc_4648() {
        for (text, base64) in [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("fooba", "Zm9vYmE="),
            ("foobar", "Zm9vYmFy"),
        ] {
            let uri = format!("data:application/octet-stream;base64,{base64}");
            assert_eq!(decode(&uri).unwrap(), text.as_bytes(), "{base64}");
        }
        assert_eq!(decode("data:;base64,+/+/").unwrap(), [0xFB, 0xFF, 0xBF]);
        assert_eq!(decode("data:;base64,Zm8").unwrap(), b"fo");
    }

    #[test]
    fn broken_uris_are_refused() {
        assert_eq!(decode("data:text/plain,abc"), Err(DataUriError::NotBase64));
        assert_eq!(decode("data:;base64,Zm9v!A"), Err(DataUriError::BadCharacter(5)));
        assert_eq!(decode("data:;base64,Zm9vY"), Err(DataUriError::BadCharacter(5)));
    }

    #[test]
    fn percent_signs() {
        assert_eq!(percent_decoded("my%20room%2e.bin%"), "my room..bin%");
        assert_eq!(percent_decoded("%zz"), "%zz");
    }
}
