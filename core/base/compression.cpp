#include "core/base/compression.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>

namespace treejet {

namespace {

const Bytef* bytes_of(std::string_view text) {
  return reinterpret_cast<const Bytef*>(text.data());
}

}  // namespace

std::uint64_t crc32(std::string_view bytes, std::uint64_t before) {
  return crc32_z(before, bytes_of(bytes), bytes.size());
}

std::optional<std::uint64_t> inflated_size(std::string_view stream, std::uint64_t most) {
  if (stream.size() > std::numeric_limits<uInt>::max()) return {};
  z_stream state{};
  state.next_in = const_cast<Bytef*>(bytes_of(stream));
  state.avail_in = static_cast<uInt>(stream.size());
  if (inflateInit(&state) != Z_OK) return {};
  std::array<Bytef, 1 << 15> passing;  // of the size that zlib looks back over
  int status = Z_OK;
  while (status == Z_OK && state.total_out <= most) {
    state.next_out = passing.data();
    state.avail_out = static_cast<uInt>(passing.size());
    status = inflate(&state, Z_SYNC_FLUSH);
  }
  const std::uint64_t size = state.total_out;
  inflateEnd(&state);
  if (status != Z_STREAM_END || size > most) return {};
  return size;
}

}  // namespace treejet
