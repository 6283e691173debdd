"""Packings of spheres that do not meet others: 100 of 2 um, 100 each of 0.2, 0.6 and 2 um, or 200 pairs of 0.5 um at gaps of 30 nm."""
import sys

import h5py
import numpy as np

kind, name = sys.argv[1:]
random = np.random.default_rng(1)
grid = np.stack(np.meshgrid(*[np.arange(7)] * 3, indexing="ij"), -1).reshape(-1, 3)
if kind == "lone":
    edge, position, radius = 700.0, 100.0 * grid[:100] + 50, np.ones(100)
elif kind == "sizes":
    edge, position, radius = 700.0, 100.0 * grid[:300] + 50, np.repeat([0.1, 0.3, 1.0], 100)
else:
    centre = 2.5 * grid[:200] + 1.25
    direction = random.normal(size=(200, 3))
    direction /= np.linalg.norm(direction, axis=1)[:, None]
    edge, radius = 17.5, np.full(400, 0.25)
    position = np.stack([centre, centre + 0.53 * direction], 1).reshape(-1, 3)
    position[:, 2] += 1.0
with h5py.File(name, "w") as f:
    layer = f.create_group("particles/layer")
    layer.create_group("box").create_dataset("edges", data=np.full(3, edge) * 1e-6)
    layer["position"], layer["radius"] = position * 1e-6, radius * 1e-6
