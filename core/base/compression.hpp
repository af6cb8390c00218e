#pragma once
/// Checksums and deflated bytes; compression.cpp is the one place that knows zlib.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace treejet {

/// CRC-32 of bytes that follow others, whose checksum is `before`.
std::uint64_t crc32(std::string_view bytes, std::uint64_t before = 0);

/// What a zlib stream holds; behind its end there may be anything. None if it is damaged, cut short or holds
/// more than `most` bytes, for which no room is made before they come.
std::optional<std::string> inflated(std::string_view stream, std::uint64_t most);

/// A zlib stream of the bytes; the lower the level, 1 to 9, the faster.
std::string deflated(std::string_view bytes, int level);

}  // namespace treejet
