//! The text files of the workspace, without what builds and runs leave behind.

use std::fs;
use std::path::Path;

/// A text file.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct TextFile {
    /// Path from the workspace's root, with slashes.
    pub path: String,
    /// What is in it.
    pub text: String,
}

/// The files of a workspace whose names end in one of `endings`, sorted by path.
///
/// # Errors
/// When a folder or a file cannot be read.
pub fn of_workspace(root: &Path, endings: &[&str]) -> Result<Vec<TextFile>, String> {
    let mut files = Vec::new();
    let mut folders = vec![root.to_path_buf()];
    while let Some(folder) = folders.pop() {
        let told = |error: std::io::Error| format!("{}: {error}", folder.display());
        for entry in fs::read_dir(&folder).map_err(told)? {
            let path = entry.map_err(told)?.path();
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            if path.is_dir() && !name.starts_with('.') && name != "target" && name != "out" {
                folders.push(path);
            } else if endings.iter().any(|ending| name.ends_with(ending)) {
                let text = fs::read_to_string(&path).map_err(told)?;
                files.push(TextFile { path: relative(&path, root), text });
            }
        }
    }
    files.sort();
    Ok(files)
}

fn relative(path: &Path, root: &Path) -> String {
    let parts: Vec<_> = path.strip_prefix(root).unwrap_or(path).iter().collect();
    parts.iter().map(|part| part.to_string_lossy()).collect::<Vec<_>>().join("/")
}
