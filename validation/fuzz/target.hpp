#pragma once
/// Readers as fuzzers see them: any bytes are read, and what has been read holds together, or refused with an
/// InputError or FileError that says why. Anything else is a fault: another exception, a crash, a finding of
/// a sanitizer, an allocation that the size of the input does not bear out.
///
/// Two drivers: validation/fuzz/libfuzzer.cpp, guided by coverage, for hours, and
/// validation/tests/product/mutated_bytes.cpp, mutants of the seeds by fixed random numbers, in every run of
/// the tests. Seeds are what this program writes, made when they are asked for.

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace treejet::fuzz {

struct Target {
  std::string_view name;
  void (*read)(std::string_view bytes);
  std::vector<std::string> (*seeds)();
};

std::span<const Target> targets();
/// std::logic_error if there is none of that name.
const Target& target(std::string_view name);

/// std::logic_error unless it holds; nobody catches one.
void demand(bool holds, const std::string& what);

/// Whether `read` came to its end; false if it refused in the right way.
bool is_read(const std::function<void()>& read);

/// The bytes in a file, the same one for all inputs of a process.
const std::filesystem::path& as_file(std::string_view bytes);

void feed_deck(std::string_view bytes);
void feed_checkpoint(std::string_view bytes);
void feed_trajectory(std::string_view bytes);
void feed_points(std::string_view bytes);
void feed_written(std::string_view bytes);
void feed_field_map(std::string_view bytes);
void feed_quantity(std::string_view bytes);

std::vector<std::string> decks();
std::vector<std::string> checkpoints();
std::vector<std::string> trajectories();
std::vector<std::string> tables_of_points();
std::vector<std::string> written_texts();
std::vector<std::string> field_maps();
std::vector<std::string> quantities();

/// What a deck may hold, one piece a line, as libFuzzer takes it.
std::string dictionary_of_decks();

/// The files of a short run, by name: a run of a straight jet and one of a whipping jet, each stopped on the
/// way and come to its end.
std::vector<std::string> files_of_runs(std::string_view name);

}  // namespace treejet::fuzz
