//! An image of floating-point colours and luminances.

/// Pixels in rows from the top left corner; colours and luminances share one unit, and colours are
/// linear with the primaries of ITU-R BT.709.
#[derive(Clone, Copy, Debug)]
pub struct Image<'a> {
    /// Width and height in pixels.
    pub resolution: [u32; 2],
    /// Red, green and blue of each pixel.
    pub rgb: &'a [[f32; 3]],
    /// Luminance of each pixel.
    pub luminance: &'a [f32],
}
