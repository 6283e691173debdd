#!/usr/bin/env bash
# Installs what building, testing and running pigment need on Debian 12, and only what is missing.
#   cmake/install-dependencies.sh          check, install what is missing (needs root or sudo)
#   cmake/install-dependencies.sh --list   print the packages and why each is needed
# Silent and quick when everything is there; it then needs neither root nor a network.
set -euo pipefail

packages=(
  "g++               the compiler (C++20)"
  "cmake             configures the build"
  "ninja-build       runs the build"
  "libeigen3-dev     dense vectors and matrices (Eigen)"
  "libsuitesparse-dev  the order in which a sparse matrix is eliminated (AMD)"
  "libhdf5-dev       result files (HDF5)"
  "libyaml-cpp-dev   scenes (YAML)"
  "libgsl-dev        special functions, splines, statistics (GSL)"
  "libcli11-dev      command lines (CLI11)"
  "libfmt-dev        messages (fmt)"
  "libudunits2-dev   units of quantities (udunits2)"
  "librandom123-dev  counter-based random numbers (Random123)"
  "voro++-dev        the space that belongs to each particle (Voro++)"
  "libpng-dev        pictures (PNG)"
  "zlib1g-dev        packs the particles of the report's 3-D view (zlib)"
  "libssl-dev        SHA-256 of input files (OpenSSL)"
  "libgtest-dev      unit tests (GoogleTest)"
  "libbenchmark-dev  benchmarks (Google Benchmark)"
  "python3-h5py      tests and studies: reads and writes HDF5 without our own code"
  "python3-scipy     studies: statistical tests, integrals, ordinary differential equations"
  "python3-matplotlib  studies: figures fit for a paper"
)

if [[ ${1:-} == --list ]]; then
  printf '%s\n' "${packages[@]}"
  exit 0
elif [[ $# -gt 0 ]]; then
  echo "usage: $0 [--list]" >&2
  exit 2
fi

if ! command -v dpkg-query >/dev/null; then
  echo "$0: this is no Debian system, so nothing was checked. pigment needs the equivalents of:" >&2
  printf '  %s\n' "${packages[@]}" >&2
  exit 0
fi

missing=()
for line in "${packages[@]}"; do
  package=${line%% *}
  status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
  [[ $status == installed ]] || missing+=("$line")
done
[[ ${#missing[@]} -gt 0 ]] || exit 0

echo "pigment needs ${#missing[@]} package(s) that are not installed:" >&2
printf '  %s\n' "${missing[@]}" >&2

if [[ $(id -u) -eq 0 ]]; then
  as_root=()
elif command -v sudo >/dev/null && { [[ -t 0 ]] || sudo -n true 2>/dev/null; }; then
  as_root=(sudo)
else
  echo "They cannot be installed from here: this is not root, and sudo is not there or wants a password. Ask for:" >&2
  echo "  apt-get install --no-install-recommends ${missing[*]%% *}" >&2
  exit 1
fi

apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=300 -o Acquire::Retries=3)
"${apt[@]}" update >&2 || echo "the package lists could not be updated; trying with those that are there" >&2
if ! "${apt[@]}" install -y --no-install-recommends "${missing[@]%% *}" >&2; then
  echo "installing failed (see above); pigment cannot be built without these packages" >&2
  exit 1
fi
