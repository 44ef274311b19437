//! The Jacobian of the positions relative to the last vehicle, and its eigenvalues from a numerical solver.
//!
//! With y_j = x_j − x_N the homogeneous ring is dy/dt = J·y(t − Δ), J = −c(I + A + B): A has −1 above the diagonal, B
//! has 1 in the first column. **Proposition.** J has N − 1 distinct eigenvalues, so it is
//! diagonalizable: its characteristic polynomial is that of −c times M = I + A + B, and
//! det(M − μI) = Σ_{k<N} (1 − μ)^k = (1 − (1 − μ)^N)/μ, whose roots are 1 − e^{2πiq/N}, q = 1 … N − 1.
//!
//! Heterogeneous drivers have such a matrix, too, with the slope c_j in row j. Its eigenvalues have no closed form, but they
//! are the roots of Π_j (1 + s/c_j) = 1, the characteristic equation without delay; so they do not depend on the order of the
//! drivers.
//!
//! ```
//! use ringroad::scenario::Scenario;
//! use ringroad::stability::jacobian::{numerical_eigenvalues, smallest_distance};
//! use ringroad::stability::lane::lanes_of;
//!
//! let lane = lanes_of(&Scenario::default()).remove(0);
//! let eigenvalues = numerical_eigenvalues(&lane.drivers, 1000.0).unwrap();
//! assert_eq!(eigenvalues.len(), 49);
//! assert!(eigenvalues.iter().all(|e| e.distance_per_s < 1e-9));
//! assert!(smallest_distance(&eigenvalues) > 0.01); // distinct: J is diagonalizable
//! ```

use super::driver_classes::DriverClasses;
use super::homogeneous::Time;
use crate::error::Error;
use crate::format::table::{Column, Table};
use crate::numerics::complex::{Complex64, norm};
use crate::scenario::driver::{Driver, equilibrium};
use nalgebra::DMatrix;
use serde::Serialize;

/// The largest number of vehicles in a lane for [`numerical_eigenvalues`]: the solver is dense, with N³ operations.
pub const MOST_VEHICLES: usize = 200;

/// A numerical eigenvalue of the Jacobian, and what theory says of it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct JacobianEigenvalue {
    /// q, from 1 to N − 1; modes q and N − q are conjugate.
    pub mode: usize,
    /// Real part from the numerical solver, 1/s.
    pub real_per_s: f64,
    /// Imaginary part from the numerical solver, 1/s.
    pub imaginary_per_s: f64,
    /// Real part by theory, 1/s: of the closed form d_q = −c(1 − e^{2πiq/N}) of homogeneous drivers; of heterogeneous drivers,
    /// of the root without delay that is followed from mode q of homogeneous drivers. NaN where it could not be followed.
    pub theory_real_per_s: f64,
    /// Imaginary part by theory, 1/s.
    pub theory_imaginary_per_s: f64,
    /// Distance of the two, 1/s.
    pub distance_per_s: f64,
}

impl JacobianEigenvalue {
    fn new(mode: usize, numerical: Complex64, theory: Complex64) -> Self {
        Self {
            mode,
            real_per_s: numerical.re,
            imaginary_per_s: numerical.im,
            theory_real_per_s: theory.re,
            theory_imaginary_per_s: theory.im,
            distance_per_s: norm(numerical - theory),
        }
    }
}

/// The N − 1 numerical eigenvalues of the Jacobian of a lane of `length` metres in equilibrium, drivers in the order given,
/// by mode. Each is the one nearest to theory's value of its mode among those that no earlier mode has taken.
///
/// Refuses a lane of more than [`MOST_VEHICLES`] vehicles, and one for which the solver does not converge.
pub fn numerical_eigenvalues(drivers: &[Driver], length: f64) -> Result<Vec<JacobianEigenvalue>, Error> {
    let vehicles = drivers.len();
    if vehicles > MOST_VEHICLES {
        let allowed =
            format!("at most {MOST_VEHICLES} vehicles in the lane for the eigenvalues of its Jacobian");
        return Err(Error::too_large("vehicles", vehicles, allowed));
    }
    let equilibrium = equilibrium(drivers, length).unwrap_or_default();
    let slopes: Vec<_> = drivers.iter().map(|driver| equilibrium.slope(&driver.law())).collect();
    let mut numerical = eigenvalues(jacobian(&slopes)).ok_or_else(|| {
        Error::conflict("vehicles", vehicles, "a lane for which the eigenvalue solver converges")
    })?;
    let theory = theory(&DriverClasses::new(slopes.into_iter().map(|slope| (slope, 0.0))));
    let of_mode = |(k, theory): (usize, Complex64)| {
        let distance = |z: &Complex64| norm(z - theory);
        let nearest = (0..numerical.len())
            .min_by(|&a, &b| distance(&numerical[a]).total_cmp(&distance(&numerical[b])))
            .expect("as many numerical eigenvalues as modes");
        JacobianEigenvalue::new(k + 1, numerical.swap_remove(nearest), theory)
    };
    Ok(theory.into_iter().enumerate().map(of_mode).collect())
}

