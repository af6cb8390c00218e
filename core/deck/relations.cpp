#include "core/deck/relations.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>

namespace treejet {

void Relations::error(bool violated, const std::vector<std::string_view>& directives,
                      const std::string& message) {
  if (violated && std::all_of(directives.begin(), directives.end(), [&](auto words) { return sound(words); }))
    findings_.errors.push_back(about(directives.front(), message));
}

void Relations::note(bool holds, std::string_view words, const std::string& message) {
  if (holds && sound(words)) findings_.notes.push_back(about(words, message));
}

bool Relations::is_given(std::string_view words) const {
  return find(words) != nullptr;
}

bool Relations::sound(std::string_view words) const {
  const Given* g = find(words);
  return g ? !g->faulty : !directive(words).mandatory;
}

const Given* Relations::find(std::string_view words) const {
  return treejet::find(given_, directive(words));
}

Finding Relations::about(std::string_view words, const std::string& message) const {
  const Given* g = find(words);
  if (!g) return {deck_, fmt::format("{}: {}", words, message)};
  return {g->place, fmt::format("{} {}: {}", words, fmt::join(g->arguments, " "), message)};
}

void Relations::only_with(bool on, const char* that, std::initializer_list<const char*> details) {
  for (const char* detail : details)
    note(!on && is_given(detail), detail, fmt::format("no effect without {}", that));
}

void Relations::law_without_extras(const char* feature, bool known, std::string_view laws,
                                   std::string_view why) {
  error(!known || p_.hbfluid || p_.yield_stress > 0 || p_.solvent_viscosity > 0,
        {feature, "stress law", "kvfluid", "hbfluid", "yield stress", "solvent viscosity"},
        fmt::format("expected {} without yield stress, hbfluid or solvent viscosity: {}", laws, why));
}

std::optional<double> Relations::element_length() const {
  if (is_given("points") == is_given("resolution") || !sound("initial length")) return std::nullopt;
  if (is_given("resolution")) return sound("resolution") ? p_.resolution : std::nullopt;
  if (!sound("points")) return std::nullopt;
  return p_.initial_length / p_.points.value_or(1);
}

bool Relations::composable() const {
  const std::span<const Directive> all = directives();
  return is_given("points") != is_given("resolution") &&
         std::all_of(all.begin(), all.end(), [&](const Directive& d) { return sound(d.words); });
}

}  // namespace treejet
