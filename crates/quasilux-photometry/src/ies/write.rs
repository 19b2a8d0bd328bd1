//! Writer of ANSI/IES LM-63 files.

use crate::angles::snapped;
use crate::shape::opening_in;
use crate::write::{Encoded, EncodingNote, Half, Writer, aligned, before, degrees, number};
use crate::{
    IesStandard, Keyword, LuminaireFacts, PhotometricType, Photometry, Standard, Symmetry, Tilt,
};
use std::f64::consts::FRAC_PI_2;

/// The file generation type that says nothing: "Undefined" (LM-63-2019, 5.13, table 2).
const UNDEFINED_GENERATION: f64 = 1.00001;

/// What stands behind a required keyword that the luminaire has no fact for.
const NO_FACT: &str = "(not given)";

/// Writes a luminaire as an LM-63 file of that edition.
///
/// Reading it back gives the same table. The values are the same bit for bit where a decimal exists
/// that the candela multiplier and the ballast factor turn into them, which is so for all that came
/// from an LM-63 file and wherever those factors are 1; elsewhere they are within one unit in the
/// last place. Angles that are multiples of 1e-9 degrees come back bit for bit; others within
/// 4e-15 rad.
///
/// - Type C has one plane at 0 for rotational symmetry, or planes from 0 to 90, 0 to 180, 90 to 270
///   or 0 to 360, the closing plane included. A half or a quarter on another side is mirrored to
///   the one that LM-63 stores. A table without its closing plane gets it.
/// - Types A and B keep their poles and all their angles (H, V), mirror images written out. A table
///   with symmetries of its own in one of these types is resampled to type C.
/// - Facts: all of LM-63 are kept. The dimensions are in metres, with the signs by
///   which the edition has the shape. The multiplier
///   holds what the ballast factor does not, for a luminaire that came from an LM-63 file, and is
///   1 for others.
/// - Keywords keep their names and order. Those that the edition requires are added at the end:
///   `[TEST]` and `[MANUFAC]` in 1991; these, `[TESTLAB]` and `[ISSUEDATE]` from 2002 on.
/// - The field behind the ballast factor is 1, but for two: in 1986 and 1991 it stays a factor that
///   a file of those editions gave, and in 2019 it is the file generation type, 1.00001
///   ("Undefined") if the luminaire did not come from a file of that edition.
/// - Lines have at most 80 characters up to `TILT=` and 132 behind it, 254 from 2002 on.
///
/// Whatever else had to be changed is in [`Encoded::notes`].
pub fn write_ies(photometry: &Photometry, edition: IesStandard) -> Encoded {
    let mut writer = Writer::default();
    let facts = photometry.facts();
    let web = Angles::new(photometry, &mut writer);
    let factors = Factors::new(facts, edition);
    // Without the two characters that end a line, which the limit of 2002 counts.
    let (text_limit, limit) =
        if edition >= IesStandard::Lm63Of2002 { (254, 254) } else { (80, 132) };

    write_header(facts, edition, text_limit, &mut writer);
    write_tilt(&facts.tilt, edition, limit, &mut writer);
    let opening = opening_in(Standard::Lm63(edition), facts.standard, &facts.opening);
    let lumens = facts.lumens_per_lamp.map_or("-1".to_owned(), number);
    let counts = [
        number(facts.lamp_count),
        lumens,
        number(factors.multiplier),
        web.vertical_deg.len().to_string(),
        web.horizontal_deg.len().to_string(),
        web.type_number.to_owned(),
        "2".to_owned(),
        number(opening.width_m),
        number(opening.length_m),
        number(opening.height_m),
    ];
    write_numbers(counts, limit, &mut writer);
    let last = [number(factors.ballast), factors.field_text(edition), number(facts.input_watts)];
    write_numbers(last, limit, &mut writer);
    write_table(&web, &factors, limit, &mut writer);
    writer.finish()
}

/// The angles of a file, and the values by them.
struct Angles {
    type_number: &'static str,
    vertical_deg: Vec<f64>,
    horizontal_deg: Vec<f64>,
    /// Intensities plane by plane: all vertical angles at the first horizontal one, then the next.
    values: Vec<f64>,
}

