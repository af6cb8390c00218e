#include "core/deck/deck.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>

#include "core/base/error.hpp"
#include "core/base/lines.hpp"
#include "core/base/number.hpp"
#include "core/deck/constraints.hpp"
#include "core/deck/foreign.hpp"
#include "core/deck/named_model.hpp"
#include "core/deck/slips.hpp"
#include "core/deck/spelling.hpp"

namespace treejet {

namespace {

using Words = std::vector<std::string>;

constexpr std::size_t largest_deck = 1 << 18;  ///< bytes; a deck has a few dozen lines
constexpr std::size_t most_findings_shown = 100;
constexpr int after_all_lines = std::numeric_limits<int>::max() - 1;

std::vector<std::string> in_order(std::vector<Finding> findings) {
  std::stable_sort(findings.begin(), findings.end(),
                   [](const Finding& a, const Finding& b) { return a.place.order < b.place.order; });
  std::vector<std::string> lines;
  for (const Finding& f : findings) {
    if (lines.size() == most_findings_shown) {
      lines.push_back(fmt::format("and {} more", findings.size() - most_findings_shown));
      break;
    }
    lines.push_back(fmt::format("{}: {}", f.place.name, f.message));
  }
  return lines;
}

std::string without_equals(std::string line) {
  std::replace(line.begin(), line.end(), '=', ' ');
  return line;
}

/// "viscosity = 30." as people write to a command line.
std::string with_blank_for_equals(std::string line) {
  if (const std::size_t place = line.find('='); place != std::string::npos) line[place] = ' ';
  return line;
}

/// Reads in two passes: what is given where, then, when the overrides have had their say, the values.
class Reader {
 public:
  explicit Reader(Deck& deck) : deck_(deck), whole_deck_{deck.name, after_all_lines + 1} {}

  void read() {
    read_text();
    read_overrides();
    const Directive& units = directive("units");  // says what the other numbers are in
    for (const bool first : {true, false})
      for (Given& g : given_)
        if (!g.faulty && (g.directive == &units) == first) assign_value(g);
    apply_model(given_, deck_.parameters, findings_);
    report_foreign();
    check_presence();
    check_relations(whole_deck_, given_, deck_.parameters, findings_);
    if (!findings_.errors.empty())
      throw InputError(fmt::format("{}", fmt::join(in_order(findings_.errors), "\n")));
    deck_.notes = in_order(findings_.notes);
  }

 private:
  void read_text() {
    int number = 0;
    bool finished = false;
    for (const std::string_view line : lines_of(deck_.text)) {
      ++number;
      const Place place{fmt::format("{}:{}", deck_.name, number), number};
      const Words words = words_of(line);
      if (words.empty()) continue;
      if (finished)
        return error(place, last_directive, "expected nothing after it but comments, found {}",
                     quoted(words[0]));
      finished = lower_case(words[0]) == last_directive;
      if (!finished)
        read_line(place, words, given_);
      else if (words.size() > 1)
        error(place, last_directive, "expected nothing after it, found {}", quoted(words[1]));
    }
    if (!finished && !finish_misspelt_)
      error(whole_deck_, last_directive, "missing; it is the last line of a deck");
  }

  void read_overrides() {
    std::vector<Given> overriding;
    for (const std::string& line : deck_.overrides) {
      const Place place{fmt::format("--set {}", quoted(line)), after_all_lines};
      const Words words = words_of(with_blank_for_equals(line));
      if (words.empty() || lower_case(words[0]) == last_directive ||
          line.find_first_of("\r\n") != std::string::npos)
        error(place, "override", "expected one directive and its value");
      else
        read_line(place, words, overriding);
    }
    for (const Given& g : overriding)
      std::erase_if(given_, [&](const Given& old) {
        return old.directive == g.directive || old.directive->words == g.directive->or_else ||
               old.directive->words == g.directive->instead_of;
      });
    given_.insert(given_.end(), overriding.begin(), overriding.end());
  }

