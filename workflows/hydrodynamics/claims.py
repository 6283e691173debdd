"""Every resistance model against exact theory: errors against gap, for pairs of all ratios, the wall and the free surface."""
import csv

import h5py
import numpy as np
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline

from errors import BANDS, MODES, Errors, REFERENCE
from study import Study

study = Study()
errors = Errors(study.results)
RATIOS = errors.ratios
NAMES = {"exact": "here, at every gap", "tapered": "here, as in a run", "thesis": "the source's forms", "leading": "leading terms"}
STYLES = {"exact": "-", "tapered": "--", "thesis": "-.", "leading": ":"}


def worst(model, partners, modes, low, high):
    return max(errors.within(model, p, low, high)[m].max() for p in partners for m in modes)


def percent(x):
    return f"{100 * x:.2g} %"


squeeze = worst("tapered", RATIOS, ["squeeze"], 0, 0.1)
rest = worst("tapered", RATIOS, MODES, 0, 0.1)
study.claim("3.2.2", f"Pairs of spheres, size ratios 1 to {RATIOS[-1]:.0f}: the relative resistance is right near contact",
            "\"squeezing, shearing, pumping and twisting\"; the source's fits are not printed", f"squeeze within {percent(squeeze)}, every other motion within {percent(rest)}",
            f"gaps to 0.1 of the smaller radius, {len(RATIOS)} ratios: squeeze under 0.05 %, any relative motion under 0.5 % of exact theory", squeeze < 5e-4 and rest < 5e-3)
for partner, name in (("wall", "a plane wall"), ("surface", "a free surface")):
    e = worst("tapered", [partner], MODES, 0, 100)
    study.claim("3.2.3", f"A sphere before {name}: resistance at every gap", f"({'12' if partner == 'wall' else '13'}), lubrication only",
                f"all five functions within {percent(e)}", "every gap of the exact table, 1e-6 to 10 radii or more: under 0.5 %", e < 5e-3)


def at(model, partner, mode, gap):
    x, e = errors.of[model][partner]
    return float(np.interp(np.log(gap), np.log(x), e[mode]))


GAPS = (1e-4, 1e-3, 1e-2, 0.1)
for partner, equation, name in (("wall", "(12)", "solid boundary"), ("surface", "(13)", "free surface")):
    found = [at("thesis", partner, "squeeze", g) for g in GAPS]
    study.claim("3.2.3", f"{equation} is the force on a sphere that approaches a {name}", f"{equation}, its bracket taken as resistance, with Stokes drag",
                "off by " + ", ".join(f"{100 * e:+.2g} %" for e in found) + " at gaps of " + ", ".join(f"{g:g}" for g in GAPS) + " radii",
                "within 0.5 % of exact theory at gaps to a tenth of the radius", max(abs(e) for e in found) < 5e-3,
                why="its first term is right, its logarithm does not match theory")
lead = worst("leading", RATIOS, ["shear", "rolling", "coupling"], 0, 0.1)
source = worst("thesis", RATIOS, ["shear", "rolling", "coupling"], 0, 0.1)
study.claim("3.2.2", "Near-field terms without constants will do for pairs of any sizes", "§3.2.2: near-field forms; finite-element fits for unequal spheres, not printed",
            f"shear, rolling and their coupling off by up to {percent(source)} (1/x and ln(1 + 1/x)), {percent(lead)} (1/x and ln(1/x)); squeeze up to "
            f"{percent(worst('thesis', RATIOS, ['squeeze'], 0, 0.1))}", "within 0.5 % of exact theory at gaps to a tenth of the smaller radius", max(lead, source) < 5e-3,
            why="the terms grow as a logarithm only, so that the constants beside them count at every gap that a run meets")
wall = np.genfromtxt(REFERENCE / "wall_resistance.csv", delimiter=",", skip_header=1)
surface = np.genfromtxt(REFERENCE / "free_surface.csv", delimiter=",", skip_header=1)
near = wall[0, 1] / surface[0, 1]
study.claim("3.2.3", "Free surface and wall differ by a factor of four", "\"differs from the solid boundary expression (12) by a factor of four\"",
            f"{near:.4f} at a gap of 1e-6 radii, {np.interp(0.01, wall[:, 0], wall[:, 1]) / np.interp(0.01, surface[:, 0], surface[:, 1]):.2f} at 0.01, "
            f"{np.interp(0.1, wall[:, 0], wall[:, 1]) / np.interp(0.1, surface[:, 0], surface[:, 1]):.2f} at 0.1",
            "ratio of the exact resistances within 1 % of four at the smallest gap (it is a limit)", abs(near / 4 - 1) < 0.01)
