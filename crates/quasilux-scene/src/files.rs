//! Where the bytes of a project come from.

/// How loaders reach files: the command line implements it over the file system, tests over maps.
pub trait Files {
    /// The bytes of a file. `path` is relative to the project file's folder, with forward
    /// slashes, as the project file writes it or a geometry file implies it.
    ///
    /// # Errors
    /// When the file cannot be read.
    fn read(&self, path: &str) -> std::io::Result<Vec<u8>>;
}
