//! Energy and reciprocity of tables, beside sums that share nothing with theirs.

use super::{analytic, ddr, direction, folder, surface};
use glam::DVec3;
use quasilux_bsdf::{
    AngleBasis, BandDefinition, BsdfAnalysis, BsdfFacts, BsdfFormat, Distribution, EnergyBalance,
    KlemsTable, MeasuredBsdf, ScatteringMode, SheetDistribution, Side, TensorTree, luminance,
};
use quasilux_photometry::Angles;
use quasilux_sampling::warp::sample_disk;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Ends of the bands of the full Klems basis in degrees, and patches.
const FULL: [(f64, f64, usize); 9] = [
    (0.0, 5.0, 1),
    (5.0, 15.0, 8),
    (15.0, 25.0, 16),
    (25.0, 35.0, 20),
    (35.0, 45.0, 24),
    (45.0, 55.0, 24),
    (55.0, 65.0, 24),
    (65.0, 75.0, 16),
    (75.0, 90.0, 12),
];

/// Projected solid angles of the 145 patches, by cosines of double angles.
fn projected_sr() -> Vec<f64> {
    let cos = |deg: f64| libm::cos(2.0 * deg.to_radians());
    let of_band = |(low, high, patches): (f64, f64, usize)| {
        vec![0.5 * PI * (cos(low) - cos(high)) / patches as f64; patches]
    };
    FULL.into_iter().flat_map(of_band).collect()
}

fn facts() -> BsdfFacts {
    BsdfFacts {
        format: BsdfFormat::WindowKlems,
        name: String::new(),
        manufacturer: String::new(),
        thickness_m: None,
    }
}

fn front(mode: ScatteringMode, distribution: Distribution) -> SheetDistribution {
    SheetDistribution { side: Side::Front, mode, distribution }
}

fn reflecting(table: Distribution) -> MeasuredBsdf {
    MeasuredBsdf::from_tables(facts(), [front(ScatteringMode::Reflection, table)])
}

/// The visible matrices of a file: side, mode, and the share of each incident patch, straight from
/// its text. Rows are exits.
fn matrices(text: &str) -> Vec<(Side, ScatteringMode, Vec<f64>)> {
    let weights = projected_sr();
    let element = |text: &str, name: &str| -> String {
        let from = text.find(&format!("<{name}>")).unwrap() + name.len() + 2;
        text[from..from + text[from..].find('<').unwrap()].trim().to_owned()
    };
    let mut found = Vec::new();
    for block in text.split("<WavelengthData>").skip(1) {
        let spectrum = block.split_once("<Wavelength unit").unwrap().1;
        let spectrum = spectrum.split_once('>').unwrap().1;
        if !spectrum.starts_with("Visible") {
            continue;
        }
        let words = element(block, "WavelengthDataDirection");
        let side = if words.ends_with("Front") { Side::Front } else { Side::Back };
        let mode = if words.starts_with("Refl") {
            ScatteringMode::Reflection
        } else {
            ScatteringMode::Transmission
        };
        let data = element(block, "ScatteringData");
        let numbers = data.split(|c: char| c == ',' || c.is_whitespace());
        let values: Vec<f64> =
            numbers.filter(|word| !word.is_empty()).map(|word| word.parse().unwrap()).collect();
        assert_eq!(values.len(), 145 * 145);
        let share = |column: usize| {
            (0..145).map(|row| weights[row] * values[145 * row + column].max(0.0)).sum()
        };
        found.push((side, mode, (0..145).map(share).collect()));
    }
    found
}

