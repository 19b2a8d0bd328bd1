//! Large files of measured surfaces, numbers as programs write them: as much memory as they take
//! decides what can be loaded.

use std::fmt::Write;

/// The name of a file, and what makes one of about this many bytes.
type Kind = (&'static str, fn(usize) -> Vec<u8>);

/// A file of each kind.
pub(crate) const KINDS: [Kind; 7] = [
    ("matrix.xml", matrix),
    ("tree.xml", tree),
    ("grey.astm", grey_astm),
    ("colours.astm", coloured_astm),
    ("grey.ddr", grey_ddr),
    ("colours.ddr", coloured_ddr),
    ("merl.binary", merl),
];

/// A value of eight decimals.
fn value(index: usize) -> f64 {
    (index % 997) as f64 / 3e3
}

/// Over a basis of one band, 11 bytes a value.
fn matrix(bytes: usize) -> Vec<u8> {
    let patches = (bytes as f64 / 11.0).sqrt() as usize;
    let basis = format!(
        "<AngleBasis><AngleBasisName>b</AngleBasisName><AngleBasisBlock><ThetaBounds>\
         <UpperTheta>90</UpperTheta></ThetaBounds><nPhis>{patches}</nPhis></AngleBasisBlock>\
         </AngleBasis>"
    );
    let of_block = "<ColumnAngleBasis>b</ColumnAngleBasis><RowAngleBasis>b</RowAngleBasis>";
    let mut values = String::with_capacity(bytes);
    for index in 0..patches * patches {
        write!(values, "{:.8},", value(index)).unwrap();
    }
    surface("Columns", &basis, of_block, &values)
}

/// Sixteen grids of rank 4, 11 bytes a value.
fn tree(bytes: usize) -> Vec<u8> {
    let of_block = "<AngleBasis>LBNL/Shirley-Chiu</AngleBasis>";
    let log_side = (1..).take_while(|log: &u32| (16 * 11) << (4 * log) <= 2 * bytes).last();
    let of_grid = 1_usize << (4 * log_side.unwrap_or(1));
    let mut data = String::with_capacity(bytes);
    for grid in 0..16 {
        data += "{ ";
        for index in 0..of_grid {
            write!(data, "{:.8} ", value(index + grid)).unwrap();
        }
        data += "}\n";
    }
    surface("TensorTree4", "", of_block, &format!("{{ {data} }}"))
}

/// A WINDOW file with one transmission.
pub(crate) fn surface(structure: &str, basis: &str, of_block: &str, data: &str) -> Vec<u8> {
    format!(
        "<WindowElement><Optical><Layer><DataDefinition><IncidentDataStructure>{structure}\
         </IncidentDataStructure>{basis}</DataDefinition><WavelengthData><Wavelength>Visible\
         </Wavelength><WavelengthDataBlock><WavelengthDataDirection>Transmission Front\
         </WavelengthDataDirection>{of_block}<ScatteringData>{data}</ScatteringData>\
         </WavelengthDataBlock></WavelengthData></Layer></Optical></WindowElement>"
    )
    .into_bytes()
}

/// Whole degrees and one digit: up to 890 incidences, a thousand would be the most, some 13 bytes a
/// line.
fn grey_astm(bytes: usize) -> Vec<u8> {
    astm(bytes, 13, "f", "1")
}

/// Values of four digits, some 33 bytes a line.
fn coloured_astm(bytes: usize) -> Vec<u8> {
    astm(bytes, 33, "R,G,B", "0.1234,0.1345,0.1456")
}

fn astm(bytes: usize, of_line: usize, columns: &str, f: &str) -> Vec<u8> {
    let thetas = 46;
    let of_plane = bytes / of_line / 89 / thetas;
    // Azimuths of exits in whole degrees.
    let planes = (of_plane / 90).clamp(1, 10);
    let phis = (of_plane / planes).clamp(8, 360);
    let mut text = String::with_capacity(bytes + bytes / 8);
    writeln!(text, "VARS theta_i,phi_i,theta_s,phi_s,{columns}").unwrap();
    for plane in 0..planes {
        for theta_i in 1..90 {
            for theta_s in 0..thetas {
                for phi in 0..phis {
                    let phi_s = phi * 360 / phis;
                    writeln!(text, "{theta_i},{plane},{theta_s},{phi_s},{f}").unwrap();
                }
            }
        }
    }
    text.into_bytes()
}

/// Seven bytes a value, over half a turn.
fn grey_ddr(bytes: usize) -> Vec<u8> {
    ddr(bytes, "BW", &["bw"])
}

fn coloured_ddr(bytes: usize) -> Vec<u8> {
    ddr(bytes, "RGB", &["red", "gre", "blu"])
}

fn ddr(bytes: usize, model: &str, blocks: &[&str]) -> Vec<u8> {
    let (sigmas, phis) = (19, 37);
    let thetas = bytes / 7 / sigmas / phis / blocks.len();
    let list = |count: usize, last: f64| -> String {
        (0..count).map(|i| format!("{:.5} ", last * i as f64 / (count - 1) as f64)).collect()
    };
    let mut text = String::with_capacity(bytes + bytes / 8);
    writeln!(text, "TypeSym PlaneSymmetrical TypeColorModel {model} TypeData Luminance Absolute")
        .unwrap();
    writeln!(text, "sigma {sigmas} {}", list(sigmas, 85.0)).unwrap();
    writeln!(text, "phi {phis} {}", list(phis, 180.0)).unwrap();
    writeln!(text, "theta {thetas} {}", list(thetas, 180.0)).unwrap();
    for block in blocks {
        writeln!(text, "{block} def").unwrap();
        for _ in 0..sigmas * phis {
            for theta in 0..thetas {
                write!(text, "{:.4} ", 0.2 + 0.1 * theta as f64 / thetas as f64).unwrap();
            }
            text.push('\n');
        }
        text += "enddef\n";
    }
    text.into_bytes()
}

fn merl(bytes: usize) -> Vec<u8> {
    let azimuths = (bytes / 24 / 100 / 100).clamp(2, 1000);
    let counts = [100_i32, 100, azimuths as i32];
    let mut file: Vec<u8> = counts.iter().flat_map(|count| count.to_le_bytes()).collect();
    file.extend((0..3 * 10_000 * azimuths).flat_map(|index| (100.0 * value(index)).to_le_bytes()));
    file
}
