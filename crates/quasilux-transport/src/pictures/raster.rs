//! The pixels of a picture, and the blocks that they are traced in.

/// Pixels along the edge of a block.
const EDGE: usize = 16;

/// The pixels of a picture, row by row from the top left corner.
#[derive(Clone, Copy, Debug)]
pub(super) struct Raster {
    /// Pixels across and down.
    pub(super) size: [usize; 2],
}

/// A rectangle of pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct PixelBlock {
    /// Column and row of its top left pixel.
    first: [usize; 2],
    /// Pixels across and down.
    size: [usize; 2],
}

impl Raster {
    pub(super) fn width(self) -> usize {
        self.size[0]
    }

    pub(super) fn pixels(self) -> usize {
        self.size[0] * self.size[1]
    }

    /// The blocks of the picture, row by row.
    pub(super) fn blocks(self) -> Vec<PixelBlock> {
        let [width, height] = self.size;
        let size = |first: usize, all: usize| (all - first).min(EDGE);
        let firsts =
            (0..height).step_by(EDGE).flat_map(|y| (0..width).step_by(EDGE).map(move |x| [x, y]));
        let block = |[x, y]: [usize; 2]| PixelBlock {
            first: [x, y],
            size: [size(x, width), size(y, height)],
        };
        firsts.map(block).collect()
    }

    /// Numbers of the pixels of a block.
    pub(super) fn places(self, block: PixelBlock) -> impl Iterator<Item = usize> {
        let PixelBlock { first: [x0, y0], size: [across, down] } = block;
        let width = self.width();
        (y0..y0 + down).flat_map(move |y| (x0..x0 + across).map(move |x| y * width + x))
    }
}

impl PixelBlock {
    pub(super) fn pixels(self) -> usize {
        self.size[0] * self.size[1]
    }

    /// The middle of each quarter, in pixels of the picture.
    pub(super) fn quarters(self) -> [[f64; 2]; 4] {
        let place =
            |axis: usize, part: f64| self.first[axis] as f64 + part * self.size[axis] as f64;
        [[0.25, 0.25], [0.75, 0.25], [0.25, 0.75], [0.75, 0.75]]
            .map(|[x, y]| [place(0, x), place(1, y)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_have_all_pixels_once() {
        let raster = Raster { size: [35, 18] };
        let blocks = raster.blocks();
        let mut places: Vec<usize> = blocks.iter().flat_map(|it| raster.places(*it)).collect();
        places.sort_unstable();
        assert!(places.into_iter().eq(0..35 * 18));
        assert_eq!(blocks.len(), 6);
        assert_eq!(blocks[5].quarters()[3], [32.0 + 0.75 * 3.0, 16.0 + 0.75 * 2.0]);
    }
}
