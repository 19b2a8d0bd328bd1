//! A project with a glazing in its window: from the files of its products to illuminances.

use crate::support::{Folder, illuminances, parsed};

/// Refractive index and internal transmittance of two uncoated panes.
const PANES: [[f64; 2]; 2] = [[1.52, 0.95], [1.6, 0.7]];

/// Luminance outside, of the sky as of the ground.
const CD_M2: f64 = 1000.0;

/// The window spans the wall y = 0 of a black room of 2 m x 3 m x 2 m.
const WIDTH_M: f64 = 2.0;
const HEIGHT_M: f64 = 2.0;

/// Transmittance and reflectance for both polarisations: what is inside goes to and fro.
fn sheet(cos: f64, [eta, internal]: [f64; 2]) -> [[f64; 2]; 2] {
    let inside = (1.0 - (1.0 - cos * cos) / (eta * eta)).sqrt();
    let a = libm::pow(internal, 1.0 / inside);
    let across = (cos - eta * inside) / (cos + eta * inside);
    let within = (eta * cos - inside) / (eta * cos + inside);
    [across, within].map(|amplitude| {
        let r = amplitude * amplitude;
        let (mut through, mut back, mut light) = (0.0, r, 1.0 - r);
        for _ in 0..60 {
            through += light * a * (1.0 - r);
            back += light * a * r * a * (1.0 - r);
            light *= a * r * a * r;
        }
        [through, back]
    })
}

/// Both panes, unpolarised.
fn transmittance(cos: f64) -> f64 {
    let [a, b] = PANES.map(|pane| sheet(cos, pane));
    let polarised = |p: usize| {
        let ([t, r], [u, s]) = (a[p], b[p]);
        (0..60).map(|bounces| t * u * libm::pow(r * s, f64::from(bounces))).sum::<f64>()
    };
    0.5 * (polarised(0) + polarised(1))
}

/// The illuminance at a point by midpoints over the window.
fn integral(position: [f64; 3], normal: [f64; 3]) -> f64 {
    const N: usize = 400;
    let mut sum = 0.0;
    for i in 0..N * N {
        let part = |k: usize| (k as f64 + 0.5) / N as f64;
        let at = [part(i % N) * WIDTH_M, 0.0, part(i / N) * HEIGHT_M];
        let way: Vec<f64> = at.iter().zip(position).map(|(to, from)| to - from).collect();
        let length = way.iter().map(|x| x * x).sum::<f64>().sqrt();
        let cos = way.iter().zip(normal).map(|(a, b)| a * b).sum::<f64>() / length;
        let cos_window = -way[1] / length;
        sum += transmittance(cos_window) * cos.max(0.0) * cos_window / (length * length);
    }
    CD_M2 * sum * WIDTH_M * HEIGHT_M / (N * N) as f64
}

fn product(pane: [f64; 2]) -> String {
    let [[t, r], _] = sheet(1.0, pane);
    let line = |um: f64| format!("{{\"wavelength\": {um}, \"T\": {t}, \"Rf\": {r}, \"Rb\": {r}}}");
    format!(
        "{{\"type\": \"glazing\", \"subtype\": \"monolithic\", \"spectral_data\": \
         {{\"spectral_data\": [{}, {}]}}}}",
        line(0.38),
        line(0.78)
    )
}

const PROJECT: &str = r#"[scene]
geometry = ["room.obj"]

[materials.black]
reflectance = 0

[materials.window]
kind = "glazing"
layers = ["outer.json", "inner.json"]

[sky]
model = "uniform"
zenith_luminance_cd_m2 = 1000

[ground]
reflectance = 1

[[sensors]]
name = "inside"
kind = "points"
points = [[1, 1, 0.5], [0.3, 2.5, 1.2], [1.9, 0.4, 1]]
normals = [[0, 0, 1], [0, -1, 0], [-1, 0, 0]]
"#;

fn folder(name: &str) -> Folder {
    let folder = Folder::new(name);
    let room = "v 0 0 0\nv 2 0 0\nv 2 3 0\nv 0 3 0\nv 0 0 2\nv 2 0 2\nv 2 3 2\nv 0 3 2\n\
                usemtl black\nf 1 2 3 4\nf 5 8 7 6\nf 4 3 7 8\nf 1 4 8 5\nf 2 6 7 3\n\
                usemtl window\nf 1 2 6 5\n";
    folder.write("room.obj", room);
    folder.write("outer.json", product(PANES[0]));
    folder.write("inner.json", product(PANES[1]));
    folder.write("room.toml", PROJECT);
    folder
}

#[test]
fn a_window_of_two_panes_gives_the_integral_over_the_sky() {
    let folder = folder("glazing_window");
    let tolerance = ["--rel-tol", "0.002", "--seed", "1"];
    let document = parsed(&folder.document("room.toml", "out", &tolerance, 0));
    let places = [
        ([1.0, 1.0, 0.5], [0.0, 0.0, 1.0]),
        ([0.3, 2.5, 1.2], [0.0, -1.0, 0.0]),
        ([1.9, 0.4, 1.0], [-1.0, 0.0, 0.0]),
    ];
    let found = illuminances(&document);
    assert_eq!(found.len(), places.len());
    for ((lx, half_width_lx), (position, normal)) in found.into_iter().zip(places) {
        let expected = integral(position, normal);
        let off = (lx - expected).abs();
        assert!(
            off < 2.0 * half_width_lx + 5e-4 * expected && off < 0.004 * expected,
            "{lx} ± {half_width_lx} not {expected}"
        );
    }
}

#[test]
fn check_tells_what_a_glazing_does() {
    let folder = folder("glazing_check");
    let check = folder.quasilux(&["check", "room.toml"]);
    assert_eq!(check.code, Some(0), "{}", check.stderr);
    let line = check.stdout.lines().find(|line| line.contains("pane, transmittance")).unwrap();
    let [t, aslant] = [1.0, 0.5].map(|cos| format!("{:.3}", transmittance(cos)));
    assert!(line.contains(&format!("transmittance {t} ({aslant} at 60 degrees)")), "{line}");
    assert!(line.contains("(front)") && line.contains("(back), 4 m"), "{line}");
    folder.write("inner.json", "{\"spectral_data\":\n 3}");
    let check = folder.quasilux(&["check", "room.toml"]);
    assert_eq!(check.code, Some(2), "{}", check.stdout);
    assert!(check.stderr.contains("inner.json:2:2: found invalid type"), "{}", check.stderr);
}
