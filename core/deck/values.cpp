/// Arguments of a directive: words to values and back, one overload for each type a member may have.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/base/lines.hpp"
#include "core/base/number.hpp"
#include "core/deck/choices.hpp"
#include "core/deck/directives.hpp"
#include "core/deck/observable_keys.hpp"
#include "core/deck/units.hpp"

namespace treejet {

namespace {

using Arguments = std::span<const std::string>;

template <class T>
std::vector<std::string_view> known_words() {
  std::vector<std::string_view> known;
  for (const auto& w : choices<T>) known.push_back(w.word);
  return known;
}

std::vector<std::string_view> known_keys() {
  std::vector<std::string_view> keys;
  for (const ObservableKey& k : observable_keys) keys.push_back(k.key);
  return keys;
}

std::string found(Arguments arguments) {
  return "found " + (arguments.empty() ? "nothing" : quoted(fmt::format("{}", fmt::join(arguments, " "))));
}

/// The one word that begins so. A value is never guessed by its letters: `on` is not `no`, gc is not vc.
std::string meant(std::string_view beginning, const std::vector<std::string_view>& known) {
  const auto continues = [&](std::string_view word) {
    return beginning.size() > 1 && word.starts_with(beginning);
  };
  if (std::count_if(known.begin(), known.end(), continues) != 1) return {};
  return fmt::format("; did you mean {}?", *std::find_if(known.begin(), known.end(), continues));
}

/// What the argument is called in documentation.
std::string kind(double) {
  return "real";
}
std::string kind(int) {
  return "integer";
}
std::string kind(const std::string&) {
  return "file";
}
std::string kind(const std::vector<double>&) {
  return "reals";
}
std::string kind(const std::vector<std::string>&) {
  return "keys";
}
template <class T>
std::string kind(T) {
  return fmt::format("{}", fmt::join(known_words<T>(), "|"));
}

template <class T>
std::string kind(const std::optional<T>&) {
  return kind(T{});
}

std::string expected(const Directive& d) {
  std::string text = argument(d);
  if (text == "real") text = "a real number";
  if (text == "integer") text = "an integer";
  if (text == "reals") text = "real numbers";
  if (text == "file") text = "the name of a file";
  if (text == "keys") text = "keys of observables";
  return fmt::format("expected {}{}, ", text, d.unit.empty() ? "" : fmt::format(" ({})", d.unit));
}

std::string trailing(Arguments arguments) {
  return fmt::format("expected nothing after {}, {}", arguments[0], found(arguments.subspan(1)));
}

template <class T>
std::string read_number(const Directive& d, Arguments arguments, Reading<T> (*reading_of)(std::string_view),
                        T& target) {
  if (arguments.empty()) return expected(d) + found(arguments);
  const Reading<T> reading = reading_of(arguments[0]);
  if (!reading.problem.empty()) return expected(d) + reading.problem;
  if (arguments.size() > 1) return trailing(arguments);
  if (d.check.holds && !d.check.holds(reading.value))
    return fmt::format("expected a value that is {}, {}", d.check.words, found(arguments));
  target = reading.value;
  return {};
}

/// "10 kV" in the directive's unit.
std::string read_quantity(const Directive& d, Arguments arguments, double& target) {
  const Reading<double> reading = real_number(arguments[0]);
  if (!reading.problem.empty()) return expected(d) + reading.problem;
  const Unit bare = unit(d.unit).value();
  const std::string wanted = fmt::format("expected {} (in {} or {})", quantity_name(bare.dimension), d.unit,
                                         usual_units(bare.dimension));
  const std::string written = fmt::format("{}", fmt::join(arguments.subspan(1), " "));
  const std::optional<Unit> given = unit(written);
  if (!given) return fmt::format("{}, found {}, which is no unit that is known", wanted, quoted(written));
  if (given->dimension != bare.dimension)
    return fmt::format("{}, {}, {}", wanted, found(arguments), quantity_name(given->dimension));
  const double value = converted(reading.value, *given, bare);
  if (!std::isfinite(value) || (value == 0) != (reading.value == 0))
    return fmt::format("{}, which is beyond the range of double precision in {}", found(arguments), d.unit);
  if (d.check.holds && !d.check.holds(value))
    return fmt::format("expected a value that is {}, {}", d.check.words, found(arguments));
  target = value;
  return {};
}

/// 20.cm: a blank is missing.
std::string stuck_unit(const Directive& d, std::string_view word) {
  const std::size_t digits = number_length(word);
  if (d.unit.empty() || digits == 0 || digits == word.size() || !unit(word.substr(digits))) return {};
  const std::string_view number = word.substr(0, digits), rest = word.substr(digits);
  const bool plain = std::all_of(rest.begin(), rest.end(), is_printable);
  return fmt::format("{}found {}; {}", expected(d), quoted(word),
                     plain ? fmt::format("did you mean {} {}?", number, rest)
                           : fmt::format("a blank is missing behind {}", number));
}

std::string read(const Directive& d, Arguments a, double& target) {
  if (a.size() == 1)
    if (std::string problem = stuck_unit(d, a[0]); !problem.empty()) return problem;
  return a.size() > 1 && !d.unit.empty() ? read_quantity(d, a, target)
                                         : read_number(d, a, real_number, target);
}
std::string read(const Directive& d, Arguments a, int& target) {
  return read_number(d, a, integer, target);
}

std::string read(const Directive& d, Arguments arguments, std::string& target) {
  if (arguments.empty()) return expected(d) + found(arguments);
  if (arguments.size() > 1)
    return fmt::format("expected nothing after {}, {}", quoted(arguments[0]), found(arguments.subspan(1)));
  target = arguments[0];
  return {};
}

std::string read(const Directive& d, Arguments arguments, std::vector<double>& target) {
  if (arguments.empty()) return expected(d) + found(arguments);
  std::vector<double> numbers(arguments.size());
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const std::string problem = read_number(d, arguments.subspan(k, 1), real_number, numbers[k]);
    if (!problem.empty()) return problem;
  }
  target = std::move(numbers);
  return {};
}

std::string read(const Directive& d, Arguments arguments, std::vector<std::string>& target) {
  if (arguments.empty()) return expected(d) + found(arguments);
  const std::vector<std::string_view> keys = known_keys();
  std::vector<std::string> unknown;
  std::vector<std::string> lower(arguments.begin(), arguments.end());
  lower = lower_case(std::move(lower));
  for (const std::string& key : lower)
    if (std::find(keys.begin(), keys.end(), key) == keys.end())
      unknown.push_back(fmt::format("found {}{}", quoted(key), meant(key, keys)));
  if (!unknown.empty())
    return fmt::format("expected keys of observables, {}; they are {}", fmt::join(unknown, ", "),
                       fmt::join(keys, " "));
  target = std::move(lower);
  return {};
}

template <class T>
std::string read(const Directive& d, Arguments arguments, T& target) {
  if (arguments.empty()) return expected(d) + found(arguments);
  const std::string word = lower_case(arguments[0]);
  for (const auto& w : choices<T>) {
    if (w.word != word) continue;
    if (arguments.size() > 1) return trailing(arguments);
    target = w.value;
    return {};
  }
  return expected(d) + found(arguments) + meant(word, known_words<T>());
}

template <class T>
std::string read(const Directive& d, Arguments arguments, std::optional<T>& target) {
  T value{};
  std::string problem = read(d, arguments, value);
  if (problem.empty()) target = value;
  return problem;
}

std::string text(double value) {
  return fmt::format("{}", value);
}
std::string text(int value) {
  return fmt::format("{}", value);
}
std::string text(const std::string& file) {
  return file;
}
std::string text(const std::vector<double>& numbers) {
  return fmt::format("{}", fmt::join(numbers, " "));
}
std::string text(const std::vector<std::string>& keys) {
  return fmt::format("{}", fmt::join(keys, " "));
}
template <class T>
std::string text(T value) {
  for (const auto& w : choices<T>)
    if (w.value == value) return std::string(w.word);
  return {};
}

template <class T>
std::string text(const std::optional<T>& value) {
  return value ? text(*value) : "";
}

/// f applied to what the member pointer points at in the parameters.
template <class Params, class F>
std::string on_member(const Directive& d, Params& parameters, F&& f) {
  return std::visit([&](auto member) { return f(parameters.*member); }, d.member);
}

}  // namespace

std::string assign(const Directive& directive, std::span<const std::string> arguments,
                   Parameters& parameters) {
  Directive d = directive;
  d.unit = bare_unit(d, parameters.units);
  return on_member(d, parameters, [&](auto& member) { return read(d, arguments, member); });
}

std::string argument(const Directive& d) {
  return on_member(d, static_cast<const Parameters&>(Parameters{}),
                   [](const auto& member) { return kind(member); });
}

std::string value_text(const Directive& d, const Parameters& parameters) {
  return on_member(d, parameters, [](const auto& member) { return text(member); });
}

std::vector<std::string> differences(const Parameters& here, const Parameters& there) {
  const auto said = [](const std::string& value) { return value.empty() ? "nothing" : value; };
  std::vector<std::string> lines;
  for (const Directive& d : directives()) {
    const std::string a = value_text(d, here), b = value_text(d, there);
    if (a != b) lines.push_back(fmt::format("{}: {} here, {} there", d.words, said(a), said(b)));
  }
  return lines;
}

}  // namespace treejet
