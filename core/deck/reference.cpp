/// The table of directives written out: as a deck and as documentation.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>
#include <vector>

#include "core/deck/deck.hpp"
#include "core/deck/directives.hpp"
#include "core/deck/foreign.hpp"
#include "core/deck/observable_keys.hpp"
#include "core/deck/units.hpp"

namespace treejet {

namespace {

/// What holds without the directive.
std::string standard(const Directive& d) {
  if (d.mandatory) return "mandatory";
  if (!d.or_else.empty()) return fmt::format("this or {}", d.or_else);
  if (!d.absent.empty()) return std::string(d.absent);
  return value_text(d, Parameters{});
}

/// The unit of a bare number, then those it may carry.
std::string units_accepted(const Directive& d) {
  if (d.unit.empty()) return {};
  return fmt::format("{} ({})", d.unit, usual_units(unit(d.unit).value().dimension));
}

std::string remark(const Directive& d) {
  const std::string status = d.mandatory || !d.or_else.empty() ? standard(d) : "default: " + standard(d);
  return fmt::format("{} [{}{}{}]", d.meaning, d.unit, d.unit.empty() ? "" : "; ", status);
}

/// A bar ends a cell in Markdown.
std::string cell(const std::string& text) {
  std::string escaped;
  for (const char c : text) escaped += fmt::format("{}{}", c == '|' ? "\\" : "", c);
  return escaped;
}

}  // namespace

std::string deck_template() {
  std::string deck =
      "# A deck for treejet. Comments go from # or ! to the end of the line; a number may "
      "carry a unit, as\n# in 10 kV, 1.2 Pa s or 839 kg/m3; without one it is in CGS.\n"
      "# A directive behind a # is optional and shown with its default, or with the kind of value it "
      "takes.\n";
  for (const Directive& d : directives()) {
    if (!d.heading.empty()) deck += fmt::format("\n# {}\n", d.heading);
    const std::string standard_value = value_text(d, Parameters{});
    const std::string line = !d.example.empty()        ? fmt::format("{} {}", d.words, d.example)
                             : !standard_value.empty() ? fmt::format("# {} {}", d.words, standard_value)
                                                       : fmt::format("# {} <{}>", d.words, argument(d));
    deck += fmt::format("{:<42} # {}\n", line, remark(d));
  }
  return deck + fmt::format("\n{}\n", last_directive);
}

std::string directive_reference() {
  std::string table;
  for (const Directive& d : directives()) {
    if (!d.heading.empty())
      table +=
          fmt::format("{}### {}\n\n| directive | value | unit | default | meaning |\n|---|---|---|---|---|\n",
                      table.empty() ? "" : "\n", d.heading);
    const std::string also = d.synonyms.empty() ? "" : fmt::format(" (also: {})", d.synonyms);
    table += fmt::format("| `{}` | {} | {} | {} | {}{} |\n", d.words, cell(argument(d)), units_accepted(d),
                         standard(d), d.meaning, also);
  }
  table += fmt::format("| `{}` | | | mandatory | last line of the deck |\n", last_directive);
  table +=
      "\n### Directives of JETSPIN that Treejet does not have\n\n| directive | what to do |\n|---|---|\n";
  for (const Foreign& f : foreign_directives()) table += fmt::format("| `{}` | {} |\n", f.words, f.advice);
  return table;
}

std::string key_reference() {
  std::string table = "| key | unit | meaning | |\n|---|---|---|---|\n";
  constexpr std::pair<ObservableProperty, const char*> notes[] = {
      {averaged, "averaged"}, {at_arrivals, "NaN without arrivals"}, {across_axis, "0 in system 1"}};
  for (const ObservableKey& k : observable_keys) {
    std::vector<std::string_view> remarks;
    for (const auto& [property, note] : notes)
      if (has(k.key, property)) remarks.push_back(note);
    table += fmt::format("| `{}` | {} | {} | {} |\n", k.key, k.unit, k.meaning, fmt::join(remarks, ", "));
  }
  return table;
}

}  // namespace treejet
