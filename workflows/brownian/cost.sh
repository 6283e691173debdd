#!/bin/bash
# What long runs with noise cost: cost.sh BIN FOLDER [PART [ROWS]]. Prints a table (Markdown). BIN: folder of the tools; FOLDER: for
# what is computed; PART: share of the model time that is run, from the settled cake on, and scaled up (1: the whole, a day or so);
# ROWS: names of those to run, "all" without. A second table has what their cakes are like beside the first one's. Nothing else should run
# beside it. Two threads.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
bin=$1 folder=$2 part=${3:-1} rows=${4:-all}
cake=$here/../filter-cake/scene.yaml
mkdir -p "$folder"
/usr/bin/python3 "$here/../filter-cake/flow.py" 100 0.5 5 > "$folder/flow.csv"
flow=$(realpath "$folder")/flow.csv
times() { /usr/bin/python3 -c "print(f'{$1:g}')"; }
done_rows=()
# NAME SCHEME DURATION STEP OPTIONS...: spheres of 0.5 um that 5 g/m2/s keeps as a cake.
row() {
  local name=$1 scheme=$2 duration=$3 step=$4
  shift 4
  [[ $rows == all || " $rows " == *" $name "* ]] || return 0
  done_rows+=("$name")
  local scene=("$cake" --set "dewatering.file=$flow" "$@")
  local run="$folder/$name"
  "$bin/pigment-pack" "${scene[@]}" --quiet -o "$run.packing.h5" >&2
  "$bin/pigment-dewater" "${scene[@]}" --quiet -o "$run.dewatering.h5" 2> /dev/null
  local until; until=$(times "0.5 + ($duration - 0.5) * $part")
  rm -f "$run.json" "$run".checkpoint*
  /usr/bin/python3 "$here/../measured.py" "$run.json" "$bin/pigment-consolidate" "${scene[@]}" --packing "$run.packing.h5" --dewatering "$run.dewatering.h5" --quiet --threads 2 \
    --set stepping.time_step="$step" --set stepping.until="$until s" --set output.every="$(times "($until) / 50") s" -o "$run.h5" >&2
  /usr/bin/python3 - "$run" "$scheme" "$duration" "$until" "$part" <<'PY'
import json, sys
import h5py
run, scheme, duration, until, part = *sys.argv[1:3], *map(float, sys.argv[3:])
took = json.load(open(run + ".json"))["seconds"]
with h5py.File(run + ".h5") as f:
    layer = f["particles/layer"]
    n, steps, step = len(layer["radius"]), int(layer["position/step"][-1]), float(f["observables/step_size/value"][1:].mean())
whole = took * duration / until
print(f"| {n} | {scheme} | {duration:g} s | {1e6 * step:.0f} us | {1e3 * took / steps:.2f} ms | {whole / 60:.1f} min{'' if part == 1 else ' (scaled)'} |")
PY
}
thousand=(--set layer.width="5 um" --set layer.thickness="8.727 um")
# What cheaper runs leave out: rotation, and most of the solver's tolerance; then all lubrication, with which the noise that obeys fluctuation and dissipation is the
# source's, and the average along the step.
options() { sed 's/^/--set=/' "$@"; }
mapfile -t lean < <(options "$here/lean.options")
mapfile -t coarse < <(options "$here/lean.options" "$here/coarse.options")
rotation=(--set hydrodynamics.rotation=true)
command="make brownian-cost"
[[ $part == 1 ]] || command+=" PART=$part"
[[ $rows == all ]] || command+=" ROWS=\"$rows\""
printf '`%s`, two threads on %s cores: spheres of 0.5 um that 5 g/m2/s keeps as a cake.\n\n' "$command" "$(nproc)"
echo "| spheres of 0.5 um | noise and drag | model time | step | wall time a step | in all |"
echo "|---|---|---|---|---|---|"
row thousand "fluctuation_dissipation, rotation" 30 "0.125 ms" "${thousand[@]}" "${rotation[@]}"
row thousand-lean "fluctuation_dissipation, no rotation, solves to 1e-2" 30 "0.125 ms" "${thousand[@]}" "${lean[@]}"
row long "fluctuation_dissipation, rotation" 300 "0.1 ms" "${rotation[@]}"
row long-thousand "fluctuation_dissipation, rotation" 300 "0.1 ms" "${thousand[@]}" "${rotation[@]}"
row long-lean "fluctuation_dissipation, no rotation, solves to 1e-2" 300 "0.1 ms" "${thousand[@]}" "${lean[@]}"
row long-coarse "k_brown, Stokes drag alone, linearly_implicit" 300 "0.1 ms" "${thousand[@]}" "${coarse[@]}"
if ((${#done_rows[@]} > 1)); then /usr/bin/python3 "$here/cost_errors.py" "$folder" "${done_rows[@]}"; fi
