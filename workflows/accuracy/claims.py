"""Errors of every run against the reference, beside its CPU time (accuracy.csv), the front of the best, and whether the
defaults are on it."""
import csv
import json

import numpy as np

from run_errors import MEASURES, differences, state
from study import Study

SHORT = 0.01   # s: until here single trajectories are compared
MARGIN = 0.1   # CPU times within this share of one another are alike

study = Study()
folder = study.results / study.size


def measures(name):
    case = f"{study.size}/{name}"
    with study.file(case, "trajectory") as t:
        layer = t["particles/layer"]
        short = int(np.argmin(np.abs(layer["position/time"][:] - SHORT)))
        return state(study, case) | {"short": layer["position/value"][short] - layer["position/value"][0]}


reference = measures("reference")
moved = np.sqrt(np.mean(np.sum(reference["short"] ** 2, axis=1)))
rows = []
for path in sorted(folder.glob("*/run.json")):
    run = json.loads(path.read_text())
    row = {"run": path.parent.name, "status": run["status"], "seconds": run["cpu_seconds"]}
    if run["status"] == 0:
        m = measures(path.parent.name)
        error = np.linalg.norm(m["short"] - reference["short"], axis=1)
        row |= {"steps": m["steps"], "iterations": m["iterations"], "end": m["end"], "displacement_rms": np.sqrt(np.mean(error**2)) / moved, "displacement_median": np.median(error) / moved}
        row |= differences(m, reference)
    rows.append(row)
columns = ["run", "status", "seconds", "steps", "iterations", "end", "displacement_rms", "displacement_median", "profile_l1", "separation_ks", "clustered", "pressure"]


def write_table(name, columns, rows):
    part = folder / f"{name}.part"
    with open(part, "w", newline="") as file:
        writer = csv.DictWriter(file, columns, lineterminator="\n", restval="", extrasaction="ignore")
        writer.writeheader()
        writer.writerows(rows)
    part.replace(folder / name)


write_table("accuracy.csv", columns, rows)

done = [r for r in rows if r["status"] == 0 and r["run"] != "reference"]
by_name = {r["run"]: r for r in done}
default = by_name["default"]


def on_front(r, error):
    """No other run is both faster, beyond the margin, and at most as wrong."""
    return not any(o["seconds"] < (1 - MARGIN) * r["seconds"] and o[error] <= r[error] for o in done)


ERRORS = (("displacement_rms", "displacement at 10 ms, rms", None), ("displacement_median", "displacement at 10 ms, median", None), *MEASURES)
figure, axes = study.figure("front", "Error against CPU time of every knob; the line joins the runs that none beats in both", columns=3, rows=2)
for axis, (error, label, bound) in zip(axes.flat, ERRORS):
    kinds = {}
    for r in done:
        kinds.setdefault(r["run"].split("-")[0], []).append(r)
    for kind, marker in zip(kinds, "sv^<>DPXphd"):
        # A clustered fraction may agree exactly, which no logarithm shows.
        axis.loglog([r["seconds"] for r in kinds[kind]], [max(r[error], 1e-5) for r in kinds[kind]], marker, label=kind.replace("_", " "), linestyle="none",
                    markersize=7 if kind == "default" else 3.5)
    front = sorted((r for r in done if on_front(r, error)), key=lambda r: r["seconds"])
    axis.plot([r["seconds"] for r in front], [max(r[error], 1e-5) for r in front], "-", color="#999999", linewidth=0.8, zorder=0)
    if bound:
        axis.axhline(bound, color="k", linestyle=":", linewidth=0.8)
    axis.set(xlabel="CPU time (s), one thread", ylabel=label)
axes.flat[0].legend(fontsize=5, ncol=2)

for error, label, bound in ERRORS:
    better = [o["run"] for o in done if o["seconds"] < (1 - MARGIN) * default["seconds"] and o[error] <= default[error]]
    # A measure in which the default is not off at all tells nobody apart who is not either.
    study.claim("accuracy", f"The defaults lie on the front: {label}", "none", f"error {default[error]:.3g} in {default['seconds']:.3g} s; faster and no worse: {', '.join(better) or 'none'}",
                f"no other run is at most as wrong in less than {1 - MARGIN:g} of the time; where the error is zero, the measure is too coarse", not better if default[error] > 0 or not better else None,
                why=f"a count of particles, of which {sum(o[error] <= default[error] for o in done)} of {len(done)} runs get as many right" if error == "clustered" else "")
    if bound:
        study.claim("accuracy", f"The defaults are close enough to the converged run: {label}", "none", f"{default[error]:.3g}", f"at most {bound:g}", bool(default[error] <= bound))
# ---- noise
calm = measures("noise/reference")
noises = []
for path in sorted(folder.glob("noise/*/run.json")):
    run = json.loads(path.read_text())
    row = {"run": path.parent.name, "status": run["status"], "seconds": run["cpu_seconds"]}
    if run["status"] == 0:
        m = measures(f"noise/{row['run']}")
        row |= {"steps": m["steps"]} | differences(m, calm)
    noises.append(row)
rows += noises
write_table("noise.csv", ["run", "status", "seconds", "steps", "profile_l1", "separation_ks", "clustered", "pressure"], noises)
ended = {r["run"]: r for r in noises if r["status"] == 0}
# Two samples of as many separations from one distribution differ by less in 99 of 100 cases (Kolmogorov and Smirnov).
chance = 1.63 * np.sqrt(2 / len(calm["gaps"]))
figure, axes = study.figure("noise", "With Brownian motion: error of statistics against CPU time, by noise and step; against the full noise at a step of 5 us. Dotted: what chance alone makes of the separations, 99 %", columns=3)
for axis, (error, label) in zip(axes, (("separation_ks", "separations < 50 nm, KS"), ("clustered", "clustered fraction at 20 nm"), ("profile_l1", "solids profile, L1"))):
    for (name, r), marker in zip(((n, r) for n, r in ended.items() if n != "reference"), "osv^<>DPX"):
        axis.loglog(r["seconds"], max(r[error], 1e-5), marker, label=name, linestyle="none", markersize=7 if name == "default" else 3.5)
    axis.set(xlabel="CPU time (s), one thread", ylabel=label)
axes[0].axhline(chance, color="k", linestyle=":", linewidth=0.8)
axes[0].legend(fontsize=5)
if "default" in ended:
    study.claim("accuracy", "The default noise and step have the separations of the converged ones", "none", f"KS {ended['default']['separation_ks']:.3f}; chance alone {chance:.3f} (99 %); k_brown "
                + (f"{ended['k_brown-0.02ms']['separation_ks']:.3f}" if "k_brown-0.02ms" in ended else "not ended"), "at most 0.02 above what chance makes of equal distributions", bool(ended["default"]["separation_ks"] < 0.02 + chance))
late = [f"{r['run']} (status {r['status']})" for r in rows if r["status"]]
study.claim("accuracy", "Every choice of every knob ends its run", "none", f"not ended: {', '.join(late) or 'none'}", "status 0 within the limit of the study", not late)
study.finish()
