/// Decks: one that is read must spell out to a deck that reads the same. Lines at the start that begin with
/// "--set " are overrides. The messages of a deck are ASCII.

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/base/error.hpp"
#include "core/deck/deck.hpp"
#include "core/deck/directives.hpp"
#include "core/deck/foreign.hpp"
#include "core/deck/observable_keys.hpp"
#include "core/io/atomic_file.hpp"
#include "validation/fuzz/target.hpp"
#include "validation/support/installation.hpp"

namespace treejet::fuzz {

namespace {

/// The parameters as a deck.
std::string spelled_out(const Parameters& p) {
  std::string text;
  for (const Directive& d : directives()) {
    const bool without_company = d.words.starts_with("hbfluid ") && !p.hbfluid;
    const std::string value = value_text(d, p);
    if (!value.empty() && !without_company) text += fmt::format("{} {}\n", d.words, value);
  }
  return text + "finish\n";
}

}  // namespace

std::string dictionary_of_decks() {
  std::string text;
  for (const Directive& d : directives()) {
    text += fmt::format("\"{} \"\n\"{}\"\n", d.words, argument(d));
    if (!d.example.empty()) text += fmt::format("\"{}\"\n", d.example);
  }
  for (const Foreign& f : foreign_directives()) text += fmt::format("\"{} \"\n", f.words);
  for (const ObservableKey& k : observable_keys) text += fmt::format("\" {}\"\n", k.key);
  for (const char* piece :
       {"finish", "--set ", "\\x0d\\x0a", " # ", "1.d-8", "yes", "no", "nan", "1.d400", "0.02.d0"})
    text += fmt::format("\"{}\"\n", piece);
  return text;
}

std::vector<std::string> decks() {
  std::vector<std::filesystem::path> files;
  const std::filesystem::path tree = source_tree();
  for (const auto& example : std::filesystem::directory_iterator(tree / "examples"))
    if (exists(example.path() / "input.dat")) files.push_back(example.path() / "input.dat");
  for (const auto& deck : std::filesystem::directory_iterator(tree / "validation" / "decks"))
    if (deck.path().extension() == ".dat") files.push_back(deck.path());
  std::sort(files.begin(), files.end());
  std::vector<std::string> texts{"--set tolerance 1.d-5\n--set viscosity 2 Pa s\n" + deck_template()};
  for (const auto& file : files) texts.push_back(read_whole(file));
  return texts;
}

void feed_deck(std::string_view bytes) {
  std::string text(bytes);
  std::vector<std::string> overrides;
  for (constexpr std::string_view set = "--set "; text.starts_with(set);) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    overrides.push_back(text.substr(set.size(), end < set.size() ? 0 : end - set.size()));
    text.erase(0, end + 1);
  }
  try {
    const Deck deck = parse_deck(text, "deck", overrides);
    const std::string spelling = spelled_out(deck.parameters);
    demand(spelled_out(parse_deck(spelling, "spelled out").parameters) == spelling,
           "a deck spelled out reads the same");
  } catch (const InputError& error) {
    const std::string_view message = error.what();
    demand(!message.empty(), "an error has a message");
    for (const char c : message) demand(c == '\n' || (c >= ' ' && c <= '~'), "a message is printable");
  }
}

}  // namespace treejet::fuzz
