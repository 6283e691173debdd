"""Figures 14 and 15 of [sand2010]; what noise does to pairs near contact and to a settled column, against exact integrals."""
import h5py
import numpy as np
from scipy.stats import chi2, kstest, norm

from equilibrium import KT, VISCOSITY, compressibility, effective_diameter, settled_column
from pairs import Pairs
from study import Study

study = Study()


def positions(name):
    with h5py.File(study.results / f"{name}.h5", "r") as f:
        layer = f["particles/layer"]
        return layer["position/value"][:], layer["position/time"][:], layer["radius"][:]


# ---- figure 14
with study.file("calibration", "kbrown") as f:
    temperature, k, deviation, closed = (f[f"kbrown/{n}"][:] for n in ("temperature", "value", "standard_deviation", "closed_form"))
figure, axis = study.figure("fig14-k-brown", "K_Brown against temperature, mean and standard deviation of 25 simulations of 45,000 displacements of a 2 um sphere "
                            "at a step of 0.1 ms, and its closed form (Fig. 14)")
axis.errorbar(temperature - 273.15, k / 1e-9, deviation / 1e-9, fmt="o", label="calibrated, ± 1 s.d.")
axis.plot(temperature - 273.15, closed / 1e-9, "-", label=r"$\sqrt{36\pi\mu kT/\Delta t}$")
axis.set(xlabel="temperature (°C)", ylabel=r"$K_{Brown}$ (nN m$^{-1/2}$)")
axis.legend()
error = deviation / 5   # of the mean of 25
study.claim("3.3.3", "K_Brown falls with rising temperature, non-linearly", "Fig. 14", ", ".join(f"{t - 273.15:.0f} C: {1e9 * v:.4f} ± {1e9 * s:.4f}" for t, v, s in zip(temperature, k, deviation)) + " nN m^-1/2 (s.d.)",
            "each value below the one before, and each slope less steep, by more than 3 standard errors",
            bool(np.all(np.diff(k) < -3 * np.hypot(error[1:], error[:-1])) and np.all(np.diff(k, 2) > 3 * np.sqrt(error[2:]**2 + 4 * error[1:-1]**2 + error[:-2]**2))))
off = (k - closed) / error
study.claim("3.3.3", "K_Brown gives the displacements of (23), (24): it equals its closed form", "text before Fig. 14", f"off the closed form by {', '.join(f'{o:.1f}' for o in off)} standard errors",
            "all four within 3 standard errors of the mean of 25 (false alarm 1 %)", bool(np.all(np.abs(off) < 3)))

# ---- figure 15: 100 spheres for 499 s each are 49,900 displacements of 1 s
x, time, radius = positions("free")
interval = time[1] - time[0]
diffusivity = KT / (6 * np.pi * VISCOSITY * radius[0])
sigma = np.sqrt(2 * diffusivity * interval)
step = np.diff(x[:500], axis=0)[:, :, 0].ravel() / sigma
size = np.abs(step)
p_gauss = kstest(step, norm.cdf).pvalue
log_mean, log_sd = np.mean(np.log(size)), np.std(np.log(size))
log_gauss = kstest(np.log(size), norm(log_mean, log_sd).cdf)
figure, axes = study.figure("fig15-displacements", f"Left: {step.size:,} displacements along x in {interval:g} s of 2 um spheres, on the Gaussian of (23). Middle: their sizes, on the log-Gaussian of the same mean and "
                            "standard deviation of the logarithm. Right: root mean square displacement at intervals of 5 to 480 s, 50,000 s in all, on (23) (Fig. 15)", columns=3)
axes[0].hist(step, bins=np.linspace(-4, 4, 61), density=True, color="0.8")
u = np.linspace(-4, 4, 200)
axes[0].plot(u, norm.pdf(u), label="Gaussian")
axes[0].set(xlabel="displacement (s.d.)", ylabel="density", xlim=(-4, 4), ylim=(0, 0.5))
axes[1].hist(size, bins=np.linspace(0, 4, 41), density=True, color="0.8")
u = np.linspace(1e-3, 4, 400)
axes[1].plot(u, 2 * norm.pdf(u), label="Gaussian, folded")
axes[1].plot(u, norm.pdf(np.log(u), log_mean, log_sd) / u, label="log-Gaussian")
axes[1].set(xlabel="size of the displacement (s.d.)", ylabel="density", xlim=(0, 4))
rows = []
for m in (5, 10, 20, 40, 80, 160, 320, 480):
    d = np.diff(x[::m], axis=0)
    rows.append((m * interval, np.mean(d**2), d.size))
