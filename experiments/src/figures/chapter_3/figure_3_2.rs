//! Figure 3.2: rotor outputs against rigid-body forces.

use crate::claim::Claim;
use crate::data::DataTable;
use crate::drawing::Drawing;
use crate::item::{Context, Item, ItemError, Kind, Make, Origin};
use crate::plot::diagram::{BLUE_TINT, Diagram, ORANGE_TINT};
use crate::plot::style::{BLUE, GREY, INK, Look, VERMILION};
use crate::plot::svg::{Point, at};
use crate::vehicle::{NOMINAL_VEHICLE, load_vehicle};
use nalgebra::Vector4;
use quad_dynamics::{RotorGeometry, Vehicle};
use quad_rotor::RotorOutput;

/// The figure.
pub(super) const ITEM: Item = Item {
    id: "3.2",
    title: "Rotor outputs against rigid-body forces",
    description: "Which rotors speed up (+, larger) and slow down (−, smaller) for a positive collective, lateral, \
                  longitudinal and yaw pseudo-input: the columns of *C*^{−1} of the nominal vehicle, seen from above, nose up \
                  the page; 1 rear, 2 front, 3 left, 4 right. Arcs show the spin.",
    kind: Kind::Diagram,
    origin: Origin::Derived,
    claims: &[SIGNS],
    make: Make::Draw(draw),
};

const SIGNS: Claim = Claim::holds(
    "signs follow from the control matrix C: each pseudo-input moves its own axis, positively, and no other",
);

const NAMES: [&str; 4] = [
    "Collective *u*_{col}: climb",
    "Lateral *u*_{lat}: roll right",
    "Longitudinal *u*_{long}: pitch up",
    "Yaw *u*_{yaw}: turn right",
];

fn draw(context: &Context) -> Result<Drawing, ItemError> {
    let vehicle = load_vehicle(context, NOMINAL_VEHICLE)?;
    let inverse = vehicle.control_matrix_inverse()?;
    let mut diagram = Diagram::new(720.0, 235.0);
    let mut data = DataTable::new([
        "pseudo_input",
        "u_rear",
        "u_front",
        "u_left",
        "u_right",
        "thrust",
        "roll",
        "pitch",
        "yaw",
    ]);
    let mut worst = 0.0_f64;
    for (k, name) in NAMES.iter().enumerate() {
        let commands: [f64; 4] = (inverse * Vector4::ith(k, 1.0)).into();
        panel(
            &mut diagram,
            at(95.0 + 178.0 * k as f64, 110.0),
            &vehicle,
            &commands,
            name,
        );
        let effects = effects(&vehicle, &commands);
        for (axis, effect) in effects.iter().enumerate() {
            worst = worst.max((effect - if axis == k { 1.0 } else { 0.0 }).abs());
        }
        let [a, b, c, d] = commands;
        let [e, f, g, h] = effects;
        data.push([
            ["u_col", "u_lat", "u_long", "u_yaw"][k].into(),
            a.into(),
            b.into(),
            c.into(),
            d.into(),
            e.into(),
            f.into(),
            g.into(),
            h.into(),
        ]);
    }
    // Rounding of one 4 × 4 inverse.
    Ok(Drawing::picture(diagram.finish()).data(data).check(
        SIGNS,
        worst < 1e-12,
        format!("forces and moments of the columns of C⁻¹, scaled, differ from the identity by {worst:.1e} at most"),
    ))
}

/// Thrust, roll, pitch and yaw of commands by the rotors' geometry, over `K_T`, `L K_T`, `L K_T`, `K_Q`.
fn effects(vehicle: &Vehicle, commands: &[f64; 4]) -> [f64; 4] {
    let gains = &vehicle.linear_rotor;
    let arm = vehicle.airframe.arm_length;
    let rotors = commands.map(|u| RotorOutput {
        thrust: gains.thrust_gain * u,
        torque: gains.torque_gain * u,
    });
    let wrench = RotorGeometry::<f64>::of(vehicle).wrench(&rotors);
    let roll_pitch = gains.thrust_gain * arm;
    [
        -wrench.force.z / gains.thrust_gain,
        wrench.moment.x / roll_pitch,
        wrench.moment.y / roll_pitch,
        wrench.moment.z / gains.torque_gain,
    ]
}

fn panel(diagram: &mut Diagram, centre: Point, vehicle: &Vehicle, commands: &[f64; 4], name: &str) {
    let largest = commands.iter().fold(0.0_f64, |m, u| m.max(u.abs()));
    let place = |i: usize| {
        let hub = vehicle.hubs()[i] / vehicle.airframe.arm_length;
        // Forward is up the page, right is right.
        centre.offset(52.0 * hub.y, -52.0 * hub.x)
    };
    for i in 0..4 {
        diagram.line(&[centre, place(i)], Look::solid(GREY, 3.0));
    }
    for (i, command) in commands.iter().enumerate() {
        let share = command / largest;
        let radius = 19.0 + 6.0 * share;
        let (fill, sign) = match share {
            s if s > 1e-9 => (BLUE_TINT, "+"),
            s if s < -1e-9 => (ORANGE_TINT, "−"),
            _ => ("#ffffff", "0"),
        };
        diagram.circle(place(i), radius, fill);
        diagram.centred(place(i), sign);
        // Beside the rotor, clear of arms and arcs.
        let beside = radius * std::f64::consts::FRAC_1_SQRT_2 + 7.0;
        diagram.centred(place(i).offset(beside, beside), &(i + 1).to_string());
        // Clockwise seen from above is clockwise on this page.
        let (from, to) = if vehicle.rotors[i].spin.sign() > 0.0 {
            (140.0, 40.0)
        } else {
            (40.0, 140.0)
        };
        let colour = if share > 1e-9 {
            BLUE
        } else if share < -1e-9 {
            VERMILION
        } else {
            INK
        };
        diagram.arrow(
            &Diagram::arc(place(i), (radius + 5.0, radius + 5.0), from, to),
            Look::solid(colour, 1.2),
        );
    }
    let nose = centre.offset(-58.0, -52.0);
    diagram.arrow(&[nose, nose.offset(0.0, -24.0)], Look::solid(INK, 1.0));
    diagram.centred(nose.offset(0.0, 10.0), "nose");
    diagram.centred(centre.offset(0.0, 108.0), name);
}
