#!/bin/sh
# The program as a user meets it: exit codes, what is written and what is not. Usage: front_door.sh TREEJET SOURCE_TREE
set -u
treejet=$1
source=$2
work=$(mktemp -d)
trap 'chmod -R u+w "$work"; rm -rf "$work"' EXIT
cd "$work" || exit 1
failures=0

fail() { echo "FAILED: $*"; failures=$((failures + 1)); }
is() { [ "$2" = "$3" ] || fail "$1: expected '$3', found '$2'"; }

# expect CODE WHAT COMMAND...: the exit code; output stays in out and err
expect() {
  code=$1 what=$2
  shift 2
  "$@" >out 2>err
  is "exit code of $what" $? "$code"
}

# A short run of the PVP jet: 0.5 ms, rows every 0.1 ms, frames of 12 lines every 0.25 ms.
pvp=$source/examples/pvp/input.dat
threads=1
short() { "$treejet" run "$pvp" --threads $threads --set "final time 5.d-4" --set "print time 1.d-4" --set "print xyz 2.5d-4" --set "print xyz maxnum 12" "$@"; }

expect 0 "a run" short --out a
is "files of a run" "$(ls a | tr '\n' ' ')" "checkpoint.end run.json statdat.dat traj.xyz "
is "first line of statdat.dat" "$(head -1 a/statdat.dat)" "# t[s] x[cm] yz[cm] n[1] vn[cm/s] vc[cm/s] curn[statC/s] curc[statC/s] rc[cm] rrr[1] lp[cm] angl[degree]"
is "rows of statdat.dat" "$(grep -vc '^#' a/statdat.dat)" 6
is "numbers in each row" "$(grep -v '^#' a/statdat.dat | awk '{print NF}' | sort -u)" 12
is "times of the rows" "$(grep -v '^#' a/statdat.dat | awk '{printf "%.1f ", $1 * 1e4}')" "0.0 1.0 2.0 3.0 4.0 5.0 "
is "frames of traj.xyz" "$(grep -c '^t = ' a/traj.xyz)" 3
is "lines of traj.xyz" "$(wc -l <a/traj.xyz | tr -d ' ')" $((3 * 14))
is "line counts of the frames" "$(awk 'NR % 14 == 1' a/traj.xyz | sort -u)" 12
is "first frame" "$(sed -n 3,5p a/traj.xyz | tr '\n' ';')" "C 0.02 0 0;C 0 0.001 0;C 0 0 0;"
is "padding of the first frame" "$(sed -n 3,14p a/traj.xyz | grep -c '^C 0 0 0$')" 10
grep -q 'x\[cm\]' out || fail "the terminal shows no table"
grep -q '^done in' out || fail "the terminal shows no summary"

cp a/statdat.dat before
expect 4 "a run over existing results" short --out a
cmp -s before a/statdat.dat || fail "existing results were touched"
grep -q -- --force err || fail "the message does not tell of --force"
expect 0 "a run with --force" short --out a --force
expect 0 "a run with frames" short --set "print hdf5 1.d-4" --out replaced
touch replaced/traj.gsd
expect 0 "one without in its place" short --out replaced --force
is "files where a run has replaced another" "$(ls replaced | tr '\n' ' ')" "checkpoint.end run.json statdat.dat traj.gsd traj.xyz "
cmp -s before a/statdat.dat || fail "the same run gave other numbers"

expect 0 "a quiet run" short --out quiet --quiet
is "what a quiet run prints" "$(cat out err)" ""
cmp -s before quiet/statdat.dat || fail "a quiet run gave other numbers"

expect 0 "a run with --set" short --out set --set "external potential 20."
cmp -s before set/statdat.dat && fail "--set changed nothing"

expect 0 "a run without outputs" "$treejet" run "$source/examples/single-bead/input.dat" --quiet --out none --set "final time 1.d-6" --set "print time 1.d-7"
is "files of a run that asks for statdat.dat only" "$(ls none | tr '\n' ' ')" "checkpoint.end run.json statdat.dat "