t, square, count = map(np.array, zip(*rows))
axes[2].errorbar(t, 1e6 * np.sqrt(square), 1e6 * np.sqrt(square) / np.sqrt(2 * count), fmt="o", label="simulated, ± 1 s.e.")
axes[2].plot(t, 1e6 * np.sqrt(2 * diffusivity * t), label="(23)")
axes[2].set(xlabel="interval (s)", ylabel="displacement (µm)", xscale="log", yscale="log")
for axis in axes:
    axis.legend(loc="upper left" if axis is axes[2] else "upper right")
study.claim("3.3.3", "Displacements are Gaussian", "Fig. 15, left", f"Kolmogorov-Smirnov p = {p_gauss:.2g} of {step.size:,} on the Gaussian of (23)",
            "p > 0.01, width of the Gaussian from (23), nothing fitted; one step alone is uniform, twenty are not", bool(p_gauss > 0.01))
study.claim("3.3.3", "Displacements follow a log-Gaussian", "Fig. 15, left", f"Kolmogorov-Smirnov distance {log_gauss.statistic:.3f} of the sizes' logarithms (mean and s.d. fitted), p = {log_gauss.pvalue:.1g}",
            "p > 0.01; sizes of a Gaussian displacement are spread wider to the small side than any log-Gaussian", bool(log_gauss.pvalue > 0.01),
            why="what (23) and (25) give are Gaussian displacements, by theory as here (the row above)")
chance = [2 * min(chi2.cdf(n * s / (2 * diffusivity * ti), n), chi2.sf(n * s / (2 * diffusivity * ti), n)) for ti, s, n in rows]
study.claim("3.3.3", "Displacements over 5 to 480 s follow (23)", "Fig. 15, right", f"smallest p = {min(chance):.2g} of {len(chance)} intervals, mean square against 2 D t",
            "chi-squared of each interval's mean square, every p > 0.01/8", bool(min(chance) > 0.01 / 8))

# ---- size error
x, time, radius = positions("sizes")
ratio, spread = [], []
for a in np.unique(radius):
    d = np.diff(x[:, radius == a], axis=0)
    expected = 2 * KT / (6 * np.pi * VISCOSITY * a) * (time[1] - time[0])
    ratio.append(np.sqrt(np.mean(d**2) / expected))
    spread.append(1 / np.sqrt(2 * d.size))
ratio, spread = np.array(ratio), np.array(spread)
study.claim("3.3.3", "The size error over 1:10 is below 3 %", "text after (25), \"expected\"", ", ".join(f"{2e6 * a:.1f} um {100 * (r - 1):+.2f} ± {100 * s:.2f} %" for a, r, s in zip(np.unique(radius), ratio, spread)),
            "each root mean square displacement within 3 standard errors of (23), those below 1 %: force and drag scale so that the error is exactly zero", bool(np.all(np.abs(ratio - 1) < 3 * spread) and np.all(3 * spread < 0.01)))

# ---- pairs
pairs = Pairs(study.results)
exact, exact_sd = pairs.exact["fd"]
figure, axes = study.figure("weak-error", f"Mean gap (left) and its standard deviation (right) of 200 pairs of 0.5 um in a well of 14 kT against the step, ± 1 s.e.; lines: exact integrals, {1e9 * exact:.2f} and "
                            f"{1e9 * exact_sd:.2f} nm of Boltzmann, and what noise without drift and k_brown sample as the step goes to nothing", columns=2, width=95, height=75)
colours = {"fd": "#0b6fb8", "undrifted": "#2f8f4e", "k_brown": "#c8531c"}
marks = {"averaged": "o-", "newton": "o-", "implicit": "s--", "explicit": "^:", "midpoint": "v-."}
for (noise, treatment), runs in pairs.runs.items():
    dt = np.array(list(runs))
    for axis, q in ((axes[0], "mean"), (axes[1], "deviation")):
        axis.errorbar(dt, [1e9 * getattr(r, q) for r in runs.values()], [1e9 * getattr(r, q + "_error") for r in runs.values()],
                      fmt=marks[treatment], color=colours[noise], label=f"{noise}, {treatment}".replace("undrifted", "no drift"))
for q, axis in enumerate(axes):
    for noise, values in pairs.exact.items():
        axis.axhline(1e9 * values[q], color=colours[noise], lw=0.6)
    axis.set(xscale="log", xlabel="step (ms)", ylabel=("mean gap (nm)", "standard deviation (nm)")[q], ylim=((23, 37), (0, 16))[q])
