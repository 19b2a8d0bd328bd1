//! Files of glazing products, each read once, and the panes that are put together from them.

use super::photometry::{load_error, passed_on};
use crate::bsdf::Pane;
use crate::geometry::read_file;
use crate::project::{LayerEntry, Project};
use crate::{FileKind, Files, LoadError, Spanned, Warning};
use quasilux_bsdf::{Glazing, GlazingLayer, GlazingProduct, read_glazing};
use std::collections::HashMap;
use std::sync::Arc;

/// The files that a project names, as far as they were read.
pub(super) struct GlazingFiles<'a> {
    project: &'a Project,
    files: &'a dyn Files,
    products: HashMap<String, Arc<GlazingProduct>>,
}

impl<'a> GlazingFiles<'a> {
    pub(super) fn new(project: &'a Project, files: &'a dyn Files) -> Self {
        Self { project, files, products: HashMap::new() }
    }

    /// The pane of these layers; passes warnings on where a file is read first.
    pub(super) fn pane(
        &mut self,
        layers: &[LayerEntry],
        warnings: &mut Vec<Warning>,
    ) -> Result<Pane, LoadError> {
        let read = |LayerEntry { file, is_flipped }: &LayerEntry| -> Result<_, LoadError> {
            let product = self.product(file, warnings)?;
            Ok(GlazingLayer { product, is_flipped: *is_flipped })
        };
        let layers = layers.iter().map(read).collect::<Result<_, _>>()?;
        Ok(Pane::of_glazing(&Glazing::new(layers)))
    }

    fn product(
        &mut self,
        file: &Spanned<String>,
        warnings: &mut Vec<Warning>,
    ) -> Result<Arc<GlazingProduct>, LoadError> {
        let name = file.value.as_str();
        if let Some(known) = self.products.get(name) {
            return Ok(Arc::clone(known));
        }
        let bytes = read_file(self.project, file, self.files, FileKind::Glazing)?;
        let read = read_glazing(&bytes).map_err(|error| load_error(name, &error))?;
        warnings.extend(read.warnings.iter().map(|warning| passed_on(name, warning)));
        let product = Arc::new(read.product);
        self.products.insert(name.to_owned(), Arc::clone(&product));
        Ok(product)
    }
}
