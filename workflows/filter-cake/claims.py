"""Figures 18 to 21 and section 4.1 of [sand2010]: filter cakes under a weaker flow and Brownian motion."""
import matplotlib.pyplot as plt
import numpy as np

from cake import CAKE, Cake
from layer import Sample, both
from study import Study

study = Study()
everything = [Cake(study, c) for c in study.cases]
cakes = {c.case.rsplit("-", 1)[0]: c for c in everything if c.seed == 1}
quick = study.size == "quick"
RISES, STAYS = 0.10, 0.05      # what counts as a change and as none, of the height of the mass centre


def cake(size, flow, temperature=20, drag="stokes", extra=""):
    return cakes.get(f"{size}-q{flow}-t{temperature}-{drag}" + (f"-{extra}" if extra else ""))


def packings(size, flow, temperature=20, drag="stokes", extra=""):
    """Runs of one name from several packings, by seed."""
    return {c.seed: c for c in everything if (c.size, c.flow, c.temperature, c.drag, c.extra) == (size, flow, temperature, drag, extra)}


class Across:
    """Figures of several packings, each (value, standard error): mean, its standard error, and what the test allows for. Of several, Student's
    test (95 %, one-sided) over them; of one, two standard errors of its block means."""

    def __init__(self, figures):
        values = [v for v, _ in figures]
        s = Sample(values)
        self.n, self.mean = s.n, s.mean
        self.error, self.margin = (s.error, s.margin) if s.n > 1 else (figures[0][1], 2 * figures[0][1])

    def within(self, limit):
        """Whether the size of it is below the limit: True, False, or None where that is not decided."""
        return True if abs(self.mean) + self.margin < limit else False if abs(self.mean) - self.margin > limit else None

    def beyond(self, limit):
        return {True: False, False: True, None: None}[self.within(limit)]

    def below(self, limit):
        return True if self.mean + self.margin < limit else False if self.mean - self.margin > limit else None

    def text(self):
        return f"{100 * self.mean:+.1f} ± {100 * self.error:.1f} % ({self.n if self.n > 1 else 'one'} packing{'s' if self.n > 1 else ''})"


OVER = "Student's test over packings, 95 %, one-sided; of one packing: beyond two standard errors of block means"


def present(*found):
    return [c for c in found if c is not None]


def rises(c):
    """True, False, or None where neither is beyond two standard errors."""
    value, error = c.rise()
    return True if value - 2 * error > RISES else False if value + 2 * error < RISES else None


def text(c):
    value, error = c.rise()
    return f"{c.size} um".replace("d", "").replace("gcc um", "gcc") + f" at {c.flow:g}: {100 * value:+.0f} ± {100 * error:.0f} %"


# ---- figures
figure, axis = study.figure("fig18-rates", "Solids against height in mean diameters, 0.5 um spheres: the cake that a strong flow made, and after a weaker one (g/m2/s); "
                            "dashed: with hindered drag (Fig. 18)")
first = cake("d0.5", 1)
z, phi = first.smooth(first.before)
axis.plot(100 * phi, z / first.diameter, "k-", lw=0.8, label="before")
for k, flow in enumerate((1, 5, 10)):
    for drag, style in (("stokes", "-"), ("hindered", "--")):
        if c := cake("d0.5", flow, drag=drag):
            z, phi = c.smooth(c.after)
            axis.plot(100 * phi, z / c.diameter, style, color=f"C{k}", label=f"{flow} g/m²/s" + (", hindered" if drag == "hindered" else ""))
axis.set(xlabel="solids (vol-%)", ylabel="height (diameters)", xlim=(0, 75), ylim=(0, None))
axis.legend()

figure, axes = study.figure("fig19-thickness", f"Height after the weak flow over that of the cake before, against diameter. Left: of the cake (solids over {100 * CAKE:.0f} vol-%); right: below which 95 % of the solids lie. "
                            "Open: hindered drag (Fig. 19)", columns=2)
