"""What every study's claims.py uses: where its results stand, figures fit for a paper, and the table of claims.

A claims.py reads results, draws figures and decides claims; workflows/rules.mk calls it as
    claims.py --results FOLDER --size quick|full --cases "A B" --figures "F G"
It writes FOLDER/claims.csv and FOLDER/figures/F.svg, ...: just the figures that its Makefile announces. Nothing stands
under a final name unless all of it was made. docs/making-a-study.md shows one.
"""
import argparse
import csv
import os
import pathlib
import re
import sys
from xml.sax.saxutils import escape

os.environ.setdefault("OMP_NUM_THREADS", "1")  # sums in the same order on every machine
import h5py  # noqa: E402
import matplotlib  # noqa: E402

matplotlib.use("svg")
import matplotlib.pyplot as plt  # noqa: E402

COLUMNS = ("study", "section", "claim", "source", "ours", "decided_by", "verdict")
REPRODUCED, NOT_REPRODUCED = "reproduced", "not reproduced"
NOT_DECIDABLE, FROM_INPUT = "not decidable", "follows from the input"

# One column of a two-column page is 85 mm wide; letters of 8 points in it stay legible. The same file has the same bytes
# each time: no date, and names of parts from a fixed salt. Letters are drawn as paths, so that no font is missing.
plt.rcParams.update({
    "figure.figsize": (3.35, 2.6), "figure.constrained_layout.use": True, "figure.dpi": 200,
    "font.size": 8, "axes.labelsize": 8, "axes.titlesize": 8, "legend.fontsize": 7, "xtick.labelsize": 7, "ytick.labelsize": 7,
    "axes.linewidth": 0.6, "lines.linewidth": 1.2, "lines.markersize": 3.5, "legend.frameon": False, "errorbar.capsize": 2,
    "xtick.direction": "in", "ytick.direction": "in", "xtick.top": True, "ytick.right": True,
    "axes.prop_cycle": matplotlib.cycler(color=["#0b6fb8", "#c8531c", "#2f8f4e", "#8a4fb0", "#b58900", "#0d9a9a", "#b03060", "#555555"]),
    "svg.hashsalt": "pigment", "svg.fonttype": "path", "axes.formatter.use_mathtext": True,
})


def verdict_of(holds):
    """True: reproduced, False: not reproduced, None: not decidable; a verdict in words stays."""
    if isinstance(holds, str):
        return holds
    return NOT_DECIDABLE if holds is None else REPRODUCED if holds else NOT_REPRODUCED


class Study:
    """results: folder of the study; size: quick or full; cases: list of names. Reads the command line unless told."""

    def __init__(self, arguments=None):
        parser = argparse.ArgumentParser(description="Decides a study's claims and draws its figures.")
        parser.add_argument("--results", type=pathlib.Path, required=True)
        parser.add_argument("--size", choices=("quick", "full"), required=True)
        parser.add_argument("--cases", default="", help="names in one argument, spaces between")
        parser.add_argument("--figures", default="", help="likewise: figures that are expected, without .svg")
        options = parser.parse_args(arguments)
        self.results, self.size = options.results, options.size
        self.name = options.results.resolve().name
        self.cases, self._expected = options.cases.split(), options.figures.split()
        self._figures, self._claims = {}, []

    def file(self, case, stem):
        """An open HDF5 file of a case: study.file("hll-20um", "solids")["solids/time"][:]."""
        return h5py.File(self.results / case / f"{stem}.h5", "r")

    def figure(self, name, caption, columns=1, rows=1, width=85, height=65, **options):
        """A figure of that many panels; returns (figure, axes) as plt.subplots does. width, height: millimetres a panel.
        caption: plain text for the report, with the figure of the source that it answers ("Fig. 22")."""
        if name in self._figures:
            raise SystemExit(f"{self.name}: figure {name} is drawn twice")
        figure, axes = plt.subplots(rows, columns, figsize=(width * columns / 25.4, height * rows / 25.4), **options)
        self._figures[name] = (figure, caption)
        return figure, axes

    def claim(self, section, claim, source, ours, decided_by, holds, why=""):
        """One row of the table. section of the source ("4.2"); source: what it says, with its figure; ours: what came out, with
        the number that decides; decided_by: the test, so that a reader could apply it; holds: True, False, None (not decidable)
        or FROM_INPUT; why: what was tried, and the cause that was found, which joins `ours` where the claim does not come out."""
        verdict = verdict_of(holds)
        if verdict not in (REPRODUCED, NOT_REPRODUCED, NOT_DECIDABLE, FROM_INPUT):
            raise SystemExit(f"{self.name}: verdict {verdict!r} of the claim {claim!r} is none of the four")
        if why and verdict in (NOT_REPRODUCED, NOT_DECIDABLE):
            ours += f". Why: {why}"
        row = (self.name, str(section), claim, source, ours, decided_by, verdict)
        self._claims.append([re.sub(r"\s+", " ", cell).strip() for cell in row])
        if not all(self._claims[-1]):
            raise SystemExit(f"{self.name}: the claim {claim!r} has an empty column")

    def finish(self):
        """Writes figures and claims; call it last."""
        if sorted(self._expected) != sorted(self._figures):
            raise SystemExit(f"{self.name}: drew {sorted(self._figures)}, its Makefile announces FIGURES {sorted(self._expected)}")
        folder = self.results / "figures"
        folder.mkdir(parents=True, exist_ok=True)
        for name, (figure, caption) in self._figures.items():
            part = folder / f"{name}.svg.part"
            figure.savefig(part, format="svg", dpi=300, metadata={"Date": None, "Creator": None})
            # The caption inside the file, where browsers and the report look for it.
            text = part.read_text(encoding="utf-8")
            end_of_tag = re.search(r"<svg\b[^>]*>", text).end()
            part.write_text(f"{text[:end_of_tag]}\n <title>{escape(caption)}</title>{text[end_of_tag:]}", encoding="utf-8")
        part = self.results / "claims.csv.part"
        with open(part, "w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(COLUMNS)
            writer.writerows(self._claims)
        for old in folder.glob("*.svg"):
            if old.stem not in self._figures:
                old.unlink()
        for name in self._figures:
            (folder / f"{name}.svg.part").replace(folder / f"{name}.svg")
        part.replace(self.results / "claims.csv")
        for row in self._claims:
            print(f"{row[-1]}: {row[2]} ({row[4]})", file=sys.stderr)
