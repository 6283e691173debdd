"""Prints docs/accuracy.md: accuracy_page.py RESULTS [BENCH.json], RESULTS = build/studies/hydrodynamics."""
import csv
import json
import pathlib
import sys

import numpy as np

from errors import BANDS, MODES, Errors

results = pathlib.Path(sys.argv[1])
errors = Errors(results)
partners = [*errors.ratios, "wall", "surface"]
MODELS = (("tapered", "The functions in use (`hydrodynamics.model: exact`)",
           "From 0.2 of the smaller radius on shear, rolling and twist of a pair are tapered to nothing at 0.4; the last column says what that costs."),
          ("thesis", "The source's forms (`hydrodynamics.model: thesis`)", "1/x and ln(1 + 1/x) for pairs; (12), (13) and a virtual sphere of 100 radii at the boundaries."),
          ("leading", "Leading terms alone", "1/x and ln(1/x), no constants; for comparison, no model of the engine."))


def number(x):
    return f"{100 * x:.2g}" if x < 10 else f"{100 * x:.0f}"


def name(partner):
    return {"wall": "wall", "surface": "free surface"}.get(partner) or f"1:{partner:.3g}"


print("""# Accuracy of resistances

How far the resistance models are from exact theory, and what a pair costs. `make accuracy` writes this page; `make
study-hydrodynamics` draws the errors.

The error is that of the whole resistance to a motion, isolated drag and the model's term together. **Maximum and median over
squeeze, twist, shear, rolling, their coupling and the worst combination of the last three**, in per cent, over the gaps of the exact
tables (data/resistance, eight a decade) in each range. Gaps are over the smaller radius.
""")
for model, title, note in MODELS:
    print(f"## {title}\n\n{note}\n")
    print("| size ratio | " + " | ".join(f"{'to' if low == 0 else f'{low:g} to'} {high:g}" for low, high in BANDS) + " |")
    print("|---|" + "---|" * len(BANDS))
    for partner in partners:
        cells = []
        for low, high in BANDS:
            values = np.concatenate([errors.within(model, partner, low, high)[m] for m in MODES])
            cells.append(f"{number(values.max())} ({number(np.median(values))})" if len(values) else "")
        print(f"| {name(partner)} | " + " | ".join(cells) + " |")
    squeeze = max(errors.within(model, p, 0, 0.1)["squeeze"].max() for p in errors.ratios)
    rest = max(errors.within(model, p, 0, 0.1)[m].max() for p in errors.ratios for m in MODES)
    print(f"\nPairs at gaps to 0.1: squeeze within {number(squeeze)} %, any relative motion within {number(rest)} %.\n")

with open(results / "claims.csv", newline="", encoding="utf-8") as file:
    approach = next(row for row in csv.DictReader(file) if row["claim"].startswith("Two spheres pressed together"))
print(f"""## Two spheres pressed together

From a gap of 0.1 to 1e-4 radii under a constant force, stepped by `pigment-consolidate`, against an accurate solution of the
differential equation with the exact resistance: {approach["ours"]}.
""")

print("## Cost of a pair\n")
if len(sys.argv) > 2:
    runs = [r for r in json.load(open(sys.argv[2]))["benchmarks"] if r["run_type"] == "iteration"]
    best = {}
    for run in runs:
        best[run["run_name"]] = max(best.get(run["run_name"], 0), run["items_per_second"])
    off = next((run["largest_error"] for run in runs if "largest_error" in run), 0)
    print("All five scalars, on one core, nanoseconds a pair: the best of ten repetitions over 100,000 random pairs\n(`bench_resistance`).\n")
    print("| | ns |\n|---|---|")
    for key, text in (("fitted", "the functions in use, with their taper"), ("leading_terms", "the source's forms"),
                      ("table", f"a table, bilinear in size and logarithm of the gap: {100 * off:.2g} % off what it was filled with")):
        print(f"| {text} | {1e9 / best[key]:.0f} |")
else:
    print("`make accuracy` measures it on the machine at hand.")
print("""
The choice: the functions. They need one logarithm and polynomials, no memory, and are smooth in gap and sizes, as the stepper's
error estimate wants. A table needs the logarithm too, reads from two distant rows for every pair, has kinks, and its error is
that of its spacing. Leading terms cost less, and are off by the tables above. Either way these scalars are found once a step
and pair, where a step solves a linear system.""")
