#include "core/deck.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <set>

#include "core/deck_relations.hpp"
#include "core/error.hpp"
#include "core/number.hpp"
#include "core/vocabulary.hpp"

namespace treejet {

namespace {

constexpr std::size_t largest_deck = 1 << 20;  ///< bytes; a deck has a few dozen lines
constexpr std::size_t most_errors_shown = 100;

std::string_view without_comment(std::string_view line) {
  return line.substr(0, line.find_first_of("#!"));
}

/// Lower-case words of a line. The only letters a deck knows are ASCII.
std::vector<std::string> words_of(std::string_view line) {
  constexpr std::string_view blanks = " \t\v\f\r\n";
  std::vector<std::string> words;
  line = without_comment(line);
  for (std::size_t i = line.find_first_not_of(blanks); i != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(blanks, i), line.size());
    std::string& word = words.emplace_back(line.substr(i, end - i));
    for (char& c : word)
      if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    i = line.find_first_not_of(blanks, end);
  }
  return words;
}

/// Lines of a text with line ends \n, \r\n or \r, without the byte order mark some editors put in front.
std::vector<std::string_view> lines_of(std::string_view text) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
    lines.push_back(text.substr(0, end));
    text.remove_prefix(end + (text.substr(end).starts_with("\r\n") ? 2 : end < text.size() ? 1 : 0));
  }
  return lines;
}

/// Reads lines in two passes: what is given where, then, when the overrides have had their say, the values.
class Reader {
 public:
  explicit Reader(Deck& deck) : deck_(deck) {}

  void read() {
    read_text();
    if (!deck_.overrides.empty()) read_overrides();
    for (Given& g : given_) {
      const std::string problem = assign(*g.directive, g.arguments, deck_.parameters);
      g.valid = problem.empty();
      if (!g.valid) error(g.where, g.directive->words, problem + longer_spelling(g));
    }
    check_presence();
    check_relations(deck_.name, given_, deck_.parameters, findings_);
    deck_.notes = findings_.notes;
    if (findings_.errors.empty()) return;
    const std::size_t count = findings_.errors.size(), shown = std::min(count, most_errors_shown);
    std::string all = fmt::format(
        "{}", fmt::join(findings_.errors.begin(), findings_.errors.begin() + static_cast<long>(shown), "\n"));
    if (shown < count) all += fmt::format("\n{}: {} more errors", deck_.name, count - shown);
    throw InputError(all);
  }

 private:
  void read_text() {
    int number = 0;
    bool finished = false;
    for (const std::string_view line : lines_of(deck_.text)) {
      const std::string where = fmt::format("{}:{}", deck_.name, ++number);
      const std::vector<std::string> words = words_of(line);
      if (words.empty()) continue;
      if (finished) {
        error(where, last_directive, "expected nothing after it but comments, found " + quoted(words[0]));
        break;
      }
      finished = words[0] == last_directive;
      if (!finished)
        read_line(where, words, given_);
      else if (words.size() > 1)
        error(where, last_directive, "expected nothing on its line, found " + quoted(words[1]));
    }
    if (!finished && !finish_misspelt_)
      error(deck_.name, last_directive, "missing; it is the last line of a deck");
  }

  void read_overrides() {
    std::vector<Given> overriding;
    for (const std::string& line : deck_.overrides) {
      const std::string where = "--set " + quoted(line);
      const std::vector<std::string> words = words_of(line);
      if (words.empty() || words[0] == last_directive || line.find_first_of("\r\n") != std::string::npos)
        error(where, "override", "expected one directive and its value");
      else
        read_line(where, words, overriding);
    }
    for (const Given& g : overriding)
      std::erase_if(given_, [&](const Given& old) { return replaces(g, old); });
    given_.insert(given_.end(), overriding.begin(), overriding.end());
  }

  static bool replaces(const Given& g, const Given& old) {
    return old.directive == g.directive || old.directive->words == g.directive->or_else;
  }

