//! Files of a scene: which may be read, and how much of them.

use super::document::{Entry, parse, shown};
use crate::{FileKind, Files, LoadError, files as reading};
use std::collections::HashMap;
use std::rc::Rc;
use std::sync::Arc;

/// Most bytes of all scene files together.
const MAX_BYTES: u64 = 1 << 29;
/// Most names that are tried for files.
const MAX_TRIALS: u32 = 100_000;

/// A file of a scene.
pub(super) struct Include {
    pub(super) path: Arc<str>,
    pub(super) entries: Vec<Entry>,
}

/// A file that a primitive names.
#[derive(Clone)]
pub(super) struct DataFile {
    pub(super) path: Arc<str>,
    pub(super) text: Arc<str>,
}

/// Reads files, each once.
pub(super) struct Includes<'f> {
    files: &'f dyn Files,
    /// Folders of the files that the project names, and its own.
    roots: Vec<String>,
    known: HashMap<String, Rc<Include>>,
    texts: HashMap<String, DataFile>,
    bytes_left: u64,
    trials_left: u32,
}

/// Why a file is not there.
pub(super) enum Missing {
    /// It must not be read, or cannot be.
    Refused(String),
    /// It is wrong.
    Wrong(LoadError),
}

impl<'f> Includes<'f> {
    /// `names` are the files that the project names.
    pub(super) fn new(files: &'f dyn Files, names: &[&str]) -> Self {
        let mut roots: Vec<String> = Vec::new();
        for name in names.iter().copied().chain([""]) {
            let root = plain(folder(&name.replace('\\', "/")));
            if !roots.contains(&root) {
                roots.push(root);
            }
        }
        Self {
            files,
            roots,
            known: HashMap::new(),
            texts: HashMap::new(),
            bytes_left: MAX_BYTES,
            trials_left: MAX_TRIALS,
        }
    }

    /// A file that the project names.
    pub(super) fn named(&mut self, name: &str) -> Result<Rc<Include>, Missing> {
        self.entries(name)
    }

    /// A scene that a command in `of` names.
    pub(super) fn scene(&mut self, of: &str, name: &str) -> Result<Rc<Include>, Missing> {
        let mut last = None;
        for path in self.candidates(of, name).map_err(Missing::Refused)? {
            match self.entries(&path) {
                Err(Missing::Refused(why)) => last = last.or(Some(why)),
                found => return found,
            }
        }
        Err(Missing::Refused(last.unwrap_or_default()))
    }

    fn entries(&mut self, path: &str) -> Result<Rc<Include>, Missing> {
        if let Some(known) = self.known.get(path) {
            return Ok(Rc::clone(known));
        }
        let bytes = self.bytes(path, FileKind::Radiance).map_err(Missing::Refused)?;
        self.charge(bytes.len() as u64).map_err(Missing::Refused)?;
        let wrong = |error: LoadError| Missing::Wrong(error);
        quasilux_text::refuse_web_page(&bytes).map_err(|error| {
            wrong(LoadError::new(path, Some(error.position()), error.message()))
        })?;
        if bytes.starts_with(b"#?RADIANCE") {
            let message = "an octree or a picture; expected a scene file, which is a text";
            return Err(wrong(LoadError::new(path, None, message)));
        }
        let entries = parse(path, &String::from_utf8_lossy(&bytes)).map_err(wrong)?;
        let include = Rc::new(Include { path: path.into(), entries });
        self.known.insert(path.to_owned(), Rc::clone(&include));
        Ok(include)
    }

    /// A data file that something in `of` names.
    pub(super) fn data(
        &mut self,
        of: &str,
        name: &str,
        kind: FileKind,
    ) -> Result<DataFile, String> {
        let mut last = None;
        for path in self.candidates(of, name)? {
            if let Some(known) = self.texts.get(&path) {
                return Ok(known.clone());
            }
            match self.bytes(&path, kind) {
                Ok(bytes) => {
                    // Tables of numbers take more memory than their texts.
                    let times = if kind == FileKind::Radiance { 4 } else { 1 };
                    self.charge(times * bytes.len() as u64)?;
                    let text = String::from_utf8_lossy(&bytes).into();
                    let file = DataFile { path: path.as_str().into(), text };
                    self.texts.insert(path, file.clone());
                    return Ok(file);
                }
                Err(why) => last = last.or(Some(why)),
            }
        }
        Err(last.unwrap_or_default())
    }

    fn charge(&mut self, bytes: u64) -> Result<(), String> {
        self.bytes_left = self.bytes_left.checked_sub(bytes).ok_or_else(|| {
            format!("the files of the scene have more than {MAX_BYTES} bytes; expected fewer")
        })?;
        Ok(())
    }

    fn bytes(&mut self, path: &str, kind: FileKind) -> Result<Vec<u8>, String> {
        self.trials_left = self.trials_left.saturating_sub(1);
        if self.trials_left == 0 {
            return Err("the scene names too many files".to_owned());
        }
        reading::read(self.files, path, kind).map_err(|error| {
            let reason = reading::reason(&error);
            format!("cannot read \"{}\": {reason}; expected a readable file", shown(path))
        })
    }

