use super::*;
use crate::laboratory::supports::{SupportRig, Triangle, icosahedral_cage, support_forces};
use crate::laboratory::{Sensor, generator};
use crate::test_coverage::assert_covers;
use approx::assert_relative_eq;
use proptest::prelude::*;
use quad_dynamics::Vehicle;

/// The nominal vehicle with its centre of mass moved by millimetres.
fn vehicle() -> Vehicle {
    let mut vehicle = Vehicle::qball_x4();
    vehicle.airframe.centre_of_mass = Vector3::new(0.004, -0.006, 0.012);
    vehicle
}

/// Three faces of the cage: upright, and on two sides.
fn triangles() -> Vec<Triangle> {
    let cage = icosahedral_cage(0.35);
    vec![cage[0], cage[4], cage[8]]
}

const PERFECT: SupportRig = SupportRig {
    scales_n: [Sensor::PERFECT; 3],
    position_m: Sensor::PERFECT,
    levelling_rad: 0.0,
    placings: 1,
};

#[test]
fn exact_cage_is_an_icosahedron() {
    let cage = icosahedral_cage(0.35);
    assert_eq!(cage.len(), 20);
    // Edge over circumscribed radius 4/√(10 + 2√5) = 1.0515; rounding.
    let edge = 0.35 * 4.0 / (10.0 + 2.0 * 5_f64.sqrt()).sqrt();
    for [a, b, c] in cage {
        for side in [a - b, b - c, c - a] {
            assert_relative_eq!(side.norm(), edge, epsilon = 1e-12);
        }
    }
}

#[test]
fn exact_forces_of_the_supports_balance_weight_and_moments() {
    // By hand: a right-angled triangle, gravity square to it, the centre of mass above (0.1, 0.2): λ = (0.7, 0.1, 0.2).
    let triangle = [Vector3::zeros(), Vector3::x(), Vector3::y()];
    let forces = support_forces(&triangle, &Vector3::new(0.1, 0.2, -5.0), 10.0, &Vector3::z()).unwrap();
    for (force, expected) in forces.iter().zip([7.0, 1.0, 2.0]) {
        assert_relative_eq!(*force, expected, epsilon = 1e-14);
    }
}

proptest! {
    #[test]
    fn prop_forces_balance_weight_and_moments_on_any_slope(
        a in prop::array::uniform3(-0.4..0.4_f64), b in prop::array::uniform3(-0.4..0.4_f64),
        c in prop::array::uniform3(-0.4..0.4_f64), r in prop::array::uniform3(-0.1..0.1_f64),
        g in prop::array::uniform3(-1.0..1.0_f64),
    ) {
        let triangle = [a, b, c].map(Vector3::from);
        let (r, down) = (Vector3::from(r), Vector3::from(g));
        let volume = (triangle[1] - triangle[0]).cross(&(triangle[2] - triangle[0])).dot(&down);
        prop_assume!(down.norm() > 0.1 && volume.abs() > 1e-3);
        let down = down.normalize();
        let forces = support_forces(&triangle, &r, 13.7, &down).unwrap();
        let force: f64 = forces.iter().sum();
        let moment: Vector3<f64> = (0..3).map(|i| (triangle[i] - r).cross(&(-down * forces[i]))).sum();
        // Rounding of a 3 × 3 solution of condition up to 1/1e-3.
        prop_assert!((force - 13.7).abs() < 1e-9 && moment.norm() < 1e-9);
    }
}

#[test]
fn exact_perfect_instruments_find_the_centre_of_mass() {
    let vehicle = vehicle();
    for count in [2, 3] {
        let placings = PERFECT
            .measure(&vehicle, &triangles()[..count], &mut generator(0))
            .unwrap();
        let found = locate(&placings).unwrap();
        // Rounding: lengths of 0.35 m and a condition number of order 1.
        assert!((found.point() - vehicle.airframe.centre_of_mass).norm() < 1e-14);
        assert_relative_eq!(found.weight.value, vehicle.weight(), epsilon = 1e-12);
        assert!(found.residuals.iter().all(|r| r.norm() < 1e-14));
    }
}

#[test]
fn exact_two_lines_by_hand() {
    // Lines along z through (1, 0, 0) and along x through (0, 0.2, 3): nearest at x = 1, z = 3, halfway in y, 0.2 apart.
    let tripod =
        |centre: Vector3<f64>, e: Vector3<f64>, f: Vector3<f64>| [centre + e, centre + f, centre - e - f];
    let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
    let placings = [
        Placing::new(0, &tripod(x, x, y), &[4.0; 3]),
        Placing::new(1, &tripod(y * 0.2 + z * 3.0, y, z), &[4.0; 3]),
    ];
    let found = locate(&placings).unwrap();
    assert_relative_eq!(found.point(), Vector3::new(1.0, 0.1, 3.0), epsilon = 1e-14);
    assert_relative_eq!(found.angle_rad, std::f64::consts::FRAC_PI_2, epsilon = 1e-14);
    // Distances 0.1 and 0.1 and one degree of freedom: s = √0.02; y is the mean of two: s/√2 = 0.1; x and z come from
    // one line each: s.
    assert_relative_eq!(
        found.goodness.standard_deviation,
        0.02_f64.sqrt(),
        epsilon = 1e-14
    );
    assert_relative_eq!(found.position[1].standard_error, 0.1, epsilon = 1e-14);
    assert_relative_eq!(found.position[0].standard_error, 0.02_f64.sqrt(), epsilon = 1e-14);
}

