//! Linearisation, poles and transmission zeros (Tables 2 and 3).

use crate::dynamics::{CONTROLS, Control, STATES, State, Vehicle};
use crate::scalar::{Dual, Scalar};
use nalgebra::{Complex, DMatrix, linalg::balancing};

/// x' = A x + B u, y = C x with y = [V, gamma]; D is zero. Only the states in use.
#[derive(Debug, Clone)]
pub struct Linear {
    /// df/dx, n x n.
    pub a: DMatrix<f64>,
    /// df/du, n x 2; u = [delta_e, phi].
    pub b: DMatrix<f64>,
    /// dy/dx, 2 x n; y = [V, gamma].
    pub c: DMatrix<f64>,
}

/// Rows of the state that are the outputs V and gamma.
pub const OUTPUT_STATES: [usize; 2] = [0, 2];

/// Time derivatives in still air and how they change along a direction, of [value, direction]; exact by
/// dual numbers. One direction at a time: many at once are quicker, but double the library.
pub fn along(vehicle: &Vehicle, [x, dx]: [&State; 2], [u, du]: [&Control; 2]) -> State<Dual<1>> {
    let x = std::array::from_fn(|i| Dual { re: x[i], eps: [dx[i]] });
    let u = std::array::from_fn(|i| Dual { re: u[i], eps: [du[i]] });
    vehicle.derivatives(&x, &u, Dual::constant(0.0))
}

impl Linear {
    /// Exact derivatives by dual numbers.
    pub fn new(vehicle: &Vehicle, state: &State, control: &Control) -> Self {
        let rates = |direction: usize| {
            let dx = std::array::from_fn(|i| f64::from(i == direction));
            let du = std::array::from_fn(|i| f64::from(STATES + i == direction));
            along(vehicle, [state, &dx], [control, &du]).map(|rate| rate.eps[0])
        };
        let n = vehicle.states();
        let columns = |first: usize, count: usize| {
            let columns: Vec<State> = (first..first + count).map(rates).collect();
            DMatrix::from_fn(n, count, |row, column| columns[column][row])
        };
        Self {
            a: columns(0, n),
            b: columns(STATES, CONTROLS),
            c: DMatrix::from_fn(OUTPUT_STATES.len(), n, |row, column| {
                f64::from(OUTPUT_STATES[row] == column)
            }),
        }
    }

    /// Eigenvalues of A, rad/s, by frequency.
    pub fn poles(&self) -> Vec<Complex<f64>> {
        eigenvalues(self.a.clone())
    }

    /// Transmission zeros from [delta_e, phi] to [V, gamma], rad/s, by frequency: n - 2 of them,
    /// or none if the controls do not reach both rates.
    pub fn zeros(&self) -> Vec<Complex<f64>> {
        self.zero_dynamics().map_or_else(Vec::new, eigenvalues)
    }

    /// Motion of the other states while V and gamma are held; none if the controls do not reach
    /// both rates. Its eigenvalues are the zeros, its eigenvectors their directions.
    ///
    /// Both outputs are states y and their rates answer the controls at once (B_y is invertible),
    /// so holding y at zero fixes u = -B_y^-1 A_yz z, which leaves A_zz - B_z B_y^-1 A_yz
    /// (Isidori, Nonlinear Control Systems, 3rd ed., 4.3).
    pub fn zero_dynamics(&self) -> Option<DMatrix<f64>> {
        let hidden: Vec<usize> =
            (0..self.a.nrows()).filter(|row| !OUTPUT_STATES.contains(row)).collect();
        let b_y = self.b.select_rows(&OUTPUT_STATES);
        let a_yz = self.a.select_rows(&OUTPUT_STATES).select_columns(&hidden);
        let held = b_y.lu().solve(&a_yz)?;
        let a_zz = self.a.select_rows(&hidden).select_columns(&hidden);
        Some(a_zz - self.b.select_rows(&hidden) * held)
    }
}

fn eigenvalues(mut matrix: DMatrix<f64>) -> Vec<Complex<f64>> {
    balancing::balance_parlett_reinsch(&mut matrix);
    let mut values: Vec<_> = matrix.complex_eigenvalues().iter().copied().collect();
    values.sort_by(|a, b| a.norm().total_cmp(&b.norm()).then(a.im.total_cmp(&b.im)));
    values
}
