use super::camera;
use crate::{Camera, MAX_SLOPE, View};
use nalgebra::{Vector2, Vector3};
use proptest::prelude::*;

#[test]
fn exact_signs_and_scale() {
    let camera = camera();
    // 1 m right and 0.5 m down at 4 m: f/4 and f/8.
    let image = camera.project(&Vector3::new(4.0, 1.0, 0.5));
    let f = camera.focal_length;
    assert_eq!(image.visible, 1.0);
    assert!((image.point - Vector2::new(f / 4.0, f / 8.0)).norm() < 1e-12);
    // Column and row from the upper left corner.
    assert!((camera.pixel(&image.point) - Vector2::new(320.0 + f / 4.0, 240.0 + f / 8.0)).norm() < 1e-12);
}

#[test]
fn exact_field_of_view() {
    let [wide, high] = camera().field_of_view();
    // By hand: 2 atan(320 · 6 µm/4 mm) = 2 atan 0.48 and 2 atan(240 · 6 µm/4 mm) = 2 atan 0.36.
    assert!((wide.to_degrees() - 51.282012).abs() < 1e-6 && (high.to_degrees() - 39.597_753).abs() < 1e-6);
    // A target just inside and just outside its edge.
    let at = |angle: f64| camera().look(&Vector3::new(angle.cos(), angle.sin(), 0.0));
    assert!(matches!(at(wide / 2.0 - 1e-6), View::Visible(_)));
    assert!(matches!(at(wide / 2.0 + 1e-6), View::OutsideField(_)));
}

#[test]
fn exact_what_is_behind_is_not_visible_and_finite() {
    let camera = camera();
    for p in [
        [-1.0, 0.0, 0.0],
        [0.0, 0.0, 0.0],
        [-2.0, 1.0, 5.0],
        [0.0, -3.0, 0.0],
        [-1e9, 1e-9, 0.0],
    ] {
        let p = Vector3::from(p);
        let image = camera.project(&p);
        assert_eq!(camera.look(&p), View::Behind, "{p}");
        assert!(
            image.visible == 0.0 && image.point.iter().all(|v| v.is_finite()),
            "{p}: {image:?}"
        );
        assert!(image.point.amax() <= MAX_SLOPE * camera.focal_length * (1.0 + 1e-12));
        // It says on which side the target is.
        assert!(image.point.x * p.y >= 0.0 && image.point.y * p.z >= 0.0);
    }
}

#[test]
fn exact_quantum_and_noise() {
    let coarse = Camera {
        quantum: 0.5,
        ..camera()
    };
    let image = crate::Image {
        point: Vector2::new(10.3, -7.6),
        visible: 1.0,
    };
    let read = coarse.read_out(&image, &Vector2::new(0.1, 0.0));
    assert_eq!(read.point, Vector2::new(10.5, -7.5));
    let fine = camera().read_out(&image, &Vector2::new(0.25, -0.25));
    assert_eq!(fine.point, image.point + Vector2::new(0.25, -0.25));
    assert_eq!(camera().read_out(&image, &Vector2::zeros()), image);
    // Rounding on a dual number does not panic and passes the derivative.
    let j = quad_math::jacobian(|x| [crate::scalar::whole(x[0])], [2.4]);
    assert_eq!(j.x, 1.0);
    assert_eq!(
        (crate::scalar::whole(2.4_f32), crate::scalar::whole(-2.6_f64)),
        (2.0, -3.0)
    );
}

proptest! {
    /// The inverse of the projection on the whole image, at any depth.
    #[test]
    fn exact_direction_inverts_the_projection(
        column in -320.0..320.0_f64, row in -240.0..240.0_f64, depth in 0.1..1e4_f64,
    ) {
        let camera = camera();
        let point = Vector2::new(column, row);
        let direction = camera.direction(&point);
        prop_assert!((direction.norm() - 1.0).abs() < 1e-15);
        let back = camera.project(&(direction * depth));
        // A handful of roundings of numbers up to 320.
        prop_assert!((back.point - point).norm() < 1e-12 && back.visible == 1.0);
    }
}