#[test]
fn matrices_have_the_figures_of_their_files() {
    let Some(folder) = folder() else {
        return;
    };
    let weights = projected_sr();
    let mut sides = 0;
    for name in [
        "klems-2011-SA1.xml",
        "klems-frads-aniso_high.xml",
        "klems-radbsdf-test_blinds_kf.xml",
        "klems-room-DiffuseGlass.xml",
        "klems-room-blinds.xml",
        "tt-radiance-sawtooth.xml",
    ] {
        let text = std::fs::read(folder.join(name)).unwrap();
        let shares = matrices(&String::from_utf8_lossy(&text));
        let bsdf = surface(name).unwrap();
        for balance in bsdf.analysis().clone().energy {
            let of_way = |wanted: ScatteringMode| -> Vec<f64> {
                let found = shares.iter().find(|(s, w, _)| (*s, *w) == (balance.side, wanted));
                found.map_or(vec![0.0; 145], |(_, _, shares)| shares.clone())
            };
            let [reflected, passed] = ScatteringMode::ALL.map(of_way);
            let diffuse = |shares: &[f64]| -> f64 {
                shares.iter().zip(&weights).map(|(share, weight)| share * weight / PI).sum()
            };
            let worst = reflected.iter().zip(&passed).map(|(r, p)| r + p).fold(0.0, f64::max);
            let expected = [diffuse(&reflected), diffuse(&passed), worst, reflected[0], passed[0]];
            let found = [
                balance.diffuse[0],
                balance.diffuse[1],
                balance.worst,
                balance.normal[0],
                balance.normal[1],
            ];
            println!("{name} {:?}: {found:.5?}", balance.side);
            for (found, expected) in found.into_iter().zip(expected) {
                assert!((found - expected).abs() < 1e-12, "{name}: {found} for {expected}");
            }
            sides += 1;
        }
    }
    assert_eq!(sides, 11);
}

/// A lattice of 128 boxes a side holds the boxes of all files: a sum of values is exact.
#[test]
fn trees_have_the_sums_of_their_values() {
    const SIDE: usize = 128;
    let middle = |i: usize| (i as f64 + 0.5) / SIDE as f64;
    for name in ["tt-pyradiance-t3.xml", "tt-room-blindsT3.xml", "radiance-testBSDF.xml"] {
        let Some(bsdf) = surface(name) else {
            return;
        };
        // The front of the first one passes light by reciprocity, in other pieces: see
        // `window_xml`.
        let is_given =
            |balance: &EnergyBalance| name != "tt-pyradiance-t3.xml" || balance.side == Side::Back;
        for balance in bsdf.analysis().clone().energy.into_iter().filter(is_given) {
            let mut diffuse = [0.0; 2];
            let mut worst = 0.0_f64;
            for i in 0..SIDE / 2 {
                let wi = upwards([-(1.0 - 2.0 * middle(i)), 0.0]);
                let mut shares = [0.0; 2];
                for (mode, share) in ScatteringMode::ALL.into_iter().zip(&mut shares) {
                    let Some(table) = bsdf.scattering(balance.side, mode) else { continue };
                    for place in 0..SIDE * SIDE {
                        let square = [middle(place / SIDE), middle(place % SIDE)];
                        *share += table.evaluate(wi, upwards(sample_disk(square)))[0];
                    }
                    *share *= PI / (SIDE * SIDE) as f64;
                }
                // Rings of the sine: their area is that of a midpoint.
                let part = 2.0 * (1.0 - 2.0 * middle(i)) * 2.0 / SIDE as f64;
                diffuse = [0, 1].map(|mode| diffuse[mode] + part * shares[mode]);
                worst = worst.max(shares[0] + shares[1]);
            }
            println!("{name} {:?}: {diffuse:.5?} {worst:.5}", balance.side);
            let expected = [diffuse[0], diffuse[1], worst];
            let found = [balance.diffuse[0], balance.diffuse[1], balance.worst];
            for (found, expected) in found.into_iter().zip(expected) {
                assert!((found / expected.max(1e-300) - 1.0).abs() < 1e-9 || found == expected);
            }
        }
    }
}

fn upwards([x, y]: [f64; 2]) -> DVec3 {
    DVec3::new(x, y, (1.0 - x * x - y * y).sqrt())
}

/// Of a tree turned round the greatest share is at the edge of a ring.
#[test]
fn a_tree_turned_round_has_its_true_maximum() {
    let Some(bsdf) = surface("tt-pyradiance-t3.xml") else {
        return;
    };
    let table = bsdf.scattering(Side::Front, ScatteringMode::Transmission).unwrap();
    let balance = bsdf.analysis().energy[0].clone();
    let (mut diffuse, mut worst) = (0.0, 0.0_f64);
    for i in 0..100_000 {
        let sin2 = (f64::from(i) + 0.5) / 1e5;
        let share = table.albedo(upwards([sin2.sqrt(), 0.0]))[0];
        diffuse += share / 1e5;
        worst = worst.max(share);
    }
    println!("{:.6} {diffuse:.6}, {:.6} {worst:.6}", balance.diffuse[1], balance.worst);
    assert!((balance.diffuse[1] / diffuse - 1.0).abs() < 1e-5);
    assert!(balance.worst >= worst && balance.worst < 1.005 * worst);
}

