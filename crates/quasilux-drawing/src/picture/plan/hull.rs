//! The convex outline of points (Andrew 1979, "Another efficient algorithm for convex hulls in two
//! dimensions").

use glam::DVec2;

/// The corners of the smallest convex outline around finite points, in turn, none twice.
pub(crate) fn hull(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.retain(|p| p.is_finite());
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    points.dedup();
    if points.len() < 3 {
        return points;
    }
    let half = |points: &mut dyn Iterator<Item = DVec2>| {
        let mut chain: Vec<DVec2> = Vec::new();
        for point in points {
            while let [.., a, b] = chain[..]
                && (b - a).perp_dot(point - b) <= 0.0
            {
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        chain
    };
    let mut outline = half(&mut points.iter().copied());
    outline.extend(half(&mut points.iter().rev().copied()));
    outline
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inner_points_and_points_on_sides_are_left_out() {
        let points = [[0.0, 0.0], [4.0, 0.0], [2.0, 0.0], [4.0, 3.0], [0.0, 3.0], [1.0, 1.0]];
        let found = hull(points.map(DVec2::from).to_vec());
        assert_eq!(found, [[0.0, 0.0], [4.0, 0.0], [4.0, 3.0], [0.0, 3.0]].map(DVec2::from));
        assert_eq!(hull(vec![DVec2::ONE; 3]), [DVec2::ONE]);
        assert!(hull(vec![DVec2::NAN]).is_empty());
    }
}
