#!/bin/bash
# A long jet on four nodes of two sockets with 32 cores each: one rank a socket, one thread a core. Stopped with a checkpoint
# ahead of the time limit and put into the queue again until it is done. Adapt the five numbers and the deck; README.md
# beside this file tells how to choose.
#SBATCH --job-name=treejet
#SBATCH --nodes=4
#SBATCH --ntasks-per-node=2
#SBATCH --ntasks-per-socket=1
#SBATCH --cpus-per-task=32
#SBATCH --hint=nomultithread
#SBATCH --time=04:00:00
#SBATCH --signal=USR1@120
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output=treejet-%j.log
set -eu

deck=${1:?usage: sbatch hybrid.sh DECK}
results=results/${SLURM_JOB_ID:?submit this script with sbatch}
stopped=75 # the exit code of a run that can be resumed

# One thread a core of the rank's socket, kept there.
export OMP_NUM_THREADS=$SLURM_CPUS_PER_TASK
export OMP_PLACES=cores
export OMP_PROC_BIND=close

if [ -e "$results/checkpoint" ] || [ -e "$results/checkpoint.old" ] || [ -e "$results/checkpoint.end" ]; then
  what=(--resume "$results")
else
  what=("$deck" --out "$results" --force) # --force: of an attempt that died before its first checkpoint
fi

# srun of Slurm 22.05 and later does not inherit --cpus-per-task; --mpi=pmix suits Open MPI, see `srun --mpi=list`.
# --walltime stops the run should the signal not come through.
code=0
srun --mpi=pmix --cpus-per-task="$SLURM_CPUS_PER_TASK" --cpu-bind=cores --kill-on-bad-exit=1 \
  treejet run "${what[@]}" --walltime 03:57:00 || code=$?

# The same by Open MPI's own launcher, where Slurm was built without pmix:
#   mpirun --map-by "ppr:1:socket:PE=$SLURM_CPUS_PER_TASK" --bind-to core -x OMP_NUM_THREADS -x OMP_PLACES -x OMP_PROC_BIND \
#     treejet run ...

if [ "$code" = $stopped ]; then
  scontrol requeue "$SLURM_JOB_ID"
  exit 0
fi
exit "$code"
