#pragma once
/// Field maps (core/jet/field_map.hpp) from files, as programs of finite elements write them.
///
///     *.h5, any HDF5 file   datasets `potential` [nz][ny][nx], `origin` [3] and `spacing` [3] (x, y, z)
///     *.vti                 VTK image data, version 0.1 or 1.0: one piece, point data of one array (of
///                           several, `potential`), ascii or appended raw without compression, little-endian
///
/// Lengths are in m and the potential in V, as such programs have them; the nozzle is at the origin, x goes
/// towards the collector. Errors: FileError for a file that cannot be read or is damaged, InputError for one
/// that holds no map.

#include <filesystem>
#include <memory>

#include "core/deck/deck.hpp"
#include "core/jet/field_map.hpp"

namespace treejet {

std::shared_ptr<const FieldMap> read_field_map(const std::filesystem::path& path);

/// Reads what the deck names, if it names one.
void read_field_map_of(Deck& deck);

}  // namespace treejet
