//! Measured surfaces: small undamaged files, and what must hold of any that load.

use glam::DVec3;
use quasilux_bsdf::{Distribution, MeasuredBsdf, SheetDistribution};
use quasilux_photometry::Angles;
use quasilux_stats::SplitMix64;

/// A matrix with a basis of its own, trees of both ranks, DDR, ASTM and MERL.
pub(crate) fn samples() -> Vec<Vec<u8>> {
    let xml = |structure: &str, basis: &str, blocks: &str| {
        format!(
            "<?xml version=\"1.0\"?>\n<WindowElement><Optical><Layer><Material><Name>a</Name>\n\
             <Thickness unit=\"meter\">0.1</Thickness></Material><DataDefinition>\n\
             <IncidentDataStructure> {structure} </IncidentDataStructure>{basis}</DataDefinition>\n\
             {blocks}</Layer></Optical></WindowElement>\n"
        )
    };
    let block = |direction: &str, bases: &str, values: &str| {
        format!(
            "<WavelengthData><Wavelength> Visible </Wavelength><WavelengthDataBlock>\n\
             <WavelengthDataDirection> {direction} </WavelengthDataDirection>\n{bases}\n\
             <ScatteringData>\n{values}\n</ScatteringData></WavelengthDataBlock></WavelengthData>\n"
        )
    };
    let band = |lower: u32, upper: u32, patches: u32| {
        format!(
            "<AngleBasisBlock><ThetaBounds><LowerTheta> {lower} </LowerTheta><UpperTheta> {upper} \
             </UpperTheta></ThetaBounds><nPhis> {patches} </nPhis></AngleBasisBlock>\n"
        )
    };
    let basis = "<AngleBasis><AngleBasisName>b</AngleBasisName>\n".to_owned()
        + &band(0, 30, 1)
        + &band(30, 90, 2)
        + "</AngleBasis>\n";
    let bases = "<ColumnAngleBasis>b</ColumnAngleBasis>\n<RowAngleBasis>b</RowAngleBasis>";
    let values = "0.5, 0.1,\t0.1\n 0.1 0.4 0.0\n 0.1 0 0.3";
    let matrix =
        block("Reflection Front", bases, values) + &block("Transmission Back", bases, values);
    let sphere = "<AngleBasis>LBNL/Shirley-Chiu</AngleBasis>";
    let leaves = |count: u32| (0..count).map(|i| format!("{{ 0.{i} }}\n")).collect::<String>();
    let grid = "{ 0.1 0.2 0.3 0.4 0.1 0.2 0.3 0.4 }\n";
    let rank_3 = block("Transmission Front", sphere, &format!("{{ {grid} {} }}", leaves(7)));
    let rank_4 = block("Transmission Front", sphere, &format!("{{ {} }}", leaves(16)));
    let ddr = ";; made up\nTypeSym PlaneSymmetrical\nTypeColorModel BW\n\
        TypeData Luminance Absolute\n\
               sigma 2\n 0 60\nphi 2\n 0 180\ntheta 3\n 0 10 90\nbw\n kbdf\n 1 0.5\n def\n\
               0.9 0.5 0\n 0.9 0.4 0\n 0.8 0.4 0\n 0.7 0.4 0\n enddef\n";
    let colours = "TypeSym ASymmetrical 4D\nTypeColorModel RGB\nTypeData Luminance Relative\n\
                   psi 2 0 90\nsigma 1 30\nphi 3 0 120 240\ntheta 2 0 90\n";
    let of_colour =
        |name: &str| format!("{name} kbdf 0.5 0.4\n def {} enddef\n", "1 0.5 ".repeat(6));
    let rgb = colours.to_owned() + &of_colour("red") + &of_colour("gre") + &of_colour("blu");
    let half = |angles: &str| ["0", "1.5708", "3.1416"].map(|phi| format!("{angles},{phi},0.2\n"));
    let lines: String = ["0,0,0.2", "0,0,1", "1,0,0.5", "1,0,2"].map(half).concat().concat();
    let astm = "NUM_POINTS 12\nVARS theta_i,phi_i,theta_s,phi_s,BRDF\n".to_owned() + &lines;
    let coloured = "VARS theta_i,phi_i,theta_s,phi_s,X,Y,Z\n\
        0.5 3 0.1 0 1 0.5 0.2\n0.5 3 0.1 1.5 1 0 0\n\
                    0.5 3 0.1 3 0.2 0.2 0.2\n0.5 3 0.1 4.6 0 0.1 0\n";
    let texts = [
        xml("Columns", &basis, &matrix),
        xml("TensorTree3", "", &rank_3),
        xml("TensorTree4", "", &rank_4),
        ddr.to_owned(),
        rgb,
        astm,
        coloured.to_owned(),
    ];
    let mut files: Vec<Vec<u8>> = texts.into_iter().map(String::into_bytes).collect();
    let mut merl: Vec<u8> = [2_i32, 3, 2].iter().flat_map(|count| count.to_le_bytes()).collect();
    let value = |i: i32| if i % 5 == 4 { -1.0 } else { f64::from(100 + 10 * i) };
    merl.extend((0..36).flat_map(|i| value(i).to_le_bytes()));
    files.push(merl);
    files
}

