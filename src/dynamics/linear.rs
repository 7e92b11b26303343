//! Linearisation, poles and transmission zeros (Tables 2 and 3).

use crate::solve::Dual;
use crate::vehicle::{CONTROLS, Control, GAMMA, GUSTS, Gust, STATES, State, V, Vehicle};
use nalgebra::{Complex, DMatrix, linalg::balancing};

/// x' = A x + B u, y = C x; u = [delta_e, phi], y = [V, a flight-path angle]. Only the states in use.
#[derive(Debug, Clone)]
pub struct LinearModel {
    /// df/dx, n x n.
    pub a: DMatrix<f64>,
    /// df/du, n x 2.
    pub b: DMatrix<f64>,
    /// dy/dx, 2 x n.
    pub c: DMatrix<f64>,
}

/// States among the outputs y: V and gamma.
pub const OUTPUT_STATES: [usize; 2] = [V, GAMMA];

/// A direction from a point, as dual numbers.
fn dual<const N: usize>([value, direction]: [&[f64; N]; 2]) -> [Dual<1>; N] {
    std::array::from_fn(|i| Dual { re: value[i], eps: [direction[i]] })
}

const STILL_AIR: Gust<Dual<1>> = [Dual { re: 0.0, eps: [0.0] }; GUSTS];

/// Time derivatives in still air and their directional derivative, from [value, direction]; exact by dual
/// numbers. One direction at a time: several at once would be faster but double the size of the library.
pub fn directional_derivative(
    vehicle: &Vehicle,
    x: [&State; 2],
    u: [&Control; 2],
) -> State<Dual<1>> {
    vehicle.derivatives(&dual(x), &dual(u), STILL_AIR)
}

impl LinearModel {
    /// With the outputs V and gamma; exact derivatives by dual numbers.
    pub fn new(vehicle: &Vehicle, state: &State, control: &Control) -> Self {
        let mut linear = Self::with_imu_gamma(vehicle, state, control);
        linear.c = DMatrix::from_fn(OUTPUT_STATES.len(), linear.a.nrows(), |row, column| {
            f64::from(OUTPUT_STATES[row] == column)
        });
        linear
    }

    /// With the outputs V and gamma at the inertial measurement unit. Neither has a direct feedthrough of
    /// the controls, so D = 0.
    pub fn with_imu_gamma(vehicle: &Vehicle, state: &State, control: &Control) -> Self {
        let n = vehicle.states();
        let changes = |direction: usize| {
            let dx = std::array::from_fn(|i| f64::from(i == direction));
            let du = std::array::from_fn(|i| f64::from(STATES + i == direction));
            let (rates, outputs) = vehicle.derivatives_and_outputs(
                &dual([state, &dx]),
                &dual([control, &du]),
                STILL_AIR,
            );
            (rates.map(|rate| rate.eps[0]), outputs.imu.gamma.eps[0])
        };
        let by_state: Vec<(State, f64)> = (0..n).map(changes).collect();
        let by_control: Vec<(State, f64)> = (STATES..STATES + CONTROLS).map(changes).collect();
        let gamma = |column: usize| by_state[column].1;
        Self {
            a: DMatrix::from_fn(n, n, |row, column| by_state[column].0[row]),
            b: DMatrix::from_fn(n, CONTROLS, |row, column| by_control[column].0[row]),
            c: DMatrix::from_fn(OUTPUT_STATES.len(), n, |row, column| match OUTPUT_STATES[row] {
                V => f64::from(column == V),
                _ => gamma(column),
            }),
        }
    }

    /// Eigenvalues of A, rad/s, by frequency.
    pub fn poles(&self) -> Vec<Complex<f64>> {
        eigenvalues(self.a.clone())
    }

    /// Transmission zeros from u to y, rad/s, by frequency: n - 2, or none if C B is singular.
    pub fn zeros(&self) -> Vec<Complex<f64>> {
        self.zero_dynamics().map_or_else(Vec::new, eigenvalues)
    }

    /// Matrix of the zero dynamics in all states but V and gamma; none if C B is singular or y does not
    /// determine V and gamma. Its eigenvalues are the transmission zeros, its eigenvectors their
    /// directions.
    ///
    /// With relative degree 1, y = 0 requires u = -(C B)^-1 C A x, and V and gamma follow from the other
    /// states z:
    ///
    /// ```text
    /// x = N z, C N = 0     z' = [A N - B (C B)^-1 C A N]_z
    /// ```
    ///
    /// (Isidori, Nonlinear Control Systems, 3rd ed., section 4.3).
    pub fn zero_dynamics(&self) -> Option<DMatrix<f64>> {
        let hidden: Vec<usize> =
            (0..self.a.nrows()).filter(|row| !OUTPUT_STATES.contains(row)).collect();
        let c_z = self.c.select_columns(&hidden);
        let follow = self.c.select_columns(&OUTPUT_STATES).lu().solve(&c_z)?;
        let mut held = DMatrix::zeros(self.a.nrows(), hidden.len());
        for (column, row) in hidden.iter().enumerate() {
            held[(*row, column)] = 1.0;
        }
        for (row, state) in OUTPUT_STATES.into_iter().enumerate() {
            held.row_mut(state).copy_from(&-follow.row(row));
        }
        let moved = &self.a * held;
        let control = (&self.c * &self.b).lu().solve(&(&self.c * &moved))?;
        Some(moved.select_rows(&hidden) - self.b.select_rows(&hidden) * control)
    }
}

fn eigenvalues(mut matrix: DMatrix<f64>) -> Vec<Complex<f64>> {
    balancing::balance_parlett_reinsch(&mut matrix);
    let mut values: Vec<_> = matrix.complex_eigenvalues().iter().copied().collect();
    let size = |value: &Complex<f64>| libm::hypot(value.re, value.im);
    values.sort_by(|a, b| size(a).total_cmp(&size(b)).then(a.im.total_cmp(&b.im)));
    values
}
