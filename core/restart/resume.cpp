#include "core/restart/resume.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/error.hpp"
#include "core/deck/directives.hpp"
#include "core/io/provenance.hpp"
#include "core/jet/stiffness.hpp"

namespace treejet {

namespace {

/// The physics that the program has beside the stock one, as it tells it of itself.
std::string own_physics(const std::string& program) {
  const auto mark = program.find(own_physics_mark);
  if (mark == std::string::npos) return "stock physics";
  const auto name = mark + std::string(own_physics_mark).size();
  return program.substr(name, program.find(" (git", name) - name);
}

/// Whether a run with these parameters has the steps and rows of one with those, up to its end.
void expect_extension(const Deck& longer, const Deck& deck, double reached) {
  const Parameters &p = longer.parameters, &before = deck.parameters;
  const auto refuse = [](const std::string& why) { throw InputError("--resume with --set: " + why); };
  Parameters allowed = p;
  allowed.final_time = before.final_time;
  allowed.checkpoint = before.checkpoint;
  if (p.print_time && *p.print_time == print_interval(before)) allowed.print_time = before.print_time;
  if (const auto others = differences(allowed, before); !others.empty())
    refuse(
        fmt::format("only final time and checkpoint may change in a run that goes on; a run with other "
                    "parameters begins with this state by treejet run DECK --from DIR\n  {}",
                    fmt::join(others, "\n  ")));
  if (p.final_time < before.final_time)
    refuse(fmt::format("expected a final time of {:g} s at least, which the run has now, found {:g} s",
                       before.final_time, p.final_time));
  if (p.final_time <= reached)
    refuse(fmt::format("expected a final time beyond {:.10g} s, which the run has reached", reached));
  const bool rows = !p.print_list.empty() || !p.printstat_list.empty();
  if (rows && print_interval(p) != print_interval(before))
    refuse(
        fmt::format("the deck has no print time, so that its rows are a hundredth of the final time apart; "
                    "add --set \"print time {:.17g}\"",
                    print_interval(before)));
  if (stiffness(p).bead_interval != stiffness(before).bead_interval)
    refuse(
        "the final time was shorter than the interval of beads, and decided on the steps; "
        "run the deck from its start");
}

}  // namespace

Resumption resumption(const std::filesystem::path& directory, const std::string& program,
                      const std::vector<std::string>& overrides, const Readers& readers) {
  Resumption found;
  Checkpoint& c = found.checkpoint;
  c = newest_checkpoint(directory, found.warnings, readers);
  if (own_physics(c.program) != own_physics(program))
    throw InputError(
        fmt::format("{}: the run has {}, this program {}: resume it with the program that began it",
                    directory.string(), own_physics(c.program), own_physics(program)));
  found.deck = parse_deck(c.deck_text, c.deck_name, c.overrides);
  if (!overrides.empty()) {
    Deck longer = changed(found.deck, overrides);
    found.extended = !differences(longer.parameters, found.deck.parameters).empty();
    if (found.extended) expect_extension(longer, found.deck, c.t);
    found.deck = std::move(longer);
  }
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
