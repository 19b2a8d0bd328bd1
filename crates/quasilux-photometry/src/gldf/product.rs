//! The definitions of `product.xml`, and references to them by identifier.

use super::GldfError;
use super::texts::{attribute, in_quotes};
use quasilux_text::xml::Element;

/// The definitions of a product.
#[derive(Clone, Copy)]
pub(super) struct Product<'e> {
    pub(super) root: &'e Element<'e>,
}

impl<'e> Product<'e> {
    /// An element of a list in `GeneralDefinitions`, by its identifier: of the list `Files` the
    /// `File` of that `id`. `asked` is the element that refers to it.
    pub(super) fn find(
        self,
        list: &str,
        names: &[&str],
        id: &str,
        asked: &Element<'_>,
    ) -> Result<&'e Element<'e>, GldfError> {
        let lists = self.root.child("GeneralDefinitions").and_then(|it| it.child(list));
        let mut items = lists.iter().flat_map(|list| &list.children);
        let is_it = |item: &&'e Element<'e>| {
            names.contains(&item.name) && attribute(item, "id") == Some(id)
        };
        items.find(is_it).ok_or_else(|| {
            let expected = format!("{} that is defined in {list}", one_of(names));
            GldfError::at(asked, format!("a reference to {}", in_quotes(id)), expected)
        })
    }

    /// The element that a child refers to, or the element itself by an attribute, as format 0.9
    /// has it; `None` where it refers to none.
    pub(super) fn refer(
        self,
        from: &'e Element<'e>,
        reference: &Reference<'_>,
    ) -> Result<Option<&'e Element<'e>>, GldfError> {
        let child = from.child(reference.child).unwrap_or(from);
        let ids = reference.attributes.iter();
        let Some(id) = ids.filter_map(|name| attribute(child, name)).next() else {
            return Ok(None);
        };
        self.find(reference.list, reference.names, id, child).map(Some)
    }
}

/// A reference from one element to another.
pub(super) struct Reference<'n> {
    /// The child that has it.
    pub(super) child: &'n str,
    /// The attributes that may have it, of which one is there.
    pub(super) attributes: &'n [&'n str],
    /// The list in which the other one stands.
    pub(super) list: &'n str,
    /// The names that it may have there.
    pub(super) names: &'n [&'n str],
}

fn one_of(names: &[&str]) -> String {
    names.join(" or ")
}
