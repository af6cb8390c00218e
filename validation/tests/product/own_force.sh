#!/bin/sh
# The program of examples/own-force, built against the installed library. Usage: own_force.sh TREEJET_DRAG TREEJET SOURCE_TREE
set -u
drag=$(realpath "$1") stock=$2 source=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }
says() { grep -q "$2" "$1" || { fail "$1: expected '$2'"; cat "$1"; }; }

# The PVP jet to 5 ms: some 40 beads by then, more than a step at two rates follows.
run() { "$drag" run "$source/examples/pvp/input.dat" --threads 1 --set "final time 5.d-3" --set "print time 1.d-3" --set "print hdf5 1.d-3" "$@"; }

run --out whole >out 2>err || { fail "a run"; cat err; }
says out "quadratic drag"
says out "two rates"
says out "column lost"
says out "fastest\[1\]"
says whole/statdat.dat "fastest\[1\]"
says whole/statdat.dat "with physics of its own: quadratic drag"
"$stock" info whole/traj.h5 >info 2>err || { fail "info"; cat err; }
says info "lost \[erg\]"
says info "with physics of its own: quadratic drag"
"$stock" info whole/statdat.dat >info 2>err || { fail "info of the table"; cat err; }
says info "fastest\[1\]"
"$stock" convert whole/traj.h5 --to csv --out frames.csv >out 2>err || { fail "convert"; cat err; }
says frames.csv "lost\[erg\]"
# the oldest bead has lost energy to the air, and more in each frame
awk -F, 'NR > 1 && $3 == 1 { if (n++ && $NF <= last) bad = 1; last = $NF } END { exit bad || n < 3 || last <= 0 }' frames.csv ||
  fail "energy lost by the oldest bead does not grow"
"$stock" run "$source/examples/pvp/input.dat" --quiet --threads 1 --set "final time 5.d-3" --set "print time 1.d-3" --out plain >out 2>err || fail "stock physics"
drag_x=$(awk '!/^#/ {x = $2} END {print x}' whole/statdat.dat) plain_x=$(awk '!/^#/ {x = $2} END {print x}' plain/statdat.dat)
awk "BEGIN { exit !($drag_x < $plain_x) }" || fail "drag does not hold the jet back: $drag_x, $plain_x"

run --out parts --walltime 0.002 --quiet >out 2>err
code=$?; [ $code -eq 75 ] || fail "a run of 0.002 s is stopped: $code"
"$stock" run --resume parts >out 2>err
[ $? -eq 2 ] || fail "stock physics must not go on with this run"
says err "resume it with the program that began it"
"$drag" run --resume parts --quiet >out 2>err || { fail "resumed"; cat err; }
cmp whole/traj.h5 parts/traj.h5 || fail "a stopped and resumed run leaves other frames"
cmp whole/statdat.dat parts/statdat.dat || fail "a stopped and resumed run leaves other rows"

run --out cut --set "parallel distributed" --set "coulomb auto" >out 2>err
[ $? -eq 2 ] || fail "an observable of the whole jet in subdomains"
says err "which see the whole jet"

"$drag" check "$source/examples/straight-jet/input.dat" >out 2>err
[ $? -eq 2 ] || fail "a straight jet"
says err "quadratic drag is written for three dimensions"
[ $failures -eq 0 ] && echo "all of a program with physics of its own is as expected"
exit $failures
