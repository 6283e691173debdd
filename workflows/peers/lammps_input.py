#!/usr/bin/env python3
"""Writes a packing as LAMMPS input for its implicit lubrication, pair style lubricateU/poly: PACKING.h5 FOLDER TYPES.

Units: um, ms, pN. Sizes are sorted into so many types, so that each pair of types has a cutoff of its own: a gap of a quarter of
the sum of radii, at most the smaller radius, as in the engine's own list of pairs that resist. Periodic in all directions.
"""
import sys

import h5py
import numpy as np

packing, folder = sys.argv[1:3]
with h5py.File(packing) as f:
    layer = f["particles/layer"]
    x = layer["position/value"][-1] if "value" in layer["position"] else layer["position"][:]
    a = layer["radius"][:] * 1e6
    edges = layer["box/edges/value"][-1] if "value" in layer["box/edges"] else layer["box/edges"][:]
x, edges = x * 1e6, np.asarray(edges) * 1e6
x[:, :2] %= edges[:2]
types = int(sys.argv[3])
bounds = a.min() * (a.max() / a.min()) ** (np.arange(types + 1) / types)
kind = np.clip(np.searchsorted(bounds, a, side="right"), 1, types)  # the largest belongs to the last type
with open(f"{folder}/layer.data", "w") as out:
    out.write(f"packing\n\n{len(a)} atoms\n{types} atom types\n\n0 {edges[0]:.12g} xlo xhi\n0 {edges[1]:.12g} ylo yhi\n")
    out.write(f"0 {edges[2] + 0.002:.12g} zlo zhi\n\nAtoms # sphere\n\n")
    for k in range(len(a)):
        out.write(f"{k + 1} {kind[k]} {2 * a[k]:.12g} 2.7e-3 {x[k, 0]:.12g} {x[k, 1]:.12g} {x[k, 2]:.12g}\n")
top = bounds[1:]
cut = max(ri + rj + min(0.25 * (ri + rj), ri, rj) for ri in top for rj in top)
with open(f"{folder}/layer.in", "w") as out:
    out.write("units micro\natom_style sphere\nboundary p p p\nnewton off\nneighbor 0.05 bin\ncomm_modify vel yes\n")
    out.write(f"read_data layer.data\npair_style lubricateU/poly 1.0 1 0.001 {cut:.6g} 0.01 1 0\n")
    for i in range(types):
        for j in range(i, types):
            c = top[i] + top[j] + min(0.25 * (top[i] + top[j]), top[i], top[j])
            inner = 1.0001 * (bounds[i] + bounds[j])
            out.write(f"pair_coeff {i + 1} {j + 1} {inner:.6g} {c:.6g}\n")
    out.write("velocity all set 0 0 0\nvelocity all create 1e-3 1\ntimestep 1e-6\nthermo 1\nrun 1\n")
