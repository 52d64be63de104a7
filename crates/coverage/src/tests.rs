//! Oracles: the volume of a pyramid, the solid angle of a rectangle, symmetry, counting by hand.

use super::*;
use approx::assert_abs_diff_eq;
use nalgebra::Vector3;
use proptest::prelude::*;
use std::f64::consts::{FRAC_PI_2, PI};

const ROOM: Room = Room {
    length_m: 8.0,
    width_m: 6.0,
    height_m: 4.0,
};
const WHOLE: Volume = Volume {
    centre_m: Vector3::new(0.0, 0.0, -2.0),
    size_m: Vector3::new(8.0, 6.0, 4.0),
};

fn lens(horizontal_deg: f64, vertical_deg: f64, far_m: f64) -> Lens {
    Lens {
        horizontal_field_rad: horizontal_deg.to_radians(),
        vertical_field_rad: vertical_deg.to_radians(),
        near_m: 0.0,
        far_m,
    }
}

fn task(lens: Lens, needed: u32, spacing_m: f64) -> Task {
    Task::new(ROOM, WHOLE, lens, needed, spacing_m).unwrap()
}

/// In the middle of the south wall, looking north.
const SOUTH: Camera = Camera {
    position_m: Vector3::new(-4.0, 0.0, -2.0),
    azimuth_rad: 0.0,
    elevation_rad: 0.0,
};

#[test]
fn exact_one_camera_sees_its_pyramid() {
    // 40° by 26°: 5.8 m by 3.7 m at the north wall, so the room cuts the pyramid at its base only.
    let lens = lens(40.0, 26.0, 100.0);
    let pyramid = 4.0 * 20_f64.to_radians().tan() * 13_f64.to_radians().tan() * 8_f64.powi(3) / 3.0;
    let coverage = task(lens, 1, 0.05).coverage(&[SOUTH]).unwrap();
    // Four faces of at most 8.6 m by 5.9 m cut cells of 0.05 m: a cell is right to half of it, and errors alternate.
    assert_abs_diff_eq!(coverage.fraction * 192.0, pyramid, epsilon = 0.1);
}

#[test]
fn exact_range_cuts_a_sector_of_a_ball() {
    // Its surface of 21 m² cuts 8400 cells of 0.05 m; each is wrong by half a cell at most, of either sign.
    // A rectangular field cuts the solid angle 4 asin(sin(h/2) sin(v/2)) from the sphere.
    let (h, v, far): (f64, f64, f64) = (50.0, 30.0, 3.0);
    let angle = 4.0 * ((0.5 * h).to_radians().sin() * (0.5 * v).to_radians().sin()).asin();
    let coverage = task(lens(h, v, far), 1, 0.05).coverage(&[SOUTH]).unwrap();
    assert_abs_diff_eq!(
        coverage.fraction * 192.0,
        angle * far.powi(3) / 3.0,
        epsilon = 0.03
    );
}

#[test]
fn exact_mounts_stand_on_their_walls_and_look_inwards() {
    let mount = |along_m| {
        ROOM.camera(&Mount {
            along_m,
            height_m: 3.0,
            pan_rad: 0.0,
            tilt_rad: 0.0,
        })
    };
    // Middles of the north, east, south and west walls.
    let expected = [
        (3.0, 4.0, 0.0, PI),
        (10.0, 0.0, 3.0, -FRAC_PI_2),
        (17.0, -4.0, 0.0, 0.0),
        (24.0, 0.0, -3.0, FRAC_PI_2),
    ];
    for (along, x, y, azimuth) in expected {
        let camera = mount(along);
        assert_abs_diff_eq!(camera.position_m, Vector3::new(x, y, -3.0), epsilon = 1e-12);
        assert_abs_diff_eq!(camera.azimuth_rad, azimuth, epsilon = 1e-12);
        // Once round is the same place.
        assert_abs_diff_eq!(mount(along + 28.0).position_m, camera.position_m, epsilon = 1e-12);
    }
}

