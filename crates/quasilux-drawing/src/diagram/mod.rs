//! Diagrams of lines and points: line plots, scatter plots, and the photometric diagrams of
//! luminaires and surfaces.
//!
//! [`scatter`] and [`scatters`] draw points of the unit square, [`figure`] a grid of line plots
//! with a common legend, [`intensities`] where a luminaire sends light, [`lobes`] where a surface
//! scatters it. Each returns a [`Drawing`](crate::Drawing). Colours are
//! [`PALETTE`](crate::PALETTE)'s; dashes tell the lines apart where there is no colour.

mod axis;
mod curve;
mod figure;
mod head;
mod intensities;
mod legend;
mod lobes;
mod panel;
mod polar;
mod scatter;

pub use axis::{Axis, Scale};
pub use curve::IntensityCurve;
pub use figure::{Figure, figure};
pub use intensities::{Diagram, Intensities, intensities};
pub use legend::LegendEntry;
pub use lobes::{Lobe, LobeDiagram, lobes};
pub use panel::{Line, Panel};
pub use scatter::{Scatter, scatter, scatters};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::Shape;
    use crate::style::{Dash, PALETTE, Stroke};

    /// Every element is closed in order, every attribute is quoted, and no number is missing: what
    /// a reader of XML insists on. Our files have neither comments nor sections of other kinds.
    fn assert_well_formed(file: &str) {
        let body =
            file.strip_prefix("<?xml version=\"1.0\" encoding=\"UTF-8\"?>").expect("a prolog");
        let mut open: Vec<&str> = Vec::new();
        for piece in body.split('<').skip(1) {
            let (tag, text) = piece.split_once('>').expect("a tag ends");
            assert!(tag.matches('"').count() % 2 == 0, "{tag}");
            assert!(!text.contains("&") || text.contains(';'), "{text}");
            if let Some(name) = tag.strip_prefix('/') {
                assert_eq!(open.pop(), Some(name));
            } else if !tag.ends_with('/') {
                open.push(tag.split(' ').next().expect("a name"));
            }
        }
        assert!(open.is_empty(), "{open:?} stay open");
        assert!(!file.contains("NaN") && !file.contains("inf"), "a number is missing");
    }

    #[test]
    fn a_scatter_is_well_formed_and_has_all_points_and_cells() {
        let points = [[0.0, 0.0], [0.5, 0.25], [1.0, 1.0], [f64::NAN, 0.5]];
        let file = scatter(&Scatter {
            title: "a <b> & \"c\"",
            subtitle: "",
            labels: ["x", "y"],
            points: &points,
            cells: 8,
        })
        .to_svg();
        assert_well_formed(&file);
        assert_eq!(file.matches("<circle").count(), 3);
        assert_eq!(file.matches("#bbbbbb").count(), 14);
        assert!(file.contains("cx=\"296\" cy=\"424\""));
    }

    #[test]
    fn intensities_are_well_formed_in_every_diagram() {
        let curve = |points: &[[f64; 2]]| IntensityCurve {
            name: "C0\u{2013}C180".to_owned(),
            points: points.to_vec(),
            stroke: Stroke::solid(PALETTE[0], 2.0),
        };
        let down = curve(&[[-180.0, 0.0], [-90.0, 0.0], [0.0, 300.0], [90.0, 0.0], [180.0, 0.0]]);
        let up = curve(&[[-180.0, 20.0], [0.0, 0.0], [0.0, 0.0], [180.0, 20.0]]);
        for curves in [vec![down.clone()], vec![up.clone()], vec![down, up], vec![curve(&[])]] {
            for diagram in [Diagram::Polar, Diagram::Cartesian, Diagram::Both] {
                for per_klm in [Some(2.0), None] {
                    let file = intensities(&Intensities {
                        title: "a < b",
                        subtitle: "",
                        curves: &curves,
                        per_klm,
                        sides: ["C180, C270", "C0, C90"],
                        diagram,
                    })
                    .to_svg();
                    assert_well_formed(&file);
                    assert!(file.contains("a &lt; b"));
                    assert_eq!(
                        file.contains("cd/klm"),
                        per_klm.is_some() && diagram != Diagram::Cartesian
                    );
                }
            }
        }
    }

    /// A long name of a luminaire is written whole, above the diagram.
    #[test]
    fn long_titles_take_more_lines() {
        let name = "RECESSED LUMINAIRE WITH A METAL ENCLOSURE, WHITE PAINTED REFLECTOR AND LOUVRE";
        let lines = |title: &str| {
            let drawing = intensities(&Intensities {
                title,
                subtitle: "1000 lm",
                curves: &[],
                per_klm: None,
                sides: ["", ""],
                diagram: Diagram::Polar,
            });
            let texts = drawing.shapes.iter().filter_map(|shape| match shape {
                Shape::Text { style, text, .. } if style.colour == crate::style::INK => {
                    Some(text.clone())
                }
                _ => None,
            });
            (texts.collect::<Vec<_>>(), drawing.size_px)
        };
        let ((one, short), (several, long)) = (lines("lamp"), lines(name));
        assert!(one.contains(&"lamp".to_owned()));
        assert!(several.join(" ").contains(name), "{several:?}");
        assert!(long[0] == short[0] && long[1] > short[1]);
    }

    /// What a legend needs more than the sheet is wide goes into further rows, for which there is
    /// room.
    #[test]
    fn a_legend_stays_on_its_sheet() {
        let curve = |number: usize| IntensityCurve {
            name: format!("C{number}.25\u{2013}C{}.25", number + 180),
            points: vec![[-180.0, 1.0], [180.0, 1.0]],
            stroke: Stroke::solid(PALETTE[number % PALETTE.len()], 2.0),
        };
        let entries_at = |count: usize| {
            let curves: Vec<IntensityCurve> = (0..count).map(curve).collect();
            let drawing = intensities(&Intensities {
                title: "",
                subtitle: "",
                curves: &curves,
                per_klm: None,
                sides: ["", ""],
                diagram: Diagram::Polar,
            });
            let is_entry = |text: &str| text.contains(".25");
            let places = drawing.shapes.iter().filter_map(|shape| match shape {
                Shape::Text { place_px, text, .. } if is_entry(text) => Some(*place_px),
                _ => None,
            });
            (places.collect::<Vec<_>>(), drawing.size_px)
        };
        let (one_row, [_, height]) = entries_at(3);
        assert!(one_row.iter().all(|[_, y]| *y == one_row[0][1]));
        let (places, size_px) = entries_at(10);
        assert_eq!(places.len(), 10);
        assert_eq!(size_px[1], height + 3.0 * (places[3][1] - places[0][1]));
        for [x, y] in places {
            assert!(x + crate::text::width_px("C9.25\u{2013}C189.25", 12.0) < size_px[0], "{x}");
            assert!(y < size_px[1] - 10.0, "{y}");
        }
    }

    #[test]
    fn a_figure_is_well_formed_whatever_it_shows() {
        let stroke = Stroke { colour: PALETTE[1], width_px: 1.0, dash: Dash::DashDot };
        let panel = |values: &[f64]| Panel {
            title: "N^{-1} < 2".to_owned(),
            x: Axis::new("N", Scale::Log(2), [1.0, 8.0]),
            y: Axis::around("error", Scale::Log(10), values.iter().copied()),
            lines: vec![Line { points: values.iter().map(|y| [2.0, *y]).collect(), stroke }],
        };
        let panels = vec![panel(&[1.0, 0.1]), panel(&[]), panel(&[0.0, f64::NAN, 3.0, 4.0])];
        let entry = LegendEntry { text: "a & b".to_owned(), stroke: Some(stroke) };
        let file = figure(&Figure {
            title: "three".to_owned(),
            panels,
            columns: 2,
            legend: vec![vec![entry]],
        })
        .to_svg();
        assert_well_formed(&file);
        assert_eq!(file.matches("<clipPath").count(), 3);
        let none = Figure { title: String::new(), panels: vec![], columns: 0, legend: vec![] };
        assert_well_formed(&figure(&none).to_svg());
    }
}
