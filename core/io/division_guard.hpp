#pragma once
/// HDF5 1.10 divides by zero over a damaged file whose chunks have no extent, and nothing tells before a
/// dataset is opened. While a guard lives this does not leave a core dump: the process says which file is
/// damaged and ends with the exit code of files. It has no way to go on, for the library is in the midst of
/// its work.

#include <csignal>
#include <filesystem>

namespace treejet {

class DivisionGuard {
 public:
  explicit DivisionGuard(const std::filesystem::path& path);
  ~DivisionGuard();
  DivisionGuard(const DivisionGuard&) = delete;
  DivisionGuard& operator=(const DivisionGuard&) = delete;

 private:
  struct sigaction before_ {};
};

}  // namespace treejet
