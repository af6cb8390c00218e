#include "core/io/division_guard.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <string>

#include "core/base/error.hpp"

namespace treejet {

namespace {

/// All that the handler needs: in the midst of a signal nothing may be allocated.
std::array<char, 1024> message;
std::size_t length = 0;
int exit_code = 0;

extern "C" void end_with_message(int) {
  const ssize_t ignored = ::write(STDERR_FILENO, message.data(), length);
  static_cast<void>(ignored);
  ::_exit(exit_code);
}

}  // namespace

DivisionGuard::DivisionGuard(const std::filesystem::path& path) {
  const std::string text =
      "treejet: " + path.string() + ": damaged: the HDF5 library divides by zero over it\n";
  length = std::min(text.size(), message.size());
  std::copy_n(text.begin(), length, message.begin());
  exit_code = FileError("").exit_code();
  struct sigaction action {};
  action.sa_handler = end_with_message;
  sigaction(SIGFPE, &action, &before_);
}

DivisionGuard::~DivisionGuard() {
  sigaction(SIGFPE, &before_, nullptr);
}

}  // namespace treejet