axes[1].legend(loc="upper left", fontsize=5.5, ncols=2)
d = pairs.default
study.claim("3.3.3", "Noise that obeys fluctuation and dissipation samples Boltzmann's distribution of a pair's gap at the default step", "not in the source",
            f"mean {1e9 * d.mean:.2f} ± {1e9 * d.mean_error:.2f}, s.d. {1e9 * d.deviation:.2f} ± {1e9 * d.deviation_error:.2f} nm at {1e3 * d.step:.3f} ms; exact {1e9 * exact:.2f} and {1e9 * exact_sd:.2f}",
            "mean gap within 3 %", bool(abs(d.mean / exact - 1) < 0.03))
kb = pairs.runs["k_brown", "explicit"][0.0078125]
study.claim("3.3.3", "The force of (25) moves particles as Brownian motion does near others as well", "implied by its use in dense layers",
            f"mean {1e9 * kb.mean:.2f} ± {1e9 * kb.mean_error:.2f}, s.d. {1e9 * kb.deviation:.2f} nm at 0.008 ms; exact {1e9 * exact:.2f} and {1e9 * exact_sd:.2f}",
            "standard deviation within 10 %", bool(abs(kb.deviation / exact_sd - 1) < 0.1),
            why="the force of (25) is scaled to the drag of a lone sphere, and near another the resistance is many times that: it moves the pair less than its thermal energy would")

# ---- a column under uniform flow
DIAMETER, POTENTIAL, DEBYE, FLOW, AREA, COUNT = 0.5, 25e-3, 5e-3, 1.5e-6, 2.4**2, 320   # of settled.yaml; um, V, um, m/s, um2
decay = 1e6 * KT / (6 * np.pi * VISCOSITY * 0.25e-6 * FLOW)                              # kT/(6 pi mu a q), um
contact = 2 * np.pi * 80 * 8.8541878128e-12 * 0.25e-6 * POTENTIAL**2 / KT                # (17) at equal spheres
effective = effective_diameter(DIAMETER, contact, DEBYE)
volume = np.pi / 6 * effective**3
SETTLED = {"drag": "isolated drag", "fd": "lubrication", "undrifted": "lubrication, no drift", "k_brown": "lubrication, k_brown"}
# The plane orders the spheres next to it; theory starts above, where what lies higher presses with its drag, whatever lies below.
LEVEL, SLICE, BLOCKS = 1.5, 0.25, 10


class Column:
    """Solids (of the effective spheres) against the height of centres, averages over 0.5..2.5 s; errors from blocks of 0.2 s."""

    def __init__(self, name):
        x, time, radius = positions(f"settled-{name}")
        blocks = np.array_split(1e6 * x[time > 0.5][:, :, 2], BLOCKS)
        self.edges = np.arange(0, 14.01, SLICE)
        self.z = (self.edges[1:] + self.edges[:-1]) / 2

        def over_blocks(values):
            values = np.array(values)
            return values.mean(0), values.std(0, ddof=1) / np.sqrt(BLOCKS)

        self.phi, self.error = over_blocks([np.histogram(b, self.edges)[0] / len(b) * volume / AREA / SLICE for b in blocks])
        # Solid volume an area above each height, over the decay length: the pressure there times the sphere's volume over kT.
        self.pressure, _ = over_blocks([[np.mean(np.sum(b > z, axis=1)) * volume / AREA / decay for z in self.z] for b in blocks])
        self.above, _ = over_blocks([np.mean(np.sum(b > LEVEL, axis=1)) * volume / AREA for b in blocks])
        self.height, self.height_error = over_blocks([b.mean() for b in blocks])
        self.expected = lambda z: settled_column(self.above, decay, z - LEVEL)


columns = {name: Column(name) for name in SETTLED}
fine = np.linspace(0.4, 20, 9801)
theory = columns["fd"].expected(fine)


class Dilute:
    """Spheres too few to meet: density of their heights, and its decay over a level where the plane is out of reach: the mean
    height over it, which for an exponential is its decay length. Errors from groups of 40 spheres, which are independent."""
    level = 0.75

    def __init__(self, name):
        x, time, radius = positions(f"settled-dilute-{name}")
        z = 1e6 * x[time > 0.5][:, :, 2]
        self.edges = np.arange(0.25, 6, SLICE)
        groups = np.array_split(z, BLOCKS, axis=1)
        density = np.array([np.histogram(g, self.edges)[0] / g.size / SLICE for g in groups])
        self.z, self.density, self.error = (self.edges[1:] + self.edges[:-1]) / 2, density.mean(0), density.std(0, ddof=1) / np.sqrt(BLOCKS)
        lengths = np.array([(g[g > self.level] - self.level).mean() for g in groups])
        self.length, self.length_error = lengths.mean(), lengths.std(ddof=1) / np.sqrt(BLOCKS)
        self.above = np.mean(z > self.level)


