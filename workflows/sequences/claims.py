"""Beyond [sand2010]: which sequence of strong and weak evaporation leaves the most open top."""
import numpy as np

from layer import STUDENT, UM, Layer, Sample
from study import Study

study = Study()
runs = {c: Layer(study, c) for c in study.cases}
names = list(dict.fromkeys(c.split("-")[1] for c in study.cases))
seeds = lambda q: [r for c, r in runs.items() if c.split("-")[1] == q]     # noqa: E731
EQUAL = 0.32    # s, two thirds of the sequence
then = lambda r: r.skin(r.frame(EQUAL))           # noqa: E731
# At the solids that all reach, so that what is compared has lost as much liquid.
SOLIDS = min(float(r.mean_wt[-1]) for r in runs.values())
last = lambda r: r.skin(int(np.argmin(np.abs(r.mean_wt - SOLIDS))))          # noqa: E731
at_time, at_end = ({q: Sample(what(r) for r in seeds(q)) for q in names} for what in (then, last))
ranking = sorted(names, key=lambda q: at_end[q].mean)
s = Sample(last(a) - last(b) for a, b in zip(seeds("hll"), seeds("llh")))
study.claim("4.2", "Of sequences that evaporate as much, late drying (LLH) leaves a more open top than early drying (HLL)", "not in the source; its section 4.2 asks for it",
            f"solids 0.5 to 2 um below the surface over the middle, at {SOLIDS:.1f} wt-% of the whole layer: HLL {at_end['hll'].text()}, LLH {at_end['llh'].text()} wt-%", f"HLL less LLH above 0 ({STUDENT})", s.above())
best, second = ranking[:2]
s = Sample(last(a) - last(b) for a, b in zip(seeds(second), seeds(best)))
study.claim("4.2", f"The most open top of {len(names)} sequences is that of {best.upper()}", "not in the source",
            f"from open to dense, at {SOLIDS:.1f} wt-% of the whole layer: " + ", ".join(f"{q.upper()} {at_end[q].text()}" for q in ranking) + f" wt-%; at {EQUAL:g} s: " + ", ".join(f"{q.upper()} {at_time[q].text()}" for q in ranking),
            f"below the next one, {second.upper()} ({STUDENT})", s.above())

figure, axis = study.figure("sequences", "Solids 0.5 to 2 um below the surface over those in the middle, less the packing's, by evaporation sequence (thirds of 0.48 s; high, low, middling); bars: standard error")
for k, (what, label) in enumerate(((at_time, f"at {EQUAL:g} s"), (at_end, f"at {SOLIDS:.1f} wt-%"))):
    axis.errorbar([what[q].mean for q in ranking], np.arange(len(ranking)) + 0.2 * k, xerr=[what[q].error if what[q].n > 1 else 0 for q in ranking], fmt="o", label=label)
axis.set(yticks=range(len(ranking)), yticklabels=[q.upper() for q in ranking], xlabel="top over middle (wt-%)")
axis.axvline(0, color="0.6", lw=0.5)
axis.legend()
figure, axis = study.figure("profiles", f"Solids against height at {EQUAL:g} s by evaporation sequence")
for i, q in enumerate(names):
    r = seeds(q)
    k = r[0].frame(EQUAL)
    axis.plot(np.mean([x.wt[x.frame(EQUAL)] for x in r], axis=0), (r[0].edges[k][1:] + r[0].edges[k][:-1]) / 2 / UM, color=f"C{i}", label=q.upper())
axis.set(xlabel="solids (wt-%)", ylabel="height (µm)", ylim=(0, None))
axis.legend()
study.finish()
