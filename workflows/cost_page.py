"""Prints docs/cost.md: what each study took, beside the forecast of pigment-scene for its runs: cost_page.py RESULTS STUDY...

A stage's seconds, CPU seconds and threads stand in CASE/.made/STAGE.took (timed.py), those of single measured commands in *.json (measured.py), a run's forecast
in CASE/scene.yaml. Counted are the cases that the study's claims were last decided with.
"""
import json
import os
import pathlib
import re
import sys

from took import duration, took

results, studies = pathlib.Path(sys.argv[1]), sys.argv[2:]
SECONDS = {"s": 1, "min": 60, "h": 3600, "days": 86400, "d": 86400}


def measured(folder, size):
    """CPU seconds of the commands that measured.py ran for this size; results of the other stand in a folder of its name."""
    other = {"quick": "full", "full": "quick"}.get(size)
    total = 0
    for path in sorted(folder.rglob("*.json")):
        record = json.loads(path.read_text())
        if other not in path.relative_to(folder).parts and isinstance(record, dict):
            total += record.get("cpu_seconds", 0)
    return total


rows, everything = [], 0
for study in studies:
    folder = results / study
    settings = folder / ".made" / "claims.settings"
    size, *cases = settings.read_text().split("/")[0].split() if settings.exists() else ("", *(p.name for p in sorted(folder.glob("*")) if p.is_dir()))
    stages = [s for case in cases for s in sorted((folder / case / ".made").glob("*.took"))]
    rest = measured(folder, size)
    rest += sum(took(own) for own in sorted((folder / ".made").glob("*.took")))     # claims, report
    runs = []
    for path in stages:
        scene = path.parent.parent / "scene.yaml"
        forecast = re.search(r"#\s+(\d+) particles.*?([\d.]+) (\w+) on one core", scene.read_text()) if scene.exists() else None
        if path.stem == "consolidate" and forecast and forecast[3] in SECONDS:
            runs.append((int(forecast[1]), float(forecast[2]) * SECONDS[forecast[3]], took(path)))
    total = sum(map(took, stages)) + rest
    if not total:
        rows.append(f"| {study} | not run |" + " |" * 6)
        continue
    everything += total
    line = f"| {study} | {size} | "
    if runs:
        ratios = [cpu / forecast for _, forecast, cpu in runs]
        line += (f"{len(runs)} | {min(r[0] for r in runs)}–{max(r[0] for r in runs)} | {duration(sum(r[1] for r in runs))} | {duration(sum(r[2] for r in runs))} | "
                 f"{min(ratios):.2f}–{max(ratios):.2f} | ")
    else:
        line += "| | | | | "
    rows.append(line + duration(total) + " |")
print(f"""# Cost

What each study took in CPU time, all that it ran taken together, beside what `pigment-scene` forecasts for its consolidation runs on
one core. `make cost` writes this page from the studies that have been run, here on a machine with {os.cpu_count()} cores. CPU time
hangs little on what else runs, but not nothing; a run that was stopped and gone on with counts from its last start. The forecast is for a run to its `until`; one
that comes to rest before takes less.

| study | size | runs | particles | forecast | took | took over forecast, of single runs | the whole study |
|---|---|---|---|---|---|---|---|""")
print("\n".join(rows))
print(f"\nTogether {duration(everything)}: half of that of the clock on two cores, but for what runs one at a time.")
