#!/usr/bin/env python3
"""Recomputes the derived numbers of data/vehicles/*.toml by an independent path.

Plain Python (3.11, no packages), written from the equations and not from the Rust code: least squares by
QR (Gram-Schmidt) where the Rust code uses normal equations, steady states by bisection where it uses the closed
form, linearisations by central differences where it uses derivatives on paper. Run from anywhere:

    python3 tools/check_parameters.py

prints each number, what the vehicle file says and the relative difference; exit code 1 if one exceeds 1e-3.
"""

import csv
import math
import pathlib
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent
TOLERANCE = 1e-3  # four printed digits leave 5e-4, the finite differences less


def table(name):
    with open(ROOT / "data" / "propellers" / name) as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def vehicle(name):
    with open(ROOT / "data" / "vehicles" / name, "rb") as file:
        return tomllib.load(file)


def least_squares(columns, values):
    """Coefficients of the columns, by modified Gram-Schmidt."""
    columns, size = [list(c) for c in columns], len(columns)
    basis, upper = [], [[0.0] * size for _ in range(size)]
    for j, column in enumerate(columns):
        for i, q in enumerate(basis):
            upper[i][j] = sum(a * b for a, b in zip(q, column))
            column = [a - upper[i][j] * b for a, b in zip(column, q)]
        upper[j][j] = math.sqrt(sum(a * a for a in column))
        basis.append([a / upper[j][j] for a in column])
    right = [sum(a * b for a, b in zip(q, values)) for q in basis]
    for i in reversed(range(size)):
        right[i] = (right[i] - sum(upper[i][k] * right[k] for k in range(i + 1, size))) / upper[i][i]
    return right


def spread(start, end, count):
    return [start + (end - start) * i / (count - 1) for i in range(count)]


def bisect(function, low, high):
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if function(middle) < 0 else (low, middle)
    return (low + high) / 2


def slope(function, x, step):
    return (function(x + step) - function(x - step)) / (2 * step)


class Rotor:
    """Propeller on a motor."""

    def __init__(self, file):
        value = lambda group, key: file[group][key]["value"]
        self.density, d = value("environment", "air_density_kg_m3"), value("propeller", "diameter_m")
        self.diameter = d
        self.k_t = value("propeller", "thrust_coefficient") * self.density * d**4 / (2 * math.pi) ** 2
        self.k_q = value("propeller", "torque_coefficient") * self.density * d**5 / (2 * math.pi) ** 2
        self.k_v, self.r = value("motor", "velocity_constant_rad_s_v"), value("motor", "resistance_ohm")
        self.i_0, self.inertia = value("motor", "no_load_current_a"), value("motor", "rotor_inertia_kg_m2")
        self.lag, self.full = value("motor", "controller_lag_s"), value("motor", "full_voltage_duty")
        self.v_b = value("battery", "nominal_voltage_v")
        self.hover_thrust = value("airframe", "mass_kg") * value("environment", "gravity_m_s2") / 4

    def acceleration(self, speed, voltage):
        current = (voltage - speed / self.k_v) / self.r
        return ((current - self.i_0) / self.k_v - self.k_q * speed**2) / self.inertia

    def speed(self, duty, battery=None):
        voltage = duty / self.full * (battery or self.v_b)
        if self.acceleration(0.0, voltage) <= 0:
            return 0.0
        return bisect(lambda w: -self.acceleration(w, voltage), 0.0, self.k_v * voltage)

    def thrust(self, duty, battery=None):
        return self.k_t * self.speed(duty, battery) ** 2

    def duty(self, speed):
        return bisect(lambda u: self.acceleration(speed, u / self.full * self.v_b), 0.0, 10 * self.full)


def check(rows, name, computed, stated):
    rows.append((name, computed, stated, abs(computed - stated) / abs(stated) if stated else abs(computed)))


