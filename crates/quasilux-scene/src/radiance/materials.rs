//! Types of modifiers, and the looks of materials.

use super::document::{Primitive, shown};
use super::look::{Coated, Look, Looks};
use super::{Findings, glass};
use crate::Rgb;
use crate::bsdf::Mirror;
use crate::{Bsdf, FileKind};
use glam::DVec3;
use std::fmt::Write;

use super::definitions::Definition;
use super::frame::Frame;
use super::includes::Includes;
use super::xform::{Parsed, Transforms};

/// Materials that become something here.
const MATERIALS: [&str; 20] = [
    "plastic",
    "metal",
    "trans",
    "plastic2",
    "metal2",
    "trans2",
    "dielectric",
    "interface",
    "glass",
    "mirror",
    "light",
    "illum",
    "glow",
    "spotlight",
    "BSDF",
    "aBSDF",
    "mist",
    "antimatter",
    "prism1",
    "prism2",
];
/// Materials that are refused where they are used.
const OTHER_MATERIALS: [&str; 14] = [
    "ashik2",
    "plasfunc",
    "metfunc",
    "transfunc",
    "BRTDfunc",
    "plasdata",
    "metdata",
    "transdata",
    "WGMDfunc",
    "mixfunc",
    "mixdata",
    "mixtext",
    "mixpict",
    "bsdf2",
];
/// Patterns that change brightness or colour.
const PATTERNS: [&str; 13] = [
    "brightfunc",
    "brightdata",
    "brighttext",
    "colorfunc",
    "colordata",
    "colorpict",
    "colortext",
    "spectrum",
    "specfile",
    "specfunc",
    "specdata",
    "specpict",
    "colourfunc",
];
/// Textures, which turn normals.
const TEXTURES: [&str; 2] = ["texfunc", "texdata"];

/// Whether a type of primitives is one of modifiers.
pub(super) fn is_modifier(kind: &str) -> bool {
    is_material(kind) || is_pattern(kind) || TEXTURES.contains(&kind)
}

pub(super) fn is_material(kind: &str) -> bool {
    MATERIALS.contains(&kind) || OTHER_MATERIALS.contains(&kind)
}

pub(super) fn is_pattern(kind: &str) -> bool {
    PATTERNS.contains(&kind)
}

/// Whether a material shines.
pub(super) fn shines(kind: &str) -> bool {
    matches!(kind, "light" | "illum" | "glow" | "spotlight")
}

/// Files and findings that a material is read with.
pub(super) struct Reading<'r, 'f> {
    pub(super) includes: &'r mut Includes<'f>,
    pub(super) findings: &'r mut Findings,
}

/// The look of a material; an alternate material of it has been resolved before.
pub(super) fn look(definition: &Definition, reading: &mut Reading<'_, '_>) -> Look {
    let primitive = &*definition.primitive;
    let place = format!("{} \"{}\"", primitive.kind, shown(&definition.name));
    let of = Of { primitive, place: &place };
    let found = match &*primitive.kind {
        "BSDF" | "aBSDF" => of.sheet(definition, reading),
        _ => of.look(&mut Looks { place: &place, findings: reading.findings }),
    };
    if matches!(found, Ok(Look::Open)) && primitive.kind.starts_with("trans") {
        reading.findings.note(&place, "all light goes straight through it, and it is left out");
    }
    found.unwrap_or_else(|message| Look::Unknown(message.into()))
}

/// A material, and how messages call it.
struct Of<'p> {
    primitive: &'p Primitive,
    place: &'p str,
}

