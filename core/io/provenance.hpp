#pragma once
/// What made a file: program, libraries and deck. All of it is a function of what is run and of the vector
/// path, so that a run's files are the same bytes on any number of threads and ranks, at any hour, and after
/// any resumption. What is not - host, threads, ranks, clock - stands in run.json beside them
/// (core/io/run_record.hpp).

#include <string>
#include <string_view>
#include <vector>

#include "core/deck/deck.hpp"

namespace treejet {

struct Provenance {
  std::string version, commit, compiler, build, isa_name;
  std::string libraries;  ///< "HDF5 1.10.8, Eigen 3.4.0, ..."
  std::string deck_name;  ///< of the file, without its directory
  std::string deck;       ///< its text, byte for byte
  std::vector<std::string> overrides;
  std::string begins_with;  ///< the state of another run that this one began with, and its time; else empty
  std::string field_map = {};  ///< its file, size and hash; empty without one
};

/// Between the number of a version and the name of physics that is not stock
/// (integrators/run/own_physics.hpp).
inline constexpr const char* own_physics_mark = " with physics of its own: ";

Provenance provenance(const Deck& deck, std::string_view isa_name);

/// "treejet 0.1.0 (git 47df22d), GNU 12.2.0, Release build, avx512 vectors"
std::string program(const Provenance& p);

/// What `treejet info` shows: a line for the program, the libraries, and the deck with its overrides.
std::string description(const Provenance& p);

/// The last part of it.
std::string deck_description(std::string_view name, std::string_view deck,
                             const std::vector<std::string>& overrides);

/// The whole as lines that begin with `mark`, for the head of a text file.
std::string commented(const Provenance& p, std::string_view mark);

/// Where the rest is told, beside each file of a run.
inline constexpr const char* run_record_name = "run.json";

}  // namespace treejet
