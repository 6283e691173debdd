"""Beyond [sand2010]: where latex of 150 nm goes, by strategy, with and without Brownian motion."""
import re

import numpy as np

from layer import STUDENT, Sample, of_seeds
from study import Study

study = Study()


class Binder:
    """Latex over pigment (volumes) by height, 1 where it is as in the whole layer; it is larger in the outermost half micrometre from the packing
    on, as the centres of large particles cannot come as near. lead: mean height of the latex less that of the pigment, over the thickness, in
    time: no slice decides it."""

    def __init__(self, case):
        with study.file(case, "solids") as f:
            self.edges = f["solids/z_edges"][:]
            self.latex, self.pigment = (f[f"solids/species_{s}/volume_fraction"][:] for s in (1, 0))
        self.height = (self.edges[:, 1:] + self.edges[:, :-1]) / 2 / self.edges[:, -1:]
        self.whole = np.sum(self.latex, 1) / np.sum(self.pigment, 1)
        self.ratio = self.latex / np.maximum(self.pigment, 1e-9) / self.whole[:, None]
        parts = np.diff(self.edges, axis=1)
        mean_height = lambda phi: np.sum(parts * phi * self.height, 1) / np.sum(parts * phi, 1)     # noqa: E731
        self.lead = mean_height(self.latex) - mean_height(self.pigment)
        self.rise = float(self.lead[-1] - self.lead[0])


runs = {c: Binder(c) for c in study.cases}
size = re.search(r"-(\d+um)-", study.cases[0])[1]
strategies = list(dict.fromkeys(c.split("-")[0] for c in study.cases))
seeds = lambda d: [runs[c] for c in of_seeds(study.cases, f"{d}-{size}")]       # noqa: E731
rise = {d: Sample(100 * r.rise for r in seeds(d)) for d in strategies}
s = Sample(100 * (a.rise - b.rise) for a, b in zip(seeds("hll"), seeds("llh")))
study.claim("4.2", "Binder migrates to the top under early strong drying (HLL) more than under late (LLH)", "not in the source, whose 250 nm particles stand for binder",
            "mean height of the latex less that of the pigment, change from start to end, % of the thickness: " + "; ".join(f"{d.upper()} {t.text(2)}" for d, t in rise.items()) + f"; HLL less LLH {s.text(2)}",
            f"HLL less LLH above 0, without Brownian motion ({STUDENT}); a measure chosen after two of the latex near the surface (the upper quarter, 0.5 to 2 um deep) had decided nothing in quick runs", s.above())
noisy = {d: runs[f"{d}-{size}-s1-b"] for d in strategies if f"{d}-{size}-s1-b" in runs}
deviation = {d: rise[d].error * np.sqrt(rise[d].n) if rise[d].n > 1 else np.inf for d in strategies}
study.claim("4.2", "Brownian motion of the latex changes where it goes", "not in the source",
            "the same change, % of the thickness: " + "; ".join(f"{d.upper()} {100 * r.rise:.2f} with, {100 * seeds(d)[0].rise:.2f} without, same packing; s.d. of packings {deviation[d]:.2f}" for d, r in noisy.items()),
            "in one strategy by more than three standard deviations of the packings", None if not noisy else bool(any(abs(100 * (r.rise - seeds(d)[0].rise)) > 3 * deviation[d] for d, r in noisy.items())),
            why="noise carries latex up as often as down, so that its mean height follows only where noise evens out what the flow has gathered; one packing with noise tells no less than what packings differ by")
figure, axes = study.figure("binder", f"Volume of latex (150 nm) over that of pigment by height, 1 where it is as in the whole layer: mean of {len(seeds(strategies[0]))} packings at the start and at the end (band: standard error), and one packing with Brownian motion", columns=len(strategies))
for axis, d in zip(axes, strategies):
    group = seeds(d)
    for k, label, colour in ((0, "start", "C7"), (-1, "end", "C0")):
        rows = np.array([r.ratio[k] for r in group])
        mean, error = rows.mean(axis=0), rows.std(axis=0) / np.sqrt(max(1, len(rows) - 1))
        axis.plot(mean, group[0].height[k], color=colour, label=label)
        axis.fill_betweenx(group[0].height[k], mean - error, mean + error, color=colour, alpha=0.2, lw=0)
    if d in noisy:
        axis.plot(noisy[d].ratio[-1], noisy[d].height[-1], "--", color="C1", label="end, with Brownian motion")
    axis.axvline(1, color="0.6", lw=0.5)
    axis.set(xlabel="latex over pigment, relative", ylabel="height over thickness", title=d.upper(), xlim=(0.5, 2), ylim=(0, 1))
axes[0].legend(loc="center right")
study.finish()
