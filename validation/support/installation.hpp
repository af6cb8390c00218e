#pragma once
/// Where decks, reference tables and the program are: beside an installed harness, else in the tree that it
/// was built from.

#include <filesystem>
#include <string>

namespace treejet {

/// The folder of this executable.
inline std::filesystem::path own_folder() {
  std::error_code error;
  return std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
}

/// examples/, validation/reference/ and validation/pictures/ are below it.
inline std::string source_tree() {
  std::error_code error;
  const auto installed = own_folder().parent_path() / "share" / "treejet";
  return std::filesystem::is_directory(installed / "validation", error) ? installed.string()
                                                                        : TREEJET_SOURCE_DIR;
}

#ifdef TREEJET_PROGRAM
inline std::string program_path() {
  std::error_code error;
  const auto installed = own_folder() / "treejet";
  return std::filesystem::exists(installed, error) ? installed.string() : TREEJET_PROGRAM;
}
#endif

}  // namespace treejet
