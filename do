#!/bin/sh
# The two commands of the README. Each does all set-up by itself and leaves alone what is already there.
#   ./do run     install what is missing, build, spin the paper's PVP jet into results/pvp and draw it
#   ./do test    install what is missing, build, run the tests
set -eu
[ "${1-}" = functions ] || cd "$(dirname "$0")"

for_building="g++ cmake ninja-build libeigen3-dev libfmt-dev libcli11-dev zlib1g-dev libhdf5-dev nlohmann-json3-dev
  libopenmpi-dev openmpi-bin"
for_pictures="python3-matplotlib python3-h5py"
for_tests="catch2 libfftw3-dev libsundials-dev hdf5-tools python3-h5py python3-ase python3-matplotlib python3-jinja2
  python3-pandas python3-pytest dpkg-dev file mkdocs"
for_ci="clang libomp-dev libclang-rt-dev llvm gcovr clang-format doxygen chromium python3-pil python3-venv"
from_pypi="h5py numpy ovito==3.17.2 MDAnalysis==2.11.0 chemfiles==0.10.4 gsd==5.0.1 vtk==9.7.2 ase pandas"

log=build/do.log

say() { printf '%s\n' "$*"; }

fail() {
  printf './do: %s\n' "$*" >&2
  exit 1
}

# steps: of the lines that it reads those with [n/m] or [ n%], in place on a terminal, else one in half a minute
steps() {
  told=$(date +%s)
  while IFS= read -r line; do
    case $line in
      \[*[0-9]/[0-9]*\]* | \[*[0-9]%\]*) ;;
      *) continue ;;
    esac
    step=${line%%\]*}]
    if [ -t 1 ]; then
      printf '\r\033[K== %s ... %s' "$what" "$step"
    elif [ $(($(date +%s) - told)) -ge 30 ]; then
      told=$(date +%s)
      printf '%s ... ' "$step"
    fi
  done
}

# quietly WHAT COMMAND...: how far it is and its seconds if it works, the end of its output if it does not
quietly() {
  what=$1 begin=$(date +%s)
  shift
  printf '== %s ... ' "$what"
  rm -f "$log.failed"
  { "$@" 2>&1 </dev/null || : >"$log.failed"; } | tee "$log" | steps
  if [ -t 1 ]; then printf '\r\033[K== %s ... ' "$what"; fi
  if [ ! -e "$log.failed" ]; then
    say "done in $(($(date +%s) - begin)) s"
  else
    say failed
    tail -n 40 "$log" >&2
    fail "failed: $*   (the whole output: $log)"
  fi
}

present() {
  case $1 in
    g++) command -v c++ ;;
    cmake) command -v cmake ;;
    ninja-build) command -v ninja || command -v make ;;
    *) [ "$(dpkg-query --show --showformat='${db:Status-Status}' "$1" 2>/dev/null)" = installed ] ;;
  esac >/dev/null
}

as_root() {
  if [ "$(id -u)" = 0 ]; then "$@"; else sudo "$@"; fi
}

install_missing() {
  missing=
  for package; do present "$package" || missing="$missing $package"; done
  [ -n "$missing" ] || return 0
  command -v apt-get >/dev/null || fail "no apt-get here; install the equivalents of these Debian packages:$missing"
  if [ "$(id -u)" != 0 ]; then
    command -v sudo >/dev/null || fail "neither root nor sudo; have an administrator run: apt-get install$missing"
    say "== these packages are missing, sudo installs them:$missing"
    sudo -v || fail "sudo refused; have an administrator run: apt-get install$missing"
  fi
  quietly "Reading the package lists" as_root apt-get -qq update
  # shellcheck disable=SC2086  # a list of words
  quietly "Installing$missing" as_root env DEBIAN_FRONTEND=noninteractive \
    apt-get -qq install --yes --no-install-recommends $missing
}

# build TESTS TARGET: in build/release, with ninja if it is there, else make
build() {
  generator=
  if [ ! -e build/release/CMakeCache.txt ] && command -v ninja >/dev/null; then generator=-GNinja; fi
  # shellcheck disable=SC2086  # no word if empty
  quietly "Configuring" cmake --preset release $generator -DTREEJET_TESTS="$1"
  quietly "Building in build/release" cmake --build build/release --target "$2" --parallel "$(nproc)"
}

mkdir -p build
case ${1-} in
  run)
    # shellcheck disable=SC2086  # lists of words
    install_missing $for_building $for_pictures
    if present catch2; then tests=ON; else tests=OFF; fi
    build $tests treejet
    say "== Built build/release/treejet; it tells the rest: build/release/treejet --help"
    say "== treejet run examples/pvp/input.dat --out results/pvp --set \"print hdf5 2.d-4\""
    build/release/treejet run examples/pvp/input.dat --out results/pvp --force --set "print hdf5 2.d-4"
    say "== Pictures, and a page for the browser"
    build/release/treejet plot results/pvp
    build/release/treejet view results/pvp
    ;;
  test)
    # shellcheck disable=SC2086  # lists of words
    install_missing $for_building $for_tests
    build ON all
    ctest --test-dir build/release --output-on-failure --parallel "$(nproc)"
    ;;
  functions) ;; # .ci/run takes what stands above
  *)
    sed -n '2,4s/^# //p' "$(basename "$0")"
    exit 2
    ;;
esac
