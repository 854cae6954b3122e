//! The force of a fluid that a tool stands in: its lift, and its drag against the flow round it.

use crate::Neighbourhood;
use crate::law::LawNode;
use glam::{DVec3, Mat3, Vec3};
use std::f64::consts::PI;

/// The shell round the tool whose fluid counts as what it stands in, in its radii: the inner part is what it drags along.
const SHELL: [f64; 2] = [1.2, 2.6];
/// Share of the shell that fluid fills, between which a tool goes over from being struck to standing in it.
const STANDS: [f64; 2] = [0.35, 0.65];
/// Fill above which a column's node is in the pool.
const IN_POOL: f32 = 0.5;
/// Highest Reynolds number of the drag law; above it the drag is taken to go on as there.
const MOST_REYNOLDS: f64 = 1000.0;

/// What a tool stands in.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Immersion {
    /// Share of the shell round the tool that fluid fills.
    pub fill: f64,
    /// Mean velocity there, m/s.
    pub flow: DVec3,
    /// Height of the free surface beside the tool, m; infinite where it is above all that was looked at, and minus infinite
    /// where there is no pool.
    pub surface: f64,
    density: f64,
    viscosity: f64,
    /// Acceleration of gravity, m/s².
    gravity: f64,
}

impl Immersion {
    /// Of a tool of `radius` (m) at `place`.
    pub fn look(around: &Neighbourhood<'_>, place: DVec3, radius: f64) -> Self {
        let (mut fill, mut flow, mut count) = (0.0, DVec3::ZERO, 0.0);
        for (k, node) in around.nodes.iter().enumerate() {
            let away = around.place(k).distance(place) / radius;
            if away > SHELL[0] && away < SHELL[1] {
                fill += f64::from(node[0]);
                flow += Vec3::new(node[1], node[2], node[3]).as_dvec3();
                count += 1.0;
            }
        }
        Self {
            fill: (fill / f64::max(count, 1.0)).min(1.0),
            flow: if fill > 1e-6 { flow / fill } else { DVec3::ZERO },
            surface: surface(around, place, radius),
            density: around.density,
            viscosity: around.viscosity,
            gravity: around.gravity.length(),
        }
    }

    /// How far the tool stands in the fluid and is not struck by it, 0..1.
    pub fn share(&self) -> f64 {
        let s = ((self.fill - STANDS[0]) / (STANDS[1] - STANDS[0])).clamp(0.0, 1.0);
        s * s * (3.0 - 2.0 * s)
    }

    /// Share of a ball of `radius` at height `y` that is below the surface.
    pub fn below(&self, radius: f64, y: f64) -> f64 {
        let depth = ((self.surface - y) / radius + 1.0).clamp(0.0, 2.0);
        0.25 * depth * depth * (3.0 - depth)
    }

    /// Lift of a tool of `volume` (m³) and `radius` at `place`, N, upwards.
    pub fn lift(&self, volume: f64, radius: f64, place: DVec3) -> DVec3 {
        DVec3::Y * (self.density * self.gravity * volume * self.below(radius, place.y))
    }

    /// Mass of fluid that goes along with a tool when that is accelerated: half of what it displaces, kg.
    pub fn added_mass(&self, volume: f64, radius: f64, place: DVec3) -> f64 {
        0.5 * self.density * volume * self.below(radius, place.y)
    }

    /// Drag of a ball against the flow, by Schiller & Naumann (1933): 6πμR (1 + 0.15 Re^0.687) w, for the part of it that is
    /// below the surface.
    pub fn drag(&self, radius: f64, place: DVec3, velocity: DVec3) -> LawNode {
        let w = self.flow - velocity;
        let speed = w.length();
        let reynolds = (2.0 * self.density * speed * radius / self.viscosity.max(1e-9)).min(MOST_REYNOLDS);
        let rise = 0.15 * reynolds.powf(0.687);
        let stokes = 6.0 * PI * self.viscosity * radius * self.below(radius, place.y);
        let factor = (stokes * (1.0 + rise)) as f32;
        // The slope along the flow is steeper by that of the second term.
        let (along, more) = (w.normalize_or_zero().as_vec3(), (stokes * 0.687 * rise) as f32);
        let steep = Mat3::from_cols(along * along.x, along * along.y, along * along.z) * more;
        LawNode {
            force: w.as_vec3() * factor,
            by_velocity: -(Mat3::from_diagonal(Vec3::splat(factor)) + steep),
        }
    }
}

