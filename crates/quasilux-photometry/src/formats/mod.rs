//! The file formats, line by line.
//!
//! - [`lm63`], ANSI/IES LM-63 (`.ies`)
//! - [`eulumdat`], EULUMDAT (`.ldt`)
//! - [`tm33`], ANSI/IES TM-33 (`.xml`)
//! - [`astm`], surfaces of ASTM E1392
//! - [`ddr`], surfaces of Integra DDR and DDT (`.ddr`, `.ddt`)
//! - [`merl`], surfaces of the MERL database (`.binary`)
//! - [`window_xml`], surfaces of LBNL WINDOW (`.xml`)
//!
//! Each page lists what stands on which line, with its clause where one is known, and then every
//! deviation that the reader tolerates: the rule, what is made of it, and the warning that it
//! gives. A test holds the pages to the variants of [`Deviation`](crate::Deviation).

pub mod astm;
pub mod ddr;
pub mod eulumdat;
pub mod lm63;
pub mod merl;
pub mod tm33;
pub mod window_xml;
