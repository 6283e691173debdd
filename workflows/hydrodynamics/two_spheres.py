"""Writes two_spheres.h5: a packing of two touching-distance spheres, a tenth of a radius apart, the heavy one above."""
import sys

import h5py

with h5py.File(sys.argv[1], "w") as file:
    layer = file.create_group("particles/layer")
    layer["box/edges"] = [1e-5, 1e-5, 1e-5]
    layer["position"] = [[5e-6, 5e-6, 5e-6], [5e-6, 5e-6, 5e-6 + 1.05e-6]]
    layer["radius"] = [0.5e-6, 0.5e-6]
    layer["species"] = [0, 1]
