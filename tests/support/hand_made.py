"""Particle files written with h5py alone, as a user would: box, position, radius and nothing else, SI without units.

hand_made.py lattice FILE        simple cubic lattice of touching 0.5 um spheres, 4 x 4 x 6, one frame, no frame axis
hand_made.py pairs FILE          three frames; a cluster across the periodic corner, a chain, loners (see the code)
hand_made.py moving FILE         four frames; the upper half of 400 particles moves (30, 0, -40) nm a frame of 2 ms
hand_made.py random FILE [N [FRAMES]]  N spheres at random, FRAMES frames, each displaced a little; for speed and bytes
hand_made.py overlap|nan|empty|no_radius|negative|below FILE   files that should be refused or warned about
"""
import sys

import h5py
import numpy as np


def write(name, edges, position, radius, time=None):
    with h5py.File(name, "w") as f:
        layer = f.create_group("particles/layer")
        layer.create_group("box").create_dataset("edges", data=np.asarray(edges, float) * 1e-6)
        position = np.asarray(position, float) * 1e-6
        if time is None:
            layer["position"] = position
        else:
            layer["position/value"] = position
            layer["position/time"] = np.asarray(time, float)
        if radius is not None:
            layer["radius"] = np.asarray(radius, float) * 1e-6


def lattice():
    grid = np.indices((4, 4, 6)).reshape(3, -1).T
    return 0.25 + 0.5 * grid


def main(kind, name, *numbers):
    if kind == "lattice":
        write(name, [2, 2, 3], lattice(), np.full(96, 0.25))
    elif kind == "pairs":
        # 0-1 meet across x, 1-2 across y; 3-4-5-6 stand on the substrate and reach the surface at 4 um; 7, 8 are alone.
        first = np.array([[0.2, 5, 2], [9.19, 5, 2], [9.19, -3.99, 2], [2, 2, 0.5], [2, 2, 1.51], [2, 2, 2.5], [2, 2, 3.5],
                          [6, 2, 1], [6, 8, 3]])
        apart = first.copy()
        apart[5:7, 0] += 0.4  # the chain breaks: 5-6 hang together no more with 3-4
        wrapped_elsewhere = first + np.array([30, -20, 0])  # unwrapped coordinates: nothing changes
        write(name, [10, 10, 4], [first, apart, wrapped_elsewhere], np.full(9, 0.5), [0, 0.001, 0.002])
        with h5py.File(name, "a") as f:
            f["particles/layer/id"] = np.array([20, 11, 30, 7, 6, 5, 9, 40, 41])
    elif kind == "moving":
        rng = np.random.default_rng(5)
        start = rng.random((400, 3)) * [8, 8, 3] + [0, 0, 1]
        start[200:, 2] += 5
        step = np.zeros((400, 3))
        step[200:] = [0.03, 0, -0.04]
        write(name, [8, 8, 10], [start + k * step for k in range(4)], np.r_[np.full(200, 0.125), np.full(200, 0.4)],
              0.002 * np.arange(4))
    elif kind == "random":
        count, frames = int(numbers[0]) if numbers else 500, int(numbers[1]) if len(numbers) > 1 else 3
        rng = np.random.default_rng(7)
        radius = 0.125 * 8 ** rng.random(count) ** 2
        volume = (4 / 3 * np.pi * radius**3).sum()
        height, width = 20.0, np.sqrt(volume / 0.45 / 20)
        position = rng.random((count, 3)) * [width, width, 1]
        position[:, 2] = radius + position[:, 2] * (height - 2 * radius)
        moves = np.cumsum(rng.normal(0, 0.003, (frames, count, 3)), axis=0)
        moves[:, :, 2] = 0
        height_in_time = height * (1 - 0.2 * np.arange(frames) / max(1, frames))
        stretched = np.repeat(position[None], frames, 0) + moves
        stretched[:, :, 2] *= (height_in_time / height)[:, None]
        write(name, [width, width, height], stretched, radius, 0.005 * np.arange(frames))
        with h5py.File(name, "a") as f:
            del f["particles/layer/box/edges"]
            f["particles/layer/box/edges/value"] = 1e-6 * np.c_[np.full(frames, width), np.full(frames, width), height_in_time]
            f["particles/layer/box/edges/time"] = 0.005 * np.arange(frames)
    elif kind == "overlap":
        write(name, [5, 5, 5], [[1, 1, 1], [1.5, 1, 1], [3, 3, 3]], [0.5, 0.5, 0.5])
    elif kind == "nan":
        write(name, [5, 5, 5], [[1, 1, 1], [1.5, np.nan, 1]], [0.5, 0.5])
    elif kind == "empty":
        write(name, [5, 5, 5], np.zeros((0, 3)), np.zeros(0))
    elif kind == "no_radius":
        write(name, [5, 5, 5], [[1, 1, 1]], None)
    elif kind == "negative":
        write(name, [5, 5, 5], [[1, 1, 1]], [-0.5])
    elif kind == "below":
        write(name, [5, 5, 5], [[1, 1, -1]], [0.5])
    else:
        sys.exit(f"unknown kind {kind}")


if __name__ == "__main__":
    main(*sys.argv[1:])
