"""Beyond [sand2010]: where latex of 150 nm goes, by strategy, with and without Brownian motion."""
import re

import numpy as np

from layer import STUDENT, UM, Sample, of_seeds
from study import Study

study = Study()


class Binder:
    def __init__(self, case):
        with study.file(case, "solids") as f:
            edges = f["solids/z_edges"][:]
            latex, pigment = (f[f"solids/species_{s}/volume_fraction"][:] for s in (1, 0))
        self.height = (edges[:, 1:] + edges[:, :-1]) / 2 / edges[:, -1:]
        # Latex over pigment, one where it is as in the whole layer.
        self.ratio = latex / np.maximum(pigment, 1e-9) / (np.sum(latex, 1) / np.sum(pigment, 1))[:, None]
        self.enrichment = [self._of(k, 0.75, 1) - self._of(0, 0.75, 1) for k in (-1,)][0]
        self.substrate = self._of(-1, 0, 0.25) - self._of(0, 0, 0.25)
        self.latex, self.pigment = latex, pigment

    def _of(self, k, low, high):
        inside = (self.height[k] > low) & (self.height[k] < high)
        return float(np.mean(self.ratio[k][inside]))


runs = {c: Binder(c) for c in study.cases}
size = re.search(r"-(\d+um)-", study.cases[0])[1]
strategies = list(dict.fromkeys(c.split("-")[0] for c in study.cases))
seeds = lambda d: [runs[c] for c in of_seeds(study.cases, f"{d}-{size}")]       # noqa: E731
top = {d: Sample(r.enrichment for r in seeds(d)) for d in strategies}
bottom = {d: Sample(r.substrate for r in seeds(d)) for d in strategies}
s = Sample(a.enrichment - b.enrichment for a, b in zip(seeds("hll"), seeds("llh")))
study.claim("4.2", "Binder migrates to the top under early strong drying (HLL) more than under late (LLH)", "not in the source, whose 250 nm particles stand for binder",
            "latex over pigment in the upper quarter at the end, change against the start: " + "; ".join(f"{d.upper()} {100 * t.mean:+.1f} ± {100 * t.error:.1f} %" for d, t in top.items())
            + "; in the lowest: " + "; ".join(f"{d.upper()} {100 * t.mean:+.1f} ± {100 * t.error:.1f} %" for d, t in bottom.items()), f"HLL less LLH above 0, without Brownian motion ({STUDENT})", s.above())
noisy = {d: runs[f"{d}-{size}-s1-b"] for d in strategies if f"{d}-{size}-s1-b" in runs}
deviation = {d: top[d].error * np.sqrt(top[d].n) if top[d].n > 1 else np.inf for d in strategies}
study.claim("4.2", "Brownian motion of the latex changes where it goes", "not in the source",
            "; ".join(f"{d.upper()} {100 * r.enrichment:+.1f} % with, {100 * seeds(d)[0].enrichment:+.1f} % without, same packing; s.d. of packings {100 * deviation[d]:.1f} %" for d, r in noisy.items()),
            "in one strategy by more than three standard deviations of the packings", None if not noisy else bool(any(abs(r.enrichment - seeds(d)[0].enrichment) > 3 * deviation[d] for d, r in noisy.items())))
figure, axes = study.figure("binder", "Latex of 150 nm over pigment by height, one where it is as in the whole layer: mean of the packings at the start and the end, and with Brownian motion", columns=len(strategies))
for axis, d in zip(axes, strategies):
    for k, label in ((0, "start"), (-1, "end")):
        axis.plot(np.mean([r.ratio[k] for r in seeds(d)], axis=0), seeds(d)[0].height[k], label=label)
    if d in noisy:
        axis.plot(noisy[d].ratio[-1], noisy[d].height[-1], "--", label="end, Brownian")
    axis.set(xlabel="latex over pigment (1)", ylabel="height over thickness", title=d.upper(), xlim=(0, 2), ylim=(0, 1))
axes[0].legend()
study.finish()
