//! Images of particles behind walls.
//!
//! A wall would otherwise look like a free surface to the particles beside it, and the fluid would pull back.

use glam::Vec3;

use super::scene::Box3;

/// A particle, or the image of one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mote {
    pub place: Vec3,
    /// m/s.
    pub speed: f32,
    /// For an image: the box whose wall it stands behind, by number.
    pub behind: Option<usize>,
}

/// Adds the images of `motes` behind the walls and floors of `boxes`, for those nearer than `reach` to one.
pub(crate) fn add_images(motes: &mut Vec<Mote>, boxes: &[Box3], reach: f32) {
    let mut owned = vec![false; motes.len()];
    for (number, b) in boxes.iter().enumerate() {
        let (low, high) = (Vec3::from(b.min), Vec3::from(b.max));
        let slack = Vec3::splat(0.2 * reach);
        let mut mine = Vec::new();
        for (mote, owned) in motes.iter().zip(&mut owned) {
            let p = mote.place;
            if !*owned && p.cmpge(low - slack).all() && p.cmple(high + slack).all() {
                *owned = true;
                mine.push(*mote);
            }
        }
        let known = mine.len();
        for (axis, level) in [(0, low.x), (0, high.x), (2, low.z), (2, high.z), (1, low.y)] {
            add_image(&mut mine, axis, level, reach);
        }
        let images = mine.drain(known..).map(|mote| Mote { behind: Some(number), ..mote });
        motes.extend(images);
    }
}

/// Adds images in the plane across `axis` at `level`.
fn add_image(motes: &mut Vec<Mote>, axis: usize, level: f32, reach: f32) {
    for i in 0..motes.len() {
        let mut image = motes[i];
        let off = image.place[axis] - level;
        if off.abs() < reach {
            image.place[axis] = level - off;
            motes.push(image);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_corner_has_every_image() {
        let room = Box3 { min: [0.0; 3], max: [1.0; 3] };
        let mut motes = vec![Mote { place: Vec3::splat(0.1), speed: 1.0, behind: None }];
        add_images(&mut motes, &[room], 0.2);
        assert_eq!(motes.len(), 8);
        assert_eq!(motes.iter().filter(|mote| mote.behind == Some(0)).count(), 7);
    }
}