#[test]
fn prop_the_result_turns_and_moves_with_the_axes() {
    let placings = SupportRig::default()
        .measure(&vehicle(), &triangles(), &mut generator(3))
        .unwrap();
    let turn = nalgebra::Rotation3::from_euler_angles(0.4, -1.1, 2.0);
    let shift = Vector3::new(0.3, -0.2, 0.7);
    let moved: Vec<Placing> = placings
        .iter()
        .map(|p| Placing::new(p.orientation, &p.points().map(|q| turn * q + shift), &p.forces()))
        .collect();
    let (before, after) = (locate(&placings).unwrap(), locate(&moved).unwrap());
    // Rounding of metres.
    assert!((turn * before.point() + shift - after.point()).norm() < 1e-13);
    let turned = turn.matrix() * before.covariance * turn.matrix().transpose();
    assert_relative_eq!(turned, after.covariance, epsilon = 1e-18, max_relative = 1e-9);
}

#[test]
fn prop_95_percent_intervals_cover_the_true_centre_and_weight() {
    let vehicle = vehicle();
    let truth = vehicle.airframe.centre_of_mass;
    let found = |seed| {
        let placings = SupportRig::default().measure(&vehicle, &triangles(), &mut generator(seed));
        locate(&placings.unwrap()).unwrap()
    };
    for axis in 0..3 {
        assert_covers(|seed| found(seed).position[axis].interval().contains(truth[axis]));
    }
    assert_covers(|seed| found(seed).weight.interval().contains(vehicle.weight()));
}

#[test]
fn data_columns_of_a_csv_file_are_read() {
    let csv = "orientation,x_1_m,y_1_m,z_1_m,force_1_n,x_2_m,y_2_m,z_2_m,force_2_n,x_3_m,y_3_m,z_3_m,force_3_n\n\
               0,1,0,0,4,0,1,0,5,-1,-1,0,6\n";
    let rows: Result<Vec<Placing>, _> = csv::Reader::from_reader(csv.as_bytes()).deserialize().collect();
    let expected = Placing::new(
        0,
        &[Vector3::x(), Vector3::y(), -Vector3::x() - Vector3::y()],
        &[4.0, 5.0, 6.0],
    );
    assert_eq!(rows.unwrap(), [expected]);
}

#[test]
fn exact_refusals() {
    let good = PERFECT
        .measure(&vehicle(), &triangles(), &mut generator(0))
        .unwrap();
    let changed = |change: fn(&mut Placing)| {
        let mut bad = good.clone();
        change(&mut bad[1]);
        locate(&bad)
    };
    assert!(matches!(
        changed(|p| p.x_2_m = f64::NAN),
        Err(CentreOfMassError::NotFinite { index: 1 })
    ));
    assert!(matches!(
        changed(|p| p.x_2_m = 350.0),
        Err(CentreOfMassError::Position { index: 1, .. })
    ));
    assert!(matches!(
        changed(|p| p.force_3_n = -0.2),
        Err(CentreOfMassError::Pulls {
            index: 1,
            support: 3,
            ..
        })
    ));
    assert!(matches!(
        changed(|p| (p.force_1_n, p.force_2_n, p.force_3_n) = (0.0, 0.0, 0.0)),
        Err(CentreOfMassError::Weight { index: 1, .. })
    ));
    assert!(matches!(
        changed(|p| (p.x_3_m, p.y_3_m, p.z_3_m) = (p.x_1_m, p.y_1_m, p.z_1_m)),
        Err(CentreOfMassError::InARow { index: 1, .. })
    ));
    assert!(matches!(
        locate(&good[..1]),
        Err(CentreOfMassError::TooFewOrientations { orientations: 1 })
    ));
    assert!(matches!(
        locate(&[]),
        Err(CentreOfMassError::TooFewOrientations { orientations: 0 })
    ));
    // The same face, called another orientation and tilted by 2°.
    let turn = nalgebra::Rotation3::from_euler_angles(2_f64.to_radians(), 0.0, 0.0);
    let tilted = Placing::new(7, &good[0].points().map(|p| turn * p), &good[0].forces());
    let Err(CentreOfMassError::NearlyParallel { angle_rad, .. }) = locate(&[good[0], tilted]) else {
        panic!("nearly parallel lines must be refused");
    };
    assert!(angle_rad > 0.0 && angle_rad <= 2_f64.to_radians() + 1e-12);
}

#[test]
fn exact_warnings() {
    let placings = SupportRig::default()
        .measure(&vehicle(), &triangles(), &mut generator(1))
        .unwrap();
    assert_eq!(locate(&placings).unwrap().warnings, []);
    // A scale that was not tared pulls all lines the same way: half a newton in 13.7 moves c by 13 mm.
    let untared: Vec<Placing> = placings
        .iter()
        .map(|p| Placing {
            force_1_n: p.force_1_n + 0.5,
            ..*p
        })
        .collect();
    let warnings = locate(&untared).unwrap().warnings;
    assert!(
        matches!(warnings[..], [Warning::GroupsDisagree { .. }]),
        "{warnings:?}"
    );
    // A scale at the end of its range.
    let mut saturated = placings;
    saturated[2].force_2_n = 3.0;
    let warnings = locate(&saturated).unwrap().warnings;
    assert!(
        warnings
            .iter()
            .any(|w| matches!(w, Warning::OddWeight { index: 2, .. })),
        "{warnings:?}"
    );
}

#[test]
fn exact_the_virtual_airframe_can_tip_over() {
    let mut vehicle = vehicle();
    vehicle.airframe.centre_of_mass = Vector3::new(0.3, 0.0, 0.0);
    let result = PERFECT.measure(&vehicle, &triangles(), &mut generator(0));
    assert!(matches!(
        result,
        Err(crate::laboratory::supports::SupportError::TipsOver { .. })
    ));
}
