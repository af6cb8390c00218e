#pragma once
/// Keeps a directory of results for one run. A file system that knows no locks keeps nothing apart.

#include <filesystem>

namespace treejet {

class DirectoryLock {
 public:
  /// Makes the directory if it is missing. FileError if it cannot be, or if another run has locked it.
  explicit DirectoryLock(const std::filesystem::path& directory);
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace treejet
