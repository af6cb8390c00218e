/// The front door: arguments -> command -> exit code. No physics here.

#include <fmt/format.h>

#include <iostream>

#include "core/base/error.hpp"
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

int main(const Arguments& a, const Ranks& ranks) {
  if (a.command == "run") return run_deck(a, ranks);
  if (a.command == "check") {
    check_deck(a);
  } else if (a.command == "template") {
    fmt::print("{}", deck_template());
  } else if (a.command == "reference") {
    fmt::print("{}\n{}", directive_reference(), key_reference());
  } else if (a.command == "convert") {
    fmt::print("{}\n", convert({a.file, a.format, a.converted, existing(a)}));
  } else if (a.command == "info") {
    fmt::print("{}", file_info(a.file));
  } else {
    run({a.points, a.field_out, coulomb_request(a.coulomb, /*points_move*/ false), threads(a, ranks), ranks,
         a.repeat, a.compare, a.json},
        std::cout);
  }
  return 0;
}

}  // namespace treejet

int main(int argc, char** argv) {
  treejet::Ranks ranks;
  const auto fail = [&](int exit_code, const char* what) {
    return ranks.fail(exit_code, fmt::format("treejet: {}\n", what));
  };
  try {
    treejet::hand_over_to_companion(argc, argv);
    ranks = treejet::join_ranks();
    const auto arguments = treejet::command_line(argc, argv, treejet::version_text());
    return arguments ? treejet::main(*arguments, ranks) : 0;
  } catch (const treejet::Error& e) {
    return fail(e.exit_code(), e.what());
  } catch (const treejet::LaunchError& e) {
    return fail(2, e.what());
  } catch (const std::exception& e) {
    return fail(1, e.what());
  }
}
