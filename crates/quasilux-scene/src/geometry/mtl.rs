//! Diffuse reflectances of Wavefront MTL files.
//!
//! Of each material its name, `Kd` (diffuse reflectance, kept within 0 to 1), `Ke` (whether it
//! emits) and `d` or `Tr` (whether it is transparent) are read. Textures and highlights are not: a
//! texture is warned of.

use super::obj_lines::{text_of, without_comment};
use crate::{Rgb, Warning};
use quasilux_text::Position;

/// Reflectance of materials without `Kd` in MTL files: that of the format's default grey.
const DEFAULT_REFLECTANCE: f64 = 0.8;

/// A material of an MTL file.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct MtlMaterial {
    pub(super) name: String,
    pub(super) reflectance: Rgb,
    pub(super) emits: bool,
    /// Whether it lets a part of the light through.
    pub(super) is_clear: bool,
}

/// Reads an MTL file; lines that make no sense are warned of and left out.
pub(super) fn read(file: &str, bytes: &[u8], warnings: &mut Vec<Warning>) -> Vec<MtlMaterial> {
    let text = text_of(bytes);
    let mut materials: Vec<MtlMaterial> = Vec::new();
    let mut textures = 0_u64;
    for (line, number) in quasilux_text::lines(&text).zip(1..) {
        let line = without_comment(line).trim();
        let (keyword, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        let mut warn = |message: String| {
            let place = Some(Position { line: number, column: 1 });
            warnings.push(Warning::new(file, place, message));
        };
        if keyword == "newmtl" {
            let reflectance = Rgb::grey(DEFAULT_REFLECTANCE);
            let name = rest.trim().to_owned();
            materials.push(MtlMaterial { name, reflectance, emits: false, is_clear: false });
            continue;
        }
        let Some(material) = materials.last_mut() else {
            continue;
        };
        match keyword {
            "Kd" => match colour(rest) {
                Some(kd) => {
                    let clipped = Rgb(kd.0.map(|c| c.clamp(0.0, 1.0)));
                    if clipped != kd {
                        warn(format!("Kd of \"{}\" is outside 0 to 1: clipped", material.name));
                    }
                    material.reflectance = clipped;
                }
                None => warn(format!(
                    "Kd of \"{}\" is not one or three numbers: {DEFAULT_REFLECTANCE} is used",
                    material.name
                )),
            },
            "Ke" => material.emits = colour(rest).is_some_and(|ke| ke.max_channel() > 0.0),
            // Programs do not agree whether `Tr` is 1 of what is opaque or of what is clear.
            "d" => material.is_clear |= last_number(rest).is_some_and(|d| d < 1.0),
            "Tr" => material.is_clear |= last_number(rest).is_some_and(|tr| tr > 0.0 && tr < 1.0),
            "map_Kd" => textures += 1,
            _ => {}
        }
    }
    if textures > 0 {
        let message = format!("{textures} textures are not read: their Kd is used alone");
        warnings.push(Warning::new(file, None, message));
    }
    materials
}

/// The number that a statement ends with.
fn last_number(words: &str) -> Option<f64> {
    words.split_whitespace().next_back()?.parse().ok()
}

/// One or three finite numbers.
fn colour(words: &str) -> Option<Rgb> {
    let numbers: Vec<f64> =
        words.split_whitespace().map(str::parse).collect::<Result<_, _>>().ok()?;
    let colour = match numbers.as_slice() {
        [grey] => Rgb::grey(*grey),
        [r, g, b] => Rgb([*r, *g, *b]),
        _ => return None,
    };
    colour.0.iter().all(|c| c.is_finite()).then_some(colour)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reflectances_and_oddities() {
        let text = "Kd 1 1 1\nnewmtl white wall\n Kd 0.8 0.7 1.5\nKs 1 1 1\nnewmtl lamp\n\
                    Kd 0.25 # dark\nKe 3 3 3\nmap_Kd a.png\nnewmtl odd\nKd x\n\u{0}\n\
                    newmtl pane #2 # of the door\nd -halo 0.3\nnewmtl old\nTr 1\n";
        let mut warnings = Vec::new();
        let materials = read("a.mtl", text.as_bytes(), &mut warnings);
        let of =
            |i: usize| (materials[i].name.as_str(), materials[i].reflectance, materials[i].emits);
        assert_eq!(materials.len(), 5);
        assert_eq!(materials[3].name, "pane #2");
        let clear: Vec<bool> = materials.iter().map(|material| material.is_clear).collect();
        assert_eq!(clear, [false, false, false, true, false]);
        assert_eq!(of(0), ("white wall", Rgb([0.8, 0.7, 1.0]), false));
        assert_eq!(of(1), ("lamp", Rgb::grey(0.25), true));
        assert_eq!(of(2), ("odd", Rgb::grey(DEFAULT_REFLECTANCE), false));
        let warnings: Vec<String> = warnings.iter().map(Warning::to_string).collect();
        assert_eq!(warnings.len(), 3, "{warnings:?}");
        assert!(warnings[0].starts_with("a.mtl:3:1: Kd of \"white wall\" is outside"));
        assert!(warnings[1].starts_with("a.mtl:10:1: "));
        assert!(warnings[2].contains("1 textures"));
    }
}
