#include "parallel/launch.hpp"

#include <charconv>
#include <cstdlib>
#include <cstring>

namespace treejet {

namespace {

struct Launcher {
  const char *ranks, *rank;
};
/// A batch script itself has SLURM_NTASKS, too, but only what srun starts is a step.
constexpr Launcher launchers[] = {{"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"},
                                  {"PMI_SIZE", "PMI_RANK"},
                                  {"SLURM_STEP_NUM_TASKS", "SLURM_PROCID"}};

int number(const char* variable, int otherwise) {
  const char* const text = std::getenv(variable);
  if (text) std::from_chars(text, text + std::strlen(text), otherwise);
  return otherwise;
}

}  // namespace

Launch launch() {
  for (const Launcher& l : launchers)
    if (const int ranks = number(l.ranks, 0); ranks > 0) return {ranks, number(l.rank, 0)};
  if (std::getenv("PMIX_RANK")) return {0, number("PMIX_RANK", 0)};
  return {};
}

}  // namespace treejet
