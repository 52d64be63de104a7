//! Ideal pointing: the angles at which the beam meets a point.
//!
//! The beam leaves the platform at an offset `o = [o_x, o_y, o_z]` along E, parallel to the platform's x. With the point
//! `p` in the pedestal's axes at zero pan, it lies on the beam where `R_z(ψ_E) R_y(θ_E) [d, o_y, o_z] = p`, hence
//!
//! ```text
//! a² = p_x² + p_y² − o_y²,   d² = a² + p_z² − o_z²
//! ψ_E = atan2(p_y, p_x) − atan2(o_y, a)
//! θ_E = atan2(o_z, d) − atan2(p_z, a)
//! ```
//!
//! Straight above the pedestal the pan angle is free; zero is chosen. A point nearer to the axes than the
//! offset can't be met. Travel and rate limits of the gimbal are left out on purpose: this is the bound that a real gimbal
//! is compared with.

use crate::{Ets, GimbalState};
use nalgebra::Vector3;
use std::f64::consts::{PI, TAU};

impl Ets<f64> {
    /// The gimbal at rest with the beam's axis through a point in W, m; `None` if no angles reach it (the point is closer
    /// to an axis of the gimbal than the beam, or not finite).
    pub fn aim(&self, point: &Vector3<f64>) -> Option<GimbalState<f64>> {
        let [_, o_y, o_z] = self.beam.offset;
        let p = point - self.pedestal.origin();
        let a_squared = p.x.powi(2) + p.y.powi(2) - o_y.powi(2);
        let d_squared = a_squared + p.z.powi(2) - o_z.powi(2);
        if !(a_squared >= 0.0 && d_squared > 0.0 && d_squared.is_finite()) {
            return None;
        }
        let (a, d) = (a_squared.sqrt(), d_squared.sqrt());
        let pan = p.y.atan2(p.x) - o_y.atan2(a) - self.pedestal.heading;
        let tilt = o_z.atan2(d) - p.z.atan2(a);
        Some(GimbalState::at_rest(pan - TAU * ((pan + PI) / TAU).floor(), tilt))
    }
}

#[cfg(test)]
mod tests {
    use crate::{Ets, Station};
    use nalgebra::Vector3;
    use proptest::prelude::*;

    proptest! {
        /// The spot's offset is zero to rounding, wherever the point and however the beam is mounted.
        #[test]
        fn prop_the_beam_meets_the_point(
            x in -50.0..50.0_f64, y in -50.0..50.0_f64, z in -50.0..50.0_f64,
            o_y in -0.2..0.2_f64, o_z in -0.2..0.2_f64, heading in -3.2..3.2_f64,
        ) {
            let mut station = Station::nominal();
            station.beam.offset = [0.1, o_y, o_z];
            station.pedestal.heading = heading;
            let ets = Ets::<f64>::new(&station);
            let point = Vector3::new(x, y, z);
            prop_assume!((point - ets.pedestal.origin()).xy().norm() > 0.3);
            let gimbal = ets.aim(&point).expect("far from the axes");
            let ray = ets.ray(&gimbal);
            let miss = (point - ray.origin).cross(&ray.direction).norm();
            // A few roundings of a distance below 100 m.
            prop_assert!(miss < 1e-12, "{miss}");
            prop_assert!((point - ray.origin).dot(&ray.direction) > 0.0);
            prop_assert!(gimbal.pan.abs() <= std::f64::consts::PI * (1.0 + 1e-15));
        }
    }

    #[test]
    fn exact_points_inside_the_offset_are_refused() {
        let mut station = Station::nominal();
        station.beam.offset = [0.0, 0.2, 0.0];
        let ets = Ets::<f64>::new(&station);
        assert!(
            ets.aim(&(ets.pedestal.origin() + Vector3::new(0.1, 0.0, -1.0)))
                .is_none()
        );
        assert!(ets.aim(&Vector3::new(f64::NAN, 0.0, 0.0)).is_none());
    }
}
