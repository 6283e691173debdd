"""Figures 14 and 15 of [sand2010]; what noise does to pairs near contact, against exact integrals."""
import h5py
import numpy as np
from scipy.stats import chi2, kstest, norm

from study import Study

study = Study()
BOLTZMANN = 1.380649e-23


def positions(name):
    with h5py.File(study.results / f"{name}.h5", "r") as f:
        layer = f["particles/layer"]
        return layer["position/value"][:], layer["position/time"][:], layer["radius"][:]


# ---- figure 14
with study.file("calibration", "kbrown") as f:
    temperature, k, deviation, closed = (f[f"kbrown/{n}"][:] for n in ("temperature", "value", "standard_deviation", "closed_form"))
figure, axis = study.figure("fig14-k-brown", "K_Brown against temperature, mean and standard deviation of 25 simulations of 45,000 displacements at a step of 0.1 ms, and its closed form (Fig. 14)")
axis.errorbar(temperature - 273.15, k / 1e-9, deviation / 1e-9, fmt="o", label="calibrated")
axis.plot(temperature - 273.15, closed / 1e-9, "-", label=r"$\sqrt{36\pi\mu kT/\Delta t}$")
axis.set(xlabel="temperature (°C)", ylabel=r"$K_{Brown}$ (nN m$^{-1/2}$)")
axis.legend()
study.claim("3.3.3", "K_Brown falls with rising temperature, non-linearly", "Fig. 14", ", ".join(f"{t - 273.15:.0f} C: {v:.4g}" for t, v in zip(temperature, k)) + " N m^-1/2",
            "each value below the one before by more than 5 standard errors, and slopes that fall", bool(np.all(np.diff(k) < -5 * deviation[0] / 5) and np.all(np.diff(k, 2) > 0)))
off = (k - closed) / (deviation / 5)
study.claim("3.3.3", "K_Brown gives the displacements of (23), (24)", "text before Fig. 14", f"off the closed form by {', '.join(f'{o:.1f}' for o in off)} standard errors",
            "all four within 3 standard errors of the mean of 25 (false alarm 1 %)", bool(np.all(np.abs(off) < 3)))

# ---- figure 15
x, time, radius = positions("free")
viscosity = 0.8900e-3  # water at 25 C [patek2009]
diffusivity = BOLTZMANN * 298.15 / (6 * np.pi * viscosity * radius[0])
step = np.diff(x, axis=0)
interval = time[1] - time[0]
sigma = np.sqrt(2 * diffusivity * interval)
normalised = step.ravel() / sigma
p_gauss = kstest(normalised, norm.cdf).pvalue
size = np.abs(normalised)
log_mean, log_sd = np.mean(np.log(size)), np.std(np.log(size))
p_log = kstest(np.log(size), norm(log_mean, log_sd).cdf).pvalue
figure, axes = study.figure("fig15-displacements", f"Left: {normalised.size} displacements a component in {interval:g} s of a 2 um sphere, on a Gaussian. Right: root mean square displacement a component at intervals "
                            "of 5 to 480 s, 50,000 s in all, on (23) (Fig. 15)", columns=2)
axes[0].hist(normalised, bins=60, density=True, color="0.8")
u = np.linspace(-4, 4, 200)
axes[0].plot(u, norm.pdf(u), label="Gaussian")
axes[0].set(xlabel="displacement (s.d.)", ylabel="density", xlim=(-4, 4))
axes[0].legend(loc="upper right")
rows = []
for m in (1, 2, 4, 8, 16, 32, 64, 96):
    d = np.diff(x[::m], axis=0)
    rows.append((m * interval, np.mean(d**2), d.size))
t, square, count = map(np.array, zip(*rows))
axes[1].errorbar(t, 1e6 * np.sqrt(square), 1e6 * np.sqrt(square) / np.sqrt(2 * count), fmt="o", label="simulated")
axes[1].plot(t, 1e6 * np.sqrt(2 * diffusivity * t), label="(23)")
axes[1].set(xlabel="interval (s)", ylabel="displacement (µm)", xscale="log", yscale="log")
axes[1].legend()
study.claim("3.3.3", "Displacements are Gaussian", "Fig. 15, left", f"Kolmogorov-Smirnov p = {p_gauss:.2g} on the Gaussian of (23); their sizes on a log-Gaussian: p = {p_log:.1g}",
            "p > 0.01 on the Gaussian whose width is that of (23), nothing fitted; one step alone is uniform, twenty are not", bool(p_gauss > 0.01))
chance = [2 * min(chi2.cdf(n * s / (2 * diffusivity * ti), n), chi2.sf(n * s / (2 * diffusivity * ti), n)) for ti, s, n in rows]
study.claim("3.3.3", "Displacements over 5 to 480 s follow (23)", "Fig. 15, right", f"smallest p = {min(chance):.2g} of {len(chance)} intervals, mean square against 2 D t",
            "chi-squared of each interval's mean square, every p > 0.01/8", bool(min(chance) > 0.01 / 8))

