#include "core/restart/resume.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/error.hpp"
#include "core/deck/directives.hpp"

namespace treejet {

Resumption resumption(const std::filesystem::path& directory, const std::string& program,
                      const Readers& readers) {
  Resumption found;
  Checkpoint& c = found.checkpoint;
  c = newest_checkpoint(directory, found.warnings, readers);
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
