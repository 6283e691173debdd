"""Figures 40 and 43 to 46 of [sand2010] and the claims of its section 4.5."""
import re

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.patches import Patch
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import dijkstra

from layer import FAR, STUDENT, UM, Sample, both, draw_section, frame_of, of_seeds
from study import Study

study = Study()
noise = "-b" if study.cases[0].endswith("-b") else ""
layer = re.match(r"llh-(\d+um-w.*?)(?=-k)", study.cases[0])[1]


class Clusters:
    def __init__(self, case):
        self.case = case
        with study.file(case, "cluster") as f:
            c = f["cluster"]
            self.time, self.size, self.fraction = c["time"][:], c["size"][:], c["clustered_fraction"][:]
            self.largest, self.id = c["largest_fraction"][:], c["id"][:]
            self.begin, self.first, self.second = (c[f"connection/{n}"][:] for n in ("begin", "first", "second"))
            self.gap, self.threshold = c["connection/separation"][:], float(c.attrs["threshold"])

    def at(self, time):
        return int(np.argmin(np.abs(self.time - min(time, self.time[-1]))))

    def by_band(self, time):
        """Clustered share of the particles: within 2 um of the substrate, in the middle two fifths, within 2 um of the surface."""
        k = self.at(time)
        (position, _, box), _ = frame_of(study, self.case, self.time[k])
        z, h, clustered = position[:, 2], box[2], self.size[k] > 1
        return np.array([np.mean(clustered[m]) if m.any() else 0 for m in (z < FAR, (z > 0.3 * h) & (z < 0.7 * h), z > h - FAR)])

    def touching(self, k, gap=1e-9):
        """Share of the particles with another nearer than this: between the primary minimum (0.3 nm) and the packing's smallest gap (2 nm)."""
        first, second, separation = self.connections(k)
        return len(np.unique(np.concatenate([first[separation < gap], second[separation < gap]]))) / self.size.shape[1]

    def half(self):
        """Frame after the first at which half of all are clustered, as near as there is."""
        return 1 + int(np.argmin(np.abs(self.fraction[1:] - 0.5)))

    def connections(self, k):
        part = slice(self.begin[k], self.begin[k + 1])
        return self.first[part], self.second[part], self.gap[part]


runs = {case: Clusters(case) for case in study.cases}
seeds = lambda d, settings: [runs[c] for c in of_seeds(study.cases, f"{d}-{layer}-{settings}{noise}")]    # noqa: E731

PLACES = ("at the substrate", "in the middle", "at the surface")


def mean_solids(case, time):
    with study.file(case, "solids") as f:
        t = f["solids/time"][:]
        return 100 * f["solids/mean_mass_fraction"][int(np.argmin(np.abs(t - time)))]


charged, bare = seeds("hll", "k10-p50"), seeds("hll", "k10-p0")
bands = np.mean([r.by_band(0.2) for r in charged], axis=0)
s = [Sample(r.by_band(0.2)[b] - 2 * r.by_band(0.2)[1] for r in charged) for b in (0, 2)]
study.claim("4.5", "At 50 mV particles cluster in the cake and in the skin only", "Fig. 40, HLL, 0.2 s, threshold 50 nm",
            f"clustered: {100 * bands[0]:.0f} % at the substrate, {100 * bands[1]:.0f} % in the middle, {100 * bands[2]:.0f} % at the surface",
            f"more than twice the share of the middle two fifths within 2 um of the substrate and of the surface ({STUDENT})", both(*(x.above() for x in s)),
            why=f"with the rates chosen the layer has {np.mean([mean_solids(r.case, 0.2) for r in charged]):.0f} wt-% at 0.2 s, where all gaps are short; earlier: the next row")
early = [r.by_band(r.time[r.half()]) for r in charged]
s = [Sample(e[b] - 2 * e[1] for e in early) for b in (0, 2)]
study.claim("4.5", "The same at 50 mV when half of all particles are clustered", "not in the source, whose rates are not printed: its layer is wetter at 0.2 s", f"{np.mean([r.time[r.half()] for r in charged]):.3f} s: " +
            "; ".join(f"{100 * m:.0f} % {where}" for m, where in zip(np.mean(early, axis=0), PLACES)), f"likewise ({STUDENT})", both(*(x.above() for x in s)),
            why="the skin clusters, the cake does not: at 50 mV and 10 nm repulsion spreads it; at 25 mV and 2.5 nm both do (20 nm): "
                + ", ".join(f"{100 * m:.0f} % {where}" for m, where in zip(np.mean([r.by_band(r.time[r.half()]) for r in seeds("hll", "k2.5-p25")], axis=0), PLACES)))
