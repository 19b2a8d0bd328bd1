//! A year on disk: what is known of its sensor points, block by block, to go on from and to put
//! together with others.
//!
//! ```text
//! heading                       a container (`container`) without a body
//! block, block, ...             containers, each with some points behind those before
//! ```
//!
//! Blocks are only added, each forced to disk, so that a year of many points costs no more than it
//! weighs. One that was cut short or changed ends what is known.

use crate::atomic_file;
use crate::build;
use crate::checkpoint::Heading;
use crate::container::{self, Contents};
use crate::exit::CliError;
use crate::input;
use quasilux_report::annual::PointOfHours;
use quasilux_report::json;
use serde::{Deserialize, Serialize};
use std::fs::{File, OpenOptions};
use std::io::{self, BufReader, Read, Write};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Name and version of the format.
const FORMAT: &str = "quasilux-year/1";
/// A block: 64 points with all replicates of an hour's every minute.
const MAX_BLOCK_BYTES: u64 = 16 << 30;

/// What a year on disk says of itself.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct YearHeading {
    /// Its project, its scene and its settings.
    pub(crate) run: Heading,
    /// When people are there, where that was said on the command line.
    pub(crate) occupied_h: Option<Range<f64>>,
    /// The points that it is to have, numbered through all sensors.
    pub(crate) points: Range<usize>,
    /// How many points the sensors have.
    pub(crate) of: usize,
}

/// Points with what they took.
#[derive(Clone, Debug, Default)]
pub(crate) struct YearBlock {
    pub(crate) took: YearCost,
    pub(crate) points: Vec<PointOfHours>,
}

/// What points took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct YearCost {
    pub(crate) rays: u64,
    pub(crate) paths: u64,
    pub(crate) seconds: f64,
}

/// Adds blocks to a year on disk.
pub(crate) struct YearWriter(File);

/// Reads the blocks of a year on disk.
pub(crate) struct YearReader {
    /// What messages call it.
    pub(crate) name: String,
    path: PathBuf,
    file: BufReader<File>,
    pub(crate) heading: YearHeading,
    /// Bytes that were whole.
    whole: u64,
}

impl YearHeading {
    /// Why both are not of one year, if they are not.
    pub(crate) fn difference(&self, other: &Self) -> Option<&'static str> {
        let (own, theirs) = (&self.run, &other.run);
        [
            (own.scene.sha256 != theirs.scene.sha256, "the scene"),
            (own.settings != theirs.settings, "a setting or the seed"),
            (self.occupied_h != other.occupied_h, "--occupied"),
            (self.of != other.of, "the number of points"),
        ]
        .into_iter()
        .find_map(|(differs, what)| differs.then_some(what))
    }
}

impl YearWriter {
    /// A year that begins, in the place of what was there once its heading is whole.
    pub(crate) fn begin(path: &Path, heading: &YearHeading) -> io::Result<Self> {
        let bytes = container::encode(FORMAT, &json::text(heading), &[]);
        atomic_file::write_beside(path, |file| file.write_all(&bytes))?.publish()?;
        Ok(Self(OpenOptions::new().append(true).open(path)?))
    }

    /// Adds some points.
    pub(crate) fn add(&mut self, block: &YearBlock) -> io::Result<()> {
        let points = postcard::to_stdvec(&block.points).map_err(io::Error::other)?;
        self.0.write_all(&container::encode(FORMAT, &json::text(&block.took), &points))?;
        self.0.sync_data()
    }
}

/// Whether a file begins like a year on disk.
pub(crate) fn is_year(path: &Path) -> bool {
    let mut begin = Vec::new();
    let read = input::expect_regular(path)
        .and_then(|()| File::open(path)?.take(FORMAT.len() as u64).read_to_end(&mut begin));
    read.is_ok() && begin.starts_with(b"quasilux-year/")
}

impl YearReader {
    /// Reads the heading.
    pub(crate) fn open(path: &Path) -> Result<Self, CliError> {
        let name = path.display().to_string();
        let refuse = |what: String| CliError::in_file(&name, None, what);
        let open = || {
            input::expect_regular(path)?;
            let mut file = BufReader::new(File::open(path)?);
            let bytes = container::next(&mut file, FORMAT, input::MAX_PLAN_BYTES)?;
            Ok::<_, io::Error>((file, bytes.unwrap_or_default()))
        };
        let (file, bytes) = open().map_err(|error| refuse(error.to_string()))?;
        let Contents { header, .. } = container::decode(FORMAT, &bytes).map_err(refuse)?;
        let heading: YearHeading =
            serde_json::from_str(header).map_err(|error| refuse(format!("its header: {error}")))?;
        let Heading { version, build, .. } = &heading.run;
        build::expect(version, build).map_err(refuse)?;
        let YearHeading { points, of, .. } = &heading;
        if points.start >= points.end || points.end > *of {
            let Range { start, end } = points;
            return Err(refuse(format!("says points {start}..{end}, of {of} in all")));
        }
        let whole = bytes.len() as u64;
        Ok(Self { name, path: path.to_owned(), file, heading, whole })
    }

    /// The next block; `None` at the end of what was written.
    pub(crate) fn next(&mut self) -> Result<Option<YearBlock>, CliError> {
        let refuse = |what: String| CliError::in_file(&self.name, None, what);
        let bytes = container::next(&mut self.file, FORMAT, MAX_BLOCK_BYTES)
            .map_err(|error| refuse(error.to_string()))?;
        let Some(bytes) = bytes else { return Ok(None) };
        let Contents { header, body } = container::decode(FORMAT, &bytes).map_err(refuse)?;
        let took =
            serde_json::from_str(header).map_err(|error| refuse(format!("a block: {error}")))?;
        let points = postcard::from_bytes(body)
            .map_err(|error| refuse(format!("the points of a block: {error}")))?;
        self.whole += bytes.len() as u64;
        Ok(Some(YearBlock { took, points }))
    }

    /// Goes on behind the last block that was whole.
    pub(crate) fn go_on(self) -> io::Result<YearWriter> {
        let file = OpenOptions::new().append(true).open(&self.path)?;
        file.set_len(self.whole)?;
        Ok(YearWriter(file))
    }
}