impl Angles {
    fn new(photometry: &Photometry, writer: &mut Writer) -> Self {
        let own = photometry.table().grid();
        let has_symmetry = matches!(
            own.symmetry,
            Symmetry::Rotational | Symmetry::Quadrant | Symmetry::Bilateral | Symmetry::Open
        );
        let kind = match photometry.facts().photometric_type {
            _ if has_symmetry => PhotometricType::C,
            kind => kind,
        };
        let grid =
            if kind == PhotometricType::C { aligned(photometry, Half::Back, writer) } else { own };
        // The poles of types A and B are at the ends of a latitude.
        let latitude = |theta: &f64| degrees(theta - FRAC_PI_2);
        let (rows, columns) = (grid.theta_rad.len(), grid.phi_rad.len());
        let row_deg: Vec<f64> = match kind {
            PhotometricType::C => grid.theta_rad.iter().map(|&theta| degrees(theta)).collect(),
            _ => grid.theta_rad.iter().map(latitude).collect(),
        };
        let column_deg: Vec<f64> = grid.phi_rad.iter().map(|&phi| degrees(phi)).collect();
        if kind == PhotometricType::B {
            // The latitude is the horizontal angle: its rows are the file's planes.
            let (vertical_deg, horizontal_deg) = (column_deg, row_deg);
            return Self { type_number: "2", vertical_deg, horizontal_deg, values: grid.values };
        }
        let by_plane = (0..columns).flat_map(|column| (0..rows).map(move |row| (row, column)));
        let values = by_plane.map(|(row, column)| grid.values[row * columns + column]).collect();
        let type_number = if kind == PhotometricType::A { "3" } else { "1" };
        Self { type_number, vertical_deg: row_deg, horizontal_deg: column_deg, values }
    }
}

/// Factors of the written candela values, in the order in which a reader multiplies them.
struct Factors {
    multiplier: f64,
    ballast: f64,
    /// What the field behind the ballast factor multiplies by: 1 but in old editions.
    field: f64,
    /// What stands there.
    written_field: f64,
}

impl Factors {
    fn new(facts: &LuminaireFacts, edition: IesStandard) -> Self {
        let positive = |x: f64| if x > 0.0 && x.is_finite() { x } else { 1.0 };
        let source = match facts.standard {
            Standard::Lm63(source) => Some(source),
            _ => None,
        };
        let is_factor = |standard: IesStandard| standard <= IesStandard::Lm63Of1991;
        let ballast = positive(facts.ballast_factor);
        let field = match source {
            Some(source) if is_factor(source) && is_factor(edition) => {
                positive(facts.ballast_lamp_field)
            }
            _ => 1.0,
        };
        let written_field = match source {
            _ if edition < IesStandard::Lm63Of2019 => field,
            Some(IesStandard::Lm63Of2019) => facts.ballast_lamp_field,
            _ => UNDEFINED_GENERATION,
        };
        let product = positive(facts.candela_factor);
        let multiplier = match source {
            Some(_) => before(product / (ballast * field), product, |x| x * ballast * field),
            None => 1.0,
        };
        Self { multiplier: positive(multiplier), ballast, field, written_field }
    }

    /// The file generation type is five decimals.
    fn field_text(&self, edition: IesStandard) -> String {
        let decimals = format!("{:.5}", self.written_field);
        let same = decimals.parse() == Ok(self.written_field);
        if edition >= IesStandard::Lm63Of2019 && same {
            decimals
        } else {
            number(self.written_field)
        }
    }

    /// The candela value that a reader turns into `intensity_cd`.
    fn candela(&self, intensity_cd: f64) -> String {
        let factor = self.multiplier * self.ballast * self.field;
        number(before(intensity_cd / factor, intensity_cd, |candela| candela * factor))
    }
}