low = {p: seeds("llh", f"k5-p{p}") for p in (50, 0)}
at = lambda group, t: Sample(100 * r.fraction[r.at(t)] for r in group)    # noqa: E731
s = at(low[50], 0.4)
study.claim("4.5", "Under LLH the layer is fully clustered at around 0.4 s (50 mV)", "Fig. 44, threshold 50 nm", f"clustered {at(low[50], 0.1).text()} % at 0.1 s, {at(low[50], 0.2).text()} at 0.2, {at(low[50], 0.3).text()} at 0.3, {s.text()} at {min(0.4, low[50][0].time[-1]):.2g}",
            f"over 95 % of the particles at 0.4 s (or the last frame before), and not yet at 0.2 s ({STUDENT})", both(s.above(95), at(low[50], 0.2).below(95)))
EARLY = 0.05
touch = lambda group, t: Sample(100 * r.touching(r.at(t)) for r in group)    # noqa: E731
when = min(EARLY, *(r.time[-1] for r in low[0] + bare))     # quick runs end before
s, high_bare = touch(low[0], EARLY), touch(bare, EARLY)
least = min(*s.values, *high_bare.values)
n_particles = low[0][0].size.shape[1]
chance = 200 * np.sqrt(0.9 * 0.1 / n_particles)
study.claim("4.5", "At 0 mV the layer agglomerates at an early stage", "Figs. 40, 44",
            f"in contact at {when:g} s: LLH {s.text()} %, HLL {high_bare.text()} % of the particles ({s.n} and {high_bare.n} packings); at 50 mV {touch(low[50], when).text()} and {touch(charged, when).text()} %; none in the packing. "
            f"Clustered at 50 nm: {at(low[0], when).text()} and {at(bare, when).text()} %, but {at(low[0], 0).text()} % in the packing, so that this threshold decides nothing",
            f"over 90 % nearer than 1 nm to another by {EARLY:g} s in every packing of both strategies, beyond two standard deviations of counting {n_particles} particles; a run that ends before with fewer does not decide",
            True if least > 90 + chance else None if when < EARLY - 1e-3 or least > 90 - chance else False, why=f"at 0.01 s: LLH {touch(low[0], 0.01).text()}, HLL {touch(bare, 0.01).text()} %")
double = {k: seeds("llh", f"k{k}-p25") for k in ("2.5", "10")}


def unevenness(r):
    """Clustered at the substrate less in the middle, when half of all particles are."""
    b = r.by_band(r.time[r.half()])
    return 100 * (b[0] - b[1])


s = {k: Sample(unevenness(r) for r in group) for k, group in double.items()}
d = Sample(unevenness(a) - unevenness(b) for a, b in zip(double["2.5"], double["10"]))
study.claim("4.5", "Under LLH a thin double layer (2.5 nm) grows a cake, a thick one (10 nm) clusters evenly", "Fig. 45, threshold 20 nm",
            f"clustered at the substrate less in the middle: {s['2.5'].text()} % at 2.5 nm, {s['10'].text()} % at 10 nm, when half of all are clustered", f"larger at 2.5 nm ({STUDENT})", d.above())


def finger(r, time=0.2):
    """Of the cluster that holds most particles at the substrate: how far its highest top is above the height of the cake (where the
    clustered share of the particles falls below one half), over the thickness, and the fewest particles in a chain up to it. (path as places)"""
    k = r.at(time)
    (position, radius, box), _ = frame_of(study, r.case, r.time[k])
    z = position[:, 2]
    edges = np.arange(0, box[2], 0.5 * UM)
    share = [np.mean(r.size[k][(z >= a) & (z < a + 1 * UM)] > 1) if np.any((z >= a) & (z < a + 1 * UM)) else 0 for a in edges]
    cake = next((a for a, c in zip(edges[1:], share[1:]) if c < 0.5), box[2])
    low = (z - radius < r.threshold) & (r.size[k] > 1)
    if not low.any() or cake >= box[2]:
        return 0.0, 0, np.array([], int)
    held = np.isin(r.id[k], np.unique(r.id[k][low]))
    tip = int(np.argmax(np.where(held, z + radius, -np.inf)))
    first, second, gap = r.connections(k)
    graph = coo_matrix((np.ones(len(first)), (first, second)), shape=(len(z), len(z))).tocsr()
    source = np.flatnonzero(held & (z < cake))
    steps, before, _ = dijkstra(graph, directed=False, indices=source, unweighted=True, min_only=True, return_predecessors=True)
    path = [tip]
    while before[path[-1]] >= 0:
        path.append(before[path[-1]])
    return max(z[tip] + radius[tip] - cake, 0) / box[2], int(steps[tip]) if np.isfinite(steps[tip]) else 0, np.array(path)




