"""What the claims.py of the studies of coating layers share: a run's profiles by height, means over seeds and their errors."""
import re

import numpy as np
from scipy.stats import t as student

UM = 1e-6
NEAR, FAR = 0.5 * UM, 2 * UM   # depths of the bands at the surface and at the substrate; a packing is looser in the outermost 0.5 um


class Layer:
    """One run. Times in s, lengths in m, solids in wt-%. A run that has come to rest stays as it is from then on."""

    def __init__(self, study, case):
        self.case = case
        with study.file(case, "solids") as f:
            s = f["solids"]
            self.time, self.edges = s["time"][:], s["z_edges"][:]
            self.phi, self.wt, self.thickness = s["volume_fraction"][:], 100 * s["mass_fraction"][:], s["thickness"][:]
            self.mean_wt, self.mass_centre = 100 * s["mean_mass_fraction"][:], s["mass_centre"][:]
            self.z95, self.z99, self.top_envelope = s["z95"][:], s["z99"][:], s["top_envelope"][:]
            self.protruding, self.cumulative_wt = s["protruding_fraction"][:], 100 * s["cumulative_mass_fraction"][:]
            fine = s["size_class_0"]
            self.fine_phi, self.fine_number, self.fine_share = fine["volume_fraction"][:], fine["number"][:], fine["share"][:]
            self.rest = float(s.attrs["immobilisation_time"]) if "immobilisation_time" in s.attrs else None
        # Density of the solids over that of the liquid, from the two fractions of the whole layer.
        phi, w = np.sum(self.phi[0] * np.diff(self.edges[0])) / self.thickness[0], self.mean_wt[0] / 100
        self.density = w * (1 - phi) / (phi * (1 - w))

    def frame(self, time):
        return int(np.argmin(np.abs(self.time - min(time, self.time[-1]))))

    def _mean(self, k, values, low, high):
        """Mean of a density given by slices over heights from low to high."""
        edges = self.edges[k]
        inside = np.clip(np.minimum(edges[1:], high) - np.maximum(edges[:-1], low), 0, None)
        return np.sum(inside * values) / np.sum(inside)

    def _bands(self, k, values):
        """Means at the substrate, in the middle two fifths, at the surface."""
        h = self.thickness[k]
        return np.array([self._mean(k, values, NEAR, FAR), self._mean(k, values, 0.3 * h, 0.7 * h), self._mean(k, values, h - FAR, h - NEAR)])

    def bands(self, k):
        phi = self._bands(k, self.phi[k])
        return 100 * phi * self.density / (phi * self.density + 1 - phi)

    def cake(self, k):
        """Solids at the substrate over those in the middle, wt-%, less what the packing had."""
        return self._over(k, 0)

    def skin(self, k):
        return self._over(k, 2)

    def _over(self, k, band):
        now, start = self.bands(k), self.bands(0)
        return now[band] - now[1] - (start[band] - start[1])

    def spread(self, k):
        """Standard deviation of the profile by height between the outermost micrometres, wt-%."""
        middle = (self.edges[k][1:] + self.edges[k][:-1]) / 2
        inner = (middle > UM) & (middle < self.thickness[k] - UM)
        return float(np.std(self.wt[k][inner]))

    def fine_density(self, k):
        """Finest class, particles a height: in each band over the middle, less the same at the start."""
        now, start = (self._bands(j, self.fine_number[j] / np.diff(self.edges[j])) for j in (k, 0))
        return now / now[1] - start / start[1]

    def fine_solids(self, k):
        """Finest class, its share of the solid volume in each band, over that share in the bands at the start."""
        now, start = (self._bands(j, self.fine_phi[j]) / self._bands(j, self.phi[j]) for j in (k, 0))
        return now / start

    def over_time(self, what):
        return np.array([what(k) for k in range(len(self.time))])


def of_seeds(cases, name):
    """Those of the cases whose name without its seed is this."""
    return [c for c in cases if re.sub(r"-s\d+", "", c) == name]


class Sample:
    """A figure of several seeds: mean, standard error, and Student's test (95 %, one-sided) of its sign."""

    def __init__(self, values):
        self.values = np.asarray(list(values), float)
        self.n, self.mean = len(self.values), float(np.mean(self.values))
        self.error = float(np.std(self.values, ddof=1) / np.sqrt(self.n)) if self.n > 1 else np.inf
        self.margin = float(student.ppf(0.95, self.n - 1) * self.error) if self.n > 1 else np.inf

    def above(self, limit=0.0):
        """True or False where the seeds decide it, None where they do not."""
        return True if self.mean - self.margin > limit else False if self.mean + self.margin < limit else None

    def below(self, limit):
        above = self.above(limit)
        return None if above is None else not above

    def text(self, digits=1):
        return f"{self.mean:.{digits}f}" + (f" ± {self.error:.{digits}f}" if self.n > 1 else "")

    def percent(self, digits=2):
        return f"{100 * self.mean:+.{digits}f}" + (f" ± {100 * self.error:.{digits}f}" if self.n > 1 else "") + " %"


def both(*verdicts):
    """All hold: True; one does not: False; else None."""
    return False if any(v is False for v in verdicts) else None if any(v is None for v in verdicts) else True


STUDENT = "Student's test over seeds with the same packings, 95 %, one-sided"


def draw_section(axis, run, values, low=None, high=None, colours="viridis", thick=1.0 * UM):
    """Cut through the layer of a frame, from (position [N, 3], radius, box [3]): circles of the spheres that the middle plane in
    y meets, or lie within `thick` of it, wrapped into the box. values: one a particle, NaN is grey."""
    import matplotlib.pyplot as plt
    from matplotlib.collections import EllipseCollection
    position, radius, box = run
    x, y = position[:, 0] % box[0], position[:, 1] % box[1]
    near = np.flatnonzero(np.abs(y - box[1] / 2) < thick / 2)
    near = near[np.argsort(-np.abs(y[near] - box[1] / 2), kind="stable")]      # the nearest to the plane last, on top
    shown = values[near]
    map_ = plt.get_cmap(colours)
    scale = plt.Normalize(np.nanmin(values) if low is None else low, np.nanmax(values) if high is None else high)
    face = np.where(np.isnan(shown)[:, None], (0.85, 0.85, 0.85, 1), map_(scale(np.nan_to_num(shown))))
    d = 2 * radius[near] / UM
    axis.add_collection(EllipseCollection(d, d, np.zeros(len(d)), units="xy", offsets=np.column_stack([x[near], position[near, 2]]) / UM,
                                          offset_transform=axis.transData, facecolors=face, edgecolors="0.25", linewidths=0.2, rasterized=True))     # thousands of circles: megabytes as lines
    axis.set(xlim=(0, box[0] / UM), ylim=(0, 1.02 * box[2] / UM), aspect="equal")
    axis.axhline(box[2] / UM, color="0.3", lw=0.6)
    return plt.cm.ScalarMappable(scale, map_)


def frame_of(study, case, time):
    """(position, radius, box) of the frame nearest to the time, the last one where the run ended before; and its number."""
    with study.file(case, "trajectory") as f:
        layer = f["particles/layer"]
        times = layer["position/time"][:]
        k = int(np.argmin(np.abs(times - min(time, times[-1]))))
        return (layer["position/value"][k], layer["radius"][:], layer["box/edges/value"][k]), k
