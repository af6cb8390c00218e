#pragma once
/// How this process was started, as the launchers tell it in the environment.

namespace treejet {

struct Launch {
  int ranks = 1;  ///< started together; 0: some, not told how many
  int rank = 0;
};

/// Of Open MPI's mpirun, of MPICH's and its kin, of srun; one rank if of none of these.
Launch launch();

}  // namespace treejet
