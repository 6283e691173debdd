#!/usr/bin/env bash
# One step of LAMMPS's implicit lubrication (pair style lubricateU/poly, two solves to 1e-3 from rest) against one assembly and
# solve of ours to 1e-3 from rest, on the same positions, one thread each, in one run; medians of five.
# Usage: compare.sh BIN BENCH FOLDER; `make bench-peers` calls it. Needs Debian's package lammps.
set -euo pipefail
bin=$1 bench=$2 folder=$3 here=$(cd "$(dirname "$0")" && pwd)
command -v lmp > /dev/null || { echo 'bench-peers runs LAMMPS, which is not here: apt install --no-install-recommends lammps' >&2; exit 1; }
export OMP_NUM_THREADS=1
mkdir -p "$folder"
cd "$folder"
seconds=60  # that LAMMPS's solver gets, each time
awk 'BEGIN { print "diameter [um],finer [wt%]"; for (k = 0; k <= 24; ++k) printf "%.8g,%.8g\n", 0.25 * 8 ^ (k / 24), 100 * k / 24 }' > wide.csv
size_narrow='[{species: small, parts: 27, size: {law: monodisperse, diameter: 1 um}}, {species: large, parts: 73, size: {law: monodisperse, diameter: 1.4 um}}]'
size_wide='[{species: pigment, size: {law: table, file: wide.csv}}]'
echo '| sizes | particles | LAMMPS, ms a step | ours, ms a solve | ratio |'
echo '|---|---|---|---|---|'
for sizes in narrow wide; do
  if [ $sizes = narrow ]; then particles=$size_narrow width=28.5 name='1:1.4' types=2; else particles=$size_wide width=10.76 name='1:8, number ~ a^-4' types=8; fi
  printf 'layer: {thickness: %s um, solids: 41 vol%%, width: %s um}\nparticles: %s\npacking: {minimum_gap: 2 nm}\n' $width $width "$particles" > scene.yaml
  "$bin/pigment-pack" scene.yaml --quiet -o packing.h5 2> /dev/null
  /usr/bin/python3 "$here/lammps_input.py" packing.h5 . $types
  PIGMENT_PACKING=packing.h5 "$bench/bench_peers" --benchmark_repetitions=5 --benchmark_format=csv 2> /dev/null > ours.csv
  ours=$(grep '_median"' ours.csv | cut -d, -f3)
  count=$(/usr/bin/python3 -c 'import h5py; print(len(h5py.File("packing.h5")["particles/layer/radius"]))')
  : > theirs.txt
  for k in 1 2 3 4 5; do
    timeout $seconds lmp -in layer.in -log none 2> /dev/null | awk '/^Loop time/ { print 1000 * $4 }' >> theirs.txt || break
  done
  if [ -s theirs.txt ]; then
    theirs=$(sort -g theirs.txt | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }')
    awk -v n="$name" -v c="$count" -v t="$theirs" -v o="$ours" 'BEGIN { printf "| %s | %d | %.0f | %.1f | %.0f |\n", n, c, t, o, t / o }'
  else
    awk -v n="$name" -v c="$count" -v s=$seconds -v o="$ours" 'BEGIN { printf "| %s | %d | no convergence in %d s | %.1f | more than %.0f |\n", n, c, s, o, 1000 * s / o }'
  fi
done
