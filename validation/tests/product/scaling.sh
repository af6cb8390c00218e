#!/bin/sh
# treejet-validate scaling --deck: the table of a few steps, what it claims of more workers than cores, and right errors.
# Usage: scaling.sh TREEJET_VALIDATE SOURCE_TREE MPI_OR_EMPTY
set -u
validate=$1 source=$2 mpi=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0
fail() { echo "FAILED: $*"; failures=$((failures + 1)); }
is() { [ "$2" = "$3" ] || fail "$1: expected '$3', found '$2'"; }
export ASAN_OPTIONS="${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0"

{ grep -v '^finish' "$source/validation/decks/stream.dat" && printf 'timestep 1.d-6\nintegrator heun\ncoulomb tree\nfinish\n'; } >deck.dat
# more threads than this machine has cores
threads=$(($(nproc --all) + 1))
ranks=
[ -n "$mpi" ] && ranks='--ranks 1,2'

# shellcheck disable=SC2086  # options
"$validate" scaling --deck deck.dat $ranks --threads "1,$threads" --steps 5 --turns 1 --out table >out 2>&1 || fail "$(cat out)"
column() { awk -F, -v name="$1" 'NR == 1 { for (k = 1; k <= NF; ++k) if ($k == name) at = k; next } { print $at }' table/scaling_deck.csv; }
is "rows" "$(column workers | wc -l | tr -d ' ')" "$([ -n "$mpi" ] && echo 6 || echo 2)"
is "steps of all teams" "$(column steps | sort -u)" 5
is "evaluations of Heun's scheme: two a step and one after an event" "$(column evaluations | awk '$1 < 10 || $1 > 15' | wc -l | tr -d ' ')" 0
grep -c 'correctness only' table/scaling_deck.csv >crowded
# the column of the efficiency is empty, and that of the memory not
paste -d, table/scaling_deck.csv /dev/null | grep 'correctness only' | grep -v ',,,,,,,,,,,,' && fail "a claim about more workers than cores"
is "memory of all teams" "$(column 'memory [MB]' | grep -c '^[1-9]')" "$(column workers | wc -l | tr -d ' ')"
is "rows for a paper" "$(grep -c '^| [1-9]' table/scaling_deck.md)" "$(column workers | wc -l | tr -d ' ')"
# parts of the serial program's time add up to it: the table has four digits more than needed
awk -F, 'NR == 1 { for (k = 1; k <= NF; ++k) at[$k] = k; next }
  NR == 2 { split("steps multirate local build upward exchange evaluate tuning output", part, " ")
    for (k in part) sum += $at[part[k] " [us]"]
    d = sum / $at["evaluation [us]"] - 1; exit d * d > 1e-6 }' table/scaling_deck.csv || fail "parts that are not the whole"
[ -e table/deck-run ] && fail "files of the measured runs are left"

# ends CODE WORDS ARGUMENTS...
ends() {
  code=$1 words=$2
  shift 2
  "$validate" "$@" --out errors >out 2>&1
  is "exit code of $*" $? "$code"
  grep -q -e "$words" out || fail "$*: no '$words' in: $(cat out)"
}
ends 2 "requires --deck" scaling --workers 1,2
ends 2 "does not exist" scaling --deck nowhere.dat
ends 2 "excludes" scaling --deck deck.dat --workers 2 --ranks 2
ends 2 "not in range" scaling --deck deck.dat --threads 0
ends 2 "not in range" scaling --deck deck.dat --steps 0
ends 2 "did you mean viscosity" scaling --deck deck.dat --set "viscosty 3."
ends 4 "no such directory" scaling --deck deck.dat --from nowhere
ends 2 "replicated" scaling --deck deck.dat --data none
ends 4 "before there was one to measure" scaling --deck deck.dat --set "inserting no" --set "points 1" --threads 1
# a straight jet is not cut: without subdomains, or with the deck's own words
ends 0 "without parallel distributed" scaling --deck "$source/examples/straight-jet/input.dat" --threads 1 --steps 3 --turns 1
ends 2 "system 1" scaling --deck "$source/examples/straight-jet/input.dat" --data distributed --threads 1 --steps 3

# serial programs side by side, each on a core of its own, where there are two
"$validate" scaling --deck deck.dat --workers 1,2 --data replicated --steps 5 --turns 1 --out copies >out 2>&1 || fail "$(cat out)"
is "rows of copies" "$(grep -c '"copies"' copies/scaling_deck.csv)" "$(awk '/physical cores/ { print ($0 !~ / 1 physical/) }' out)"
grep '"copies"' copies/scaling_deck.csv | grep -q '"\([0-9][0-9]*\),\1"' && fail "copies on one core"

# begun with the state of another run, by all teams
"${validate%-validate}" run deck.dat --quiet --set "coulomb direct" --out begun --threads 1 || fail "a run to begin with"
# shellcheck disable=SC2086
"$validate" scaling --deck deck.dat --from begun $ranks --threads 1 --steps 3 --turns 1 --out later >out 2>&1 || fail "$(cat out)"
is "beads of all teams that begin alike" "$(awk -F, 'NR > 1 { print $5 }' later/scaling_deck.csv | sort -u | wc -l | tr -d ' ')" 1

[ $failures = 0 ] || exit 1
