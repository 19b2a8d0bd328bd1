//! What a project is made of: its text, and files and arrays that the text names.
//!
//! A project on disk has all of it in the folder of its file. One that a program makes may have
//! files and arrays in memory; these go before files of the same name in its folder. A
//! [bundle](bundle) has everything, and a [model](model) of another program becomes one.

mod arrays;
pub(crate) mod bundle;
mod model;

pub use arrays::Triangles;
pub(crate) use model::{Model, folder_of, is_model};

use crate::digest::{SceneFile, SceneIdentity, sha256_hex};
use crate::exit::CliError;
use crate::input;
use quasilux_scene::{FileKind, Files, Loaded, TriangleArrays, Warning, ifc_advice, load};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};

/// The text of a project with the files and arrays that it names.
#[derive(Clone, Debug)]
pub struct Source {
    /// What messages call the project file.
    pub(crate) name: String,
    text: Vec<u8>,
    /// The project file, where there is one.
    pub(crate) path: Option<PathBuf>,
    /// Of files that are not in memory, from the root.
    folder: Option<PathBuf>,
    files: BTreeMap<String, Vec<u8>>,
    triangles: BTreeMap<String, Triangles>,
    /// Parts of the model that it was made of, which it has not.
    findings: Vec<Warning>,
    /// Of the identity that it has to have.
    expected_sha256: Option<String>,
}

/// A loaded scene, and which one it is.
pub(crate) struct Identified {
    pub(crate) loaded: Loaded,
    pub(crate) identity: SceneIdentity,
}

impl Source {
    /// A project in memory; messages call its file `name`. It reaches no file on disk.
    #[must_use]
    pub fn in_memory(name: &str, text: impl Into<Vec<u8>>) -> Self {
        Self {
            name: name.to_owned(),
            text: text.into(),
            path: None,
            folder: None,
            files: BTreeMap::new(),
            triangles: BTreeMap::new(),
            findings: Vec::new(),
            expected_sha256: None,
        }
    }

    /// The same, with files that are not in memory in a folder.
    #[must_use]
    pub fn with_folder(self, folder: &Path) -> Self {
        Self { folder: Some(from_the_root(folder)), ..self }
    }

    /// The same with a file.
    #[must_use]
    pub fn with_file(mut self, name: &str, bytes: Vec<u8>) -> Self {
        self.files.insert(name.to_owned(), bytes);
        self
    }

    /// The same with geometry.
    #[must_use]
    pub fn with_triangles(mut self, name: &str, triangles: Triangles) -> Self {
        self.triangles.insert(name.to_owned(), triangles);
        self
    }

    /// A project on disk; messages name its files as the user does.
    pub(crate) fn at(path: &Path) -> Result<Self, CliError> {
        let name = path.display().to_string();
        let refuse = |what: &dyn std::fmt::Display| CliError::in_file(&name, None, what);
        if let Some(advice) = ifc_advice(&name) {
            return Err(refuse(&advice));
        }
        let source = match bundle::read(path).map_err(|error| refuse(&error))? {
            Some(bytes) => bundle::unpacked(&bytes).map_err(|what| refuse(&what))?,
            None if is_model(path) => return Self::of_model(&Model::at(path), None),
            None => {
                let text = input::read(path, input::MAX_PROJECT_BYTES);
                let text = text.map_err(|error| refuse(&error))?;
                let folder = path.parent().unwrap_or(Path::new(""));
                Self::in_memory(&name, text).with_folder(folder)
            }
        };
        Ok(Self { path: Some(path.to_owned()), ..source })
    }

    /// The text of the project.
    #[must_use]
    pub fn text(&self) -> &[u8] {
        &self.text
    }

    /// Loads the scene.
    pub(crate) fn load(&self) -> Result<Identified, CliError> {
        let reader = Reader { source: self, read: RefCell::default() };
        let mut loaded = load(&self.name, &self.text, &reader)?;
        loaded.warnings.splice(0..0, self.findings.iter().cloned());
        let own_name = Path::new(&self.name).file_name().unwrap_or_default();
        let own_name = own_name.to_string_lossy().into_owned();
        let own = SceneFile { path: own_name, sha256: Some(sha256_hex(&self.text)) };
        let others = reader.read.into_inner().into_iter();
        let others = others.map(|(path, sha256)| SceneFile { path, sha256 }).collect();
        let identity = SceneIdentity::new(own, others);
        match &self.expected_sha256 {
            Some(expected) if *expected != identity.sha256 => {
                let message = "the bundle loads to another scene than it was made of";
                Err(CliError::in_file(&self.name, None, message))
            }
            _ => Ok(Identified { loaded, identity }),
        }
    }

    /// The bytes of a file, whose name no geometry in memory may have.
    fn read(&self, name: &str, kind: FileKind) -> io::Result<Vec<u8>> {
        if self.triangles.contains_key(name) {
            return Err(io::Error::other("the geometry in memory has the name of this file"));
        }
        match (self.files.get(name), &self.folder) {
            (Some(bytes), _) => Ok(bytes.clone()),
            (None, Some(folder)) => input::read_kind(&folder.join(name), kind),
            (None, None) => Err(io::ErrorKind::NotFound.into()),
        }
    }
}

/// Hands out what a project names, and remembers what it was.
struct Reader<'a> {
    source: &'a Source,
    /// Digests of what was read, by name; `None` where there was no file.
    read: RefCell<BTreeMap<String, Option<String>>>,
}

impl Files for Reader<'_> {
    fn read(&self, path: &str, kind: FileKind) -> io::Result<Vec<u8>> {
        let outcome = self.source.read(path, kind);
        let digest = outcome.as_ref().ok().map(|bytes| sha256_hex(bytes));
        self.read.borrow_mut().insert(path.to_owned(), digest);
        outcome
    }

    fn triangles(&self, path: &str) -> Option<TriangleArrays<'_>> {
        let triangles = self.source.triangles.get(path)?;
        self.read.borrow_mut().insert(path.to_owned(), Some(sha256_hex(&triangles.to_bytes())));
        Some(triangles.arrays())
    }
}

/// A path that is the same from every folder.
pub(crate) fn from_the_root(path: &Path) -> PathBuf {
    std::path::absolute(path).unwrap_or_else(|_| {
        // Of an empty path there is none.
        std::env::current_dir().map_or_else(|_| path.to_owned(), |here| here.join(path))
    })
}
