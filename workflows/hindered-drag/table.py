"""Prints the page of measure.sh: solids by height, pressures and falls, a column a drag."""
import sys
import h5py
import numpy as np

names = sys.argv[1:]
columns = []
for name in names:
    with h5py.File(name + ".h5") as f, h5py.File(name + "-solids.h5") as s:
        o, layer = f["observables"], f["particles/layer"]
        fraction, time = s["solids/volume_fraction"][-1], layer["position/time"][-1]
        third = len(fraction) // 3
        radius, z = layer["radius"][:], layer["position/value"][-1][:, 2]
        moved = z - layer["position/value"][0][:, 2]
        small = radius <= np.median(radius)
        columns.append({
            "solids, lowest third, vol-%": 100 * fraction[:third].mean(),
            "solids, middle third, vol-%": 100 * fraction[third:-third].mean(),
            "solids, highest third, vol-%": 100 * fraction[-third:].mean(),
            "mass centre, um": 1e6 * o["mass_centre/value"][-1],
            "99 % of the solids below, um": 1e6 * o["z99/value"][-1],
            "pressure on the substrate, Pa": o["substrate_pressure/value"][-4:].mean(),
            "fall of the smaller half, um": -1e6 * moved[small].mean(),
            "fall of the larger half, um": -1e6 * moved[~small].mean(),
        })
        if "liquid_pressure" in o:
            columns[-1]["liquid pressure at the substrate, Pa"] = o["liquid_pressure/value"][-4:].mean()
print("""# What hindered drag changes in a draining layer

The same packing drains through its substrate under a reservoir, once with the drag of isolated spheres (`hydrodynamics.drag: stokes`, as
the source has it) and once with that of a bed ([physics.md](physics.md#hindered-drag)). `make hindered-drag` measures it and writes
this page; the scene is `workflows/hindered-drag/scene.yaml`.
""")
print(f"After {1e3 * time:.3g} ms, {len(radius)} particles, lowest, middle and highest third of the packed box, pressures as the mean of the\n"
      "last four frames:\n")
print("| | " + " | ".join(f"drag: {n}" for n in names) + " |\n|---|" + "---|" * len(names))
for row in columns[-1]:
    print(f"| {row} | " + " | ".join(f"{float(format(c[row], '.3g')):g}" if row in c else "not recorded" for c in columns) + " |")
