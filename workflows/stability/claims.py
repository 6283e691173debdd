"""What each hard case did, against what it was to do. stability.csv is the table."""
import csv
import json

import h5py
import numpy as np

from study import Study

# Status, outcomes that are right (any of them), and what the case is about.
AT_REST = ("immobile", "until", "first_critical_concentration")
EXPECTED = {
    "minus-25mv": (0, ("until", "first_critical_concentration"), "-25 mV, to 80 wt-%; what the next is measured against"),
    "0mv": (0, ("until", "first_critical_concentration"), "0 mV, to 80 wt-%"),
    "attraction": (0, ("until", "first_critical_concentration"), "0 mV with ten times the Hamaker constant, to 80 wt-% (quick: 74)"),
    "debye-1nm": (0, AT_REST, "double layer of 1 nm"),
    "debye-0.5nm": (0, AT_REST, "double layer of 0.5 nm"),
    "ratio-100": (0, ("until",), "1:100 in size, a gap of 1e-6 of the smaller radius, pressed together"),
    "jammed": (0, ("until", "first_critical_concentration"), "compressed past immobility"),
    "surface-0.1nm": (0, AT_REST, "surface spring at a roughness of 0.1 nm"),
    "overlap": (0, ("until", "first_critical_concentration"), "particles overlap at the start"),
    "explicit-long": (1, ("failed",), "explicit Euler with a step that is too long"),
    "hot-fine": (0, ("until",), "200 nm at 80 degrees, Brownian, long"),
    "hot-fine-noise": (0, ("until",), "the same with the full noise; full: 300 s at 0.1 ms"),
}
study = Study()


def text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


def not_a_number(folder):
    """Numbers that are not finite, over every dataset of floating-point numbers of every file of a case. Infinity is what
    a layer without pairs has for its smallest gap, so that it counts in everything but that."""
    count = 0
    for name in folder.glob("*.h5"):
        with h5py.File(name) as file:
            def look(path, item):
                nonlocal count
                if isinstance(item, h5py.Dataset) and item.dtype.kind == "f":
                    values = item[()]
                    count += np.sum(np.isnan(values) if "minimum_gap" in path else ~np.isfinite(values))
            file.visititems(look)
    return int(count)


rows = []
for case, (status, outcomes, what) in EXPECTED.items():
    folder = study.results / study.size / case
    run = json.loads((folder / "run.json").read_text())
    row = {"case": case, "what": what, "expected": f"status {status}: " + " or ".join(outcomes), "status": run["status"], "outcome": "none",
           "smallest_gap_nm": np.nan, "time_s": np.nan, "steps": 0, "iterations": np.nan, "not_finite": not_a_number(folder), "cpu_seconds": run["cpu_seconds"],
           "message": run["message"] if run["status"] else ""}
    for name in ("trajectory", "trajectory.failed"):
        if (folder / f"{name}.h5").exists():
            with h5py.File(folder / f"{name}.h5") as f:
                layer, observables = f["particles/layer"], f["observables"]
                row |= {"outcome": text(f["pigment"].attrs["outcome"]), "steps": int(layer["position/step"][-1]), "time_s": float(layer["position/time"][-1]),
                        "smallest_gap_nm": float(observables["minimum_gap/value"][:].min()) * 1e9,
                        "iterations": float(observables["solver_iterations/value"][1:].mean()) if len(layer["position/step"]) > 1 else np.nan}
    row["as_stated"] = row["status"] == status and row["outcome"] in outcomes and row["not_finite"] == 0
    rows.append(row)
part = study.results / "stability.csv.part"
with open(part, "w", newline="") as file:
    writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
part.replace(study.results / "stability.csv")
by_case = {row["case"]: row for row in rows}

figure, axis = study.figure("outcomes", "What the hard cases did: CPU time, outcome and smallest gap", width=120, height=75)
place = np.arange(len(rows))[::-1]
axis.barh(place, [r["cpu_seconds"] for r in rows], color=["#2f8f4e" if r["as_stated"] else "#c8531c" for r in rows])
for y, r in zip(place, rows):
    axis.annotate(f"{r['outcome'].replace('_', ' ')}, gap {r['smallest_gap_nm']:.2g} nm", (r["cpu_seconds"], y), xytext=(3, 0), textcoords="offset points", va="center", fontsize=7)
axis.set_yticks(place, [r["case"] for r in rows])
axis.set(xlabel="CPU time (s), one thread", xscale="log", xlim=(None, 2000 * max(r["cpu_seconds"] for r in rows)))

for r in rows:
    study.claim("3.4", f"Ends as stated: {r['what']}", r["expected"], f"status {r['status']}: {r['outcome']} at {r['time_s']:.3g} s, {r['steps']} steps, smallest gap {r['smallest_gap_nm']:.3g} nm, "
                f"{r['not_finite']} numbers not finite" + (f"; {r['message']}" if r["message"] else ""), "status, outcome, and no NaN in any dataset of any file", bool(r["as_stated"]))
repulsion = by_case["minus-25mv"]
for case in ("0mv", "attraction"):
    r = by_case[case]
    study.claim("4.4", f"No pair ever overlaps: {r['what']}", "psi = 0", f"smallest gap of all frames {r['smallest_gap_nm']:.3g} nm, status {r['status']}", "above zero in every frame of a run that ended",
                bool(r["status"] == 0 and r["smallest_gap_nm"] > 0))
    ratio = r["cpu_seconds"] / repulsion["cpu_seconds"]
    study.claim("4.4", f"At most 10 times the time of -25 mV: {r['what']}", "psi = 0", f"{r['cpu_seconds']:.3g} s against {repulsion['cpu_seconds']:.3g} s, {ratio:.2g} times; status {r['status']}",
                "at most 10 (CPU time), both run to their end", None if case == "attraction" and study.size == "quick" else bool(ratio <= 10 and r["status"] == 0 == repulsion["status"]),
                why=f"{r['steps']} steps against {repulsion['steps']}, {r['iterations']:.0f} iterations a step against {repulsion['iterations']:.0f}, each dearer, as contacts bind the layer to a network"
                + ("; a quick run ends before most bonds have formed, SIZE=full decides" if case == "attraction" and study.size == "quick" else ""))
explicit = by_case["explicit-long"]
said = explicit["message"]
study.claim("3.4", "A blow-up names step, time, pair, radii, gap, force and a step that would do", "none", said or "no message", "all words are there",
            bool(all(word in said for word in ("step ", "t = ", "ids", "radii", "gap", "force", "stepping.time_step"))))
study.finish()
