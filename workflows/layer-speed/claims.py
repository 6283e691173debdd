"""What a whole layer costs and how far it is off: layer.csv, and the claims on both."""
import csv
import os
import re

import numpy as np

from run_errors import MEASURES, differences, mean_state, state
from study import Study

COMPARED = 0.3        # s: when the layers are held against one another
SECONDS = 20.0        # for a layer of 30 um
study = Study()
full = study.size == "full"
layer = study.cases[0]
screened = f"{layer}-1nm"
packings = [c for c in study.cases if re.search(r"-s\d+$", c)]    # of a layer and of its converged run, by seed, beside the first
references = sorted((c for c in study.cases if c.startswith(f"{layer}-tolerance-") and c not in packings), key=lambda c: float(c.split("-tolerance-")[1]))
finest = references[0]
of_finest = finest.removeprefix(layer)
for_errors = (*references, *packings, *(c for c in study.cases if c.startswith(f"{screened}-tolerance-")))    # whose times do not count


def text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


def look(case):
    seconds, cpu, threads = (study.results / case / ".made" / "consolidate.took").read_text().split()
    with study.file(case, "trajectory") as f:
        steps, time, seen = f["particles/layer/position/step"][:], f["particles/layer/position/time"][:], f["observables"]
        return {"run": case, "particles": len(f["particles/layer/radius"]), "seconds": float(seconds), "cpu_seconds": float(cpu), "threads": threads, "steps": int(steps[-1]),
                "outcome": text(f["pigment"].attrs["outcome"]), "end": float(time[-1]), "solids": float(seen["solids_mass_fraction/value"][-1]),
                "smallest_gap_nm": 1e9 * float(seen["minimum_gap/value"][:].min()), "time": time, "step": steps}


runs = {case: look(case) for case in study.cases}
states = {case: state(study, case, COMPARED) for case in (layer, screened, *for_errors) if runs[case]["end"] >= COMPARED - 1e-6}
for case in references[1:] + [layer]:
    runs[case] |= differences(states[case], states[finest]) if case in states else {}
if screened + of_finest in states:
    runs[screened] |= differences(states[screened], states[screened + of_finest])
columns = ["run", "particles", "threads", "seconds", "cpu_seconds", "steps", "outcome", "end", "solids", "smallest_gap_nm", *(key for key, *_ in MEASURES)]
part = study.results / "layer.csv.part"
with open(part, "w", newline="") as file:
    writer = csv.DictWriter(file, columns, lineterminator="\n", restval="", extrasaction="ignore")
    writer.writeheader()
    writer.writerows(runs.values())
part.replace(study.results / "layer.csv")

# ---- wall time. It counts on two cores, at the size that was asked for, where the run had both.
alone = full and os.cpu_count() == 2 and all(runs[c]["threads"] in ("all", "2") for c in study.cases if c not in for_errors)
where = "wall time of pigment-consolidate with 2 threads on 2 cores and nothing beside it; SIZE=full, without -j"
RESTED = ("immobile", "first_critical_concentration")
thin_layer, thinner, charged, uncharged = (runs[c] for c in study.cases if c != layer and c not in for_errors)
spent = lambda r: f"{r['seconds']:.1f} s ({r['cpu_seconds']:.1f} s of CPU time), {r['steps']} steps, {r['outcome']} at {r['end']:.3f} s"    # noqa: E731
r = runs[layer]
study.claim("3.4", f"A layer dries from 65 wt-% to rest within {SECONDS:g} s", "none", f"{r['particles']} particles: {spent(r)}", f"at most {SECONDS:g} s, at rest; {where}",
            bool(r["seconds"] <= SECONDS and r["outcome"] in RESTED) if alone else None)
study.claim("3.4", "A double layer of 1 nm takes at most three times as long", "none", spent(thin_layer), f"at most {3 * SECONDS:g} s, at rest; {where}",
            bool(thin_layer["seconds"] <= 3 * SECONDS and thin_layer["outcome"] in RESTED) if alone else None)
