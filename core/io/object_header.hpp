#pragma once
/// The header of an object in an HDF5 file, and what it leads to, read without the HDF5 library, as far as
/// the library (1.10) would go astray: it divides by the extents of chunks before it looks whether they are
/// all there, follows trees and gaps of heaps in circles, and takes an address that stands for nowhere for
/// that of what it has in memory. Format: HDF5 File Format Specification 3.0, III.A.1 (trees), III.D (heaps),
/// IV.A.1 (headers) and IV.A.2.b (dataspace), .i (layout), .q (continuation), .r (symbol table). FileError if
/// it is damaged.

#include <cstdint>
#include <filesystem>
#include <string>

namespace treejet {

struct HeaderPlace {
  std::uint64_t origin;   ///< bytes of the file in front of what addresses count from
  std::uint64_t address;  ///< of eight bytes
};

/// The names of its members can be looked up: they are in the file, and found by a tree without circles.
void check_group(const std::filesystem::path& file, const std::string& object, const HeaderPlace& place);

/// It can be opened: its values lie in one piece, or in chunks as every version since 1.6.3 makes them for
/// files of the oldest format, as many extents as the table has, found by a tree without circles.
void check_dataset(const std::filesystem::path& file, const std::string& object, const HeaderPlace& place);

}  // namespace treejet
