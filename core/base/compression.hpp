#pragma once
/// Checksums and deflated bytes; compression.cpp is the one place that knows zlib.

#include <cstdint>
#include <optional>
#include <string_view>

namespace treejet {

/// CRC-32 of bytes that follow others, whose checksum is `before`.
std::uint64_t crc32(std::string_view bytes, std::uint64_t before = 0);

/// How many bytes a zlib stream holds, without keeping them; what follows its end is not looked at. None if
/// it is damaged, cut short or holds more than `most`.
std::optional<std::uint64_t> inflated_size(std::string_view stream, std::uint64_t most);

}  // namespace treejet
