//! A rank-two correction of the beam's mass matrix that sets mass centre and pitch inertia.
//!
//! Pitch, bending and slosh share one kinetic energy, so the mass matrix M of the modes must have the
//! mass centre and the pitch inertia of the equations of motion. The beam's density gives M_b, with mass
//! m_b, mass centre x_b and inertia I_b about it. With the fields 1 (heave) and b = x - x_b (rotation),
//!
//! ```text
//! h = M_b 1 / m_b,   r = M_b b / I_b                 h^T 1 = r^T b = 1,   h^T b = r^T 1 = 0
//! M = M_b + delta (h r^T + r h^T) + j r r^T
//! ```
//!
//! h^T u and r^T u are the mean translation and rotation of a displacement u. Written as u = a 1 + c b +
//! v with v M_b-orthogonal to both,
//!
//! ```text
//! u^T M u = m_b a^2 + 2 delta a c + (I_b + j) c^2 + v^T M_b v
//! ```
//!
//! so M has the mass m_b, the first moment delta about x_b and the inertia I_b + j, and differs from M_b
//! in rigid-body motion only: a beam without sloshing masses keeps its modes. M is positive definite if
//! and only if m_b (I_b + j) > delta^2. Only products with M are needed, at O(n); it is never inverted.

/// Mean translation and rotation of the displacements of a beam.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RigidMotion {
    /// Mass, kg/m.
    pub mass: f64,
    /// Mass centre x_b of the density, m from the nose.
    pub centre_m: f64,
    /// Inertia I_b of the density about it, kg m^2/m.
    pub inertia: f64,
    /// h, one entry for each entry of a displacement.
    pub translation: Vec<f64>,
    /// r, 1/m.
    pub rotation: Vec<f64>,
}

impl RigidMotion {
    /// Mean translation h^T u and mean slope r^T u of nodal deflections and slopes.
    pub fn part(&self, w: &[f64], slope: &[f64]) -> [f64; 2] {
        [&self.translation, &self.rotation].map(|measure| {
            let (pairs, _) = measure.as_chunks::<2>();
            pairs
                .iter()
                .zip(w.iter().zip(slope))
                .map(|([by_w, by_slope], (w, s))| by_w * w + by_slope * s)
                .sum()
        })
    }
}

/// The correction of the mass matrix.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MassCorrection {
    /// delta, kg: first moment of the mass per metre of width.
    pub first: f64,
    /// j, kg m^2/m.
    pub second: f64,
    /// h and r; empty if there is no correction.
    pub motion: RigidMotion,
}

impl MassCorrection {
    /// Adds `(delta (h r^T + r h^T) + j r r^T) displacement` to a product.
    pub fn add_product(&self, displacement: &[f64], product: &mut [f64]) {
        let RigidMotion { translation, rotation, .. } = &self.motion;
        let (mut translated, mut rotated) = (0.0, 0.0);
        // Both sums in one loop: neither waits for the other.
        for ((h, r), u) in translation.iter().zip(rotation).zip(displacement) {
            translated += h * u;
            rotated += r * u;
        }
        let along_h = self.first * rotated;
        let along_r = self.first * translated + self.second * rotated;
        for ((entry, h), r) in product.iter_mut().zip(translation).zip(rotation) {
            *entry += along_h * h + along_r * r;
        }
    }
}