#[test]
fn exact_up_is_up() {
    let field = Camera {
        elevation_rad: 0.3,
        ..SOUTH
    }
    .field(&lens(40.0, 30.0, 10.0), 1.0);
    let axis: Vector3<f64> = field.iter().sum::<Vector3<f64>>() / 4.0 - SOUTH.position_m;
    assert_abs_diff_eq!(
        axis,
        Vector3::new(0.3_f64.cos(), 0.0, -0.3_f64.sin()),
        epsilon = 1e-12
    );
    // Looking north, right is east (+y) and up is −z: the first corner is upper left.
    assert!(field[0].y < 0.0 && field[1].y > 0.0 && field[0].z < field[3].z);
}

#[test]
fn exact_three_cameras_at_one_place_count_three() {
    let task = task(lens(60.0, 45.0, 20.0), 3, 0.4);
    let two = task.coverage(&[SOUTH; 2]).unwrap();
    let three = task.coverage(&[SOUTH; 3]).unwrap();
    assert_eq!(two.fraction, 0.0);
    assert!(three.fraction > 0.1);
    assert_abs_diff_eq!(three.fraction, three.progress, epsilon = 1e-12);
    assert_abs_diff_eq!(two.progress, three.progress * 2.0 / 3.0, epsilon = 1e-12);
}

fn any_mount() -> impl Strategy<Value = Mount> {
    (0.0..28.0, 0.5..4.0, -1.2..1.2, -0.8..0.5).prop_map(|(along_m, height_m, pan_rad, tilt_rad)| Mount {
        along_m,
        height_m,
        pan_rad,
        tilt_rad,
    })
}

proptest! {
    #[test]
    fn prop_one_more_camera_never_sees_less(mounts in prop::collection::vec(any_mount(), 1..6)) {
        let task = task(lens(46.0, 35.0, 9.0), 2, 0.5);
        let cameras: Vec<_> = mounts.iter().map(|m| ROOM.camera(m)).collect();
        let all = task.coverage(&cameras).unwrap();
        let fewer = task.coverage(&cameras[1..]).unwrap();
        prop_assert!(all.fraction >= fewer.fraction && all.progress >= fewer.progress);
        prop_assert!((0.0..=1.0).contains(&all.progress) && all.fraction <= all.progress + 1e-12);
    }

    #[test]
    fn prop_the_mirrored_rig_covers_as_much(mounts in prop::collection::vec(any_mount(), 1..5)) {
        // Mirrored at the plane y = 0. Points on the rim of a field may fall either way by rounding.
        let task = task(lens(46.0, 35.0, 9.0), 1, 0.5);
        let rig: Vec<_> = mounts.iter().map(|m| ROOM.camera(m)).collect();
        let mirrored: Vec<_> = rig.iter().map(|c| Camera {
            position_m: c.position_m.component_mul(&Vector3::new(1.0, -1.0, 1.0)),
            azimuth_rad: -c.azimuth_rad,
            ..*c
        }).collect();
        let (a, b) = (task.coverage(&rig).unwrap(), task.coverage(&mirrored).unwrap());
        prop_assert!((a.fraction - b.fraction).abs() <= 2.0 / task.points().len() as f64);
    }
}

#[test]
fn exact_bad_input() {
    let good = lens(46.0, 35.0, 9.0);
    let new = |room, volume, lens, needed, spacing| {
        Task::new(room, volume, lens, needed, spacing)
            .err()
            .unwrap()
            .to_string()
    };
    let flat = Room {
        height_m: 0.0,
        ..ROOM
    };
    assert!(new(flat, WHOLE, good, 3, 0.5).contains("the room's height must be positive"));
    let high = Volume {
        centre_m: Vector3::new(0.0, 0.0, -3.0),
        ..WHOLE
    };
    assert!(new(ROOM, high, good, 3, 0.5).contains("inside the room"));
    assert!(new(ROOM, WHOLE, Lens { near_m: 10.0, ..good }, 3, 0.5).contains("got 10 m to 9 m"));
    assert!(
        new(
            ROOM,
            WHOLE,
            Lens {
                vertical_field_rad: f64::NAN,
                ..good
            },
            3,
            0.5
        )
        .contains("vertical field")
    );
    assert!(new(ROOM, WHOLE, good, 0, 0.5).contains("at least one camera"));
    assert!(new(ROOM, WHOLE, good, 3, 1e-3).contains("larger cells"));
    assert!(new(ROOM, WHOLE, good, 3, f64::NAN).contains("spacing"));
    let task = task(good, 3, 0.5);
    let told = |camera| task.coverage(&[SOUTH, camera]).err().unwrap().to_string();
    let outside = Camera {
        position_m: Vector3::new(9.0, 0.0, -1.0),
        ..SOUTH
    };
    assert!(told(outside).contains("camera 1 must be inside the room"));
    assert!(
        told(Camera {
            azimuth_rad: f64::NAN,
            ..SOUTH
        })
        .contains("camera 1: azimuth")
    );
    assert!(
        told(Camera {
            position_m: Vector3::repeat(f64::NAN),
            ..SOUTH
        })
        .contains("inside the room")
    );
}

