#!/bin/bash
# What long runs with the full noise cost: cost.sh BIN FOLDER [PART]. Prints a table (Markdown). BIN: folder of the tools; FOLDER: for
# what is computed; PART: share of the model time that is run, from the settled cake on, and scaled up (1: the whole, an hour or so).
# Nothing else should run beside it. Two threads.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
bin=$1 folder=$2 part=${3:-1}
cake=$here/../filter-cake/scene.yaml
mkdir -p "$folder"
/usr/bin/python3 "$here/../filter-cake/flow.py" 100 0.5 5 > "$folder/flow.csv"
flow=$(realpath "$folder")/flow.csv
times() { /usr/bin/python3 -c "print(f'{$1:g}')"; }
# NAME DURATION STEP OPTIONS...: spheres of 0.5 um that 5 g/m2/s keeps as a cake.
row() {
  local name=$1 duration=$2 step=$3
  shift 3
  local scene=("$cake" --set "dewatering.file=$flow" --set hydrodynamics.rotation=true "$@")
  local run="$folder/$name"
  "$bin/pigment-pack" "${scene[@]}" --quiet -o "$run.packing.h5" >&2
  "$bin/pigment-dewater" "${scene[@]}" --quiet -o "$run.dewatering.h5" 2> /dev/null
  local until; until=$(times "0.5 + ($duration - 0.5) * $part")
  rm -f "$run.json" "$run".checkpoint*
  /usr/bin/python3 "$here/../measured.py" "$run.json" "$bin/pigment-consolidate" "${scene[@]}" --packing "$run.packing.h5" --dewatering "$run.dewatering.h5" --quiet --threads 2 \
    --set stepping.time_step="$step" --set stepping.until="$until s" --set output.every="$(times "($until) / 50") s" -o "$run.h5" >&2
  /usr/bin/python3 - "$run" "$duration" "$until" "$part" <<'PY'
import json, sys
import h5py
run, duration, until, part = sys.argv[1], *map(float, sys.argv[2:])
took = json.load(open(run + ".json"))["seconds"]
with h5py.File(run + ".h5") as f:
    layer = f["particles/layer"]
    n, steps, step = len(layer["radius"]), int(layer["position/step"][-1]), float(f["observables/step_size/value"][1:].mean())
whole = took * duration / until
print(f"| {n} | {duration:g} s | {1e6 * step:.0f} us | {1e3 * took / steps:.2f} ms | {whole / 60:.1f} min{'' if part == 1 else ' (scaled)'} |")
PY
}
echo "| spheres of 0.5 um | model time | step | wall time a step | in all |"
echo "|---|---|---|---|---|"
row thousand 30 "0.125 ms" --set layer.width="5 um" --set layer.thickness="8.727 um"
row long 300 "0.1 ms"
row long-thousand 300 "0.1 ms" --set layer.width="5 um" --set layer.thickness="8.727 um"
