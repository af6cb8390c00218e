/// Files of text that a run leaves - statdat.dat, traj.xyz, run.json, what `treejet convert` makes - as
/// `treejet info` reads them. What it tells goes to a terminal.

#include "core/base/lines.hpp"
#include "core/commands/file_info.hpp"
#include "core/io/run_record.hpp"
#include "validation/fuzz/target.hpp"

namespace treejet::fuzz {

std::vector<std::string> written_texts() {
  std::vector<std::string> all;
  for (const char* name : {"statdat.dat", "traj.xyz", "run.json", "traj.xdmf", "traj-of.csv",
                           "traj-of.extxyz", "traj-of.pvd", "traj-of.vtp"})
    for (auto& one : files_of_runs(name)) all.push_back(std::move(one));
  return all;
}

void feed_written(std::string_view bytes) {
  const auto& file = as_file(bytes);
  is_read([&] {
    const std::string told = file_info(file);
    demand(!told.empty() && printable(told) == told, "what is told is fit for a terminal");
  });
  const auto record = file.parent_path() / run_record_name;
  std::filesystem::copy_file(file, record, std::filesystem::copy_options::overwrite_existing);
  is_read([&] { has_completed(file.parent_path()); });
}

}  // namespace treejet::fuzz
