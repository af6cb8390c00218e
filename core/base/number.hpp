#pragma once
/// Numbers as Fortran users write them: 1.d-8, 10000.d, 0.02d0, 1.E+2, +.5, 5. (exponent letter d or e,
/// either case; a letter without digits means exponent 0). Converted with correct rounding. Everything else
/// is a problem, never a guess: a second dot, a unit stuck to the number, nan, inf, a value that overflows or
/// rounds to zero. A hint never changes the magnitude: it only spells the same number properly (1.q4, 1x10^4,
/// 0.02.d0, a typographic minus), and where two numbers could be meant (44,000) it names none.

#include <string>
#include <string_view>

namespace treejet {

/// A number, or what is wrong with the word: a phrase that begins with "found" and ends with the same number
/// well spelt, if there is one.
template <class T>
struct Reading {
  T value = 0;
  std::string problem = {};
};

Reading<double> real_number(std::string_view word);
Reading<int> integer(std::string_view word);

/// How many letters of the word, from its start on, are a well-formed number: 3 of "20.cm", 0 of "cm".
std::size_t number_length(std::string_view word);

/// Printable ASCII.
constexpr bool is_printable(char c) {
  return c >= ' ' && c <= '~';
}

/// A word of unknown origin made fit for a message: quoted, shortened, bytes that are not printable ASCII as
/// \xNN.
std::string quoted(std::string_view word);

}  // namespace treejet
