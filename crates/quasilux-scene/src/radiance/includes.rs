//! Files of a scene: which may be read, and how much of them.

use super::document::{Entry, parse, shown};
use crate::{FileKind, Files, LoadError, files as reading};
use std::collections::HashMap;
use std::rc::Rc;

/// Most bytes of all scene files together.
const MAX_BYTES: u64 = 1 << 29;
/// Most names that are tried for files.
const MAX_TRIALS: u32 = 100_000;

/// A file of a scene.
pub(super) struct Include {
    pub(super) path: Rc<str>,
    pub(super) entries: Vec<Entry>,
}

/// Reads files, each once.
pub(super) struct Includes<'f> {
    files: &'f dyn Files,
    /// Folder of the first file of the scene.
    root: String,
    known: HashMap<String, Rc<Include>>,
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
    pub(super) fn new(files: &'f dyn Files, first: &str) -> Self {
        Self {
            files,
            root: folder(first).to_owned(),
            known: HashMap::new(),
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
        self.bytes_left = self.bytes_left.saturating_sub(bytes.len() as u64);
        if self.bytes_left == 0 {
            let message = format!("the files of the scene have more than {MAX_BYTES} bytes");
            return Err(Missing::Refused(message));
        }
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

    /// Bytes of a data file that something in `of` names.
    pub(super) fn data(&mut self, of: &str, name: &str, kind: FileKind) -> Result<Vec<u8>, String> {
        let mut last = None;
        for path in self.candidates(of, name)? {
            match self.bytes(&path, kind) {
                Ok(bytes) => return Ok(bytes),
                Err(why) => last = last.or(Some(why)),
            }
        }
        Err(last.unwrap_or_default())
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
                "\"{}\" is outside of the scene's folder, and not read; copy it there, and name it \
                 from there",
                shown(name)
            )
        };
        let name = name.replace('\\', "/");
        if name.starts_with('/') || name.contains(':') || name.starts_with('~') {
            return Err(outside());
        }
        let above = self.root.split('/').filter(|part| *part == "..").count();
        let mut found = Vec::new();
        for base in [folder(of), &self.root] {
            let path =
                plain(&if base.is_empty() { name.clone() } else { format!("{base}/{name}") });
            let leaves =
                self.root.starts_with('/') && !path.starts_with(&format!("{}/", self.root));
            let climbs = leaves || path.split('/').filter(|part| *part == "..").count() > above;
            if !climbs && !found.contains(&path) {
                found.push(path);
            }
        }
        if found.is_empty() { Err(outside()) } else { Ok(found) }
    }
}

/// The folder of a file; empty where it is that of the project.
fn folder(path: &str) -> &str {
    path.rsplit_once('/').map_or("", |(folder, _)| folder)
}

/// A path without detours.
fn plain(path: &str) -> String {
    let is_absolute = path.starts_with('/') && !path.starts_with("//");
    let mut parts: Vec<&str> = Vec::new();
    for part in path.split('/').filter(|part| !part.is_empty() && *part != ".") {
        match (part, parts.last()) {
            ("..", Some(&last)) if last != ".." => {
                parts.pop();
            }
            _ => parts.push(part),
        }
    }
    let path = parts.join("/");
    if is_absolute && !parts.is_empty() { format!("/{path}") } else { path }
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
        let includes = Includes::new(&Nothing, "rooms/a.rad");
        let names = |of, name| includes.candidates(of, name).unwrap();
        assert_eq!(names("rooms/a.rad", "b.rad"), ["rooms/b.rad"]);
        assert_eq!(names("rooms/x/a.rad", "./b.rad"), ["rooms/x/b.rad", "rooms/b.rad"]);
        assert_eq!(names("rooms/a.rad", "..\\mat/b.rad"), ["mat/b.rad"]);
        for name in ["/etc/passwd", "../../b.rad", "C:\\b.rad", "~/b.rad", "x/../../../b.rad"] {
            assert!(includes.candidates("rooms/a.rad", name).is_err(), "{name}");
        }
        // What the project names may lie above it, and files beside that, too.
        let includes = Includes::new(&Nothing, "../models/a.rad");
        let names = |name| includes.candidates("../models/a.rad", name);
        assert_eq!(names("b.rad").unwrap(), ["../models/b.rad"]);
        assert_eq!(names("../b.rad").unwrap(), ["../b.rad"]);
        assert!(names("../../b.rad").is_err());
    }
}
