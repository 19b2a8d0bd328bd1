//! OpenEXR files of several layers in 32-bit floating point.
//!
//! Each layer is a part of one multi-part file ("OpenEXR File Layout", Academy Software Foundation,
//! version 2) with channels of its own, compressed without loss (ZIP, 16 rows a block), and names
//! its unit in the attribute `unit`. `chromaticities` are those of ITU-R BT.709 and
//! `whiteLuminance` is 1: R = G = B = 1 is one unit of luminance. Viewers show the first layer.

use exr::meta::attribute::Chromaticities;
use exr::prelude::{
    AnyChannel, AnyChannels, AttributeValue, Blocks, Compression, Encoding, FlatSamples, Image,
    ImageAttributes, IntegerBounds, LayerAttributes, Layers, LineOrder, Text, Vec2, WritableImage,
};

/// A layer of an image.
#[derive(Clone, Debug)]
pub struct Layer<'a> {
    /// Its name, unique in the file.
    pub name: &'a str,
    /// Unit of its values.
    pub unit: &'a str,
    /// Its channels.
    pub channels: Vec<Channel<'a>>,
}

/// A channel of a layer.
#[derive(Clone, Debug)]
pub struct Channel<'a> {
    /// Its name; viewers know R, G, B and Y.
    pub name: &'a str,
    /// Its values, row by row from the top left corner.
    pub values: Vec<f32>,
}

/// x and y of red, green, blue and white (ITU-R BT.709-6, items 1.3 and 1.4).
const BT709: Chromaticities = Chromaticities {
    red: Vec2(0.64, 0.33),
    green: Vec2(0.3, 0.6),
    blue: Vec2(0.15, 0.06),
    white: Vec2(0.3127, 0.329),
};

/// Layers of one resolution as an OpenEXR file.
///
/// # Panics
/// If there is no layer, a layer has no channel, or a channel does not have `width * height`
/// values.
#[must_use]
pub fn exr_bytes([width, height]: [u32; 2], layers: Vec<Layer<'_>>) -> Vec<u8> {
    let size = Vec2(width as usize, height as usize);
    let attributes = ImageAttributes {
        chromaticities: Some(BT709),
        ..ImageAttributes::new(IntegerBounds::from_dimensions(size))
    };
    let layers: Layers<AnyChannels<FlatSamples>> =
        layers.into_iter().map(|layer| written(layer, size)).collect();
    let mut file = std::io::Cursor::new(Vec::new());
    Image::from_layers(attributes, layers)
        .write()
        .non_parallel()
        .to_buffered(&mut file)
        .expect("memory takes layers of one size");
    file.into_inner()
}