expect 0 "a run with a tree" short --out tree --set "points 600" --set "initial length 12" --set "coulomb tree" --set "coulomb accuracy 1.d-4" --set "printstat list t n ferr ferrmax"
grep -q '^# t = .*tree of order' tree/statdat.dat || fail "statdat.dat does not tell how the forces were computed"
grep -q '^forces: .*asked for 0.0001' out || fail "the summary does not tell the force error"
is "warnings of its accuracy in a run with a tree" "$(grep -c "warning.*accuracy" err)" 0
expect 0 "a run that misses its accuracy" short --out missed --set "points 600" --set "initial length 12" --set "coulomb tree" --set "coulomb accuracy 1.d-9" --set "coulomb order 2" --set "coulomb opening 0.9"
grep -q 'warning.*accuracy' err || fail "a missed accuracy is not warned of"
grep -q 'ACCURACY MISSED' out || fail "the summary does not tell of a missed accuracy"

sed 's/viscosity/viscosty/' "$pvp" >misspelt.dat
expect 2 "a misspelt directive" "$treejet" run misspelt.dat --out wrong
grep -q 'misspelt.dat:[0-9]*:.*viscosity' err || fail "the message does not lead to viscosity: $(cat err)"
[ -e wrong ] && fail "a wrong deck left something behind"
expect 2 "a misspelt override" short --out wrong --set "viscosty 3"
[ -e wrong ] && fail "a wrong override left something behind"
expect 2 "an unknown option" "$treejet" run "$pvp" --fast
expect 2 "no command" "$treejet"
expect 2 "a misspelt command" "$treejet" runn x
grep -q 'did you mean run?' err || fail "the message does not name the nearest command: $(cat err)"
expect 2 "a directive without quotes" "$treejet" run "$pvp" --set final time 9
grep -q -- '--set "final time 9"' err || fail "the message does not quote the directive: $(cat err)"
expect 2 "more threads than any machine has" env OMP_NUM_THREADS=99999999999 "$treejet" run "$pvp" --out wrong
grep -q 'OMP_NUM_THREADS' err || fail "the message does not name OMP_NUM_THREADS: $(cat err)"
expect 0 "help of a command" "$treejet" field --help
is "lines of the lesson in the help of a command" "$(grep -c 'Exit codes' out)" 0
grep -q 'direct|tree' out || fail "the help of field does not name its words: $(cat out)"
expect 2 "a wrong number of threads" short --out wrong --threads 0
expect 4 "a deck that is not there" "$treejet" run nowhere.dat
grep -q nowhere.dat err || fail "the message does not name the deck"

touch file
expect 4 "a directory that cannot be made" short --out file/below
grep -q 'file' err || fail "the message does not name the directory"
if [ "$(id -u)" != 0 ]; then
  mkdir locked && chmod a-w locked
  expect 4 "a directory without permission to write" short --out locked
fi
[ -w /dev/full ] && mkdir full && ln -s /dev/full full/statdat.dat && expect 4 "a full disk" short --out full --force

