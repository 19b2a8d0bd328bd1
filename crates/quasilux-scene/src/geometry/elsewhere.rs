//! Models that another program makes projects of.

/// Endings of IFC models.
const IFC_ENDINGS: [&str; 3] = ["ifc", "ifczip", "ifcxml"];

/// Advice on an IFC model, by the name of its file; `None` for other files.
#[must_use]
pub fn ifc_advice(name: &str) -> Option<String> {
    let (_, ending) = name.rsplit_once('.')?;
    let is_ifc = IFC_ENDINGS.iter().any(|known| ending.eq_ignore_ascii_case(known));
    is_ifc.then(|| {
        format!(
            "an IFC model, which the Python package reads: `pip install 'quasilux[ifc]'`, then \
             `python -m quasilux.ifc \"{name}\" --out project.toml` writes a project of it"
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ifc_models_are_known_by_their_names() {
        let advice = ifc_advice("a b/Model.IFC").unwrap();
        assert!(advice.contains("python -m quasilux.ifc \"a b/Model.IFC\""), "{advice}");
        assert!(ifc_advice("model.ifcZIP").is_some());
        assert_eq!(ifc_advice("ifc"), None);
        assert_eq!(ifc_advice("model.ifc.obj"), None);
    }
}
