"""What the runs of this study are held against: stationary statistics of a pair's gap, and the column of Carnahan and Starling.

Called by itself it prints the gaps at which the pair's force and resistance are to be known (CSV, metres)."""
import csv
import sys

import numpy as np

BOLTZMANN = 1.380649e-23
RADIUS, VISCOSITY, TEMPERATURE = 0.25e-6, 0.89e-3, 298.15   # of pairs.yaml
KT = BOLTZMANN * TEMPERATURE
# From outside the primary minimum to where the attraction ends: no pair of 200 crosses 199 kT or leaves a well of 14 kT.
GAPS = np.arange(1e-9, 199.5e-9, 0.05e-9)


def pair_statistics(file):
    """Mean and standard deviation (m) of the gap of two equal spheres from pigment-interactions' table: Boltzmann's; of noise
    without drift; of k_brown. The last two are stationary densities of Ito's equation for the distance, with diffusivities D
    along and D' across the line of centres: p ~ exp(integral of (M F + 2 D'/r)/D)/D."""
    with open(file, newline="") as f:
        rows = list(csv.DictReader(f))
    h, kn, ks, kp, force = (np.array([float(r[k]) for r in rows]) for k in ("h", "kn", "ks", "kp", "f_total"))
    r, a = h + 2 * RADIUS, RADIUS
    drag, torque = 6 * np.pi * VISCOSITY * a, 8 * np.pi * VISCOSITY * a**3
    along = 2 / (drag + 2 * kn)
    across, across_k = np.empty_like(h), np.empty_like(h)
    for k in range(len(h)):
        slip = np.array([[1, -1, a + h[k] / 2, a + h[k] / 2], [0, 0, 1, -1]])
        resistance = np.diag([drag, drag, torque, torque]) + slip.T @ np.diag([ks[k], kp[k]]) @ slip
        v = np.linalg.solve(resistance, [1, -1, 0, 0])
        across[k], across_k[k] = v[0] - v[1], drag * (v[0]**2 + v[1]**2)
    along_k = drag * along**2 / 2

    def moments(log_density):
        p = np.exp(log_density - log_density.max())
        mean = np.sum(p * h) / np.sum(p)
        return mean, np.sqrt(np.sum(p * (h - mean)**2) / np.sum(p))

    def integral(f):
        return np.concatenate([[0], np.cumsum(0.5 * (f[1:] + f[:-1]) * np.diff(h))])

    def ito(d, d_across):
        return moments(integral((along * force / KT + 2 * d_across / r) / d) - np.log(d))

    return {"fd": moments(2 * np.log(r) + integral(force) / KT), "undrifted": ito(along, across), "k_brown": ito(along_k, across_k)}


def compressibility(phi):
    """Pressure over n kT of hard spheres [carnahan1969]."""
    return (1 + phi + phi**2 - phi**3) / (1 - phi)**3


def effective_diameter(diameter, energy_at_contact, debye_length):
    """Diameter of hard spheres that stands for a repulsion energy_at_contact (kT) ln(1 + exp(-gap/debye_length)) [barker1967]."""
    gap = np.linspace(0, 40 * debye_length, 40001)
    f = 1 - np.exp(-energy_at_contact * np.log1p(np.exp(-gap / debye_length)))
    return diameter + np.sum(0.5 * (f[1:] + f[:-1]) * np.diff(gap))


def settled_column(volume, decay, height):
    """Solids against height of hard spheres pressed onto a plane: d(phi Z)/dz = -phi/decay, `volume` of them an area; decay =
    kT/(6 pi mu a q). Heights, and the length, in one unit. Returns phi at `height` (an array from 0 on)."""
    phi = np.linspace(1e-8, 0.62, 200000)
    pressure = phi * compressibility(phi)
    # z(phi) below the height of phi[0], from dz = -decay d(phi Z)/phi.
    depth = decay * np.concatenate([[0], np.cumsum(np.diff(pressure) * 0.5 * (1 / phi[1:] + 1 / phi[:-1]))])
    bottom = np.interp(volume / decay, pressure, depth)
    return np.interp(bottom - height, depth, phi, left=0)


if __name__ == "__main__":
    print("a1,a2,h")
    for gap in GAPS:
        print(f"{RADIUS},{RADIUS},{gap:.6e}")