/// Rank 4, of light that depends on both angles of the incidence.
#[test]
fn anisotropic_trees_have_the_mean_of_their_shares() {
    let f = |wi: DVec3, wo: DVec3| (0.2 + 0.1 * wi.x) * (1.0 - 0.5 * wo.z * wi.y);
    let tree = TensorTree::from_function(false, 3, f).unwrap();
    let table = Distribution::TensorTree(tree);
    let (mut mean, mut worst) = (0.0, 0.0_f64);
    for place in 0..64 {
        let square = [place / 8, place % 8].map(|i| (f64::from(i) + 0.5) / 8.0);
        let share = table.albedo(upwards(sample_disk(square)))[0];
        mean += share / 64.0;
        worst = worst.max(share);
    }
    let energy = &reflecting(table).analysis().energy[0].clone();
    assert!((energy.diffuse[0] / mean - 1.0).abs() < 1e-12);
    assert!((energy.worst / worst - 1.0).abs() < 1e-12);
}

/// Shares of lobes by a fine quadrature over the incidence, isotropic and with azimuths.
#[test]
fn lobes_have_the_integral_of_their_shares() {
    let glossy = ddr::table(analytic::glossy, 4.0);
    let mut file = "TypeSym ASymmetrical\nTypeColorModel BW\nTypeData Luminance Relative\n\
                    psi 4 0 40 100 300 sigma 3 10 30 75 phi 2 0 180 theta 2 0 180\nbw kbdf "
        .to_owned();
    file += "0.3 0.5 0.2 0.1 0.9 0.6 0.4 0.4 0.8 0.2 0.7 0.95 def ";
    file += &("1 1 1 1 ".repeat(12) + "enddef");
    let read = quasilux_bsdf::read_ddr(file.as_bytes(), ScatteringMode::Reflection).unwrap();
    let planes = read.bsdf.scattering(Side::Front, ScatteringMode::Reflection).unwrap().clone();
    for table in [glossy, planes] {
        const ROWS: u32 = 2000;
        const COLUMNS: u32 = 360;
        let (mut diffuse, mut worst) = (0.0, 0.0_f64);
        for i in 0..ROWS {
            let theta_rad = FRAC_PI_2 * (f64::from(i) + 0.5) / f64::from(ROWS);
            let part = libm::sin(2.0 * theta_rad) * FRAC_PI_2 / f64::from(ROWS * COLUMNS);
            for j in 0..COLUMNS {
                let phi_rad = TAU * f64::from(j) / f64::from(COLUMNS);
                let share = luminance(table.albedo(Angles { theta_rad, phi_rad }.direction()));
                diffuse += part * share;
                worst = worst.max(share);
            }
        }
        let energy = &reflecting(table).analysis().energy[0].clone();
        println!("{:.6} {diffuse:.6}, {:.6} {worst:.6}", energy.diffuse[0], energy.worst);
        assert!((energy.diffuse[0] - diffuse).abs() < 1e-5 * diffuse);
        assert!(energy.worst >= worst && energy.worst < 1.001 * worst);
    }
}

/// No patch is overlooked: a pair of values in any place of a matrix shows, and its partner alike.
#[test]
fn each_pair_of_patches_is_looked_at() {
    let basis = || AngleBasis::known("LBNL/Klems Full").unwrap();
    for patch in 0..145 {
        let other = (patch + 60) % 145;
        let mut values = vec![0.0; 145 * 145];
        values[145 * patch + other] = 3.0;
        let table = KlemsTable::new(basis(), basis(), values).unwrap();
        let bsdf = reflecting(Distribution::Klems(table));
        let found =
            bsdf.analysis().reciprocity(Side::Front, ScatteringMode::Reflection).expect("light");
        assert_eq!((found.mean, found.worst), (1.0, 1.0), "patch {patch}");
    }
}

