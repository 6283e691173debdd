"""Figures 35 to 39, 41 and 42 of [sand2010] and the claims of its section 4.4."""
import re

import numpy as np

from layer import STUDENT, UM, Layer, Sample, both, of_seeds
from study import FROM_INPUT, Study

study = Study()
runs = {case: Layer(study, case) for case in study.cases}
noise = "-b" if study.cases[0].endswith("-b") else ""
layer = re.match(r"hll-\d+um-w.*?(?=-k)", study.cases[0])[0]
THICK = re.search(r"(\d+)um", layer)[1]
LOW, HIGH = (0, 5, 10), (25, 50)
TIMES = (0.05, 0.1, 0.2)
at = lambda run, t: run.frame(t)           # noqa: E731


def seeds(settings):
    return [runs[c] for c in of_seeds(study.cases, f"{layer}-{settings}{noise}")]


def one(settings, end=""):
    """The first packing's run, without Brownian motion where there is none with it; None: the study has neither."""
    names = (f"{layer}-{settings}-s1{motion}{end}" for motion in (noise, ""))
    return next((runs[name] for name in names if name in runs), None)


def of_potential(p):
    return seeds(f"k10-p{p}")


POTENTIALS = tuple(p for p in LOW + HIGH if of_potential(p))
# Uncharged layers are dear; a quick run has one packing of them, which joins no mean.
LOW = tuple(p for p in LOW if len(of_potential(p)) == len(of_potential(50)))
ALL = LOW + HIGH
reach = lambda p, t: all(r.time[-1] > t - 1e-3 for r in of_potential(p))     # noqa: E731
at_time = lambda t: [p for p in POTENTIALS if reach(p, t)]                   # noqa: E731
PACKINGS = range(len(of_potential(50)))
DEAR = "layers at 0 to 10 mV are for SIZE=full: every pair becomes a contact, which is dear"

# ---- surface potential
WITHIN = 0.01     # what we call a difference in thickness: "much thicker" in the source is several per cent of the layer
mean_um = lambda p, t=0.2, what="z99": Sample(getattr(r, what)[at(r, t)] / UM for r in of_potential(p))     # noqa: E731
if LOW:
    relative = [np.mean([of_potential(p)[i].z99[at(of_potential(p)[i], 0.2)] for p in LOW]) / np.mean([of_potential(p)[i].z99[at(of_potential(p)[i], 0.2)] for p in HIGH]) - 1
                for i in PACKINGS]
    s = Sample(relative)
    study.claim("4.4", "Potentials of 0 to 10 mV leave a much thicker layer than those above", "Fig. 36; thickness by the particles, since the surface's height is imposed",
                "height below which 99 % of the solids lie at 0.2 s: " + ", ".join(f"{p} mV {mean_um(p).text(2)} um" for p in at_time(0.2)) + f"; mean of {', '.join(map(str, LOW))} mV over 25 and 50 mV {s.percent()}",
                f"more than {100 * WITHIN:g} % ({STUDENT})", s.above(WITHIN), why="the surface, whose height the dewatering imposes, lies on the particles at every potential; surfaces that yield: below")
else:
    study.claim("4.4", "Potentials of 0 to 10 mV leave a much thicker layer than those above", "Fig. 36; thickness by the particles, since the surface's height is imposed", DEAR,
                f"more than {100 * WITHIN:g} % ({STUDENT})", None)
surface = {p: [abs(of_potential(p)[0].thickness[at(of_potential(p)[0], t)] - of_potential(50)[0].thickness[at(of_potential(50)[0], t)]) for t in TIMES if reach(p, t)] for p in POTENTIALS}
study.claim("4.4", "The layer shrinks at roughly the same rate at every potential", "Fig. 38",
            f"the surface at {len(TIMES)} times differs by at most {max(max(v) for v in surface.values() if v) / 1e-9:.1f} nm, as the dewatering is the same", "the surface's height is the wet layer less the liquid lost, which the scene imposes", FROM_INPUT)
