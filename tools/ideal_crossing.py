#!/usr/bin/env python3
"""Where the ideal cost of the nominal crossing is least: the oracle of wpt-optim's test of the two minima.

    python3 tools/ideal_crossing.py

Needs NumPy. Written from the geometry alone: the vehicle is on the polynomial y(t) from -5 m to 5 m at x north and 3 m up, its thrust
along the acceleration that the path needs, its nose's azimuth towards the station at the origin; range over 8 m and incidence over
40 degrees, squared, averaged over the crossing.
"""
import numpy as np

GRAVITY = 9.81
# The smooth steps from 0 to 1 of degrees 5, 7 and 9: coefficients of s^0, s^1, ...
STEPS = {
    5: [0, 0, 0, 10, -15, 6],
    7: [0, 0, 0, 0, 35, -84, 70, -20],
    9: [0, 0, 0, 0, 0, 126, -420, 540, -315, 70],
}


def unit(v):
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def cost(x, duration, degree, offset):
    """Phi of the crossing with x_0 = x_f = x, the receiver `offset` ahead of the centre of mass."""
    s, h = np.linspace(0.0, 1.0, 4001, retstep=True)
    step = np.polynomial.Polynomial(STEPS[degree])
    zero = np.zeros_like(s)
    position = np.stack([zero + x, -5.0 + 10.0 * step(s), zero - 3.0], axis=1)
    acceleration = np.stack([zero, 10.0 * step.deriv(2)(s) / duration**2, zero], axis=1)
    z_b = unit(np.array([0.0, 0.0, GRAVITY]) - acceleration)
    psi = np.arctan2(-position[:, 1], -position[:, 0])
    # Heading psi: x_B, normal to z_B, lies in the vertical plane of the azimuth psi.
    x_b = unit(np.cross(np.stack([-np.sin(psi), np.cos(psi), zero], axis=1), z_b))
    to_station = -(position + offset * x_b)
    distance = np.linalg.norm(to_station, axis=1)
    incidence = np.arccos(np.sum(to_station * x_b, axis=1) / distance)
    terms = (distance / 8.0) ** 2 + (incidence / np.radians(40.0)) ** 2
    weights = np.ones_like(s)
    weights[1:-1:2], weights[2:-1:2] = 4.0, 2.0
    return h / 3.0 * np.sum(weights * terms)


def least(low, high, f):
    while high - low > 1e-6:
        third = (high - low) / 3.0
        if f(low + third) < f(high - third):
            high -= third
        else:
            low += third
    return 0.5 * (low + high)


for degree in STEPS:
    for offset in (0.0, 0.2):
        for duration in (10.0, 20.0):
            x = least(2.0, 7.0, lambda x: cost(x, duration, degree, offset))
            phi = cost(x, duration, degree, offset)
            print(f"degree {degree}, offset {offset} m, {duration:.0f} s: x = {x:.4f} m, Phi = {phi:.6f}")
