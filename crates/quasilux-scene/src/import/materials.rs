//! What materials are in a state, as sections of a project file.

use super::Writer;
use super::text::{number, quoted, vector};
use crate::bsdf::{AngularTable, Conductor, Diffuse, Mirror, Pane, Plastic, Translucent};
use crate::radiance::Look;
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

    fn share(&mut self, key: &str, rgb: Rgb) {
        let [r, g, b] = rgb.0.map(number);
        let value = if rgb.is_grey() { r } else { format!("[{r}, {g}, {b}]") };
        self.text.key(key, &value);
    }

    fn bsdf(&mut self, bsdf: &Bsdf) {
        self.kind(bsdf.kind());
        match bsdf {
            Bsdf::Diffuse(Diffuse { reflectance }) | Bsdf::Mirror(Mirror { reflectance }) => {
                self.share("reflectance", *reflectance);
            }
            Bsdf::Translucent(Translucent { reflectance, transmittance }) => {
                self.share("reflectance", *reflectance);
                self.share("transmittance", *transmittance);
            }
            Bsdf::Conductor(Conductor { reflectance, alpha }) => {
                self.share("reflectance", *reflectance);
                self.text.key("alpha", &number(*alpha));
            }
            Bsdf::Plastic(Plastic { reflectance, eta, alpha }) => {
                self.share("reflectance", *reflectance);
                self.text.key("eta", &number(*eta));
                self.text.key("alpha", &number(*alpha));
            }
            Bsdf::Pane(pane) => self.pane(pane),
            // Models have none of them; sheets have another look.
            Bsdf::Dielectric(_) | Bsdf::Measured(_) => {}
        }
    }

    fn pane(&mut self, pane: &Pane) {
        match pane {
            Pane::Clear { eta } => self.text.key("eta", &number(*eta)),
            Pane::Tinted { eta, transmittance } => {
                self.text.key("eta", &number(*eta));
                self.share("transmittance", *transmittance);
            }
            Pane::Measured { transmittance, front_reflectance, .. } => {
                self.text.key("transmittance", &table(transmittance));
                self.text.key("reflectance", &table(front_reflectance));
            }
        }
    }
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