fn written(layer: Layer<'_>, size: Vec2<usize>) -> exr::prelude::Layer<AnyChannels<FlatSamples>> {
    let mut attributes = LayerAttributes::named(layer.name);
    attributes.white_luminance = Some(1.0);
    let unit = AttributeValue::Text(Text::from(layer.unit));
    attributes.other.insert(Text::from("unit"), unit);
    let encoding = Encoding {
        compression: Compression::ZIP16,
        blocks: Blocks::ScanLines,
        line_order: LineOrder::Increasing,
    };
    let channels = layer.channels.into_iter().map(|channel| {
        assert_eq!(channel.values.len(), size.area(), "a channel of another image");
        AnyChannel::new(channel.name, FlatSamples::F32(channel.values))
    });
    exr::prelude::Layer::new(size, attributes, encoding, AnyChannels::sort(channels.collect()))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three layers of a resolution, the last with NaN.
    fn layers([width, height]: [u32; 2]) -> Vec<Layer<'static>> {
        let ramp = |factor: f32| (0..width * height).map(|i| factor * (i % 251) as f32).collect();
        let channel = |name, factor| Channel { name, values: ramp(factor) };
        let layer = |name, channels| Layer { name, unit: "cd/m2", channels };
        vec![
            layer("rgb", vec![channel("R", 0.37), channel("G", 1.0), channel("B", -2.0)]),
            layer("luminance", vec![channel("Y", 1e-3)]),
            layer("half_width", vec![channel("Y", f32::NAN)]),
        ]
    }

    /// A reader of the file layout by its own words: what stands at the beginning of the file, and
    /// the rows of one part. It shares nothing with the library that writes.
    struct Reader<'a>(&'a [u8]);

    impl Reader<'_> {
        fn bytes(&mut self, count: usize) -> &[u8] {
            let (head, rest) = self.0.split_at(count);
            self.0 = rest;
            head
        }

        fn word(&mut self) -> u32 {
            u32::from_le_bytes(self.bytes(4).try_into().expect("four bytes"))
        }

        fn text(&mut self) -> String {
            let end = self.0.iter().position(|byte| *byte == 0).expect("a zero ends a text");
            let text = String::from_utf8(self.bytes(end).to_vec()).expect("ASCII");
            self.bytes(1);
            text
        }

        /// The attributes of one header by their names; none at the end of all headers.
        fn header(&mut self) -> std::collections::BTreeMap<String, Vec<u8>> {
            let mut header = std::collections::BTreeMap::new();
            loop {
                let name = self.text();
                if name.is_empty() {
                    return header;
                }
                let _kind = self.text();
                let size = self.word() as usize;
                header.insert(name, self.bytes(size).to_vec());
            }
        }
    }

    /// Undoes ZIP: deflate, differences, and the separation of even and odd bytes.
    fn unzipped(data: &[u8], size: usize) -> Vec<u8> {
        if data.len() == size {
            return data.to_vec();
        }
        let mut bytes = miniz_oxide::inflate::decompress_to_vec_zlib(data).expect("deflated bytes");
        for i in 1..bytes.len() {
            bytes[i] = bytes[i - 1].wrapping_add(bytes[i]).wrapping_sub(128);
        }
        let (even, odd) = bytes.split_at(size.div_ceil(2));
        (0..size).map(|i| if i % 2 == 0 { even[i / 2] } else { odd[i / 2] }).collect()
    }

    fn little_endian(words: &[f32]) -> Vec<u8> {
        words.iter().flat_map(|word| word.to_le_bytes()).collect()
    }

    /// Resolutions with one row, with part of a block, and with several blocks.
    #[test]
    fn a_reader_written_after_the_file_layout_finds_headers_and_pixels() {
        for resolution in [[1, 1], [7, 1], [5, 33], [64, 48]] {
            let wanted = layers(resolution);
            let file = exr_bytes(resolution, layers(resolution));
            let mut reader = Reader(&file);
            assert_eq!(reader.word(), 20_000_630);
            assert_eq!(reader.word(), 2 | 1 << 12, "version 2, several parts");
            let headers: Vec<_> = (0..wanted.len()).map(|_| reader.header()).collect();
            assert!(reader.header().is_empty());
            let [width, height] = resolution;
            let blocks = height.div_ceil(16);
            for (header, layer) in headers.iter().zip(&wanted) {
                assert_eq!(header["name"], layer.name.as_bytes());
                assert_eq!(header["type"], b"scanlineimage");
                assert_eq!(header["unit"], layer.unit.as_bytes());
                assert_eq!(header["compression"], [3]);
                assert_eq!(header["chunkCount"], blocks.to_le_bytes());
                let window = [0, 0, width - 1, height - 1].map(u32::to_le_bytes);
                assert_eq!(header["dataWindow"], window.as_flattened());
                assert_eq!(header["displayWindow"], window.as_flattened());
                assert_eq!(header["whiteLuminance"], 1.0_f32.to_le_bytes());
                let bt709 = [0.64, 0.33, 0.3, 0.6, 0.15, 0.06, 0.3127, 0.329];
                assert_eq!(header["chromaticities"], little_endian(&bt709));
            }
            let mut seen = 0;
            let tables = wanted.len() * blocks as usize;
            let offsets: Vec<u8> = reader.bytes(8 * tables).to_vec();
            for (number, offset) in offsets.chunks(8).enumerate() {
                let offset = u64::from_le_bytes(offset.try_into().expect("eight bytes")) as usize;
                let mut block = Reader(&file[offset..]);
                let part = block.word() as usize;
                assert_eq!(part, number / blocks as usize);
                let top = block.word();
                let size = block.word() as usize;
                let rows = top as usize..(top as usize + 16).min(height as usize);
                let mut channels: Vec<&Channel<'_>> = wanted[part].channels.iter().collect();
                channels.sort_by_key(|channel| channel.name);
                let row = |y: usize| y * width as usize..(y + 1) * width as usize;
                let pixels: Vec<u8> = rows
                    .flat_map(|y| channels.iter().map(move |channel| &channel.values[row(y)]))
                    .flat_map(little_endian)
                    .collect();
                assert_eq!(unzipped(block.bytes(size), pixels.len()), pixels);
                seen += pixels.len();
            }
            assert_eq!(seen, 4 * 5 * (width * height) as usize);
        }
    }

    #[test]
    #[should_panic(expected = "a channel of another image")]
    fn channels_of_another_size_are_refused() {
        let _ = exr_bytes([3, 2], layers([2, 2]));
    }
}
