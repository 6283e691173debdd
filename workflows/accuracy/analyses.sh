#!/usr/bin/env bash
# Wall time of the measuring tools, pictures and exports for 20,000 particles of a 30 um layer and 100 frames.
# Usage: analyses.sh BIN FOLDER; `make speed` calls it. Prints a table as docs/speed.md has it; what it
# says besides goes to stderr.
set -euo pipefail
bin=$1 folder=$2 here=$(cd "$(dirname "$0")" && pwd)
scene=$here/../drying/scene.yaml
mkdir -p "$folder"
cd "$folder"
"$bin/pigment-pack" "$scene" --quiet --set layer.thickness="30 um" --set layer.width="8.4 um" -o pack65.h5
# No run is needed to measure one: the packing shrinks evenly to two thirds, with small random steps.
/usr/bin/python3 - <<'PY'
import h5py, numpy as np
frames = 100
with h5py.File('pack65.h5') as source, h5py.File('shrinking.h5', 'w') as f:
    layer, group = source['particles/layer'], f.create_group('particles/layer')
    box = layer['box/edges/value'][0]
    start, count = layer['position/value'][0], len(layer['radius'])
    share = 1 - np.arange(frames) / (frames - 1) / 3
    position = np.repeat(start[None], frames, 0)
    position[:, :, 2] *= share[:, None]
    position[:, :, :2] += np.cumsum(np.random.default_rng(1).normal(0, 4e-9, (frames, count, 2)), 0)
    time = 0.005 * np.arange(frames)
    group['position/value'], group['position/time'], group['position/step'] = position, time, np.arange(frames)
    group['velocity/value'] = np.gradient(position, time, axis=0).astype('f4')
    group['box/edges/value'] = box * np.c_[np.ones(frames), np.ones(frames), share]
    for name in ('radius', 'mass', 'species', 'id'):
        group[name] = layer[name][:]
    print(f'| | s, for {count} particles and {frames} frames |\n|---|---|')
PY
timed() {  # name command...
  local name=$1 begin end
  shift
  begin=$(date +%s.%N)
  "$@" --quiet 2> "$name.log" || { cat "$name.log" >&2; exit 1; }
  end=$(date +%s.%N)
  awk -v n="$name" -v b="$begin" -v e="$end" 'BEGIN { printf "| %s | %.1f |\n", n, e - b }'
}
for tool in solids cluster separation mobility; do
  timed $tool "$bin/pigment-$tool" shrinking.h5 -o $tool.h5
done
timed picture "$bin/pigment-render" shrinking.h5 --size 1600x1200 --view oblique -o picture.png
timed connections "$bin/pigment-render" shrinking.h5 --size 1600x1200 --connections --threshold "10 nm" -o connections.png
for ending in xdmf xyz nm.h5; do
  timed "export-$ending" "$bin/pigment-export" shrinking.h5 -o "export.$ending"
done
timed report "$bin/pigment-report" shrinking.h5 solids.h5 cluster.h5 separation.h5 mobility.h5 -o report.html
awk -v b="$(stat -c %s report.html)" 'BEGIN { printf "\nThe report has %.1f MB.\n", b / 1e6 }'
