//! Where a picture is taken from: a pinhole camera, and which way each place in its picture looks.
//!
//! Places are in pixels from the top left corner, x to the right and y down; the centre of the
//! first pixel is at (0.5, 0.5). With `f` the unit vector from position to target, the frame is
//! right-handed: `right` is f x up, `down` is f x right. The picture plane stands at distance 1, as
//! high as 2 tan(fov / 2); pixels are square.

use glam::DVec3;

/// A pinhole camera: it measures luminance, and never blocks light.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// Unique name among sensors and cameras, also the name of its result files.
    pub name: String,
    /// The pinhole, in m.
    pub position: DVec3,
    /// The point in the middle of the picture, in m; not `position`.
    pub target: DVec3,
    /// A direction that points upward in the picture; not parallel to the line of sight.
    pub up: DVec3,
    /// Angle between the upper and the lower edge of the picture, in (0, pi).
    pub vertical_fov_rad: f64,
    /// Width and height in pixels, at least 1 each.
    pub resolution: [u32; 2],
    /// Paths of each pixel in each replicate, at most where there is a tolerance too; `None` leaves
    /// them to the run.
    pub samples: Option<u64>,
    /// Wanted half-width of the interval of a pixel, mean over the pixels, over the mean luminance
    /// of the picture; `None` leaves it to the run.
    pub rel_tol: Option<f64>,
}

/// The line of sight of each place in a camera's picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// The pinhole, in m.
    pub position: DVec3,
    /// From the pinhole to the top left corner of the picture plane.
    corner: DVec3,
    /// From one pixel to the next on the picture plane, to the right and down.
    across: DVec3,
    along: DVec3,
}

impl Camera {
    /// Ending of the name of its false-colour picture, after its own name.
    pub const FALSE_COLOUR_ENDING: &'static str = "-falsecolour";

    /// The number of pixels.
    #[must_use]
    pub fn pixels(&self) -> usize {
        self.resolution[0] as usize * self.resolution[1] as usize
    }

    /// The lines of sight.
    #[must_use]
    pub fn view(&self) -> View {
        let forward = (self.target - self.position).normalize();
        let right = forward.cross(self.up).normalize();
        let down = forward.cross(right);
        let [width, height] = self.resolution.map(f64::from);
        let pixel = 2.0 * libm::tan(0.5 * self.vertical_fov_rad) / height;
        let (across, along) = (right * pixel, down * pixel);
        let corner = forward - across * (0.5 * width) - along * (0.5 * height);
        View { position: self.position, corner, across, along }
    }
}

impl View {
    /// The unit direction in which the camera looks at a place of its picture.
    #[must_use]
    pub fn direction(&self, [x, y]: [f64; 2]) -> DVec3 {
        (self.corner + self.across * x + self.along * y).normalize()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_3};

    fn camera(resolution: [u32; 2], vertical_fov_rad: f64) -> Camera {
        Camera {
            name: "eye".to_owned(),
            position: DVec3::new(1.0, -2.0, 0.5),
            target: DVec3::new(1.0, 6.0, 0.5),
            up: DVec3::new(0.0, 0.3, 2.0),
            vertical_fov_rad,
            resolution,
            samples: None,
            rel_tol: None,
        }
    }

    /// Looking along y with z upward, x lies to the right.
    #[test]
    fn the_frame_is_the_one_that_people_expect() {
        let view = camera([300, 100], FRAC_PI_2).view();
        let close = |place, wanted: DVec3| {
            let found = view.direction(place);
            assert!((found - wanted.normalize()).length() < 1e-14, "{place:?}: {found}");
        };
        close([150.0, 50.0], DVec3::Y);
        // At 90 degrees the edges of a picture of height 2 are at distance 1 from its middle.
        close([150.0, 0.0], DVec3::new(0.0, 1.0, 1.0));
        close([150.0, 100.0], DVec3::new(0.0, 1.0, -1.0));
        close([0.0, 50.0], DVec3::new(-3.0, 1.0, 0.0));
        close([300.0, 0.0], DVec3::new(3.0, 1.0, 1.0));
    }

    #[test]
    fn the_angle_is_that_between_upper_and_lower_edge() {
        for fov_rad in [1e-3, 0.4, FRAC_PI_3, 3.1] {
            let view = camera([7, 5], fov_rad).view();
            let [top, bottom] = [0.0, 5.0].map(|y| view.direction([3.5, y]));
            let angle = libm::atan2(top.cross(bottom).length(), top.dot(bottom));
            assert!((angle - fov_rad).abs() < 1e-12, "{angle} for {fov_rad}");
        }
    }
}
