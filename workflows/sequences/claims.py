"""Beyond [sand2010]: which sequence of strong and weak evaporation leaves the most open top."""
import numpy as np

from layer import STUDENT, UM, Layer, Sample
from study import Study

study = Study()
runs = {c: Layer(study, c) for c in study.cases}
names = list(dict.fromkeys(c.split("-")[1] for c in study.cases))
seeds = lambda q: [r for c, r in runs.items() if c.split("-")[1] == q]     # noqa: E731
EQUAL = 0.32    # s, two thirds of the sequence
# At the solids that all reach, so that what is compared has lost as much liquid; and half-way to it, where gradients are largest.
SOLIDS, HALFWAY = min(float(r.mean_wt[-1]) for r in runs.values()), 75
at_solids = lambda wt: lambda r: int(np.argmin(np.abs(r.mean_wt - wt)))     # noqa: E731
moments = {f"at {EQUAL:g} s": lambda r: r.frame(EQUAL), f"when the layer has {HALFWAY} wt-%": at_solids(HALFWAY), f"when the layer has {SOLIDS:.1f} wt-%": at_solids(SOLIDS)}
then, halfway, end = moments
skin = {when: {q: [r.skin(frame(r)) for r in seeds(q)] for q in names} for when, frame in moments.items()}


def spread(when, q):
    """Of a sequence, top over middle: mean, and the standard error of what it differs by from the mean of all sequences in the same packing, since
    packings differ more than sequences do."""
    mean_of_all = np.mean([skin[when][other] for other in names], axis=0)
    return np.mean(skin[when][q]), Sample(np.array(skin[when][q]) - mean_of_all).error


def listed(when):
    return ", ".join(f"{q.upper()} {m:.1f} ± {e:.1f}" for q, (m, e) in ((q, spread(when, q)) for q in ranking)) + f" {when}"


def difference(one, other, when):
    return Sample(np.array(skin[when][one]) - np.array(skin[when][other]))


ranking = sorted(names, key=lambda q: np.mean(skin[end][q]))
s = difference("hll", "llh", end)
study.claim("4.2", "Of sequences that evaporate as much, late drying (LLH) leaves a more open top than early drying (HLL)", "not in the source; its section 4.2 asks for it",
            f"solids 0.5 to 2 um below the surface over the middle, HLL less LLH: {s.text(2)} wt-% {end}; {difference('hll', 'llh', halfway).text(2)} {halfway}", f"above 0 at the end ({STUDENT})", s.above(),
            why=f"what sequences leave evens out: tops differ by {abs(difference('hll', 'llh', halfway).mean):.1f} wt-% {halfway} and by {abs(s.mean):.1f} {end}")
best, second = ranking[:2]
s = difference(second, best, end)
study.claim("4.2", f"The most open top of {len(names)} sequences is that of {best.upper()}", "not in the source",
            "from open to dense, wt-% (± of what differs in the same packing): " + "; ".join(listed(when) for when in (end, halfway, then)), f"below the next one, {second.upper()}, at the end ({STUDENT})", s.above(),
            why=f"the two differ by {s.mean:.2f} ± {s.error:.2f} wt-% at the end, as gradients even out; earlier by more, in another order")

figure, axes = study.figure("sequences", f"Liquid lost by evaporation sequence (thirds of 0.48 s; high, low, middling), and what it leaves: solids 0.5 to 2 um below the surface over those in the middle, less the packing's; mean of {len(seeds(names[0]))} packings, bars: standard error of what sequences differ by in the same packing", columns=2, height=75)
for i, q in enumerate(names):
    with study.file(seeds(q)[0].case, "dewatering") as f:
        axes[0].plot(f["dewatering/time"][:], (f["dewatering/absorbed"][:] + f["dewatering/evaporated"][:]) / UM, color=f"C{i}", label=q.upper())
axes[0].axvline(EQUAL, color="0.6", lw=0.5)
axes[0].set(xlabel="time (s)", ylabel="liquid lost (µm)", xlim=(0, 0.48), ylim=(0, 12))
axes[0].legend(ncols=2, loc="upper left")
for k, when in enumerate(moments):
    values = [spread(when, q) for q in ranking]
    axes[1].errorbar([m for m, _ in values], np.arange(len(ranking)) + 0.2 * (k - 1), xerr=[e if np.isfinite(e) else 0 for _, e in values], fmt="o^s"[k], label=when)
axes[1].set(yticks=range(len(ranking)), yticklabels=[q.upper() for q in ranking], xlabel="top over middle (wt-%)", ylim=(-0.6, len(ranking) + 1.2))
axes[1].tick_params(axis="y", length=0)
axes[1].axvline(0, color="0.6", lw=0.5)
axes[1].legend(loc="upper right")
figure, axes = study.figure("profiles", f"Solids against height by evaporation sequence, mean of {len(seeds(names[0]))} packings: at one time, and when all have lost as much liquid (band: standard error, of the most open and the densest top)", columns=3, width=65)
for axis, (title, frame) in zip(axes, moments.items()):
    for i, q in enumerate(names):
        group = seeds(q)
        rows = np.array([r.wt[frame(r)] for r in group])
        edges = np.mean([r.edges[frame(r)] for r in group], axis=0) / UM
        mean, error, height = rows.mean(axis=0), rows.std(axis=0) / np.sqrt(max(1, len(rows) - 1)), (edges[1:] + edges[:-1]) / 2
        axis.plot(mean, height, color=f"C{i}", lw=0.9, label=q.upper())
        if q in (ranking[0], ranking[-1]):
            axis.fill_betweenx(height, mean - error, mean + error, color=f"C{i}", alpha=0.2, lw=0)
    axis.set(xlabel="solids (wt-%)", ylabel="height (µm)", ylim=(0, None), xlim=(55, 90), title=title)
axes[0].legend(loc="upper left", handlelength=1)
study.finish()
