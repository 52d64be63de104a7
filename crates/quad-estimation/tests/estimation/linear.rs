//! On a linear process both filters are the Kalman filter: against another crate, against each other, against the Riccati
//! equation.

use crate::support::{generator, normals, scaled_difference};
use adskalman::{ObservationModel, StateAndCovariance, TransitionModelLinearNoControl};
use nalgebra::{DMatrix, DVector, Matrix1, Matrix1x2, Matrix2, Matrix2x1, U1, U2, Vector1, Vector2};
use quad_estimation::{Belief, ExtendedFilter, Filter, Observation, Process, Spread, UnscentedFilter};

/// `x' = F x + u`, `y = H x`, whatever the step.
#[derive(Clone, Debug)]
struct Linear {
    f: DMatrix<f64>,
    h: DMatrix<f64>,
    q: DVector<f64>,
}

impl Process for Linear {
    type Input = f64;
    type Instrument = ();

    fn state_len(&self) -> usize {
        self.f.nrows()
    }

    fn error_len(&self) -> usize {
        self.f.nrows()
    }

    fn readings(&self, (): ()) -> usize {
        self.h.nrows()
    }

    fn retract(&self, x: &DVector<f64>, error: &DVector<f64>) -> DVector<f64> {
        x + error
    }

    fn local(&self, reference: &DVector<f64>, x: &DVector<f64>) -> DVector<f64> {
        x - reference
    }

    fn reset_jacobian(&self, error: &DVector<f64>) -> DMatrix<f64> {
        DMatrix::identity(error.len(), error.len())
    }

    fn transition(&mut self, x: &DVector<f64>, input: &f64, _step_s: f64) -> DVector<f64> {
        (&self.f * x).add_scalar(*input)
    }

    fn transition_jacobian(&mut self, _x: &DVector<f64>, _input: &f64, _step_s: f64) -> DMatrix<f64> {
        self.f.clone()
    }

    fn process_noise(&self, _step_s: f64) -> DVector<f64> {
        self.q.clone()
    }

    fn observe(&mut self, x: &DVector<f64>, _input: &f64, (): ()) -> DVector<f64> {
        &self.h * x
    }

    fn observe_jacobian(&mut self, _x: &DVector<f64>, _input: &f64, (): ()) -> DMatrix<f64> {
        self.h.clone()
    }
}

const DEVIATION: f64 = 0.3;
const Q: [f64; 2] = [1e-4, 0.02];

fn f() -> Matrix2<f64> {
    Matrix2::new(1.0, 0.1, -0.3, 0.95)
}

/// A damped oscillator whose position is seen.
fn oscillator() -> Linear {
    Linear {
        f: DMatrix::from_column_slice(2, 2, f().as_slice()),
        h: DMatrix::from_row_slice(1, 2, &[1.0, 0.0]),
        q: DVector::from_column_slice(&Q),
    }
}

fn first() -> Belief {
    Belief::new(
        DVector::from_vec(vec![1.0, -0.5]),
        DMatrix::from_row_slice(2, 2, &[0.5, 0.1, 0.1, 0.8]),
    )
    .expect("a covariance")
}

/// Readings of some signal; whether it is the oscillator's doesn't matter here.
fn readings() -> DVector<f64> {
    normals(60, &mut generator(4))
}

fn run(filter: &mut impl Filter<Process = Linear>, input: f64) -> Vec<Belief> {
    let step = |y: &f64| {
        let values = DVector::from_element(1, *y);
        let observation = Observation {
            instrument: (),
            values,
            deviation: DEVIATION,
        };
        filter.predict(&input, 0.1).expect("a good step");
        filter.update(&input, &observation, None).expect("a good reading");
        filter.belief().clone()
    };
    readings().iter().map(step).collect()
}

/// The same process for the other crate.
struct Theirs;

impl TransitionModelLinearNoControl<f64, U2> for Theirs {
    fn F(&self) -> &Matrix2<f64> {
        const F: Matrix2<f64> = Matrix2::new(1.0, 0.1, -0.3, 0.95);
        &F
    }

    fn FT(&self) -> &Matrix2<f64> {
        const FT: Matrix2<f64> = Matrix2::new(1.0, -0.3, 0.1, 0.95);
        &FT
    }

    fn Q(&self) -> &Matrix2<f64> {
        const NOISE: Matrix2<f64> = Matrix2::new(Q[0], 0.0, 0.0, Q[1]);
        &NOISE
    }
}

impl ObservationModel<f64, U2, U1> for Theirs {
    fn H(&self) -> &Matrix1x2<f64> {
        const H: Matrix1x2<f64> = Matrix1x2::new(1.0, 0.0);
        &H
    }

    fn HT(&self) -> &Matrix2x1<f64> {
        const HT: Matrix2x1<f64> = Matrix2x1::new(1.0, 0.0);
        &HT
    }

