#pragma once
/// A text file of results: created once, never over an existing one unless told to, flushed after every
/// record, and every failed write is a FileError that names the file.

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace treejet {

class OutputFile {
 public:
  enum class Existing { keep, replace };

  OutputFile(std::filesystem::path path, Existing existing);
  void write(std::string_view record);
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
  std::ofstream stream_;
};

}  // namespace treejet
