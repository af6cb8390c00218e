/// Feeds one of the readers (validation/fuzz/target.hpp) by libFuzzer. CMake preset fuzz; a program each:
///
///     cmake --preset fuzz && cmake --build build/fuzz
///     build/fuzz/fuzz-checkpoint --seeds build/fuzz/seeds
///     build/fuzz/fuzz-checkpoint -timeout=10 -malloc_limit_mb=256 -max_total_time=600 build/fuzz/seeds
///
/// HDF5 loses memory over damaged files, and asks for too much: -detect_leaks=0, at the end of the program
/// ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=1, too. --seeds DIR writes the seeds, --dictionary
/// prints what decks may hold, for libFuzzer's -dict. An input that was found is run again by giving its file
/// instead of the directory.

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "validation/fuzz/target.hpp"

using namespace treejet::fuzz;

namespace {

const Target& own_target() {
  static const Target& own = target(TREEJET_FUZZ_TARGET);
  return own;
}

void write_seeds(const std::filesystem::path& directory) {
  std::filesystem::create_directories(directory);
  int number = 0;
  for (const std::string& seed : own_target().seeds())
    std::ofstream(directory / fmt::format("seed-{}", number++), std::ios::binary) << seed;
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  const std::string first = *argc > 1 ? (*argv)[1] : "";
  if (first == "--seeds" && *argc == 3) write_seeds((*argv)[2]);
  if (first == "--dictionary") std::fputs(dictionary_of_decks().c_str(), stdout);
  if (first.starts_with("--")) std::exit(0);
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  own_target().read({reinterpret_cast<const char*>(data), size});
  return 0;
}
