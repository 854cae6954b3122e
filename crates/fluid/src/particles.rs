//! The particles, as structure of arrays in f32, sorted by grid cell.

use glam::Vec3;

/// Elements kept readable past the last particle, so that the pair loops may load whole vectors.
pub(crate) const PAD: usize = 16;

/// Where the padding stands: far from everything, finite.
const FAR: f32 = 1e6;

/// Every column has `len() + PAD` entries.
#[derive(Clone, Debug, Default)]
pub(crate) struct Particles {
    pub x: Vec<f32>,
    pub y: Vec<f32>,
    pub z: Vec<f32>,
    pub u: Vec<f32>,
    pub v: Vec<f32>,
    pub w: Vec<f32>,
    /// `wcsph`: pressure over rest density, m²/s². `muller`: pressure, Pa.
    pub p: Vec<f32>,
    /// `wcsph`: pressure that acts (damped, clamped), over rest density. `muller`: 1/density, m³/kg.
    pub aux: Vec<f32>,
    /// `wcsph`: packing feedback, m²/s³. `muller`: density that is forgiven after a change of mode, kg/m³.
    pub slow: Vec<f32>,
    /// `wcsph`: share of its neighbourhood that fluid and solids fill, at the last look.
    pub fill: Vec<f32>,
    /// Time since birth, s.
    pub age: Vec<f32>,
    /// Time for which the source still leads it, s.
    pub held: Vec<f32>,
    pub id: Vec<u32>,
    len: usize,
    next_id: u32,
    spare: Vec<f32>,
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

    pub fn len(&self) -> usize {
        self.len
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

    fn columns(&mut self) -> [&mut Vec<f32>; 12] {
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
            &mut self.age,
            &mut self.held,
        ]
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
            let row = row.into_iter().chain([b.pressure, 0.0, 0.0, 1.0, b.age, b.held]);
            for (column, value) in self.columns().into_iter().zip(row) {
                column.push(value);
            }
            self.id.push(self.next_id);
            self.next_id = self.next_id.wrapping_add(1);
        }
        self.len += newborn.len();
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
        for column in self.columns() {
            spare.clear();
            spare.extend(order.iter().map(|&i| column[i as usize]));
            std::mem::swap(column, &mut spare);
        }
        self.spare = spare;
        self.spare_id.clear();
        self.spare_id.extend(order.iter().map(|&i| self.id[i as usize]));
        std::mem::swap(&mut self.id, &mut self.spare_id);
        self.len = order.len();
        self.pad();
    }

    fn pad(&mut self) {
        let wanted = self.len + PAD;
        for column in self.columns() {
            column.resize(wanted, 0.0);
        }
        self.id.resize(wanted, 0);
        for k in self.len..wanted {
            (self.x[k], self.y[k], self.z[k]) = (FAR, FAR, FAR);
        }
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
