"""Figures 29 to 34 of [sand2010] and the claims of its section 4.3."""
import re

import numpy as np

from layer import STUDENT, UM, Layer, Sample, both, draw_section, frame_of, of_seeds
from study import FROM_INPUT, Study

study = Study()
thin_name = re.sub(r"-s\d+", "", study.cases[0])
thick_name = next(re.sub(r"-s\d+", "", c) for c in study.cases if re.sub(r"-s\d+", "", c) != thin_name)
thick_tail = thick_name.removeprefix("hll-")
THIN, THICK = (re.search(r"\d+(?=um)", n)[0] for n in (thin_name, thick_name))


class Moves:
    """Displacements of the finest class over the one interval of a case, by height band: equal quarters, then the surface band."""

    def __init__(self, case):
        self.case = case
        with study.file(case, "mobility") as f:
            m = f["mobility"]
            g = m["size_class_0"]
            self.edges, self.time = m["edges"][:] / UM, float(m["time"][-1])
            self.absolute, self.vertical, self.lateral = (g[n][-1] * UM for n in ("absolute", "vertical", "lateral"))
            self.mean_absolute, self.mean_vertical = g["mean_absolute"][-1] / UM, g["mean_vertical"][-1] / UM
            self.rms_vertical, self.rms_lateral = g["rms_vertical"][-1] / UM, g["rms_lateral"][-1] / UM
            # About its mean, which the imposed fall of the surface carries along.
            self.deviation = np.sqrt(np.maximum(self.rms_vertical**2 - self.mean_vertical**2, 0))


moves = {c: Moves(c) for c in study.cases}
layers = {c: Layer(study, c) for c in study.cases}
thin = [moves[c] for c in of_seeds(study.cases, thin_name)]
thick = {d: [moves[c] for c in of_seeds(study.cases, f"{d}-{thick_tail}")] for d in ("hll", "llh", "abs", "eva")}
SURFACE = 4
pairs = lambda a, b, what: Sample(what(x) - what(y) for x, y in zip(thick[a], thick[b]))   # noqa: E731



def spreads(m, time, low, high, below_surface=False):
    """Of fine particles that start so far from the substrate, or below the surface: root mean squares of one lateral component, of the vertical
    displacement, and of the latter about the fall at the particle's own height (a straight line in the height at the start). um"""
    (begin, radius, box), _ = frame_of(study, m.case, 0)
    (end, _, _), _ = frame_of(study, m.case, time)
    away = box[2] - begin[:, 2] if below_surface else begin[:, 2]
    chosen = (2 * radius <= FINE) & (away >= low) & (away < high)
    x, y, z = ((end - begin)[chosen] / UM).T
    height = begin[chosen, 2]
    return np.array([np.sqrt(np.mean(x**2 + y**2) / 2), np.sqrt(np.mean(z**2)), np.std(z - np.polyval(np.polyfit(height, z, 1), height))])


FINE = 0.3 * UM     # diameter of the finest class
THIN_TIME, THICK_TIME, LATE = 0.05, 0.2, 0.34
relative = lambda m, band: m.deviation[band] / abs(m.mean_vertical[band])                  # noqa: E731
s = Sample(relative(m, 1) - relative(m, 3) for m in thin)
study.claim("4.3", "A sharp peak of high displacement at the surface", "Fig. 30, HLL, 10 um, 0.05 s",
            f"vertical displacement of the top quarter {Sample(abs(m.mean_vertical[3]) for m in thin).text(2)} um, its s.d. over it {Sample(relative(m, 3) for m in thin).text(2)}; "
            f"second quarter from below {Sample(abs(m.mean_vertical[1]) for m in thin).text(2)} um and {Sample(relative(m, 1) for m in thin).text(2)}",
            f"relative width narrower, mean larger than in the second quarter ({STUDENT})", both(s.above(), Sample(abs(m.mean_vertical[3]) - abs(m.mean_vertical[1]) for m in thin).above()))
