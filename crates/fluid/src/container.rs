//! What holds the fluid: an open-topped box, round tank or bowl.

use crate::config::range;
use crate::{Aabb, FluidError};
use glam::DVec3;

/// Shape of a container within its corners.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ContainerForm {
    /// A floor and four walls.
    #[default]
    Box,
    /// A floor and a round wall.
    Cylinder,
    /// Part of a hollow ball, as deep as its corners say, and as wide at its rim.
    Bowl,
}

/// An open-topped container: its floor at `min.y`, its walls up to `max.y`, the inside between the corners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Container {
    /// Inner corners, m.
    pub inner: Aabb,
    /// Its shape.
    pub form: ContainerForm,
}

impl Container {
    /// An open box.
    pub fn open_box(inner: Aabb) -> Self {
        Self { inner, form: ContainerForm::Box }
    }

    /// Middle of the floor, m.
    pub fn foot(&self) -> DVec3 {
        DVec3 { y: self.inner.min.y, ..0.5 * (self.inner.min + self.inner.max) }
    }

    /// Radius of a round wall, m; infinite for a box.
    pub fn radius(&self) -> f64 {
        let size = self.inner.max - self.inner.min;
        let rim = 0.5 * size.x;
        match self.form {
            ContainerForm::Box => f64::INFINITY,
            ContainerForm::Cylinder => rim,
            // The ball through the foot and the rim.
            ContainerForm::Bowl => (rim * rim + size.y * size.y) / (2.0 * size.y),
        }
    }

    /// Mean curvature of the round wall as the fluid sees it, 1/m: negative, as it is within.
    pub(crate) fn mean_curvature(&self) -> f64 {
        match self.form {
            ContainerForm::Box => 0.0,
            ContainerForm::Cylinder => -0.5 / self.radius(),
            ContainerForm::Bowl => -1.0 / self.radius(),
        }
    }

    /// Whether a place between the corners is nearer to a round wall than `room` metres, or behind it.
    pub(crate) fn cuts_off(&self, p: DVec3, room: f64) -> bool {
        let arm = match self.form {
            ContainerForm::Box => return false,
            ContainerForm::Cylinder => (p - self.foot()) * DVec3::new(1.0, 0.0, 1.0),
            ContainerForm::Bowl => p - self.foot() - DVec3::Y * self.radius(),
        };
        self.inner.contains(p) && arm.length() > self.radius() - room
    }

    /// A round one is as wide as it is long, and no bowl is deeper than half a ball.
    pub(crate) fn check(&self) -> Result<(), FluidError> {
        let size = self.inner.max - self.inner.min;
        if self.form == ContainerForm::Box {
            return Ok(());
        }
        let equal = 1e-9 * size.x;
        range("container (width along z, as along x)", size.z, size.x - equal, size.x + equal)?;
        match self.form {
            ContainerForm::Bowl => range("container (depth of a bowl)", size.y, 1e-3, 0.5 * size.x + equal),
            ContainerForm::Box | ContainerForm::Cylinder => Ok(()),
        }
    }
}
