#include "core/io/provenance.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <filesystem>

#include "core/base/lines.hpp"
#include "core/base/version.hpp"
#include "core/io/hdf5_file.hpp"

namespace treejet {

Provenance provenance(const Deck& deck, std::string_view isa_name) {
  const Version v = version();
  Provenance p{std::string(v.number),
               std::string(v.commit),
               std::string(v.compiler),
               std::string(v.build),
               std::string(isa_name),
               {},
               {},
               deck.text,
               deck.overrides,
               {}};
  p.libraries = fmt::format("HDF5 {}, Eigen {}.{}.{}, fmt {}.{}.{}", hdf5_version(), EIGEN_WORLD_VERSION,
                            EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION, FMT_VERSION / 10000,
                            FMT_VERSION / 100 % 100, FMT_VERSION % 100);
  p.deck_name = utf8(std::filesystem::path(deck.name).filename().string());
  return p;
}

std::string program(const Provenance& p) {
  return fmt::format("treejet {} (git {}), {}, {} build, {} vectors", p.version, p.commit, p.compiler,
                     p.build, p.isa_name);
}

std::string deck_description(std::string_view name, std::string_view deck,
                             const std::vector<std::string>& overrides) {
  std::string text = fmt::format("deck {}\n", utf8(name));
  for (const std::string_view line : lines_of(deck)) text += fmt::format("| {}\n", line);
  for (const auto& line : overrides) text += fmt::format("--set \"{}\"\n", line);
  return text;
}

std::string description(const Provenance& p) {
  std::string text = fmt::format("{}\n{}\n", program(p), p.libraries);
  if (!p.field_map.empty()) text += p.field_map + "\n";
  if (!p.begins_with.empty()) text += fmt::format("begins with {}\n", p.begins_with);
  return text + deck_description(p.deck_name, p.deck, p.overrides);
}

std::string commented(const Provenance& p, std::string_view mark) {
  std::string text;
  const std::string all = description(p);
  for (const std::string_view line : lines_of(all)) text += fmt::format("{}{}\n", mark, line);
  return text;
}

}  // namespace treejet