bulk = {p: Sample(r.bands(at(r, 0.2))[1] for r in of_potential(p)) for p in POTENTIALS}
all_bands = lambda p: np.mean([r.bands(at(r, 0.2)) for r in of_potential(p)], axis=0)     # noqa: E731
slope = Sample(np.polyfit(ALL, [of_potential(p)[i].bands(at(of_potential(p)[i], 0.2))[1] for p in ALL], 1)[0] * 50 for i in PACKINGS)
study.claim("4.4", "The potential has no significant systematic impact on the solids inside", "Fig. 37", "middle of the layer at 0.2 s: " + ", ".join(f"{p} mV {bulk[p].text()}" for p in at_time(0.2)) + f" wt-%; fitted over {ALL[0]} to 50 mV, a rise of {slope.text(2)}",
            f"the straight line through {len(ALL)} potentials changes over 50 mV by less than 1 wt-% ({STUDENT})", both(slope.below(1), slope.above(-1), None if not LOW else True),
            why="the layer's mean is imposed, and repulsion is what evens it out: with less of it cake and skin are denser, and what lies between them is left wetter. Substrate, "
                "middle, surface: " + "; ".join(f"{p} mV {', '.join(f'{v:.1f}' for v in all_bands(p))}" for p in at_time(0.2)) + " wt-%; 0 mV: contacts that hold keep cake and skin from going on as at 5 mV"
            if LOW else "two potentials are no trend; those of 0 to 10 mV are dear, and SIZE=full has them")
near, NEAR_TIME = {}, next(t for t in reversed((0.01, *TIMES)) if reach(0, t))
for p in POTENTIALS:
    share = []
    for r in of_potential(p):
        with study.file(r.case, "separation") as f:
            x, d = f["separation/edges"][:], f["separation/density"][at(r, NEAR_TIME)]
        share.append(100 * np.sum(d[x[1:] <= 20e-9] * np.diff(x)[x[1:] <= 20e-9]))
    near[p] = share
s = Sample(a - b for a, b in zip(near[0], near[50]))
spread = float(np.std(near[50], ddof=1)) if len(near[50]) > 1 else np.inf
study.claim("4.4", "A low potential agglomerates the particles: a sharp peak at short separations", "Fig. 39", "pairs nearer than 20 nm: " + ", ".join(f"{p} mV {np.mean(near[p]):.1f} %" for p in POTENTIALS) + f" ({len(near[0])} packings at 0 mV, {len(near[50])} at 50)",
            f"more at 0 than at 50 mV, of the pairs nearer than the smallest diameter, {NEAR_TIME:g} s, by ten standard deviations of the packings at 50 mV", None if len(near[50]) < 2 else bool(s.mean > 10 * spread))

# ---- how the surface holds


def pressure_on_surface(run, t):
    with study.file(run.case, "trajectory") as f:
        return f["observables/surface_pressure/value"][at(run, t)]


if LOW:
    WEAK = 0
    tensions = {p: [(t, r) for t, r in ((72, of_potential(p)[0]), *((t, one(f"k10-p{p}-t{t:g}")) for t in (7, 0.7, 0.07))) if r] for p in (WEAK, 50)}
    limited = {p: one(f"k10-p{p}-limited") for p in (WEAK, 50)}
    differences = [(f"{t:g} mN/m", a.z99[at(a, 0.2)] / b.z99[at(b, 0.2)] - 1, a.protruding[at(a, 0.2)]) for (t, a), (_, b) in zip(tensions[WEAK], tensions[50])]
    if limited[WEAK] and limited[50]:
        differences.append(("500 kPa at most", limited[WEAK].z99[at(limited[WEAK], 0.2)] / limited[50].z99[at(limited[50], 0.2)] - 1, limited[WEAK].protruding[at(limited[WEAK], 0.2)]))
    study.claim("4.4", f"A surface that yields would let layers of low potential ({WEAK} mV) stay thicker", "Fig. 36 leaves open how the surface held in the source",
                f"z99 at {WEAK} mV over that at 50 mV, 0.2 s: " + "; ".join(f"{name} {100 * d:+.2f} % ({100 * o:.2f} % of the solids above the surface)" for name, d, o in differences),
                f"more than {100 * WITHIN:g} % with any of the weaker surfaces (one packing)", any(d > WITHIN for _, d, _ in differences[1:]),
                why="no layer presses on the surface yet: at 0.2 s, under 72 mN/m, " + ", ".join(f"{p} mV with {pressure_on_surface(tensions[p][0][1], 0.2):.0f} Pa" for p in tensions))
