#include <fmt/format.h>
#include <fmt/ranges.h>
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#include "core/io/hdf5_file.hpp"
#include "core/io/hdf5_handle.hpp"
#include "core/io/hdf5_table.hpp"

namespace treejet {

using namespace hdf5;

namespace {

std::string without_padding(std::string text) {
  text.resize(std::min(text.find('\0'), text.size()));
  return text;
}

/// Of the group that all names begin at, whatever the library's version calls the record that holds it.
template <class Record>
std::uint64_t address_of_root(herr_t (*record_of)(hid_t, Record*, unsigned), hid_t file,
                              const Checker& check) {
  Record record;
  check(record_of(file, &record, H5O_INFO_BASIC), "cannot be read");
  return record.addr;
}

/// A number up to HDF5 1.10, from 1.12 on its bytes in a token.
std::uint64_t address_of(const H5L_info_t& link) {
  std::uint64_t address = 0;
  std::memcpy(&address, &link.u, sizeof address);
  return address;
}

HeaderPlace root_of(hid_t file, const std::filesystem::path& path) {
  const Checker check(path, "");
  const Handle form(check(H5Fget_create_plist(file), "cannot be read"), H5Pclose);
  std::size_t address = 0, length = 0;
  hsize_t origin = 0;
  check(H5Pget_sizes(form, &address, &length), "cannot be read");
  check(H5Pget_userblock(form, &origin), "cannot be read");
  if (address != sizeof(std::uint64_t) || length != address) refuse(path, "", "not addressed by eight bytes");
  return {origin, address_of_root(H5Oget_info2, file, check)};
}

/// A dataset opened without a cache for chunks: into one HDF5 reads as many bytes as the file says that a
/// chunk has, and without one it goes by the extent, where there are no filters.
hid_t opened_to_read(hid_t file, const std::string& name) {
  const Handle list(H5Pcreate(H5P_DATASET_ACCESS), H5Pclose);
  H5Pset_chunk_cache(list, 0, 0, H5D_CHUNK_CACHE_W0_DEFAULT);
  return H5Dopen2(file, name.c_str(), list);
}

bool holds_numbers(hid_t type) {
  const std::array<hid_t, 20> known = {H5T_IEEE_F64LE, H5T_STD_I64LE, H5T_IEEE_F32LE, H5T_IEEE_F64BE,
                                       H5T_IEEE_F32BE, H5T_STD_I8LE,  H5T_STD_I16LE,  H5T_STD_I32LE,
                                       H5T_STD_I8BE,   H5T_STD_I16BE, H5T_STD_I32BE,  H5T_STD_I64BE,
                                       H5T_STD_U8LE,   H5T_STD_U16LE, H5T_STD_U32LE,  H5T_STD_U64LE,
                                       H5T_STD_U8BE,   H5T_STD_U16BE, H5T_STD_U32BE,  H5T_STD_U64BE};
  return std::any_of(known.begin(), known.end(), [&](hid_t one) { return H5Tequal(type, one) > 0; });
}

/// Those that chunks have gone through. Any other is unknown here, and HDF5 would look for a program that
/// undoes it.
std::vector<ChunkFilter> filters_of(hid_t content, const std::filesystem::path& path,
                                    std::string_view object) {
  std::vector<ChunkFilter> filters;
  const int count = Checker(path, object)(H5Pget_nfilters(content), "cannot be read");
  for (unsigned k = 0; k < static_cast<unsigned>(count); ++k) {
    unsigned flags = 0, width = 0;
    std::size_t numbers = 1;
    using Kind = ChunkFilter::Kind;
    switch (H5Pget_filter2(content, k, &flags, &numbers, &width, 0, nullptr, nullptr)) {
      case H5Z_FILTER_SHUFFLE:
        filters.push_back({Kind::shuffle, width});
        break;
      case H5Z_FILTER_DEFLATE:
        filters.push_back({Kind::deflate});
        break;
      case H5Z_FILTER_FLETCHER32:
        filters.push_back({Kind::fletcher32});
        break;
      default:
        refuse(path, object, "is compressed otherwise than by shuffle and deflate (gzip)");
    }
  }
  return filters;
}

double volume(const Extent& size) {
  double values = 1;
  for (const auto n : size) values *= static_cast<double>(n);
  return values;
}

/// The size of the one text of fixed length that is there, of `stored` bytes in the file.
std::size_t text_size(hid_t type, hid_t space, hsize_t stored, const std::filesystem::path& path,
                      std::string_view object) {
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0 ||
      H5Sget_simple_extent_npoints(space) != 1)
    refuse(path, object, "is not one text of fixed length");
  const std::size_t size = H5Tget_size(type);
  if (size > stored) refuse(path, object, fmt::format("has {} bytes, of which {} are stored", size, stored));
  return size;
}

/// Whether so many values can be what the stored bytes tell: deflate shrinks by a factor of 1032 at the most.
bool plausible(const Extent& extent, hsize_t stored) {
  constexpr double most_deflated = 1032, value = 8;
  const bool rows_only = extent.size() == 1;
  double bytes = value;  // of a row, which is written as a whole
  for (std::size_t k = rows_only ? 0 : 1; k < extent.size(); ++k) bytes *= static_cast<double>(extent[k]);
  return extent[0] == 0 || bytes <= most_deflated * static_cast<double>(stored);
}

}  // namespace