/// The roots without delay of modes 1 … N − 1.
fn theory(classes: &DriverClasses) -> Vec<Complex64> {
    let n = classes.vehicles();
    let lower_half = |q: usize| match classes.homogeneous() {
        Some((ring, _)) => ring.eigenvalue(q),
        None => classes.follow(q, 0, Time::Continuous).unwrap_or(Complex64::new(f64::NAN, f64::NAN)),
    };
    (1..n).map(|q| if 2 * q <= n { lower_half(q) } else { lower_half(n - q).conj() }).collect()
}

/// The smallest distance (1/s) between two numerical eigenvalues; infinite with fewer than two. Where it is larger than the
/// error of the solver, the eigenvalues are distinct.
pub fn smallest_distance(eigenvalues: &[JacobianEigenvalue]) -> f64 {
    let value = |e: &JacobianEigenvalue| Complex64::new(e.real_per_s, e.imaginary_per_s);
    let pairs =
        eigenvalues.iter().enumerate().flat_map(|(k, a)| eigenvalues[..k].iter().map(move |b| (a, b)));
    pairs.map(|(a, b)| norm(value(a) - value(b))).fold(f64::INFINITY, f64::min)
}

/// The eigenvalues as a table.
pub fn table(eigenvalues: &[JacobianEigenvalue]) -> Table {
    let column = |of: fn(&JacobianEigenvalue) -> f64| eigenvalues.iter().map(of).collect();
    Table::new(vec![
        Column::whole(
            "mode",
            "",
            "q, from 1 to N − 1; q and N − q are conjugate",
            eigenvalues.iter().map(|e| e.mode as u64).collect(),
        ),
        Column::float(
            "real_per_s",
            "1/s",
            "real part of the numerical eigenvalue of the Jacobian",
            column(|e| e.real_per_s),
        ),
        Column::float("imaginary_per_s", "1/s", "its imaginary part", column(|e| e.imaginary_per_s)),
        Column::float(
            "theory_real_per_s",
            "1/s",
            "real part by theory: of the closed form −c(1 − e^(2πiq/N)); of drivers that differ, of the root without delay \
             that is followed from mode q of equal drivers",
            column(|e| e.theory_real_per_s),
        ),
        Column::float(
            "theory_imaginary_per_s",
            "1/s",
            "its imaginary part",
            column(|e| e.theory_imaginary_per_s),
        ),
        Column::float(
            "distance_per_s",
            "1/s",
            "distance of the numerical eigenvalue from theory",
            column(|e| e.distance_per_s),
        ),
    ])
}

/// J of a ring whose vehicle j has the slope c_j (1/s), each followed by its leader in the list; (N − 1) × (N − 1).
///
/// Row j: dy_j/dt = c_j(y_{j+1} − y_j) − c_N·y_1, with y_N = 0.
pub fn jacobian(slopes: &[f64]) -> DMatrix<f64> {
    let n = slopes.len().saturating_sub(1);
    let last = slopes.last().copied().unwrap_or(0.0);
    DMatrix::from_fn(n, n, |row, column| {
        let own = if column == row { -slopes[row] } else { 0.0 };
        let ahead = if column == row + 1 { slopes[row] } else { 0.0 };
        let reference = if column == 0 { -last } else { 0.0 };
        own + ahead + reference
    })
}

