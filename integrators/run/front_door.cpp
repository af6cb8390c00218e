#include "integrators/run/front_door.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <iostream>
#include <new>
#include <stdexcept>
#include <system_error>

#include "core/base/error.hpp"
#include "core/base/freed_memory.hpp"
#include "core/base/lines.hpp"
#include "core/commands/command_line.hpp"
#include "core/commands/companions.hpp"
#include "core/commands/convert.hpp"
#include "core/commands/file_info.hpp"
#include "core/deck/deck.hpp"
#include "forces/coulomb/command/field_command.hpp"
#include "forces/scene/coulomb_settings.hpp"
#include "integrators/run/check_deck.hpp"
#include "integrators/run/run_deck.hpp"

namespace treejet {

namespace {

int dispatch(const Arguments& a, const Ranks& ranks, const OwnPhysics& own) {
  const bool parallel = a.command == "run" || a.command == "field";
  if (!parallel && !ranks.first()) return 0;  // one is enough, and two would write the same file
  if (a.command == "run") return run_deck(a, ranks, own);
  if (a.command == "check") {
    check_deck(a, own);
  } else if (a.command == "template") {
    fmt::print("{}", deck_template());
  } else if (a.command == "reference") {
    fmt::print("{}", a.reference.empty() ? directive_reference() + "\n" + key_reference() : a.reference);
  } else if (a.command == "convert") {
    fmt::print("{}\n", convert({a.file, a.format, a.converted, existing(a)}));
  } else if (a.command == "info") {
    fmt::print("{}", file_info(a.file));
  } else {
    run({a.points, a.field_out, existing(a), coulomb_request(a.coulomb, /*points_move*/ false),
         threads(a, ranks), ranks, a.repeat, a.compare, a.json},
        std::cout);
  }
  return 0;
}

constexpr int memory_refused = 5;

/// Where descriptors 0 to 2 are closed, the next files opened would get their numbers, and the table and
/// messages with them.
void occupy_standard_descriptors() {
  for (int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(descriptor, F_GETFD) < 0) static_cast<void>(::open("/dev/null", O_RDWR));
}

/// What was printed is out, or its reader has gone, which is no failure: `treejet ... | head`.
void flush_standard_output() {
  const bool flushed = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  struct stat out {};
  const bool reader = ::fstat(STDOUT_FILENO, &out) == 0 && (S_ISFIFO(out.st_mode) || S_ISSOCK(out.st_mode));
  if (!flushed && !reader) throw FileError("standard output: writing failed");
}

int command(int argc, char** argv, const Ranks& ranks, const OwnPhysics& own) {
  std::string all;
  for (int k = 1; k < argc; ++k) all += std::string(argv[k]) + '\n';
  if (!ranks.agree(all)) throw LaunchError("the ranks were started with different arguments");
  const auto arguments = command_line(argc, argv, version_text(own));
  int code = 0;
  try {
    if (arguments) code = dispatch(*arguments, ranks, own);
  } catch (const std::system_error&) {
    if (std::ferror(stdout) == 0) throw;
  }
  flush_standard_output();
  return code;
}

}  // namespace

int front_door(int argc, char** argv, const OwnPhysics& own) {
  occupy_standard_descriptors();
  keep_freed_memory();
  std::signal(SIGXFSZ, SIG_IGN);  // the failed write tells, by name of the file
  Ranks ranks;
  const auto fail = [&](int exit_code, const char* what) {
    return ranks.fail(exit_code, fmt::format("treejet: {}\n", printable(what)));
  };
  try {
    hand_over_to_companion(argc, argv);
    ranks = join_ranks();
    return command(argc, argv, ranks, own);
  } catch (const Error& e) {
    return fail(e.exit_code(), e.what());
  } catch (const LaunchError& e) {
    return fail(2, e.what());
  } catch (const std::invalid_argument& e) {  // of the environment
    return fail(2, e.what());
  } catch (const std::bad_alloc&) {
    return fail(memory_refused, "the system refuses the memory that this takes");
  } catch (const std::exception& e) {
    return fail(1, e.what());
  }
}

}  // namespace treejet