s = Sample(np.min(m.mean_absolute[1:4]) - m.mean_absolute[0] for m in thin)
study.claim("4.3", "Shorter displacements at the substrate", "Fig. 30", "; ".join(Sample(m.mean_absolute[b] for m in thin).text(2) for b in range(4)) + " um, quarters from the substrate up",
            f"mean displacement of the lowest quarter below every other ({STUDENT})", s.above())
quarter = np.mean([spreads(m, THIN_TIME, 0, frame_of(study, m.case, 0)[0][2][2] / 4) for m in thin], axis=0)
compressed = lambda values: f"the band is compressed, its top falls farther than its bottom; about the fall at their own height vertical {values[2]:.3f} um, lateral {values[0]:.3f}"     # noqa: E731
s = Sample(m.rms_lateral[0] - m.deviation[0] for m in thin)
raw = Sample(m.rms_lateral[0] - m.rms_vertical[0] for m in thin)
study.claim("4.3", "Lateral displacement dominates over vertical at the substrate", "Fig. 31, HLL, 10 um",
            f"lateral {Sample(m.rms_lateral[0] for m in thin).text(3)} um, vertical {Sample(m.rms_vertical[0] for m in thin).text(3)} um, about its mean {Sample(m.deviation[0] for m in thin).text(3)} um "
            f"(root mean squares of one component)", f"lateral above vertical with its mean, in the lowest quarter ({STUDENT})", raw.above(), why=compressed(quarter) + "; next to the substrate: the next row")
touching = [spreads(m, THIN_TIME, 0, FINE) for m in thin]
study.claim("4.3", "The same for the particles next to the substrate", "Fig. 31: at the boundary of substrate and filter cake",
            f"lateral {Sample(t[0] for t in touching).text(3)} um, vertical {Sample(t[1] for t in touching).text(3)} um", f"likewise, of those whose centres start within one diameter, {FINE / UM:g} um ({STUDENT})",
            Sample(t[0] - t[1] for t in touching).above())
study.claim("4.3", "Vertical motion at the substrate is pinned: about its mean it is smaller than the lateral", "text with Fig. 31", f"lateral less vertical about its mean: {s.text(3)} um",
            f"above 0 in the lowest quarter ({STUDENT})", s.above(), why=compressed(quarter))
s = Sample(m.rms_lateral[SURFACE] - m.deviation[SURFACE] for m in thick["hll"])
study.claim("4.3", "Lateral displacement dominates under a skin too, the layer's fall apart", "text with Fig. 32, HLL, 25 um, 0.2 s",
            f"0.5 to 2 um below the surface: lateral {Sample(m.rms_lateral[SURFACE] for m in thick['hll']).text(3)} um, vertical about its mean {Sample(m.deviation[SURFACE] for m in thick['hll']).text(3)} um, "
            f"mean {Sample(m.mean_vertical[SURFACE] for m in thick['hll']).text(2)} um", f"lateral above vertical about its mean ({STUDENT})", s.above(),
            why=compressed(np.mean([spreads(m, THICK_TIME, 0.5 * UM, 2 * UM, True) for m in thick["hll"]], axis=0)))


def top(m, time=THICK_TIME):
    run = layers[m.case]
    return run.bands(run.frame(time))[2]


def start(m):
    return layers[m.case].bands(0)[2]


def mean_solids(m, time=THICK_TIME):
    run = layers[m.case]
    return run.mean_wt[run.frame(time)]


s = Sample((top(a) - start(a)) - (top(b) - start(b)) for a, b in zip(thick["hll"], thick["llh"]))
study.claim("4.3", "The top has 82 wt-% under HLL against 68 under LLH after 0.2 s", "Fig. 32, text",
            f"{Sample(map(top, thick['hll'])).text()} against {Sample(map(top, thick['llh'])).text()} wt-% (at the start {Sample(map(start, thick['hll'])).text()}); difference {s.text()}",
            f"0.5 to 2 um below the surface, less the packing's own: difference within 14 ± 5 wt-% ({STUDENT}); the mean solids of the two layers differ by what the scene imposes",
            both(s.above(9), s.below(19)),
            why="the source prints no rates, and its layer under LLH is hardly drier at 0.2 s than it was applied; here the whole layer has "
                f"{Sample(mean_solids(m) for m in thick['llh']).mean:.0f} wt-% by then, against {Sample(mean_solids(m) for m in thick['hll']).mean:.0f} under HLL")


