//! A space with three axes: trajectories, planes and points in an orthographic view, with shadows on the floor.

use super::axis::Axis;
use super::frame::Area;
use super::legend::{Entry, Legend, Sample};
use super::marker::draw_marker;
pub use super::scene::{Point3, View};
use super::scene::{Scene, Setup};
use super::style::Look;
use super::svg::{Anchor, Svg, TextLook, at};

/// Three axes and what is drawn between them.
///
/// The vertical axis points up and the axes are drawn right-handed. A frame whose z axis points down is so pictured by
/// [`Space::of_z_down`]: `[x, −y, −z]`, north-west-up for north-east-down. With `[x, y, −z]` every turn would be shown the other way round.
#[derive(Clone, Debug)]
pub struct Space {
    /// Words above the picture. Rich text.
    pub caption: String,
    axes: [Axis; 3],
    view: View,
    equal: bool,
    shadows: bool,
    layers: Vec<Layer>,
}

#[derive(Clone, Debug)]
enum Layer {
    Line {
        label: String,
        look: Look,
        points: Vec<Point3>,
    },
    Markers {
        label: String,
        look: Look,
        points: Vec<Point3>,
    },
    Surface {
        colour: &'static str,
        opacity: f64,
        corners: Vec<Point3>,
    },
    Note {
        point: Point3,
        text: String,
    },
}

/// Width and greatest height of a picture of its own, and its border, px.
const PICTURE: (f64, f64) = (520.0, 420.0);
const BORDER: f64 = 8.0;
/// Ticks aimed at on each axis.
const TARGET_TICKS: f64 = 4.5;
/// Look of shadows on the floor.
const SHADOW: Look = Look::solid("#c4c4c4", 0.6);

impl Space {
    /// An empty space with axis labels, the third for the vertical axis, which points up.
    pub fn new(x: impl Into<String>, y: impl Into<String>, up: impl Into<String>) -> Self {
        let axis = |label: String| Axis {
            label,
            ..Axis::default()
        };
        let axes = [axis(x.into()), axis(y.into()), axis(up.into())];
        let view = View::default();
        Self {
            caption: String::new(),
            axes,
            view,
            equal: false,
            shadows: true,
            layers: Vec::new(),
        }
    }

    /// A point of a frame whose z axis points down (north-east-down, forward-right-down) in right-handed axes that point up.
    pub const fn of_z_down(x: f64, y: f64, z: f64) -> Point3 {
        [x, -y, -z]
    }

    /// Adds a line and its shadow.
    pub fn line(
        mut self,
        label: impl Into<String>,
        look: Look,
        points: impl IntoIterator<Item = Point3>,
    ) -> Self {
        let points = points
            .into_iter()
            .filter(|p| p.iter().all(|v| v.is_finite()))
            .collect();
        self.layers.push(Layer::Line {
            label: label.into(),
            look,
            points,
        });
        self
    }

    /// Adds markers.
    pub fn markers(
        mut self,
        label: impl Into<String>,
        look: Look,
        points: impl IntoIterator<Item = Point3>,
    ) -> Self {
        let points = points
            .into_iter()
            .filter(|p| p.iter().all(|v| v.is_finite()))
            .collect();
        self.layers.push(Layer::Markers {
            label: label.into(),
            look,
            points,
        });
        self
    }

    /// Adds a translucent polygon (a plane, a wall, a field of view).
    pub fn surface(
        mut self,
        colour: &'static str,
        opacity: f64,
        corners: impl IntoIterator<Item = Point3>,
    ) -> Self {
        self.layers.push(Layer::Surface {
            colour,
            opacity,
            corners: corners.into_iter().collect(),
        });
        self
    }

    /// Writes words just above a point.
    pub fn annotate(mut self, point: Point3, text: impl Into<String>) -> Self {
        self.layers.push(Layer::Note {
            point,
            text: text.into(),
        });
        self
    }

    /// Sets the direction from which the space is seen.
    pub fn view(mut self, view: View) -> Self {
        self.view = view;
        self
    }

    /// Sets the range of one axis (0, 1, 2).
    pub fn range(mut self, axis: usize, min: f64, max: f64) -> Self {
        self.axes[axis].range = Some((min, max));
        self
    }

    /// Makes one unit equally long on all axes.
    pub fn equal_aspect(mut self) -> Self {
        self.equal = true;
        self
    }

    /// Leaves out the shadows on the floor.
    pub fn without_shadows(mut self) -> Self {
        self.shadows = false;
        self
    }

    /// Sets the words above the picture. Rich text.
    pub fn caption(mut self, caption: impl Into<String>) -> Self {
        self.caption = caption.into();
        self
    }

