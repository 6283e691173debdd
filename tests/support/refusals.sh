# Source this. refuses STATUS TEXT COMMAND...: the command ends with STATUS, says TEXT on stderr, and leaves no output.h5.
refuses() {
  local status=$1 text=$2 found=0
  shift 2
  rm -f output.h5
  "$@" > refused.out 2> refused.err || found=$?
  if [ "$found" -ne "$status" ]; then
    echo "expected status $status, found $found: $*" >&2
    cat refused.err >&2
    return 1
  fi
  if ! grep -qF -e "$text" refused.err; then
    echo "no \"$text\" in what it said: $*" >&2
    cat refused.err >&2
    return 1
  fi
  if [ -e output.h5 ] || ls ./*.part > /dev/null 2>&1; then
    echo "left an output behind: $*" >&2
    return 1
  fi
}

# What every tool that measures a particle file refuses.
refuses_bad_particle_files() {
  local tool=$1
  for kind in nan empty no_radius negative below; do
    /usr/bin/python3 "$PIGMENT_SOURCE/tests/support/hand_made.py" $kind $kind.h5
    refuses 3 $kind.h5 "$tool" $kind.h5 -o output.h5
  done
  refuses 3 missing.h5 "$tool" missing.h5 -o output.h5
  echo 'not HDF5' > text.h5
  refuses 3 text.h5 "$tool" text.h5 -o output.h5
  /usr/bin/python3 "$PIGMENT_SOURCE/tests/support/hand_made.py" random whole.h5 300 3
  head -c 3000 whole.h5 > cut.h5
  refuses 3 cut.h5 "$tool" cut.h5 -o output.h5
  refuses 2 clutser_threshold "$tool" whole.h5 --set 'analysis.clutser_threshold=20 nm' -o output.h5
  refuses 2 'write e.g.' "$tool" whole.h5 --set 'analysis.cluster_threshold=20' -o output.h5
  echo 'analysis: {slices: many}' > bad.yaml
  refuses 2 bad.yaml:1 "$tool" whole.h5 --scene bad.yaml -o output.h5
  refuses 2 '' "$tool"
  refuses 2 '' "$tool" whole.h5 -o output.h5 --unknown
  refuses 4 nowhere "$tool" whole.h5 -o nowhere/output.h5
  refuses 2 whole.h5 "$tool" whole.h5 -o whole.h5
}

# The same bytes at 1 and 2 threads.
same_bytes_at_any_thread_count() {
  local tool=$1
  /usr/bin/python3 "$PIGMENT_SOURCE/tests/support/hand_made.py" random many.h5 1500 21
  "$tool" many.h5 --quiet --threads 1 -o one.h5
  "$tool" many.h5 --quiet --threads 2 -o two.h5
  cmp one.h5 two.h5
}
