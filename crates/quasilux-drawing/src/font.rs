//! The bundled fonts: the glyph of each character, its advance width and its outline.
//!
//! The faces are subsets of Noto Sans, Noto Sans Math and Noto Sans CJK, in `fonts/` with their
//! licence (SIL Open Font License 1.1). A character comes from the first face that has it; one
//! that none has is drawn as U+FFFD. No font of the system is read, and outlines are computed
//! with basic operations alone, so that glyphs are the same on every machine. Lengths are in
//! em, the font size.

use glam::DVec2;
use std::sync::LazyLock;
use ttf_parser::{Face, GlyphId, OutlineBuilder};

/// Height of a capital in em: that of Noto Sans.
pub(crate) const CAPITAL_EM: f64 = 0.714;
/// Straight pieces for each curve of an outline.
const PIECES: u32 = 6;
/// Stands for characters that no face has.
const REPLACEMENT: char = '\u{fffd}';

/// In the order in which they are asked for a character; the last has the East Asian letters.
static FACES: LazyLock<[Face<'static>; 3]> = LazyLock::new(|| {
    [
        include_bytes!("../fonts/NotoSans-subset.ttf").as_slice(),
        include_bytes!("../fonts/NotoSansMath-subset.ttf").as_slice(),
        include_bytes!("../fonts/NotoSansCJK-subset.otf").as_slice(),
    ]
    .map(|file| Face::parse(file, 0).expect("bundled fonts are well-formed"))
});

/// A straight line from one point to another.
pub(crate) type Segment = [DVec2; 2];

/// The drawing of one character.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Glyph {
    /// Place in [`FACES`].
    face: usize,
    id: GlyphId,
}

impl Glyph {
    /// The glyph of a character. White space that no face has, such as a tabulator, is a space.
    pub(crate) fn new(c: char) -> Self {
        let space = c.is_whitespace().then_some(' ');
        [Some(c), space, Some(REPLACEMENT)]
            .into_iter()
            .flatten()
            .find_map(Self::find)
            .expect("a bundled font has the replacement")
    }

    fn find(c: char) -> Option<Self> {
        FACES.iter().enumerate().find_map(|(face, f)| Some(Self { face, id: f.glyph_index(c)? }))
    }

    /// Whether this is what stands for characters that no face has.
    #[cfg(test)]
    pub(crate) fn is_replacement(self) -> bool {
        Self::find(REPLACEMENT) == Some(self)
    }

    /// Distance to the next glyph in em.
    pub(crate) fn advance_em(self) -> f64 {
        let face = &FACES[self.face];
        f64::from(face.glyph_hor_advance(self.id).unwrap_or(0)) / f64::from(face.units_per_em())
    }

    /// The closed outlines in em as straight pieces, x to the right and y upward from the origin on
    /// the base line. The inside is where the winding number is not zero.
    pub(crate) fn outline_em(self) -> Vec<Segment> {
        let face = &FACES[self.face];
        let mut outline = Outline { scale: 1.0 / f64::from(face.units_per_em()), ..<_>::default() };
        // A glyph without an outline, such as a space, has no pieces.
        let _ = face.outline_glyph(self.id, &mut outline);
        outline.pieces
    }
}

/// Width of a line of text in em: the sum of its advances.
pub(crate) fn width_em(text: &str) -> f64 {
    text.chars().map(|c| Glyph::new(c).advance_em()).sum()
}

/// Collects an outline, its curves cut into straight pieces.
#[derive(Default)]
struct Outline {
    pieces: Vec<Segment>,
    scale: f64,
    start: DVec2,
    here: DVec2,
}

impl Outline {
    fn point(&self, x: f32, y: f32) -> DVec2 {
        DVec2::new(f64::from(x), f64::from(y)) * self.scale
    }

    fn line_to(&mut self, to: DVec2) {
        if to != self.here {
            self.pieces.push([self.here, to]);
            self.here = to;
        }
    }

    /// A curve to `end`, given by its points over the parameter in [0, 1].
    fn curve_to(&mut self, end: DVec2, at: impl Fn(f64) -> DVec2) {
        for piece in 1..PIECES {
            self.line_to(at(f64::from(piece) / f64::from(PIECES)));
        }
        self.line_to(end);
    }
}

impl OutlineBuilder for Outline {
    fn move_to(&mut self, x: f32, y: f32) {
        self.start = self.point(x, y);
        self.here = self.start;
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.line_to(self.point(x, y));
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        let (a, b, c) = (self.here, self.point(x1, y1), self.point(x, y));
        self.curve_to(c, |t| a.lerp(b, t).lerp(b.lerp(c, t), t));
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        let (a, b, c, d) = (self.here, self.point(x1, y1), self.point(x2, y2), self.point(x, y));
        self.curve_to(d, |t| {
            let [ab, bc, cd] = [a.lerp(b, t), b.lerp(c, t), c.lerp(d, t)];
            ab.lerp(bc, t).lerp(bc.lerp(cd, t), t)
        });
    }

    fn close(&mut self) {
        self.line_to(self.start);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One line for each script and repertoire that `fonts/README.md` promises.
    const COVERED: [&str; 11] = [
        "workplane 0123456789 !\"#$%&'()*+,-./:;<=>?@[\\]^_`{|}~",
        "façade œuvre Straße łódź ngọc ạ̈ ½ € № ™",
        "Ράβδος ΑΒΓΔ ᾠδή",
        "рабочая плоскость Ёж Їжак Ћуприја",
        "機 机の上 カーテン ｶｰﾃﾝ ―々〆ヶ、。「」〜",
        "工作面 办公桌 车间 照明",
        "辦公室 燈具 牆壁",
        "작업면 책상 똠방각하 ㄱㅎ",
        "→←↑↓ − ≤ ≥ ≠ ≈ ∞ √ ∑ ±×·°²³µ…–—",
        "①②③ ■□▲△●○",
        "ＡＢＣ　１２３",
    ];

    #[test]
    fn each_script_has_its_letters() {
        for c in COVERED.iter().flat_map(|line| line.chars()) {
            let glyph = Glyph::new(c);
            assert!(!glyph.is_replacement(), "{c} is missing");
            assert!(c.is_whitespace() || !glyph.outline_em().is_empty(), "{c} is empty");
        }
        assert!(('\u{ac00}'..='\u{d7a3}').all(|c| !Glyph::new(c).is_replacement()));
    }

    #[test]
    fn what_no_face_has_is_replaced_visibly() {
        for c in ['\u{5d0}', '\u{e01}', '\u{1f4a1}', '\u{e000}', '\u{0}'] {
            assert!(Glyph::new(c).is_replacement(), "{c:?}");
        }
        assert!(!Glyph::new(REPLACEMENT).outline_em().is_empty());
        assert_eq!(Glyph::new('\t'), Glyph::new(' '));
    }

    #[test]
    fn digits_are_of_one_width_and_capitals_of_the_stated_height() {
        for digit in '0'..='9' {
            assert_eq!(Glyph::new(digit).advance_em(), Glyph::new('0').advance_em());
        }
        let top = Glyph::new('H').outline_em().iter().flatten().map(|p| p.y).fold(0.0, f64::max);
        assert!((top - CAPITAL_EM).abs() < 1e-9);
        assert_eq!(width_em("机の上"), 3.0);
    }

    #[test]
    fn outlines_are_closed() {
        for c in COVERED.iter().flat_map(|line| line.chars()) {
            let turn: DVec2 = Glyph::new(c).outline_em().iter().map(|[a, b]| *b - *a).sum();
            assert!(turn.length() < 1e-9, "{c}");
        }
    }
}
