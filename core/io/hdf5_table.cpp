#include "core/io/hdf5_table.hpp"

#include <fmt/ranges.h>
#include <hdf5.h>

#include <cstring>

namespace treejet::hdf5 {

namespace {

TableBox values_of_one(const Extent& place, const Extent& chunk) {
  return values_of({place, Extent(place.size(), 1)}, chunk);
}

std::size_t count(const TableBox& box) {
  std::size_t values = 1;
  for (const auto n : box.size) values *= n;
  return values;
}

/// A space in memory of the size of a box.
Handle space_of(const TableBox& box, const Checker& check) {
  const std::vector<hsize_t> size(box.size.begin(), box.size.end());
  return {check(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), "space"), H5Sclose};
}

void select(Id space, const TableBox& part, const Checker& check) {
  const std::vector<hsize_t> first(part.first.begin(), part.first.end()),
      size(part.size.begin(), part.size.end());
  check(H5Sselect_hyperslab(space, H5S_SELECT_SET, first.data(), nullptr, size.data(), nullptr), "selection");
}

}  // namespace

Extent extent_of(Id set, const Checker& check) {
  const Handle space(check(H5Dget_space(set), "cannot be opened"), H5Sclose);
  std::vector<hsize_t> now(
      static_cast<std::size_t>(check(H5Sget_simple_extent_ndims(space), "cannot be opened")));
  if (!now.empty()) check(H5Sget_simple_extent_dims(space, now.data(), nullptr), "cannot be opened");
  return {now.begin(), now.end()};
}

template <class T>
void TableReader<T>::read_plain(const TableBox& box, const Extent& chunk, T* values, T absent) const {
  std::vector<TableBox> parts = {box};
  if (!chunk.empty())
    parts = parts_there(
        box, chunk, [&](const Extent& place) { return chunk_bytes(values_of_one(place, chunk).first) > 0; });
  if (parts != std::vector{box}) std::fill_n(values, count(box), absent);
  const Handle space(check_(H5Dget_space(set_), "cannot be read"), H5Sclose);
  const Handle memory = space_of(box, check_);
  for (const TableBox& part : parts) {
    Extent in_memory = part.first;
    for (std::size_t k = 0; k < in_memory.size(); ++k) in_memory[k] -= box.first[k];
    select(space, part, check_);
    select(memory, {in_memory, part.size}, check_);
    check_(H5Dread(set_, type_, memory, space, H5P_DEFAULT, values), "cannot be read");
  }
}

template <class T>
void TableReader<T>::read_filtered(const TableBox& box, const Extent& chunk,
                                   std::span<const ChunkFilter> filters, std::uint64_t length, T* values,
                                   T absent) const {
  const Handle stored(check_(H5Dget_type(set_), "cannot be read"), H5Tclose);
  static_assert(sizeof(T) == sizeof(std::uint64_t), "no number that is stored is wider");
  std::vector<T> numbers;
  std::fill_n(values, count(box), absent);
  for_each_place(chunks_touched_by(box, chunk), [&](const Extent& place) {
    const TableBox own = values_of_one(place, chunk);
    unsigned skipped = 0;
    const std::string bytes = filtered(own.first, skipped);
    if (bytes.empty()) return;
    const auto plain = unfiltered(bytes, filters, skipped, length);
    if (!plain)
      refuse(path_, name_,
             fmt::format("is damaged: its chunk at {} is not {} bytes of values", fmt::join(own.first, ", "),
                         length));
    numbers.resize(length / H5Tget_size(stored));
    std::memcpy(numbers.data(), plain->data(), length);
    check_(H5Tconvert(stored, type_, numbers.size(), numbers.data(), nullptr, H5P_DEFAULT), "cannot be read");
    copy_shared(own, numbers.data(), box, values);
  });
}

template <class T>
std::uint64_t TableReader<T>::chunk_bytes(const Extent& first) const {
  const std::vector<hsize_t> at(first.begin(), first.end());
  hsize_t bytes = 0;
  if (H5Dget_chunk_storage_size(set_, at.data(), &bytes) < 0 && reason() != "chunk storage is not allocated")
    check_(-1, "cannot be read");
  return bytes;
}

template <class T>
std::string TableReader<T>::filtered(const Extent& first, unsigned& skipped) const {
  const std::uint64_t length = chunk_bytes(first);
  if (length == 0) return {};
  std::error_code error;
  if (length > std::filesystem::file_size(path_, error))
    refuse(path_, name_, "is damaged: a chunk is longer than the file");
  std::string bytes(length, '\0');
  const std::vector<hsize_t> at(first.begin(), first.end());
  check_(H5Dread_chunk(set_, H5P_DEFAULT, at.data(), &skipped, bytes.data()), "cannot be read");
  return bytes;
}

template <class T>
void TableWriter<T>::write_plain(const TableBox& box, const T* values) const {
  const Handle place(check_(H5Dget_space(set_), "cannot be opened"), H5Sclose),
      memory = space_of(box, check_);
  select(place, box, check_);
  check_(H5Dwrite(set_, type_, memory, place, H5P_DEFAULT, values), "cannot be written");
}

template <class T>
void TableWriter<T>::write_filtered(const TableBox& box, const Extent& chunk,
                                    std::span<const ChunkFilter> filters, const RowSharing& chunks_shared,
                                    const T* values, T absent) const {
  const Handle stored(check_(H5Dget_type(set_), "cannot be written"), H5Tclose);
  struct Chunk {
    std::vector<hsize_t> first;
    std::string bytes;
  };
  std::vector<Chunk> chunks;
  for_each_place(chunks_touched_by(box, chunk), [&](const Extent& place) {
    const TableBox own = values_of_one(place, chunk);
    std::vector<T> numbers(count(own), absent);
    copy_shared(box, values, own, numbers.data());
    check_(H5Tconvert(type_, stored, numbers.size(), numbers.data(), nullptr, H5P_DEFAULT),
           "cannot be written");
    chunks.push_back({{own.first.begin(), own.first.end()},
                      {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T)}});
  });
  chunks_shared(static_cast<Eigen::Index>(chunks.size()), [&](Eigen::Index first, Eigen::Index count) {
    for (Chunk& c :
         std::span(chunks).subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(count)))
      c.bytes = filtered(std::move(c.bytes), filters);
  });
  for (const Chunk& c : chunks)
    check_(H5Dwrite_chunk(set_, H5P_DEFAULT, 0, c.first.data(), c.bytes.size(), c.bytes.data()),
           "cannot be written");
}

template class TableReader<double>;
template class TableReader<std::int64_t>;
template class TableWriter<double>;
template class TableWriter<std::int64_t>;

}  // namespace treejet::hdf5
