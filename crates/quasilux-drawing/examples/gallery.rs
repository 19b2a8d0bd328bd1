//! One drawing of each kind, as SVG and as PNG with two pixels a unit, in the folder that is named:
//! `cargo run -p quasilux-drawing --example gallery -- DIR`.

use quasilux_drawing::diagram::{
    Axis, Diagram, Figure, Intensities, IntensityCurve, LegendEntry, Line, Lobe, LobeDiagram,
    Panel, Scale, Scatter, figure, intensities, lobes, scatter,
};
use quasilux_drawing::picture::{Caption, Cell, GridPicture, LuminancePicture, grid, luminance};
use quasilux_drawing::{Dash, Drawing, PALETTE, Stroke};
use std::path::PathBuf;

fn main() -> std::io::Result<()> {
    let folder = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| ".".to_owned()));
    let drawings = [
        ("convergence", convergence()),
        ("batwing", batwing()),
        ("lobes", two_lobes()),
        ("points", lattice()),
        ("grid", illuminance()),
        ("luminance", gradient()),
    ];
    for (name, drawing) in drawings {
        std::fs::write(folder.join(name).with_extension("svg"), drawing.to_svg())?;
        std::fs::write(folder.join(name).with_extension("png"), drawing.to_png(2.0))?;
    }
    Ok(())
}

/// Errors that fall with N^{-1/2} and with N^{-1}.
fn convergence() -> Drawing {
    let entries = [
        ("random, N^{\u{2212}1/2}", Stroke::solid(PALETTE[0], 2.0), -0.5),
        ("quasi-random", Stroke { dash: Dash::Dashed, ..Stroke::solid(PALETTE[1], 2.0) }, -1.0),
        ("a guide", Stroke { dash: Dash::Dotted, ..Stroke::solid([0x76; 3], 2.0) }, -1.5),
        ("another", Stroke { dash: Dash::DashDot, ..Stroke::solid(PALETTE[2], 2.0) }, -0.8),
    ];
    let numbers = || (6..=20).map(|k| libm::exp2(f64::from(k)));
    let panel = |title: &str| Panel {
        title: title.to_owned(),
        x: Axis::around("number of samples N", Scale::Log(2), numbers()),
        y: Axis::new("relative error", Scale::Log(10), [1e-6, 1.0]),
        lines: entries
            .iter()
            .map(|(_, stroke, slope)| Line {
                points: numbers().map(|n| [n, libm::pow(n, *slope)]).collect(),
                stroke: *stroke,
            })
            .collect(),
    };
    let entry = |(text, stroke, _): &(&str, Stroke, f64)| LegendEntry {
        text: (*text).to_owned(),
        stroke: Some(*stroke),
    };
    figure(&Figure {
        title: "Convergence".to_owned(),
        panels: vec![panel("one room"), panel("機 another room")],
        columns: 2,
        legend: vec![entries.iter().map(entry).collect()],
    })
}

fn curve(name: &str, stroke: Stroke, value: impl Fn(f64) -> f64) -> IntensityCurve {
    let degrees = (-180..=180).map(f64::from);
    let points = degrees.map(|gamma| [gamma, value(gamma.to_radians()).max(0.0)]).collect();
    IntensityCurve { name: name.to_owned(), points, stroke }
}

/// Two planes of a luminaire that shines down, and a little up.
fn batwing() -> Drawing {
    let wide =
        |gamma: f64| 300.0 * libm::cos(gamma) * (1.0 + 2.0 * libm::pow(libm::sin(gamma), 2.0));
    let narrow = |gamma: f64| if libm::cos(gamma) > 0.0 { 300.0 * libm::cos(gamma) } else { 60.0 };
    let dashed = Stroke { dash: Dash::Dashed, ..Stroke::solid(PALETTE[1], 2.2) };
    let curves = [
        curve("C0\u{2013}C180", Stroke::solid(PALETTE[0], 2.2), wide),
        curve("C90\u{2013}C270", dashed, narrow),
    ];
    intensities(&Intensities {
        title: "A batwing",
        subtitle: "1000 lm of the luminaire",
        curves: &curves,
        per_klm: Some(1.0),
        sides: ["C180, C270", "C0, C90"],
        diagram: Diagram::Both,
    })
}

fn two_lobes() -> Drawing {
    let lobe = |number: usize, incidence_deg: f64| Lobe {
        incidence_deg,
        curve: curve(
            &format!("{incidence_deg}\u{b0}"),
            Stroke::solid(PALETTE[number], 2.0),
            |gamma| {
                let away = libm::cos(gamma + std::f64::consts::PI + incidence_deg.to_radians());
                libm::pow(away.max(0.0), 20.0) + 0.2 * libm::cos(gamma).abs()
            },
        ),
    };
    let diagram = |side: &str| LobeDiagram {
        title: format!("light on the {side}"),
        lobes: vec![lobe(0, 0.0), lobe(1, 40.0)],
    };
    lobes("A satin sheet", &[diagram("front"), diagram("back")])
}

fn lattice() -> Drawing {
    let point = |i: i32| [(f64::from(i) + 0.5) / 64.0, f64::from(i) * 0.618_034 % 1.0];
    let points: Vec<[f64; 2]> = (0..64).map(point).collect();
    scatter(&Scatter {
        title: "A rank-1 lattice",
        subtitle: "64 points",
        labels: ["dimension 0", "dimension 1"],
        points: &points,
        cells: 8,
    })
}

fn illuminance() -> Drawing {
    let cells: Vec<Cell> = (0..20 * 12)
        .map(|cell| {
            let [x, y] = [f64::from(cell % 20) - 6.5, f64::from(cell / 20) - 5.5];
            let lux = 120.0 + 4e4 / (60.0 + x * x + y * y) * (1.0 - libm::exp(-0.1 * x * x));
            Cell { value: Some(lux), half_width: Some(2.0) }
        })
        .collect();
    grid(&GridPicture {
        caption: Caption {
            title: "机の上 workplane",
            project: "office",
            facts: &["average 498.0 ± 1.1 lx".to_owned(), "uniformity 0.43 ± 0.01".to_owned()],
            method: "path, sobol, owen, 16 \u{d7} 1 024 samples, 95 % intervals",
            caution: "stopped before the wanted tolerance was reached",
        },
        unit: "lx",
        origin_m: [0.5, 0.5, 0.8],
        u_m: [5.0, 0.0, 0.0],
        v_m: [0.0, 3.0, 0.0],
        counts: [20, 12],
        cells: &cells,
        target: Some(500.0),
        ..GridPicture::default()
    })
}

fn gradient() -> Drawing {
    let pixel = |i: u16| libm::exp(f64::from(i % 40) / 8.0 + f64::from(i / 40) / 20.0) as f32;
    let luminances: Vec<f32> = (0..40 * 25).map(pixel).collect();
    luminance(&LuminancePicture {
        caption: Caption { title: "window", method: "path", ..Caption::default() },
        resolution: [40, 25],
        luminances_cd_m2: &luminances,
    })
}
