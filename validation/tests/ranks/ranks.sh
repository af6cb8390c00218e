#!/bin/sh
# Runs on several ranks and threads: the same bytes as on one, and the right end when something goes wrong.
# Usage: ranks.sh all|some TREEJET SOURCE_TREE MPIEXEC NUMPROC_FLAG
set -u
extent=$1 treejet=$2 source=$3 mpiexec=$4 flag=$5
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0

# A container's root may start Open MPI, on more ranks than cores, whose threads then must not spin; two ranks are not to be
# bound to a core each, which other programs may hold.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
export OMPI_MCA_hwloc_base_binding_policy=none OMP_WAIT_POLICY=passive OMP_DYNAMIC=false

# What the MPI library leaves allocated is not ours.
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0"

fail() { echo "FAILED: $*"; failures=$((failures + 1)); }
is() { [ "$2" = "$3" ] || fail "$1: expected '$3', found '$2'"; }
on() { ranks=$1; shift; timeout 300 "$mpiexec" "$flag" "$ranks" "$@"; }

# scene "DIRECTIVES" RANKSxTHREADS...: the files of a run by each of these against those of one rank and thread.
scene() {
  name=$(echo "$1" | tr '\n' ' ')
  { grep -v '^finish' "$source/validation/decks/stream.dat" && printf '%s\nfinish\n' "$1"; } >deck.dat
  shift
  rm -rf one many
  "$treejet" run deck.dat --quiet --threads 1 --out one 2>err || fail "$name: $(cat err)"
  is "$name: beads removed" "$(tail -1 one/statdat.dat | awk '{print int($5)}')" 7
  for workers; do
    on "${workers%x*}" "$treejet" run deck.dat --quiet --threads "${workers#*x}" --out many --force 2>err ||
      fail "$name on $workers: $(cat err)"
    for file in statdat.dat traj.xyz traj.h5 traj.xdmf; do
      cmp -s one/$file many/$file || fail "$name: $file differs on $workers (ranks x threads)"
    done
  done
}

fixed='timestep 1.d-6
integrator heun'
noisy='airdrag yes
airdrag model full
airdrag airvelocity -200.
noise yes
noise diffusivity 1.d6
noise interval 3.d-6'
tree='coulomb tree
coulomb accuracy 1.d-3'
if [ "$extent" = all ]; then
  for ranks in 1 2 3 5; do for threads in 1 2 4; do all="${all-} ${ranks}x$threads"; done; done
  for steps in "$fixed" "tolerance 1.d-6" "tolerance 1.d-6
multirate no" "tolerance 1.d-6
integrator kencarp5" "$fixed
events step"; do
    for sum in "coulomb direct" "$tree" "$tree
coulomb tree space" "$tree
coulomb expansions none" "cutoff 0.1"; do
      # shellcheck disable=SC2086  # a list of words
      scene "$steps
$sum" $all
    done
  done
else
  scene "$fixed" 2x1 3x2 5x4
  scene "$fixed
$tree" 5x1 2x2
  scene "tolerance 1.d-6" 3x1 2x4
  scene "tolerance 1.d-6
$tree" 2x1 3x4
  scene "tolerance 1.d-6
multirate no" 5x2
  scene "tolerance 1.d-5
$noisy" 3x2
  scene "timestep 1.d-6
integrator 4
$noisy" 2x1
  scene "tolerance 1.d-6
multirate no
$tree
coulomb tree space" 3x1
fi

[ "$extent" = all ] && exit $((failures > 0))

# ends CODE WORDS WHAT COMMAND...: the exit code, and one message of ours, which holds the words
ends() {
  code=$1 words=$2 what=$3
  shift 3
  "$@" >out 2>err
  is "exit code of $what" $? "$code"
  is "messages of $what" "$(grep '^treejet: ' err | grep -vc 'treejet: warning')" 1
  grep -q "^treejet: .*$words" err || fail "$what: no '$words' in: $(cat err)"
}

pvp=$source/examples/pvp/input.dat
set -- run "$pvp" --quiet --set "final time 1.d-3" --set "print time 1.d-4" --set "cutoff 0.02"
on 5 "$treejet" "$@" --out few 2>err || fail "more ranks than beads: $(cat err)"
"$treejet" "$@" --out alone
cmp -s few/statdat.dat alone/statdat.dat || fail "more ranks than beads: other numbers"
set -- run "$pvp" --quiet --set "final time 4.d-3" --set "self field slender" --set "print time 1.d-3" --set "print hdf5 1.d-3" \
  --set "dynamic refinement yes" --set "dynamic refinement tolerance 1.d-2" --set "printstat list t x n nref"
on 3 "$treejet" "$@" --threads 2 --out refined 2>err || fail "a jet that refines: $(cat err)"
"$treejet" "$@" --threads 1 --out refined-alone
for file in statdat.dat traj.h5; do
  cmp -s refined/$file refined-alone/$file || fail "a jet that refines: $file differs on three ranks"
done
[ "$(tail -1 refined/statdat.dat | awk '{print ($4 > 50)}')" = 1 ] || fail "a jet that should have refined"
is "versions that three ranks print" "$(on 3 "$treejet" --version | wc -l | tr -d ' ')" 1