/// The name to read a file by: the content of DDR and DDT files does not tell which it is.
pub(crate) fn name(bytes: &[u8]) -> &'static str {
    if bytes.len().is_multiple_of(2) { "surface.ddr" } else { "surface.ddt" }
}

/// Samples, densities and shares are numbers that fit each other, also of the tables that paths
/// draw from: those with both directions swapped.
pub(crate) fn check(bsdf: &MeasuredBsdf, random: &mut SplitMix64) {
    let adjoint = bsdf.distributions().filter_map(|SheetDistribution { side, mode, .. }| {
        Some(SheetDistribution { side, mode, distribution: bsdf.adjoint(side, mode)? })
    });
    for SheetDistribution { side, mode, distribution } in bsdf.distributions().chain(adjoint) {
        let place = format!("{} {}", mode.name(), side.name());
        let mut uniform = || random.uniform();
        let angles = Angles { theta_rad: 1.5 * uniform(), phi_rad: 6.0 * uniform() };
        let us = [[0.0, 0.0], [1.0, 1.0], [uniform(), uniform()], [uniform(), uniform()]];
        for wi in [DVec3::Z, DVec3::Y, angles.direction()] {
            us.into_iter().for_each(|u| check_sample(distribution, wi, u, &place));
        }
        assert!(!distribution.incidences().is_empty());
    }
}

fn check_sample(distribution: &Distribution, wi: DVec3, u: [f64; 2], place: &str) {
    let luminance = |rgb: [f64; 3]| 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
    let albedo = distribution.albedo(wi);
    assert!(albedo.iter().all(|share| share.is_finite() && *share >= 0.0), "{place}: {albedo:?}");
    let Some(sample) = distribution.sample(wi, u) else {
        assert_eq!(luminance(albedo), 0.0, "{place} at {wi}");
        return;
    };
    assert!((sample.wo.length() - 1.0).abs() < 1e-12 && sample.wo.z >= 0.0, "{place}: {sample:?}");
    assert!(sample.pdf_sr > 0.0 && sample.pdf_sr.is_finite(), "{place}: {sample:?} of {u:?}");
    let again = distribution.pdf_sr(wi, sample.wo);
    assert!((again / sample.pdf_sr - 1.0).abs() < 1e-6, "{place}: {again} for {sample:?}");
    let f = luminance(distribution.evaluate(wi, sample.wo));
    let weight = f * sample.wo.z / again;
    let off = weight / luminance(albedo) - 1.0;
    assert!(off.abs() < 1e-9, "{place}: {weight} of {albedo:?} at {sample:?}");
    let back = distribution.invert(wi, sample.wo);
    assert!(back.is_some_and(|u| u.iter().all(|u| (0.0..=1.0).contains(u))), "{place}: {back:?}");
}
