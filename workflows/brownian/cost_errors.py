"""What the cakes of the long runs are like (cost.sh): cost_errors.py FOLDER NAME... Prints a table (Markdown), the first run being what
the others are held against, over the times that all have: the second half of the shortest run."""
import sys
from pathlib import Path

import h5py
import numpy as np
from scipy.spatial import cKDTree

NEAR = 0.05       # um: gaps of pairs that count as near, a tenth of the diameter


def blocks(values):
    """Mean and its standard error from four blocks of frames."""
    means = np.array([b.mean() for b in np.array_split(np.asarray(values), 4)])
    return means.mean(), means.std(ddof=1) / 2


def state(path, begin, end):
    """Height of the mass centre (um), near pairs a particle and their mean gap (nm), each with its standard error."""
    with h5py.File(path) as f:
        layer = f["particles/layer"]
        time, radius, box = layer["position/time"][:], 1e6 * layer["radius"][:], 1e6 * layer["box/edges/value"][0]
        frames = np.flatnonzero((time >= begin) & (time <= end))
        position = 1e6 * layer["position/value"][frames[0] : frames[-1] + 1]
    centre, gap, count = [], [], []
    for p in position:
        p = p.copy()
        p[:, :2] %= box[:2]
        pairs = cKDTree(p, boxsize=[box[0], box[1], 0]).query_pairs(2 * radius.max() + NEAR, output_type="ndarray")
        d = p[pairs[:, 1]] - p[pairs[:, 0]]
        d[:, :2] -= box[:2] * np.rint(d[:, :2] / box[:2])
        gaps = np.linalg.norm(d, axis=1) - radius[pairs].sum(axis=1)
        gaps = gaps[gaps < NEAR]
        centre.append(p[:, 2].mean())
        count.append(len(gaps) / len(p))
        gap.append(1e3 * gaps.mean())
    return [blocks(v) for v in (centre, count, gap)]


def main():
    folder, names = Path(sys.argv[1]), sys.argv[2:]
    ends = []
    for name in names:
        with h5py.File(folder / f"{name}.h5") as f:
            ends.append(f["particles/layer/position/time"][-1])
    end = min(ends)
    states = {name: state(folder / f"{name}.h5", 0.5 * end, end) for name in names}
    print(f"\nFrom {0.5 * end:.3g} to {end:.3g} s; differences from `{names[0]}`; standard errors from four blocks.\n")
    print("| run | height of the mass centre | near pairs a particle | their mean gap |\n|---|---|---|---|")
    for name, row in states.items():
        cells = [f"{m:.4g} ± {e:.1g} {unit}".rstrip() for (m, e), unit in zip(row, ("um", "", "nm"))]
        if name != names[0]:
            for k, ((m, e), (m0, e0)) in enumerate(zip(row, states[names[0]])):
                cells[k] += f" ({100 * (m / m0 - 1):+.1f} ± {100 * np.hypot(e, e0) / m0:.1f} %)"
        print(f"| `{name}` | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
