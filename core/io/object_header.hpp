#pragma once
/// The header of an object in an HDF5 file, read without the HDF5 library, as far as it says how the object's
/// values are laid out. The library divides by the extents of chunks as it opens a dataset, and 1.10 does not
/// look first whether they are all there and not zero; a signal would end the program. Format: HDF5 File
/// Format Specification 3.0, IV.A.1 (headers), IV.A.2.b (dataspace), .i (layout) and .q (continuation).

#include <cstdint>
#include <filesystem>
#include <string>

namespace treejet {

/// FileError unless the object at this address (of eight bytes, counted from the beginning of the file) is a
/// dataset that the library can open: of values in one piece, or in chunks as every version since 1.6.3 makes
/// them for files of the oldest format, as many extents as the table has.
void check_layout(const std::filesystem::path& file, const std::string& object, std::uint64_t address);

}  // namespace treejet
