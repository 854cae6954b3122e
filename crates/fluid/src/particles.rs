//! The particles, as structure of arrays in f32, sorted by grid cell.

use glam::Vec3;
use rayon::prelude::*;

/// Elements kept readable past the last particle, so that the pair loops may load whole vectors.
pub(crate) const PAD: usize = 16;

/// Where the padding stands: far from everything, finite.
const FAR: f32 = 1e6;

/// Columns that last from one sub-step to the next.
const COLUMNS: usize = 13;

/// Every column has `len() + PAD` entries.
#[derive(Clone, Debug, Default)]
pub(crate) struct Particles {
    pub x: Vec<f32>,
    pub y: Vec<f32>,
    pub z: Vec<f32>,
    pub u: Vec<f32>,
    pub v: Vec<f32>,
    pub w: Vec<f32>,
    /// `wcsph`, `dfsph`: pressure over rest density, m²/s². `muller`: pressure, Pa.
    pub p: Vec<f32>,
    /// `wcsph`: pressure that acts (damped, clamped), over rest density. `dfsph`: the unknown of a solve. `muller`: 1/density, m³/kg.
    pub aux: Vec<f32>,
    /// `wcsph`: packing feedback, m²/s³. `muller`: density that is forgiven after a change of mode, kg/m³.
    pub slow: Vec<f32>,
    /// `wcsph`: share of its neighbourhood that fluid and solids fill, at the last look.
    pub fill: Vec<f32>,
    /// `wcsph`: how far within the fluid it lies, 0..1, at the last look.
    pub inner: Vec<f32>,
    /// Time since birth, s.
    pub age: Vec<f32>,
    /// Time for which the source still leads it, s.
    pub held: Vec<f32>,
    /// `wcsph`: Laplacian of the velocity, 1/(m s). `dfsph`: that, and in a solve what the unknowns make of the velocity
    /// (m/s) or shift (m). Of this sub-step alone.
    pub lx: Vec<f32>,
    pub ly: Vec<f32>,
    pub lz: Vec<f32>,
    pub id: Vec<u32>,
    /// Images across the sides of a periodic world: the copy and whom it is of. They stand among the others from
    /// the sort to the end of the sub-step.
    images: Vec<[u32; 2]>,
    /// Whether each is an image; empty in a world that is not periodic.
    is_image: Vec<bool>,
    len: usize,
    /// Grows whenever the rows are others or stand elsewhere.
    generation: u64,
    next_id: u32,
    spare: [Vec<f32>; COLUMNS],
    spare_id: Vec<u32>,
}

/// A particle about to be born.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Newborn {
    pub position: Vec3,
    pub velocity: Vec3,
    pub pressure: f32,
    pub age: f32,
    pub held: f32,
}

impl Particles {
    pub fn new() -> Self {
        let mut particles = Self::default();
        particles.pad();
        particles
    }

    /// How many there are, images included.
    pub fn len(&self) -> usize {
        self.len
    }

    /// How many there are, images left out.
    pub fn count(&self) -> usize {
        self.len - self.images.len()
    }

    /// Grows whenever the rows are others or stand elsewhere than before.
    pub fn generation(&self) -> u64 {
        self.generation
    }

    /// Whether `i` is the image of another.
    pub fn is_image(&self, i: usize) -> bool {
        self.is_image.get(i).copied().unwrap_or(false)
    }

    pub fn position(&self, i: usize) -> Vec3 {
        Vec3::new(self.x[i], self.y[i], self.z[i])
    }

    pub fn velocity(&self, i: usize) -> Vec3 {
        Vec3::new(self.u[i], self.v[i], self.w[i])
    }

    pub fn set_position(&mut self, i: usize, p: Vec3) {
        (self.x[i], self.y[i], self.z[i]) = (p.x, p.y, p.z);
    }

    pub fn set_velocity(&mut self, i: usize, v: Vec3) {
        (self.u[i], self.v[i], self.w[i]) = (v.x, v.y, v.z);
    }

