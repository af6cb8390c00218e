#include "core/io/object_header.hpp"

#include <fmt/format.h>

#include <fstream>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/error.hpp"

namespace treejet {

namespace {

class Header {
 public:
  Header(const std::filesystem::path& file, const std::string& object, std::uint64_t origin)
      : file_(file), object_(object), stream_(file, std::ios::binary), origin_(origin) {
    std::error_code error;
    size_ = std::filesystem::file_size(file, error);
    if (error || !stream_ || origin > size_) refuse("cannot be read");
    size_ -= origin;
  }

  void check(std::uint64_t address) {
    find_first_block(address);
    // a block more than messages tell of is a circle
    constexpr std::size_t most_blocks = 1000;
    for (std::size_t k = 0; k < blocks_.size() && k < most_blocks; ++k)
      look_at_messages(bytes(blocks_[k].at, blocks_[k].length));
    if (chunk_extents_ && (!rank_ || *rank_ + 1 != *chunk_extents_)) damaged();
  }
  void demand_layout() const {
    if (!has_layout_) refuse("is no dataset");
  }

 private:
  struct Block {
    std::uint64_t at, length;
  };

  [[noreturn]] void refuse(std::string_view why) const {
    throw FileError(fmt::format("{}: {} {}", file_.string(), object_, why));
  }
  [[noreturn]] void damaged() const { refuse("is damaged: its header or what it leads to is none"); }

  std::string bytes(std::uint64_t at, std::uint64_t length) {
    if (at > size_ || length > size_ - at) damaged();
    std::string found(length, '\0');
    stream_.seekg(static_cast<std::streamoff>(origin_ + at));
    stream_.read(found.data(), static_cast<std::streamsize>(length));
    if (!stream_) refuse("cannot be read");
    return found;
  }

  /// Of so many bytes, the lowest first.
  std::uint64_t number(std::string_view text, std::size_t at, std::size_t width) const {
    if (at > text.size() || width > text.size() - at) damaged();
    std::uint64_t value = 0;
    for (std::size_t k = width; k-- > 0;) value = value << 8 | static_cast<unsigned char>(text[at + k]);
    return value;
  }

  void find_first_block(std::uint64_t address) {
    constexpr std::uint64_t longest_prefix = 16, times = 16, phases = 4;
    const std::string begin = bytes(address, longest_prefix);
    if (begin.starts_with("OHDR")) {
      new_form_ = true;
      const std::uint64_t flags = number(begin, 5, 1), width = 1u << (flags & 3);
      message_head_ = (flags & 4) != 0 ? 6 : 4;
      std::uint64_t at = address + 6;
      if ((flags & 0x20) != 0) at += times;
      if ((flags & 0x10) != 0) at += phases;
      blocks_.push_back({at + width, number(bytes(at, width), 0, width)});
    } else {
      if (number(begin, 0, 1) != 1) damaged();
      blocks_.push_back({address + longest_prefix, number(begin, 8, 4)});
    }
  }

  void look_at_messages(std::string_view block) {
    while (block.size() >= message_head_) {  // what is less is a gap
      const std::size_t width = new_form_ ? 1 : 2;
      const std::uint64_t kind = number(block, 0, width), length = number(block, width, 2);
      if (length > block.size() - message_head_) damaged();
      const bool elsewhere = (number(block, width + 2, 1) & 2) != 0;
      look_at(kind, block.substr(message_head_, length), elsewhere);
      block.remove_prefix(message_head_ + length);
    }
  }

  void look_at(std::uint64_t kind, std::string_view message, bool elsewhere) {
    constexpr std::uint64_t dataspace = 1, layout = 8, continuation = 16, symbol_table = 17;
    if (kind == dataspace) {
      if (rank_ || elsewhere) damaged();
      rank_ = number(message, 1, 1);
    }
    if (kind == layout) look_at_layout(message);
    if (kind == symbol_table) {
      look_at_tree({number(message, 0, 8), 0, std::nullopt});
      look_at_heap(number(message, 8, 8));
    }
    if (kind != continuation) return;
    Block next{number(message, 0, 8), number(message, 8, 8)};
    constexpr std::uint64_t signature = 4, checksum = 4;
    if (new_form_ && next.length < signature + checksum) damaged();
    if (new_form_) next = {next.at + signature, next.length - signature - checksum};
    blocks_.push_back(next);
  }

