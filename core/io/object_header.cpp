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
  Header(const std::filesystem::path& file, const std::string& object)
      : file_(file), object_(object), stream_(file, std::ios::binary) {
    std::error_code error;
    size_ = std::filesystem::file_size(file, error);
    if (error || !stream_) refuse("cannot be read");
  }

  void check(std::uint64_t address) {
    find_first_block(address);
    // a block more than messages tell of is a circle
    constexpr std::size_t most_blocks = 1000;
    for (std::size_t k = 0; k < blocks_.size() && k < most_blocks; ++k)
      look_at_messages(bytes(blocks_[k].at, blocks_[k].length));
    if (!has_layout_) refuse("is no dataset");
    if (chunk_extents_ && (!rank_ || *rank_ + 1 != *chunk_extents_)) damaged();
  }

 private:
  struct Block {
    std::uint64_t at, length;
  };

  [[noreturn]] void refuse(std::string_view why) const {
    throw FileError(fmt::format("{}: {} {}", file_.string(), object_, why));
  }
  [[noreturn]] void damaged() const { refuse("is damaged: its header is none"); }

  std::string bytes(std::uint64_t at, std::uint64_t length) {
    if (at > size_ || length > size_ - at) damaged();
    std::string found(length, '\0');
    stream_.seekg(static_cast<std::streamoff>(at));
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
    constexpr std::uint64_t dataspace = 1, layout = 8, continuation = 16;
    if (kind == dataspace) {
      if (rank_ || elsewhere) damaged();
      rank_ = number(message, 1, 1);
    }
    if (kind == layout) look_at_layout(message);
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
  }

  const std::filesystem::path& file_;
  const std::string& object_;
  std::ifstream stream_;
  std::uint64_t size_ = 0;
  bool new_form_ = false, has_layout_ = false;
  std::size_t message_head_ = 8;
  std::vector<Block> blocks_;
  std::optional<std::uint64_t> rank_, chunk_extents_;
};

}  // namespace

void check_layout(const std::filesystem::path& file, const std::string& object, std::uint64_t address) {
  Header(file, object).check(address);
}

}  // namespace treejet
