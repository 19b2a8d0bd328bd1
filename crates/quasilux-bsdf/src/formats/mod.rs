//! The file formats, line by line.
//!
//! - [`astm`], ASTM E1392
//! - [`ddr`], Integra DDR and DDT (`.ddr`, `.ddt`)
//! - [`igsdb`], glazing products of the IGSDB (`.json`)
//! - [`merl`], the MERL database (`.binary`)
//! - [`window_xml`], LBNL WINDOW (`.xml`)
//!
//! Each page lists what stands on which line, with its clause where one is known, and then every
//! deviation that the reader tolerates: the rule, what is made of it, and the warning that it
//! gives. A test holds the pages to the variants of [`WarningKind`](crate::WarningKind).

pub mod astm;
pub mod ddr;
pub mod igsdb;
pub mod merl;
pub mod window_xml;