    fn columns(&mut self) -> [&mut Vec<f32>; COLUMNS] {
        [
            &mut self.x,
            &mut self.y,
            &mut self.z,
            &mut self.u,
            &mut self.v,
            &mut self.w,
            &mut self.p,
            &mut self.aux,
            &mut self.slow,
            &mut self.fill,
            &mut self.inner,
            &mut self.age,
            &mut self.held,
        ]
    }

    /// What motion changes of the particles, in runs of up to `length`.
    pub fn runs(&mut self, length: usize) -> impl IndexedParallelIterator<Item = Run<'_>> {
        let (len, is_image) = (self.len, &self.is_image);
        let place = in_runs([&mut self.x[..len], &mut self.y[..len], &mut self.z[..len]], length);
        let velocity = in_runs([&mut self.u[..len], &mut self.v[..len], &mut self.w[..len]], length);
        let times = self.age[..len].par_chunks_mut(length).zip(self.held[..len].par_chunks_mut(length));
        let runs = place.zip(velocity).zip(times).enumerate();
        runs.map(move |(n, ((place, velocity), (age, held)))| {
            let first = n * length;
            let is_image = is_image.get(first..first + age.len()).unwrap_or(&[]);
            Run { first, place, velocity, age, held, is_image }
        })
    }

    /// Adds particles at the end; the next sort puts them in place.
    pub fn extend(&mut self, newborn: &[Newborn]) {
        let len = self.len;
        for column in self.columns() {
            column.truncate(len);
        }
        self.id.truncate(len);
        for b in newborn {
            let row = [b.position.x, b.position.y, b.position.z, b.velocity.x, b.velocity.y, b.velocity.z];
            let row = row.into_iter().chain([b.pressure, 0.0, 0.0, 1.0, 0.0, b.age, b.held]);
            for (column, value) in self.columns().into_iter().zip(row) {
                column.push(value);
            }
            self.id.push(self.next_id);
            self.next_id = self.next_id.wrapping_add(1);
        }
        self.len += newborn.len();
        self.pad();
    }

    /// Adds all of `others` at the end, as they are; the next sort puts them in place.
    pub fn append(&mut self, others: &Self) {
        let len = self.len;
        let mut others_too = others.clone();
        for (column, other) in self.columns().into_iter().zip(others_too.columns()) {
            column.truncate(len);
            column.extend_from_slice(&other[..others.len]);
        }
        self.id.truncate(len);
        self.id.extend_from_slice(&others.id[..others.len]);
        self.len += others.len;
        self.pad();
    }

    /// Replaces all particles; numbers are never used again.
    pub fn replace(&mut self, newborn: &[Newborn]) {
        self.len = 0;
        self.extend(newborn);
    }

    /// Keeps `order.len()` particles: entry k of every column becomes the old entry `order[k]`.
    pub fn permute(&mut self, order: &[u32]) {
        let mut spare = std::mem::take(&mut self.spare);
        self.columns().into_par_iter().zip(&mut spare).for_each(|(column, spare)| {
            spare.clear();
            spare.extend(order.iter().map(|&i| column[i as usize]));
            std::mem::swap(column, spare);
        });
        self.spare = spare;
        self.spare_id.clear();
        self.spare_id.extend(order.iter().map(|&i| self.id[i as usize]));
        std::mem::swap(&mut self.id, &mut self.spare_id);
        self.len = order.len();
        self.images.clear();
        self.is_image.clear();
        self.pad();
    }

    /// Adds images at the end: whom each is of, and its place. [`link_images`](Self::link_images) comes after the
    /// sort.
    pub fn add_images(&mut self, images: &[(u32, Vec3)]) {
        let len = self.len;
        for column in self.columns() {
            column.truncate(len);
            column.extend(images.iter().map(|&(owner, _)| column[owner as usize]).collect::<Vec<_>>());
        }
        self.id.truncate(len);
        self.id.extend(images.iter().map(|_| u32::MAX));
        self.len += images.len();
        self.pad();
        for (k, &(_, place)) in images.iter().enumerate() {
            self.set_position(len + k, place);
        }
    }

    /// Finds the images among the sorted: they were the last of `images` before the sort by `order`.
    pub fn link_images(&mut self, order: &[u32], images: &[(u32, Vec3)], first: usize) {
        let mut now = vec![0; order.iter().map(|&old| old as usize + 1).max().unwrap_or(0)];
        for (new, &old) in order.iter().enumerate() {
            now[old as usize] = new as u32;
        }
        self.is_image.clear();
        self.is_image.resize(order.len(), false);
        self.images.clear();
        for (k, &(owner, _)) in images.iter().enumerate() {
            let image = now[first + k];
            self.is_image[image as usize] = true;
            self.images.push([image, now[owner as usize]]);
        }
    }

    /// Gives the images what their owners have become.
    pub fn refresh_images(&mut self) {
        let images = std::mem::take(&mut self.images);
        for column in [&mut self.p, &mut self.aux, &mut self.lx, &mut self.ly, &mut self.lz] {
            copy(&images, column);
        }
        self.images = images;
    }

    /// Gives the images their owners' entries of `rows`.
    pub fn copy_to_images<T: Copy>(&self, rows: &mut [T]) {
        copy(&self.images, rows);
    }

    /// Drops the images.
    pub fn drop_images(&mut self) {
        if !self.images.is_empty() {
            let real: Vec<_> = (0..self.len).filter(|&i| !self.is_image(i)).map(|i| i as u32).collect();
            self.permute(&real);
        }
    }

    /// Every change of the rows ends here.
    fn pad(&mut self) {
        self.generation += 1;
        let wanted = self.len + PAD;
        for column in self.columns() {
            column.resize(wanted, 0.0);
        }
        for column in [&mut self.lx, &mut self.ly, &mut self.lz] {
            column.resize(wanted, 0.0);
        }
        self.id.resize(wanted, 0);
        for k in self.len..wanted {
            (self.x[k], self.y[k], self.z[k]) = (FAR, FAR, FAR);
        }
    }
}

