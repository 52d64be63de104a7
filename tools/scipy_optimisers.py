#!/usr/bin/env python3
"""What SciPy's optimisers find on the standard test functions: the oracle of optim's tests.

    python3 tools/scipy_optimisers.py > crates/optim/tests/data/scipy_optimisers.json

Needs SciPy. Every float is written so that it reads back bit for bit. Nelder-Mead starts from a given simplex, and all
points it evaluates are recorded; the rest is compared by its minimum only, because the random numbers are others.
"""
import json

import numpy as np
import scipy
from scipy import optimize


def himmelblau(x):
    a, b = x[0] * x[0] + x[1] - 11.0, x[0] + x[1] * x[1] - 7.0
    return a * a + b * b


def rosenbrock(x):
    total = 0.0
    for i in range(len(x) - 1):
        a, b = x[i + 1] - x[i] * x[i], 1.0 - x[i]
        total = total + (100.0 * (a * a) + b * b)
    return total


def rastrigin(x):
    return float(sum(10.0 + v * v - 10.0 * np.cos(2.0 * np.pi * v) for v in x))


def sphere(x):
    return float(sum(v * v for v in x))


FUNCTIONS = {f.__name__: f for f in (himmelblau, rosenbrock, rastrigin, sphere)}


def result(found):
    return {"x": [float(v) for v in found.x], "cost": float(found.fun), "evaluations": int(found.nfev)}


def nelder_mead(name, lower, upper, start, adaptive=False):
    """From a simplex with edges of a tenth of the box."""
    n = len(start)
    simplex = [list(start)] + [[s + (0.1 * (upper - lower) if i == k else 0.0) for i, s in enumerate(start)] for k in range(n)]
    points = []

    def cost(x):
        points.append([float(v) for v in x])
        return float(FUNCTIONS[name](points[-1]))

    options = {"initial_simplex": simplex, "xatol": 1e-6 * (upper - lower), "fatol": 1e-8, "adaptive": adaptive, "maxfev": 5000}
    found = optimize.minimize(cost, start, method="Nelder-Mead", bounds=[(lower, upper)] * n, options=options)
    assert found.success
    return {"function": name, "lower": lower, "upper": upper, "simplex": simplex, "adaptive": adaptive,
            "found": result(found), "iterations": int(found.nit), "points": points if n == 2 else []}


def quasi_newton(name, lower, upper, start):
    bounds = [(lower, upper)] * len(start)
    found = optimize.minimize(FUNCTIONS[name], start, method="L-BFGS-B", bounds=bounds, options={"ftol": 1e-15, "gtol": 1e-9})
    return {"function": name, "lower": lower, "upper": upper, "start": list(start), "found": result(found)}


def global_method(method, name, lower, upper, n, **options):
    found = method(FUNCTIONS[name], bounds=[(lower, upper)] * n, **options)
    return {"function": name, "lower": lower, "upper": upper, "variables": n, "found": result(found)}


def bounded(name, lower, upper, start):
    """Powell's line searches within bounds."""
    bounds = [(lower, upper)] * len(start)
    found = optimize.minimize(FUNCTIONS[name], start, method="Powell", bounds=bounds, options={"xtol": 1e-9, "ftol": 1e-12})
    return {"function": name, "lower": lower, "upper": upper, "start": list(start), "found": result(found)}


evolve, anneal = optimize.differential_evolution, optimize.dual_annealing
print(json.dumps({
    "scipy": scipy.__version__,
    "nelder_mead": [
        nelder_mead("himmelblau", -5.0, 5.0, [0.0, 0.0]),
        nelder_mead("himmelblau", -5.0, 5.0, [-4.0, -1.0]),
        nelder_mead("rosenbrock", -2.0, 2.0, [-1.2, 1.0]),
        # The minimum, (1, 1), is out of this box: the constrained one is (0.5, 0.25).
        nelder_mead("rosenbrock", -2.0, 0.5, [-1.2, 0.0]),
        nelder_mead("rosenbrock", -2.0, 2.0, [-1.2, 1.0, -1.2, 1.0], adaptive=True),
        nelder_mead("rosenbrock", -2.0, 2.0, [0.5, 0.5, 0.5, 0.5]),
    ],
    "l_bfgs_b": [
        quasi_newton("rosenbrock", -2.0, 2.0, [-1.2, 1.0]),
        quasi_newton("rosenbrock", -2.0, 0.5, [-1.2, 0.0]),
        quasi_newton("himmelblau", -5.0, 5.0, [1.0, 1.0]),
        quasi_newton("rosenbrock", -2.0, 2.0, [-1.2, 1.0, -1.2, 1.0]),
    ],
    "differential_evolution": [
        global_method(evolve, "rastrigin", -5.12, 4.0, 2, rng=1, polish=False, updating="deferred", tol=0.01, atol=1e-8),
        global_method(evolve, "himmelblau", -5.0, 5.0, 2, rng=1, polish=False, updating="deferred", tol=0.01, atol=1e-8),
        global_method(evolve, "rosenbrock", -2.0, 2.0, 4, rng=1, polish=False, updating="deferred", tol=0.01, atol=1e-8),
    ],
    "dual_annealing": [
        global_method(anneal, "rastrigin", -5.12, 4.0, 2, rng=1),
        global_method(anneal, "himmelblau", -5.0, 5.0, 2, rng=1),
    ],
    "powell": [
        bounded("sphere", -5.0, 4.0, [3.0, -2.0, 1.0]),
        bounded("himmelblau", -5.0, 5.0, [1.0, 1.0]),
    ],
}, indent=None, separators=(",", ":")).replace(',"', ',\n"'))
