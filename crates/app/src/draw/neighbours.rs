//! Who is near whom.

use std::collections::HashMap;

use glam::{IVec3, Vec3};

/// Points sorted into cubes.
pub(crate) struct Neighbours<'a> {
    points: &'a [Vec3],
    side: f32,
    order: Vec<u32>,
    cubes: HashMap<IVec3, (u32, u32)>,
}

impl<'a> Neighbours<'a> {
    /// Sorts `points` into cubes of `side`, m.
    pub fn new(points: &'a [Vec3], side: f32) -> Self {
        let mut keyed: Vec<(IVec3, u32)> =
            points.iter().enumerate().map(|(i, p)| (cube(*p, side), i as u32)).collect();
        keyed.sort_unstable_by_key(|(cube, i)| (cube.z, cube.y, cube.x, *i));
        let mut cubes = HashMap::new();
        for (place, (cube, _)) in keyed.iter().enumerate() {
            let range = cubes.entry(*cube).or_insert((place as u32, place as u32));
            range.1 = place as u32 + 1;
        }
        Self { points, side, order: keyed.into_iter().map(|(_, i)| i).collect(), cubes }
    }

    /// Calls `visit` with every point nearer than the side to `centre`, and the distance.
    pub fn each(&self, centre: Vec3, mut visit: impl FnMut(usize, f32)) {
        let middle = cube(centre, self.side);
        for step in 0..27 {
            let offset = IVec3::new(step % 3, step / 3 % 3, step / 9) - 1;
            let Some(&(first, last)) = self.cubes.get(&(middle + offset)) else { continue };
            for &i in &self.order[first as usize..last as usize] {
                let distance = self.points[i as usize].distance(centre);
                if distance < self.side {
                    visit(i as usize, distance);
                }
            }
        }
    }
}

/// The cube that holds `p`.
fn cube(p: Vec3, side: f32) -> IVec3 {
    (p / side).floor().clamp(Vec3::splat(-1e9), Vec3::splat(1e9)).as_ivec3()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_those_near_and_no_others() {
        let points: Vec<Vec3> = (-5..5).map(|i| Vec3::new(0.3 * i as f32, 0.0, 0.0)).collect();
        let mut found = Vec::new();
        Neighbours::new(&points, 0.5).each(Vec3::ZERO, |i, _| found.push(i));
        found.sort_unstable();
        assert_eq!(found, [4, 5, 6]);
    }
}
