"""Figures 2, 3, 12 and 13 of [sand2010], and whether minima, barriers and forces are where theory puts them."""
import pathlib

import numpy as np
from scipy.optimize import brentq, minimize_scalar

from study import Study

study = Study()
EPSILON = 8.8541878128e-12 * 80      # CODATA 2018; permittivity of Table 3
HAMAKER, WAVELENGTH, COLLISION = 1e-21, 100e-9, 0.5e-9
REDUCED = 0.25e-6                    # a1 a2/(a1 + a2) of two spheres of radius 0.5 um
NM = 1e-9


# ---- theory, from the equations as docs/physics.md reads them
def electrostatic(h, debye, psi):    # (17), as an energy
    return 4 * np.pi * EPSILON * REDUCED * psi**2 * np.log1p(np.exp(-h / debye))


def van_der_waals(h):                # (19), as an energy
    return -HAMAKER * REDUCED * WAVELENGTH / (6 * h * (WAVELENGTH + 11.116 * h))


def born(h):                         # [ruckenstein1976, feke1984]
    return HAMAKER * COLLISION**6 * REDUCED / (1260 * h**7)


def dlvo(h, debye, psi):
    return electrostatic(h, debye, psi) + van_der_waals(h)


def extremum(energy, low, high, sign):
    """Gap and energy of the minimum (sign 1) or maximum (-1) between two gaps: scanned, then refined."""
    h = np.geomspace(low, high, 4001)
    k = int(np.argmin(sign * energy(h)))
    if k in (0, len(h) - 1):
        return None
    found = minimize_scalar(lambda log_h: sign * energy(np.exp(log_h)), bounds=(np.log(h[k - 1]), np.log(h[k + 1])),
                            method="bounded", options={"xatol": 1e-10})
    return np.exp(found.x), energy(np.exp(found.x))


# ---- ours: curves of pigment-interactions
class Curves:
    def __init__(self, case):
        with study.file(case, "interactions") as f:
            self.gap = f["interactions/gap"][:]
            self.kt = float(f["interactions"].attrs["thermal_energy"])
            self.energy = {law: f[f"interactions/pair/{law}/energy"][0] for law in f["interactions/pair"] if f"interactions/pair/{law}/energy" in f}
            self.force = {law: f[f"interactions/pair/{law}/force"][0] for law in self.energy}

    def dlvo(self):
        return self.energy["electrostatic"] + self.energy["van_der_waals"]

    def dlvo_force(self):
        return self.force["electrostatic"] + self.force["van_der_waals"]

    def zero_of(self, force, low, high, rising):
        """Gap at which the force crosses zero, linear between points in the logarithm of the gap; rising: from - to +."""
        for k in range(len(self.gap) - 1):
            if not low <= self.gap[k] <= high:
                continue
            a, b = force[k], force[k + 1]
            if (a < 0 <= b) if rising else (a > 0 >= b):
                t = a / (a - b)
                return float(np.exp((1 - t) * np.log(self.gap[k]) + t * np.log(self.gap[k + 1])))
        return None

    def extremum(self, energy, force, low, high, rising):
        """At the zero of the force: gap, and energy by Hermite interpolation between the two points around it."""
        h = self.zero_of(force, low, high, rising)
        if h is None:
            return None
        k = int(np.searchsorted(self.gap, h)) - 1
        width = self.gap[k + 1] - self.gap[k]
        t = (h - self.gap[k]) / width
        value = ((1 + 2 * t) * (1 - t)**2 * energy[k] - t * (1 - t)**2 * width * force[k]
                 + t * t * (3 - 2 * t) * energy[k + 1] - t * t * (t - 1) * width * force[k + 1])
        return h, float(value)


debyes, potentials = (2.5, 5, 10), (0, 3, 5, 10, 25, 50)
curves = {(d, p): Curves(f"kappa-{d}-psi-{p}") for d in debyes for p in potentials}
kt = curves[5, 25].kt


def barrier(d, p):
    c = curves[d, p]
    return c.extremum(c.dlvo(), c.dlvo_force(), 0.05 * NM, 30 * NM, rising=True)  # attraction inside, repulsion outside


def secondary(d, p):
    c = curves[d, p]
    return c.extremum(c.dlvo(), c.dlvo_force(), 5 * NM, 500 * NM, rising=False)


# The curves have 100 points a decade: an extremum's gap is found to 0.1 % between them, its energy far better.
GAP, ENERGY = 2e-3, 5e-4
TEST = "position within 0.2 %, energy within 0.05 % of the extremum of (17) + (19), found independently"


