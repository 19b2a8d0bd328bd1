//! Scenes for other programs: [`export_radiance`].

mod lights;
mod luminaires;
mod materials;
mod outside;
mod sensors;
mod shapes;
mod surfaces;
mod webs;
mod words;

use crate::{Light, Scene};
use std::collections::BTreeSet;
use words::{Identifiers, Words};

/// Lumens in a watt, as all programs of Radiance count them.
const LM_PER_W: f64 = 179.0;

/// A scene as files of another program.
#[derive(Clone, Debug, Default)]
pub struct Exported {
    /// The files, whose names have no folder.
    pub files: Vec<ExportedFile>,
    /// Parts of the scene that the files have otherwise, in words.
    pub findings: BTreeSet<String>,
}

/// A file of an exported scene.
#[derive(Clone, Debug)]
pub struct ExportedFile {
    /// Its name.
    pub name: String,
    /// Everything that is in it.
    pub text: String,
}

/// Commands that compile and measure what the files say.
const COMMANDS: &str = "\
# RAYPATH has to name this folder (.) and Radiance's lib. Illuminances in lx of NAME.pts, a line a
# point; more -ad and repeated runs tell how sure they are:
oconv scene.rad > scene.oct
rtrace -h -I+ -ab 8 -aa 0 -ad 4096 -lr -10 -lw 1e-5 -ds 0.02 -dc 1 -dt 0 scene.oct < \"NAME.pts\" |
    rcalc -e '$1 = 179 * (0.265 * $1 + 0.670 * $2 + 0.065 * $3)'
# Pictures: rpict -vf \"NAME.vf\" -x WIDTH -y HEIGHT scene.oct > \"NAME.hdr\"
";

/// A scene for Radiance: `scene.rad`, which `oconv` compiles, with data and function files; points
/// for `rtrace` and views for `rpict` and `rvu`; and what to do with them, `commands.txt`.
///
/// # Errors
/// In words, where a material is nothing that Radiance can be told.
pub fn export_radiance(scene: &Scene) -> Result<Exported, String> {
    let mut exported = Exported::default();
    let mut words = Words::default();
    let mut names = Identifiers::default();
    let mut tables = luminaires::Tables::new();
    words.comment("Made by quasilux: lengths in metres, z up; radiances are luminances / 179.");
    let materials = materials::write(scene, &mut words, &mut names, &mut exported)?;
    surfaces::write(scene, &materials, &mut words);
    for (number, light) in scene.lights.iter().enumerate() {
        match light {
            Light::Point(light) => lights::point(light, number, &mut words),
            Light::Area(light) => lights::area(scene, light, number, &mut words, &mut exported),
            Light::Luminaire(light) => {
                luminaires::write(light, number, &mut tables, &mut words, &mut exported);
            }
        }
    }
    if let Some(environment) = &scene.environment {
        outside::write(environment, &mut words, &mut exported);
    }
    exported.add("quasilux.cal", luminaires::FUNCTIONS.to_owned());
    exported.add("scene.rad", words.0);
    sensors::write(scene, &mut exported);
    exported.add("commands.txt", COMMANDS.to_owned());
    Ok(exported)
}

impl Exported {
    fn add(&mut self, name: &str, text: String) {
        self.files.push(ExportedFile { name: name.to_owned(), text });
    }

    fn note(&mut self, finding: impl Into<String>) {
        self.findings.insert(finding.into());
    }
}
