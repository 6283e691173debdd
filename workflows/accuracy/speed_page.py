"""Prints docs/speed.md: speed_page.py RESULTS LAYERS, RESULTS = build/studies/accuracy, with the larger SIZE where both were run; LAYERS =
build/studies/layer-speed, which may not have been run."""
import csv
import json
import os
import pathlib
import sys

results, layers = map(pathlib.Path, sys.argv[1:])
size = next(s for s in ("full", "quick") if (results / s / "accuracy.csv").exists())
layer = {"full": "the drying study's layer of 20 um from 65 wt-% to 0.2 s", "quick": "10 um of the drying study's layer from 65 wt-% to 0.05 s"}[size]
packing = json.loads((results / size / "packing.json").read_text())
with open(results / size / "accuracy.csv", newline="") as file:
    rows = list(csv.DictReader(file))
analyses = results / "analyses.md"
noises = results / size / "noise.csv"


def percent(text):
    return f"{100 * float(text):.2g} %"


print(f"""# Speed and error

`make speed` measures what stands here and writes this page (`SIZE={size}`); run it with nothing else running. One thread.

{layer[0].upper() + layer[1:]}, HLL, without Brownian motion, packed in {packing['seconds']:.2g} s. Each row changes one thing from the default; INTEGRATOR-TOLERANCE changes the
integrator and its tolerance. Errors are against the run `reference`: extrapolated, at a tight tolerance and a solver tolerance of 1e-8.

| run | steps | CPU time, s | displacement after 10 ms, rms | median | solids profile L1 | separations < 50 nm, KS | clustered fraction at 20 nm | surface pressure |
|---|---|---|---|---|---|---|---|---|""")
for row in sorted(rows, key=lambda r: float(r["seconds"])):
    if row["status"] != "0":
        print(f"| {row['run']} | | over {float(row['seconds']):.0f}: status {row['status']} | | | | | | |")
    elif row["run"] == "reference":
        print(f"| reference | {row['steps']} | {float(row['seconds']):.1f} | | | | | | |")
    else:
        print(f"| {row['run']} | {row['steps']} | {float(row['seconds']):.1f} | {percent(row['displacement_rms'])} | {percent(row['displacement_median'])} | {percent(row['profile_l1'])} | "
              f"{float(row['separation_ks']):.3f} | {float(row['clustered']):.4f} | {percent(row['pressure'])} |")
print("""
Displacements are over the root mean square displacement of the reference, at 10 ms. L1 is the integral of the difference of the final
solids profiles (30 slices) over that of the reference; KS the largest difference of the cumulative distributions of surface separations
below 50 nm; the clustered fraction is that of particles with a neighbour nearer than 20 nm, as a difference; pressure the mean
of the last four frames. Two different random packings differ by several per cent in the same profile. The figure is in
`build/studies/accuracy/report.html`.""")
if noises.exists():
    with open(noises, newline="") as file:
        rows = list(csv.DictReader(file))
    print("""
## With Brownian motion

The same layer to its first 10 ms (`SIZE=full`: 0.1 s); errors against the full noise (`fluctuation_dissipation`) at a step of 5 us, by statistics, since no two paths agree.
NOISE-STEP: `fd` is the full noise, `implicit` and `explicit` the same with the force at the ends of the step, `undrifted` without its drift, `k_brown` the source's.

| run | steps | CPU time, s | solids profile L1 | separations < 50 nm, KS | clustered fraction at 20 nm | surface pressure |
|---|---|---|---|---|---|---|""")
    for row in sorted(rows, key=lambda r: float(r["seconds"])):
        if row["status"] != "0":
            print(f"| {row['run']} | | over {float(row['seconds']):.0f}: status {row['status']} | | | | |")
        else:
            print(f"| {row['run']} | {row['steps']} | {float(row['seconds']):.1f} | {percent(row['profile_l1'])} | {float(row['separation_ks']):.3f} | {float(row['clustered']):.4f} | {percent(row['pressure'])} |")
if (layers / "layer.csv").exists():
    with open(layers / "layer.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    size = (layers / ".made" / "claims.settings").read_text().split()[0]
    print(f"""
## Whole layers

`make study-layer-speed SIZE={size}`: HLL to rest, with a double layer of 5, 1 and 0.5 nm; converged runs to 0.3 s{"; both with two more packings, s2 and s3" if size == "full" else ""}; at -25 mV and without charge to 80 wt-%. Threads "all"
are every core ({os.cpu_count()} here); 1: converged runs. These and further packings (s2, s3), whose times do not count, may run beside something else. Errors at 0.3 s against the finest tolerance: those of the other converged runs are chance, since paths are chaotic.

| run | particles | threads | steps | wall time, s | CPU time, s | outcome | at, s | solids, wt-% | smallest gap, nm | solids profile L1 | separations < 50 nm, KS | clustered fraction at 20 nm | surface pressure |
|---|---|---|---|---|---|---|---|---|---|---|---|---|---|""")
    for row in rows:
        errors = ((percent(row["profile_l1"]), f"{float(row['separation_ks']):.3f}", f"{float(row['clustered']):.4f}", percent(row["pressure"])) if row["profile_l1"] else ("",) * 4)
        print(f"| {row['run']} | {row['particles']} | {row['threads']} | {row['steps']} | {float(row['seconds']):.1f} | {float(row['cpu_seconds']):.1f} | {row['outcome'].replace('_', ' ')} | {float(row['end']):.3f} | "
              f"{100 * float(row['solids']):.1f} | {float(row['smallest_gap_nm']):.3g} | " + " | ".join(errors) + " |")
if analyses.exists():
    print("\n## Measuring tools, pictures, exports\n\n" + analyses.read_text().strip())
