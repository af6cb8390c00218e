#include "core/output_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

#include "core/error.hpp"

namespace treejet {

namespace fs = std::filesystem;

OutputFile::OutputFile(fs::path path, Existing existing) : path_(std::move(path)) {
  std::error_code error;
  if (existing == Existing::keep && fs::exists(path_, error)) {
    throw FileError(fmt::format(
        "{}: exists already; choose another directory with --out, or --force to replace it", path_.string()));
  }
  if (!path_.parent_path().empty()) fs::create_directories(path_.parent_path(), error);
  if (error) throw FileError(fmt::format("{}: {}", path_.parent_path().string(), error.message()));
  stream_.open(path_, std::ios::trunc);
  if (!stream_) throw FileError(fmt::format("{}: {}", path_.string(), std::strerror(errno)));
}

void OutputFile::write(std::string_view record) {
  stream_ << record << std::flush;
  if (!stream_) throw FileError(fmt::format("{}: writing failed: {}", path_.string(), std::strerror(errno)));
}

}  // namespace treejet
