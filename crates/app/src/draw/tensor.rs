//! Symmetric 3 by 3 matrices.

use glam::{Mat3, Vec3};

/// Eigenvalues of the symmetric matrix `m`, and the matrix whose columns are the unit eigenvectors.
pub(crate) fn eigen(m: Mat3) -> (Vec3, Mat3) {
    let mut a = m.to_cols_array_2d();
    let mut v = Mat3::IDENTITY.to_cols_array_2d();
    for _ in 0..6 {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            rotate(&mut a, &mut v, p, q);
        }
    }
    (Vec3::new(a[0][0], a[1][1], a[2][2]), Mat3::from_cols_array_2d(&v))
}

/// One Jacobi rotation, which makes `a[p][q]` zero.
fn rotate(a: &mut [[f32; 3]; 3], v: &mut [[f32; 3]; 3], p: usize, q: usize) {
    if a[p][q].abs() <= 1e-12 * (a[p][p].abs() + a[q][q].abs()) {
        return;
    }
    let theta = 0.5 * (a[q][q] - a[p][p]) / a[p][q];
    let t = theta.signum() / (theta.abs() + theta.hypot(1.0));
    let c = 1.0 / t.hypot(1.0);
    let s = t * c;
    for row in a.iter_mut() {
        (row[p], row[q]) = (c * row[p] - s * row[q], s * row[p] + c * row[q]);
    }
    for k in 0..3 {
        (a[p][k], a[q][k]) = (c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]);
        (v[p][k], v[q][k]) = (c * v[p][k] - s * v[q][k], s * v[p][k] + c * v[q][k]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eigenvectors_rebuild_the_matrix() {
        let m = Mat3::from_cols_array(&[4.0, 1.0, -2.0, 1.0, 3.0, 0.5, -2.0, 0.5, 1.0]);
        let (values, vectors) = eigen(m);
        let rebuilt = vectors * Mat3::from_diagonal(values) * vectors.transpose();
        assert!(rebuilt.abs_diff_eq(m, 1e-4), "{rebuilt}");
    }
}
