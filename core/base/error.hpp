#pragma once
/// The ways a run can fail, each with the exit code the front door returns (README, "Exit codes").

#include <stdexcept>
#include <string>

namespace treejet {

class Error : public std::runtime_error {
 public:
  Error(int exit_code, const std::string& what) : std::runtime_error(what), exit_code_(exit_code) {}
  int exit_code() const { return exit_code_; }

 private:
  int exit_code_;
};

/// The deck or the arguments are wrong.
struct InputError : Error {
  explicit InputError(const std::string& what) : Error(2, what) {}
};
/// The numbers went wrong: non-finite state, step below round-off, bead order broken.
struct NumericalError : Error {
  explicit NumericalError(const std::string& what) : Error(3, what) {}
};
/// A file cannot be read or written.
struct FileError : Error {
  explicit FileError(const std::string& what) : Error(4, what) {}
};

/// Not a failure: the exit code of a run that was stopped and can be resumed (EX_TEMPFAIL of sysexits.h).
constexpr int stopped_early = 75;

}  // namespace treejet
