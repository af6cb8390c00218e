#pragma once
/// Numbers as Fortran users write them: 1.d-8, 10000.d, 0.02d0, 1.E+2, +.5, 5. (exponent letter d or e,
/// either case; a letter without digits means exponent 0). Converted with correct rounding. Everything else
/// is a problem, never a guess: a second dot, a unit stuck to the number, nan, inf, a value that overflows or
/// rounds to zero.

#include <string>
#include <string_view>

namespace treejet {

/// A number, or what is wrong with the word: a phrase that begins with "found" and ends with the nearest fix,
/// if any.
template <class T>
struct Reading {
  T value = 0;
  std::string problem = {};
};

Reading<double> real_number(std::string_view word);
Reading<int> integer(std::string_view word);

/// A word of unknown origin made fit for a message: quoted, shortened, bytes that are not printable ASCII as
/// \xNN.
std::string quoted(std::string_view word);

}  // namespace treejet
