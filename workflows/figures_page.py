"""Writes docs/studies/STUDY.md and the figures it shows from a study that has been run: figures_page.py RESULTS STUDY DOCS."""
import csv
import html
import pathlib
import re
import sys

from took import duration, took

MOST = 600_000      # bytes of a figure: sections of thousands of particles take more
results, study, docs = pathlib.Path(sys.argv[1]), sys.argv[2], pathlib.Path(sys.argv[3])
figures = sorted((results / study / "figures").glob("*.svg"))
if not figures:
    raise SystemExit(f"{results / study}: no figures; run make study-{study} first")
size, *settings = (results / study / ".made" / "claims.settings").read_text().split()
cases = [name for name in settings if (results / study / name / "scene.yaml").exists()]
with open(results / study / "claims.csv", newline="", encoding="utf-8") as file:
    claims = list(csv.DictReader(file))
# Which random packings, where cases name theirs.
seeds = sorted({m[1] for case in cases if (m := re.search(r"-s(\d+)(?:-|$)", case))})
packings = f' SEEDS="{" ".join(seeds)}"' if seeds else ""
runs = {case: took(record) for case in cases if (record := results / study / case / ".made" / "consolidate.took").exists()}
cost = ""
if runs:
    dearest = max(runs, key=runs.get)
    cost = f" Their consolidation took {duration(sum(runs.values()))} of CPU time, `{dearest}` the most of it, {duration(runs[dearest])}."
folder = docs / "images" / study
folder.mkdir(parents=True, exist_ok=True)
(docs / "studies").mkdir(exist_ok=True)
for old in folder.glob("*.svg"):
    old.unlink()

readme = pathlib.Path(__file__).parent / study / "README.md"
title, _, about = (readme.read_text(encoding="utf-8") if readme.exists() else f"# {study}\n").partition("\n")
about = about.strip().split("\n\n")[0].replace("](../", "](../../workflows/")     # its links are those of the study's own folder
lines = [title, "", about, "",
         f"`make study-{study} SIZE={size}{packings}` ran what follows, {len(cases)} cases; `make figures-{study}` wrote this page.{cost} "
         f"[All claims](../claims.md#{study}), from runs of either size.", "",
         "<details><summary>The cases that ran</summary>", "", ", ".join(cases), "", "</details>", "",
         "| § | claim | ours | decided by | verdict |", "|---|---|---|---|---|"]
lines += ["| " + " | ".join(row[c].replace("|", "\\|") for c in ("section", "claim", "ours", "decided_by")) + f" | **{row['verdict']}** |" for row in claims]
for path in figures:
    text = path.read_text(encoding="utf-8")
    caption = html.unescape(re.search(r"<title>(.*?)</title>", text, re.DOTALL)[1])
    if len(text) > MOST:
        lines += ["", f"*{caption}: too large a drawing for this page; the study's report has it*"]
        continue
    (folder / path.name).write_text(text, encoding="utf-8")
    lines += ["", f"![{path.stem}](../images/{study}/{path.name})", "", f"*{caption}*"]
(docs / "studies" / f"{study}.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
