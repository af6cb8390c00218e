#pragma once
/// Words of a command line for the shell.

#include <string>
#include <string_view>

namespace treejet {

/// The text as one word, whatever is in it.
inline std::string shell_word(std::string_view text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

}  // namespace treejet