  void read_line(const Place& place, const Words& written, std::vector<Given>& given) {
    const Words words = lower_case(written);
    const Spelling* spelling = spelling_at_start(words);
    const Spelling* intended = nearest_spelling(words, spelling ? spelling->words : 0);
    const std::string line = fmt::format("{}", fmt::join(words, " "));
    if (line.find('=') != std::string::npos) {
      error(place, quoted(line), "expected blanks, not =, between a directive and its value");
      intended = directive_at_start(words_of(without_equals(line)));
    } else if (intended) {
      error(place, quoted(line), "unknown directive; did you mean {}?", intended->text);
    } else if (!spelling) {
      unknown(place, words[0]);
    } else if (spelling->foreign) {
      keep_foreign(place, *spelling->foreign, line, std::span(words).subspan(spelling->words));
      intended = foreign_intended(*spelling->foreign, words);
    } else {
      const Given* first = find(given, *spelling->directive);
      if (first && !first->faulty)
        return error(place, spelling->directive->words, "given twice, first at {}", first->place.name);
      given.push_back({spelling->directive,
                       place,
                       {written.begin() + static_cast<long>(spelling->words), written.end()}});
    }
    if (intended && intended->directive) given.push_back({intended->directive, place, {}, /*faulty*/ true});
    finish_misspelt_ |= intended && intended->text == last_directive;
  }

  void unknown(const Place& place, const std::string& first_word) {
    const std::vector<std::string_view> longer = directives_beginning_with(first_word);
    if (longer.empty())
      error(place, quoted(first_word), "unknown directive; `treejet template` shows all there are");
    else
      error(place, first_word, "expected {}", fmt::join(longer, ", or "));
  }

  void assign_value(Given& g) {
    if (std::holds_alternative<std::vector<std::string> Parameters::*>(g.directive->member))
      drop_foreign_keys(g);
    later_jetspin_ |= g.directive->since_1_21;
    const std::string problem = assign(*g.directive, g.arguments, deck_.parameters);
    g.faulty = !problem.empty();
    if (g.faulty) return error(g.place, g.directive->words, "{}", problem);
    if (g.arguments.size() != 1) return;
    const std::string slip =
        likely_slip(*g.directive, real_number(g.arguments[0]).value, deck_.parameters.units);
    if (!slip.empty()) note(g.place, g.directive->words, "{}", slip);
  }

  void drop_foreign_keys(Given& g) {
    Words left_out;
    for (const ForeignKey& foreign : foreign_keys())
      if (std::erase_if(g.arguments, [&](const std::string& key) { return lower_case(key) == foreign.key; }) >
          0)
        left_out.push_back(fmt::format("{} ({})", foreign.key, foreign.feature));
    if (!left_out.empty())
      note(g.place, g.directive->words, "JETSPIN's keys of what is not modelled are left out: {}",
           fmt::join(left_out, ", "));
    later_jetspin_ |= !left_out.empty();
  }

  void keep_foreign(const Place& place, const Foreign& f, const std::string& line,
                    std::span<const std::string> rest) {
    const auto same = [&](const ForeignLines& lines) { return lines.feature == f.feature; };
    auto lines = std::find_if(foreign_.begin(), foreign_.end(), same);
    if (lines == foreign_.end()) lines = foreign_.insert(foreign_.end(), {f.feature, f.advice, place, line});
    ++lines->count;
    lines->harmless &= f.harmless;
    lines->off |= rest.size() == 1 && !f.off.empty() && reads_as(rest[0], f.off);
    later_jetspin_ |= f.since_1_21;
  }

  /// The same word, or the same number.
  static bool reads_as(const std::string& word, std::string_view value) {
    const Reading<double> number = real_number(word), wanted = real_number(value);
    return word == value ||
           (number.problem.empty() && wanted.problem.empty() && number.value == wanted.value);
  }

  /// `system 4` is about our system, too; it is not missing besides.
  static const Spelling* foreign_intended(const Foreign& f, const Words& words) {
    const bool a_value = f.words.starts_with("system ") || f.words.starts_with("integrator ");
    return a_value ? directive_at_start(words) : nullptr;
  }

  void report_foreign() {
    for (const ForeignLines& f : foreign_) {
      const std::string count = f.count > 1 ? fmt::format(" ({} lines on {})", f.count, f.feature) : "";
      if (f.harmless || f.off)
        note(f.first, f.first_line, "left out{}{}{}", count, f.off ? ": nothing here differs from it" : ": ",
             f.off ? "" : f.advice);
      else
        error(f.first, f.first_line, "JETSPIN's, not modelled here{}: {}", count, f.advice);
    }
    note_coulomb_law();
  }