# A run of some tenths of a second that is stopped, or disturbed, once it has written a few rows.
long() { "$treejet" run "$pvp" --quiet --set "final time 4.d-2" --set "print time 1.d-4" --set "print xyz 2.d-4" "$@"; }
begun() { until [ -e "$1/statdat.dat" ] && [ "$(grep -vc "^#" "$1/statdat.dat")" -gt 9 ]; do sleep 0.01; done; }
same() { for file in statdat.dat traj.xyz; do cmp -s "whole/$file" "$1/$file" || fail "$file of $2 differs from the uninterrupted run's"; done; }

# disturbed DIRECTORY COMMAND [ARGUMENT...]: the exit code of such a run; once more if it ended before the command came, as on a busy machine
disturbed() {
  for attempt in 1 2 3 4 5; do
    rm -rf "$1"
    # a background job of sh starts with SIGINT ignored, which the program respects
    place=$1 command=$2
    shift 2
    env --default-signal=INT "$treejet" run "$pvp" --quiet --set "final time 4.d-2" --set "print time 1.d-4" --set "print xyz 2.d-4" "$@" --out "$place" 2>err &
    run=$!
    begun "$place"
    eval "$command" 2>/dev/null
    set -- "$place" "$command" "$@"
    wait $run && continue
    return $?
  done
}

expect 0 "a run left alone" long --out whole
for signal in TERM USR1 INT; do
  disturbed $signal "kill -$signal \$run"
  is "exit code of a run stopped by $signal" $? 75
  grep -q "SIG$signal.*treejet run --resume $signal" err || fail "the message does not tell how to go on: $(cat err)"
  expect 4 "starting over where a run was stopped" long --out $signal
  grep -q -- --resume err || fail "the message does not tell of --resume"
  expect 0 "going on after $signal, no longer quiet" "$treejet" run --resume $signal --threads 2
  same $signal "a run stopped by $signal"
  is "files of a run stopped by $signal" "$(ls $signal | tr '\n' ' ')" "checkpoint.end run.json statdat.dat traj.xyz "
done
disturbed frames 'kill -TERM $run' --set "print hdf5 2.d-4"
is "files of a stopped run with frames" "$(ls frames | tr '\n' ' ')" "checkpoint run.json statdat.dat traj.h5 traj.xdmf traj.xyz "
expect 0 "resuming a run that has ended" "$treejet" run --resume TERM
grep -q 'already at its end' out || fail "resuming a run that has ended does not say so: $(cat out)"

# Beyond its end, and with its jet under another voltage.
expect 0 "extending a run" "$treejet" run --resume TERM --set "final time 4.5d-2" --quiet
is "last time of an extended run" "$(tail -1 TERM/statdat.dat | awk '{printf "%.4f", $1}')" 0.0450
expect 0 "extending it again to the same end" "$treejet" run --resume TERM --set "final time 4.5d-2"
grep -q 'already at its end' out || fail "extending to the same end does not say so: $(cat out)"
expect 2 "extending with another viscosity" "$treejet" run --resume TERM --set "viscosity 30"
cp -r whole source
expect 0 "beginning with another run's jet" "$treejet" run "$pvp" --quiet --out onward --from source --set "final time 4.2d-2" --set "print time 1.d-4" --set "external potential 11 kV"
is "first time of it" "$(awk '!/^#/ {printf "%.3f", $1; exit}' onward/statdat.dat)" 0.040
grep -q '^## begins with source/checkpoint.end, t = 0.0.* external potential' onward/statdat.dat || fail "statdat.dat does not tell with what it begins"
diff -r whole source >/dev/null || fail "a run that another one began with was changed"
expect 2 "an error estimate of a run that had begun with another jet and goes on" "$treejet" run --resume onward --set "final time 4.3d-2" --estimate-error
grep -q 'begins with\|began with' err || fail "the message does not tell with what the run began: $(cat err)"
expect 2 "beginning where the other run is" "$treejet" run "$pvp" --out source --from source --force
diff -r whole source >/dev/null || fail "a refused run changed the one it was to begin with"

# A run finds its field map again from wherever it is resumed.
mkdir maps
awk 'BEGIN {
  print "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\">"
  print "<ImageData WholeExtent=\"0 5 0 5 0 5\" Origin=\"-0.05 -0.1 -0.1\" Spacing=\"0.06 0.04 0.04\">"
  print "<Piece Extent=\"0 5 0 5 0 5\"><PointData><DataArray type=\"Float64\" Name=\"potential\" format=\"ascii\">"
  for (n = 0; n < 216; ++n) print 9000 - 56250 * (-0.05 + 0.06 * (n % 6))
  print "</DataArray></PointData></Piece></ImageData></VTKFile>"
}' >maps/plates.vti
sed 's/^external potential.*/field map plates.vti/; s/^final time.*/final time 1.d-2/' "$pvp" >maps/jet.dat
(cd maps && exec "$treejet" run jet.dat --quiet --walltime 0.05 --out ../mapped 2>../err)
is "exit code of a run in a field map that is stopped" $? 75
expect 0 "resuming it from elsewhere" "$treejet" run --resume mapped --quiet
expect 4 "a map that is not there" "$treejet" run maps/jet.dat --quiet --out unmapped
grep -q "$PWD/plates.vti" err || fail "the message does not tell where the map was looked for: $(cat err)"

# What is going on in a directory is left alone by a second run there, whatever it asks for.
"$treejet" run "$pvp" --quiet --set "checkpoint 0.1" --set "tolerance 1.d-12" --out going &
run=$!
until [ -e going/checkpoint ]; do sleep 0.01; done
expect 4 "a second run where one is going on" "$treejet" run "$pvp" --quiet --out going --force
[ -e going/checkpoint ] || fail "a refused run removed the checkpoints of the one going on"
expect 4 "resuming a run that is going on" "$treejet" run --resume going
grep -q 'is running there' err || fail "the message does not tell that a run is going on: $(cat err)"
expect 0 "a look at its checkpoint" "$treejet" info going/checkpoint
kill -TERM $run
wait $run
is "exit code of the run that was left alone" $? 75

# Standard output that cannot be written is a failure of files; without it nothing goes astray.
if [ -w /dev/full ]; then
  "$treejet" reference >/dev/full 2>err
  is "exit code of the reference to a full device" $? 4
  "$treejet" check "$pvp" >/dev/full 2>err
  is "exit code of a check to a full device" $? 4
fi
short --out closed <&- >&- 2>&-
is "exit code of a run without standard descriptors" $? 0
grep -q 'done in' closed/statdat.dat && fail "the table of a run without standard output is in its files"

# A table whose numbers have decimal commas is not read as other points.
printf 'x,y,z,q\n0,5,0,0,1\n' >commas.csv
expect 2 "a table with decimal commas" "$treejet" field commas.csv
grep -q 'decimal' err || fail "the message does not tell of decimal commas: $(cat err)"
printf 'x,y,z,q\n0,0,0,1\n1,0,0,1\n' >points.csv
expect 4 "a field over its own points" "$treejet" field points.csv --out points.csv
is "points after a refused field" "$(wc -l <points.csv)" 3
printf 'system 3\n' >some.dat
expect 4 "a field over another file" "$treejet" field points.csv --out some.dat
is "the file after a refused field" "$(cat some.dat)" "system 3"
expect 0 "a field that may replace it" "$treejet" field points.csv --out some.dat --force

expect 75 "a run with no time" long --out late --walltime 0.001
expect 2 "resuming with another deck" "$treejet" run --resume late "$pvp" --set "viscosity 30"
grep -q 'viscosity: 30 here, 20 there' err || fail "the message does not name the difference: $(cat err)"
expect 2 "--resume with --out" "$treejet" run --resume late --out elsewhere
for time in 1:70:00 1-24:00:00 29:60 0 -5 1:2:3:4 30kV 1x; do expect 2 "walltime $time" long --out wrong --walltime $time; done
for time in 1-00:00:00 29:58 24:00:00 1-0 30min 2h 90:00; do expect 0 "walltime $time" short --quiet --out "within-$time" --walltime $time; done
head -c 100 late/checkpoint >cut && mv cut late/checkpoint
expect 4 "resuming from a checkpoint cut short" "$treejet" run --resume late
grep -q 'late/checkpoint: cut short' err || fail "the message does not tell what is wrong: $(cat err)"

# A disk that fills up in the middle of the trajectory, and has room again later.
(ulimit -f 400 && long --out filled --set "checkpoint 0.01" 2>err)
is "exit code with the disk full" $? 4
grep -q 'filled/.*: writing failed: File too large' err || fail "the message does not name the file: $(cat err)"
for file in statdat.dat traj.xyz; do
  sed '/^##/d' filled/$file >left  # the decks differ in the checkpoints
  sed '/^##/d' whole/$file | head -c "$(wc -c <left)" | cmp -s - left || fail "$file was damaged when the disk was full"
done
expect 0 "going on with room on the disk" "$treejet" run --resume filled --quiet
for file in statdat.dat traj.xyz; do
  sed '/^##/d' filled/$file >left
  sed '/^##/d' whole/$file | cmp -s - left || fail "$file of a run that had filled the disk differs from the uninterrupted run's"
done

disturbed removed "rm removed/traj.xyz"
is "exit code with a file removed" $? 4
grep -q 'removed/traj.xyz: was removed' err || fail "the message does not name the file removed: $(cat err)"

# steps a thousand times too large
expect 3 "a numerical failure" "$treejet" run "$pvp" --out stopped --quiet --set "integrator 2" --set "timestep 1.d-3" --set "final time 5.d-2" --set "print time 1.d-3" --set "printstat list t x yz n vn"
grep -q 'bead' err && grep -q 'time' err && grep -q 'likely cause' err || fail "the message names no bead, time or cause: $(cat err)"
[ "$(grep -vc '^#' stopped/statdat.dat)" -ge 1 ] || fail "rows before a numerical failure were lost"
grep -qi nan stopped/statdat.dat && fail "statdat.dat holds NaN"

# What a run leaves can be drawn, where there is matplotlib.
if /usr/bin/python3 -c 'import matplotlib, h5py' 2>/dev/null; then
  expect 0 "the pictures of a run" "$treejet" plot a --out drawn
  is "pictures of a run" "$(ls drawn | tr '\n' ' ')" "history.png jet.png "
fi

# The HDF5 trajectory, and what else it can become.
hdf5() { short --quiet --set "print hdf5 1.d-4" "$@"; }
expect 0 "a run with print hdf5" hdf5 --out h5
is "files of a run with print hdf5" "$(ls h5 | tr '\n' ' ')" "checkpoint.end run.json statdat.dat traj.h5 traj.xdmf traj.xyz "
threads=2
expect 0 "the same again on two threads" hdf5 --out h5again
threads=1
for file in statdat.dat traj.h5 traj.xdmf traj.xyz; do
  cmp -s h5/$file h5again/$file || fail "$file differs from run to run"
done
expect 4 "a run over an HDF5 trajectory" hdf5 --out h5
for format in xyz extxyz csv vtp; do
  expect 0 "convert --to $format" "$treejet" convert h5/traj.h5 --to $format --out as-$format
  expect 4 "convert over an existing file" "$treejet" convert h5/traj.h5 --to $format --out as-$format
done
is "lines of the CSV file" "$(wc -l <as-csv | tr -d ' ')" "$(($(grep -c '^[CX] ' as-extxyz) + 1))"
is "frames for ParaView" "$(ls as-vtp-frames | wc -l | tr -d ' ')" 6
expect 2 "convert to an unknown format" "$treejet" convert h5/traj.h5 --to pdb
expect 4 "convert of a foreign file" "$treejet" convert h5/traj.xyz --to csv
size=$(wc -c <h5/traj.h5)
expect 4 "convert over what it reads" "$treejet" convert h5/traj.h5 --to csv --out h5/traj.h5 --force
is "the trajectory after that" "$(wc -c <h5/traj.h5)" "$size"
expect 4 "convert of no file" "$treejet" convert nowhere.h5 --to csv
expect 75 "a run stopped at once" hdf5 --out later --walltime 0.001
for file in h5/traj.h5 h5/traj.xdmf h5/statdat.dat h5/traj.xyz h5/run.json as-xyz as-extxyz as-csv as-vtp as-vtp-frames/000003.vtp later/checkpoint; do
  expect 0 "info $file" "$treejet" info $file
  head -c $(($(wc -c <$file) * 2 / 3)) $file >cut
  expect 4 "info of two thirds of $file" "$treejet" info cut
  grep -Eq 'cut: (cut short|cannot be read: truncated)' err || fail "the message does not tell that $file is cut short: $(cat err)"
done
for file in h5/traj.h5 h5/statdat.dat h5/run.json; do
  "$treejet" info $file | grep -q 'elastic modulus' || fail "$file does not tell the deck"
  "$treejet" info $file | grep -q 'print hdf5 1.d-4' || fail "$file does not tell the overrides"
done
expect 4 "info of a foreign file" "$treejet" info "$source/README.md"

# Five beads without successors: all arrive, and the run says when.
expect 0 "a run whose beads all leave" "$treejet" run "$pvp" --out early --set "inserting no" --set "points 5" --set "initial length 0.1" --set "final time 0.05" --set "print time 5.d-3" --set "printstat list t n chc q" --set "print list t vc"
grep -q '^the jet has left at t = 0.0182' out || fail "the summary does not tell that the jet has left: $(cat out)"
grep -q '^ *0 *-$' out || fail "the terminal shows no dash for a window without arrivals"
is "beads in all rows together" "$(awk '!/^#/ {sum += $3; if ($4 > q) q = $4} END {print sum / q}' early/statdat.dat)" 5

expect 4 "a file whose name commands terminals" "$treejet" info "$(printf 'a\033[2Jb')"
grep -q "a?\[2Jb: " err || fail "a message hands a name to the terminal as it is: $(cat -v err)"

expect 0 "a run whose traj.xyz is too small" "$treejet" run "$pvp" --out few --set "points 5" --set "initial length 0.1" --set "final time 1.d-4" --set "print xyz 5.d-5" --set "print xyz maxnum 3"
grep -q '^traj.xyz leaves out the beads nearest to the nozzle: .* points, print xyz maxnum 3' out || fail "nobody is told that beads are left out: $(cat out)"

expect 0 "check" "$treejet" check "$pvp"
grep -q 'surface tension' out || fail "check does not tell what is composed"
is "files left by check" "$(ls | grep -c statdat)" 0
expect 0 "template" "$treejet" template
cp out template.dat
expect 0 "check of the template" "$treejet" check template.dat
expect 0 "--version" "$treejet" --version
grep -q '^treejet [0-9]' out || fail "--version shows no version"
expect 0 "--help" "$treejet" --help
grep -q 'Exit codes' out || fail "--help does not teach the exit codes"

[ $failures = 0 ] || exit 1
