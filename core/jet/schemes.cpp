#include "core/jet/schemes.hpp"

#include <fmt/format.h>

#include <vector>

namespace treejet {

std::string scheme_words(bool adaptive, std::string_view conjunction, bool numbers) {
  std::vector<std::string> words;
  for (const auto& s : schemes)
    if (s.adaptive == adaptive)
      words.push_back(numbers ? fmt::format("{} ({})", s.number, s.word) : std::string(s.word));
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k) {
    const bool last = k + 1 == words.size();
    text += k == 0 ? words[k] : last ? fmt::format(" {} {}", conjunction, words[k]) : ", " + words[k];
  }
  return text;
}

}  // namespace treejet
