#pragma once
/// What the files that call the HDF5 library share (hdf5_*.cpp, its one door): handles that close themselves,
/// and errors that name file and object. The library's own header stays out of it: a handle is a number.

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/error.hpp"

namespace treejet::hdf5 {

using Id = std::int64_t;

/// The library, set up once before anything else calls it: whichever call is the first starts it, and after
/// that it can no longer be told to leave the end of the program alone. A file that could not be closed must
/// not be tried again there.
void start_library();

/// The innermost reason on HDF5's stack of errors, where the operating system gave one: its words only, as
/// HDF5 adds the clock and the addresses of its buffers.
std::string reason();

/// A handle of the library, closed when it goes.
class Handle {
 public:
  using Close = int (*)(Id);

  Handle(Id id, Close close) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }

  operator Id() const { return id_; }  // NOLINT: so that it goes wherever the library takes a handle
  /// What the library has put off until then may fail, which the end of a handle tells nobody.
  int close() { return close_(release()); }
  Id release() { return std::exchange(id_, -1); }

 private:
  Id id_;
  Close close_;
};

/// Says what fails, if something does.
class Checker {
 public:
  Checker(const std::filesystem::path& path, std::string_view object) : path_(path), object_(object) {}

  template <class Result>
  Result operator()(Result result, const char* what) const {
    if (result < 0)
      throw FileError(
          fmt::format("{}: {}{}{}: {}", path_.string(), object_, object_.empty() ? "" : " ", what, reason()));
    return result;
  }

 private:
  const std::filesystem::path& path_;
  std::string_view object_;
};

[[noreturn]] void refuse(const std::filesystem::path& path, std::string_view object, std::string_view why);

}  // namespace treejet::hdf5
