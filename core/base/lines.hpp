#pragma once
/// Text of any editor as lines of words, before anyone asks what they mean: decks, tables, deck lines given
/// as options. Errors: none; every text has lines and words.

#include <string>
#include <string_view>
#include <vector>

namespace treejet {

/// Lines of a text with line ends \n, \r\n or \r, without the byte order mark some editors put in front.
std::vector<std::string_view> lines_of(std::string_view text);

/// Words of a line up to its comment (# or !), as they are written.
std::vector<std::string> words_of(std::string_view line);

/// With lower-case letters. The only letters known are ASCII.
std::string lower_case(std::string_view word);
std::vector<std::string> lower_case(std::vector<std::string> words);

/// The text as one word of a shell: in quotes where it needs them.
std::string for_shell(const std::string& text);

/// The text in UTF-8: as it is if that is what it is, else read as Latin-1, which makes every byte a
/// character. Text of users goes through here before it goes into a file.
std::string utf8(std::string_view text);

/// The text fit for a terminal, which must not take it for commands: with ? for control characters other than
/// line ends and tabs. What files and their names say goes through here before it is shown.
std::string printable(std::string text);

}  // namespace treejet
