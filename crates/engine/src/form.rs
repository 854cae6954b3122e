//! What a tool, an obstacle or a body looks like, as a scene says it: a kind of shape, and lengths of which each kind
//! takes its own.

use crate::mesh_file;
use glam::DVec3;
use hapflow_fluid::{Mesh, Shape};
use std::path::Path;
use std::sync::Arc;

/// Kind of a shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FormKind {
    /// A ball, of `radius`.
    Sphere,
    /// A flat round plate, its axis up, of `radius` and `thickness`.
    Disc,
    /// The same by its other name, of `radius` and `length`.
    Cylinder,
    /// A rod with round ends, its axis up, of `radius`; `length` lies between the middles of its ends.
    Capsule,
    /// A box of the edges `size`.
    Box,
    /// What the closed mesh of a `file` holds, `scale` times as large.
    Mesh,
}

impl FormKind {
    /// All of them.
    pub const ALL: [Self; 6] =
        [Self::Sphere, Self::Disc, Self::Cylinder, Self::Capsule, Self::Box, Self::Mesh];
}

/// See the module.
#[derive(Clone, Debug, PartialEq)]
pub struct Form {
    /// Which of the lengths count.
    pub kind: FormKind,
    /// Radius, m.
    pub radius: f64,
    /// Thickness of a disc, m.
    pub thickness: f64,
    /// Length of a cylinder or a capsule, m.
    pub length: f64,
    /// Edges of a box along the axes, m.
    pub size: DVec3,
    file: String,
    scale: f64,
    /// As it is in the file, and as it is here.
    mesh: Option<[Arc<Mesh>; 2]>,
}

impl Form {
    /// A ball of `radius` metres.
    pub fn ball(radius: f64) -> Self {
        Self {
            kind: FormKind::Sphere,
            radius,
            thickness: 0.01,
            length: 0.04,
            size: DVec3::splat(0.03),
            file: String::new(),
            scale: 1.0,
            mesh: None,
        }
    }

    /// File of the mesh; empty for none.
    pub fn file(&self) -> &str {
        &self.file
    }

    /// Metres a unit of that file.
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// Takes the mesh of `file`, Wavefront OBJ or STL; the text says what is wrong with it. Of an empty name, none.
    ///
    /// # Errors
    /// A file that cannot be read, or whose mesh is none; nothing changes then.
    pub fn set_file(&mut self, file: &str) -> Result<(), String> {
        self.mesh = if file.is_empty() {
            None
        } else {
            let mesh = Arc::new(mesh_file::read(Path::new(file))?);
            Some([Arc::new(mesh.scaled(self.scale)), mesh])
        };
        self.file = file.into();
        Ok(())
    }

    /// Makes the mesh `scale` times as large as in its file.
    pub fn set_scale(&mut self, scale: f64) {
        self.scale = scale;
        if let Some([here, file]) = &mut self.mesh {
            *here = Arc::new(file.scaled(scale));
        }
    }

    /// Whether it has all that its kind needs.
    pub fn is_whole(&self) -> bool {
        self.kind != FormKind::Mesh || self.mesh.is_some()
    }

    /// The shape; of a mesh without a file, the ball.
    pub fn shape(&self) -> Shape {
        let Self { radius, thickness, length, size, .. } = *self;
        match self.kind {
            FormKind::Sphere => Shape::Sphere { radius },
            FormKind::Disc => Shape::Disc { radius, thickness },
            FormKind::Cylinder => Shape::Disc { radius, thickness: length },
            FormKind::Capsule => Shape::Capsule { radius, length },
            FormKind::Box => Shape::Box { size },
            FormKind::Mesh => {
                self.mesh.as_ref().map_or(Shape::Sphere { radius }, |[here, _]| Shape::Mesh(here.clone()))
            }
        }
    }
}
