//! Standard errors from repetitions: pure error in place of the residuals.
//!
//! ```text
//! cov p̂ = B (Σ_g s_g² X_gᵀ X_g) B,   B = (XᵀX)⁻¹,   s_g² = Σ_i (r_gi − r̄_g)² / (n_g − 1)
//! ν_i = V_i² / Σ_g (w_gi s_g²)²/(n_g − 1),   V_i = Σ_g w_gi s_g²,   w_gi = [B X_gᵀ X_g B]_ii
//! ```
//!
//! with the scatter `s_g` of each setting's own repetitions (of all together where a setting was read once), because noise may
//! grow with the load; degrees of freedom ν of each parameter by Satterthwaite.
//!
//! Where a curve misses what it is fitted to, its residuals are noise and misfit together. The misfit is the same in every
//! repetition of the test, so that it does not scatter the estimates about the best curve over these settings; only the
//! noise does, and repetitions at one setting tell the noise alone. What the curve misses is no matter of an interval: it is
//! reported by [`LackOfFit`]. Without repetitions the two cannot be distinguished, and intervals from the residuals, wider than
//! the noise, are all there is.
//!
//! Assumptions: noise independent from datum to datum. Source: Draper and Smith, *Applied Regression
//! Analysis*, section on lack of fit and pure error; White, *A heteroskedasticity-consistent covariance matrix estimator*, Econometrica 48, 1980;
//! Satterthwaite, *An approximate distribution of estimates of variance components*, Biometrics Bulletin 2, 1946.

use crate::estimate::Fit;
use crate::lack_of_fit::LackOfFit;
use nalgebra::{SMatrix, SVector};

/// Degrees of freedom from which pure error is taken: with ten, Student's interval is a seventh wider than with many; with
/// one or two it would be several times as wide, and the residuals say more.
const FEWEST_FREEDOM: f64 = 10.0;

impl<const N: usize> Fit<N> {
    /// The fit of a linear model with standard errors by pure error, if the repetitions have ten degrees of freedom or more; else
    /// unchanged. Rows are the regressors of each datum; data of one setting have the same number.
    ///
    /// The goodness of fit stays that of the residuals, but for the degrees of freedom.
    ///
    /// # Panics
    /// If there is not one row and one setting for each residual: a programming error.
    #[must_use]
    pub fn with_pure_error(mut self, rows: &[[f64; N]], settings: &[usize], repetitions: &LackOfFit) -> Self {
        assert_eq!(rows.len(), self.residuals.len(), "one row for each residual");
        assert_eq!(
            settings.len(),
            self.residuals.len(),
            "one setting for each residual"
        );
        let variance = self.goodness.standard_deviation.powi(2);
        if repetitions.within < FEWEST_FREEDOM || variance <= 0.0 {
            return self;
        }
        let bread = self.covariance / variance;
        let mut covariance = SMatrix::<f64, N, N>::zeros();
        let mut over_freedom = [0.0; N];
        for group in self.groups(rows, settings) {
            let freedom = group.count - 1.0;
            let (scatter, freedom) = if freedom > 0.0 {
                (
                    (group.squares - group.sum.powi(2) / group.count).max(0.0) / freedom,
                    freedom,
                )
            } else {
                (repetitions.pure_error.powi(2), repetitions.within)
            };
            let part = bread * group.gram * bread * scatter;
            covariance += part;
            for (i, sum) in over_freedom.iter_mut().enumerate() {
                *sum += part[(i, i)].powi(2) / freedom;
            }
        }
        for (i, estimate) in self.parameters.iter_mut().enumerate() {
            estimate.standard_error = covariance[(i, i)].sqrt();
            estimate.degrees_of_freedom =
                (covariance[(i, i)].powi(2) / over_freedom[i]).min(repetitions.within);
        }
        let freedoms = self.parameters.iter().map(|p| p.degrees_of_freedom);
        self.goodness.degrees_of_freedom = freedoms.fold(repetitions.within, f64::min);
        self.covariance = covariance;
        self
    }

    fn groups(&self, rows: &[[f64; N]], settings: &[usize]) -> Vec<Group<N>> {
        let count = settings.iter().max().map_or(0, |last| last + 1);
        let mut groups = vec![Group::default(); count];
        for ((row, &setting), &residual) in rows.iter().zip(settings).zip(&self.residuals) {
            let (group, row) = (&mut groups[setting], SVector::from(*row));
            group.count += 1.0;
            group.sum += residual;
            group.squares += residual * residual;
            group.gram += row * row.transpose();
        }
        groups.retain(|group| group.count > 0.0);
        groups
    }
}

/// The data of one setting.
#[derive(Clone)]
struct Group<const N: usize> {
    count: f64,
    /// `Σ r` and `Σ r²`.
    sum: f64,
    squares: f64,
    /// `X_gᵀ X_g`.
    gram: SMatrix<f64, N, N>,
}

impl<const N: usize> Default for Group<N> {
    fn default() -> Self {
        Self {
            count: 0.0,
            sum: 0.0,
            squares: 0.0,
            gram: SMatrix::zeros(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::regression::{Row, linear};

    /// A line through a parabola at −1, 0 and 1, eight readings each with errors ±e: the slope is the mean of the
    /// differences, its variance by hand `s²/(8 + 8)`, with `s² = 8 e²/7`; the parabola is in the residuals alone. Only the two
    /// outer places have a weight: 14 degrees of freedom.
    #[test]
    fn exact_slope_through_a_parabola() {
        let e = 1e-3;
        let places: Vec<f64> = (0..24).map(|k| f64::from(k / 8) - 1.0).collect();
        let rows: Vec<Row<2>> = places
            .iter()
            .enumerate()
            .map(|(k, &x)| Row {
                regressors: [1.0, x],
                y: x * x + if k % 2 == 0 { e } else { -e },
            })
            .collect();
        let regressors: Vec<[f64; 2]> = rows.iter().map(|row| row.regressors).collect();
        let settings: Vec<usize> = (0..24).map(|k| k / 8).collect();
        let plain = linear(&rows).unwrap();
        let test = LackOfFit::test(&plain.residuals, &places, 2).unwrap();
        assert!(test.is_significant());
        let fit = plain.clone().with_pure_error(&regressors, &settings, &test);
        let by_hand = (8.0 * e * e / 7.0 / 16.0_f64).sqrt();
        // Rounding of residuals of 0.7 against errors of 0.001.
        assert!((fit.parameters[1].standard_error / by_hand - 1.0).abs() < 1e-10);
        // Rounding of residuals of 0.7 against errors of 0.001, as above.
        assert!((fit.parameters[1].degrees_of_freedom / 14.0 - 1.0).abs() < 1e-9);
        assert_eq!(fit.goodness.standard_deviation, plain.goodness.standard_deviation);
        // By its residuals the slope would be uncertain by a hundred times as much.
        assert!(plain.parameters[1].standard_error > 100.0 * by_hand);
        // Few repetitions say too little.
        let few = LackOfFit { within: 9.0, ..test };
        assert_eq!(plain.clone().with_pure_error(&regressors, &settings, &few), plain);
    }
}
