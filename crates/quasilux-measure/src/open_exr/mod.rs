//! The picture of a camera as numbers: an OpenEXR file of three layers, 32-bit floating point.
//!
//! The layers are parts of one multi-part file, each with its own channels, all in cd/m2: `rgb` (R, G,
//! B; the first, so that viewers show it), `luminance` (Y, which is 0.2126 R + 0.7152 G + 0.0722 B),
//! `half_width` (Y: half the width of the interval of the luminance, not a number where nothing is
//! known of it). Each says so in the attribute `unit`; `chromaticities` are those of BT.709 and
//! `whiteLuminance` is 1: R = G = B = 1 is 1 cd/m2.
//!
//! The format is that of "OpenEXR File Layout" (Academy Software Foundation, version 2 with the
//! multi-part flag): the headers of all parts, their tables of offsets, then blocks of 16 rows, each
//! compressed without loss (ZIP). Written here and not by a library because what is needed is less
//! than a library brings along; the tests read the files with one.

mod block;

use crate::CameraReport;
use quasilux_transport::Pixel;

/// The first four bytes of every OpenEXR file.
const MAGIC: u32 = 20_000_630;
/// Version 2, with the bit that says that there are several parts.
const VERSION: u32 = 2 | 1 << 12;
/// Code of the compression ZIP.
const ZIP: u8 = 3;
/// Rows that ZIP compresses together.
const ROWS: usize = 16;
/// Code of 32-bit floating point.
const FLOAT: u32 = 2;
/// x and y of red, green, blue and white (ITU-R BT.709-6, item 1.3 and 1.4).
const BT709: [f32; 8] = [0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329];

/// A layer, its channels in alphabetical order as the format wants them.
struct Part {
    name: &'static str,
    unit: &'static str,
    channels: &'static [Channel],
}

/// A channel: its name, and its value in a pixel.
struct Channel(&'static str, fn(&Pixel) -> f32);

const PARTS: [Part; 3] = [
    Part {
        name: "rgb",
        unit: "cd/m2",
        channels: &[
            Channel("B", |pixel| pixel.rgb_cd_m2[2]),
            Channel("G", |pixel| pixel.rgb_cd_m2[1]),
            Channel("R", |pixel| pixel.rgb_cd_m2[0]),
        ],
    },
    Part {
        name: "luminance",
        unit: "cd/m2",
        channels: &[Channel("Y", |pixel| pixel.luminance_cd_m2)],
    },
    Part {
        name: "half_width",
        unit: "cd/m2",
        channels: &[Channel("Y", |pixel| pixel.half_width_cd_m2.unwrap_or(f32::NAN))],
    },
];

/// The picture of a camera as an OpenEXR file.
#[must_use]
pub fn exr(camera: &CameraReport) -> Vec<u8> {
    let [width, height] = camera.resolution.map(|n| n as usize);
    let blocks = height.div_ceil(ROWS);
    let mut file = [MAGIC.to_le_bytes(), VERSION.to_le_bytes()].concat();
    for part in &PARTS {
        part.write_header(&mut file, camera.resolution, blocks);
    }
    file.push(0);
    let mut table = file.len();
    file.resize(table + 8 * PARTS.len() * blocks, 0);
    for (number, part) in (0_u32..).zip(&PARTS) {
        for (block, rows) in camera.pixels.chunks(ROWS * width).enumerate() {
            let offset = (file.len() as u64).to_le_bytes();
            file[table..table + 8].copy_from_slice(&offset);
            table += 8;
            let data = block::compressed(part.bytes(rows, width));
            let head = [number, (block * ROWS) as u32, data.len() as u32];
            file.extend(head.iter().flat_map(|word| word.to_le_bytes()));
            file.extend(data);
        }
    }
    file
}

impl Part {
    fn write_header(&self, file: &mut Vec<u8>, [width, height]: [u32; 2], blocks: usize) {
        let window = words([0, 0, width - 1, height - 1]);
        let mut attribute = |name: &str, kind: &str, value: &[u8]| {
            for text in [name, kind] {
                file.extend(text.as_bytes());
                file.push(0);
            }
            file.extend((value.len() as u32).to_le_bytes());
            file.extend(value);
        };
        attribute("channels", "chlist", &self.channel_list());
        attribute("chromaticities", "chromaticities", &floats(BT709));
        attribute("chunkCount", "int", &words([blocks as u32]));
        attribute("compression", "compression", &[ZIP]);
        attribute("dataWindow", "box2i", &window);
        attribute("displayWindow", "box2i", &window);
        attribute("lineOrder", "lineOrder", &[0]);
        attribute("name", "string", self.name.as_bytes());
        attribute("pixelAspectRatio", "float", &floats([1.0]));
        attribute("screenWindowCenter", "v2f", &floats([0.0, 0.0]));
        attribute("screenWindowWidth", "float", &floats([1.0]));
        attribute("type", "string", b"scanlineimage");
        attribute("unit", "string", self.unit.as_bytes());
        attribute("whiteLuminance", "float", &floats([1.0]));
        file.push(0);
    }

    fn channel_list(&self) -> Vec<u8> {
        let mut list = Vec::new();
        for Channel(name, _) in self.channels {
            list.extend(name.as_bytes());
            list.push(0);
            // The second word marks values to be stored as logarithms; no channel skips pixels.
            list.extend(words([FLOAT, 0, 1, 1]));
        }
        list.push(0);
        list
    }

    /// The values of some rows: row by row, in each channel by channel.
    fn bytes(&self, rows: &[Pixel], width: usize) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(4 * self.channels.len() * rows.len());
        for row in rows.chunks(width) {
            for Channel(_, value) in self.channels {
                bytes.extend(row.iter().flat_map(|pixel| value(pixel).to_le_bytes()));
            }
        }
        bytes
    }
}