# ---- size error
x, time, radius = positions("sizes")
ratio, spread = [], []
for a in np.unique(radius):
    d = np.diff(x[:, radius == a], axis=0)
    expected = 2 * BOLTZMANN * 298.15 / (6 * np.pi * viscosity * a) * (time[1] - time[0])
    ratio.append(np.sqrt(np.mean(d**2) / expected))
    spread.append(np.std(d**2) / np.mean(d**2) / np.sqrt(d.size) / 2)
study.claim("3.3.3", "The size error over 1:10 is below 3 %", "text after (25), \"expected\"", ", ".join(f"{2e6 * a:.1f} um {100 * (r - 1):+.2f} +- {100 * s:.2f} %" for a, r, s in zip(np.unique(radius), ratio, spread)),
            "each root mean square displacement within 3 standard errors of (23): force and drag scale so that it is exactly zero", bool(np.all(np.abs(np.array(ratio) - 1) < 3 * np.array(spread))))

# ---- pairs: Boltzmann's integral from (17) and the depletion law
kT, a, debye, psi, reach, pressure = BOLTZMANN * 298.15, 0.25e-6, 5e-9, 0.025, 200e-9, 4.0
h = np.linspace(1e-9, 199.9e-9, 20000)
energy = 4 * np.pi * 80 * 8.8541878128e-12 * a / 2 * psi**2 * np.log1p(np.exp(-h / debye)) - np.pi * pressure * (reach - h)**2 * ((2 * a + h) / 4 + (reach - h) / 6)
weight = (2 * a + h)**2 * np.exp(-(energy - energy.min()) / kT)
exact = np.sum(weight * h) / np.sum(weight)
exact_sd = np.sqrt(np.sum(weight * (h - exact)**2) / np.sum(weight))


def gaps(name):
    """Mean, s.d. and their standard errors over independent pairs; the first sixth of the run is left out."""
    x, time, radius = positions(name)
    g = np.linalg.norm(x[:, 1::2] - x[:, 0::2], axis=2) - 2 * a
    g = g[len(g) // 6:]
    mean, sd = g.mean(), g.std()
    each = ((g - mean)**2).mean(axis=0)
    return mean, sd, g.mean(axis=0).std() / np.sqrt(g.shape[1] - 1), each.std() / np.sqrt(g.shape[1] - 1) / (2 * sd)


schemes = {"averaged": "averaged (default)", "implicit": "linearly implicit", "explicit": "explicit", "without-drift": "averaged, no drift", "k-brown": "k_brown"}
steps = ("0.03125", "0.125", "0.25")
results = {(s, dt): gaps(f"pairs-{s}-{dt}") for s in schemes for dt in steps}
figure, axes = study.figure("weak-error", f"Mean gap and its standard deviation of 200 pairs of 0.5 um in a well of 14 kT against the step; lines: exact, {exact / 1e-9:.2f} and {exact_sd / 1e-9:.2f} nm", columns=2)
for s, label in schemes.items():
    for axis, q in ((axes[0], 0), (axes[1], 1)):
        axis.errorbar([float(dt) for dt in steps], [1e9 * results[s, dt][q] for dt in steps], [1e9 * results[s, dt][q + 2] for dt in steps], fmt="o-", label=label)
for axis, value, label in ((axes[0], exact, "mean gap (nm)"), (axes[1], exact_sd, "standard deviation (nm)")):
    axis.axhline(value / 1e-9, color="k", lw=0.6)
    axis.set(xscale="log", xlabel="step (ms)", ylabel=label)
axes[0].set(ylim=(24, 38))
axes[1].set(ylim=(0, 14))
axes[1].legend(loc="upper left", fontsize=6)
default = gaps("pairs-default")
study.claim("3.3.3", "Noise that obeys fluctuation and dissipation samples Boltzmann's distribution of a pair's gap at the default step", "not in the source",
            f"mean {default[0] / 1e-9:.2f} +- {default[2] / 1e-9:.2f}, s.d. {default[1] / 1e-9:.2f} nm; exact {exact / 1e-9:.2f} and {exact_sd / 1e-9:.2f}",
            "mean gap within 3 %", bool(abs(default[0] / exact - 1) < 0.03))
kb = results["k-brown", steps[0]]
study.claim("3.3.3", "The force of (25) moves particles as Brownian motion does near others as well", "implied by its use in dense layers", f"mean {kb[0] / 1e-9:.2f}, s.d. {kb[1] / 1e-9:.2f} nm at {steps[0]} ms; exact {exact / 1e-9:.2f} and {exact_sd / 1e-9:.2f}",
            "standard deviation within 10 %", bool(abs(kb[1] / exact_sd - 1) < 0.1))
study.finish()
