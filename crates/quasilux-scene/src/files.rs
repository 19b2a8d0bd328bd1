//! Where the bytes of a project come from, and how many of them there may be.

use std::io;

/// Kind of a file, as which it is read. Each has a size beyond which no file of it makes sense.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FileKind {
    /// Wavefront OBJ, glTF or GLB.
    Geometry,
    /// A Honeybee model.
    Model,
    /// A Radiance scene, or data, points and views that go with one.
    Radiance,
    /// Wavefront MTL.
    MaterialLibrary,
    /// A buffer of a glTF file.
    Buffer,
    /// A luminaire: LM-63, EULUMDAT or TM-33.
    Photometry,
    /// A product: GLDF, a container of luminaires with models and documents.
    Container,
    /// Tilt factors of an LM-63 file.
    Tilt,
    /// A measured surface.
    Bsdf,
    /// Weather of a site: EPW or WEA.
    Weather,
    /// A picture of the sky in Radiance's format.
    Panorama,
    /// A glazing product of the IGSDB.
    Glazing,
    /// When blinds are closed: CSV.
    Schedule,
}

impl FileKind {
    /// All kinds.
    pub const ALL: [Self; 13] = [
        Self::Geometry,
        Self::Model,
        Self::Radiance,
        Self::MaterialLibrary,
        Self::Buffer,
        Self::Photometry,
        Self::Container,
        Self::Tilt,
        Self::Bsdf,
        Self::Weather,
        Self::Panorama,
        Self::Glazing,
        Self::Schedule,
    ];

    /// Most bytes that a file of this kind can have.
    #[must_use]
    pub const fn max_bytes(self) -> u64 {
        match self {
            Self::Geometry | Self::Buffer => 2 << 30,
            Self::Panorama => 1 << 30,
            Self::Bsdf | Self::Container | Self::Model | Self::Radiance => 256 << 20,
            Self::MaterialLibrary | Self::Photometry | Self::Weather => 64 << 20,
            Self::Glazing | Self::Schedule => 16 << 20,
            Self::Tilt => 1 << 20,
        }
    }
}

/// How loaders reach files: the command line implements it over the file system, tests over maps.
pub trait Files {
    /// The bytes of a file. `path` is relative to the project file's folder, with forward
    /// slashes, as the project file writes it or a geometry file implies it. Of a file with more
    /// bytes than [`FileKind::max_bytes`] none should be read: an error ([`too_large`]) costs
    /// neither time nor memory. Loaders refuse it in any case.
    ///
    /// # Errors
    /// When the file cannot be read.
    fn read(&self, path: &str, kind: FileKind) -> io::Result<Vec<u8>>;

    /// The triangles that the project file calls `path` in its list of geometry, where they are in
    /// memory and not in a file. Asked first, whatever the name ends in.
    fn triangles(&self, _path: &str) -> Option<TriangleArrays<'_>> {
        None
    }
}

/// Triangles in memory, in the axes and the unit that the project file states for geometry.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TriangleArrays<'a> {
    /// Vertex positions. Those of equal coordinates become one.
    pub positions: &'a [[f64; 3]],
    /// Indices into `positions`, counter-clockwise seen from the front side.
    pub triangles: &'a [[u32; 3]],
    /// Index into `materials` for each triangle; empty where all have the first one.
    pub material_of: &'a [u32],
    /// Names of materials, as the project file has them. Without any, triangles have none.
    pub materials: &'a [String],
    /// Name of the object that the triangles are; empty where it is that of the arrays.
    pub object: &'a str,
}

/// That a file has more bytes than are read: `max_bytes`.
#[must_use]
pub fn too_large(max_bytes: u64) -> io::Error {
    let message = if max_bytes.is_multiple_of(1 << 20) {
        format!("the file is larger than {} MiB", max_bytes >> 20)
    } else {
        format!("the file is larger than {max_bytes} bytes")
    };
    io::Error::new(io::ErrorKind::FileTooLarge, message)
}

/// Reads a file, and holds it to the size of its kind whatever `files` does.
pub(crate) fn read(files: &dyn Files, path: &str, kind: FileKind) -> io::Result<Vec<u8>> {
    let bytes = files.read(path, kind)?;
    let max_bytes = kind.max_bytes();
    if bytes.len() as u64 > max_bytes { Err(too_large(max_bytes)) } else { Ok(bytes) }
}

/// Why a file cannot be read, in the words of no particular system.
pub(crate) fn reason(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "no such file".to_owned(),
        _ => error.to_string().replace('\n', "; "),
    }
}
