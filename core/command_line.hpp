#pragma once
/// The command line: the only place that knows the argument library.

#include <optional>
#include <string>
#include <vector>

namespace treejet {

struct Arguments {
  std::string command;  ///< run, check, template, reference
  std::string deck;
  std::vector<std::string> overrides;
  std::string out = ".";
  int threads = 0;  ///< 0: as many as there are cores
  bool quiet = false, force = false;
};

/// The arguments of a command, or, when help, version or an error has been printed, the exit code.
struct CommandLine {
  std::optional<Arguments> arguments;
  int exit_code = 0;
};

CommandLine command_line(int argc, char** argv, const std::string& version_text);

}  // namespace treejet