const HEIGHTS: std::ops::RangeInclusive<f64> = 1.0..=3.0;

/// Four cameras of a rig of eight decide on all: what they see is its own mirror image at both middle planes.
#[test]
fn prop_a_rig_of_a_multiple_of_four_is_symmetrical() {
    let rig = WallRig::new(ROOM, 8, HEIGHTS).unwrap();
    assert_eq!(rig.variables().len(), 8);
    let task = task(lens(60.0, 40.0, 6.0), 2, 0.25);
    // 32, 24 and 16 cells along x, y and z.
    let at = |i: usize, j: usize, k: usize| i + 32 * (j + 24 * k);
    let seen = task
        .coverage(&rig.cameras(&[4.1, 2.0, 0.3, -0.2, 8.3, 1.2, -0.4, 0.1]))
        .unwrap();
    let mut differing = 0;
    for (i, j, k) in (0..32).flat_map(|i| (0..24).flat_map(move |j| (0..16).map(move |k| (i, j, k)))) {
        let of = |i, j| seen.seen_by[at(i, j, k)];
        assert_eq!(of(i, j), of(31 - i, j));
        assert_eq!(of(i, j), of(i, 23 - j));
        differing += u32::from(of(i, j) != of(0, 0));
    }
    assert!(differing > 1000, "{differing}");
}

/// The first guess: at equal ways along the walls, each looking at the wall opposite.
#[test]
fn exact_first_guesses() {
    for cameras in [1, 4, 6, 8] {
        let rig = WallRig::new(ROOM, cameras, HEIGHTS).unwrap();
        let guess = rig.cameras(&rig.first_guess());
        assert_eq!(guess.len(), cameras);
        for camera in &guess {
            let p = camera.position_m;
            assert_eq!(p.z, -2.5);
            let ahead = Vector3::new(camera.azimuth_rad.cos(), camera.azimuth_rad.sin(), 0.0);
            // On the north or south wall it looks along x, on the others along y, and inwards.
            let onto = if p.x.abs() == 4.0 { p.x } else { p.y };
            assert_abs_diff_eq!(ahead.dot(&p), -onto.abs(), epsilon = 1e-12);
        }
        let inside = |values: &[f64]| {
            let bounds = rig.variables();
            values
                .iter()
                .zip(&bounds)
                .all(|(x, v)| (v.lower..=v.upper).contains(x))
        };
        assert!(inside(&rig.first_guess()));
    }
}

/// Nothing covered costs 1.1, all covered nothing.
#[test]
fn exact_costs() {
    let none = task(lens(40.0, 26.0, 100.0), 1, 0.5).coverage(&[]).unwrap();
    assert_abs_diff_eq!(none.cost(), 1.1, epsilon = 1e-12);
    let all = Coverage {
        seen_by: Vec::new(),
        fraction: 1.0,
        progress: 1.0,
    };
    assert_eq!(all.cost(), 0.0);
}

#[test]
fn exact_rigs_that_are_none() {
    for cameras in [0, 65_536, usize::MAX] {
        let refused = WallRig::new(ROOM, cameras, HEIGHTS);
        assert_eq!(refused, Err(CoverageError::BadCount { cameras, limit: 1024 }));
    }
    for heights in [3.0..=1.0, -1.0..=2.0, 1.0..=5.0, f64::NAN..=2.0] {
        let refused = WallRig::new(ROOM, 4, heights).unwrap_err();
        assert!(matches!(refused, CoverageError::BadHeights { .. }), "{refused}");
    }
    let flat = Room { width_m: 0.0, ..ROOM };
    assert!(matches!(
        WallRig::new(flat, 4, HEIGHTS),
        Err(CoverageError::NonPositiveLength { .. })
    ));
}
