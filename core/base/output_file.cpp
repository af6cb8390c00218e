#include "core/base/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "core/base/archive.hpp"

namespace treejet {

namespace fs = std::filesystem;

namespace {

int flags(OutputFile::Existing existing) {
  switch (existing) {
    case OutputFile::Existing::keep:
      return O_CREAT | O_EXCL;
    case OutputFile::Existing::replace:
      return O_CREAT;
    case OutputFile::Existing::resume:
      return 0;
  }
  return 0;
}

}  // namespace

FileError exists_already(const fs::path& path) {
  return FileError(fmt::format(
      "{}: exists already; choose another place with --out, or --force to replace it", path.string()));
}

OutputFile::OutputFile(fs::path path, Existing existing)
    : path_(std::move(path)), is_new_(existing != Existing::resume) {
  std::error_code error;
  if (is_new_ && !path_.parent_path().empty()) fs::create_directories(path_.parent_path(), error);
  if (error) throw FileError(fmt::format("{}: {}", path_.parent_path().string(), error.message()));
  descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC | flags(existing), 0666);
  if (descriptor_ < 0 && existing == Existing::keep && errno == EEXIST) throw exists_already(path_);
  if (descriptor_ < 0) fail("cannot be opened");
  if (existing == Existing::replace) cut(0);
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      is_new_(other.is_new_),
      length_(other.length_) {}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void OutputFile::write(std::string_view record) {
  check_undisturbed();
  const std::uint64_t begin = length_;
  while (!record.empty()) {
    const ssize_t written = ::write(descriptor_, record.data(), record.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const int reason = errno;
      cut(begin);
      errno = reason;
      fail("writing failed");
    }
    record.remove_prefix(static_cast<std::size_t>(written));
    length_ += static_cast<std::uint64_t>(written);
  }
}

void OutputFile::sync() {
  check_undisturbed();
  // a device or a pipe cannot be forced, and need not be
  if (::fsync(descriptor_) != 0 && errno != EINVAL && errno != EROFS) fail("writing failed");
}

void OutputFile::visit(Archive& state) {
  if (!state.reading()) sync();
  std::uint64_t length = length_;
  state(length);
  if (!state.reading()) return;
  struct stat now {};
  if (::fstat(descriptor_, &now) != 0) fail("cannot be examined");
  if (static_cast<std::uint64_t>(now.st_size) < length) {
    throw FileError(fmt::format("{}: has {} bytes, but the checkpoint goes on after {}", path_.string(),
                                now.st_size, length));
  }
  cut(length);
}

/// Also tells a second writer, and someone who has emptied the file.
void OutputFile::check_undisturbed() const {
  struct stat now {};
  if (::fstat(descriptor_, &now) != 0) fail("cannot be examined");
  if (now.st_nlink == 0) throw FileError(fmt::format("{}: was removed during the run", path_.string()));
  if (S_ISREG(now.st_mode) && static_cast<std::uint64_t>(now.st_size) != length_)
    throw FileError(fmt::format("{}: was changed by another program during the run", path_.string()));
}

void OutputFile::cut(std::uint64_t length) {
  length_ = length;
  struct stat now {};
  if (::fstat(descriptor_, &now) != 0 || !S_ISREG(now.st_mode)) return;
  const auto end = static_cast<off_t>(length);
  if (::ftruncate(descriptor_, end) != 0 || ::lseek(descriptor_, end, SEEK_SET) != end) fail("cannot be cut");
}

void OutputFile::fail(std::string_view what) const {
  throw FileError(fmt::format("{}: {}: {}", path_.string(), what, std::strerror(errno)));
}

}  // namespace treejet
