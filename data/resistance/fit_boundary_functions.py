#!/usr/bin/python3
"""Fits the one-sphere boundary functions of lib/resistance/boundary_resistance.cpp to the exact tables beside this file.

Every function is  g(x) = singular + lead L (1+x)^(1-m) + (c0 + c1 x L + c2 x + c3 x^2 L + c4 x^2) / (1+x)^(m+2),
x = gap/radius, L = ln(1 + 1/x); `lead` is the known lubrication coefficient, x^-m the known far-field decay.
Linear least squares, weighted so that the error printed is relative to the whole resistance."""
import csv
import os
import numpy as np

here = os.path.dirname(os.path.abspath(__file__))


def load(name):
    rows = list(csv.DictReader(open(os.path.join(here, name))))
    return {key: np.array([float(row[key]) for row in rows]) for key in rows[0]}


def fit(name, x, y, lead, m, scale):
    L = np.log1p(1 / x)
    base = lead * L / (1 + x) ** (m - 1)
    columns = [np.ones_like(x), x * L, x, x * x * L, x * x]
    A = np.array([c / (1 + x) ** (m + 2) for c in columns]).T
    c, *_ = np.linalg.lstsq(A / scale[:, None], (y - base) / scale, rcond=None)
    error = np.abs((A @ c + base - y) / scale).max()
    print(f"{name:28s} lead {lead:+.6f} m {m} c", " ".join(f"{v:+.8g}" for v in c), f" largest error {error:.1e}")


wall, surface = load("wall_resistance.csv"), load("free_surface.csv")
x = wall["gap_over_a"]
par, rot = wall["F_par(Ft*)"], wall["T_rot(Tr*)"]
fit("wall perpendicular - 1/x", x, wall["F_perp"] - 1 - 1 / x, 1 / 5, 1, wall["F_perp"])
fit("wall parallel", x, par - 1, 8 / 15, 1, par)
fit("wall rolling", x, rot - 1, 2 / 5, 3, rot)
fit("wall coupling", x, wall["F_rot(Fr*)"], -2 / 15, 4, np.sqrt(par * rot))
fit("wall twist", x, wall["T_twist"] - 1, 0, 3, wall["T_twist"])
x = surface["gap_over_a"]
par, rot = surface["F_par"], surface["T_rot"]
fit("surface perpendicular - 1/4x", x, surface["F_perp"] - 1 - 1 / (4 * x), 9 / 20, 1, surface["F_perp"])
fit("surface parallel", x, par - 1, 0, 1, par)
fit("surface rolling", x, rot - 1, 3 / 20, 3, rot)
fit("surface coupling", x, surface["F_rot"], 0, 2, np.sqrt(par * rot))
fit("surface twist", x, surface["T_twist"] - 1, 0, 3, surface["T_twist"])
