#pragma once
/// A file of results: created once, never over an existing one unless told to.
///
/// A record is in the file as a whole or not at all, unless the program is killed while it is written: every
/// record is handed to the operating system at once, and what a failed write left of it is cut off again. A
/// checkpoint forces the file to disk and notes its length; a run that is resumed cuts it there and goes on.
/// FileError, with the file's name: failed calls, a file removed or changed under us.

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/error.hpp"

namespace treejet {

class Archive;

/// Of a file that is not to be replaced.
FileError exists_already(const std::filesystem::path& path);

class OutputFile {
 public:
  enum class Existing { keep, replace, resume };

  OutputFile(std::filesystem::path path, Existing existing);
  OutputFile(OutputFile&& other) noexcept;
  ~OutputFile();

  void write(std::string_view record);
  /// On to the disk with all records.
  void sync();
  void visit(Archive& state);

  const std::filesystem::path& path() const { return path_; }
  bool is_new() const { return is_new_; }

 private:
  void check_undisturbed() const;
  void cut(std::uint64_t length);
  [[noreturn]] void fail(std::string_view what) const;

  std::filesystem::path path_;
  int descriptor_;
  bool is_new_;
  std::uint64_t length_ = 0;
};

}  // namespace treejet