dilute = {name: Dilute(name) for name in ("drag", "fd")}
figure, axes = study.figure("settled", f"{COUNT} spheres of 0.5 um pressed onto a plane by 1.5 um/s, on hard spheres of {effective:.3f} um [Carnahan and Starling]. Left: solids against height of the centres; "
                            "middle: pressure over n kT against solids, from the balance of forces; right: 400 spheres that hardly meet, on exp(-z/decay)", columns=3)
for (name, label), mark in zip(SETTLED.items(), "os^v"):
    c = columns[name]
    axes[0].errorbar(c.phi, c.z, xerr=c.error, fmt=mark, ms=2.5, lw=0.6, label=label)
    use = (c.z > LEVEL) & (c.phi > 5e-3)
    axes[1].plot(c.phi[use], (c.pressure / c.phi)[use], mark, ms=2.5, label=label)
axes[0].plot(theory, fine, "k-", lw=0.8, label="Carnahan-Starling")
axes[0].set(xlabel="solids of the effective spheres", ylabel="height (µm)", ylim=(0, 14), xlim=(0, 1))
for (name, c), mark in zip(dilute.items(), "os"):
    axes[2].errorbar(c.density, c.z, xerr=c.error, fmt=mark, ms=2.5, lw=0.6, label=SETTLED[name])
height = np.linspace(Dilute.level, 5, 2)
axes[2].plot(dilute["fd"].above / decay * np.exp(-(height - Dilute.level) / decay), height, "k-", lw=0.8, label=f"decay {decay:.3f} µm")
axes[2].set(xscale="log", xlim=(3e-4, 3), ylim=(0, 5), xlabel="density of heights (1/µm)", ylabel="height (µm)")
axes[2].legend(fontsize=6, loc="lower left")
p = np.linspace(0.001, 0.53, 200)
axes[1].plot(p, compressibility(p), "k-", lw=0.8)
axes[1].set(xlabel="solids of the effective spheres", ylabel="pressure / (n k T)", xlim=(0, 0.6), ylim=(0, 16))
axes[0].legend(fontsize=6)
axes[1].legend(fontsize=6, loc="upper left")
for name in ("drag", "fd"):
    c = columns[name]
    use = (c.z > LEVEL) & (c.phi > 5e-3)
    off = c.phi[use] - c.expected(c.z[use])
    study.claim("4.1", f"Spheres under a uniform flow stand as Carnahan and Starling's ({SETTLED[name]})", "not in the source; decides whether cakes can be trusted",
                f"solids off by {off.mean():+.4f} on average, {np.max(np.abs(off)):.3f} at most; up to {c.phi[use].max():.2f}",
                f"each of {use.sum()} slices above {LEVEL} um within 4 standard errors and 0.02, for the softness of the spheres and the step", bool(np.all(np.abs(off) < 4 * c.error[use] + 0.02)))
    study.claim("4.1", f"The dilute end decays with kT/(6 pi mu a q) ({SETTLED[name]})", "not in the source",
                f"{dilute[name].length:.3f} ± {dilute[name].length_error:.3f} um of 400 spheres over a level; kT/(6 pi mu a q) is {decay:.3f} um",
                "within 3 standard errors", bool(abs(dilute[name].length - decay) < 3 * dilute[name].length_error))
for name in ("undrifted", "k_brown"):
    c, right = columns[name], columns["fd"]
    difference, error = c.height - right.height, np.hypot(c.height_error, right.height_error)
    study.claim("4.1", f"A column of spheres with {SETTLED[name].split(', ')[1]} stands as high as with the full noise", "the source's noise" if name == "k_brown" else "not in the source",
                f"mean height {c.height:.3f} ± {c.height_error:.3f} um against {right.height:.3f} ± {right.height_error:.3f}: {100 * difference / right.height:+.1f} %",
                "no more than 3 standard errors apart", bool(abs(difference) < 3 * error),
                why={"undrifted": "without the drift that the divergence of the mobility makes, spheres gather where they are least mobile: near one another",
                     "k_brown": "in a packed column its noise, scaled to the drag of lone spheres, moves them less than their thermal energy would"}[name])
study.finish()