/// Mean height to which the fluid stands in the columns beside the tool.
fn surface(around: &Neighbourhood<'_>, place: DVec3, radius: f64) -> f64 {
    let (n, s) = (around.side, around.spacing);
    let (mut height, mut full, mut columns) = (0.0, 0.0, 0.0);
    for (x, z) in (0..n * n).map(|k| (k % n, k / n)) {
        let at = around.origin + DVec3::new(x as f64 * s, 0.0, z as f64 * s);
        let away = DVec3::new(at.x - place.x, 0.0, at.z - place.z).length() / radius;
        if away > SHELL[0] && away < SHELL[1] {
            columns += 1.0;
            if let Some(top) = column_top((0..n).map(|y| around.nodes[(z * n + y) * n + x][0])) {
                full += 1.0;
                height += top;
            }
        }
    }
    if full < 0.5 * columns {
        f64::NEG_INFINITY
    } else if height / full > n as f64 - 1.5 {
        f64::INFINITY
    } else {
        around.origin.y + s * (height / full - 0.5)
    }
}

/// Height to which a column of nodes is filled, in nodes; none if it is empty. Below a floor there is nothing.
fn column_top(fills: impl Iterator<Item = f32>) -> Option<f64> {
    let mut filled = fills.enumerate().skip_while(|(_, fill)| *fill < IN_POOL);
    let (floor, _) = filled.next()?;
    let above = filled.map(|(_, fill)| f64::from(fill.min(1.0))).take_while(|fill| *fill > 0.0);
    Some(floor as f64 + 1.0 + above.sum::<f64>())
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIDE: usize = 16;
    const RADIUS: f64 = 0.012;

    /// A pool up to `surface` (m), flowing along x at 0.3 m/s, with a hole where the ball is, looked at from a ball in the
    /// origin.
    fn pool(surface: f64) -> Immersion {
        let spacing = 6.0 * RADIUS / 15.0;
        let origin = DVec3::splat(-3.0 * RADIUS);
        let at =
            |k: usize| origin + spacing * DVec3::new((k % 16) as f64, (k / 16 % 16) as f64, (k / 256) as f64);
        let fill = |p: DVec3| {
            let below = ((surface - p.y) / spacing + 0.5).clamp(0.0, 1.0) as f32;
            if p.length() < RADIUS { 0.0 } else { below }
        };
        let nodes: Vec<_> = (0..SIDE.pow(3)).map(at).map(fill).map(|f| [f, 0.3 * f, 0.0, 0.0]).collect();
        let gravity = DVec3::NEG_Y * 9.81;
        let around = Neighbourhood {
            density: 1000.0,
            viscosity: 0.1,
            gravity,
            origin,
            spacing,
            side: SIDE,
            nodes: &nodes,
        };
        Immersion::look(&around, DVec3::ZERO, RADIUS)
    }

    #[test]
    fn surface_flow_and_fill_are_found() {
        for height in [-0.02, 0.0, 0.013] {
            let found = pool(height);
            assert!((found.surface - height).abs() < 1e-4, "{height}: {found:?}");
            assert!((found.flow - DVec3::X * 0.3).length() < 1e-6);
        }
        assert_eq!(pool(1.0).surface, f64::INFINITY);
        assert_eq!(pool(-1.0).surface, f64::NEG_INFINITY);
        assert_eq!((pool(1.0).share(), pool(-1.0).share()), (1.0, 0.0));
    }

    #[test]
    fn lift_is_archimedes_and_drag_is_stokes_where_it_is_slow() {
        let volume = 4.0 / 3.0 * PI * RADIUS.powi(3);
        let lift = |surface| pool(surface).lift(volume, RADIUS, DVec3::ZERO).y / (9810.0 * volume);
        assert!((lift(1.0) - 1.0).abs() < 1e-9 && lift(-1.0) == 0.0 && (lift(0.0) - 0.5).abs() < 0.02);
        let node = pool(1.0).drag(RADIUS, DVec3::ZERO, DVec3::X * 0.299);
        // At Re 0.24 it is 5.6 % above Stokes's.
        let expected = 6.0 * PI * 0.1 * RADIUS * 1e-3 * 1.056;
        assert!((f64::from(node.force.x) / expected - 1.0).abs() < 0.01);
        let (slow, fast) = [0.1, 0.11].map(|v| pool(1.0).drag(RADIUS, DVec3::ZERO, DVec3::X * v)).into();
        let slope = (fast.force.x - slow.force.x) / 0.01;
        assert!((slow.by_velocity.x_axis.x / slope - 1.0).abs() < 0.03, "{slope} {slow:?}");
    }
}