else:
    study.claim("4.4", "A surface that yields would let uncharged layers stay thicker", "Fig. 36 leaves open how the surface held in the source", DEAR, f"more than {100 * WITHIN:g} % with any of the weaker surfaces (one packing)", None)

# ---- double layer
def double_layer(k):
    return seeds(f"k{k}-p25") or [r for r in [one(f"k{k}-p25")] if r]


s = Sample(a.z99[at(a, 0.2)] / b.z99[at(b, 0.2)] - 1 for a, b in zip(double_layer("2.5"), double_layer(10)))
study.claim("4.4", "The double layer hardly changes the thickness", "text with Fig. 41", f"z99 at 0.2 s, 2.5 nm over 10 nm: {s.percent()}", f"by less than 2 % ({STUDENT}); the surface's height is imposed", both(s.below(0.02), s.above(-0.02)))
for band, name, source in ((0, "cake", 5), (2, "skin", 2)):
    s = Sample((a.bands(at(a, 0.2)) - b.bands(at(b, 0.2)))[band] for a, b in zip(double_layer("2.5"), double_layer(10)))
    early = Sample((a.bands(at(a, 0.1)) - b.bands(at(b, 0.1)))[band] for a, b in zip(double_layer("2.5"), double_layer(10)))
    study.claim("4.4", f"A thin double layer sharpens the {name}, by about {source} wt-%", "Figs. 41, 42", f"2.5 nm less 10 nm: {s.text()} wt-% at 0.2 s, {early.text()} at 0.1 s",
                f"0.5 to 2 um from the {'substrate' if band == 0 else 'surface'} at 0.2 s, above half of that ({STUDENT})", s.above(source / 2),
                why=f"by 0.2 s the layer has {np.mean([a.mean_wt[at(a, 0.2)] for a in double_layer('2.5')]):.0f} wt-% and is even, with the rates chosen; the source prints none")
thinner = [(k, one(f"k{k}-p25")) for k in ("10", "5", "2.5", "1", "0.5")]
thinner = [(k, r) for k, r in thinner if r]
gains = [r.bands(at(r, 0.2))[0] for _, r in thinner]
study.claim("4.4", "Below 2.5 nm, which the source could not afford, the cake goes on to sharpen", "not in the source", "at the substrate at 0.2 s: " + ", ".join(f"{k} nm {g:.1f}" for (k, _), g in zip(thinner, gains)) + f" wt-% (one packing{'; 1 and 0.5 nm without Brownian motion' if noise else ''})",
            "more at 0.5 nm than at 2.5 nm by over 1 wt-%", None if thinner[-1][0] != "0.5" else bool(gains[-1] - gains[2] > 1),
            why="the layer is even by 0.2 s; at 0.1 s " + ", ".join(f"{k} nm {r.bands(at(r, 0.1))[0]:.1f}" for k, r in thinner) + ", so that what repulsion there is below 2.5 nm no longer holds particles apart")

# ---- viscosity: with one and the same dewatering, and with Darcy's law left to it
VISCOSITIES = ("0.89", "2", "4")
thin = next(re.match(r"hll-\d+um", c)[0] for c in study.cases if "-m2-" in c)
viscous = {end: {m: [runs[c] for c in of_seeds(study.cases, f"{thin}{layer[layer.index('-w'):]}-k10-p50-m{m}{noise}{end}")] for m in VISCOSITIES} for end in ("", "-darcy")}
KEEPS = 0.5     # wt-%, standard deviation of the profile by height: what we call a difference
# Compared when all have lost as much liquid, half-way to the 85 wt-% at which layers are at rest and even: with one dewatering at one time, under Darcy's law not.
HALFWAY = 75
halfway = lambda r: int(np.argmin(np.abs(r.mean_wt - HALFWAY)))     # noqa: E731
for end, how in (("", "the dewatering fixed"), ("-darcy", "Darcy's flux unscaled")):
    spreads = {m: Sample(r.spread(halfway(r)) for r in viscous[end][m]) for m in VISCOSITIES}
    when = {m: np.mean([r.time[halfway(r)] for r in viscous[end][m]]) for m in VISCOSITIES}
    s = Sample(a.spread(halfway(a)) - b.spread(halfway(b)) for a, b in zip(viscous[end]["4"], viscous[end]["0.89"]))
    study.claim("4.4", f"A higher viscosity keeps gradients, {how}", "Fig. 35", f"s.d. of the profile when the layer has {HALFWAY} wt-%: " + ", ".join(f"{m} mPa s {x.text(2)} ({when[m]:.3f} s)" for m, x in spreads.items()) + f" wt-%; from 0.89 to 4 mPa s {s.text(2)} more",
                f"more by over {KEEPS} wt-% ({STUDENT})", s.above(KEEPS),
                why="the slower the substrate drains, the larger the part that evaporates, which makes a skin; by how much packings differ is no less than what is left to decide" if end else "every resistance grows alike, and with the fall of the surface the motion that it imposes stays; only colloidal forces lose beside drag")