for axis, what, label in ((axes[0], Cake.thickness, "thickness of the cake, after / before"), (axes[1], Cake.z95, "height of 95 %, after / before")):
    for k, flow in enumerate((1, 5, 10)):
        for drag, mark in (("stokes", "o-"), ("hindered", "s--")):
            found = sorted((float(c.size[1:]), what(c, c.after) / what(c, c.before)) for c in cakes.values()
                           if c.size != "gcc" and (c.flow, c.temperature, c.drag, c.extra) == (flow, 20, drag, ""))
            if found:
                d, ratio = np.array(found).T
                axis.plot(d, ratio, mark, color=f"C{k}", mfc=f"C{k}" if drag == "stokes" else "none", label=f"{flow} g/m²/s" + (", hindered" if drag == "hindered" else ""))
    axis.axhline(1, color="0.5", lw=0.6)
    axis.set(xscale="log", xlabel="diameter (µm)", ylabel=label, ylim=(0, None))
    axis.set_xticks([0.2, 0.5, 1, 2], ["0.2", "0.5", "1", "2"])
    axis.minorticks_off()
axes[1].legend(fontsize=6)

gcc = [c for c in cakes.values() if c.size == "gcc" and c.drag == "stokes"]
figure, axes = study.figure("fig20-views", f"Cake of fine ground calcium carbonate at the end under {', '.join(f'{c.flow:g}' for c in gcc)} g/m2/s. Above: from the side, cut open, colour by diameter; below: from the top, "
                            "colour by height (Fig. 20)", columns=len(gcc), rows=2, width=75, height=75, squeeze=False)
for k, c in enumerate(gcc):
    for row, view in enumerate(("side", "top")):
        axes[row][k].imshow(plt.imread(study.results / c.case / f"{view}.png"))
        axes[row][k].set_axis_off()
    axes[0][k].set_title(f"{c.flow:g} g/m²/s")

pairs_of_temperature = [(s, q) for s in ("d0.2", "d1", "d2") for q in (1, 10) if cake(s, q) and cake(s, q, 80)]
figure, axes = study.figure("fig21-temperature", "Solids against height in diameters at the end, by temperature (Fig. 21)", columns=len(pairs_of_temperature), squeeze=False)
for axis, (s, q) in zip(axes[0], pairs_of_temperature):
    for t in (20, 40, 60, 80):
        if c := cake(s, q, t):
            z, phi = c.smooth(c.after)
            axis.plot(100 * phi, z / c.diameter, label=f"{t} °C")
    axis.set(xlabel="solids (vol-%)", ylabel="height (diameters)", xlim=(0, None), ylim=(0, 1.3 * max(c.z95(c.after) / c.diameter for c in (cake(s, q), cake(s, q, 80)))), title=f"{s[1:]} µm, {q} g/m²/s")
    axis.legend()