lateral = surface[:, 2].min()
study.claim("3.2.3", "A free surface \"allows for almost unconstrained lateral movement\"", "Fig. 10; no lateral drag beyond Stokes'",
            f"lateral drag {surface[0, 2]:.3f} of Stokes' at contact, {np.interp(3, surface[:, 0], surface[:, 2]):.3f} at three radii; at the wall {np.interp(0.01, wall[:, 0], wall[:, 2]):.2f} at 0.01",
            "exact lateral drag under a free surface at most that of an isolated sphere at every gap, beside a wall more", lateral < 1 and surface[:, 2].max() <= 1 and wall[:, 2].min() > 1)

# ---- two spheres pressed together, against an accurate solution with the exact resistance
SPHERE, MU = 0.5e-6, 1e-3
LOAD = 0.5 * 1700 * 4 / 3 * np.pi * SPHERE**3 * 2000   # half of the upper sphere's weight is internal (approach.yaml)
pair = np.genfromtxt(REFERENCE / "relative_K_basis.csv", delimiter=",", skip_header=1)
equal = pair[pair[:, 0] == 1]
# Kn x is smooth in ln h: a cubic spline through 8 points a decade.
kn_x = CubicSpline(np.log(equal[:, 2]), equal[:, 3] * equal[:, 1])


def rate(_, log_gap):                                  # of ln h: -F/(h (K_isolated + K)), K = 6 pi mu R Kn
    y = np.exp(log_gap) / SPHERE
    kn = kn_x(np.log(y)) / (2 * y)                     # h/R = 2 h/a
    return -LOAD / (np.exp(log_gap) * MU * (3 * np.pi * SPHERE + 3 * np.pi * SPHERE * kn))


approach = {}
for tolerance in ("default", "1e-5", "1e-7"):
    with h5py.File(study.results / f"approach-{tolerance}.h5") as f:
        position, time = f["particles/layer/position/value"][:], f["particles/layer/position/time"][:]
    gap = np.linalg.norm(position[:, 1] - position[:, 0], axis=1) - 2 * SPHERE
    exact_gap = np.exp(solve_ivp(rate, (time[0], time[-1]), [np.log(gap[0])], t_eval=time, rtol=1e-10, atol=1e-12, method="DOP853").y[0])
    approach[tolerance] = time, gap, exact_gap, np.where(exact_gap > 1e-4 * SPHERE, np.abs(gap / exact_gap - 1), 0)
worst_of = {t: a[3].max() for t, a in approach.items()}
study.claim("3.1", "Two spheres pressed together approach as lubrication theory says, from 0.1 a to 1e-4 a",
            "near-field theory, integrated to second order; no comparison is printed",
            "gap off by at most " + ", ".join(f"{percent(e)} at {'the default tolerance' if t == 'default' else 'tolerance ' + t}" for t, e in worst_of.items()),
            "against a solution of the ordinary differential equation with the exact table (rtol 1e-10): within 0.5 % at tolerance 1e-7", worst_of["1e-7"] < 5e-3)

# ---- figures
figure, axes = study.figure("approach", "Two spheres of 1 um pressed together by a constant force: gap against time (left; line: accurate solution with the exact resistance), and error of the gap by the "
                            "stepper's tolerance (right)", columns=2)
for k, (tolerance, (time, gap, exact_gap, error)) in enumerate(approach.items()):
    axes[0].semilogy(time[::8] * 1e3, gap[::8] / SPHERE, "os^"[k], color=f"C{k}", mfc="none", label=tolerance)
    axes[1].semilogy(time[1:] * 1e3, np.where(error[1:] > 0, 100 * error[1:], np.nan), color=f"C{k}")
axes[0].semilogy(time * 1e3, exact_gap / SPHERE, color="0.3", lw=0.8, zorder=0)
axes[0].set(xlabel="time (ms)", ylabel="gap / radius", xlim=(0, None))
axes[1].axhline(0.5, color="0.6", lw=0.6, zorder=0)
axes[1].set(xlabel="time (ms)", ylabel="error of the gap (%)", xlim=(0, None))
axes[0].legend(title="tolerance", title_fontsize=7)

figure, axes = study.figure("fig10-boundaries", "Resistance of a sphere before a free surface and before a wall, over Stokes drag (Fig. 10 in numbers). Lines: here; circles: exact; dotted: (12), (13)", columns=2)
with open(study.results / "exact.csv", newline="") as file:
    rows = list(csv.DictReader(file))
with open(study.results / "thesis.csv", newline="") as file:
    source_rows = list(csv.DictReader(file))