def before_meeting(r):
    """Time of the last frame before a cluster reaches from the substrate to the surface; frame 0 is the packing."""
    for k in range(1, len(r.time)):
        (position, radius, box), _ = frame_of(study, r.case, r.time[k])
        held = r.size[k] > 1
        low, high = ((position[:, 2] - radius < r.threshold) & held), ((position[:, 2] + radius > box[2] - radius) & held)
        if np.intersect1d(r.id[k][low], r.id[k][high]).size:
            return r.time[max(1, k - 1)]
    return r.time[-1]


thinnest = seeds("hll", "k2.5-p25")
still = runs.get(f"hll-{layer}-k2.5-p25-s1") if noise else None


meetings = [before_meeting(r) for r in thinnest]


def why_no_fingers(times):
    met = np.mean(meetings)
    if np.mean(times) > met:
        return f"cake and skin have met by then, at {met:.2f} s, with the rates chosen; before: the next row"
    if not still:
        return ""
    height, particles, _ = finger(still, np.mean(times))
    return (f"Brownian motion, which tears chains of 20 nm apart, is a part of it: without, one packing, the highest reaches {height:.2f} of the thickness over {particles} particles; "
            "the rest was not traced")


for name, source, times in (("Fingers grow from the cake, over 5 to 6 particles and a third of the layer", "Fig. 46, HLL, 25 mV, 2.5 nm, 20 nm, 0.2 s", [0.2] * len(thinnest)),
                            ("The same before cake and skin meet", "not the time of the source, whose rates are not printed", meetings)):
    fingers = [finger(r, t) for r, t in zip(thinnest, times)]
    reach, chain = Sample(f[0] for f in fingers), Sample(f[1] for f in fingers)
    study.claim("4.5", name, source, f"{np.mean(times):.3f} s: the highest reaches {reach.text(2)} of the thickness above the cake, over {chain.text()} particles",
                f"means of {reach.n} packings within 1/3 ± 0.15 and 5.5 ± 1.5", bool(abs(reach.mean - 1 / 3) < 0.15 and abs(chain.mean - 5.5) < 1.5),
                why=why_no_fingers(times))


# ---- figures
def panels(name, caption, runs, colour, times):
    """Sections through the layers side by side, one a time; a run that has ended by a time is shown no more. runs: (title, run)."""
    shown = [(title, r, k) for title, r in runs for k in dict.fromkeys(r.at(t) for t in times if t < r.time[-1] + 0.01)]
    figure, axes = study.figure(name, caption, columns=len(shown), width=170 / max(6, len(shown)), height=95, sharey=True)
    highest = max(frame_of(study, r.case, 0)[0][2][2] for _, r in runs) / UM
    for axis, (title, r, k) in zip(axes, shown):
        state, _ = frame_of(study, r.case, r.time[k])
        values, low, high, colours = colour(r, k)
        picture = draw_section(axis, state, values, low, high, colours)
        axis.set(title=f"{title}\n{r.time[k]:.2g} s", xlabel="x (µm)", ylim=(0, 1.02 * highest))
        axis.locator_params(axis="x", nbins=3)
    axes[0].set_ylabel("height (µm)")
    if colour is by_size:
        bar = figure.colorbar(picture, ax=axes, label="particles in the cluster (grey: alone)", shrink=0.7, aspect=30)
        ticks = [n for n in (2, 10, 100, 1000, 10000) if n <= runs[0][1].size.shape[1]]
        bar.set_ticks(np.log10(ticks), labels=[f"{n}" for n in ticks])
    else:
        figure.legend(handles=[Patch(facecolor=plt.get_cmap("Greys")(shade), edgecolor="0.25", lw=0.3, label=label) for shade, label in ((DARK, "in a cluster"), (LIGHT, "alone"))],
                      loc="lower center", ncols=2)
        figure.get_layout_engine().set(rect=(0, 0.06, 1, 0.94))


