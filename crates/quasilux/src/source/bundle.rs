//! Bundles: everything that a scene is made of in one file or message, for another machine.
//!
//! A bundle is a [container](crate::container): the header lists pieces with their lengths, the
//! body is the pieces one after the other. What it loads to has the same identity as the project
//! that it was made of. It names no file of the machine that reads it.

use super::{Source, Triangles};
use crate::container::{self, Contents};
use crate::digest::{SceneIdentity, sha256_hex};
use crate::exit::CliError;
use quasilux_report::json;
use quasilux_scene::FileKind;
use serde::{Deserialize, Serialize};
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// Name and version of the format.
pub(crate) const FORMAT: &str = "quasilux-scene/1";
/// What files of any version begin with.
const MARK: &[u8] = b"quasilux-scene/";

/// What a bundle says of its body.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Heading {
    /// What messages call the project file.
    name: String,
    /// Of the scene's identity.
    sha256: String,
    pieces: Vec<Piece>,
}

/// A piece of the body.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Piece {
    kind: PieceKind,
    /// As the project names it; of the project itself, nothing.
    name: String,
    bytes: u64,
}

/// What a piece is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum PieceKind {
    Project,
    File,
    Triangles,
}

/// The bytes of a bundle; `None` where the file is none.
pub(crate) fn read(path: &Path) -> io::Result<Option<Vec<u8>>> {
    crate::input::expect_regular(path)?;
    let mut head = Vec::new();
    File::open(path)?.take(MARK.len() as u64).read_to_end(&mut head)?;
    if head == MARK { container::read(path).map(Some) } else { Ok(None) }
}

impl Source {
    /// Everything that the scene of this identity is made of. Files on disk are read again, and
    /// refused if they have changed.
    pub(crate) fn to_bundle(&self, identity: &SceneIdentity) -> Result<Vec<u8>, CliError> {
        let mut pieces = Vec::new();
        let mut body = Vec::new();
        let mut add = |kind, name: &str, content: &[u8]| {
            pieces.push(Piece { kind, name: name.to_owned(), bytes: content.len() as u64 });
            body.extend_from_slice(content);
        };
        add(PieceKind::Project, "", &self.text);
        for file in identity.files.iter().skip(1) {
            let Some(sha256) = &file.sha256 else { continue };
            if let Some(triangles) = self.triangles.get(&file.path) {
                add(PieceKind::Triangles, &file.path, &triangles.to_bytes());
                continue;
            }
            let refuse = |what: String| CliError::in_file(&file.path, None, what);
            let bytes = self.read(&file.path, FileKind::Geometry);
            let bytes = bytes.map_err(|error| refuse(error.to_string()))?;
            if sha256_hex(&bytes) != *sha256 {
                return Err(refuse("has changed since the scene was loaded".to_owned()));
            }
            add(PieceKind::File, &file.path, &bytes);
        }
        let sha256 = identity.sha256.clone();
        let heading = Heading { name: self.name.clone(), sha256, pieces };
        Ok(container::encode(FORMAT, &json::text(&heading), &body))
    }

    /// What a bundle is made of; loading it gives the scene that it was made of.
    ///
    /// # Errors
    /// For bytes that are no bundle, or not the whole one.
    pub fn from_bundle(bytes: &[u8]) -> Result<Self, CliError> {
        unpacked(bytes).map_err(|what| CliError::in_file("the bundle", None, what))
    }
}