def without_noise(*strategies):
    """What the first packings do without Brownian motion, where the study has such runs beside those with it."""
    still = [moves[case] for d in strategies if (case := thick[d][0].case.removesuffix("-b")) in moves and thick[d][0].case != case]
    if len(still) < len(strategies):
        return ""
    return ("Brownian motion carries particles sideways where the layer stays wet, under LLH longest; without it, one packing: "
            + ", ".join(f"{d.upper()} {m.rms_lateral[SURFACE]:.3f}" for d, m in zip(strategies, still)) + " um")


s = pairs("hll", "llh", lambda m: m.rms_lateral[SURFACE])
study.claim("4.3", "Lateral mobility near the surface is significantly higher under HLL than under LLH", "Fig. 32",
            "; ".join(f"{d.upper()} {Sample(m.rms_lateral[SURFACE] for m in thick[d]).text(3)} um" for d in ("hll", "llh")), f"root mean square, 0.5 to 2 um below the surface ({STUDENT})", s.above(),
            why=without_noise("hll", "llh"))
s = pairs("abs", "eva", lambda m: m.rms_lateral[SURFACE])
study.claim("4.3", "Lateral mobility near the surface is higher under ABS than under EVA", "Fig. 34",
            "; ".join(f"{d.upper()} {Sample(m.rms_lateral[SURFACE] for m in thick[d]).text(3)} um" for d in ("abs", "eva")), f"likewise ({STUDENT})", s.above(),
            why=f"under ABS the cake has not reached the surface by {THICK_TIME:g} s, where the solids are {Sample(map(top, thick['abs'])).mean:.0f} wt-%, against {Sample(map(top, thick['eva'])).mean:.0f} under EVA; the next row")
sideways = {d: [spreads(m, LATE, 0.5 * UM, 2 * UM, True)[0] for m in thick[d]] for d in ("abs", "eva")}
study.claim("4.3", "The same when the cake has reached the surface", "not the time of the source, whose rates are not printed", f"{LATE:g} s: " + "; ".join(f"{d.upper()} {Sample(v).text(3)} um, solids {Sample(top(m, LATE) for m in thick[d]).mean:.0f} wt-%" for d, v in sideways.items()),
            f"likewise ({STUDENT})", Sample(np.subtract(sideways["abs"], sideways["eva"])).above(),
            why=f"at equal solids the two differ by less than packings do, of which there are {len(thick['abs'])}")
s = pairs("abs", "eva", lambda m: abs(m.mean_vertical[SURFACE]))
falls = {d: layers[thick[d][0].case].thickness[0] - layers[thick[d][0].case].thickness[layers[thick[d][0].case].frame(0.2)] for d in ("abs", "eva")}
imposed = falls["abs"] > falls["eva"]
study.claim("4.3", "Vertical mobility near the surface is higher under ABS than under EVA", "Fig. 34",
            "; ".join(f"{d.upper()} {Sample(abs(m.mean_vertical[SURFACE]) for m in thick[d]).text(2)} um, the surface falls by {falls[d] / UM:.2f} um" for d in ("abs", "eva")),
            f"mean ({STUDENT}); where the imposed fall is in the same order it is no finding", FROM_INPUT if s.above() and imposed else s.above())
noisy = [c for c in study.cases if c.endswith("-b") and c.removesuffix("-b") in moves]
if noisy:
    study.claim("4.3", "Brownian motion carries particles of 250 to 300 nm about as far as the rest does", "not in the source, whose runs all have it",
                "; ".join(f"{c}: lateral {moves[c].rms_lateral[SURFACE]:.3f} um with, {moves[c.removesuffix('-b')].rms_lateral[SURFACE]:.3f} um without" for c in noisy),
                "0.5 to 2 um below the surface, root mean square: more with noise in both", all(moves[c].rms_lateral[SURFACE] > moves[c.removesuffix("-b")].rms_lateral[SURFACE] for c in noisy))

