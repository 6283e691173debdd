#!/usr/bin/env bash
# Speed against error: packs and steps layers, prints a table. Usage: measure.sh BIN FOLDER; `make speed` calls it.
# Errors of the stepper are against its own tightest tolerance, for the measures that docs/speed.md defines.
set -euo pipefail
bin=$1 folder=$2 here=$(cd "$(dirname "$0")" && pwd)
scene=$here/../drying/scene.yaml
mkdir -p "$folder"
cd "$folder"
timed() {  # name command...: runs the command, keeps its wall time in NAME.seconds
  local name=$1 begin end
  shift
  begin=$(date +%s.%N)
  "$@" --quiet
  end=$(date +%s.%N)
  awk -v b="$begin" -v e="$end" 'BEGIN { printf "%.1f\n", e - b }' > "$name.seconds"
}
# 20,000 particles at 65 wt-%; 5,000 at 78 wt-%.
timed pack65 "$bin/pigment-pack" "$scene" --set layer.thickness="30 um" --set layer.width="8.4 um" -o pack65.h5
timed pack78 "$bin/pigment-pack" "$scene" --set layer.thickness="12 um" --set layer.width="5.57 um" --set layer.solids="78 wt%" -o pack78.h5
# The drying study's layer without Brownian motion, to 0.1 s.
"$bin/pigment-pack" "$scene" --quiet -o packing.h5
"$bin/pigment-dewater" "$scene" --quiet -o dewatering.h5
grep -v '^brownian' "$scene" > still.yaml
for tolerance in 1e-2 1e-3 1e-4 1e-5; do
  rm -f "t$tolerance".*
  timed "t$tolerance" "$bin/pigment-consolidate" still.yaml --packing packing.h5 --dewatering dewatering.h5 \
    --set stepping.tolerance="$tolerance" --set stepping.until="0.1 s" --set stepping.stop_when=until -o "t$tolerance.h5"
  "$bin/pigment-solids" "t$tolerance.h5" --quiet -o "s$tolerance.h5"
  "$bin/pigment-separation" "t$tolerance.h5" --quiet -o "g$tolerance.h5"
done
/usr/bin/python3 "$here/table.py" 1e-5 1e-2 1e-3 1e-4
