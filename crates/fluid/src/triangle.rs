//! The place of a triangle that is nearest to a point.

use glam::DVec3;

/// Part of a triangle, with the number of its corner, or of the corner at which its edge begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Part {
    Corner(usize),
    Edge(usize),
    Face,
}

/// The nearest place of the triangle `t` to `p`, and the part that it lies on (Ericson 2005, "Real-Time Collision
/// Detection", section 5.1.5).
pub(crate) fn nearest(t: &[DVec3; 3], p: DVec3) -> (DVec3, Part) {
    let [a, b, c] = *t;
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return (a, Part::Corner(0));
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    if d3 >= 0.0 && d4 <= d3 {
        return (b, Part::Corner(1));
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return (a + ab * (d1 / (d1 - d3)), Part::Edge(0));
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d6 >= 0.0 && d5 <= d6 {
        return (c, Part::Corner(2));
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return (a + ac * (d2 / (d2 - d6)), Part::Edge(2));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        let w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return (b + (c - b) * w, Part::Edge(1));
    }
    let scale = 1.0 / (va + vb + vc);
    (a + ab * (vb * scale) + ac * (vc * scale), Part::Face)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_part_is_found() {
        let t = [DVec3::ZERO, DVec3::X, DVec3::Y];
        for (p, place, part) in [
            ([-1.0, -1.0, 1.0], [0.0, 0.0, 0.0], Part::Corner(0)),
            ([3.0, -1.0, 0.0], [1.0, 0.0, 0.0], Part::Corner(1)),
            ([-1.0, 3.0, 0.0], [0.0, 1.0, 0.0], Part::Corner(2)),
            ([0.4, -1.0, 0.5], [0.4, 0.0, 0.0], Part::Edge(0)),
            ([1.0, 1.0, 0.5], [0.5, 0.5, 0.0], Part::Edge(1)),
            ([-2.0, 0.3, 0.5], [0.0, 0.3, 0.0], Part::Edge(2)),
            ([0.2, 0.3, 0.5], [0.2, 0.3, 0.0], Part::Face),
        ] {
            let (found, of) = nearest(&t, DVec3::from(p));
            assert!((found - DVec3::from(place)).length() < 1e-12 && of == part, "{p:?}: {found} {of:?}");
        }
    }
}