# ---- figures
shown = (noisy or study.cases[len(thin):])[0]
state, k = frame_of(study, shown, 0.2)
with study.file(shown, "mobility") as f:
    speed = f["mobility/global_speed"][:] / UM
figure, axis = study.figure("fig29-velocity", f"Section 1 um thick of {shown} after 0.2 s, coloured by mean speed since the start (Fig. 29)", height=110)
figure.colorbar(draw_section(axis, state, speed, 0, np.percentile(speed, 99)), ax=axis, label="speed (µm/s)", shrink=0.6)
axis.set(xlabel="x (µm)", ylabel="height (µm)")


def mean_of(runs, what, bins=40, end=None):
    """Mean of several seeds' distributions on one grid, by way of their cumulative ones."""
    grid = np.linspace(0, end or max(m.edges[-1] for m in runs), bins + 1)
    below = np.mean([np.interp(grid, m.edges, np.concatenate([[0], np.cumsum(what(m) * np.diff(m.edges))])) for m in runs], axis=0)
    return (grid[1:] + grid[:-1]) / 2, np.diff(below) / np.diff(grid)


figure, axis = study.figure("fig30-displacement-by-height", f"Displacement of particles of 250 to 300 nm by height at the start, HLL, {THIN} um, 0.05 s (Fig. 30)")
for b, name in enumerate(("lowest quarter", "second", "third", "highest")):
    axis.plot(*mean_of(thin, lambda m: m.absolute[b]), label=name)
axis.set(xlabel="displacement (µm)", ylabel="density (1/µm)", xlim=(0, None), ylim=(0, None))
axis.legend()


def directions(axes, groups):
    """Left the vertical displacement, which the surface's fall carries along, right the lateral one, to the 99th percentile."""
    widest = max(m.edges[min(np.searchsorted(np.cumsum(m.lateral[band] * np.diff(m.edges)), 0.99) + 1, len(m.edges) - 1)] for _, runs, band in groups for m in runs)
    for label, runs, band in groups:
        axes[0].plot(*mean_of(runs, lambda m: m.vertical[band]), label=label)
        axes[1].plot(*mean_of(runs, lambda m: m.lateral[band], 25, widest), label=label)
    for axis, name in zip(axes, ("vertical", "lateral")):
        axis.set(xlabel=f"size of the {name} displacement (µm)", ylabel="density (1/µm)", xlim=(0, None), ylim=(0, None))
    axes[0].legend()


figure, axes = study.figure("fig31-directions", f"Vertical and lateral displacement of particles of 250 to 300 nm, HLL, {THIN} um, 0.05 s (Fig. 31)", columns=2)
directions(axes, [("lowest quarter", thin, 0), ("highest quarter", thin, 3)])
for name, pair, number in (("fig32-top-hll-llh", ("hll", "llh"), 32), ("fig34-top-abs-eva", ("abs", "eva"), 34)):
    figure, axes = study.figure(name, f"Vertical and lateral displacement of particles of 250 to 300 nm that start 0.5 to 2 um below the surface, {THICK} um, 0.2 s (Fig. {number})", columns=2)
    directions(axes, [(d.upper(), thick[d], SURFACE) for d in pair])

figure, axes = study.figure("trajectories", f"Paths of single fine particles that start at several heights, {THICK} um, to 0.2 s: sideways and downwards", columns=2)
for axis, d in zip(axes, ("hll", "llh")):
    with study.file(thick[d][0].case, "mobility") as f:
        t = f["mobility/trajectory"]
        position, thickness, time = t["position"][:] / UM, t["thickness"][:] / UM, t["time"][:]
    axis.plot(time, thickness, color="0.3", lw=0.8)
    for i in range(position.shape[1]):
        axis.plot(time, position[:, i, 2], color=f"C{i}")
        axis.plot(time, position[0, i, 2] + position[:, i, 0] - position[0, i, 0], ":", color=f"C{i}")
    axis.set(xlabel="time (s)", ylabel="height; dots: sideways (µm)", title=d.upper())
    axis.locator_params(axis="x", nbins=5)
study.finish()
