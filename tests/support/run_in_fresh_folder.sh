#!/usr/bin/env bash
# run_in_fresh_folder.sh TEST: runs a shell test in a temporary folder of its own. The folder is removed when the test
# passes or is skipped (status 77), and named when it fails. PIGMENT_BIN holds the executables, PIGMENT_SOURCE the source tree.
set -uo pipefail
test=$1
: "${PIGMENT_BIN:?}" "${PIGMENT_SOURCE:?}"
folder=$(mktemp -d "${TMPDIR:-/tmp}/pigment-$(basename "$test" .test).XXXXXX") || exit 1
cd "$folder" || exit 1
bash "$test"
status=$?
if [[ $status -eq 0 || $status -eq 77 ]]; then
  rm -rf "$folder"
else
  echo "$test: status $status; its files are in $folder" >&2
fi
exit "$status"
