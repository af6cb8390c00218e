#pragma once
/// The command line: the only place that knows the argument library.

#include <optional>
#include <string>
#include <vector>

#include "core/jet/parameters.hpp"

namespace treejet {

struct Arguments {
  std::string command;  ///< run, check, convert, info, field, template, reference
  std::string deck;
  std::vector<std::string> overrides;
  std::string out = ".";
  int threads = 0;  ///< 0: auto
  bool quiet = false, force = false;
  std::string resume;              ///< directory of the run to continue; empty: a new run
  std::optional<double> walltime;  ///< s
  bool estimate_error = false;     ///< of the rows of statdat.dat, by a second run

  std::string file, format, converted;  ///< of convert and info

  std::string points, field_out;  ///< of the field command
  CoulombSetting coulomb{.coulomb = CoulombSum::automatic};
  int repeat = 1;
  bool compare = false, json = false;
};

/// The arguments of a command; none when help or version has been asked for, and printed. InputError for
/// wrong ones.
std::optional<Arguments> command_line(int argc, char** argv, const std::string& version_text);

/// The text as one word of a shell: in quotes where it needs them.
std::string for_shell(const std::string& text);

}  // namespace treejet