def by_size(r, k):
    return np.where(r.size[k] > 1, np.log10(r.size[k]), np.nan), np.log10(2), np.log10(r.size.shape[1]), "turbo"


LIGHT, DARK = 0.15, 0.85


def dark(r, k):
    return np.where(r.size[k] > 1, DARK, LIGHT), 0, 1, "Greys"


note = "sections 1 um thick"
HLL_TIMES, LLH_TIMES = (0.05, 0.1, 0.2), (0.05, 0.1, 0.2, 0.4)
panels("fig40-clusters-hll", f"Clusters by size under HLL, 50 and 0 mV, 10 nm, threshold 50 nm, {note} (Fig. 40)", [("50 mV", charged[0]), ("0 mV", bare[0])], by_size, HLL_TIMES)
panels("fig43-double-layer-hll", f"Clustered and lone particles under HLL, 2.5 and 10 nm, 25 mV, threshold 20 nm, {note} (Fig. 43)",
       [("2.5 nm", seeds("hll", "k2.5-p25")[0]), ("10 nm", seeds("hll", "k10-p25")[0])], dark, HLL_TIMES)
panels("fig44-clusters-llh", f"Clusters by size under LLH, 50 and 0 mV, 5 nm, threshold 50 nm, {note} (Fig. 44)", [("50 mV", low[50][0]), ("0 mV", low[0][0])], by_size, LLH_TIMES)
panels("fig45-double-layer-llh", f"Clustered and lone particles under LLH, 2.5 and 10 nm, 25 mV, threshold 20 nm, {note} (Fig. 45)",
       [(f"{k} nm", double[k][0]) for k in ("2.5", "10")], dark, LLH_TIMES)

r = seeds("hll", "k2.5-p25")[0]
figure, axes = study.figure("fig46-fingers", "Connections of the clusters under HLL, 2.5 nm, 25 mV, threshold 20 nm, in projection: red near, blue far (Fig. 46). Black: the shortest chain from the cake to the highest particle it holds", columns=3, width=48, height=95, sharey=True)
nearest = 1e9 * np.percentile(r.connections(r.at(HLL_TIMES[-1]))[2], 2)
for axis, t in zip(axes, HLL_TIMES):
    k = r.at(t)
    (position, radius, box), _ = frame_of(study, r.case, r.time[k])
    first, second, gap = r.connections(k)
    x = position[:, 0] % box[0] / UM
    z = position[:, 2] / UM
    whole = np.abs(x[first] - x[second]) < box[0] / UM / 2       # not those across the border
    lines = LineCollection(np.stack([np.column_stack([x[first], z[first]]), np.column_stack([x[second], z[second]])], axis=1)[whole], array=1e9 * gap[whole], cmap="coolwarm_r", linewidths=0.6, rasterized=True,
                           norm=plt.Normalize(nearest, 1e9 * r.threshold))
    axis.add_collection(lines)
    path = finger(r, t)[2]
    axis.plot(x[path], z[path], ".", color="black", ms=4)
    axis.axhline(box[2] / UM, color="0.3", lw=0.6)
    axis.set(xlim=(0, box[0] / UM), ylim=(0, 1.02 * frame_of(study, r.case, 0)[0][2][2] / UM), aspect="equal", title=f"{r.time[k]:.2g} s", xlabel="x (µm)")
    axis.locator_params(axis="x", nbins=3)
axes[0].set_ylabel("height (µm)")
figure.colorbar(lines, ax=axes, label="surface separation (nm)", shrink=0.6, aspect=30)

figure, axes = study.figure("clustered", "Share of clustered particles in time: potentials (threshold 50 nm), double layers (threshold 20 nm)", columns=2)
for axis, groups in zip(axes, ([("HLL 50 mV", charged), ("HLL 0 mV", bare), ("LLH 50 mV", low[50]), ("LLH 0 mV", low[0])],
                               [(f"{d.upper()} {k} nm", seeds(d, f"k{k}-p25")) for d in ("hll", "llh") for k in ("2.5", "10")])):
    for i, (name, group) in enumerate(groups):
        for g in group:
            axis.plot(g.time, 100 * g.fraction, color=f"C{i}", lw=0.8, marker=".", markevery=[-1], label=name if g is group[0] else None)
    axis.set(xlabel="time (s)", ylabel="clustered particles (%)", ylim=(0, 103))
    axis.legend()
study.finish()
