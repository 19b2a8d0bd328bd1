//! cargo run --example column
//!
//! A reader of a small format, one length in metres a line, that never panics: it gives the sum, or
//! an error with line and column. What it tolerates, decimal commas, becomes one warning a kind
//! with the number of cases.

use quasilux_text::{ParseError, Position, TextWarning, Token, Warnings, decode, lines};

fn sum_m(bytes: &[u8], warnings: &mut Warnings<TextWarning>) -> Result<f64, ParseError> {
    let text = decode(bytes, warnings);
    let mut sum_m = 0.0;
    for (index, line) in lines(&text).enumerate() {
        let text = line.trim();
        if !text.is_empty() {
            let column = 1 + line.chars().take_while(|c| c.is_whitespace()).count();
            let token = Token { text, at: Position { line: index + 1, column } };
            sum_m += token.number_with_comma("a length in m", warnings)?.value;
        }
    }
    Ok(sum_m)
}

fn main() {
    for bytes in [&b"1.5\n2,25\n3,5\n"[..], b"1.5\n  two\n"] {
        let mut warnings = Warnings::default();
        match sum_m(bytes, &mut warnings) {
            Ok(sum_m) => println!("{sum_m} m"),
            Err(error) => println!("error   {error}"),
        }
        for warning in warnings.into_vec() {
            println!("warning {warning}");
        }
    }
}
