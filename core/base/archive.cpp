#include "core/base/archive.hpp"

#include <cstring>

#include "core/base/error.hpp"

namespace treejet {

namespace {
[[noreturn]] void other_layout() {
  throw FileError("the state has another layout than this program's: it was written by another version");
}
}  // namespace

void Archive::block(void* data, std::size_t size) {
  if (!reading()) {
    take_({reinterpret_cast<const char*>(&size), sizeof size});
    if (size > 0) take_({static_cast<const char*>(data), size});
    return;
  }
  std::size_t found = 0;
  if (source_->size() - at_ < sizeof found) other_layout();
  std::memcpy(&found, source_->data() + at_, sizeof found);
  at_ += sizeof found;
  if (found != size || source_->size() - at_ < size) other_layout();
  if (size > 0) std::memcpy(data, source_->data() + at_, size);
  at_ += size;
}

void Archive::truth(bool& value) {
  unsigned char byte = value ? 1 : 0;
  block(&byte, sizeof byte);
  if (byte > 1) other_layout();
  value = byte == 1;
}

std::size_t Archive::counted(std::size_t count, std::size_t size) {
  block(&count, sizeof count);
  // a count that cannot be true must not become an allocation, nor rows of no columns
  const std::size_t most = !reading() ? count : size > 0 ? (source_->size() - at_) / size : source_->size();
  if (count > most) other_layout();
  return count;
}

std::int64_t Archive::counted_columns(std::int64_t count) {
  constexpr std::int64_t most = 1024;
  block(&count, sizeof count);
  if (count < 0 || count > most) other_layout();
  return count;
}

void Archive::expect_end() const {
  if (at_ != source_->size()) other_layout();
}

}  // namespace treejet
