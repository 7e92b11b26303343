//! The rigid motion of a beam, and moments of mass that its density does not have.
//!
//! Pitch, bending and slosh share one kinetic energy, so the pitch inertia of the equations of flight
//! and the mass centre must be those of the mass matrix that the modes are orthogonal in. A beam's
//! density gives it a mass m_b, a mass centre x_b and an inertia I_b of its own. With the fields
//! 1 (heave) and b = x - x_b (rotation), `h = M_b 1 / m_b` and `r = M_b b / I_b` measure the mean
//! translation and the mean rotation of any displacement, and
//!
//! `M = M_b + delta (h r^T + r h^T) + j r r^T`
//!
//! has the same mass, the first moment delta about x_b and the inertia I_b + j. It differs from M_b in
//! the rigid motion of the beam alone: whatever is orthogonal to heave and rotation in M_b is so in M,
//! so a beam without sloshing masses keeps its modes. A product with M takes O(n).

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
    /// Mean translation at x_b (unit of w) and mean slope (that over m) of nodal deflections and slopes.
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

/// Moments of mass beyond those of the density.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MassCorrection {
    /// delta, kg: of the mass per metre of width.
    pub first: f64,
    /// j, kg m^2/m.
    pub second: f64,
    /// Where they act; empty if there are none.
    pub motion: RigidMotion,
}

impl MassCorrection {
    /// Adds `(delta (h r^T + r h^T) + j r r^T) displacement` to a product.
    pub fn add_product(&self, displacement: &[f64], product: &mut [f64]) {
        let RigidMotion { translation, rotation, .. } = &self.motion;
        let mean =
            |measure: &[f64]| -> f64 { measure.iter().zip(displacement).map(|(m, u)| m * u).sum() };
        let (moved, turned) = (mean(translation), mean(rotation));
        let along_h = self.first * turned;
        let along_r = self.first * moved + self.second * turned;
        for ((entry, h), r) in product.iter_mut().zip(translation).zip(rotation) {
            *entry += along_h * h + along_r * r;
        }
    }
}
