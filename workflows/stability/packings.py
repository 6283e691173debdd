"""Packings made by hand: packings.py ratio FILE writes two large spheres and a small one between them, almost touching;
packings.py overlap FILE grows every particle of FILE by 1 %, so that many overlap."""
import sys

import h5py

kind, name = sys.argv[1:]
if kind == "ratio":
    large, small = 1e-6, 1e-8
    gap = 1e-6 * small
    low, step = 2e-6, large + small + gap
    with h5py.File(name, "w") as file:
        layer = file.create_group("particles/layer")
        layer["box/edges"] = [1e-5, 1e-5, 2e-5]
        layer["position"] = [[5e-6, 5e-6, low], [5e-6, 5e-6, low + step], [5e-6, 5e-6, low + 2 * step]]
        layer["radius"] = [large, small, large]
else:
    with h5py.File(name, "r+") as file:
        radius = file["particles/layer/radius"]
        radius[...] = 1.01 * radius[:]
