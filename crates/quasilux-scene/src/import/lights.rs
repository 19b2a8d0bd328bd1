//! Modifiers that shine as area lights.

use super::Writer;
use super::text::{number, quoted};
use crate::honeybee::Surfaces;
use crate::radiance::Look;

impl Writer<'_> {
    /// Writes a light for each modifier that shines; their number.
    pub(super) fn lights(&mut self, surfaces: &Surfaces<'_>) -> usize {
        let mut count = 0;
        for (name, look) in &surfaces.materials {
            let Look::Light(luminance_cd_m2) = look else { continue };
            self.text.section("[[lights]]");
            self.text.key("kind", &quoted("area"));
            self.text.key("material", &quoted(name));
            self.text.key("luminance_cd_m2", &number(*luminance_cd_m2));
            count += 1;
        }
        count
    }
}