/// Where an object's header is, if there is one of that name. All of its name must be hard links: soft and
/// external ones lead elsewhere, as far as any file that the user may read.
std::optional<HeaderPlace> Hdf5File::find(const std::string& name) const {
  const Checker check(path_, name);
  if (!root_) root_ = root_of(file_, path_);
  HeaderPlace place = *root_;
  std::string above = "/";
  for (auto end = name.find('/', 1);; end = name.find('/', end + 1)) {
    // what is being written need not be in the file yet
    if (access_ == Access::read && !groups_.contains(above)) check_group(path_, above, place);
    groups_.insert(above);
    above = name.substr(0, end);
    if (check(H5Lexists(file_, above.c_str(), H5P_DEFAULT), "cannot be read") == 0) return {};
    H5L_info_t link;
    check(H5Lget_info(file_, above.c_str(), &link, H5P_DEFAULT), "cannot be read");
    if (link.type != H5L_TYPE_HARD) refuse(path_, name, "is a link that may lead out of the file");
    place.address = address_of(link);
    if (end == std::string::npos) return place;
  }
}

bool Hdf5File::has(const std::string& name) const {
  return find(name).has_value();
}

/// A dataset whose values are in this very file. External raw data are elsewhere, and Treejet writes none.
Hdf5File::Id Hdf5File::open(const std::string& dataset) const {
  const Checker check(path_, dataset);
  if (!stored_.contains(dataset)) {
    const auto place = find(dataset);
    if (!place) refuse(path_, dataset, "is not there");
    if (access_ == Access::read) check_dataset(path_, dataset, *place);
  }
  Handle set(check(opened_to_read(file_, dataset), "cannot be read"), H5Dclose);
  const Handle content(check(H5Dget_create_plist(set), "cannot be read"), H5Pclose);
  if (H5Pget_external_count(content) != 0 || H5Pget_layout(content) == H5D_VIRTUAL)
    refuse(path_, dataset, "has its values in another file");
  return set.release();
}

