"""Prints the radii and gaps at which data/resistance has exact values, as pigment-interactions reads them.

The smaller sphere, or the one before a boundary, has a radius of 0.5 um; of two spheres the larger comes first.
"""
import pathlib
import sys

import numpy as np

reference = pathlib.Path(sys.argv[1])
SMALLER = 0.5e-6
print("a1,a2,h")
for row in np.genfromtxt(reference / "relative_K_basis.csv", delimiter=",", skip_header=1):
    if row[0] > 0:  # a ratio of 0 is the plane, which the boundary tables hold
        print(f"{SMALLER / row[0]!r},{SMALLER!r},{row[2] * SMALLER!r}")
for name, partner in (("wall_resistance", "inf"), ("free_surface", "surface")):
    for row in np.genfromtxt(reference / f"{name}.csv", delimiter=",", skip_header=1):
        print(f"{SMALLER!r},{partner},{row[0] * SMALLER!r}")
