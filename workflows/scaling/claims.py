"""Time per step, memory and pairs against the number of particles; scaling.csv has what was measured."""
import csv
import json

import numpy as np
from scipy.spatial import cKDTree

from study import Study

CUTOFF = 0.4  # of the smaller radius: the gap at which pair terms have faded (docs/accuracy.md)
SAMPLE = 2000
NAMES = ("steps-3", "steps-13")

study = Study()


def pairs_per_particle(layer):
    """Pairs within the cutoff over particles, from a random sample where there are many. Periodic in x and y."""
    position, radius = np.squeeze(layer["position/value"][:]), layer["radius"][:]
    edges = np.asarray(layer["box/edges/value"][-1])
    box = np.array([edges[0], edges[1], 10 * edges[2]])
    position[:, :2] %= box[:2]
    tree = cKDTree(position, boxsize=box)
    chosen = np.random.default_rng(1).permutation(len(radius))[:SAMPLE]
    near = 0
    for i in chosen:
        j = np.array(tree.query_ball_point(position[i], radius[i] + (1 + CUTOFF) * radius.max()))
        j = j[j != i]
        d = position[j] - position[i]
        d[:, :2] -= box[:2] * np.round(d[:, :2] / box[:2])
        near += np.sum(np.linalg.norm(d, axis=1) - radius[i] - radius[j] < CUTOFF * np.minimum(radius[i], radius[j]))
    return near / len(chosen) / 2


def middle(runs, what):
    return float(np.median([run[what] for run in runs]))


rows = []
for folder in sorted((p.parent for p in study.results.glob("*/steps-13-1.json")), key=lambda p: int(p.name)):
    if study.size == "quick" and int(folder.name) > 100:
        continue
    pack = json.loads((folder / "pack.json").read_text())
    short, long = ([json.loads(f.read_text()) for f in sorted(folder.glob(f"{name}-*.json"))] for name in NAMES)
    if study.size == "quick":
        short, long = short[:1], long[:1]
    row = {"name": folder.name, "status": max(run["status"] for run in (pack, *short, *long))}
    if row["status"] == 0:
        with study.file(folder.name, "packing") as f:
            layer = f["particles/layer"]
            row |= {"particles": len(layer["radius"]), "pairs_per_particle": pairs_per_particle(layer)}
        counts, iterations = [], []
        for name in NAMES:
            with study.file(folder.name, name) as f:
                counts.append(int(f["particles/layer/position/step"][-1]))
                iterations.append(counts[-1] * float(f["observables/solver_iterations/value"][-1]))
        between = counts[1] - counts[0]
        row |= {"steps": counts[1], "iterations": (iterations[1] - iterations[0]) / between,
                "seconds_per_step": (middle(long, "cpu_seconds") - middle(short, "cpu_seconds")) / between, "seconds": middle(long, "cpu_seconds"),
                "peak_memory": max(run["peak_memory"] for run in long), "pack_seconds": pack["cpu_seconds"], "pack_memory": pack["peak_memory"]}
    rows.append(row)
columns = ["name", "status", "particles", "steps", "iterations", "seconds_per_step", "seconds", "peak_memory", "pack_seconds", "pack_memory", "pairs_per_particle"]
part = study.results / "scaling.csv.part"
with open(part, "w", newline="") as file:
    writer = csv.DictWriter(file, columns, lineterminator="\n", restval="")
    writer.writeheader()
    writer.writerows(rows)
part.replace(study.results / "scaling.csv")

good = [r for r in rows if r["status"] == 0]
n, step, iterations, memory, packing, pairs = (
    np.array([r[c] for r in good]) for c in ("particles", "seconds_per_step", "iterations", "peak_memory", "pack_seconds", "pairs_per_particle"))
large = n > 8000


def exponent(values):
    """Slope of log values against log n from 1e4 particles on; None with fewer than two such."""
    use = large & (values > 0)
    return np.polyfit(np.log(n[use]), np.log(values[use]), 1)[0] if use.sum() > 1 else None


figure, axes = study.figure("scaling", "Time of one step, of packing, and memory against the number of particles (Figs 8, 9)", columns=2)
axes[0].loglog(n, step, "o-", label="one step")
axes[0].loglog(n, packing, "s-", label="packing")
axes[0].loglog(n, step[-1] * n / n[-1], "k:", label="linear")
axes[0].set(xlabel="particles", ylabel="CPU time (s), one thread")
axes[0].legend()
axes[1].semilogx(n, memory / n / 1e3, "o-")
axes[1].axhline(3, color="k", linestyle=":")
axes[1].set(xlabel="particles", ylabel="largest resident memory (kB per particle)", ylim=(0, None))

reached = f"{n.min():,} to {n.max():,} particles"
failed = [r["name"] for r in rows if r["status"]]
slope = exponent(step)
study.claim("3.4", "Time per step is linear in the number of particles", "Figs 8, 9; O(N log N)",
            f"exponent {slope:.3f}, {reached}; of the iterations a step {exponent(iterations):.3f}, of the time an iteration "
            f"{exponent(step / iterations):.3f}" if slope else reached, "exponent fitted from 1e4 particles on at most 1.05",
            None if slope is None else bool(slope <= 1.05),
            why="what a layer of tens of thousands of particles keeps in the processor's cache a larger one fetches from memory; iterations a step do not grow")
growth = (memory[-1] - memory[0]) / (n[-1] - n[0])
study.claim("3.4", "Memory is linear, at most 3 kB a particle at 41 vol%", "Table 2", f"{growth / 1e3:.2f} kB for each further particle, {memory[-1] / n[-1] / 1e3:.2f} kB in all at {n[-1]:,}",
            "both at most 3 kB", bool(max(growth, memory[-1] / n[-1]) <= 3000))
blocks = 1 + 2 * pairs[-1]
study.claim("3.4", "The matrix is filled to about 37/N", "37/N", f"{blocks:.1f}/N: {pairs[-1]:.2f} pairs a particle within {CUTOFF} of the smaller radius",
            "blocks a row, 1 + 2 pairs a particle, within a factor of 2 of 37", bool(18.5 <= blocks <= 74),
            why="the source's cutoff is longer; what that of lubrication changes is measured by study-accuracy")
study.claim("3.4", "A million particles can be stepped", "1e6 is beyond the source", f"{n.max():,} particles, {good[-1]['steps']} steps; failed: {failed or 'none'}",
            "at least 10 steps of 9e5 or more particles; decided by SIZE=full", None if study.size == "quick" else bool(n.max() >= 9e5 and good[-1]["steps"] >= 10 and not failed))
study.finish()