impl Of<'_> {
    fn refusal(&self, what: &str) -> String {
        format!("{} {what}", self.place)
    }

    /// Exactly `N` real arguments.
    fn reals<const N: usize>(&self) -> Result<[f64; N], String> {
        let reals = self.primitive.reals.as_slice();
        let found = reals.len();
        reals
            .first_chunk()
            .copied()
            .filter(|_| found == N)
            .ok_or_else(|| self.refusal(&format!("has {found} real arguments; expected {N}")))
    }

    fn shares<const N: usize>(&self, what: &str, shares: [f64; N]) -> Result<[f64; N], String> {
        match shares.into_iter().find(|share| !(0.0..=1.0).contains(share)) {
            None => Ok(shares),
            Some(wrong) => {
                Err(self.refusal(&format!("has {what} of {wrong}; expected a share from 0 to 1")))
            }
        }
    }

    fn coated(&self, [r, g, b, specularity, roughness]: [f64; 5]) -> Result<Coated, String> {
        let reflectance = Rgb(self.shares("a reflectance", [r, g, b])?);
        self.shares("a specularity", [specularity])?;
        self.shares("a roughness", [roughness])?;
        Ok(Coated { reflectance, specularity, roughness })
    }

    /// Of two roughnesses their geometric mean.
    fn round(&self, looks: &mut Looks<'_>, [r, g, b, s, u, v]: [f64; 6]) -> Result<Coated, String> {
        looks.note("its highlight is as wide in all directions here");
        self.coated([r, g, b, s, (u * v).max(0.0).sqrt()])
    }

    fn look(&self, looks: &mut Looks<'_>) -> Result<Look, String> {
        let what = "a share that goes through";
        Ok(match &*self.primitive.kind {
            "plastic" => looks.plastic(self.coated(self.reals()?)?),
            "metal" => looks.metal(self.coated(self.reals()?)?),
            "plastic2" => {
                let coated = self.round(looks, self.reals()?)?;
                looks.plastic(coated)
            }
            "metal2" => {
                let coated = self.round(looks, self.reals()?)?;
                looks.metal(coated)
            }
            "trans" => {
                let [r, g, b, s, rough, through, straight] = self.reals()?;
                let coated = self.coated([r, g, b, s, rough])?;
                let [through, straight] = self.shares(what, [through, straight])?;
                looks.trans(coated, through, straight)
            }
            "trans2" => {
                let [r, g, b, s, u, v, through, straight] = self.reals()?;
                let coated = self.round(looks, [r, g, b, s, u, v])?;
                let [through, straight] = self.shares(what, [through, straight])?;
                looks.trans(coated, through, straight)
            }
            "glass" => self.glass(looks)?,
            "dielectric" => self.dielectric(looks)?,
            "interface" => self.interface(looks)?,
            "mirror" => self.mirror(looks)?,
            "light" | "illum" | "glow" => self.light(looks)?,
            "mist" => {
                looks.note("mist is left out: light is not scattered in the air here");
                Look::Open
            }
            "antimatter" => return Err(self.nothing("cut the surfaces instead")),
            kind if OTHER_MATERIALS.contains(&kind) || kind.starts_with("prism") => {
                return Err(self.nothing("expected plastic, metal, trans, glass or BSDF"));
            }
            _ => return Err(self.nothing("expected another material")),
        })
    }

    fn nothing(&self, advice: &str) -> String {
        let kind = &self.primitive.kind;
        self.refusal(&format!("is of the type {kind}, for which there is nothing here; {advice}"))
    }

    fn index(&self, eta: f64) -> Result<f64, String> {
        if eta > 1.0 && eta <= 5.0 {
            return Ok(eta);
        }
        Err(self.refusal(&format!("has an index of {eta}; expected one above 1, at most 5")))
    }

    fn glass(&self, looks: &mut Looks<'_>) -> Result<Look, String> {
        let (colour, eta) = match *self.primitive.reals.as_slice() {
            [r, g, b] => ([r, g, b], glass::INDEX),
            _ => {
                let [r, g, b, eta] = self.reals()?;
                ([r, g, b], self.index(eta)?)
            }
        };
        Ok(looks.glass(eta, Rgb(self.shares("a transmissivity", colour)?)))
    }

    fn dielectric(&self, looks: &mut Looks<'_>) -> Result<Look, String> {
        let [r, g, b, eta, _hartmann] = self.reals()?;
        if [r, g, b] != [1.0; 3] {
            looks.note("the colour of the body is left out: it takes no light");
        }
        Ok(looks.dielectric(self.index(eta)?))
    }

    fn interface(&self, looks: &mut Looks<'_>) -> Result<Look, String> {
        let [r, g, b, inside, r2, g2, b2, outside] = self.reals()?;
        if [r, g, b, r2, g2, b2] != [1.0; 6] {
            looks.note("the colour of the body is left out: it takes no light");
        }
        let eta = inside / outside;
        if (0.2..=5.0).contains(&eta) && outside > 0.0 {
            return Ok(looks.dielectric(eta));
        }
        Err(self
            .refusal(&format!("has indices of {inside} and {outside}; expected those of bodies")))
    }

    fn mirror(&self, looks: &mut Looks<'_>) -> Result<Look, String> {
        let reflectance = Rgb(self.shares("a reflectance", self.reals()?)?);
        if !self.primitive.strings.is_empty() {
            looks.note("its alternate material is left out: it is a mirror for all light");
        }
        Ok(Look::from(Bsdf::Mirror(Mirror { reflectance })))
    }

    fn light(&self, looks: &mut Looks<'_>) -> Result<Look, String> {
        let (radiance, max_radius) = match &*self.primitive.kind {
            "glow" => {
                let [r, g, b, max_radius] = self.reals()?;
                ([r, g, b], max_radius)
            }
            _ => (self.reals()?, 0.0),
        };
        if let Some(wrong) = radiance.into_iter().find(|it| !(0.0..=1e9).contains(it)) {
            let what = format!("has a radiance of {wrong}; expected one from 0 to 1e9");
            return Err(self.refusal(&what));
        }
        if &*self.primitive.kind == "illum" {
            return Err(self.refusal(
                "shines and lets all light through, for which there is nothing here; name its \
                 alternate material, or make it a light",
            ));
        }
        Ok(looks.light(radiance, max_radius))
    }

    /// Of a `BSDF` the first string is a thickness.
    fn sheet(
        &self,
        definition: &Definition,
        reading: &mut Reading<'_, '_>,
    ) -> Result<Look, String> {
        let strings = self.primitive.strings.as_slice();
        let is_thick = &*self.primitive.kind == "BSDF";
        let (thickness, strings) = match strings.split_first() {
            Some((thickness, rest)) if is_thick => (&**thickness, rest),
            _ => ("0", strings),
        };
        let [file, x, y, z, _function, transform @ ..] = strings else {
            return Err(self.refusal("lacks string arguments; expected a file and where up is"));
        };
        let looks = &mut Looks { place: self.place, findings: reading.findings };
        if thickness.parse::<f64>().ok() != Some(0.0) {
            looks.note("its thickness is left out: light meets the sheet where it is drawn");
        }
        if self.primitive.reals.iter().any(|&share| share != 0.0) {
            looks.note("diffuse light beside that of its tables is left out");
        }
        let words: Vec<String> = transform.iter().map(|word| word.to_string()).collect();
        let Parsed { transforms, .. } =
            Transforms::parse(&words).map_err(|it| self.refusal(&it))?;
        let own = transforms.copy(0).map(|copy| copy.frame).unwrap_or_default();
        let frame: Frame = own.then(&definition.frame);
        let up: Option<Vec<f64>> = [x, y, z].iter().map(|it| it.parse().ok()).collect();
        let up = up.map(|up| frame.direction(DVec3::new(up[0], up[1], up[2])));
        let up = up.filter(|up| up.length() > 0.0 && up.length() < 1e9).ok_or_else(|| {
            self.refusal("has no numbers for where up is; expected a direction of some length")
        })?;
        let table = reading.includes.data(&definition.place.file, file, FileKind::Bsdf);
        let table = table.map_err(|message| self.refusal(&format!(": {message}")))?;
        // One file is one table, wherever it is used.
        Ok(Look::Sheet { name: table.path, xml: table.text, up })
    }
}

/// Text that is the same for materials that are.
pub(super) fn key(definition: &Definition, patterns: &[usize], is_textured: bool) -> String {
    let primitive = &definition.primitive;
    let mut key = format!(
        "{:?} {:?} {:?} {} {}",
        definition.name,
        primitive.kind,
        primitive.strings,
        patterns.is_empty(),
        is_textured
    );
    primitive.reals.iter().for_each(|real| {
        write!(key, " {:x}", real.to_bits()).expect("strings grow");
    });
    if matches!(&*primitive.kind, "BSDF" | "aBSDF") {
        write!(key, " {} {:?}", definition.place.file, definition.frame.turn)
            .expect("strings grow");
    }
    if shines(&primitive.kind) {
        write!(key, " {:?}", patterns).expect("strings grow");
    }
    key
}
