//! Parsing of text files with positions: decoding, lines, numbers, XML elements, and diagnostics.
//!
//! A parser built on this crate is total: any bytes give a result or a [`ParseError`] that names
//! the line, the column, what was found there and what was expected. A deviation from a standard
//! that a parser tolerates becomes a [`Warning`] of a kind that the parser's crate defines;
//! [`Warnings`] keeps each kind once, at its first position, and counts the others.
//!
//! ```
//! use quasilux_text::{Position, Token};
//! let token = Token { text: "12,5", at: Position { line: 3, column: 7 } };
//! let error = token.number("the length in m").unwrap_err();
//! assert_eq!(
//!     error.to_string(),
//!     "3:7: found \"12,5\"; expected the length in m (a number, no more than 1e18)"
//! );
//! ```

mod decode;
mod error;
mod number;
mod position;
mod quote;
mod warning;
mod web_page;
pub mod xml;

pub use decode::{decode, lines};
pub use error::ParseError;
pub use number::{Number, Token, check_room, number_list};
pub use position::Position;
pub use quote::{printable, printable_json, printable_lines, quoted, shortened};
pub use warning::{TextWarning, Warning, Warnings};
pub use web_page::refuse_web_page;

/// Tests the example of the README.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