def dynamics(rows, file, rotor, hover):
    """Poles and the torque's zero, from finite differences of the equation of motion."""
    voltage = rotor.duty(hover) / rotor.full * rotor.v_b
    pole = -slope(lambda w: rotor.acceleration(w, voltage), hover, 1e-3 * hover)
    controller = 1 / rotor.lag
    value = lambda group, key: file[group][key]["value"]
    check(rows, "bandwidth", min(pole, controller), value("linear_rotor", "bandwidth_rad_s"))
    zero = slope(lambda w: rotor.k_q * w**2, hover, 1e-3 * hover) / rotor.inertia
    c2 = pole * controller
    numbers = (pole + controller, c2, c2 / zero, c2, pole + controller, c2)
    keys = ("thrust_c1_per_s", "thrust_c2_per_s2", "torque_c1_per_s", "torque_c2_per_s2", "torque_c3_per_s", "torque_c4_per_s2")
    for key, number in zip(keys, numbers):
        check(rows, key, number, value("rotor_dynamics", key))


def polynomial(rows, file, points, ratio):
    top = max(x for x, _ in points)
    columns = [[(x / top) ** power for x, _ in points] for power in (1, 2, 3)]
    terms = [c / top ** (i + 1) for i, c in enumerate(least_squares(columns, [y for _, y in points]))]
    for i, term in enumerate(terms):
        power = "" if i == 0 else str(i + 1)
        group = file["polynomial_rotor"]
        check(rows, f"thrust k{i + 1}", term, group[f"thrust_k{i + 1}_n_per_v{power}"]["value"])
        check(rows, f"torque k{i + 1}", term * ratio, group[f"torque_k{i + 1}_n_m_per_v{power}"]["value"])
    error = max(abs(sum(k * x ** (i + 1) for i, k in enumerate(terms)) - y) for x, y in points)
    print(f"  cubic: largest error {error:.4f} N over {len(points)} points")
    return terms


def line(rows, file, duties, thrusts, ratio):
    intercept, gain = least_squares([[1.0] * len(duties), duties], thrusts)
    zero = -intercept / gain
    value = lambda group, key: file[group][key]["value"]
    check(rows, "thrust gain", gain, value("linear_rotor", "thrust_gain_n"))
    check(rows, "torque gain", gain * ratio, value("linear_rotor", "torque_gain_n_m"))
    check(rows, "zero-thrust duty", zero + value("pwm", "minimum"), value("pwm", "zero_thrust"))
    return gain, zero


def qball(rows):
    file = vehicle("qball-x4.toml")
    static = [[float(x) for x in row.values()] for row in table("apc_sf_10x4.7_static.csv")]
    squares = [rpm**2 for rpm, _, _ in static]
    (c_t,) = least_squares([squares], [c * s for s, (_, c, _) in zip(squares, static)])
    (c_p,) = least_squares([squares], [c * s for s, (_, _, c) in zip(squares, static)])
    check(rows, "C_T", c_t, file["propeller"]["thrust_coefficient"]["value"])
    check(rows, "C_Q", c_p / (2 * math.pi), file["propeller"]["torque_coefficient"]["value"])

    rotor = Rotor(file)
    hover = math.sqrt(rotor.hover_thrust / rotor.k_t)
    u = rotor.duty(hover)
    print(f"  k_T {rotor.k_t:.4e} N s2, k_Q {rotor.k_q:.4e} N m s2, torque per thrust {rotor.k_q / rotor.k_t:.5f} m")
    print(f"  hover: {hover * 30 / math.pi:.0f} rpm, duty {u:.5f}, {u / rotor.full * rotor.v_b:.3f} V; full PWM {rotor.thrust(rotor.full):.2f} N")
    print(f"  slope at hover {slope(rotor.thrust, u, 1e-5):.1f} N, gain from zero {rotor.hover_thrust / u:.1f} N")
    dynamics(rows, file, rotor, hover)

    ratio = rotor.k_q / rotor.k_t
    first, last = (rotor.duty(row[0] * math.pi / 30) for row in (static[0], static[-1]))
    duties = spread(first, last, 1001)
    gain, zero = line(rows, file, duties, [rotor.thrust(d) for d in duties], ratio)
    print(f"  line over {first:.4f}..{last:.4f}: hover error {gain * (u - zero) - rotor.hover_thrust:+.3f} N")
    points = [(d * v, rotor.thrust(d, v)) for d in spread(0.0, 0.05, 51) for v in spread(9.9, 12.6, 10)]
    terms = polynomial(rows, file, points, ratio)
    x = u * rotor.v_b
    print(f"  cubic at hover: {sum(k * x ** (i + 1) for i, k in enumerate(terms)) - rotor.hover_thrust:+.4f} N")

    run = [(float(r["advance_ratio"]), float(r["thrust_coefficient"])) for r in table("apc_sf_10x4.7_advance.csv") if r["run"] == "kt0836"]
    at_rest = next(c for rpm, c, _ in static if rpm == 4029.0)
    run = [(0.0, at_rest)] + [row for row in run if row[0] <= 0.3]
    _, advance = least_squares([[1.0] * len(run), [j for j, _ in run]], [c for _, c in run])
    axial = -rotor.density * hover / (2 * math.pi) * rotor.diameter**3 * advance
    print(f"  dC_T/dJ {advance:.4f}, -dT/dV {axial:.4f} N s/m")
    arm, damping = file["airframe"]["arm_length_m"]["value"], file["drag"]["rate_damping_n_m_s"]["value"]
    for name, number, stated in zip("xyz", (2 * arm**2 * axial, 2 * arm**2 * axial, 8 * rotor.k_q * hover), damping):
        check(rows, f"rate damping {name}", number, stated)