for word, table, name, colour in (("surface", surface, "free surface", "C0"), ("inf", wall, "wall", "C1")):
    gap = np.array([float(r["h"]) / float(r["a1"]) for r in rows if r["a2"] == word])
    drag = 6 * np.pi * 1e-3 * 0.5e-6
    for axis, key, column in ((axes[0], "kn", 1), (axes[1], "ks", 2)):
        axis.semilogx(gap, 1 + np.array([float(r[key]) for r in rows if r["a2"] == word]) / drag, color=colour, label=name)
        axis.semilogx(gap, 1 + np.array([float(r[key]) for r in source_rows if r["a2"] == word]) / drag, ":", color=colour)
        axis.semilogx(table[::3, 0], table[::3, column], "o", color=colour, mfc="none", ms=3)
for axis, title in zip(axes, ("towards or away", "along")):
    axis.set(xlabel="gap / radius", ylabel="resistance / Stokes drag", title=title, xlim=(1e-4, 10))
axes[0].set(yscale="log", ylim=(0.9, 2e4))
axes[1].set(ylim=(0.5, 6))
axes[0].legend()

FLOOR = 1e-6


def draw(axis, model, partner, mode, **how):
    gap, e = errors.of[model][partner]
    axis.loglog(gap, np.maximum(np.abs(100 * e[mode]), 100 * FLOOR), STYLES[model], **how)


shown = [r for r in (1, 2, 5, 10, 100) if any(np.isclose(r, x) for x in RATIOS)]
shown = [min(RATIOS, key=lambda x: abs(x - r)) for r in shown]
figure, axes = study.figure("pair-error", "Two spheres: error of the whole relative resistance against the gap over the smaller radius. Colours: size ratio; full lines: the functions used here; dash-dotted: the "
                            "source's near-field forms", columns=3, rows=2, width=60, height=52, sharex=True, sharey=True)
for axis, mode in zip(axes.flat, MODES):
    for k, ratio in enumerate(shown):
        draw(axis, "exact", ratio, mode, color=f"C{k}", label=f"1:{ratio:.0f}")
        draw(axis, "thesis", ratio, mode, color=f"C{k}", lw=0.8)
    axis.axhline(0.5, color="0.6", lw=0.6, zorder=0)
    axis.axvline(0.1, color="0.6", lw=0.6, zorder=0)
    axis.set(title={"worst": "any shear and rolling"}.get(mode, mode), xlim=(1e-6, 2), ylim=(1e-4, 300))
for axis in axes[1]:
    axis.set_xlabel("gap / smaller radius")
for axis in axes[:, 0]:
    axis.set_ylabel("error (%)")
axes[0, 0].legend(ncols=2, loc="upper left", columnspacing=1)

figure, axis = study.figure("pair-error-worst", "Two spheres: largest error over all size ratios from 1 to 1:100 and all relative motions, by model. Below 0.1 of the smaller radius the model in use is within 0.5 %; the taper "
                            "ends it at 0.4 (shear) and 1.5 (squeeze)")
for k, model in enumerate(NAMES):
    gaps, most = [], []
    for low, high in zip(np.geomspace(1e-6, 1.5, 40)[:-1], np.geomspace(1e-6, 1.5, 40)[1:]):
        values = [e for r in RATIOS for m in MODES for e in errors.within(model, r, low, high)[m]]
        if values:
            gaps.append(np.sqrt(low * high))
            most.append(100 * max(values))
    axis.loglog(gaps, most, STYLES[model], color=f"C{k}", label=NAMES[model])
axis.axhline(0.5, color="0.6", lw=0.6, zorder=0)
axis.axvline(0.1, color="0.6", lw=0.6, zorder=0)
axis.set(xlabel="gap / smaller radius", ylabel="largest error (%)", xlim=(1e-6, 1.5), ylim=(0.01, 300))
axis.legend(loc="upper left")

figure, axes = study.figure("boundary-error", "A sphere before a wall (left) and a free surface (right): error of the whole resistance against the gap. Full lines: the functions used here; dash-dotted: (12) and (13), a virtual "
                            "sphere of 100 radii for sliding and rolling at the wall; dotted: leading terms", columns=2, sharey=True)
for axis, partner in zip(axes, ("wall", "surface")):
    for k, mode in enumerate(MODES[:-1]):
        draw(axis, "exact", partner, mode, color=f"C{k}", label={"squeeze": "perpendicular", "shear": "parallel"}.get(mode, mode))
        for model in ("thesis", "leading"):
            draw(axis, model, partner, mode, color=f"C{k}", lw=0.8)
    axis.axhline(0.5, color="0.6", lw=0.6, zorder=0)
    axis.set(xlabel="gap / radius", title={"wall": "wall", "surface": "free surface"}[partner], xlim=(1e-6, 10), ylim=(3e-7, 300))
axes[0].set_ylabel("error (%)")
axes[0].legend(ncols=2, loc="lower left")
study.finish()
