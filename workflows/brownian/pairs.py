"""Gaps of the pairs that the runs of this study moved, beside what they should be."""
import h5py
import numpy as np

from equilibrium import RADIUS, pair_statistics

NOISES = {"fd": "fluctuation_dissipation", "undrifted": "the same, drift: false", "k_brown": "k_brown"}
TREATMENTS = {"averaged": "averaged along the step", "newton": "implicit, Newton's method", "implicit": "linearly implicit", "explicit": "explicit", "midpoint": "explicit midpoint"}


class Gaps:
    """Over the pairs of one run, its first sixth left out: mean, s.d. (m) and their standard errors, from independent pairs."""

    def __init__(self, file):
        with h5py.File(file, "r") as f:
            layer = f["particles/layer"]
            x, self.step = layer["position/value"][:], float(np.mean(f["observables/step_size/value"][1:]))
        g = np.linalg.norm(x[:, 1::2] - x[:, 0::2], axis=2) - 2 * RADIUS
        g = g[len(g) // 6:]
        self.mean, self.deviation = g.mean(), g.std()
        n = g.shape[1]
        self.mean_error = g.mean(axis=0).std(ddof=1) / np.sqrt(n)
        self.deviation_error = ((g - self.mean)**2).mean(axis=0).std(ddof=1) / np.sqrt(n) / (2 * self.deviation)


class Pairs:
    """results: the study's folder. runs: {(noise, treatment): {step in ms: Gaps}}; default, long, lean, coarse: Gaps; exact: {noise: (mean, s.d.)}."""

    def __init__(self, results):
        self.exact = pair_statistics(results / "interactions.csv")
        self.default, self.long, self.lean, self.coarse = (Gaps(results / f"pairs-{name}.h5") for name in ("default", "long", "lean", "coarse"))
        self.runs = {}
        for noise in NOISES:
            for treatment in TREATMENTS:
                found = {float(f.stem.split("-")[-1]): Gaps(f) for f in results.glob(f"pairs-{noise}-{treatment}-*.h5")}
                if found:
                    self.runs[noise, treatment] = dict(sorted(found.items()))
