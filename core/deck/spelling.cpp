#include "core/deck/spelling.hpp"

#include <algorithm>
#include <functional>

#include "core/deck/suggestion.hpp"

namespace treejet {

namespace {

std::size_t count_words(std::string_view text) {
  return 1 + static_cast<std::size_t>(std::count(text.begin(), text.end(), ' '));
}

std::vector<Spelling> all_spellings() {
  std::vector<Spelling> all{{last_directive, 1}};
  for (const Directive& d : directives()) {
    all.push_back({d.words, count_words(d.words), &d});
    for (std::string_view rest = d.synonyms; !rest.empty();) {
      const std::string_view synonym = rest.substr(0, rest.find(", "));
      all.push_back({synonym, count_words(synonym), &d});
      rest.remove_prefix(std::min(rest.size(), synonym.size() + 2));
    }
  }
  for (const Foreign& f : foreign_directives()) all.push_back({f.words, count_words(f.words), nullptr, &f});
  return all;
}

const std::vector<Spelling>& spellings() {
  static const std::vector<Spelling> all = all_spellings();
  return all;
}

std::string first_words(std::span<const std::string> line, std::size_t count) {
  std::string joined;
  for (const std::string& word : line.first(count)) joined += (joined.empty() ? "" : " ") + word;
  return joined;
}

/// Does alike(word, known) hold for each word of the spelling and the line's word in its place?
template <class Alike>
bool matches(std::span<const std::string> line, const Spelling& spelling, Alike alike) {
  if (spelling.words > line.size()) return false;
  std::string_view rest = spelling.text;
  for (const std::string& word : line.first(spelling.words)) {
    const std::string_view known = rest.substr(0, rest.find(' '));
    if (!alike(word, known)) return false;
    rest.remove_prefix(std::min(rest.size(), known.size() + 1));
  }
  return true;
}

template <class Wanted>
const Spelling* longest(std::span<const std::string> line, Wanted wanted) {
  const Spelling* best = nullptr;
  for (const Spelling& s : spellings())
    if (wanted(s) && (!best || s.words > best->words) && matches(line, s, std::equal_to<std::string_view>{}))
      best = &s;
  return best;
}

/// `coulomb tree` is the directive coulomb with its value tree, `coulomb tree chain` is another directive:
/// where the longest spelling leaves no value, a shorter one counts that does.
const Spelling* with_value(std::span<const std::string> line, const Spelling* longest_one) {
  if (!longest_one || !longest_one->directive || longest_one->words < line.size()) return longest_one;
  const Spelling* shorter = longest(
      line, [&](const Spelling& s) { return s.directive != nullptr && s.words < longest_one->words; });
  Parameters scratch;
  const bool counts = shorter && assign(*shorter->directive, line.subspan(shorter->words), scratch).empty();
  return counts ? shorter : longest_one;
}

}  // namespace

const Spelling* spelling_at_start(std::span<const std::string> line) {
  return with_value(line, longest(line, [](const Spelling&) { return true; }));
}

const Spelling* directive_at_start(std::span<const std::string> line) {
  return with_value(line, longest(line, [](const Spelling& s) { return s.directive != nullptr; }));
}

const Spelling* nearest_spelling(std::span<const std::string> line, std::size_t words) {
  const bool first_word_known = !directives_beginning_with(line[0]).empty();
  const Spelling* best = nullptr;
  int least = 0;
  for (const Spelling& s : spellings()) {
    if (words > 0 && !s.text.starts_with(line[0])) continue;
    if (s.words <= words || (s.words == 1 && first_word_known) || !matches(line, s, resembles)) continue;
    const int distance = edit_distance(first_words(line, s.words), s.text);
    if (distance == 0) continue;  // not misspelt: passed over by spelling_at_start
    if (!best || distance < least) best = &s, least = distance;
  }
  for (const Spelling& s : spellings())  // blanks forgotten: finaltime, print_time
    if (!best && words == 0 && !first_word_known && s.words > 1 && resembles(line[0], s.text)) best = &s;
  return best;
}

std::vector<std::string_view> directives_beginning_with(std::string_view word) {
  std::vector<std::string_view> found;
  for (const Directive& d : directives())
    if (d.words.substr(0, d.words.find(' ')) == word) found.push_back(d.words);
  return found;
}

}  // namespace treejet
