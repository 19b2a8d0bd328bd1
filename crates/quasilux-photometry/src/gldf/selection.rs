//! What of a container is asked for.

/// Which light of a container. A part that there is only one of needs no name.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct GldfChoice {
    /// The variant of the product, by its `id` or its name in any language.
    pub variant: Option<String>,
    /// The emitter of the variant, by its `id`, by its object in the 3D model, or by its name.
    pub emitter: Option<String>,
    /// The equipment or light source, of several that can be exchanged in one emitter: by its `id`,
    /// by its name, or by its number from 1 on.
    pub light_source: Option<String>,
    /// The channel of a light source with several, by its name or its number from 1 on; all of
    /// them without it.
    pub channel: Option<String>,
    /// Whether its light in an emergency is asked for.
    pub emergency: bool,
}

impl GldfChoice {
    /// Whether nothing in particular is asked for.
    #[must_use]
    pub fn is_open(&self) -> bool {
        *self == Self::default()
    }
}
