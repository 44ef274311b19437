//! The Jacobian of the positions relative to the last vehicle, and its eigenvalues from a numerical solver.
//!
//! With y_j = x_j − x_N the equal ring is dy/dt = J·y(t − Δ), J = −c(I + A + B): A has −1 above the diagonal, B
//! has 1 in the first column. **Proposition.** J has N − 1 distinct eigenvalues, so it is
//! diagonalizable: its characteristic polynomial is that of −c times M = I + A + B, and
//! det(M − μI) = Σ_{k<N} (1 − μ)^k = (1 − (1 − μ)^N)/μ, whose roots are 1 − e^{2πiq/N}, q = 1 … N − 1.

use crate::numerics::complex::Complex64;
use nalgebra::DMatrix;

/// J of a ring whose vehicle j has the slope c_j (1/s), in the order of the ring; (N − 1) × (N − 1).
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
    use super::super::homogeneous::HomogeneousRing;
    use super::*;
    use crate::numerics::complex::norm;

    /// Each closed form has one numerical eigenvalue within 1e-9, and no two share one.
    #[test]
    fn numerical_eigenvalues_are_the_closed_form() {
        for vehicles in (2..=20).chain([25, 33, 50, 64, 100, 128, 133]) {
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
}
