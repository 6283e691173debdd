"""How far two runs of one layer are apart, in what one measures in a layer: MEASURES. For the studies that hold runs against a converged one.

A case needs its trajectory and its solids. Single paths are chaotic, so that two runs agree in them only for a while."""
import numpy as np
from scipy.spatial import cKDTree

NEAR = 50e-9       # m: separations that count
CLUSTERED = 20e-9  # m: a particle with a neighbour nearer than this is clustered
GRID = np.linspace(0, NEAR, 501)
# What differences() returns, how a figure calls it, and how much of it is close enough.
MEASURES = (("profile_l1", "solids profile, L1", 0.01), ("separation_ks", "separations < 50 nm, KS", 0.02), ("clustered", "clustered fraction at 20 nm", 0.01),
            ("pressure", "surface pressure (relative)", 0.05))


def near_gaps(position, radius, edges):
    """Surface separations below NEAR of all pairs, with the pairs. Periodic in x and y."""
    position = position.copy()
    position[:, :2] %= edges[:2]
    position[:, 2] -= min(0.0, position[:, 2].min())
    box = np.array([edges[0], edges[1], 10 * (np.ptp(position[:, 2]) + edges[2])])
    pairs = []
    # By size: a pair counts where the larger of the two looks, with a reach of its own. Trees of octaves keep that short.
    octave = np.floor(np.log2(radius / radius.min())).astype(int)
    for high in np.unique(octave):
        mine = np.flatnonzero(octave == high)
        for low in np.unique(octave[octave <= high]):
            others = np.flatnonzero(octave == low)
            reach = radius[mine].max() + radius[others].max() + NEAR
            a, b = cKDTree(position[mine], boxsize=box), cKDTree(position[others], boxsize=box)
            found = a.sparse_distance_matrix(b, reach, output_type="coo_matrix")
            i, j = mine[found.row], others[found.col]
            gap = found.data - radius[i] - radius[j]
            keep = (gap < NEAR) & (i != j) & ((low != high) | (i < j))
            pairs.append(np.c_[i[keep], j[keep], gap[keep]])
    return np.concatenate(pairs)


def state(study, case, at=None):
    """A run's layer in its last frame, or in the one nearest to the time `at` (s); its pressure is the mean of the four frames up to there."""
    with study.file(case, "trajectory") as t, study.file(case, "solids") as s:
        layer, observables = t["particles/layer"], t["observables"]
        time, radius = layer["position/time"][:], layer["radius"][:]
        frame = len(time) - 1 if at is None else int(np.argmin(np.abs(time - at)))
        pairs = near_gaps(layer["position/value"][frame], radius, np.asarray(layer["box/edges/value"][frame]))
        close = pairs[pairs[:, 2] < CLUSTERED, :2].astype(int)
        return {"end": time[frame], "steps": int(layer["position/step"][frame]), "iterations": float(observables["solver_iterations/value"][1:frame + 1].mean()),
                "profile": s["solids/volume_fraction"][frame], "gaps": np.sort(pairs[:, 2]), "clustered": len(np.unique(close)) / len(radius),
                "pressure": observables["surface_pressure/value"][max(0, frame - 3):frame + 1].mean()}


def mean_state(states):
    """Of runs of several packings of one layer: what single paths have by chance goes out of it."""
    states = list(states)
    mean = lambda key: np.mean([s[key] for s in states], axis=0)    # noqa: E731
    return {"profile": mean("profile"), "gaps": np.sort(np.concatenate([s["gaps"] for s in states])), "clustered": mean("clustered"), "pressure": mean("pressure")}


def share(gaps):
    return np.searchsorted(gaps, GRID) / max(1, len(gaps))


def differences(one, other):
    """Of one state to the other, by MEASURES: L1 and pressure are relative to the other."""
    return {"profile_l1": np.abs(one["profile"] - other["profile"]).sum() / other["profile"].sum(),
            "separation_ks": np.abs(share(one["gaps"]) - share(other["gaps"])).max(), "clustered": abs(one["clustered"] - other["clustered"]),
            "pressure": abs(one["pressure"] / other["pressure"] - 1)}