/// What a bundle is made of, or what is wrong with it.
pub(super) fn unpacked(bytes: &[u8]) -> Result<Source, String> {
    let Contents { header, body } = container::decode(FORMAT, bytes)?;
    let heading: Heading =
        serde_json::from_str(header).map_err(|error| format!("its header: {error}"))?;
    let damaged = || "is damaged: its pieces are not what its header says".to_owned();
    let mut source = Source::in_memory(&heading.name, Vec::new());
    source.expected_sha256 = Some(heading.sha256);
    let mut rest = body;
    for piece in &heading.pieces {
        let length = usize::try_from(piece.bytes).map_err(|_| damaged())?;
        let (content, behind) = rest.split_at_checked(length).ok_or_else(damaged)?;
        rest = behind;
        match piece.kind {
            PieceKind::Project => source.text = content.to_vec(),
            PieceKind::File => source = source.with_file(&piece.name, content.to_vec()),
            PieceKind::Triangles => {
                let triangles = Triangles::from_bytes(content).ok_or_else(damaged)?;
                source = source.with_triangles(&piece.name, triangles);
            }
        }
    }
    if rest.is_empty() { Ok(source) } else { Err(damaged()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::project::Project;

    const PROJECT: &str = "[scene]\ngeometry = [\"floor\", \"wall.obj\"]\n\
        [[lights]]\nkind = \"point\"\nposition = [0.2, 0.2, 1]\nintensity_cd = 100\n\
        [[sensors]]\nname = \"s\"\nkind = \"points\"\n\
        points = [[0.1, 0.1, 0.5]]\nnormals = [[0, 0, 1]]\n";
    const WALL: &[u8] = b"mtllib none.mtl\nv 2 0 0\nv 2 1 0\nv 2 1 1\nf 1 2 3\n";

    fn source() -> Source {
        let floor = Triangles {
            positions: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            triangles: vec![[0, 1, 2]],
            ..Triangles::default()
        };
        Source::in_memory("room", PROJECT)
            .with_triangles("floor", floor)
            .with_file("wall.obj", WALL.to_vec())
    }

    /// What is missing, like the material file here, is missing there, too.
    #[test]
    fn a_bundle_loads_to_the_same_scene() {
        let project = Project::load(source()).unwrap();
        let bundle = project.to_bundle().unwrap();
        let again = Project::load(Source::from_bundle(&bundle).unwrap()).unwrap();
        assert_eq!(again.identity, project.identity);
        assert_eq!(again.identity.files.len(), 4);
        assert_eq!(again.loaded.scene.mesh, project.loaded.scene.mesh);
        assert_eq!(again.to_bundle().unwrap(), bundle);
        let other = source().with_file("wall.obj", [WALL, b"f 3 2 1\n"].concat());
        assert_ne!(Project::load(other).unwrap().identity.sha256, project.identity.sha256);
    }

    #[test]
    fn a_file_with_the_name_of_geometry_is_refused() {
        let lamp = "[[luminaires]]\nphotometry = \"a.ies\"\nposition = [0, 0, 1]\n";
        let with_lamp = Source { text: [PROJECT, lamp].concat().into_bytes(), ..source() };
        let with_both = with_lamp
            .with_triangles("a.ies", Triangles::default())
            .with_file("a.ies", b"IESNA91".to_vec());
        let error = Project::load(with_both).err().expect("a refusal").to_string();
        assert!(error.contains("has the name of this file"), "{error}");
    }

    #[test]
    fn what_is_no_bundle_is_refused() {
        let bundle = Project::load(source()).unwrap().to_bundle().unwrap();
        let refusal = |bytes: &[u8]| Source::from_bundle(bytes).unwrap_err().to_string();
        assert!(refusal(&bundle[..bundle.len() - 1]).contains("cut short or changed"));
        assert!(refusal(b"").contains("is no file of the format quasilux-scene/1"));
        let repacked = |change: &dyn Fn(&str) -> String, body: &[u8]| {
            let Contents { header, .. } = container::decode(FORMAT, &bundle).unwrap();
            container::encode(FORMAT, &change(header), body)
        };
        let body = container::decode(FORMAT, &bundle).unwrap().body;
        let same = str::to_owned;
        assert!(refusal(&repacked(&same, &body[1..])).contains("its pieces are not"));
        assert!(refusal(&repacked(&same, &[body, b"x"].concat())).contains("its pieces are not"));
        assert!(refusal(&repacked(&|_| "{}".to_owned(), body)).contains("its header: missing"));
        let huge = |header: &str| header.replacen("\"bytes\": ", "\"bytes\": 9", 1);
        assert!(refusal(&repacked(&huge, body)).contains("its pieces are not"));
        let mut changed = body.to_vec();
        changed[0] = b'#';
        let other = Source::from_bundle(&repacked(&same, &changed)).unwrap();
        assert!(Project::load(other).is_err());
        let mut changed = body.to_vec();
        let last = changed.len() - 1;
        changed[last] = b' ';
        let other = Source::from_bundle(&repacked(&same, &changed)).unwrap();
        let error = Project::load(other).err().expect("a refusal").to_string();
        assert!(error.contains("another scene"), "{error}");
    }
}
