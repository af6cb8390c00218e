#include "core/io/atomic_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>

#include "core/base/error.hpp"
#include "core/base/output_file.hpp"

namespace treejet {

namespace fs = std::filesystem;

namespace {
void check(bool done, const fs::path& path, const char* what) {
  if (!done) throw FileError(fmt::format("{}: {}: {}", path.string(), what, std::strerror(errno)));
}
}  // namespace

std::string read_whole(const fs::path& path) {
  std::error_code kind;
  if (fs::exists(path, kind) && !fs::is_regular_file(path, kind))
    throw FileError(fmt::format("{}: cannot be read: not a regular file", path.string()));
  std::ifstream stream(path, std::ios::binary);
  std::error_code error;
  const auto size = fs::file_size(path, error);
  std::string bytes(error ? 0 : size, '\0');
  stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  check(bool(stream), path, "cannot be read");
  return bytes;
}

void write_whole(const fs::path& path, std::string_view text) {
  const fs::path fresh = path.string() + ".next";
  std::error_code error;
  fs::remove(fresh, error);  // a link goes itself, not what it leads to
  try {
    OutputFile(fresh, OutputFile::Existing::keep).write(text);
    put_in_place(fresh, path);
  } catch (const FileError&) {
    fs::remove(fresh, error);
    throw;
  }
}

void put_in_place(const fs::path& fresh, const fs::path& path) {
  check(std::rename(fresh.c_str(), path.c_str()) == 0, path, "cannot be put in place");
}

void force_to_disk(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  check(descriptor >= 0, path, "cannot be opened");
  // some file systems cannot, and need not
  const bool done = ::fsync(descriptor) == 0 || errno == EINVAL || errno == EROFS;
  ::close(descriptor);
  check(done, path, "writing failed");
}

}  // namespace treejet
