"""Prints docs/brownian.md: page.py RESULTS COST, RESULTS = build/studies/brownian, COST = what make brownian-cost has written, if it has."""
import pathlib
import sys

from pairs import NOISES, TREATMENTS, Pairs

pairs = Pairs(pathlib.Path(sys.argv[1]))
exact = pairs.exact["fd"]
steps = sorted({step for runs in pairs.runs.values() for step in runs})


def table(quantity, index):
    print("| noise | stiff forces | the step to nothing | " + " | ".join(f"{1e3 * s:.3g} us" for s in steps) + " |")
    print("|---|---|---|" + "---|" * len(steps))
    for (noise, treatment), runs in pairs.runs.items():
        # Half a step ahead, k_brown has a drift of its own, and another limit.
        limit = "" if treatment == "midpoint" else f"{100 * (pairs.exact[noise][index] / exact[index] - 1):+.1f}"
        cells = [f"{100 * (getattr(runs[s], quantity) / exact[index] - 1):+.1f} ± {100 * getattr(runs[s], quantity + '_error') / exact[index]:.1f}" if s in runs else "" for s in steps]
        print(f"| {NOISES[noise]} | {TREATMENTS[treatment]} | {limit} | " + " | ".join(cells) + " |")
    print()


def off(gaps):
    """Mean and standard deviation off their exact values, in words."""
    return (f"{100 * (gaps.mean / exact[0] - 1):+.1f} ± {100 * gaps.mean_error / exact[0]:.1f} % (standard deviation "
            f"{100 * (gaps.deviation / exact[1] - 1):+.1f} ± {100 * gaps.deviation_error / exact[1]:.1f} %)")


WELL = 200e-9  # m: how far the attraction of pairs.yaml reaches


def kept(gaps):
    """The same; or that pairs do not stay in their wells."""
    return off(gaps) if gaps.mean < WELL else f"none: pairs leave their wells of {1e9 * WELL:.0f} nm (mean gap {1e9 * gaps.mean:.0f} nm)"


default = pairs.default
print(f"""# Error of Brownian motion against the step

`make brownian` writes this page from `make study-brownian`, which draws the same (`weak-error`).

200 pairs of spheres of 0.5 um at 25 degC, each in a well of 14 kT: DLVO (25 mV, 5 nm, 1e-21 J) and a weak attraction over 200 nm, with
exact lubrication. The gap has Boltzmann's distribution, mean {1e9 * exact[0]:.2f} nm and standard deviation {1e9 * exact[1]:.2f} nm by
integration. The tables hold what each noise and each treatment of the stiff forces has in its place, over the exact value, in per cent, with the standard
error of the run (24 ms each). "The step to nothing" is the integral of what a scheme samples in the limit (docs/physics.md): what no shorter step mends.
Explicit steps beyond 2 R/K, K the stiffness of the gap, blow up.

## Mean gap, per cent off
""")
table("mean", 0)
print("## Standard deviation of the gap, per cent off\n")
table("deviation", 1)
print(f"""## The rule for the step

Near contact gap, force and noise are made dimensionless by the Debye length l and the time l c/kT, c = 6 pi mu R^2, R the reduced radius; dt kT/(l c) sets
the error whatever the sizes. The default takes 0.25 of it for the smallest particles: {1e3 * default.step * 1e3:.0f} us here, where the mean gap is {100 * (default.mean / exact[0] - 1):+.1f} ±
{100 * default.mean_error / exact[0]:.1f} % and its standard deviation {100 * (default.deviation / exact[1] - 1):+.1f} ± {100 * default.deviation_error / exact[1]:.1f} % off (240 ms). The step goes
with the Debye length and with the square of the radius.

## The long runs of `make brownian-cost`

The same pairs at the steps and with the options of those runs (240 ms), mean gap off its exact value. Steps are means: one that finds no solution is made in halves.

| | step | mean gap |
|---|---|---|
| fluctuation_dissipation, with rotation | {1e3 * pairs.long.step * 1e3:.0f} us | {off(pairs.long)} |
| without rotation, solves to 1e-2 (`lean.options`) | {1e3 * pairs.lean.step * 1e3:.0f} us | {off(pairs.lean)} |
| and without lubrication, k_brown in linearly implicit steps, solves to a half (`coarse.options`) | {1e3 * pairs.coarse.step * 1e3:.0f} us | {kept(pairs.coarse)} |

Without lubrication the two noises are one, and without attraction what stands in the tables above does not bind it: what such steps cost in a cake of repulsive
spheres is in the second table below.""")
cost = pathlib.Path(sys.argv[2])
if cost.exists():
    print("\n## What long runs cost\n\n" + cost.read_text().strip())
