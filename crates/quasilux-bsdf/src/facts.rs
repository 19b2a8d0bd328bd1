//! What the file of a measured surface says beside its tables.

/// What a file says about its surface.
#[derive(Clone, Debug, PartialEq)]
pub struct BsdfFacts {
    /// The format that the file has.
    pub format: BsdfFormat,
    /// Empty where the file gives none.
    pub name: String,
    /// Empty where the file gives none.
    pub manufacturer: String,
    /// Thickness of the sheet; light is scattered as if it had none.
    pub thickness_m: Option<f64>,
}

/// The formats of measured surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum BsdfFormat {
    /// LBNL WINDOW XML, a matrix over Klems patches.
    WindowKlems,
    /// LBNL WINDOW XML, a tensor tree.
    WindowTensorTree,
    /// Integra DDR or DDT.
    Ddr,
    /// MERL binary.
    Merl,
    /// ASTM E1392 text.
    Astm,
}

impl BsdfFormat {
    /// What people call it.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::WindowKlems => "WINDOW XML, Klems",
            Self::WindowTensorTree => "WINDOW XML, tensor tree",
            Self::Ddr => "DDR",
            Self::Merl => "MERL",
            Self::Astm => "ASTM E1392",
        }
    }
}
