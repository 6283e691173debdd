"""Packings made by hand: 100 lone spheres of 2 um; 100 each of 0.2, 0.6 and 2 um; 200 pairs of 0.5 um at gaps of 30 nm; a column
of 320 of 0.5 um, about as dense as it will be, and 400 as far apart as its top. by_hand.py lone|sizes|pairs|settled|dilute FILE"""
import sys

import h5py
import numpy as np

from equilibrium import settled_column

kind, name = sys.argv[1:]
random = np.random.default_rng(1)
grid = np.stack(np.meshgrid(*[np.arange(7)] * 3, indexing="ij"), -1).reshape(-1, 3)
if kind == "lone":
    edge, position, radius = (700.0,) * 3, 100.0 * grid[:100] + 50, np.ones(100)
elif kind == "sizes":
    edge, position, radius = (700.0,) * 3, 100.0 * grid[:300] + 50, np.repeat([0.1, 0.3, 1.0], 100)
elif kind == "pairs":
    centre = 2.5 * grid[:200] + 1.25
    direction = random.normal(size=(200, 3))
    direction /= np.linalg.norm(direction, axis=1)[:, None]
    edge, radius = (17.5,) * 3, np.full(400, 0.25)
    position = np.stack([centre, centre + 0.53 * direction], 1).reshape(-1, 3)
    position[:, 2] += 1.0
elif kind == "dilute":
    x, y = np.meshgrid(2.5 * np.arange(20), 2.5 * np.arange(20))
    position = np.column_stack([x.ravel(), y.ravel(), 0.28 + random.exponential(0.65, 400)])
    edge, radius = (50.0, 50.0, 20.0), np.full(400, 0.25)
else:
    # Layers of 16, each over the holes of the one below, as far apart as the solids there ask for.
    height = np.linspace(0, 30, 3001)
    column = np.cumsum(settled_column(320 * np.pi / 6 * 0.53**3 / 5.76, 0.65, height)) * 0.01
    z = 0.28 + np.interp((np.arange(20) + 0.5) / 20 * column[-1], column, height)
    x, y = np.meshgrid(0.6 * np.arange(4), 0.6 * np.arange(4))
    position = np.concatenate([np.column_stack([x.ravel() + 0.3 * (k % 2), y.ravel() + 0.3 * (k % 2), np.full(16, z[k])]) for k in range(20)])
    edge, radius = (2.4, 2.4, 20.0), np.full(320, 0.25)
with h5py.File(name, "w") as f:
    layer = f.create_group("particles/layer")
    layer.create_group("box").create_dataset("edges", data=np.array(edge) * 1e-6)
    layer["position"], layer["radius"] = position * 1e-6, radius * 1e-6