def crazyflie(rows):
    file = vehicle("crazyflie.toml")
    rotor = Rotor(file)
    measured = lambda c: 0.02248 - 0.01143 * c + 0.12828 * c**2
    ratio = 0.005964552
    command = lambda thrust: bisect(lambda c: measured(c) - thrust, 0.05, 2.0)
    hover_command = command(rotor.hover_thrust)

    # Speed at hover from the published maps of thrust and speed over the command of 16 bits.
    thrust = lambda c: 2.130295e-11 * c**2 + 1.032633e-6 * c + 5.484560e-4
    hover = 0.04076521 * bisect(lambda c: thrust(c) - rotor.hover_thrust, 0.0, 65535.0) + 380.8359
    k_t = rotor.hover_thrust / hover**2
    value = lambda group, key: file[group][key]["value"]
    c_t = k_t * (2 * math.pi) ** 2 / (rotor.density * rotor.diameter**4)
    check(rows, "C_T", c_t, value("propeller", "thrust_coefficient"))
    check(rows, "C_Q", c_t * ratio / rotor.diameter, value("propeller", "torque_coefficient"))
    current = rotor.k_v * k_t * ratio * hover**2 + rotor.i_0
    check(rows, "resistance", (hover_command * rotor.v_b - hover / rotor.k_v) / current, rotor.r)
    damping = 1 / (rotor.k_v**2 * rotor.r) + 2 * k_t * ratio * hover
    check(rows, "rotor inertia", 0.074 * damping, rotor.inertia)
    print(f"  hover at command {hover_command:.4f}, {hover:.0f} rad/s; full PWM {rotor.thrust(1.0):.4f} N, measured {measured(1.0):.4f} N")
    dynamics(rows, file, rotor, hover)

    duties = spread(command(rotor.hover_thrust / 2), command(1.5 * rotor.hover_thrust), 1001)
    gain, zero = line(rows, file, duties, [measured(d) for d in duties], ratio)
    print(f"  line over {duties[0]:.4f}..{duties[-1]:.4f}: hover error {gain * (hover_command - zero) - rotor.hover_thrust:+.5f} N")
    polynomial(rows, file, [(c * rotor.v_b, measured(c)) for c in spread(0.3, 1.0, 1001)], ratio)

    across, along = 9.1785e-7 * hover, 10.311e-7 * hover
    quadratic, damping = file["drag"]["quadratic_n_s2_m2"]["value"], file["drag"]["rate_damping_n_m_s"]["value"]
    for axis, drag, stated in zip("xyz", (across, across, along), quadratic):
        check(rows, f"drag {axis}", 4 * drag / 2.0, stated)
    hub = 4 * 0.028**2 * along
    for axis, number, stated in zip("xyz", (hub, hub, 8 * k_t * ratio * hover), damping):
        check(rows, f"rate damping {axis}", number, stated)


def main():
    worst = 0.0
    for name, checks in (("qball-x4.toml", qball), ("crazyflie.toml", crazyflie)):
        rows = []
        print(name)
        checks(rows)
        for label, computed, stated, difference in rows:
            worst = max(worst, difference)
            print(f"  {label:18} {computed:13.6g} file {stated:13.6g} relative difference {difference:.1e}")
    return 1 if worst > TOLERANCE else 0


if __name__ == "__main__":
    sys.exit(main())
