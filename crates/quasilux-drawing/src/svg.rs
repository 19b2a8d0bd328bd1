//! The SVG 1.1 writer of drawings (W3C 2011), for print and the web.
//!
//! Text is text, so that it can be searched and read aloud; a viewer draws it with its own fonts.

use crate::drawing::{Drawing, Frame, Shape};
use crate::style::{Anchor, Colour, Stroke, TextStyle};
use crate::text::{self, HALO_PX, Run};
use std::fmt::Write;

/// The families that are asked for: Latin ones first, then those of systems and of Noto for the
/// East Asian scripts, from which a viewer takes the letters that the first ones lack.
const FONT: &str = "Helvetica, Arial, 'Liberation Sans', 'DejaVu Sans', 'Noto Sans', \
    'Noto Sans CJK JP', 'Noto Sans CJK SC', 'Noto Sans CJK KR', 'Hiragino Sans', 'PingFang SC', \
    'Apple SD Gothic Neo', 'Yu Gothic', 'Microsoft YaHei', 'Malgun Gothic', sans-serif";

impl Drawing {
    /// The drawing as an SVG file.
    #[must_use]
    pub fn to_svg(&self) -> String {
        let ([width, height], title) = (self.size_px.map(number), escaped(&self.title));
        let mut writer = Writer { file: String::new(), clips: 0 };
        writer.push(format_args!("<?xml version=\"1.0\" encoding=\"UTF-8\"?>"));
        writer.push(format_args!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"{FONT}\" role=\"img\">"
        ));
        writer.push(format_args!("<title>{title}</title>"));
        self.shapes.iter().for_each(|shape| writer.shape(shape));
        writer.push(format_args!("</svg>"));
        writer.file
    }
}

struct Writer {
    file: String,
    clips: usize,
}

impl Writer {
    fn push(&mut self, element: std::fmt::Arguments<'_>) {
        writeln!(self.file, "{element}").expect("strings grow");
    }

    fn shape(&mut self, shape: &Shape) {
        match shape {
            Shape::Fill { frame, colour } => self.fill(*frame, *colour),
            Shape::Lines { lines, stroke } => {
                let stroke = stroked(*stroke);
                let [line] = lines.as_slice() else {
                    let path = outlined(lines);
                    self.push(format_args!(
                        "<path d=\"{path}\" {stroke} stroke-linecap=\"round\"/>"
                    ));
                    return;
                };
                let element = if line.first() == line.last() { "polygon" } else { "polyline" };
                let points = places(line);
                self.push(format_args!("<{element} points=\"{points}\" {stroke}/>"));
            }
            Shape::Region { outlines, colour } => {
                let (path, colour) = (outlined(outlines), hex(*colour));
                self.push(format_args!("<path d=\"{path}\" fill=\"{colour}\"/>"));
            }
            Shape::Disk { centre_px: [x, y], radius_px, colour } => {
                let ([x, y, r], colour) = ([*x, *y, *radius_px].map(number), hex(*colour));
                self.push(format_args!(
                    "<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\" fill=\"{colour}\"/>"
                ));
            }
            Shape::Text { place_px, style, text } => self.text(*place_px, *style, text),
            Shape::Cells { frame, columns, colours } => self.cells(*frame, *columns, colours),
            Shape::Clipped { frame, shapes } => {
                self.clips += 1;
                let (clip, shape) = (self.clips, rectangle(*frame));
                self.push(format_args!("<clipPath id=\"clip{clip}\"><rect {shape}/></clipPath>"));
                self.push(format_args!("<g clip-path=\"url(#clip{clip})\">"));
                shapes.iter().for_each(|shape| self.shape(shape));
                self.push(format_args!("</g>"));
            }
        }
    }

    fn fill(&mut self, frame: Frame, colour: Colour) {
        let (shape, colour) = (rectangle(frame), hex(colour));
        self.push(format_args!("<rect {shape} fill=\"{colour}\"/>"));
    }

    fn text(&mut self, [x, y]: [f64; 2], style: TextStyle, text: &str) {
        let [left, base, size] = [x, y, style.size_px].map(number);
        let anchor = match style.anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let mut more = String::new();
        let [right, down] = style.direction;
        if [right, down] != [1.0, 0.0] {
            let turn = number(libm::atan2(down, right).to_degrees());
            write!(more, " transform=\"rotate({turn} {left} {base})\"").expect("strings grow");
        }
        if let Some(halo) = style.halo {
            let (halo, width) = (hex(halo), number(HALO_PX));
            write!(
                more,
                " stroke=\"{halo}\" stroke-width=\"{width}\" stroke-linejoin=\"round\" \
                 paint-order=\"stroke\""
            )
            .expect("strings grow");
        }
        let (colour, text) = (hex(style.colour), with_powers(text));
        self.push(format_args!(
            "<text x=\"{left}\" y=\"{base}\" font-size=\"{size}\" text-anchor=\"{anchor}\" \
             fill=\"{colour}\"{more}>{text}</text>"
        ));
    }

