"""Prints the table of measure.sh: steps, wall time, and errors against the first tolerance named."""
import sys
import h5py
import numpy as np


def seconds(name):
    return open(name + ".seconds").read().strip()


def measures(tolerance):
    with h5py.File(f"t{tolerance}.h5") as t, h5py.File(f"s{tolerance}.h5") as s:
        layer, observables = t["particles/layer"], t["observables"]
        position, radius = layer["position/value"][-1], layer["radius"][:]
        width = layer["box/edges/value"][-1][:2]
        gaps = []
        order = np.argsort(position[:, 2])
        z, a = position[order, 2], radius[order]
        for k, i in enumerate(order):  # neighbours in height only, then in the plane
            last = np.searchsorted(z, z[k] + a[k] + a.max() + 5e-8)
            j = order[k + 1:last]
            d = position[j] - position[i]
            d[:, :2] -= width * np.round(d[:, :2] / width)
            gap = np.linalg.norm(d, axis=1) - radius[j] - radius[i]
            gaps.append(gap[gap < 5e-8])
        return dict(profile=s["solids/volume_fraction"][-1], gaps=np.sort(np.concatenate(gaps)),
                    pressure=observables["surface_pressure/value"][-4:].mean(), step=observables["step_size/value"][1:],
                    every=np.diff(layer["position/time"][:]))


names = sys.argv[1:]
reference = measures(names[0])
grid = np.linspace(0, 5e-8, 501)
share = lambda g: np.searchsorted(g, grid) / len(g)
for name, what in (("pack65", "65 wt-%"), ("pack78", "78 wt-%")):
    with h5py.File(name + ".h5") as f:
        print(f"packing of {f['particles/layer/radius'].shape[0]} particles at {what}: {seconds(name)} s")
print("\n| tolerance | steps | wall time, s | solids profile L1 | separations < 50 nm, KS | surface pressure |\n|---|---|---|---|---|---|")
for name in names[1:] + names[:1]:
    m = measures(name)
    steps = int(round((m["every"] / m["step"]).sum()))
    if name == names[0]:
        print(f"| {name} | {steps} | {seconds('t' + name)} | reference | reference | reference |")
        continue
    l1 = np.abs(m["profile"] - reference["profile"]).sum() / reference["profile"].sum()
    ks = np.abs(share(m["gaps"]) - share(reference["gaps"])).max()
    print(f"| {name} | {steps} | {seconds('t' + name)} | {100 * l1:.2f} % | {ks:.3f} | {100 * (m['pressure'] / reference['pressure'] - 1):+.1f} % |")
