#!/usr/bin/env bash
# What hindered drag changes in a draining layer: the same packing drains through its substrate with either drag. Prints
# docs/hindered-drag.md. Usage: measure.sh BIN FOLDER; `make hindered-drag` calls it.
set -euo pipefail
bin=$1 folder=$2 here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$folder"
cd "$folder"
"$bin/pigment-pack" "$here/scene.yaml" --quiet -o packing.h5
"$bin/pigment-dewater" "$here/scene.yaml" --quiet -o dewatering.h5
for drag in stokes hindered; do
  rm -f "$drag".*
  "$bin/pigment-consolidate" "$here/scene.yaml" --packing packing.h5 --dewatering dewatering.h5 --quiet \
    --set hydrodynamics.drag="$drag" -o "$drag.h5"
  "$bin/pigment-solids" "$drag.h5" --quiet --scene "$here/scene.yaml" -o "$drag-solids.h5"
done
/usr/bin/python3 "$here/table.py" stokes hindered
