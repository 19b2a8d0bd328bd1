//! The elements of an SVG file.

use super::style::{FONT, Stroke, TextStyle};
use std::fmt::Write;

/// A drawing: the origin is at the top left, y runs down, lengths are pixels.
#[derive(Clone, Debug)]
pub struct Drawing {
    size_px: [f64; 2],
    body: String,
    clips: usize,
}

/// A rectangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// The corner at the top left.
    pub corner_px: [f64; 2],
    /// Width and height.
    pub size_px: [f64; 2],
}

impl Frame {
    /// The place at these shares of the width from the left and of the height from the *bottom*.
    #[must_use]
    pub fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let ([left, top], [width, height]) = (self.corner_px, self.size_px);
        [left + x * width, top + (1.0 - y) * height]
    }
}

impl Drawing {
    /// A white drawing.
    #[must_use]
    pub fn new(size_px: [f64; 2]) -> Self {
        let mut drawing = Self { size_px, body: String::new(), clips: 0 };
        drawing.fill(Frame { corner_px: [0.0, 0.0], size_px }, "#ffffff");
        drawing
    }

    /// A filled rectangle.
    pub fn fill(&mut self, frame: Frame, colour: &str) {
        let shape = rectangle(frame);
        self.push(format_args!("<rect {shape} fill=\"{colour}\"/>"));
    }

    /// The border of a rectangle.
    pub fn outline(&mut self, frame: Frame, stroke: Stroke) {
        let (shape, stroke) = (rectangle(frame), stroked(stroke));
        self.push(format_args!("<rect {shape} {stroke}/>"));
    }

    /// A line through points; where one is not finite the line is broken.
    pub fn line(&mut self, points_px: &[[f64; 2]], stroke: Stroke) {
        let finite = |point: &[f64; 2]| point.iter().all(|x| x.is_finite());
        let stroke = stroked(stroke);
        for run in points_px.split(|point| !finite(point)).filter(|run| run.len() > 1) {
            let places: Vec<String> =
                run.iter().map(|[x, y]| format!("{},{}", number(*x), number(*y))).collect();
            let places = places.join(" ");
            self.push(format_args!("<polyline points=\"{places}\" {stroke}/>"));
        }
    }

    /// A filled disk; none where its place is not finite.
    pub fn disk(&mut self, [x, y]: [f64; 2], radius_px: f64, colour: &str) {
        if x.is_finite() && y.is_finite() {
            let [x, y, r] = [x, y, radius_px].map(number);
            self.push(format_args!("<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\" fill=\"{colour}\"/>"));
        }
    }

    /// A text on its base line; what stands in `^{..}` is raised.
    pub fn text(&mut self, [x, y]: [f64; 2], style: TextStyle, text: &str) {
        let [x, y, size] = [x, y, style.size_px].map(number);
        let (anchor, colour) = (style.anchor.name(), style.colour);
        let turn = if style.upwards {
            format!(" transform=\"rotate(-90 {x} {y})\"")
        } else {
            String::new()
        };
        let text = with_powers(text);
        self.push(format_args!(
            "<text x=\"{x}\" y=\"{y}\" font-size=\"{size}\" text-anchor=\"{anchor}\" \
             fill=\"{colour}\"{turn}>{text}</text>"
        ));
    }

    /// Draws, and shows only what is inside the frame.
    pub fn clipped(&mut self, frame: Frame, draw: impl FnOnce(&mut Self)) {
        self.clips += 1;
        let (clip, shape) = (self.clips, rectangle(frame));
        self.push(format_args!("<clipPath id=\"clip{clip}\"><rect {shape}/></clipPath>"));
        self.push(format_args!("<g clip-path=\"url(#clip{clip})\">"));
        draw(self);
        self.push(format_args!("</g>"));
    }

    /// The file; `title` is what a reader of the screen says.
    #[must_use]
    pub fn finish(self, title: &str) -> String {
        let ([width, height], title) = (self.size_px.map(number), escaped(title));
        format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
             <svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" font-family=\"{FONT}\" role=\"img\">\n\
             <title>{title}</title>\n{}</svg>\n",
            self.body
        )
    }

    fn push(&mut self, element: std::fmt::Arguments<'_>) {
        writeln!(self.body, "{element}").expect("strings grow");
    }
}

fn rectangle(frame: Frame) -> String {
    let [[x, y], [width, height]] = [frame.corner_px, frame.size_px].map(|pair| pair.map(number));
    format!("x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\"")
}

fn stroked(stroke: Stroke) -> String {
    let (colour, width) = (stroke.colour, number(stroke.width_px));
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

/// Raised text is smaller, and what follows it comes down again: `dy` counts from where the last
/// letter stood, in heights of the letters it moves.
fn with_powers(text: &str) -> String {
    let mut pieces = text.split("^{");
    let mut marked = escaped(pieces.next().unwrap_or(""));
    for piece in pieces {
        let (power, rest) = piece.split_once('}').unwrap_or((piece, ""));
        let (power, rest) = (escaped(power), escaped(rest));
        write!(marked, "<tspan dy=\"-0.5em\" font-size=\"0.72em\">{power}</tspan>")
            .expect("strings grow");
        if !rest.is_empty() {
            write!(marked, "<tspan dy=\"0.36em\">{rest}</tspan>").expect("strings grow");
        }
    }
    marked
}

#[cfg(test)]
mod tests {
    use super::super::{Anchor, TextStyle};
    use super::*;

    #[test]
    fn numbers_are_short() {
        let texts = [0.0, -0.001, 1.0, 10.0, 1.5, 2.0 / 3.0].map(number);
        assert_eq!(texts, ["0", "0", "1", "10", "1.5", "0.67"]);
    }

    #[test]
    fn text_is_escaped_and_powers_are_raised() {
        let mut drawing = Drawing::new([10.0, 10.0]);
        drawing.text([0.0, 0.0], TextStyle::plain(Anchor::Start), "a<b & N^{-1}\u{0} end");
        let file = drawing.finish("\"t\"");
        assert!(file.contains("a&lt;b &amp; N<tspan"));
        assert!(file.contains(">-1</tspan><tspan dy=\"0.36em\">  end</tspan>"));
        assert!(file.contains("<title>&quot;t&quot;</title>"));
    }

    #[test]
    fn what_is_not_finite_is_not_drawn() {
        let mut drawing = Drawing::new([10.0, 10.0]);
        let before = drawing.body.clone();
        drawing.disk([f64::NAN, 1.0], 1.0, "#000000");
        drawing
            .line(&[[0.0, 0.0], [1.0, f64::INFINITY], [2.0, 2.0]], Stroke::solid("#000000", 1.0));
        assert_eq!(drawing.body, before);
    }
}
