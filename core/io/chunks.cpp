#include "core/io/chunks.hpp"

#include <algorithm>
#include <stdexcept>

#include "core/base/compression.hpp"

namespace treejet {

namespace {

/// What is left over of the last element stands at the end.
std::string unshuffled(const std::string& bytes, std::uint64_t width) {
  const std::uint64_t elements = bytes.size() / width;
  std::string whole = bytes;
  for (std::uint64_t k = 0; k < width; ++k) {
    const char* from = bytes.data() + k * elements;
    for (std::uint64_t i = 0; i < elements; ++i) whole[i * width + k] = from[i];
  }
  return whole;
}

std::string shuffled(const std::string& whole, std::uint64_t width) {
  const std::uint64_t elements = whole.size() / width;
  std::string bytes = whole;
  for (std::uint64_t k = 0; k < width; ++k) {
    char* to = bytes.data() + k * elements;
    for (std::uint64_t i = 0; i < elements; ++i) to[i] = whole[i * width + k];
  }
  return bytes;
}

/// Fletcher's sums of numbers of two bytes, the first byte the high one, modulo 65535.
std::uint32_t fletcher32(std::string_view bytes) {
  const auto byte = [&](std::size_t k) {
    return k < bytes.size() ? std::uint32_t(static_cast<unsigned char>(bytes[k])) : 0u;
  };
  std::uint32_t sum = 0, sum_of_sums = 0;
  for (std::size_t k = 0; k < bytes.size(); k += 2) {
    sum = (sum + (byte(k) << 8 | byte(k + 1))) % 65535;
    sum_of_sums = (sum_of_sums + sum) % 65535;
  }
  return sum_of_sums << 16 | sum;
}

/// Takes the checksum off; false if it is another one.
bool without_checksum(std::string& bytes) {
  constexpr std::size_t sums = 4;
  if (bytes.size() < sums) return false;
  std::uint32_t found = 0;
  for (std::size_t k = 0; k < sums; ++k)
    found |= std::uint32_t(static_cast<unsigned char>(bytes[bytes.size() - sums + k])) << 8 * k;
  bytes.resize(bytes.size() - sums);
  const std::uint32_t expected = fletcher32(bytes);
  // 0 and 65535 are the same remainder, and either may have been written
  return found % 65536 % 65535 == expected % 65536 && (found >> 16) % 65535 == expected >> 16;
}

}  // namespace

std::optional<std::string> unfiltered(std::string bytes, std::span<const ChunkFilter> filters,
                                      unsigned skipped, std::uint64_t length) {
  constexpr std::uint64_t checksum = 4, most_filters = 32;
  for (std::size_t k = filters.size(); k-- > 0;) {
    if ((skipped >> k & 1) != 0) continue;
    switch (filters[k].kind) {
      case ChunkFilter::Kind::fletcher32:
        if (!without_checksum(bytes)) return {};
        break;
      case ChunkFilter::Kind::deflate: {
        auto whole = inflated(bytes, length + most_filters * checksum);
        if (!whole) return {};
        bytes = *std::move(whole);
        break;
      }
      case ChunkFilter::Kind::shuffle:
        if (filters[k].width == 0) return {};
        if (filters[k].width <= bytes.size()) bytes = unshuffled(bytes, filters[k].width);
        break;
    }
  }
  if (bytes.size() != length) return {};
  return bytes;
}

std::string filtered(std::string bytes, std::span<const ChunkFilter> filters) {
  for (const ChunkFilter& filter : filters) {
    switch (filter.kind) {
      case ChunkFilter::Kind::shuffle:
        bytes = shuffled(bytes, filter.width);
        break;
      case ChunkFilter::Kind::deflate:
        bytes = deflated(bytes, deflate_level);
        break;
      case ChunkFilter::Kind::fletcher32:
        throw std::logic_error("no file is written with checksums of chunks");
    }
  }
  return bytes;
}

TableBox values_of(TableBox chunks, const Extent& chunk) {
  for (std::size_t k = 0; k < chunk.size(); ++k) chunks.first[k] *= chunk[k], chunks.size[k] *= chunk[k];
  return chunks;
}

TableBox shared(const TableBox& a, const TableBox& b) {
  TableBox both = a;
  for (std::size_t k = 0; k < a.first.size(); ++k) {
    const std::uint64_t end = std::min(a.first[k] + a.size[k], b.first[k] + b.size[k]);
    both.first[k] = std::max(a.first[k], b.first[k]);
    both.size[k] = end - std::min(end, both.first[k]);
  }
  return both;
}

TableBox chunks_touched_by(const TableBox& box, const Extent& chunk) {
  TableBox grid = box;
  for (std::size_t k = 0; k < chunk.size(); ++k) {
    grid.first[k] = box.first[k] / chunk[k];
    if (box.size[k] > 0) grid.size[k] = (box.first[k] + box.size[k] - 1) / chunk[k] - grid.first[k] + 1;
  }
  return grid;
}

bool is_of_whole_chunks(const TableBox& box, const Extent& chunk, const Extent& table) {
  for (std::size_t k = 0; k < chunk.size(); ++k) {
    const std::uint64_t end = box.first[k] + box.size[k];
    if (box.first[k] % chunk[k] != 0 || (end % chunk[k] != 0 && end != table[k])) return false;
  }
  return true;
}

namespace {

/// The chunks that a box touches, and of which of them there is something.
class Presence {
 public:
  Presence(const TableBox& box, const Extent& chunk, const std::function<bool(const Extent&)>& there)
      : box_(box), chunk_(chunk), grid_(chunks_touched_by(box, chunk)) {
    for_each_place(grid_, [&](const Extent& place) { there_.push_back(there(place)); });
  }

  std::vector<TableBox> parts() const {
    std::vector<TableBox> found;
    collect(grid_, found);
    return found;
  }

 private:
  /// All of a box of chunks, nothing of it, or each half by itself.
  void collect(const TableBox& chunks, std::vector<TableBox>& found) const {
    std::uint64_t all = 0, some = 0;
    for_each_place(chunks,
                   [&](const Extent& place) { ++all, some += there_[number_in(grid_, place)] ? 1 : 0; });
    if (some == 0) return;
    if (some == all) return found.push_back(shared(box_, values_of(chunks, chunk_)));
    const auto longest = static_cast<std::size_t>(std::max_element(chunks.size.begin(), chunks.size.end()) -
                                                  chunks.size.begin());
    TableBox left = chunks, right = chunks;
    left.size[longest] /= 2;
    right.first[longest] += left.size[longest];
    right.size[longest] -= left.size[longest];
    collect(left, found);
    collect(right, found);
  }

  const TableBox& box_;
  const Extent& chunk_;
  TableBox grid_;
  std::vector<bool> there_;
};

}  // namespace

std::vector<TableBox> parts_there(const TableBox& box, const Extent& chunk,
                                  const std::function<bool(const Extent& place)>& there) {
  return Presence(box, chunk, there).parts();
}

}  // namespace treejet
