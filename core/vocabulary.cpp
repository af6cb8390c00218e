#include "core/vocabulary.hpp"

#include <algorithm>

#include "core/suggestion.hpp"

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
  for (const std::string& word : line.first(std::min(count, line.size())))
    joined += (joined.empty() ? "" : " ") + word;
  return joined;
}

bool each_word_resembles(std::span<const std::string> line, std::string_view spelling) {
  for (const std::string& word : line) {
    const std::string_view known = spelling.substr(0, spelling.find(' '));
    if (!resembles(word, known)) return false;
    if (known.size() == spelling.size()) break;
    spelling.remove_prefix(known.size() + 1);
  }
  return true;
}

}  // namespace

const Spelling* spelling_at_start(std::span<const std::string> line) {
  const Spelling* longest = nullptr;
  for (const Spelling& s : spellings())
    if ((!longest || s.words > longest->words) && first_words(line, s.words) == s.text) longest = &s;
  return longest;
}

const Spelling* nearest_spelling(std::span<const std::string> line, std::size_t words) {
  const Spelling* best = nullptr;
  int least = 0;
  for (const Spelling& s : spellings()) {
    if (s.words <= words || s.words > line.size()) continue;
    if (!each_word_resembles(line, s.text)) continue;
    const int distance = edit_distance(first_words(line, s.words), s.text);
    if (!best || distance < least) best = &s, least = distance;
  }
  for (const Spelling& s : spellings())  // blanks forgotten: finaltime, print_time
    if (!best && words == 0 && s.words > 1 && resembles(line[0], s.text)) best = &s;
  return best;
}

std::vector<std::string_view> directives_beginning_with(std::string_view word) {
  std::vector<std::string_view> found;
  for (const Directive& d : directives())
    if (d.words.substr(0, d.words.find(' ')) == word) found.push_back(d.words);
  return found;
}

}  // namespace treejet
