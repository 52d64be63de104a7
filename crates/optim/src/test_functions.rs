//! Functions with known minima, on which optimisers are compared.

use std::f64::consts::TAU;

/// Himmelblau's function `(x² + y − 11)² + (x + y² − 7)²` of the first two values: four minima of value 0 (Himmelblau 1972).
pub fn himmelblau(x: &[f64]) -> f64 {
    let (x, y) = (x[0], x[1]);
    (x * x + y - 11.0).powi(2) + (x + y * y - 7.0).powi(2)
}

/// The four minima of [`himmelblau`]: (3, 2) and the three other real roots, to the last bits.
pub const HIMMELBLAU_MINIMA: [[f64; 2]; 4] = [
    [3.0, 2.0],
    [-2.805_118_086_952_745, 3.131_312_518_250_573],
    [-3.779_310_253_377_747, -3.283_185_991_286_17],
    [3.584_428_340_330_492, -1.848_126_526_964_404],
];

/// Rosenbrock's valley `Σ 100 (x_{i+1} − x_i²)² + (1 − x_i)²`: the minimum 0 is at ones (Rosenbrock 1960).
pub fn rosenbrock(x: &[f64]) -> f64 {
    x.windows(2)
        .map(|w| 100.0 * (w[1] - w[0] * w[0]).powi(2) + (1.0 - w[0]).powi(2))
        .sum()
}

/// Rastrigin's function `10 n + Σ x_i² − 10 cos 2π x_i`: the minimum 0 is at the origin, among local ones near
/// every point of whole numbers (Rastrigin 1974).
pub fn rastrigin(x: &[f64]) -> f64 {
    x.iter().map(|x| 10.0 + x * x - 10.0 * (TAU * x).cos()).sum()
}

/// Sphere `Σ x_i²`: the minimum 0 is at the origin.
pub fn sphere(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum()
}
