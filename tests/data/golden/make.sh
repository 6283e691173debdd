#!/usr/bin/env bash
# Makes the golden files anew; not run by any test.
set -eu
bin=$(cd "${PIGMENT_BIN:?folder of the executables}" && pwd)
cd "$(dirname "$0")"
for tool in solids cluster separation mobility; do
  "$bin/pigment-$tool" particles.h5 --quiet --scene scene.yaml -o $tool.h5
done
