//! How the result document is broken into lines.

use std::io::{Result, Write};

/// Indents the outer levels, keeps points and figures on one line each, and lists of plain values
/// on one line.
#[derive(Default)]
pub(super) struct Layout {
    /// The objects and arrays around the place that is written, outermost first.
    around: Vec<Level>,
}

/// An object or array that is open.
struct Level {
    is_array: bool,
    /// Whether its entries have lines of their own. Arrays know when their first entry begins.
    is_broken: bool,
    has_entries: bool,
}

/// From this depth on nothing is broken into lines: document, sensors, sensor and points are above.
const INLINE_DEPTH: usize = 5;

impl Layout {
    /// Begins an object or array. As the first entry of an array it decides how that is written.
    fn open<W: ?Sized + Write>(&mut self, writer: &mut W, is_array: bool) -> Result<()> {
        let depth = self.around.len();
        if let Some(outer) = self.around.last_mut()
            && outer.is_array
            && !outer.has_entries
            && depth < INLINE_DEPTH
        {
            outer.is_broken = true;
            self.new_line(writer)?;
        }
        let is_broken = !is_array && depth + 1 < INLINE_DEPTH;
        self.around.push(Level { is_array, is_broken, has_entries: false });
        writer.write_all(if is_array { b"[" } else { b"{" })
    }

    fn close<W: ?Sized + Write>(&mut self, writer: &mut W, bracket: &[u8]) -> Result<()> {
        if self.around.pop().is_some_and(|level| level.is_broken && level.has_entries) {
            self.new_line(writer)?;
        }
        writer.write_all(bracket)
    }

    /// Goes from one entry to the next, or to the first of an object.
    fn separate<W: ?Sized + Write>(&mut self, writer: &mut W, first: bool) -> Result<()> {
        let is_broken = self.around.last().is_some_and(|level| level.is_broken);
        match (is_broken, first) {
            (true, true) => self.new_line(writer),
            (false, true) => Ok(()),
            (true, false) => writer.write_all(b",").and_then(|()| self.new_line(writer)),
            (false, false) => writer.write_all(b", "),
        }
    }

    fn end_entry(&mut self) {
        if let Some(level) = self.around.last_mut() {
            level.has_entries = true;
        }
    }

    fn new_line<W: ?Sized + Write>(&self, writer: &mut W) -> Result<()> {
        writer.write_all(b"\n")?;
        self.around.iter().try_for_each(|_| writer.write_all(b"  "))
    }
}

impl serde_json::ser::Formatter for Layout {
    fn begin_array<W: ?Sized + Write>(&mut self, writer: &mut W) -> Result<()> {
        self.open(writer, true)
    }

    fn end_array<W: ?Sized + Write>(&mut self, writer: &mut W) -> Result<()> {
        self.close(writer, b"]")
    }

    fn begin_array_value<W: ?Sized + Write>(&mut self, writer: &mut W, first: bool) -> Result<()> {
        // What the first entry is, and so how the array is written, shows when it begins.
        if first { Ok(()) } else { self.separate(writer, false) }
    }

    fn end_array_value<W: ?Sized + Write>(&mut self, _: &mut W) -> Result<()> {
        self.end_entry();
        Ok(())
    }

    fn begin_object<W: ?Sized + Write>(&mut self, writer: &mut W) -> Result<()> {
        self.open(writer, false)
    }

    fn end_object<W: ?Sized + Write>(&mut self, writer: &mut W) -> Result<()> {
        self.close(writer, b"}")
    }

    fn begin_object_key<W: ?Sized + Write>(&mut self, writer: &mut W, first: bool) -> Result<()> {
        self.separate(writer, first)
    }

    fn begin_object_value<W: ?Sized + Write>(&mut self, writer: &mut W) -> Result<()> {
        writer.write_all(b": ")
    }

    fn end_object_value<W: ?Sized + Write>(&mut self, _: &mut W) -> Result<()> {
        self.end_entry();
        Ok(())
    }
}
