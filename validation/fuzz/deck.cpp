/// Feeds arbitrary text to the deck reader (libFuzzer; CMake option TREEJET_FUZZ, clang). A deck is read, or
/// refused with an InputError whose message is printable; anything else is a crash. A deck that is read must
/// spell out to a deck that reads the same. Lines at the start that begin with "--set " are overrides.
///
///     cmake -S . -B fuzz -DTREEJET_FUZZ=ON -DCMAKE_CXX_COMPILER=clang++ && cmake --build fuzz
///     fuzz/fuzz-deck --dictionary > fuzz/deck.dict
///     mkdir -p fuzz/corpus && cp validation/decks/*.dat fuzz/corpus
///     fuzz/fuzz-deck -dict=fuzz/deck.dict -timeout=5 -max_total_time=600 fuzz/corpus

#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "core/base/error.hpp"
#include "core/deck/deck.hpp"
#include "core/deck/directives.hpp"
#include "core/deck/foreign.hpp"
#include "core/deck/observable_keys.hpp"

using namespace treejet;

namespace {

void demand(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "violated: %s\n", what);
  std::abort();
}

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

void print_dictionary() {
  for (const Directive& d : directives()) {
    std::printf("\"%s \"\n\"%s\"\n", std::string(d.words).c_str(), argument(d).c_str());
    if (!d.example.empty()) std::printf("\"%s\"\n", std::string(d.example).c_str());
  }
  for (const Foreign& f : foreign_directives()) std::printf("\"%s \"\n", std::string(f.words).c_str());
  for (const ObservableKey& k : observable_keys) std::printf("\" %s\"\n", std::string(k.key).c_str());
  for (const char* piece :
       {"finish", "--set ", "\\x0d\\x0a", " # ", "1.d-8", "yes", "no", "nan", "1.d400", "0.02.d0"})
    std::printf("\"%s\"\n", piece);
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  if (*argc == 2 && std::string_view((*argv)[1]) == "--dictionary") {
    print_dictionary();
    std::exit(0);
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string text(reinterpret_cast<const char*>(data), size);
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
  return 0;
}