  /// Versions of JETSPIN mean different laws by the same lines: such a deck is told which one it gets.
  void note_coulomb_law() {
    const bool named = find(given_, directive("coulomb law")) && find(given_, directive("dragvel"));
    if (!later_jetspin_ || named) return;
    const Parameters& p = deck_.parameters;
    findings_.notes.push_back(
        {whole_deck_,
         fmt::format("the Coulomb law is {}, and beads are released {} the paper's dragging velocity; "
                     "JETSPIN from 1.21 on means coulomb law softened, and dragvel no where it is not given",
                     p.coulomb_law == CoulombLaw::point ? "point, 1/R^2" : "softened, 1/(R + a)^2",
                     p.dragvel ? "with" : "without")});
  }

  void check_presence() {
    for (const Directive& d : directives()) {
      const Given* given = find(given_, d);
      if (d.mandatory && !given) error(whole_deck_, d.words, "missing; it is mandatory: {}", signature(d));
      if (d.or_else.empty()) continue;
      const Directive& alternative = directive(d.or_else);
      const Given* other = find(given_, alternative);
      if (!given && !other && &d < &alternative)
        error(whole_deck_, d.words, "missing; expected either {} or {}", signature(d),
              signature(alternative));
      if (given && other && other < given)
        error(given->place, d.words, "expected either this or {}, which is given at {}", d.or_else,
              other->place.name);
    }
  }

  static std::string signature(const Directive& d) {
    return fmt::format("{} <{}{}{}>", d.words, argument(d), d.unit.empty() ? "" : ", ", d.unit);
  }

  template <class... T>
  void note(const Place& place, std::string_view about, fmt::format_string<T...> what, T&&... values) {
    const std::string text = fmt::format(what, std::forward<T>(values)...);
    findings_.notes.push_back({place, fmt::format("{}: {}", about, text)});
  }

  template <class... T>
  void error(const Place& place, std::string_view about, fmt::format_string<T...> what, T&&... values) {
    const std::string text = fmt::format(what, std::forward<T>(values)...);
    findings_.errors.push_back({place, fmt::format("{}: {}", about, text)});
  }

  Deck& deck_;
  const Place whole_deck_;
  std::vector<Given> given_;
  std::vector<ForeignLines> foreign_;
  Findings findings_;
  bool later_jetspin_ = false;  ///< words that JETSPIN knows since 1.21
  bool finish_misspelt_ = false;
};

}  // namespace

Deck parse_deck(std::string_view text, std::string name, std::vector<std::string> overrides) {
  for (std::string& line : overrides) line = utf8(line);
  Deck deck{{}, utf8(text), std::move(name), std::move(overrides), {}};
  if (deck.text.size() > largest_deck)
    throw InputError(deck.name + ": expected a deck, found more than 256 kB");
  if (deck.text.find('\0') != std::string::npos)
    throw InputError(deck.name + ": expected a text file, found a zero byte");
  Reader(deck).read();
  return deck;
}

Deck changed(const Deck& deck, const std::vector<std::string>& overrides) {
  const auto directive_of = [](const std::string& line) {
    const Spelling* spelling = directive_at_start(lower_case(words_of(with_blank_for_equals(line))));
    return spelling ? spelling->directive : nullptr;
  };
  std::vector<std::string> all = deck.overrides;
  for (const std::string& line : overrides)
    if (const Directive* d = directive_of(line))
      std::erase_if(all, [&](const std::string& old) {
        const Directive* before = directive_of(old);
        return before == d || (before && before->words == d->or_else);
      });
  all.insert(all.end(), overrides.begin(), overrides.end());
  return parse_deck(deck.text, deck.name, std::move(all));
}

std::string notes(const Deck& deck) {
  std::string text;
  for (const auto& note : deck.notes) text += fmt::format("note: {}\n", note);
  return text;
}

Deck read_deck(const std::string& path, const std::vector<std::string>& overrides) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(fmt::format("{}: cannot be opened: {}", path, std::strerror(errno)));
  std::string text(largest_deck + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad()) throw FileError(fmt::format("{}: cannot be read: {}", path, std::strerror(errno)));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return parse_deck(text, path, overrides);
}

}  // namespace treejet
