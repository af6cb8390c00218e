#include "validation/support/rank_layout.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <filesystem>

#include "core/base/error.hpp"
#include "core/base/lines.hpp"

namespace treejet {

std::string mpi_launcher() {
  return TREEJET_MPIEXEC;
}

namespace {

/// Open MPI is told by its environment, which others ignore.
std::string environment(const RankLayout& layout, bool pinned) {
  std::string text =
      fmt::format("OMP_NUM_THREADS={} OMP_WAIT_POLICY={} ", layout.threads, pinned ? "active" : "passive");
  if (pinned) text += "OMP_PROC_BIND=close OMP_PLACES=cores ";
  if (layout.ranks == 1) return text;
  text += "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1 ";
  return text +
         fmt::format("OMPI_MCA_hwloc_base_binding_policy={} OMPI_MCA_rmaps_base_mapping_policy=slot:PE={} ",
                     pinned ? "core" : "none", pinned ? layout.threads : 1);
}

}  // namespace

std::string launch_line(const RankLayout& layout, bool pinned, const std::string& program,
                        const std::string& arguments) {
  std::string line = environment(layout, pinned);
  if (layout.ranks > 1) line += fmt::format("{} -n {} ", for_shell(mpi_launcher()), layout.ranks);
  return line + fmt::format("{} {}", for_shell(program), arguments);
}

namespace {

std::string this_program() {
  return std::filesystem::read_symlink("/proc/self/exe").string();
}

std::string output_of(const std::string& line) {
  std::FILE* pipe = popen(line.c_str(), "r");
  if (!pipe) throw FileError("cannot start " + line);
  std::string all;
  for (std::array<char, 512> some; std::fgets(some.data(), some.size(), pipe);) all += some.data();
  const auto at = all.find("measured ");
  if (pclose(pipe) != 0 || at == std::string::npos) throw FileError("failed: " + line);
  return all.substr(at);
}

}  // namespace

std::string output(const RankLayout& layout, int cores, const std::string& arguments) {
  return output_of(launch_line(layout, layout.workers() <= cores, this_program(), arguments));
}

std::string output_on_core(int core, const std::string& arguments) {
  return output_of(fmt::format("OMP_NUM_THREADS=1 OMP_PROC_BIND=close OMP_PLACES='{{{}}}' {} {}", core,
                               for_shell(this_program()), arguments));
}

}  // namespace treejet