  void read_line(const std::string& where, const std::vector<std::string>& words, std::vector<Given>& given) {
    const Spelling* spelling = spelling_at_start(words);
    if (!spelling) return unknown(where, words);
    if (spelling->foreign)
      return error(
          where, spelling->text,
          fmt::format("a directive of JETSPIN's that Treejet does not have: {}", spelling->foreign->advice));
    const auto first = std::find_if(given.begin(), given.end(),
                                    [&](const Given& g) { return g.directive == spelling->directive; });
    if (first != given.end())
      return error(where, spelling->directive->words, "given twice, first at " + first->where);
    given.push_back(
        {spelling->directive, where, {words.begin() + static_cast<long>(spelling->words), words.end()}});
  }

  void unknown(const std::string& where, const std::vector<std::string>& words) {
    if (const Spelling* nearest = nearest_spelling(words)) {
      if (nearest->directive) meant_.insert(nearest->directive);
      finish_misspelt_ |= nearest->text == last_directive;
      return error(where, quoted(fmt::format("{}", fmt::join(words, " "))),
                   fmt::format("unknown directive; did you mean {}?", nearest->text));
    }
    const std::vector<std::string_view> longer = directives_beginning_with(words[0]);
    if (!longer.empty())
      return error(where, words[0], fmt::format("expected {}", fmt::join(longer, ", or ")));
    error(where, quoted(words[0]), "unknown directive; `treejet template` shows all there are");
  }

  /// "print xyz maxnumb 400" reads as print xyz with a bad number, but is a misspelt longer directive.
  std::string longer_spelling(const Given& g) {
    std::vector<std::string> words = words_of(g.directive->words);
    const std::size_t taken = words.size();
    words.insert(words.end(), g.arguments.begin(), g.arguments.end());
    const Spelling* nearest = nearest_spelling(words, taken);
    if (!nearest) return {};
    if (nearest->directive) meant_.insert(nearest->directive);
    return fmt::format("; did you mean {}?", nearest->text);
  }

  void check_presence() {
    for (const Directive& d : directives()) {
      if (meant_.contains(&d) || find(d)) continue;
      if (d.mandatory) error(deck_.name, d.words, "missing; it is mandatory: " + signature(d));
      if (d.or_else.empty()) continue;
      const Directive& other = directive(d.or_else);
      if (!find(other) && !meant_.contains(&other) && &d < &other)
        error(deck_.name, d.words,
              fmt::format("missing; expected either {} or {}", signature(d), signature(other)));
    }
    for (const Given& g : given_) {
      const Given* other = g.directive->or_else.empty() ? nullptr : find(directive(g.directive->or_else));
      if (other && other < &g)
        error(g.where, g.directive->words,
              fmt::format("expected either this or {}, which is given at {}", other->directive->words,
                          other->where));
    }
  }

  static std::string signature(const Directive& d) {
    return fmt::format("{} <{}{}{}>", d.words, argument(d), d.unit.empty() ? "" : ", ", d.unit);
  }

  const Given* find(const Directive& d) const {
    const auto found =
        std::find_if(given_.begin(), given_.end(), [&](const Given& g) { return g.directive == &d; });
    return found == given_.end() ? nullptr : &*found;
  }

  void error(std::string_view where, std::string_view directive, std::string_view what) {
    findings_.errors.push_back(fmt::format("{}: {}: {}", where, directive, what));
  }

  Deck& deck_;
  std::vector<Given> given_;
  Findings findings_;
  std::set<const Directive*> meant_;  ///< misspelt, hence not missing
  bool finish_misspelt_ = false;
};

}  // namespace

Deck parse_deck(std::string text, std::string name, std::vector<std::string> overrides) {
  Deck deck{{}, std::move(text), std::move(name), std::move(overrides), {}};
  if (deck.text.size() > largest_deck)
    throw InputError(deck.name + ": expected a deck, found more than a megabyte");
  if (deck.text.find('\0') != std::string::npos)
    throw InputError(deck.name + ": expected a text file, found a zero byte");
  Reader(deck).read();
  return deck;
}

Deck read_deck(const std::string& path, const std::vector<std::string>& overrides) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(fmt::format("{}: cannot be opened: {}", path, std::strerror(errno)));
  std::string text(largest_deck + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad()) throw FileError(fmt::format("{}: cannot be read: {}", path, std::strerror(errno)));
  text.resize(static_cast<std::size_t>(file.gcount()));
  return parse_deck(std::move(text), path, overrides);
}

}  // namespace treejet