/// Particles that lie together, and what motion changes of them.
pub(crate) struct Run<'a> {
    /// The number of the first.
    pub first: usize,
    place: [&'a mut [f32]; 3],
    velocity: [&'a mut [f32]; 3],
    pub age: &'a mut [f32],
    pub held: &'a mut [f32],
    is_image: &'a [bool],
}

impl Run<'_> {
    pub fn len(&self) -> usize {
        self.age.len()
    }

    pub fn is_image(&self, k: usize) -> bool {
        self.is_image.get(k).copied().unwrap_or(false)
    }

    pub fn position(&self, k: usize) -> Vec3 {
        self.place.each_ref().map(|axis| axis[k]).into()
    }

    pub fn velocity(&self, k: usize) -> Vec3 {
        self.velocity.each_ref().map(|axis| axis[k]).into()
    }

    /// Sets position and velocity.
    pub fn set(&mut self, k: usize, (position, velocity): (Vec3, Vec3)) {
        for (axis, value) in self.place.iter_mut().zip(position.to_array()) {
            axis[k] = value;
        }
        for (axis, value) in self.velocity.iter_mut().zip(velocity.to_array()) {
            axis[k] = value;
        }
    }
}

/// Three columns in runs of up to `length`.
fn in_runs(
    [x, y, z]: [&mut [f32]; 3],
    length: usize,
) -> impl IndexedParallelIterator<Item = [&mut [f32]; 3]> {
    let runs = x.par_chunks_mut(length).zip(y.par_chunks_mut(length)).zip(z.par_chunks_mut(length));
    runs.map(|((x, y), z)| [x, y, z])
}

fn copy<T: Copy>(images: &[[u32; 2]], rows: &mut [T]) {
    for &[image, owner] in images {
        rows[image as usize] = rows[owner as usize];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn permute_moves_whole_rows_and_drops_the_rest() {
        let mut p = Particles::new();
        let born =
            |k: f32| Newborn { position: Vec3::splat(k), velocity: -Vec3::splat(k), ..Newborn::default() };
        p.extend(&[born(0.0), born(1.0), born(2.0)]);
        p.permute(&[2, 0]);
        assert_eq!(p.len(), 2);
        assert_eq!((p.position(0), p.velocity(0), p.id[0]), (Vec3::splat(2.0), -Vec3::splat(2.0), 2));
        assert_eq!(p.id[1], 0);
        assert!(p.x[2..].iter().all(|&x| x == FAR));
    }
}
