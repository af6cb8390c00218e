#include "core/base/compression.hpp"

#include <zlib.h>

#include <algorithm>
#include <limits>
#include <new>

namespace treejet {

namespace {

const Bytef* bytes_of(std::string_view text) {
  return reinterpret_cast<const Bytef*>(text.data());
}

}  // namespace

std::uint64_t crc32(std::string_view bytes, std::uint64_t before) {
  return crc32_z(before, bytes_of(bytes), bytes.size());
}

std::optional<std::string> inflated(std::string_view stream, std::uint64_t most) {
  if (stream.size() > std::numeric_limits<uInt>::max()) return {};
  z_stream state{};
  state.next_in = const_cast<Bytef*>(bytes_of(stream));
  state.avail_in = static_cast<uInt>(stream.size());
  if (inflateInit(&state) != Z_OK) return {};
  // few are shrunk further, and one byte more than there may be shows that there are more
  constexpr std::uint64_t usual = 16;
  std::string found(std::min(most + 1, usual * stream.size()), '\0');
  int status = Z_OK;
  while (status == Z_OK && state.total_out <= most) {
    if (found.size() == state.total_out) found.resize(std::min<std::uint64_t>(most + 1, 2 * found.size()));
    state.next_out = reinterpret_cast<Bytef*>(found.data()) + state.total_out;
    state.avail_out = static_cast<uInt>(
        std::min<std::uint64_t>(found.size() - state.total_out, std::numeric_limits<uInt>::max()));
    status = inflate(&state, Z_SYNC_FLUSH);
  }
  found.resize(state.total_out);
  inflateEnd(&state);
  if (status != Z_STREAM_END || found.size() > most) return {};
  return found;
}

std::string deflated(std::string_view bytes, int level) {
  uLongf length = compressBound(bytes.size());
  std::string stream(length, '\0');
  if (compress2(reinterpret_cast<Bytef*>(stream.data()), &length, bytes_of(bytes), bytes.size(), level) !=
      Z_OK)
    throw std::bad_alloc();  // there is room for any bytes
  stream.resize(length);
  return stream;
}

}  // namespace treejet