def agrees(ours, theory):
    return ours is not None and theory is not None and abs(ours[0] / theory[0] - 1) < GAP and abs(ours[1] / theory[1] - 1) < ENERGY


def text(found):
    return "none" if found is None else f"{found[1] / kt:.3g} kT at {found[0] / NM:.3g} nm"


theory = extremum(lambda h: dlvo(h, 5 * NM, 25e-3), 20 * NM, 200 * NM, 1)
study.claim("2.2.2", "The DLVO energy has a secondary minimum where theory puts it (1/kappa = 5 nm, psi = 25 mV, d = 1 um)",
            f"Fig. 2 prints no number; (17) and (19) give {text(theory)}", text(secondary(5, 25)), TEST, agrees(secondary(5, 25), theory))
theory = extremum(lambda h: dlvo(h, 5 * NM, 25e-3), 0.1 * NM, 20 * NM, -1)
study.claim("2.2.2", "An energy barrier separates primary and secondary minimum (same pair, before Born repulsion)",
            f"Fig. 2 prints no number; (17) and (19) give {text(theory)}", text(barrier(5, 25)), TEST, agrees(barrier(5, 25), theory))

pairs = [(p, barrier(10, p), extremum(lambda h: dlvo(h, 10 * NM, p * 1e-3), 0.1 * NM, 30 * NM, -1)) for p in (3, 5, 10, 25)]
study.claim("2.2.2", "The barrier grows with the surface potential, so that aggregation sets in at a few mV (1/kappa = 10 nm)",
            "; ".join(f"{p} mV: {t[1] / kt:.3g} kT" for p, _, t in pairs) + ", by (17) and (19)",
            "; ".join(f"{p} mV: {o[1] / kt:.3g} kT" for p, o, _ in pairs if o), TEST, all(agrees(o, t) for _, o, t in pairs))

holds = all((secondary(d, p) is None) == (extremum(lambda h: dlvo(h, d * NM, p * 1e-3), 5 * NM, 499 * NM, 1) is None)
            and (secondary(d, p) is None or agrees(secondary(d, p), extremum(lambda h: dlvo(h, d * NM, p * 1e-3), 5 * NM, 499 * NM, 1)))
            for d in debyes for p in potentials if p)
moves = all(secondary(2.5, p)[0] < secondary(5, p)[0] < secondary(10, p)[0] for p in (25, 50))
study.claim("2.2.2", "A thicker double layer moves the secondary minimum outwards and makes it shallower",
            "Fig. 2: several double layer thicknesses and surface charges",
            "; ".join(f"{d} nm: {text(secondary(d, 25))}" for d in debyes) + " (25 mV)",
            TEST + ", in all 15 cases; order of the gaps", holds and moves)

# Primary minimum of DLVO + Born at psi = 0, where it can be worked out: without retardation h = sigma/30^(1/6), depth
# (6/7) A R/(6 h). Retardation takes from the attraction at 0.28 nm; the exact place is the zero of the summed force.
c = curves[5, 0]
ours = c.extremum(c.energy["total"], c.force["total"], 0.2 * NM, 1 * NM, rising=False)
unretarded = COLLISION / 30**(1 / 6)
force_at = lambda h: 7 * born(h) / h + (van_der_waals(h * (1 - 1e-6)) - van_der_waals(h * (1 + 1e-6))) / (2e-6 * h)
at = brentq(force_at, 0.5 * unretarded, 2 * unretarded, xtol=1e-18)
depth = born(at) + van_der_waals(at)
study.claim("3.3", "Born repulsion leaves a finite primary minimum (psi = 0)",
            f"\"An additional mechanical interaction model ... mimicking Born repulsion, is needed\"; theory {depth / kt:.3f} kT at {at / NM:.4f} nm "
            f"(without retardation {-HAMAKER * REDUCED / (7 * unretarded) / kt:.3f} kT at {unretarded / NM:.4f} nm)",
            f"{ours[1] / kt:.3f} kT at {ours[0] / NM:.4f} nm", "depth within 1 % of the analytic minimum of (19) + Born", abs(ours[1] / depth - 1) < 0.01)

found = [(d, p, curves[d, p].zero_of(curves[d, p].dlvo_force(), 5 * NM, 500 * NM, rising=False), secondary(d, p)) for d in debyes for p in (10, 25, 50)]
spread = []
for d, p, zero, _ in found:
    k = int(np.argmin(np.where(curves[d, p].gap > 5 * NM, curves[d, p].dlvo(), np.inf)))
    spread.append(abs(np.log(curves[d, p].gap[k] / zero)))