/// The greatest sum of two matrices over different patches is in the overlap of two of them.
#[test]
fn sums_over_different_patches_have_their_true_maximum() {
    let exit = || AngleBasis::new("all", &[BandDefinition::new(90.0, 1)]).unwrap();
    let table = |bands: [[f64; 2]; 2], bright: usize| {
        let bands =
            bands.map(|[upper_deg, patches]| BandDefinition::new(upper_deg, patches as usize));
        let basis = AngleBasis::new("bands", &bands).unwrap();
        let values = (0..basis.patches()).map(|i| if i == bright { 0.2 } else { 0.01 }).collect();
        Distribution::Klems(KlemsTable::new(basis, exit(), values).unwrap())
    };
    // 49 to 50 degrees, and an azimuth of 18 to 20 degrees.
    let reflected = table([[49.0, 1.0], [90.0, 9.0]], 1);
    let passed = table([[50.0, 10.0], [90.0, 1.0]], 1);
    let tables =
        [front(ScatteringMode::Reflection, reflected), front(ScatteringMode::Transmission, passed)];
    let bsdf = MeasuredBsdf::from_tables(facts(), tables);
    let balance = bsdf.analysis().energy[0].clone();
    assert!((balance.worst - 0.4 * PI).abs() < 1e-12, "{}", balance.worst);
    assert!(balance.worst_wi.angle_between(direction(49.5, 199.0)) < 0.02);
}

/// A lobe of six degrees that is twice as bright one way as the other, beside the sum over half a
/// million pairs.
#[test]
fn defects_of_narrow_lobes_are_measured() {
    let f = |wi: DVec3, wo: DVec3| {
        let factor = if wi.z < wo.z { 1.0 } else { 2.0 };
        let off = DVec3::new(wi.x + wo.x, wi.y + wo.y, 0.0).length();
        factor * libm::exp(-off * off / 0.02) + 1e-3
    };
    let table = Distribution::TensorTree(TensorTree::from_function(true, 6, f).unwrap());
    let (mut difference, mut sum) = (0.0, 0.0);
    for i in 0..32 {
        let sine = (f64::from(i) + 0.5) / 32.0;
        let a = upwards([sine, 0.0]);
        for place in 0..128 * 128 {
            let square = [place / 128, place % 128].map(|i| (f64::from(i) + 0.5) / 128.0);
            let b = upwards(sample_disk(square));
            let [forth, back] = [table.evaluate(a, b)[0], table.evaluate(b, a)[0]];
            difference += sine * (forth - back).abs();
            sum += sine * forth.max(back);
        }
    }
    let mean = difference / sum;
    let bsdf = reflecting(table);
    let found = bsdf.analysis().reciprocity(Side::Front, ScatteringMode::Reflection).unwrap();
    println!("{} for {mean}", found.mean);
    assert!((found.mean / mean - 1.0).abs() < 0.02);
}

/// Figures and adjoint tables are made once, and again after a table is put in.
#[test]
fn a_surface_keeps_its_figures_and_adjoint_tables() {
    let basis = || AngleBasis::known("LBNL/Klems Quarter").unwrap();
    let table =
        |f: f64| Distribution::Klems(KlemsTable::new(basis(), basis(), vec![f; 41 * 41]).unwrap());
    let mut bsdf = reflecting(table(0.1));
    let figures: *const BsdfAnalysis = bsdf.analysis();
    assert!(std::ptr::eq(figures, bsdf.analysis()));
    let (side, mode) = (Side::Front, ScatteringMode::Reflection);
    let adjoint: *const Distribution = bsdf.adjoint(side, mode).unwrap();
    assert!(std::ptr::eq(adjoint, bsdf.adjoint(side, mode).unwrap()));
    assert!(bsdf.adjoint(Side::Back, ScatteringMode::Reflection).is_none());
    assert!(bsdf.analysis().reciprocity(Side::Back, ScatteringMode::Reflection).is_none());
    bsdf.set(side, mode, table(0.2));
    assert!((bsdf.analysis().energy[0].diffuse[0] - 0.2 * PI).abs() < 1e-12);
    let value = bsdf.adjoint(side, mode).unwrap().evaluate(DVec3::Z, DVec3::Z);
    assert_eq!(value, [0.2; 3]);
}