const Hdf5File::Stored& Hdf5File::stored(const std::string& dataset, Id set) const {
  if (const auto known = stored_.find(dataset); known != stored_.end()) return known->second;
  const Checker check(path_, dataset);
  const Handle type(check(H5Dget_type(set), "cannot be read"), H5Tclose),
      content(check(H5Dget_create_plist(set), "cannot be read"), H5Pclose);
  if (!holds_numbers(type)) refuse(path_, dataset, "does not hold numbers");
  const Extent size = extent_of(set, check);
  if (size.empty()) refuse(path_, dataset, "is one value, not a table");
  const double value_bytes = static_cast<double>(H5Tget_size(type));
  Stored found;
  if (H5Pget_layout(content) == H5D_CHUNKED) {
    std::vector<hsize_t> chunk(size.size());
    const int rank = static_cast<int>(size.size());
    if (H5Pget_chunk(content, rank, chunk.data()) != rank)
      refuse(path_, dataset, "has chunks of another rank");
    const double bytes = volume({chunk.begin(), chunk.end()}) * value_bytes;
    if (!(bytes > 0 && bytes <= std::numeric_limits<std::uint32_t>::max()))
      refuse(path_, dataset, "has chunks of a size that HDF5 cannot have made");
    found = {
        {chunk.begin(), chunk.end()}, filters_of(content, path_, dataset), static_cast<std::uint64_t>(bytes)};
  } else if (const hsize_t bytes = H5Dget_storage_size(set);
             volume(size) * value_bytes > static_cast<double>(bytes)) {
    refuse(path_, dataset,
           fmt::format("claims {} values, but {} bytes are stored", fmt::join(size, " x "), bytes));
  }
  return stored_.emplace(dataset, std::move(found)).first->second;
}

Extent Hdf5File::extent(const std::string& dataset) const {
  const Handle set(open(dataset), H5Dclose);
  const bool in_chunks = !stored(dataset, set).chunk.empty();
  const Extent extent = extent_of(set, Checker(path_, dataset));
  if (const hsize_t bytes = H5Dget_storage_size(set); in_chunks && !plausible(extent, bytes))
    refuse(path_, dataset,
           fmt::format("claims {} values, but {} bytes are stored", fmt::join(extent, " x "), bytes));
  return extent;
}

std::string Hdf5File::text(const std::string& dataset) const {
  const Checker check(path_, dataset);
  const Handle set(open(dataset), H5Dclose);
  const Handle type(check(H5Dget_type(set), "cannot be read"), H5Tclose),
      space(check(H5Dget_space(set), "cannot be read"), H5Sclose),
      content(check(H5Dget_create_plist(set), "cannot be read"), H5Pclose);
  if (H5Pget_layout(content) == H5D_CHUNKED) refuse(path_, dataset, "is not one text of fixed length");
  std::string value(text_size(type, space, H5Dget_storage_size(set), path_, dataset), '\0');
  check(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data()), "cannot be read");
  return without_padding(value);
}

std::string Hdf5File::text_attribute(const std::string& object, const std::string& name) const {
  const Checker check(path_, object);
  if (!has(object)) refuse(path_, object, "is not there");
  const Handle a(check(H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                       "attribute cannot be read"),
                 H5Aclose);
  const Handle type(check(H5Aget_type(a), "attribute cannot be read"), H5Tclose),
      space(check(H5Aget_space(a), "attribute cannot be read"), H5Sclose);
  std::string value(text_size(type, space, H5Aget_storage_size(a), path_, object), '\0');
  check(H5Aread(a, type, value.data()), "attribute cannot be read");
  return without_padding(value);
}

template <class T>
void Hdf5File::read(const std::string& dataset, const Box& box, Id type, T* values, T absent) const {
  const Handle set(open(dataset), H5Dclose);
  const Stored& form = stored(dataset, set);
  const TableReader<T> reader(path_, dataset, set, type);
  if (form.filters.empty())
    reader.read_plain(box, form.chunk, values, absent);
  else
    reader.read_filtered(box, form.chunk, form.filters, form.chunk_bytes, values, absent);
}

void Hdf5File::read(const std::string& dataset, const Box& box, double* values) const {
  read(dataset, box, H5T_NATIVE_DOUBLE, values, std::numeric_limits<double>::quiet_NaN());
}
void Hdf5File::read(const std::string& dataset, const Box& box, std::int64_t* values) const {
  read(dataset, box, H5T_NATIVE_INT64, values, std::int64_t{-1});
}

}  // namespace treejet
