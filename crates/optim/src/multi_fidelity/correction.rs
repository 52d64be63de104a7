//! The difference of two levels, interpolated between the points where it is known.
//!
//! ```text
//! δ(u) = Σ_i λ_i |u − u_i|³ + c_0 + c · (u − u_c),   Σ λ_i = 0,   Σ λ_i u_i = 0
//! ```
//!
//! in shares of the box. Affine differences are reproduced from n + 1 points; with fewer the solution of least norm is
//! constant across the directions that are not explored. Source: Powell 1992; March and Willcox 2012.

use nalgebra::{DMatrix, DVector};

/// Singular values below this share of the largest are of points that coincide.
const RANK: f64 = 1e-12;

/// A point where the difference is known.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Node {
    /// Where, in shares of the box.
    pub(super) u: Vec<f64>,
    /// The difference of the costs.
    pub(super) difference: f64,
}

/// The interpolation.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Correction {
    centres: Vec<Vec<f64>>,
    centre: Vec<f64>,
    coefficients: DVector<f64>,
}

fn cubed_distance(a: &[f64], b: &[f64]) -> f64 {
    let square: f64 = a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum();
    square * square.sqrt()
}

impl Correction {
    /// Interpolates; `centre` is where the linear part has its constant.
    pub(super) fn fit(nodes: &[Node], centre: &[f64]) -> Self {
        let (m, n) = (nodes.len(), centre.len());
        let tail = |u: &[f64], j: usize| match j {
            0 => 1.0,
            _ => u[j - 1] - centre[j - 1],
        };
        let entry = |i: usize, j: usize| match (i < m, j < m) {
            (true, true) => cubed_distance(&nodes[i].u, &nodes[j].u),
            (true, false) => tail(&nodes[i].u, j - m),
            (false, true) => tail(&nodes[j].u, i - m),
            (false, false) => 0.0,
        };
        let matrix = DMatrix::from_fn(m + n + 1, m + n + 1, entry);
        let right = DVector::from_fn(m + n + 1, |i, _| nodes.get(i).map_or(0.0, |node| node.difference));
        let svd = matrix.svd(true, true);
        let least = RANK * svd.singular_values.max();
        // The solve fails only without U and V, which are asked for.
        let coefficients = svd
            .solve(&right, least)
            .unwrap_or_else(|_| DVector::zeros(m + n + 1));
        Self {
            centres: nodes.iter().map(|node| node.u.clone()).collect(),
            centre: centre.to_vec(),
            coefficients,
        }
    }

    /// The difference at `u`.
    pub(super) fn at(&self, u: &[f64]) -> f64 {
        let m = self.centres.len();
        let radial = self.centres.iter().map(|c| cubed_distance(u, c));
        let linear = u.iter().zip(&self.centre).map(|(u, c)| u - c);
        let terms = radial.chain(std::iter::once(1.0)).chain(linear);
        debug_assert_eq!(self.coefficients.len(), m + 1 + u.len());
        self.coefficients
            .iter()
            .zip(terms)
            .map(|(c, term)| c * term)
            .sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn nodes(points: &[Vec<f64>], f: impl Fn(&[f64]) -> f64) -> Vec<Node> {
        let node = |u: &Vec<f64>| Node {
            u: u.clone(),
            difference: f(u),
        };
        points.iter().map(node).collect()
    }

    /// One point: the constant, everywhere.
    #[test]
    fn exact_one_point_is_a_constant() {
        let fit = Correction::fit(&nodes(&[vec![0.3, 0.4]], |_| 2.5), &[0.3, 0.4]);
        for u in [[0.3, 0.4], [0.9, 0.1]] {
            assert!((fit.at(&u) - 2.5).abs() < 1e-14);
        }
    }

    proptest! {
        /// An affine difference from a simplex and more points, everywhere. Points are at least 0.1 apart, so the condition
        /// of the system is below 1e6.
        #[test]
        fn exact_affine_differences(a in -3.0..3.0, b in -3.0..3.0, c in -3.0..3.0, x in 0.0..1.0, y in 0.0..1.0) {
            let affine = |u: &[f64]| a + b * u[0] + c * u[1];
            let points = [vec![0.5, 0.5], vec![0.6, 0.5], vec![0.5, 0.6], vec![0.2, 0.8]];
            for count in [3, 4] {
                let fit = Correction::fit(&nodes(&points[..count], affine), &points[0]);
                prop_assert!((fit.at(&[x, y]) - affine(&[x, y])).abs() < 1e-9);
            }
        }

        /// Through every point, whatever the values.
        #[test]
        fn prop_interpolates(values in proptest::collection::vec(-1.0..1.0_f64, 5)) {
            let points = [[0.5, 0.5], [0.6, 0.5], [0.5, 0.6], [0.2, 0.8], [0.9, 0.3]];
            let known: Vec<Node> =
                points.iter().zip(&values).map(|(u, &difference)| Node { u: u.to_vec(), difference }).collect();
            let fit = Correction::fit(&known, &points[0]);
            for node in &known {
                prop_assert!((fit.at(&node.u) - node.difference).abs() < 1e-9);
            }
        }
    }
}