  void look_at_layout(std::string_view message) {
    constexpr std::uint64_t usual = 3, newest = 4, chunked = 2, in_other_files = 3;
    const std::uint64_t version = number(message, 0, 1), kind = number(message, 1, 1);
    if (std::exchange(has_layout_, true)) damaged();
    if (version == newest && kind == in_other_files) refuse("has its values in another file");
    if (version != usual && (version != newest || kind >= chunked))
      refuse(
          "is laid out in a form that not every version of HDF5 knows (rewrite it with: h5repack OLD NEW)");
    if (kind != chunked) return;
    chunk_extents_ = number(message, 2, 1);
    for (std::size_t k = 0; k < *chunk_extents_; ++k)
      if (number(message, 11 + 4 * k, 4) == 0) refuse("is damaged: has chunks without extent");
    if (const std::uint64_t tree = number(message, 3, 8); tree != nowhere)
      look_at_tree({tree, 8 + 8 * *chunk_extents_, std::nullopt});
  }

  /// A node of a B-tree of version 1: the length of what stands between its children, 0 for names of a group,
  /// and its level, if that has been told.
  struct Node {
    std::uint64_t at, key;
    std::optional<std::uint64_t> level;
  };

  /// That each node leads to others in the file, of the level below.
  void look_at_tree(const Node& root) {
    constexpr std::uint64_t head = 24, child = 8;
    const bool of_names = root.key == 0;
    const std::uint64_t key = of_names ? 8 : root.key;
    std::vector<Node> nodes = {root};
    for (std::uint64_t seen = 0; !nodes.empty(); ++seen) {
      const Node node = nodes.back();
      nodes.pop_back();
      // more than there is room for are seen only where two lead to the same
      if (seen + nodes.size() > size_ / head) damaged();
      const std::string begin = bytes(node.at, head);
      const std::uint64_t level = number(begin, 5, 1), children = number(begin, 6, 2);
      if (!begin.starts_with("TREE") || (number(begin, 4, 1) == 0) != of_names) damaged();
      if (node.level && level != *node.level) damaged();
      const std::string all = bytes(node.at + head, children * (key + child));
      for (std::uint64_t k = 0; k < children; ++k) {
        const std::uint64_t at = number(all, k * (key + child) + key, child);
        if (level > 0)
          nodes.push_back({at, root.key, level - 1});
        else if (of_names && bytes(at, 4) != "SNOD")
          damaged();
      }
    }
  }

  /// The names of a group's members, and between them gaps, each of which leads to the next.
  void look_at_heap(std::uint64_t address) {
    constexpr std::uint64_t gap = 16, no_more = 1;
    const std::string heap = bytes(address, 32);
    const std::uint64_t length = number(heap, 8, 8), at = number(heap, 24, 8);
    if (!heap.starts_with("HEAP") || at > size_ || length > size_ - at) damaged();
    std::uint64_t next = number(heap, 16, 8);
    for (std::uint64_t seen = 0; next != no_more; ++seen) {
      // more than there is room for are seen only in a circle
      if (seen > length / gap || length < gap || next > length - gap) damaged();
      next = number(bytes(at + next, gap), 0, 8);
    }
  }

  static constexpr std::uint64_t nowhere = ~std::uint64_t{0};
  const std::filesystem::path& file_;
  const std::string& object_;
  std::ifstream stream_;
  std::uint64_t origin_, size_ = 0;  ///< what stands before addresses count, and behind that
  bool new_form_ = false, has_layout_ = false;
  std::size_t message_head_ = 8;
  std::vector<Block> blocks_;
  std::optional<std::uint64_t> rank_, chunk_extents_;
};

}  // namespace

void check_dataset(const std::filesystem::path& file, const std::string& object, const HeaderPlace& place) {
  Header header(file, object, place.origin);
  header.check(place.address);
  header.demand_layout();
}

void check_group(const std::filesystem::path& file, const std::string& object, const HeaderPlace& place) {
  Header(file, object, place.origin).check(place.address);
}

}  // namespace treejet
