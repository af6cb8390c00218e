#!/bin/bash
# A sweep as a job array: a task a row of a table whose header names directives, e.g. points.csv
#
#     external potential,viscosity
#     10 kV,3 Pa s
#     12 kV,3 Pa s
#
#     sbatch --array=1-$(($(wc -l <points.csv) - 1)) sweep.sh DECK points.csv results/sweep
#
# Submitted again it leaves finished points alone and resumes stopped ones. In the end, on any machine,
#     treejet sweep DECK --list points.csv --out results/sweep
# finds all points finished and makes the table of means and the picture.
#SBATCH --job-name=treejet-sweep
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=1
#SBATCH --time=01:00:00
#SBATCH --signal=USR1@60
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output=treejet-sweep-%A-%a.log
set -eu

deck=${1:?usage: sbatch --array=1-N sweep.sh DECK POINTS.csv DIR}
point=${SLURM_ARRAY_TASK_ID:?submit this script with sbatch --array}
stopped=75 # the exit code of a run that can be resumed

code=0
srun --mpi=none treejet sweep "$deck" --list "${2:?a table of points}" --out "${3:?a directory}" --only "$point" || code=$?
if [ "$code" = $stopped ]; then
  scontrol requeue "${SLURM_ARRAY_JOB_ID}_$point"
  exit 0
fi
exit "$code"