study.claim("3.4", "A double layer of 0.5 nm comes to rest as well", "none", spent(thinner), "at rest or at the first critical concentration, status 0; quick runs end before, SIZE=full decides",
            None if thinner["outcome"] == "until" and not full else thinner["outcome"] in RESTED)
ratio = uncharged["seconds"] / charged["seconds"]
study.claim("4.4", "Uncharged particles take at most ten times as long as particles of -25 mV", "none",
            f"{ratio:.1f} times: {spent(uncharged)}, {100 * uncharged['solids']:.1f} wt-%; {spent(charged)}, {100 * charged['solids']:.1f} wt-%", f"at most 10, both to 80 wt-%; {where}",
            bool(ratio <= 10 and min(uncharged["solids"], charged["solids"]) >= 0.8) if alone else None)
study.claim("4.4", "Uncharged particles never overlap on the way to 80 wt-%", "none", f"smallest gap of all frames {uncharged['smallest_gap_nm']:.3f} nm, to {100 * uncharged['solids']:.1f} wt-%", "above zero, to 80 wt-%",
            bool(uncharged["smallest_gap_nm"] > 0 and uncharged["solids"] >= 0.8))

# ---- error, and what chance makes of converged runs
chance = {key: max((differences(states[a], states[b])[key] for i, a in enumerate(references) for b in references[:i]), default=np.inf) for key, *_ in MEASURES}


def judge(base, what):
    # Packings that both the layer and its converged run reached the time with.
    pairs = [(one, one.replace(base, base + of_finest)) for one in study.cases if re.fullmatch(rf"{re.escape(base)}(-s\d+)?", one)]
    pairs = [(one, other) for one, other in pairs if one in states and other in states]
    each = [differences(states[one], states[other]) for one, other in pairs]
    of_means = differences(mean_state(states[one] for one, _ in pairs), mean_state(states[other] for _, other in pairs)) if pairs else {}
    for key, label, bound in MEASURES:
        error = of_means.get(key)
        among = f"means over {len(pairs)} packings; each by itself {', '.join(f'{d[key]:.3g}' for d in each)}" if len(pairs) > 1 else "one packing"
        study.claim("accuracy", f"{what} is close enough to the converged run: {label}", "none",
                    f"came to rest before {COMPARED:g} s" if error is None else f"{error:.3g} at {COMPARED:g} s ({among}); converged runs of one packing of {layer} differ by up to {chance[key]:.3g} from one another",
                    f"at most {bound:g}, against a tolerance of {finest.split('-tolerance-')[1]}", None if error is None or (error > bound and chance[key] > bound) else bool(error <= bound),
                    why="" if full else f"a difference of any size grows, as paths are chaotic, and a piece of {runs[layer]['particles']} particles leaves more of it to chance than those of SIZE=full, which decides")


judge(layer, "A whole layer")
if full:
    judge(screened, "A whole layer with a double layer of 1 nm")

figure, axis = study.figure("progress", f"Steps of whole layers against time; {runs[layer]['particles']} particles, those to 80 wt-% {charged['particles']}; with the time by the clock that each took", width=110)
for case in study.cases:
    if case in packings or case in for_errors and case not in references:
        continue
    strategy, thickness, *changed = case.split("-", 2)
    what = changed[0] if changed else "as in the drying study"
    what = f"tolerance {what.removeprefix('tolerance-')}" if case in references else f"double layer of {what.removesuffix('nm')} nm" if what.endswith("nm") else \
        f"−{what.removesuffix('mv')} mV, to 80 wt-%".replace("−0 ", "0 ") if what.endswith("mv") else what
    axis.plot(runs[case]["time"], runs[case]["step"], "--" if case in references else "-", label=f"{thickness.replace('um', ' µm')}, {what}: {runs[case]['seconds']:.0f} s")
axis.set(xlabel="time (s)", ylabel="steps", yscale="log", ylim=(10, None))
axis.legend(fontsize=5.5)
study.finish()
