"""Prints docs/cost.md: what the runs of each study took, beside the forecast of pigment-scene: cost_page.py RESULTS STUDY...

A run's seconds and threads stand in CASE/.made/took (workflows/rules.mk), its forecast in CASE/scene.yaml.
"""
import os
import pathlib
import re
import sys

results, studies = pathlib.Path(sys.argv[1]), sys.argv[2:]
SECONDS = {"s": 1, "min": 60, "h": 3600, "days": 86400, "d": 86400}


def duration(seconds):
    return f"{seconds:.0f} s" if seconds < 120 else f"{seconds / 60:.1f} min" if seconds < 7200 else f"{seconds / 3600:.1f} h"


rows, missing = [], []
for study in studies:
    runs = []
    for took in sorted((results / study).glob("*/.made/took")):
        scene = took.parent.parent / "scene.yaml"
        forecast = re.search(r"#\s+(\d+) particles.*?([\d.]+) (\w+) on one core", scene.read_text()) if scene.exists() else None
        if forecast and forecast[3] in SECONDS:
            seconds, threads = took.read_text().split()
            runs.append((int(forecast[1]), float(forecast[2]) * SECONDS[forecast[3]], int(seconds), threads))
    if runs:
        ratios = [took / forecast for _, forecast, took, _ in runs]
        threads = {t for *_, t in runs}
        rows.append(f"| {study} | {len(runs)} | {min(r[0] for r in runs)}–{max(r[0] for r in runs)} | {duration(sum(r[1] for r in runs))} | {duration(sum(r[2] for r in runs))} | "
                    f"{min(ratios):.2f}–{max(ratios):.2f} | {' or '.join(sorted(threads))} |")
    elif (results / study).is_dir():
        missing.append(study)
print(f"""# Cost

What the consolidation runs of each study took, beside what `pigment-scene` forecasts for one core. `make cost` writes this page
from the studies that have been run, here on a machine with {os.cpu_count()} cores; times mean something where nothing else ran beside
them. Times are of the clock, with the threads given; a run that was stopped and gone on with counts from its last start. The
forecast is for a run to its `until`; one that comes to rest before takes less.

| study | runs | particles | forecast, one core | took | took over forecast, of single runs | threads |
|---|---|---|---|---|---|---|""")
print("\n".join(rows))
if missing:
    print(f"\nNo consolidation runs of their own: {', '.join(missing)}.")