figure, axes = study.figure("cake-height", f"Height of the cake of fine ground calcium carbonate by place at the end: where solids around fall below {100 * CAKE:.0f} vol-%", columns=len(gcc), width=75, squeeze=False)
rough = lambda c: np.mean([c.local_height(k).std() for k in c.after[:: max(1, len(c.after) // 4)]])     # noqa: E731
for axis, c in zip(axes[0], gcc):
    height = c.local_height(c.after[-1])
    picture = axis.imshow(height.T, origin="lower", extent=(0, c.box[0], 0, c.box[1]), cmap="viridis")
    axis.set(xlabel="x (µm)", ylabel="y (µm)", title=f"{c.flow:g} g/m²/s")
    figure.colorbar(picture, ax=axis, label="height (µm)", shrink=0.9)

figure, axis = study.figure("segregation", "Mean diameter by volume against height: the packing, the cake before, and after the weak flow")


def mean_diameter(c, frames):
    z, share = c.position[frames][:, :, 2], np.broadcast_to(c.share, (len(frames), len(c.share)))
    size = np.broadcast_to(2 * c.radius * c.share, share.shape)
    edges = np.linspace(0, c.z95(frames), 9)
    return (edges[1:] + edges[:-1]) / 2, np.histogram(z, edges, weights=size)[0] / np.maximum(np.histogram(z, edges, weights=share)[0], 1e-12)


for k, c in enumerate(gcc):
    if k == 0:
        for frames, label, style in (([0], "packing", "k:"), (c.before, "before", "k-")):
            z, d = mean_diameter(c, frames)
            axis.plot(d, z, style, label=label)
    z, d = mean_diameter(c, c.after)
    axis.plot(d, z, "o-", color=f"C{k}", label=f"{c.flow:g} g/m²/s")
axis.set(xlabel="mean diameter (µm)", ylabel="height (µm)", ylim=(0, None))
axis.legend()

figure, axis = study.figure("drag", "Height of the mass centre over that in the cake, against the time since the flow became weak, over the time of diffusion d²/D: isolated drag, hindered drag, the source's noise, and coarse runs of 300 s")
for c in cakes.values():
    if c.size in ("d0.2", "d0.5") and c.temperature == 20 and c.flow in (1, 10) and c.extra in ("", "k_brown", "coarse"):
        late = c.time >= c.turn
        diffusivity = 1.380649e-23 * 293.15 / (6 * np.pi * 1.0016e-3 * 0.5e-6 * c.diameter) * 1e12
        label = f"{c.size[1:]} µm, {c.flow:g}, " + (c.extra or c.drag)
        axis.plot((c.time[late] - c.turn) * diffusivity / c.diameter**2, c.centre[late] / c.mean_centre(c.before)[0], lw=0.9, label=label,
                  ls="--" if c.drag == "hindered" else ":" if c.extra else "-")
axis.set(xlabel="time (d²/D)", ylabel="mass centre / that before", xscale="symlog")
axis.legend(fontsize=5.5)

# ---- claims
TEST = f"mass centre of the solids, its rise since the strong flow: above {100 * RISES:.0f} % or not, beyond two standard errors of block means"
some = [c for c in cakes.values() if c.size == "d0.5" and c.drag == "stokes" and not c.extra]
by_rate = {c.flow: c.rise() for c in some}
study.claim("4.1", "The absorption rate has a significant influence on the structure of the cake", "Fig. 18, text", "; ".join(text(c) for c in some),
            "rise at 1 g/m2/s above that at 10 by more than 10 % of the height, beyond two standard errors",
            bool(by_rate[1][0] - by_rate[10][0] - 2 * np.hypot(by_rate[1][1], by_rate[10][1]) > RISES))
hindered = present(*(cake("d0.5", q, drag="hindered") for q in (1, 5, 10)))
study.claim("4.1", "The same with hindered drag", "not in the source", "; ".join(text(c) for c in hindered), TEST + ", at 1 g/m2/s", rises(hindered[0]))
NO_RUN = "SIZE=quick has no such run; SIZE=full decides"
for drag in ("stokes", "hindered"):
    ends = present(cake("d0.2", 1, drag=drag), cake("d2", 1, drag=drag))
    gap, error = (ends[0].rise()[0] - ends[1].rise()[0], np.hypot(ends[0].rise()[1], ends[1].rise()[1])) if len(ends) == 2 else (0, np.inf)
    study.claim("4.1", f"The size of the particles has a significant influence on the cake ({drag} drag)", "Fig. 19, text" if drag == "stokes" else "not in the source; the drag of a packed bed",
                "; ".join(text(c) for c in ends) if len(ends) == 2 else NO_RUN, f"rise at 1 g/m2/s of 0.2 um above that of 2 um by more than {100 * RISES:.0f} %, beyond two standard errors",
                bool(gap - 2 * error > RISES) if len(ends) == 2 else None)
edges = {name: c.edge(c.after) for name, c in cakes.items() if c.extra not in ("fine", "coarse")}
sharp, gradual = min(edges, key=edges.get), max(edges, key=edges.get)
study.claim("4.1", "Both mechanisms occur: a sharp filter cake and thickening with a gradient", "Fig. 18, text", f"solids fall from 3/4 to 1/4 within {edges[sharp]:.1f} diameters ({sharp}) to {edges[gradual]:.1f} ({gradual})",
            "some run below 1.5 mean diameters and some above 3", bool(edges[sharp] < 1.5 and edges[gradual] > 3))
usual = present(cake("d0.5", 10), cake("d1", 10), cake("d2", 10), cake("gcc", 10))
study.claim("4.1", "Near industrial conditions (10 g/m2/s, pigment) a sharp cake is to be expected", "conclusion of 4.1", ", ".join(f"{c.size} {c.edge(c.after):.1f}" for c in usual) + " diameters",
            "solids fall from 3/4 to 1/4 within 2 mean diameters in each", bool(all(c.edge(c.after) < 2 for c in usual)),
            why="spheres of 0.5 um alone, which rise by a seventh; the pigment itself is sharp")
for drag in ("stokes", "hindered"):
    small = present(cake("d0.2", 10, drag=drag), cake("d0.4", 10, drag=drag))
    study.claim("4.1", f"Particles of {'200 to 400' if len(small) > 1 else '200'} nm diffuse back even at 10 g/m2/s ({drag} drag)", "Fig. 19, text" if drag == "stokes" else "not in the source; the drag of a packed bed",
                "; ".join(text(c) for c in small), TEST, both(*(rises(c) for c in small)),
                why="the drag of a packed bed is tens of times that of a lone sphere" if drag == "hindered" else "")
    if len(small) == 1:
        study.claim("4.1", f"Particles of 400 nm do so too ({drag} drag)", "Fig. 19, text" if drag == "stokes" else "not in the source; the drag of a packed bed", NO_RUN, TEST, None)
if c := cake("d0.2", 10, extra="k_brown"):
    study.claim("4.1", "The same with the source's own noise and isolated drag", "Fig. 19, text", text(c), TEST, rises(c))


def titled(drag, claim):
    return claim[0].upper() + claim[1:] if drag == "stokes" else "The same with hindered drag: " + claim


def source(drag, where):
    return where if drag == "stokes" else "not in the source"


for drag in ("stokes", "hindered"):
    large = {size: Across([c.rise() for c in packings(size, 10, drag=drag).values()]) for size in ("d1", "d2") if packings(size, 10, drag=drag)}
    study.claim("4.1", titled(drag, "cakes of large particles stay at 10 g/m2/s"), source(drag, "Fig. 19"), "; ".join(f"{size[1:]} um at 10: {a.text()}" for size, a in large.items()) or NO_RUN,
                f"rise below {100 * STAYS:.0f} % ({OVER})", both(*(a.below(STAYS) for a in large.values())) if large else None,
                why="the rise of 1 um lies too near to the limit for so few packings" if large else "")


def warming(size, flow, drag="stokes"):
    """Rise of the mass centre at 80 C less that at 20 C: each over its own cake, since no two cakes are packed alike."""
    cold, hot = (packings(size, flow, t, drag) for t in (20, 80))
    pairs = [(cold[seed].rise(), hot[seed].rise()) for seed in cold if seed in hot]
    return Across([(b[0] - a[0], np.hypot(b[1], a[1])) for a, b in pairs])


for drag in ("stokes", "hindered"):
    change = warming("d0.2", 1, drag) if cake("d0.2", 1, 20, drag) and cake("d0.2", 1, 80, drag) else None
    study.claim("4.1", titled(drag, "temperature has a notable effect on 200 nm at the lowest rate"), source(drag, "Fig. 21"), f"rise at 80 less that at 20 C, at 1 g/m2/s, of the cake {change.text()}" if change else NO_RUN,
                f"more than {100 * RISES:.0f} % ({OVER})", change.beyond(RISES) if change else None)
    found = {size: warming(size, 10, drag) for size in ("d1", "d2") if cake(size, 10, 20, drag) and cake(size, 10, 80, drag)}
    study.claim("4.1", titled(drag, "temperature has a small influence on large particles at high rates"), source(drag, "Fig. 21"),
                "; ".join(f"{size[1:]} um at 10 g/m2/s: rise at 80 less that at 20 C, of the cake {change.text()}" for size, change in found.items()) or NO_RUN,
                f"less than {100 * STAYS:.0f} % ({OVER})", both(*(change.within(STAYS) for change in found.values())) if found else None)
cold, hot = cake("d0.2", 1), cake("d0.2", 1, 80)
densest = [max(c.smooth(c.after)[1]) for c in (cold, hot)]
study.claim("4.1", "A rise in temperature makes the cake less dense and its gradient wider", "text before Fig. 21", f"densest {100 * densest[0]:.0f} to {100 * densest[1]:.0f} vol-%, edge {cold.edge(cold.after):.1f} to {hot.edge(hot.after):.1f} diameters",
            "both, from 20 to 80 C, 200 nm at 1 g/m2/s", bool(densest[1] < densest[0] and hot.edge(hot.after) > cold.edge(cold.after)))


def parting(c):
    """Rise of the fine half of the solids less that of the coarse half since the strong flow, over the mass centre before; s.e. over particles."""
    rise = c.position[c.after][:, :, 2].mean(0) - c.position[c.before][:, :, 2].mean(0)
    order = np.argsort(c.radius)
    fine = np.zeros(len(order), bool)
    fine[order[: np.searchsorted(np.cumsum(c.share[order]), 0.5)]] = True
    means, errors = [], []
    for half in (fine, ~fine):
        w = c.share[half] / c.share[half].sum()
        means.append(w @ rise[half])
        errors.append(np.sqrt(np.sum(w**2 * (rise[half] - means[-1])**2)))
    base = c.mean_centre(c.before)[0]
    return (means[0] - means[1]) / base, np.hypot(*errors) / base


parted = {c.flow: parting(c) for c in gcc}
listed = "; ".join(f"{q:g} g/m2/s: {100 * v:+.1f} ± {100 * e:.1f} %" for q, (v, e) in parted.items())
PARTING = "rise of the fine half of the solids less that of the coarse half, over the height of the mass centre, since the strong flow"
study.claim("4.1", "Size segregation takes place at 10 g/m2/s", "Fig. 20, text", listed, PARTING + "; more than two standard errors over particles (below zero: the coarse rise above the fine, whose weight in the flow is larger for their volume)",
            bool(abs(parted[10][0]) > 2 * parted[10][1]))
study.claim("4.1", "It is an effect of higher rates", "Fig. 20, text", listed, "larger at 10 than at 1 g/m2/s by more than two standard errors; the other way round: not reproduced",
            None if abs(abs(parted[10][0]) - abs(parted[1][0])) < 2 * np.hypot(parted[10][1], parted[1][1]) else bool(abs(parted[10][0]) > abs(parted[1][0])),
            why="the more a cake expands, the further its sizes come apart, and it expands at the lower rate")
study.claim("4.1", "Small particles migrate upwards to some extent", "text before Fig. 20", listed, PARTING + "; above zero by more than two standard errors at some rate", bool(any(v > 2 * e for v, e in parted.values())),
            why="the osmotic gradient of the fine lifts the coarse by their volume, and the flow holds them by their radius only")
slow = {c.flow: c for c in cakes.values() if c.size == "gcc" and c.drag == "hindered" and not c.extra}
apart = {q: parting(c) for q, c in slow.items()}
study.claim("4.1", titled("hindered", "size segregation takes place at 10 g/m2/s"), "not in the source", "; ".join(f"{q:g} g/m2/s: {100 * v:+.1f} ± {100 * e:.1f} %" for q, (v, e) in apart.items()) or NO_RUN,
            PARTING + "; more than two standard errors over particles", bool(abs(apart[10][0]) > 2 * apart[10][1]) if 10 in apart else None)
# Of a sharp cake with a rough top the mean profile has the edge of the distribution of heights: from 3/4 to 1/4 within 1.35 s.d. where it is Gaussian.
for drag, group in (("stokes", gcc), ("hindered", list(slow.values()))):
    roughness = {c.flow: rough(c) for c in group}
    ratio = {c.flow: 1.35 * roughness[c.flow] / (c.edge(c.after) * c.diameter) for c in group}
    study.claim("4.1", ("" if drag == "stokes" else "The same with hindered drag: ") + "Gradients in the mean profile may come from the roughness of the cake's top rather than thickening", "Fig. 20, text" if drag == "stokes" else "not in the source",
                "; ".join(f"{q:g} g/m2/s: roughness {roughness[q]:.2f} um, {100 * r:.0f} % of the edge" for q, r in ratio.items()) or NO_RUN,
                "1.35 s.d. of the local height make more than half of the edge of the mean profile at some rate", bool(max(ratio.values()) > 0.5) if ratio else None)
heavy, light = packings("d2", 1, extra="gravity"), packings("d2", 1)
drop = Across([(heavy[k].rise()[0] - light[k].rise()[0], np.hypot(heavy[k].rise()[1], light[k].rise()[1])) for k in heavy if k in light])
study.claim("4.1", "Gravity, which the source leaves out, changes nothing", "not in the source; 2 um spheres settle at 3.7 um/s", f"2 um at 1 g/m2/s: rise with gravity less that without, of the cake {drop.text()}",
            f"less than {100 * STAYS:.0f} % ({OVER})", drop.within(STAYS),
            why="their weight presses as a flow of 3.7 g/m2/s does, beside 1")
steps = [c for c in cakes.values() if c.extra == "fine"]
for c in steps:
    coarse = cakes[c.case.rsplit("-", 2)[0]]
    (a, ea), (b, eb) = coarse.mean_centre(coarse.after), c.mean_centre(c.after)
    study.claim("4.1", "The step of these runs is short enough", "not in the source", f"{c.size[1:]} um at {c.flow:g} g/m2/s: mass centre {100 * (a / b - 1):+.1f} ± {100 * np.hypot(ea, eb) / b:.1f} % off that at half the step",
                f"less than {100 * STAYS:.0f} % off, beyond two standard errors: what counts as no change above", bool(abs(a / b - 1) < STAYS + 2 * np.hypot(ea, eb) / b))
for c in (c for c in cakes.values() if c.extra == "coarse"):
    whole = cake(c.size, f"{c.flow:g}")
    # At the same times since the flow became weak: those of the other's last fifth.
    since = whole.time[whole.after] - whole.turn
    frames = np.flatnonzero((c.time - c.turn >= since[0]) & (c.time - c.turn <= since[-1] + 1e-9))
    (a, ea), (b, eb) = c.mean_centre(frames), whole.mean_centre(whole.after)
    took = float((study.results / c.case / ".made" / "consolidate.took").read_text().split()[0])
    study.claim("4.1", f"A coarse run is within a tenth: {c.size[1:] + ' um' if c.size != 'gcc' else c.size} at {c.flow:g} g/m2/s", "not in the source", f"mass centre {100 * (a / b - 1):+.1f} ± {100 * np.hypot(ea, eb) / b:.1f} % off that with the full noise, {since[0]:.3g} to {since[-1]:.3g} s after the strong flow; "
                f"at 300 s {100 * c.rise()[0]:+.0f} ± {100 * c.rise()[1]:.0f} % above its own cake; {len(c.radius)} spheres, {took:.0f} s", "less than 10 % off, beyond two standard errors",
                bool(abs(a / b - 1) < RISES + 2 * np.hypot(ea, eb) / b))
study.finish()