    /// Cells of one colour side by side are one rectangle.
    fn cells(&mut self, frame: Frame, columns: usize, colours: &[Colour]) {
        let rows = colours.len().div_ceil(columns.max(1));
        let size = [frame.size_px[0] / columns as f64, frame.size_px[1] / rows as f64];
        self.push(format_args!("<g shape-rendering=\"crispEdges\">"));
        for (row, colours) in colours.chunks(columns.max(1)).enumerate() {
            let mut column = 0;
            for run in colours.chunk_by(|a, b| a == b) {
                let [left, top] = frame.corner_px;
                let corner_px = [left + column as f64 * size[0], top + row as f64 * size[1]];
                let size_px = [run.len() as f64 * size[0], size[1]];
                self.fill(Frame { corner_px, size_px }, run[0]);
                column += run.len();
            }
        }
        self.push(format_args!("</g>"));
    }
}

fn rectangle(frame: Frame) -> String {
    let [[x, y], [width, height]] = [frame.corner_px, frame.size_px].map(|pair| pair.map(number));
    format!("x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"")
}

/// Points of a line; a closed one ends before its first point comes again.
fn places(line: &[[f64; 2]]) -> String {
    let open = if line.first() == line.last() { &line[1..] } else { line };
    let places = open.iter().map(|[x, y]| format!("{},{}", number(*x), number(*y)));
    places.collect::<Vec<_>>().join(" ")
}

/// The data of a path through several lines; a closed one ends before its first point comes again.
fn outlined(lines: &[Vec<[f64; 2]>]) -> String {
    let mut path = String::new();
    for line in lines {
        let is_closed = line.len() > 2 && line.first() == line.last();
        let open = if is_closed { &line[1..] } else { line };
        for (step, [x, y]) in open.iter().enumerate() {
            let letter = if step == 0 { 'M' } else { 'L' };
            write!(path, "{letter}{},{}", number(*x), number(*y)).expect("strings grow");
        }
        path.push_str(if is_closed { "Z" } else { "" });
    }
    path
}

fn stroked(stroke: Stroke) -> String {
    let (colour, width) = (hex(stroke.colour), number(stroke.width_px));
    let mut text = format!(
        "fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\" stroke-linejoin=\"round\""
    );
    let lengths: Vec<String> =
        stroke.dash.lengths().iter().map(|x| number(x * stroke.width_px)).collect();
    if !lengths.is_empty() {
        write!(text, " stroke-dasharray=\"{}\"", lengths.join(" ")).expect("strings grow");
    }
    text
}

fn hex([r, g, b]: Colour) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// At most two decimals: a hundredth of a pixel.
fn number(x: f64) -> String {
    let text = format!("{x:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    (if text == "-0" { "0" } else { text }).to_owned()
}

/// Text as XML allows it: no markup, no control characters.
fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            _ if character.is_control() => safe.push(' '),
            '\u{fffe}' | '\u{ffff}' => safe.push('\u{fffd}'),
            _ => safe.push(character),
        }
    }
    safe
}

/// `dy` counts from where the last letter stood, in em of the letters it moves: what follows raised
/// letters comes down again.
fn with_powers(text: &str) -> String {
    let (scale, rise) = (text::RAISED_SCALE, text::RAISED_EM);
    let (up, down) = (number(-rise / scale), number(rise));
    let mut marked = String::new();
    let mut was_raised = false;
    for Run { text, is_raised } in text::runs(text) {
        let text = escaped(text);
        match (is_raised, was_raised) {
            (true, _) => {
                write!(marked, "<tspan dy=\"{up}em\" font-size=\"{scale}em\">{text}</tspan>")
            }
            (false, true) => write!(marked, "<tspan dy=\"{down}em\">{text}</tspan>"),
            (false, false) => write!(marked, "{text}"),
        }
        .expect("strings grow");
        was_raised = is_raised;
    }
    marked
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let texts = [0.0, -0.001, 1.0, 10.0, 1.5, 2.0 / 3.0].map(number);
        assert_eq!(texts, ["0", "0", "1", "10", "1.5", "0.67"]);
    }

    #[test]
    fn text_is_escaped_and_powers_are_raised() {
        let mut drawing = Drawing::new("\"t\"", [10.0, 10.0]);
        drawing.text([0.0, 0.0], TextStyle::plain(Anchor::Start), "a<b & N^{-1}\u{0} end");
        let file = drawing.to_svg();
        assert!(file.contains("a&lt;b &amp; N<tspan dy=\"-0.5em\" font-size=\"0.72em\">-1"));
        assert!(file.contains(">-1</tspan><tspan dy=\"0.36em\">  end</tspan>"));
        assert!(file.contains("<title>&quot;t&quot;</title>"));
    }

    #[test]
    fn equal_neighbours_are_one_rectangle() {
        let mut drawing = Drawing::new("", [6.0, 4.0]);
        let frame = Frame { corner_px: [0.0, 0.0], size_px: [6.0, 4.0] };
        let (a, b) = ([1; 3], [2; 3]);
        drawing.cells(frame, 3, vec![a, a, b, b, b, b]);
        let file = drawing.to_svg();
        assert!(file.contains("<rect x=\"0\" y=\"0\" width=\"4\" height=\"2\" fill=\"#010101\"/>"));
        assert!(file.contains("<rect x=\"0\" y=\"2\" width=\"6\" height=\"2\" fill=\"#020202\"/>"));
        assert_eq!(file.matches("<rect").count(), 4);
    }
}