/// Eigenvalues by the QR algorithm on the Schur form; `None` where it does not converge.
pub fn eigenvalues(matrix: DMatrix<f64>) -> Option<Vec<Complex64>> {
    if matrix.is_empty() {
        return Some(Vec::new());
    }
    let schur = nalgebra::linalg::Schur::try_new(matrix, f64::EPSILON, 100_000)?;
    Some(schur.complex_eigenvalues().iter().map(|z| Complex64::new(z.re, z.im)).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Scenario;
    use crate::stability::homogeneous::HomogeneousRing;
    use crate::stability::lane::lanes_of;

    /// Each closed form has one numerical eigenvalue within 1e-9, and no two share one.
    #[test]
    fn numerical_eigenvalues_are_the_closed_form() {
        for vehicles in (2..=20).chain([25, 33, 50, 64, 100, 128, 133, 200]) {
            let ring = HomogeneousRing { vehicles, slope: 0.731_616 };
            let mut numeric = eigenvalues(jacobian(&vec![ring.slope; vehicles])).unwrap();
            assert_eq!(numeric.len(), vehicles - 1);
            for q in 1..vehicles {
                let exact = ring.eigenvalue(q);
                let (place, distance) = numeric
                    .iter()
                    .map(|z| norm(z - exact))
                    .enumerate()
                    .min_by(|a, b| a.1.total_cmp(&b.1))
                    .unwrap();
                assert!(distance < 1e-9, "N = {vehicles}, q = {q}: {distance:e}");
                numeric.swap_remove(place);
            }
        }
    }

    /// The matrix is the paper's −c(I + A + B).
    #[test]
    fn the_matrix_of_four_vehicles() {
        let c = 2.0;
        let expected = [[-4.0, 2.0, 0.0], [-2.0, -2.0, 2.0], [-2.0, 0.0, -2.0]];
        let matrix = jacobian(&[c; 4]);
        for (row, values) in expected.iter().enumerate() {
            for (column, value) in values.iter().enumerate() {
                assert_eq!(matrix[(row, column)], *value);
            }
        }
    }

    /// Σ_{k<N} (1 − μ)^k vanishes at every μ = −d_q/c, and the eigenvalues are distinct.
    #[test]
    fn the_proposition() {
        for vehicles in 2..=133 {
            let ring = HomogeneousRing { vehicles, slope: 1.0 };
            for q in 1..vehicles {
                let one_less = 1.0 + ring.eigenvalue(q);
                let sum = (0..vehicles).fold(Complex64::ZERO, |sum, _| sum * one_less + 1.0);
                assert!(norm(sum) < 1e-10 * vehicles as f64, "N = {vehicles}, q = {q}: {sum}");
                for other in 1..q {
                    assert!(norm(ring.eigenvalue(q) - ring.eigenvalue(other)) > 1e-4);
                }
            }
        }
    }

    /// Also of heterogeneous drivers: the roots followed without delay are the eigenvalues of the matrix, in any order of the
    /// drivers.
    #[test]
    fn theory_stands_beside_every_numerical_eigenvalue() {
        let heterogeneous =
            ["1-9:sensitivity=1.6,max-speed=35".parse().unwrap(), "20:min-headway=9".parse().unwrap()];
        for vehicles in [1, 2, 3, 50, 51, 120] {
            for overrides in [Vec::new(), heterogeneous.to_vec()] {
                let scenario = Scenario { vehicles, ..Scenario::default() };
                let overrides = if vehicles < 20 { Vec::new() } else { overrides };
                let mut drivers = lanes_of(&Scenario { overrides, ..scenario }).remove(0).drivers;
                for _ in 0..2 {
                    let found = numerical_eigenvalues(&drivers, 1000.0).unwrap();
                    assert_eq!(found.len(), vehicles - 1);
                    assert!(found.iter().all(|e| e.distance_per_s < 1e-9), "{vehicles}: {found:?}");
                    let error = found.iter().map(|e| e.distance_per_s).fold(0.0, f64::max);
                    assert!(smallest_distance(&found) > 1e4 * error);
                    assert_eq!(table(&found).rows(), vehicles - 1);
                    drivers.swap(0, vehicles / 2);
                }
            }
        }
        // In the jam the matrix is 0.
        let jam = lanes_of(&Scenario { vehicles: 150, ..Scenario::default() }).remove(0).drivers;
        assert!(numerical_eigenvalues(&jam, 1000.0).unwrap().iter().all(|e| e.distance_per_s == 0.0));
    }

    #[test]
    fn a_lane_that_is_too_large_is_refused() {
        let drivers = [Driver::default(); MOST_VEHICLES + 1];
        let message = numerical_eigenvalues(&drivers, 1e4).unwrap_err().to_string();
        assert!(
            message.starts_with("vehicles: 201 is not allowed; allowed: at most 200 vehicles"),
            "{message}"
        );
    }
}
