"""A filter cake measured from positions: there is no surface that would bound a layer, so heights are those of the solids."""
import h5py
import numpy as np
from scipy.ndimage import label, uniform_filter, uniform_filter1d

CAKE = 0.3        # solids above which there is cake: half of what a settled bed has


def slice_volume(low, high, centre, radius):
    """Volume of spheres between two heights: pi int (a^2 - (z - c)^2) dz."""
    b, t = (np.clip(z - centre, -radius, radius) for z in (low, high))
    return np.pi * (radius**2 * (t - b) - (t**3 - b**3) / 3)


class Cake:
    """One run; lengths in um, times in s. before: frames of the last two fifths of the strong flow; after: of the last fifth of the run."""

    def __init__(self, study, case):
        self.case = case
        parts = case.split("-")
        self.size, self.flow, self.temperature, self.drag = parts[0], float(parts[1][1:]), float(parts[2][1:]), parts[3]
        changed = parts[4:-1]           # the last part is the size of the study
        self.seed = next((int(c[1:]) for c in changed if c[1:].isdigit()), 1)
        self.extra = next((c for c in changed if not c[1:].isdigit()), "")
        with study.file(case, "trajectory") as f:
            layer = f["particles/layer"]
            self.position, self.time = 1e6 * layer["position/value"][:], layer["position/time"][:]
            self.radius, self.box = 1e6 * layer["radius"][:], 1e6 * layer["box/edges/value"][0]
            self.outcome = f["pigment"].attrs["outcome"]
            self.outcome = self.outcome.decode() if isinstance(self.outcome, bytes) else self.outcome
        with study.file(case, "dewatering") as f:
            time, flux = f["dewatering/time"][:], f["dewatering/absorption_flux"][:]
        self.turn = time[np.flatnonzero(flux == flux[0])[-1]]
        volume = self.radius**3
        self.share = volume / volume.sum()
        self.diameter = 2 * volume.sum() / (self.radius**2).sum()           # surface mean
        frames = np.arange(len(self.time))
        self.before = frames[(self.time > 0.6 * self.turn) & (self.time <= self.turn * (1 + 1e-9))]
        self.after = frames[self.time > self.time[-1] - 0.2 * (self.time[-1] - self.turn)]
        self.centre = self.position[:, :, 2] @ self.share                     # height of the mass centre against time

    def mean_centre(self, frames):
        """Mean and standard error from four blocks, or as many as there are frames."""
        blocks = np.array([b.mean() for b in np.array_split(self.centre[frames], min(4, len(frames)))])
        return blocks.mean(), blocks.std(ddof=1) / np.sqrt(len(blocks))

    def rise(self):
        """Of the mass centre from the cake to the end, over its height in the cake; and standard error."""
        (a, ea), (b, eb) = self.mean_centre(self.before), self.mean_centre(self.after)
        return b / a - 1, np.hypot(eb, ea) / a

    def profile(self, frames):
        """Heights and solids in slices of a fifth of the mean diameter, averaged over frames."""
        z = self.position[frames][:, :, 2]
        step = 0.2 * self.diameter
        edges = np.arange(0, z.max() + self.radius.max() + step, step)
        solids = np.zeros(len(edges) - 1)
        for k in range(len(z)):
            for s in range(len(solids)):
                near = np.abs(z[k] - edges[s]) < self.radius + step
                solids[s] += slice_volume(edges[s], edges[s + 1], z[k][near], self.radius[near]).sum()
        return (edges[1:] + edges[:-1]) / 2, solids / (len(z) * step * self.box[0] * self.box[1])

    def smooth(self, frames):
        """The profile averaged over a diameter: without the layers that a plane makes."""
        z, phi = self.profile(frames)
        return z, uniform_filter1d(phi, 5, mode="nearest")

    @staticmethod
    def last_above(z, phi, level):
        above = np.flatnonzero(phi > level)
        return z[above[-1]] if len(above) else 0.0

    def thickness(self, frames):
        return self.last_above(*self.smooth(frames), CAKE)

    def z95(self, frames):
        z, phi = self.profile(frames)
        return np.interp(0.95, np.cumsum(phi) / phi.sum(), z)

    def solids(self, frames):
        """In the cake, between half a diameter and its thickness less a diameter; NaN where there is none."""
        z, phi = self.profile(frames)
        use = (z > 0.5 * self.diameter) & (z < self.thickness(frames) - self.diameter)
        return phi[use].mean() if use.any() else np.nan

    def edge(self, frames):
        """Height over which solids fall from three quarters to one quarter of the cake's, in mean diameters."""
        z, phi = self.smooth(frames)
        top = np.max(phi)
        return (self.last_above(z, phi, 0.25 * top) - self.last_above(z, phi, 0.75 * top)) / self.diameter

    def local_height(self, frame):
        """Height of the cake at each point of a grid of an eighth of the mean diameter: where solids, averaged over a cube of
        one and a quarter diameters there, fall below the limit for the last time, in what hangs together with the bottom: spheres
        that float above are none of it."""
        step = self.diameter / 8
        count = [max(8, int(round(self.box[d] / step))) for d in (0, 1)]
        p, a = self.position[frame], self.radius
        axes = [(np.arange(n) + 0.5) * self.box[d] / n for d, n in enumerate(count)]
        z = np.arange(0.5 * step, min(p[:, 2].max() + a.max(), 3 * self.z95([frame])), step)
        full = np.zeros((*count, len(z)), bool)
        for (x0, y0, z0), r in zip(p, a):
            dx, dy = (self.wrap(axes[d] - c, self.box[d]) for d, c in ((0, x0), (1, y0)))
            i, j, k = (np.flatnonzero(np.abs(q) < r) for q in (dx, dy, z - z0))
            inside = dx[i, None, None]**2 + dy[None, j, None]**2 + (z[k] - z0)[None, None, :]**2 < r * r
            full[np.ix_(i, j, k)] |= inside
        around = uniform_filter(full.astype(float), 10, mode=("wrap", "wrap", "nearest")) > CAKE
        piece, _ = label(around)
        at_bottom = np.unique(piece[:, :, : max(1, int(self.diameter / step))])
        around &= np.isin(piece, at_bottom[at_bottom > 0])
        return np.where(around.any(axis=2), z[len(z) - 1 - np.argmax(around[:, :, ::-1], axis=2)], 0.0)

    @staticmethod
    def wrap(d, width):
        return d - width * np.round(d / width)
