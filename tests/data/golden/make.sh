#!/usr/bin/env bash
# Makes the golden files anew; not run by any test.
set -eu
bin=$(cd "${PIGMENT_BIN:?folder of the executables}" && pwd)
cd "$(dirname "$0")"
for tool in solids cluster separation mobility; do
  "$bin/pigment-$tool" particles.h5 --quiet --scene scene.yaml -o $tool.h5
done

# The chain, each file from the ones before it; kept compressed, since HDF5's own bookkeeping is most of a small file.
"$bin/pigment-scene" chain.yaml --quiet | sed '/^$/,$d' > chain.txt
"$bin/pigment-pack" chain.yaml --quiet -o packing.h5
"$bin/pigment-dewater" chain.yaml --quiet -o dewatering.h5
"$bin/pigment-kbrown" chain.yaml --quiet -o kbrown.h5
"$bin/pigment-consolidate" chain.yaml --packing packing.h5 --dewatering dewatering.h5 --kbrown kbrown.h5 --quiet -o brownian.h5
sed '/^brownian/d' chain.yaml > smooth.yaml
"$bin/pigment-consolidate" smooth.yaml --packing packing.h5 --dewatering dewatering.h5 --quiet -o smooth.h5
rm smooth.yaml
for name in packing dewatering kbrown brownian smooth; do gzip -9nf $name.h5; done
