//! What materials are in a state, as sections of a project file.

use super::Writer;
use super::text::{number, quoted, vector};
use crate::bsdf::{AngularTable, Conductor, Mirror, Pane, Plastic, Translucent};
use crate::honeybee::Look;
use crate::{Bsdf, Rgb};

impl Writer<'_> {
    /// Writes the keys of a material of this look.
    pub(super) fn material(&mut self, look: &Look) {
        match look {
            Look::Surface(bsdf) => self.bsdf(bsdf),
            Look::Sheet { name: of, xml, up } => {
                let known = self.sheets.get(&**of).cloned();
                let file = known.unwrap_or_else(|| self.sheet(of, xml));
                self.kind("bsdf");
                self.text.key("file", &quoted(&file));
                self.text.key("up", &vector(*up));
            }
            // None of them is in a state.
            Look::Light(_) | Look::Open | Look::Unknown(_) => self.text.key("reflectance", "0"),
        }
    }

    /// Adds the file of a sheet.
    fn sheet(&mut self, name: &str, xml: &str) -> String {
        let file = self.file(name, ".xml", xml.as_bytes().to_vec());
        self.sheets.insert(name.to_owned(), file.clone());
        file
    }

    fn kind(&mut self, kind: &str) {
        self.text.key("kind", &quoted(kind));
    }

    fn bsdf(&mut self, bsdf: &Bsdf) {
        self.kind(bsdf.kind());
        let (reflectance, more) = match bsdf {
            Bsdf::Diffuse(it) => (Some(it.reflectance), Vec::new()),
            Bsdf::Mirror(Mirror { reflectance }) => (Some(*reflectance), Vec::new()),
            Bsdf::Translucent(Translucent { reflectance, transmittance }) => {
                (Some(*reflectance), vec![("transmittance", shares(*transmittance))])
            }
            Bsdf::Conductor(Conductor { reflectance, alpha }) => {
                (Some(*reflectance), vec![("alpha", number(*alpha))])
            }
            Bsdf::Plastic(Plastic { reflectance, eta, alpha }) => {
                let more = vec![("eta", number(*eta)), ("alpha", number(*alpha))];
                (Some(*reflectance), more)
            }
            Bsdf::Pane(pane) => (None, of_pane(pane)),
            // Models have none of them, sheets have another look.
            Bsdf::Dielectric(_) | Bsdf::Measured(_) => (None, Vec::new()),
        };
        if let Some(reflectance) = reflectance {
            self.text.key("reflectance", &shares(reflectance));
        }
        more.iter().for_each(|(key, value)| self.text.key(key, value));
    }
}

fn of_pane(pane: &Pane) -> Vec<(&'static str, String)> {
    match pane {
        Pane::Clear { eta } => vec![("eta", number(*eta))],
        Pane::Tinted { eta, transmittance } => {
            vec![("eta", number(*eta)), ("transmittance", shares(*transmittance))]
        }
        Pane::Measured { transmittance, front_reflectance, .. } => {
            vec![("transmittance", table(transmittance)), ("reflectance", table(front_reflectance))]
        }
    }
}

fn shares(rgb: Rgb) -> String {
    let [r, g, b] = rgb.0.map(number);
    if rgb.is_grey() { r } else { format!("[{r}, {g}, {b}]") }
}

fn table(table: &AngularTable) -> String {
    let last = table.nodes().len() - 1;
    let node = |(index, node): (usize, &crate::bsdf::AngularNode)| {
        let degrees = node.theta_rad.to_degrees();
        let whole = degrees.round();
        let is_whole = index == last || whole.to_radians() == node.theta_rad;
        let degrees = if is_whole { whole } else { degrees };
        format!("[{}, {}]", number(degrees), number(node.share))
    };
    let nodes: Vec<String> = table.nodes().iter().enumerate().map(node).collect();
    format!("[{}]", nodes.join(", "))
}
