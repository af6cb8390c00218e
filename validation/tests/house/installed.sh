#!/bin/sh
# An installation as its users meet it: the program away from its sources, companions, pages, completion, examples.
#   installed.sh PREFIX WORK
set -u
prefix=$1
work=$2
rm -rf "$work" && mkdir -p "$work" && cd "$work" || exit 1
failures=0
fail() {
  echo "FAILED: $*"
  failures=$((failures + 1))
}

for file in bin/treejet share/man/man1/treejet.1 share/man/man5/treejet-deck.5 share/bash-completion/completions/treejet \
  share/doc/treejet/copyright share/doc/treejet/README.md share/treejet/examples/pvp/input.dat \
  share/treejet/examples/peo/input.dat share/treejet/examples/slurm/hybrid.sh share/treejet/python/treejet/view.py; do
  [ -e "$prefix/$file" ] || fail "$file is not installed"
done

PATH=$prefix/bin:$PATH
treejet run "$prefix/share/treejet/examples/peo/input.dat" --out run --quiet --set "final time 2 ms" || fail "a run: $?"
if /usr/bin/python3 -c 'import matplotlib, h5py' 2>/dev/null; then
  treejet view run >/dev/null && [ -s run/view.html ] || fail "treejet view"
  treejet plot run >/dev/null && [ -s run/history.png ] || fail "treejet plot"
fi
if [ -x "$prefix/bin/treejet-validate" ]; then
  treejet-validate time --help | grep -q quick || fail "treejet-validate"
fi

# Pages without a complaint of the formatter, which hold what the tables hold.
for page in man1/treejet.1 man5/treejet-deck.5; do
  if command -v groff >/dev/null; then
    groff -man -ww -z -Tutf8 "$prefix/share/man/$page" 2>warnings
    [ -s warnings ] && fail "$page: $(head -3 warnings)"
  fi
done
grep -q '\\-\\-from DIR' "$prefix/share/man/man1/treejet.1" || fail "the page does not tell of --from"
grep -q 'surface tension <real, g/s^2>' "$prefix/share/man/man5/treejet-deck.5" || fail "the page of decks does not tell of surface tension"

if command -v bash >/dev/null; then
  bash -c '. "$0"; COMP_WORDS=(treejet ru) COMP_CWORD=1; _treejet; echo "${COMPREPLY[*]}"' \
    "$prefix/share/bash-completion/completions/treejet" | grep -qx run || fail "bash does not complete ru to run"
  bash -c '. "$0"; COMP_WORDS=(treejet run --wa) COMP_CWORD=2; _treejet; echo "${COMPREPLY[*]}"' \
    "$prefix/share/bash-completion/completions/treejet" | grep -qx -- --walltime || fail "bash does not complete --wa"
fi

[ $failures = 0 ] || exit 1
