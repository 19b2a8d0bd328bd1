//! SHA-256 (FIPS 180-4): of files, as `sha256sum` prints it, and of whole scenes.

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

/// Length of a digest.
pub(crate) const BYTES: usize = 32;

/// The digest of some bytes.
pub(crate) fn sha256(bytes: &[u8]) -> [u8; BYTES] {
    Sha256::digest(bytes).into()
}

/// The same in hexadecimal digits.
pub(crate) fn sha256_hex(bytes: &[u8]) -> String {
    hex(&sha256(bytes))
}

/// Bytes in hexadecimal digits.
pub(crate) fn hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// A file that a scene is made of.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SceneFile {
    /// As the project names it, relative to the project file, whose own name is the first.
    pub(crate) path: String,
    /// `None` where there is none and the scene does without.
    pub(crate) sha256: Option<String>,
}

/// What identifies a scene: the bytes of all files that were read for it, the project file first.
/// Bytes and not what was made of them, so that a user can check with `sha256sum` what has changed,
/// and no change of a parser passes for the same scene.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SceneIdentity {
    /// Of the list of digests and names, but for the project file's name.
    pub(crate) sha256: String,
    pub(crate) files: Vec<SceneFile>,
}

impl SceneIdentity {
    /// Of a project file and the files it needs; their order does not matter.
    pub(crate) fn new(project: SceneFile, mut others: Vec<SceneFile>) -> Self {
        others.sort_by(|a, b| a.path.cmp(&b.path));
        let line = |path: &str, sha256: &Option<String>| {
            format!("{}  {path}\n", sha256.as_deref().unwrap_or("missing"))
        };
        let mut list = line("", &project.sha256);
        others.iter().for_each(|file| list += &line(&file.path, &file.sha256));
        let files = std::iter::once(project).chain(others).collect();
        Self { sha256: sha256_hex(list.as_bytes()), files }
    }

    /// What has changed since `before`, by name.
    pub(crate) fn difference(&self, before: &Self) -> Option<String> {
        if self.sha256 == before.sha256 {
            return None;
        }
        // The first one is the project file, whatever it is called.
        let name = |number: usize, file: &SceneFile| {
            if number == 0 { String::new() } else { file.path.clone() }
        };
        let named = |identity: &Self| -> Vec<(String, SceneFile)> {
            let files = identity.files.iter().enumerate();
            files.map(|(number, file)| (name(number, file), file.clone())).collect()
        };
        let (now, then) = (named(self), named(before));
        let find = |list: &[(String, SceneFile)], key: &str| {
            list.iter().find(|(other, _)| other == key).map(|(_, file)| file.clone())
        };
        let mut changes = Vec::new();
        for (key, file) in &now {
            match find(&then, key) {
                None => changes.push(format!("{} is new", file.path)),
                Some(old) if old.sha256 != file.sha256 => {
                    changes.push(format!("{} has changed", file.path));
                }
                Some(_) => {}
            }
        }
        let gone = then.iter().filter(|(key, _)| find(&now, key).is_none());
        changes.extend(gone.map(|(_, file)| format!("{} is gone", file.path)));
        Some(if changes.is_empty() { "its files differ".to_owned() } else { changes.join(", ") })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn identity(files: &[(&str, &str)]) -> SceneIdentity {
        let file = |(path, content): &(&str, &str)| SceneFile {
            path: (*path).to_owned(),
            sha256: Some(sha256_hex(content.as_bytes())),
        };
        SceneIdentity::new(file(&files[0]), files[1..].iter().map(file).collect())
    }

    /// The example of FIPS 180-2, appendix B.1.
    #[test]
    fn the_digest_is_that_of_the_standard() {
        let digest = sha256_hex(b"abc");
        assert!(digest.starts_with("ba7816bf8f01cfea") && digest.ends_with("f20015ad"), "{digest}");
    }

    #[test]
    fn what_has_changed_is_named() {
        let before = identity(&[("a.toml", "1"), ("x.obj", "2"), ("y.ies", "3")]);
        let same = identity(&[("b.toml", "1"), ("y.ies", "3"), ("x.obj", "2")]);
        assert_eq!(same.difference(&before), None);
        let other = identity(&[("a.toml", "0"), ("x.obj", "2"), ("z.ies", "3")]);
        let change = other.difference(&before).unwrap();
        assert_eq!(change, "a.toml has changed, z.ies is new, y.ies is gone");
    }
}
