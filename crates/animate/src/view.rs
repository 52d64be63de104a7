//! From where the scene is seen at first, and where its ground is.

use serde::Serialize;

/// Smallest half diagonal of a scene, m: a vehicle that hovers is not drawn as large as the screen.
const LEAST_EXTENT_M: f64 = 2.0;

/// The overview at first.
#[derive(Serialize)]
pub(crate) struct View {
    /// Height of the ground in W, m, positive down.
    ground: f64,
    /// Half diagonal of the box around everything, m.
    extent: f64,
    /// Its centre in W, m.
    middle: [f64; 3],
    /// North and east of the centre, m.
    centre: [f64; 2],
    /// Depth to which a camera's field of view is drawn, m.
    frustum: f64,
    camera: Camera,
}

/// Where the eye of the overview is: azimuth from north clockwise, degrees; elevation, degrees; magnification.
#[derive(Serialize)]
struct Camera {
    azimuth: f64,
    elevation: f64,
    zoom: f64,
}

impl View {
    /// The view of these positions in W, m. The ground is at z = 0, or below the lowest position.
    pub(crate) fn of(places: impl Iterator<Item = [f64; 3]>) -> Self {
        let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for place in places {
            for i in 0..3 {
                low[i] = low[i].min(place[i]);
                high[i] = high[i].max(place[i]);
            }
        }
        let ground = high[2].max(0.0);
        high[2] = ground;
        let [x, y, z] = [0, 1, 2].map(|i| (low[i] + high[i]) / 2.0);
        let square: f64 = (0..3).map(|i| (high[i] - low[i]).powi(2)).sum();
        let extent = (square.sqrt() / 2.0).max(LEAST_EXTENT_M);
        Self {
            ground,
            extent,
            middle: [x, y, z],
            centre: [x, y],
            frustum: 0.3 * extent,
            // From the south-west, so that north is to the left and away.
            camera: Camera {
                azimuth: 215.0,
                elevation: 24.0,
                zoom: 1.0,
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_box_ground_and_centre() {
        let view = View::of([[0.0, -3.0, -1.0], [4.0, 3.0, -2.0]].into_iter());
        assert_eq!((view.ground, view.middle), (0.0, [2.0, 0.0, -1.0]));
        // Half diagonal of a box of 4 m by 6 m by 2 m.
        assert_eq!(view.extent, 14_f64.sqrt());
    }

    #[test]
    fn exact_the_ground_lies_below_all() {
        assert_eq!(View::of([[0.0, 0.0, 1.5]].into_iter()).ground, 1.5);
    }
}