heights = {end: [np.mean([r.thickness[at(r, 0.05)] / UM for r in viscous[end][m]]) for m in VISCOSITIES] for end in viscous}
study.claim("4.4", "A higher viscosity slows consolidation", "Fig. 35, text", "surface at 0.05 s, absorption by Darcy's law: " + ", ".join(f"{m} mPa s {x:.2f} um" for m, x in zip(VISCOSITIES, heights["-darcy"])) + f"; with the dewatering fixed they differ by {np.ptp(heights['']) * 1000:.1f} nm",
            "Darcy's flux falls with viscosity, and the fall of the surface is imposed", FROM_INPUT if heights["-darcy"][0] < heights["-darcy"][1] < heights["-darcy"][2] else False)

# ---- figures
def profile(axis, group, when, colour, label):
    """Mean over seeds by height, with a band of one standard error. when: the frame, of a run."""
    grid = np.linspace(0, 1, 61)
    rows = [np.interp(grid, np.linspace(0, 1, 2 * r.phi.shape[1] + 1)[1::2], r.wt[when(r)]) for r in group]
    height = np.mean([r.thickness[when(r)] for r in group]) * grid / UM
    mean, error = np.mean(rows, axis=0), np.std(rows, axis=0) / np.sqrt(max(1, len(rows) - 1))
    axis.plot(mean, height, color=colour, label=label)
    axis.fill_betweenx(height, mean - error, mean + error, color=colour, alpha=0.2, lw=0)
    axis.set(xlabel="solids (wt-%)", ylabel="height (µm)", ylim=(0, None))


figure, axes = study.figure("fig35-viscosity", f"Solids at three viscosities, {thin[4:-2]} um, 10 nm, 50 mV (Fig. 35), when the layer has {HALFWAY} wt-%: with one and the same dewatering, and with Darcy's flux unscaled; right: the latter at one time. Mean of {len(PACKINGS)} packings, band: standard error", columns=3, width=65)
EARLY = viscous["-darcy"]["0.89"][0].time[halfway(viscous["-darcy"]["0.89"][0])]
for axis, (end, when, title) in zip(axes, (("", halfway, f"dewatering fixed, {HALFWAY} wt-%"), ("-darcy", halfway, f"Darcy unscaled, {HALFWAY} wt-%"), ("-darcy", lambda r: at(r, EARLY), f"Darcy unscaled, {EARLY:.3f} s"))):
    for i, m in enumerate(VISCOSITIES):
        profile(axis, viscous[end][m], when, f"C{i}", f"{m} mPa s")
    axis.set(title=title, xlim=(55, 85))
axes[0].legend(loc="center left")
figure, axes = study.figure("fig36-thickness", f"Thickness by the particles against surface potential at several times, {THICK} um, 10 nm (Fig. 36); bars: standard error", columns=2)
for axis, (what, name) in zip(axes, (("z99", "99 % of the solids (µm)"), ("top_envelope", "mean particle top (µm)"))):
    for t in TIMES:
        values = [mean_um(p, t, what) for p in at_time(t)]
        axis.errorbar(at_time(t), [v.mean for v in values], yerr=[v.error if v.n > 1 else 0 for v in values], fmt="o-", label=f"{t:g} s")
    axis.set(xlabel="surface potential (mV, negative)", ylabel=name)
axes[1].legend(loc=(0.62, 0.1))
figure, axis = study.figure("fig37-solids-by-potential", f"Solids at 0.2 s by surface potential, {THICK} um, 10 nm (Fig. 37)")
for i, p in enumerate(at_time(0.2)):
    profile(axis, of_potential(p), lambda r: at(r, 0.2), f"C{i}", f"{p} mV")