study.claim("3.3.1", "The force is zero at the secondary minimum of the energy", "Fig. 13, caption",
            f"the two are at most {100 * max(spread):.2g} % apart", "the lowest point of the energy curve lies within one point of the curves (2.3 %) of the force's zero, in 9 cases",
            max(spread) < 0.0233)

# ---- steric
steric = Curves("steric")
layer, s = 5 * NM, 2 * REDUCED
f, h = steric.force["steric"], steric.gap
inside = (h > layer / 20) & (h < layer)
outside = (h > layer) & (h < 2 * layer)
osmotic = 1e6 * s * np.where(h < layer, 2 * layer**2 / h - layer, np.maximum(2 * layer - h, 0))
elastic = 1e6 * s * np.where(h < layer, layer * np.log(4 * layer**3 / (h * (h - 3 * layer)**2)), 0)
printed = osmotic + elastic
worst = np.max(np.abs(f[inside | outside] / printed[inside | outside] - 1))
study.claim("3.3.2", "Steric force: osmotic and elastic part both repel, and end at twice the layer",
            "Fig. 3, \"combined osmotic and elastic repulsion\"; (21) is printed with the opposite sign",
            f"{f[np.argmin(abs(h - 0.5 * layer))]:.3g} N at half a layer, repulsive up to two layers and 0 from there; off (20)-(22) by at most {worst:.1g}",
            "(20)-(22) with (21) repelling, from a twentieth of a layer to two, to 1e-9; repulsive throughout; zero beyond", worst < 1e-9 and np.all(f[h < 2 * layer] > 0) and np.all(f[h >= 2 * layer] == 0))

# ---- free surface
with study.file("surface", "interactions") as file:
    g = file["interactions/free_surface"]
    gap, increment = file["interactions/gap"][:], g["perpendicular"][0]
    out, spring = g["protrusion"][0], g["spring_force"][0]
    viscosity = float(file["interactions"].attrs["viscosity"])
a, speed, tension, roughness = 1e-6, 10e-6, 72e-3, 2e-9
stokes = 6 * np.pi * viscosity * a
drag = (stokes + increment) * speed
table = np.genfromtxt(pathlib.Path(__file__).resolve().parents[2] / "data/resistance/free_surface.csv", delimiter=",", names=True)
inside = (table["gap_over_a"] > 2.01 * roughness / a) & (table["gap_over_a"] < 9)
ours_at = np.exp(np.interp(np.log(table["gap_over_a"][inside] * a), np.log(gap), np.log(increment / stokes + 1)))
error = np.max(np.abs(ours_at / table["F_perp"][inside] - 1))
study.claim("3.2.3", "Hydrodynamic force on a sphere that approaches the free surface (a = 1 um, 10 um/s)",
            f"Fig. 12, (13): the leading term is right, its logarithm is not. Exact: {np.interp(0.01, table['gap_over_a'], table['F_perp']) * stokes * speed:.3g} N at 10 nm",
            f"{np.interp(1e-8, gap, drag):.3g} N at 10 nm; off exact theory by at most {100 * error:.2g} % from 4 nm to 9 um",
            "within 0.5 % of the exact table (data/resistance/free_surface.csv)", error < 5e-3)
frozen = drag[gap <= roughness]
study.claim("3.2.3", "At the roughness the hydrodynamic force hands over to surface tension",
            "\"the force is transferred to correspond to the surface tension force\"",
            f"below 2 nm the hydrodynamic term stays at {frozen[0]:.3g} N, and the spring begins at {spring[0]:.3g} N",
            "the term is constant to 1e-9 below the roughness; the spring is zero where it begins", np.ptp(frozen) < 1e-9 * frozen[0] and spring[0] == 0)
largest = spring[:-1].max()
limit = 2 * np.pi * a * tension
study.claim("3.2.3", "Surface tension exceeds the hydrodynamic force by orders of magnitude: it is a constraint in all but name",
            f"Fig. 12; (14), (15): at most 2 pi a sigma = {limit:.3g} N", f"at most {largest:.3g} N, {largest / frozen[0]:.3g} times the hydrodynamic force at the roughness",
            "largest force of the spring within 6 % of 2 pi a sigma (its last point before h = 2a); more than 100 times the hydrodynamic one",
            0.94 < largest / limit <= 1 and largest > 100 * frozen[0])