    fn R(&self) -> &Matrix1<f64> {
        const R: Matrix1<f64> = Matrix1::new(DEVIATION * DEVIATION);
        &R
    }

    fn predict_observation(&self, state: &Vector2<f64>) -> Vector1<f64> {
        Vector1::new(state.x)
    }
}

#[test]
fn exact_another_crates_linear_filter() {
    let start = first();
    let mut ours = ExtendedFilter::new(oscillator(), start.clone()).expect("same size");
    let ours = run(&mut ours, 0.0);
    let mut theirs = StateAndCovariance::new(
        Vector2::from_column_slice(start.mean.as_slice()),
        Matrix2::from_column_slice(start.covariance.as_slice()),
    );
    for (belief, y) in ours.iter().zip(readings().iter()) {
        let prior = TransitionModelLinearNoControl::predict(&Theirs, &theirs);
        theirs = ObservationModel::update(
            &Theirs,
            &prior,
            &Vector1::new(*y),
            adskalman::CovarianceUpdateMethod::JosephForm,
        )
        .expect("a positive definite prior");
        // Sixty steps of some twenty roundings each, of numbers of order one.
        assert!((belief.mean.fixed_rows::<2>(0) - theirs.state()).amax() < 1e-13);
        let difference = (belief.covariance.fixed_view::<2, 2>(0, 0) - theirs.covariance()).amax();
        assert!(difference < 1e-13, "{difference}");
    }
}

#[test]
fn agree_unscented_with_extended_on_a_linear_process() {
    let mut extended = ExtendedFilter::new(oscillator(), first()).expect("same size");
    let extended = run(&mut extended, 0.05);
    for alpha in [1e-2, 0.1, 1.0] {
        let spread = Spread {
            alpha,
            ..Spread::default()
        };
        let mut unscented = UnscentedFilter::new(oscillator(), first(), spread).expect("same size");
        for (u, e) in run(&mut unscented, 0.05).iter().zip(&extended) {
            // The weights are 1/α² large: rounding of 1e-16 grows by that in means and by it once more in covariances.
            let tolerance = 1e-13 / alpha.powi(2);
            assert!((&u.mean - &e.mean).amax() < tolerance, "α = {alpha}");
            assert!(
                scaled_difference(&u.covariance, &e.covariance) < tolerance,
                "α = {alpha}"
            );
        }
    }
}

/// A random walk seen through noise, `x' = x + w`, `y = x + v`: in the steady state the prior variance solves
/// `p² − q p − q r = 0`.
#[test]
fn exact_steady_state_of_the_riccati_equation() {
    let (q, r) = (0.04, DEVIATION * DEVIATION);
    let walk = Linear {
        f: DMatrix::identity(1, 1),
        h: DMatrix::identity(1, 1),
        q: DVector::from_element(1, q),
    };
    let start = Belief::new(DVector::zeros(1), DMatrix::from_element(1, 1, 5.0)).expect("a covariance");
    let prior = 0.5 * (q + (q * q + 4.0 * q * r).sqrt());
    let posterior = prior * r / (prior + r);
    let mut extended = ExtendedFilter::new(walk.clone(), start.clone()).expect("same size");
    let mut unscented = UnscentedFilter::new(walk, start, Spread::default()).expect("same size");
    for belief in [
        run(&mut extended, 0.0).pop().expect("sixty"),
        run(&mut unscented, 0.0).pop().expect("sixty"),
    ] {
        // The distance shrinks by (r/(p + r))² = 0.27 a step: sixty steps leave nothing but rounding.
        assert!((belief.covariance[(0, 0)] - posterior).abs() < 1e-13);
    }
}

#[test]
fn exact_a_reading_beyond_the_gate_changes_nothing() {
    use quad_estimation::Verdict;
    let mut filter = ExtendedFilter::new(oscillator(), first()).expect("same size");
    let far = Observation {
        instrument: (),
        values: DVector::from_element(1, 9.0),
        deviation: DEVIATION,
    };
    let told = filter.update(&0.0, &far, Some(9.0)).expect("a good reading");
    // ν = 8, S = 0.5 + 0.09.
    assert!((told.nis - 64.0 / 0.59).abs() < 1e-10);
    assert_eq!(told.verdict, Verdict::Rejected);
    assert_eq!(filter.belief(), &first());
    assert_eq!(
        filter.update(&0.0, &far, None).expect("a good reading").verdict,
        Verdict::Used
    );
    // −½ (ν²/S + ln S + ln 2π).
    let expected = -0.5 * (64.0 / 0.59 + 0.59_f64.ln() + std::f64::consts::TAU.ln());
    assert!((told.log_likelihood() - expected).abs() < 1e-10);
}
