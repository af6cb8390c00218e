#pragma once
/// A deck as lines of words, before anyone asks what they mean.

#include <string>
#include <string_view>
#include <vector>

namespace treejet {

/// Lines of a text with line ends \n, \r\n or \r, without the byte order mark some editors put in front.
std::vector<std::string_view> lines_of(std::string_view text);

/// Lower-case words of a line up to its comment. The only letters a deck knows are ASCII.
std::vector<std::string> words_of(std::string_view line);

}  // namespace treejet