    /// Draws the space as a picture of its own, with its legend above.
    pub fn draw(&self) -> Svg {
        let legend = Legend::new(self.entries(), PICTURE.0 - 2.0 * BORDER);
        let top = BORDER + legend.height();
        let free = (PICTURE.0 - 2.0 * BORDER, PICTURE.1);
        // A flat box needs less height than there is.
        let whole = Area {
            origin: at(BORDER, top),
            size: free,
        };
        let size = (free.0, Scene::new(self.setup(), whole).height().min(free.1));
        let mut svg = Svg::new(PICTURE.0, top + size.1 + BORDER);
        legend.draw(&mut svg, PICTURE.0 / 2.0, BORDER, (BORDER, PICTURE.0 - BORDER));
        self.draw_in(
            &mut svg,
            Area {
                origin: at(BORDER, top),
                size,
            },
        );
        svg
    }

    /// Legend entries, in order.
    pub(super) fn entries(&self) -> Vec<Entry> {
        let entry = |layer: &Layer| match layer {
            Layer::Line { label, look, .. } => Some((label.clone(), *look, Sample::Line)),
            Layer::Markers { label, look, .. } => Some((label.clone(), *look, Sample::Marker)),
            _ => None,
        };
        let entries = self
            .layers
            .iter()
            .filter_map(entry)
            .filter(|(label, ..)| !label.is_empty());
        entries
            .map(|(label, look, sample)| Entry { label, look, sample })
            .collect()
    }

    /// Draws the space inside an area.
    pub(super) fn draw_in(&self, svg: &mut Svg, area: Area) {
        let scene = Scene::new(self.setup(), area);
        scene.draw_box(svg);
        if self.shadows {
            self.draw_shadows(svg, &scene);
        }
        for layer in &self.layers {
            match layer {
                Layer::Line { look, points, .. } => scene.polyline(svg, points, look),
                Layer::Markers { look, points, .. } => {
                    for point in points {
                        draw_marker(svg, scene.project(*point), look, 4.0);
                    }
                }
                Layer::Surface {
                    colour,
                    opacity,
                    corners,
                } => {
                    let corners: Vec<_> = corners.iter().map(|p| scene.project(*p)).collect();
                    svg.raw(&format!("<g opacity=\"{opacity}\">"));
                    svg.polygon(&corners, colour, Some(&Look::solid(colour, 0.8)));
                    svg.raw("</g>");
                }
                Layer::Note { point, text } => {
                    let look = TextLook {
                        size: 11.0,
                        anchor: Anchor::Middle,
                        ..TextLook::default()
                    };
                    svg.text(scene.project(*point).offset(0.0, -8.0), text, look);
                }
            }
        }
    }

    /// What the box shows.
    fn setup(&self) -> Setup<'_> {
        Setup {
            axes: [0, 1, 2].map(|i| self.axes[i].settle(self.extent(i).into_iter(), true, TARGET_TICKS)),
            labels: [0, 1, 2].map(|i| self.axes[i].label.as_str()),
            view: self.view,
            equal: self.equal,
        }
    }

    fn draw_shadows(&self, svg: &mut Svg, scene: &Scene<'_>) {
        let floor = scene.floor();
        for layer in &self.layers {
            match layer {
                Layer::Line { points, .. } => {
                    let shadow: Vec<Point3> = points.iter().map(|p| [p[0], p[1], floor]).collect();
                    scene.polyline(svg, &shadow, &SHADOW);
                }
                Layer::Markers { points, .. } => {
                    for p in points {
                        svg.circle(scene.project([p[0], p[1], floor]), 2.2, SHADOW.colour, None);
                    }
                }
                _ => {}
            }
        }
    }

    /// Values of one axis that it must cover.
    fn extent(&self, axis: usize) -> Vec<f64> {
        let value = |layer: &Layer| -> Vec<f64> {
            match layer {
                Layer::Line { points, .. } | Layer::Markers { points, .. } => {
                    points.iter().map(|p| p[axis]).collect()
                }
                Layer::Surface { corners, .. } => corners.iter().map(|p| p[axis]).collect(),
                Layer::Note { point, .. } => vec![point[axis]],
            }
        };
        self.layers.iter().flat_map(value).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A left turn flown from north to west (heading falling, z down) is counter-clockwise from above in the picture as well.
    #[test]
    fn exact_a_left_turn_of_a_frame_with_z_down_stays_one() {
        let north = Space::of_z_down(1.0, 0.0, -2.0);
        let west = Space::of_z_down(0.0, -1.0, -2.0);
        assert_eq!((north, west), ([1.0, 0.0, 2.0], [0.0, 1.0, 2.0]));
        assert!(north[0] * west[1] - north[1] * west[0] > 0.0);
    }
}