fn words<const N: usize>(words: [u32; N]) -> Vec<u8> {
    words.iter().flat_map(|word| word.to_le_bytes()).collect()
}

fn floats<const N: usize>(floats: [f32; N]) -> Vec<u8> {
    floats.iter().flat_map(|float| float.to_le_bytes()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::example::picture;
    use ::exr::prelude::{FlatSamples, ReadChannels, ReadLayers, Text, read};

    /// Resolutions with one row, with part of a block, and with several blocks.
    #[test]
    fn a_library_reads_what_was_written() {
        for resolution in [[1, 1], [7, 1], [5, 33], [64, 48]] {
            let report = picture(resolution, |x, y| 1.0 + f64::from(x * y) * 0.37);
            let camera = &report.cameras[0];
            let bytes = exr(camera);
            let image = read()
                .no_deep_data()
                .largest_resolution_level()
                .all_channels()
                .all_layers()
                .all_attributes()
                .non_parallel()
                .from_buffered(std::io::Cursor::new(&bytes))
                .expect("an OpenEXR file");
            let size = image.attributes.display_window.size;
            assert_eq!([size.x() as u32, size.y() as u32], resolution);
            assert_eq!(image.layer_data.len(), PARTS.len());
            for (layer, part) in image.layer_data.iter().zip(&PARTS) {
                let name = layer.attributes.layer_name.as_ref().map(Text::to_string);
                assert_eq!(name.as_deref(), Some(part.name));
                assert_eq!(layer.attributes.white_luminance, Some(1.0));
                let unit = format!("{:?}", layer.attributes.other);
                assert!(unit.contains("unit") && unit.contains("cd/m2"), "{unit}");
                let channels = &layer.channel_data.list;
                assert_eq!(channels.len(), part.channels.len());
                for (channel, Channel(name, value)) in channels.iter().zip(part.channels) {
                    assert_eq!(channel.name.to_string(), *name);
                    let FlatSamples::F32(values) = &channel.sample_data else { panic!("floats") };
                    let wanted = camera.pixels.iter().map(|pixel| value(pixel).to_bits());
                    assert!(values.iter().map(|x| x.to_bits()).eq(wanted), "{resolution:?} {name}");
                }
            }
        }
    }
}
