#include "core/restart/resume.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/error.hpp"
#include "core/deck/directives.hpp"
#include "core/io/provenance.hpp"

namespace treejet {

namespace {

/// The physics that the program has beside the stock one, as it tells it of itself.
std::string own_physics(const std::string& program) {
  const auto mark = program.find(own_physics_mark);
  if (mark == std::string::npos) return "stock physics";
  const auto name = mark + std::string(own_physics_mark).size();
  return program.substr(name, program.find(" (git", name) - name);
}

}  // namespace

Resumption resumption(const std::filesystem::path& directory, const std::string& program,
                      const Readers& readers) {
  Resumption found;
  Checkpoint& c = found.checkpoint;
  c = newest_checkpoint(directory, found.warnings, readers);
  if (own_physics(c.program) != own_physics(program))
    throw InputError(
        fmt::format("{}: the run has {}, this program {}: resume it with the program that began it",
                    directory.string(), own_physics(c.program), own_physics(program)));
  found.deck = parse_deck(c.deck_text, c.deck_name, c.overrides);
  if (c.program != program) {
    found.warnings.push_back(fmt::format(
        "the checkpoint was written by {}; this is {}: an uninterrupted run's bytes are not promised",
        c.program, program));
  }
  return found;
}

void expect_same(const Deck& given, const Deck& in_checkpoint) {
  const auto lines = differences(given.parameters, in_checkpoint.parameters);
  if (lines.empty()) return;
  throw InputError(fmt::format("{}: not the deck of the checkpoint ({}):\n  {}", given.name,
                               in_checkpoint.name, fmt::join(lines, "\n  ")));
}

}  // namespace treejet
