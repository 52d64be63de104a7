use super::super::axis::Axis;
use super::*;

/// Seen from above, the way from the first axis to the second is counter-clockwise, whatever the azimuth: right-handed.
#[test]
fn exact_the_axes_are_right_handed() {
    for azimuth_deg in [-150.0, -62.0, 10.0, 110.0] {
        let view = View {
            azimuth_deg,
            elevation_deg: 40.0,
        };
        let corners = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let unit = Axis {
            range: Some((0.0, 1.0)),
            ..Axis::default()
        };
        let setup = Setup {
            axes: [(); 3].map(|()| unit.settle(std::iter::empty(), false, 4.0)),
            labels: ["x", "y", "up"],
            view,
            equal: false,
        };
        let area = Area {
            origin: at(0.0, 0.0),
            size: (400.0, 400.0),
        };
        let scene = Scene::new(setup, area);
        let [o, x, y, up] = corners.map(|p| scene.project(p));
        // The page's y points down, so a counter-clockwise turn has a negative cross product.
        let cross = (x.x - o.x) * (y.y - o.y) - (x.y - o.y) * (y.x - o.x);
        assert!(cross < 0.0 && up.y < o.y, "{azimuth_deg}: {cross}");
    }
}

/// All labels lie inside the area, beside a box that is as large as they allow.
#[test]
fn prop_labels_lie_inside_the_area() {
    for (azimuth_deg, equal) in [(-55.0, false), (35.0, true), (120.0, false), (-140.0, true)] {
        let axis = |low: f64, high: f64| {
            let axis = Axis {
                range: Some((low, high)),
                ..Axis::default()
            };
            axis.settle(std::iter::empty(), false, 4.5)
        };
        let setup = Setup {
            axes: [axis(-4.0, 4.0), axis(-1e-6, 1e-6), axis(0.0, 2.0)],
            labels: ["north of the station, m", "west, m", "height, m"],
            view: View {
                azimuth_deg,
                elevation_deg: 26.0,
            },
            equal,
        };
        let area = Area {
            origin: at(10.0, 20.0),
            size: (300.0, 260.0),
        };
        let scene = Scene::new(setup, area);
        for (from, to) in scene.words().iter().map(Words::extent) {
            assert!(
                from.x >= 9.0 && to.x <= 311.0 && from.y >= 19.0 && to.y <= 281.0,
                "{azimuth_deg}: {from:?} {to:?}"
            );
        }
    }
}