axis.legend()
figure, axis = study.figure("fig38-shrinkage", f"Thickness in time by surface potential, {THICK} um, 10 nm (Fig. 38): line by the particles (z99), dashes the surface, which is imposed")
for i, p in enumerate(POTENTIALS):
    r = of_potential(p)[0]
    axis.plot(r.time, r.z99 / UM, color=f"C{i}", label=f"{p} mV")
    axis.plot(r.time, r.thickness / UM, "--", color=f"C{i}", lw=0.7)
axis.set(xlabel="time (s)", ylabel="thickness (µm)")
axis.locator_params(axis="x", nbins=5)
axis.legend()
figure, axis = study.figure("fig39-separations", f"Surface separations of near neighbours at {NEAR_TIME:g} s (Fig. 39)")
for group, label in ((of_potential(0), "0 mV, 10 nm"), *([(of_potential(10), "10 mV, 10 nm")] if of_potential(10) else []), (of_potential(50), "50 mV, 10 nm"), (double_layer("2.5"), "25 mV, 2.5 nm"), (double_layer(10), "25 mV, 10 nm")):
    with study.file(group[0].case, "separation") as f:
        x, d = f["separation/edges"][:] * 1e9, f["separation/density"][at(group[0], NEAR_TIME)] * 1e-9
    axis.stairs(d, x, label=label, lw=1.2)
axis.set(xlabel="surface separation (nm)", ylabel="density (1/nm)", xlim=(0, 120), ylim=(3e-5, 1), yscale="log")
axis.legend(ncols=2, loc="upper right")
figure, axes = study.figure("fig41-solids-by-double-layer", f"Solids by Debye length, {THICK} um, 25 mV, at 0.1 and 0.2 s (Fig. 41)", columns=2)
figure2, axes2 = study.figure("fig42-cumulative", f"Solids of all that lies below a height, by Debye length, {THICK} um, 25 mV, 0.2 s (Fig. 42); right: the cake", columns=2)
for i, (k, r) in enumerate(thinner):
    group = double_layer(k)
    for axis, t in zip(axes, (0.1, 0.2)):
        profile(axis, group, lambda r: at(r, t), f"C{i}", f"{k} nm")
        axis.set(title=f"{t:g} s")
    for axis in axes2:
        n = at(r, 0.2)
        axis.plot(np.mean([g.cumulative_wt[at(g, 0.2)] for g in group], axis=0), r.edges[n][1:] / UM, color=f"C{i}", label=f"{k} nm")
        axis.set(xlabel="solids below (wt-%)", ylabel="height (µm)", ylim=(0, None))
axes2[1].set(ylim=(0, r.thickness[n] / UM / 4))
axes[0].legend()
axes2[0].legend()
figure, axes = study.figure("pressure", f"Pressure of the surface on the particles against solids, {THICK} um: by potential (10 nm), by Debye length (25 mV)", columns=2)
for axis, group in zip(axes, ([(f"{p} mV", of_potential(p)[0]) for p in POTENTIALS], [(f"{k} nm", r) for k, r in thinner])):
    for name, r in group:
        with study.file(r.case, "trajectory") as f:
            w, pressure = 100 * f["observables/solids_mass_fraction/value"][:], f["observables/surface_pressure/value"][:] / 1e3
        axis.semilogy(w[pressure > 0], pressure[pressure > 0], label=name)
    axis.set(xlabel="solids (wt-%)", ylabel="pressure of the surface (kPa)")
    axis.legend()
if LOW:
    figure, axes = study.figure("surface-tension", f"Thickness by the particles in time with surfaces that hold less and less, {THICK} um, 10 nm; dashes: the surface", columns=2)
    for axis, p in zip(axes, (WEAK, 50)):
        for i, (name, r) in enumerate([(f"{t:g} mN/m", r) for t, r in tensions[p]] + ([("500 kPa at most", limited[p])] if limited[p] else [])):
            axis.plot(r.time, r.z99 / UM, color=f"C{i}", label=name)
            axis.plot(r.time, r.thickness / UM, "--", color=f"C{i}", lw=0.6)
        axis.set(xlabel="time (s)", ylabel="z99 (µm)", title=f"{p} mV")
    axes[0].legend()
study.finish()
