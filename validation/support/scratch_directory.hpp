#pragma once
/// A directory of its own for a test, gone with it.

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>

namespace treejet {

struct ScratchDirectory {
  ScratchDirectory() {
    static int number = 0;
    path = std::filesystem::temp_directory_path() / fmt::format("treejet-test-{}-{}", ::getpid(), number++);
    std::filesystem::create_directories(path);
  }
  ScratchDirectory(const ScratchDirectory&) = delete;
  ScratchDirectory& operator=(const ScratchDirectory&) = delete;
  ~ScratchDirectory() { std::filesystem::remove_all(path); }
  std::filesystem::path path;
};

}  // namespace treejet
