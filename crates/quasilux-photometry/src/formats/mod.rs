//! The file formats, line by line.
//!
//! - [`lm63`], ANSI/IES LM-63 (`.ies`)
//! - [`eulumdat`], EULUMDAT (`.ldt`)
//!
//! Each page lists what stands on which line, with its clause, and then every deviation that the
//! reader tolerates.

pub mod eulumdat;
pub mod lm63;