ends 2 "did you mean viscosity" "a wrong deck" on 3 "$treejet" run "$pvp" --out wrong --set "viscosty 3"
ends 2 "not expected: --fast" "a wrong argument" on 2 "$treejet" run "$pvp" --fast
ends 3 "likely cause" "a numerical failure" on 3 "$treejet" run "$pvp" --out stopped --quiet \
  --set "integrator 2" --set "timestep 1.d-3" --set "final time 5.d-2" --set "print time 1.d-3"
ends 4 "has come to its end here" "a run over existing results" on 2 "$treejet" run "$pvp" --quiet --out few
if [ -w /dev/full ]; then
  mkdir full && ln -s /dev/full full/statdat.dat
  ends 4 "writing failed" "a full disk on the first rank" on 3 "$treejet" run "$pvp" --quiet --out full --force
fi
ends 2 "different arguments" "ranks with different decks" "$mpiexec" "$flag" 1 "$treejet" run "$pvp" --quiet --out wrong : \
  "$flag" 1 "$treejet" run "$pvp" --quiet --set "viscosity 3." --out wrong
ends 2 "vectors" "ranks with different vectors" "$mpiexec" "$flag" 1 "$treejet" run "$pvp" --quiet --out wrong : \
  "$flag" 1 env TREEJET_VECTOR_PATH=plain "$treejet" run "$pvp" --quiet --out wrong
[ -e wrong ] && fail "ranks that could not begin left something behind"

# a noisy jet in subdomains: the rows of the replicated one, but for the accuracy of the field
alike() {  # WHAT DIRECTORY DIRECTORY
  for files in "$2" "$3"; do grep -v '^#' "$files/statdat.dat" >"$files.rows"; done
  paste "$2.rows" "$3.rows" | awk '
    { for (k = 1; k <= NF / 2; ++k) { d = $k - $(k + NF / 2); if (d * d > 1e-12 * $k * $k + 1e-20) { print "row", NR, "column", k, $k, $(k + NF / 2); bad = 1 } } }
    END { exit bad || NR == 0 }' >differences || fail "$1: $(head -3 differences)"
}
run="$treejet run deck.dat --quiet --threads 1 --force"
{ grep -v '^finish\|^coulomb' deck.dat && printf '%s\nfinish\n' "$noisy"; } >noisy.dat
mv noisy.dat deck.dat
grep -q '^multirate' deck.dat || sed -i 's/^finish/multirate no\nfinish/' deck.dat
$run --out one || fail "the jet that is to be cut"
sed -i 's/^finish/coulomb tree\ncoulomb accuracy 1.d-5\nparallel distributed\nfinish/' deck.dat
on 3 $run --out subdomains 2>err || fail "a jet in subdomains: $(cat err)"
alike "a jet in subdomains" one subdomains
is "points in the trajectory of a jet in subdomains" "$(head -1 subdomains/traj.xyz)" "$(head -1 one/traj.xyz)"

# one of the ranks is killed: the others end, the launcher tells, and the run goes on on other ranks
running() { for pid in killed/*.pid; do ps -o stat= -p "$(cat "$pid")"; done | grep -vc Z; }
kill_one() {  # FILE COMMAND...: of three ranks, once there is this file
  file=$1
  shift
  rm -rf killed && mkdir killed
  # shellcheck disable=SC2016  # the ranks' shell expands it
  on 3 sh -c 'echo $$ >killed/$$.pid; exec "$@"' rank "$@" 2>err &
  launcher=$!
  while [ "$(ls killed/*.pid 2>/dev/null | wc -l)" -lt 3 ] || [ ! -s "$file" ]; do
    kill -0 $launcher 2>/dev/null || { fail "no rank to kill: $(cat err)"; return; }
    sleep 0.01
  done
  kill -9 "$(cat "$(ls killed/*.pid | tail -1)")"
  wait $launcher
  code=$?
  [ $code -ne 0 ] && [ $code -ne 124 ] || fail "a killed rank: exit code $code"
  tries=0
  while [ "$(running)" -gt 0 ] && [ $tries -lt 50 ]; do sleep 0.1 && tries=$((tries + 1)); done
  is "ranks left running by a killed one" "$(running)" 0
}
kill_one lost/statdat.dat "$treejet" run "$pvp" --quiet --set "tolerance 1.d-12" --out lost
kill_one cut/checkpoint $run --set "checkpoint 0.01" --set "final time 2.d-4" --out cut
on 2 "$treejet" run --resume cut --quiet --walltime 600 2>err || fail "a jet in subdomains resumed on other ranks: $(cat err)"
on 3 $run --set "final time 2.d-4" --out subdomains 2>err || fail "a jet in subdomains: $(cat err)"
alike "a jet in subdomains that lost a rank" subdomains cut

# the program's choice: subdomains of five thousand beads and more, which a run that is resumed keeps
holds() {  # RANKS WORDS COMMAND...
  ranks=$1 words=$2
  shift 2
  on "$ranks" "$@" >out 2>err
  is "what each of $ranks ranks holds" "$(grep -o 'each with [a-z]* [a-z]*' out)" "each with $words"
}
set -- deck.dat --force --out chosen --set "parallel auto" --set "points 10200"
on 2 "$treejet" run "$@" --quiet --set "checkpoint 0.01" --walltime 0.5 2>err
holds 3 "a subdomain" "$treejet" run --resume chosen --walltime 1
holds 2 "a subdomain" "$treejet" run "$@" --set "final time 4.d-7"
holds 3 "the whole" "$treejet" run "$@" --set "final time 4.d-7"

[ $failures = 0 ] || exit 1
