//! A small valid project, and files in a map.

use quasilux_scene::{FileKind, Files, LoadError, Loaded, load};
use std::collections::HashMap;
use std::io::{Error, ErrorKind};

/// A floor of 1 m x 1 m under a point light.
pub(crate) const PROJECT: &str = r#"[scene]
geometry = ["room.obj"]

[[lights]]
kind = "point"
position = [0.5, 0.5, 2.0]
intensity_cd = 100

[[sensors]]
name = "plane"
kind = "grid"
origin = [0, 0, 0.8]
u = [1, 0, 0]
v = [0, 1, 0]
spacing = 0.25
"#;

pub(crate) const ROOM_OBJ: &str = "mtllib room.mtl\no floor\nusemtl wood\n\
    v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";

pub(crate) const ROOM_MTL: &str = "newmtl wood\nKd 0.4 0.4 0.4\n";

/// Type C, absolute: 1000 cd in all directions of the lower half.
pub(crate) const LAMP_IES: &str = "IESNA:LM-63-2002\n[TEST] none\n[MANUFAC] none\nTILT=NONE\n\
    1 -1 1 2 1 1 2 0 0 0\n1 1 10\n0 90\n0\n1000 1000\n";

/// EULUMDAT, absolute: 500 cd/klm of 2000 lm in all directions of the lower half.
pub(crate) fn lamp_ldt() -> String {
    let dimensions = "0\n".repeat(9);
    let ratios = "1\n".repeat(10);
    format!(
        "none\n1\n1\n1\n0\n2\n90\n\n\n\n\n\n{dimensions}100\n314.159\n1\n0\n\
        1\n-1\nLED\n2000\n\n\n10\n{ratios}0\n0\n90\n500\n500\n"
    )
}

/// TM-33, absolute: 100 cd in all directions of the lower half.
pub(crate) const LAMP_TM33: &str = "<?xml version=\"1.0\"?>
<IESTM33-22><Version>1.1</Version>
<Header><Description>lamp</Description><Laboratory>none</Laboratory>
<ReportNumber>0</ReportNumber><ReportDate>2024-01-01</ReportDate></Header>
<Emitter><Quantity>1</Quantity><Description>LED</Description><InputWattage>9</InputWattage>
<LuminousData><LuminousIntensity>
<NumberMeasured>2</NumberMeasured><NumberHorz>1</NumberHorz><NumberVert>2</NumberVert>
<Multiplier>100</Multiplier>       <Symm>Symm_Full</Symm>
<IntData h=\"0\" v=\"0\">1</IntData><IntData h=\"0\" v=\"90\">1</IntData>
</LuminousIntensity></LuminousData></Emitter></IESTM33-22>
";

/// Files in a map.
#[derive(Clone, Default)]
pub(crate) struct MapFiles(pub(crate) HashMap<String, Vec<u8>>);

impl MapFiles {
    /// The files of the small valid project.
    pub(crate) fn room() -> Self {
        Self::default()
            .with("room.obj", ROOM_OBJ)
            .with("room.mtl", ROOM_MTL)
            .with("lamp.ies", LAMP_IES)
    }

    pub(crate) fn with(mut self, path: &str, bytes: impl AsRef<[u8]>) -> Self {
        self.0.insert(path.to_owned(), bytes.as_ref().to_vec());
        self
    }
}

impl Files for MapFiles {
    fn read(&self, path: &str, _kind: FileKind) -> std::io::Result<Vec<u8>> {
        self.0.get(path).cloned().ok_or_else(|| Error::from(ErrorKind::NotFound))
    }
}

pub(crate) fn load_text(project: &str, files: &MapFiles) -> Result<Loaded, LoadError> {
    load("room.toml", project.as_bytes(), files)
}

/// Loads the small project over other geometry.
pub(crate) fn load_geometry(name: &str, files: &MapFiles) -> Result<Loaded, LoadError> {
    load_text(&PROJECT.replace("room.obj", name), files)
}

pub(crate) fn warnings_of(loaded: &Loaded) -> Vec<String> {
    loaded.warnings.iter().map(ToString::to_string).collect()
}

/// A deterministic stream of numbers: splitmix64 (Steele, Lea and Flood 2014).
pub(crate) struct Stream(pub(crate) u64);

impl Stream {
    pub(crate) fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    pub(crate) fn below(&mut self, n: usize) -> usize {
        (self.next() % n.max(1) as u64) as usize
    }
}
