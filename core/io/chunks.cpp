#include "core/io/chunks.hpp"

#include <algorithm>

#include "core/base/compression.hpp"

namespace treejet {

std::optional<std::uint64_t> unfiltered_length(std::string_view bytes, std::span<const ChunkFilter> filters,
                                               unsigned skipped, std::uint64_t most) {
  constexpr std::uint64_t fletcher = 4;
  std::uint64_t length = bytes.size();
  bool as_stored = true;
  for (std::size_t k = filters.size(); k-- > 0;) {
    if ((skipped >> k & 1) != 0) continue;
    switch (filters[k]) {
      case ChunkFilter::fletcher32:
        if (length < fletcher) return {};
        length -= fletcher;
        break;
      case ChunkFilter::deflate: {
        if (!as_stored) return {};
        const auto inflated = inflated_size(bytes.substr(0, length), most + fletcher);
        if (!inflated) return {};
        length = *inflated;
        as_stored = false;
        break;
      }
      case ChunkFilter::shuffle:
        as_stored = false;
        break;
    }
  }
  if (length > most) return {};
  return length;
}

namespace {

/// Calls `act` with each place in a box, in the order of rows.
template <class Act>
void for_each_place(const TableBox& box, Act act) {
  if (std::find(box.size.begin(), box.size.end(), 0) != box.size.end()) return;
  Extent place = box.first;
  for (std::size_t k = place.size(); k > 0;) {
    act(place);
    for (k = place.size(); k > 0; --k) {
      if (++place[k - 1] < box.first[k - 1] + box.size[k - 1]) break;
      place[k - 1] = box.first[k - 1];
    }
  }
}

/// The chunks that a box touches, and of which of them there is something.
class Presence {
 public:
  Presence(const TableBox& box, const Extent& chunk, const std::function<bool(const Extent&)>& there)
      : box_(box), chunk_(chunk), grid_(box) {
    for (std::size_t k = 0; k < chunk.size(); ++k) {
      grid_.first[k] = box.first[k] / chunk[k];
      if (box.size[k] > 0) grid_.size[k] = (box.first[k] + box.size[k] - 1) / chunk[k] - grid_.first[k] + 1;
    }
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
    for_each_place(chunks, [&](const Extent& place) { ++all, some += at(place) ? 1 : 0; });
    if (some == 0) return;
    if (some == all) return found.push_back(values_of(chunks));
    const auto longest = static_cast<std::size_t>(std::max_element(chunks.size.begin(), chunks.size.end()) -
                                                  chunks.size.begin());
    TableBox left = chunks, right = chunks;
    left.size[longest] /= 2;
    right.first[longest] += left.size[longest];
    right.size[longest] -= left.size[longest];
    collect(left, found);
    collect(right, found);
  }

  bool at(const Extent& place) const {
    std::uint64_t index = 0;
    for (std::size_t k = 0; k < place.size(); ++k) index = index * grid_.size[k] + place[k] - grid_.first[k];
    return there_[index];
  }

  TableBox values_of(const TableBox& chunks) const {
    TableBox values = box_;
    for (std::size_t k = 0; k < chunk_.size(); ++k) {
      const std::uint64_t begin = std::max(box_.first[k], chunks.first[k] * chunk_[k]),
                          end = std::min(box_.first[k] + box_.size[k],
                                         (chunks.first[k] + chunks.size[k]) * chunk_[k]);
      values.first[k] = begin;
      values.size[k] = end - begin;
    }
    return values;
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