fn write_header(facts: &LuminaireFacts, edition: IesStandard, limit: usize, writer: &mut Writer) {
    let (first, required): (_, &[&'static str]) = match edition {
        IesStandard::Lm63Of1986 => (None, &[]),
        IesStandard::Lm63Of1991 => (Some("IESNA91"), &["TEST", "MANUFAC"]),
        IesStandard::Lm63Of1995 => (Some("IESNA:LM-63-1995"), &[]),
        IesStandard::Lm63Of2002 => {
            (Some("IESNA:LM-63-2002"), &["TEST", "TESTLAB", "ISSUEDATE", "MANUFAC"])
        }
        IesStandard::Lm63Of2019 => {
            (Some("IES:LM-63-2019"), &["TEST", "TESTLAB", "ISSUEDATE", "MANUFAC"])
        }
    };
    if let Some(first) = first {
        writer.line(first);
    }
    for keyword in &facts.keywords {
        write_keyword(keyword, edition, limit, writer);
    }
    for name in required {
        if facts.keyword(name).is_none() {
            writer.line(&format!("[{name}] {NO_FACT}"));
            writer.note(EncodingNote::KeywordAdded(name));
        }
    }
}

fn write_keyword(keyword: &Keyword, edition: IesStandard, limit: usize, writer: &mut Writer) {
    let is_label = keyword.name.is_empty();
    let lines = keyword.value.split('\n').map(|line| line.replace(char::is_control, " "));
    let is_bare = is_label && edition == IesStandard::Lm63Of1986;
    let mut name = keyword.name.as_str();
    if is_label && !is_bare {
        writer.note(EncodingNote::LabelAsOther);
        name = "OTHER";
    }
    for line in lines {
        let mut rest = line.trim();
        loop {
            let start = if is_bare { String::new() } else { format!("[{name}] ") };
            let (piece, tail) = split(rest, limit.saturating_sub(start.chars().count()).max(1));
            writer.line(format!("{start}{piece}").trim_end());
            name = "MORE";
            if tail.is_empty() {
                break;
            }
            writer.note(EncodingNote::TextContinued);
            rest = tail;
        }
    }
}

/// As much of a text as fits into `room` characters, broken at a blank if there is one, and the
/// rest.
fn split(text: &str, room: usize) -> (&str, &str) {
    let Some((end, _)) = text.char_indices().nth(room) else {
        return (text, "");
    };
    let end = text[..end].rfind(' ').filter(|&blank| blank > 0).unwrap_or(end);
    (&text[..end], text[end..].trim_start())
}

fn write_tilt(tilt: &Tilt, edition: IesStandard, limit: usize, writer: &mut Writer) {
    match tilt {
        Tilt::None => writer.line("TILT=NONE"),
        Tilt::File(name) => {
            if edition >= IesStandard::Lm63Of2019 {
                writer.note(EncodingNote::TiltFile);
            }
            writer.line(&format!("TILT={}", name.replace(char::is_control, " ").trim()));
        }
        Tilt::Include { lamp_geometry, angles_rad, factors } => {
            writer.line("TILT=INCLUDE");
            writer.line(&lamp_geometry.to_string());
            writer.line(&angles_rad.len().to_string());
            write_numbers(angles_rad.iter().map(|&angle| number(degrees(angle))), limit, writer);
            write_numbers(factors.iter().map(|&factor| number(factor)), limit, writer);
        }
    }
}

fn write_table(web: &Angles, factors: &Factors, limit: usize, writer: &mut Writer) {
    let (first, last) = (web.vertical_deg[0], web.vertical_deg[web.vertical_deg.len() - 1]);
    if web.type_number == "1" && !(matches!(first, 0.0 | 90.0) && matches!(last, 90.0 | 180.0)) {
        writer.note(EncodingNote::PolarRange);
    }
    for angles in [&web.vertical_deg, &web.horizontal_deg] {
        if angles.iter().any(|&angle| snapped(angle, 90.0) != angle) {
            writer.note(EncodingNote::AngleNearAxis);
        }
        write_numbers(angles.iter().map(|&angle| number(angle)), limit, writer);
    }
    for plane in web.values.chunks_exact(web.vertical_deg.len()) {
        write_numbers(plane.iter().map(|&value| factors.candela(value)), limit, writer);
    }
}

/// Numbers with blanks between them, in lines of at most `limit` characters.
fn write_numbers(numbers: impl IntoIterator<Item = String>, limit: usize, writer: &mut Writer) {
    let mut line = String::new();
    for number in numbers {
        if !line.is_empty() && line.len() + 1 + number.len() > limit {
            writer.line(&line);
            line.clear();
        }
        if !line.is_empty() {
            line.push(' ');
        }
        line.push_str(&number);
    }
    writer.line(&line);
}
