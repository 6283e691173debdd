#!/usr/bin/env bash
# replace_if_changed.sh FILE COMMAND...: takes what COMMAND writes to stdout into FILE. A FILE that holds the same bytes
# already keeps its time; when COMMAND fails, it stays as it is.
set -euo pipefail
file=$1
shift
new=$file.new.$$
trap 'rm -f "$new"' EXIT
"$@" > "$new"
cmp -s "$new" "$file" || mv "$new" "$file"
