use crate::{Aperture, GRAZING, Ray, Receiver};
use nalgebra::{Matrix3, Vector2, Vector3};
use proptest::prelude::*;
use quad_kinematics::EulerAngles;

fn receiver(normal: [f64; 3]) -> Receiver<f64> {
    Receiver {
        aperture: Aperture::Disc { radius: 0.1 },
        offset: [0.2, 0.0, 0.05],
        normal,
        efficiency: 0.2,
    }
}

/// Vehicle 5 m north, facing south to the station at the origin: head on, the spot is where the geometry says.
#[test]
fn exact_head_on() {
    let r_wb = EulerAngles::level(std::f64::consts::PI).rotation().matrix;
    let face = receiver([1.0, 0.0, 0.0]).on(&Vector3::new(5.2, 0.0, -0.05), &r_wb);
    assert!((face.centre - Vector3::new(5.0, 0.0, 0.0)).norm() < 1e-15);
    // Who looks north at the face has east on the right and up above.
    assert!((face.axes.column(0) - Vector3::y()).norm() < 1e-15);
    assert!((face.axes.column(1) + Vector3::z()).norm() < 1e-15);
    let ray = Ray {
        origin: Vector3::new(0.0, 0.03, -0.04),
        direction: Vector3::x(),
    };
    let link = face.under(&ray);
    assert!((link.range - (25.0_f64 + 0.0025).sqrt()).abs() < 1e-14);
    assert!(link.incidence < 1e-15 && (link.cos_incidence - 1.0).abs() < 1e-15 && link.facing == 1.0);
    assert!((link.spot - Vector2::new(0.03, 0.04)).norm() < 1e-15);
}

/// Turned by 30° about the vertical: α = 30°, and a sideways ray offset b is stretched to b/cos α on the sensor.
#[test]
fn exact_oblique() {
    let angle = 30.0_f64.to_radians();
    let r_wb = EulerAngles::level(std::f64::consts::PI + angle).rotation().matrix;
    let receiver = Receiver {
        offset: [0.0; 3],
        ..receiver([1.0, 0.0, 0.0])
    };
    let face = receiver.on(&Vector3::new(5.0, 0.0, 0.0), &r_wb);
    let link = face.under(&Ray {
        origin: Vector3::new(0.0, 0.1, -0.2),
        direction: Vector3::x(),
    });
    assert!((link.incidence - angle).abs() < 1e-14);
    assert!((link.spot - Vector2::new(0.1 / angle.cos(), 0.2)).norm() < 1e-14);
}

#[test]
fn exact_faces_up_and_down_have_axes() {
    for normal in [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]] {
        let axes = receiver(normal).axes();
        assert_eq!(axes.column(1), Vector3::x());
        assert!((axes.determinant() - 1.0).abs() < 1e-15);
    }
}

#[test]
fn exact_light_from_behind_is_flagged_and_finite() {
    let face = receiver([1.0, 0.0, 0.0]).on(&Vector3::new(5.0, 0.0, 0.0), &Matrix3::identity());
    for direction in [Vector3::x(), -Vector3::x(), Vector3::y()] {
        let link = face.under(&Ray {
            origin: Vector3::zeros(),
            direction,
        });
        assert_eq!(link.facing, 0.0);
        assert!(
            link.spot
                .iter()
                .all(|v| v.is_finite() && v.abs() <= 6.0 / GRAZING),
            "{link:?}"
        );
    }
}

proptest! {
    /// The axes are a right-handed orthonormal triad for every normal.
    #[test]
    fn prop_axes_are_a_rotation(v in prop::array::uniform3(-1.0..1.0_f64)) {
        prop_assume!(Vector3::from(v).norm() > 0.1);
        let n = Vector3::from(v).normalize();
        let axes = receiver(n.into()).axes();
        // The in-plane part of "up" is at least 1e-6 long: its direction keeps ten digits.
        prop_assert!((axes.transpose() * axes - Matrix3::identity()).norm() < 1e-9);
        prop_assert!(axes.determinant() > 0.0 && (axes.column(2) - n).norm() < 1e-15);
    }

    /// The spot lies on the beam's axis and in the sensor's plane: the definition, checked from the outside.
    #[test]
    fn prop_the_spot_is_on_axis_and_plane(
        euler in prop::array::uniform3(-0.6..0.6_f64),
        place in prop::array::uniform3(-1.0..1.0_f64),
        aside in prop::array::uniform2(-0.1..0.1_f64),
    ) {
        let r_wb = EulerAngles::new(euler[0], euler[1], euler[2] + std::f64::consts::PI).rotation().matrix;
        let face = receiver([1.0, 0.0, 0.0]).on(&(Vector3::from(place) + Vector3::new(6.0, 0.0, 0.0)), &r_wb);
        let direction = (face.centre + Vector3::new(0.0, aside[0], aside[1])).normalize();
        let link = face.under(&Ray { origin: Vector3::zeros(), direction });
        prop_assert_eq!(link.facing, 1.0);
        let spot = face.centre + face.axes * Vector3::new(link.spot.x, link.spot.y, 0.0);
        // Distance of the spot from the axis: metres, a dozen roundings.
        prop_assert!(spot.cross(&direction).norm() < 1e-13);
        prop_assert!((link.incidence.cos() + direction.dot(&face.axes.column(2))).abs() < 1e-14);
    }
}