# ---- figures
figure, axes = study.figure("fig02-dlvo-energy", "DLVO energy of two spheres of 1 um against their gap, with Born repulsion (Fig. 2). Left: surface potentials at a Debye length of "
                            "5 nm; right: Debye lengths at 25 mV. Below: the same about the secondary minimum", columns=2, rows=2, height=55)
for (near, far), cases, label, title in ((axes[:, 0], [(5, p) for p in potentials], "{1} mV", "potential"), (axes[:, 1], [(d, 25) for d in debyes], "{0} nm", "Debye length")):
    for axis in (near, far):
        for key in cases:
            axis.plot(curves[key].gap / NM, curves[key].energy["total"] / kt, label=label.format(*key))
        axis.axhline(0, color="0.6", lw=0.5, zorder=0)
        axis.set(xlabel="gap (nm)", ylabel="energy ($kT$)")
    near.set(xlim=(0, 30), ylim=(-60, 320))
    far.set(xlim=(15, 180), ylim=(-0.11, 0.04))
    near.legend(title=title, loc="upper right", title_fontsize=7)

figure, axes = study.figure("fig13-dlvo-force", "Force between two spheres of 1 um against their gap, repulsion positive (Fig. 13). Left: near; right: about the secondary minimum, where it is zero", columns=2)
for d in debyes:
    for p, style in ((10, ":"), (25, "-"), (50, "--")):
        c, colour = curves[d, p], f"C{debyes.index(d)}"
        for axis, unit in ((axes[0], 1e-12), (axes[1], 1e-15)):
            axis.plot(c.gap / NM, c.force["total"] / unit, style, color=colour, label=f"{d:g} nm, {p} mV")
for axis in axes:
    axis.axhline(0, color="0.6", lw=0.5, zorder=0)
axes[0].set(xlim=(0, 40), ylim=(-15, 160), xlabel="gap (nm)", ylabel="force (pN)")
axes[1].set(xlim=(20, 160), ylim=(-12, 12), xlabel="gap (nm)", ylabel="force (fN)")
axes[0].legend(loc="upper right", title="Debye length, potential", title_fontsize=7)

figure, axis = study.figure("fig03-steric-force", "Steric force between two spheres of 1 um with polymer layers of 5 nm, k1 = k2 = 1 MPa, against the gap in layers (Fig. 3)")
axis.plot(h / layer, f / 1e-9, label="both")
axis.plot(h / layer, osmotic / 1e-9, "--", label="osmotic (21), repelling")
axis.plot(h / layer, elastic / 1e-9, ":", label="elastic (22)")
axis.set(xlim=(0, 2.2), ylim=(0, 40), xlabel="gap / layer thickness", ylabel="force (nN)")
axis.legend()

figure, axes = study.figure("fig12-free-surface-force", "Force of the free surface on a sphere of radius 1 um that approaches it at 10 um/s and penetrates it (Fig. 12): hydrodynamic up to the roughness of 2 nm, "
                            "then surface tension", columns=2)
axes[0].loglog(gap / NM, drag, label="here")
beta = 1 + gap / a     # (13), its bracket taken as resistance and added to Stokes drag
bracket = beta / 2 - beta**2 / (2 * (beta - 1)) - 1 / (4 * beta) - 1 + 1.5 * beta * np.log(beta / (beta - 1))
axes[0].loglog(gap / NM, (stokes - 3 * np.pi * viscosity * a * bracket) * speed, "--", label="(13), as resistance")
axes[0].loglog(table["gap_over_a"] * a / NM, table["F_perp"] * stokes * speed, "o", markevery=6, mfc="none", label="exact")
axes[0].axvline(roughness / NM, color="0.6", lw=0.5)
axes[0].set(xlim=(0.5, 1e4), ylim=(1e-13, 1e-10), xlabel="gap to the surface (nm)", ylabel="force (N)")
axes[0].legend()
axes[1].semilogy(out / 1e-6, np.where(spring > 0, spring, np.nan))
axes[1].axhline(frozen[0], color="C1", ls="--")
axes[1].annotate("hydrodynamic, at the roughness", (1, frozen[0]), xytext=(0, 3), textcoords="offset points", ha="center", fontsize=7)
axes[1].set(xlim=(0, 2), ylim=(1e-11, 1e-6), xlabel="height above the surface (µm)", ylabel="surface tension force (N)")
study.finish()
