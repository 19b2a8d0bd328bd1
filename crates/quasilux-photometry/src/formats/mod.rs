//! The file formats, line by line.
//!
//! - [`lm63`], ANSI/IES LM-63 (`.ies`)
//! - [`eulumdat`], EULUMDAT (`.ldt`)
//! - [`tm33`], ANSI/IES TM-33 (`.xml`)
//! - [`gldf`], GLDF (`.gldf`), containers of the others
//!
//! Each page lists what stands on which line, with its clause where one is known, and then every
//! deviation that the reader tolerates: the rule, what is made of it, and the warning that it
//! gives. A test holds the pages to the variants of [`WarningKind`](crate::WarningKind).

pub mod eulumdat;
pub mod gldf;
pub mod lm63;
pub mod tm33;