    /// Where a file may be: beside the file that names it, as `xform` has it, or where the scene
    /// begins, as other programs have it.
    fn candidates(&self, of: &str, name: &str) -> Result<Vec<String>, String> {
        let outside = || {
            format!(
                "\"{}\" is outside of the folders of the scene and of the project, and not read; \
                 copy it there, and name it from there",
                shown(name)
            )
        };
        let name = name.replace('\\', "/");
        if name.starts_with(['/', '~']) || has_drive(&name) {
            return Err(outside());
        }
        let of = of.replace('\\', "/");
        let mut found = Vec::new();
        for base in [folder(&of)].into_iter().chain(self.roots.iter().map(String::as_str)) {
            let path =
                plain(&if base.is_empty() { name.clone() } else { format!("{base}/{name}") });
            if self.roots.iter().any(|root| is_below(root, &path)) && !found.contains(&path) {
                found.push(path);
            }
        }
        if found.is_empty() { Err(outside()) } else { Ok(found) }
    }
}

/// Whether a path begins with the letter of a drive.
fn has_drive(path: &str) -> bool {
    let bytes = path.as_bytes();
    bytes.len() > 1 && bytes[0].is_ascii_alphabetic() && bytes[1] == b':'
}

/// Whether a path without detours is in a folder; the empty one is the project's.
fn is_below(root: &str, path: &str) -> bool {
    let rest = if root.is_empty() {
        Some(path).filter(|path| !path.starts_with('/') && !has_drive(path))
    } else {
        path.strip_prefix(root).and_then(|rest| rest.strip_prefix('/'))
    };
    rest.is_some_and(|rest| !rest.split('/').any(|part| part == ".."))
}

/// The folder of a file; empty where it is that of the project.
fn folder(path: &str) -> &str {
    path.rsplit_once('/').map_or("", |(folder, _)| folder)
}

/// A path without detours.
fn plain(path: &str) -> String {
    let absolute = if path.starts_with("//") {
        "//"
    } else if path.starts_with('/') {
        "/"
    } else {
        ""
    };
    let mut parts: Vec<&str> = Vec::new();
    for part in path.split('/').filter(|part| !part.is_empty() && *part != ".") {
        match (part, parts.last()) {
            ("..", Some(&last)) if last != ".." && !last.ends_with(':') => {
                parts.pop();
            }
            _ => parts.push(part),
        }
    }
    format!("{absolute}{}", parts.join("/"))
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Nothing;

    impl Files for Nothing {
        fn read(&self, _path: &str, _kind: FileKind) -> std::io::Result<Vec<u8>> {
            Err(std::io::ErrorKind::NotFound.into())
        }
    }

    #[test]
    fn files_outside_are_refused() {
        let includes = Includes::new(&Nothing, &["rooms/a.rad"]);
        let names = |of, name| includes.candidates(of, name).unwrap();
        assert_eq!(names("rooms/a.rad", "b.rad"), ["rooms/b.rad", "b.rad"]);
        assert_eq!(names("rooms/x/a.rad", "./b.rad"), ["rooms/x/b.rad", "rooms/b.rad", "b.rad"]);
        assert_eq!(names("rooms/a.rad", "..\\mat/b.rad"), ["mat/b.rad"]);
        assert_eq!(names("rooms/a.rad", "12:30.rad")[0], "rooms/12:30.rad");
        for name in ["/etc/passwd", "../../b.rad", "C:\\b.rad", "~/b.rad", "x/../../../b.rad"] {
            assert!(includes.candidates("rooms/a.rad", name).is_err(), "{name}");
        }
    }

    #[test]
    fn detours_of_the_project_open_nothing() {
        let includes = Includes::new(&Nothing, &["sub/../a.rad"]);
        assert!(includes.candidates("sub/../a.rad", "../secret.rad").is_err());
        assert_eq!(includes.candidates("sub/../a.rad", "b.rad").unwrap(), ["b.rad"]);
    }

    /// Scenes of a project may lie above it, and elsewhere, with files beside them.
    #[test]
    fn files_are_beside_each_scene() {
        let scenes = ["../models/a.rad", "/data/b.rad", "D:\\rooms\\c.rad"];
        let includes = Includes::new(&Nothing, &scenes);
        let first = |of, name| includes.candidates(of, name).map(|found| found[0].clone());
        assert_eq!(first("../models/a.rad", "x/b.rad").unwrap(), "../models/x/b.rad");
        assert_eq!(first("/data/b.rad", "b.mat").unwrap(), "/data/b.mat");
        assert_eq!(first("D:\\rooms\\c.rad", "c.mat").unwrap(), "D:/rooms/c.mat");
        let refused = |of, name| !first(of, name).is_ok_and(|found| found.contains("secret"));
        assert!(refused("/data/b.rad", "../secret") && refused("/data/b.rad", "../../secret"));
        assert!(refused("../models/a.rad", "../secret"));
        assert!(refused("D:\\rooms\\c.rad", "../secret"));
        assert!(refused("D:\\rooms\\c.rad", "../../../secret"));
    }
}
