#include "core/io/hdf5_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>
#include <span>
#include <utility>

#include "core/base/error.hpp"

namespace treejet {

static_assert(std::is_same_v<hid_t, std::int64_t> || sizeof(hid_t) == sizeof(std::int64_t));

namespace {

/// The library, set up once before anything else calls it: whichever call is the first starts it, and after
/// that it can no longer be told to leave the end of the program alone. A file that could not be closed must
/// not be tried again there.
void start_library() {
  static const bool once = [] {
    H5dont_atexit();
    H5open();
    return H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr) >= 0;
  }();
  static_cast<void>(once);
}

/// The innermost reason on HDF5's stack of errors, where the operating system gave one: its words only, as
/// HDF5 adds the clock and the addresses of its buffers.
std::string reason() {
  std::string text;
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_UPWARD,
      [](unsigned, const H5E_error2_t* error, void* to) -> herr_t {
        auto& all = *static_cast<std::string*>(to);
        if (all.empty() && error->desc) all = error->desc;
        return 0;
      },
      &text);
  constexpr std::string_view opens = "error message = '";
  if (const auto begin = text.find(opens); begin != std::string::npos) {
    text.erase(0, begin + opens.size());
    text.resize(std::min(text.find('\''), text.size()));
  }
  return text;
}

/// A handle of the library, closed when it goes.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);

  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }

  operator hid_t() const { return id_; }  // NOLINT: so that it goes wherever the library takes a handle
  hid_t release() { return std::exchange(id_, -1); }

 private:
  hid_t id_;
  Close close_;
};

/// Says what fails, if something does.
class Checker {
 public:
  Checker(const std::filesystem::path& path, std::string_view object) : path_(path), object_(object) {}

  template <class Result>
  Result operator()(Result result, const char* what) const {
    if (result < 0)
      throw FileError(
          fmt::format("{}: {}{}{}: {}", path_.string(), object_, object_.empty() ? "" : " ", what, reason()));
    return result;
  }

 private:
  const std::filesystem::path& path_;
  std::string_view object_;
};

Handle text_type(std::size_t size, H5T_cset_t letters = H5T_CSET_UTF8) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, size);
  H5Tset_cset(type, letters);
  return type;
}

Handle makes_groups() {
  Handle list(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(list, 1);
  return list;
}

Handle without_times(hid_t what) {
  Handle list(H5Pcreate(what), H5Pclose);
  H5Pset_obj_track_times(list, false);
  return list;
}

hid_t on_disk(Hdf5File::Number number) {
  return number == Hdf5File::Number::real ? H5T_IEEE_F64LE : H5T_STD_I64LE;
}

std::string without_padding(std::string text) {
  text.resize(std::min(text.find('\0'), text.size()));
  return text;
}

[[noreturn]] void refuse(const std::filesystem::path& path, std::string_view object, std::string_view why) {
  throw FileError(fmt::format("{}: {} {}", path.string(), object, why));
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

double volume(const std::vector<hsize_t>& size) {
  double values = 1;
  for (const hsize_t n : size) values *= static_cast<double>(n);
  return values;
}

std::vector<hsize_t> size_of(hid_t set, const Checker& check) {
  const Handle space(check(H5Dget_space(set), "cannot be read"), H5Sclose);
  std::vector<hsize_t> now(
      static_cast<std::size_t>(check(H5Sget_simple_extent_ndims(space), "cannot be read")));
  if (!now.empty()) check(H5Sget_simple_extent_dims(space, now.data(), nullptr), "cannot be read");
  return now;
}

/// A dataset whose form has been found good, read as numbers of one type.
template <class T>
class TableReader {
 public:
  TableReader(const std::filesystem::path& path, const std::string& name, hid_t set, hid_t type)
      : path_(path), name_(name), set_(set), type_(type), check_(path, name) {}

  /// In one piece, if there are no chunks.
  void read_plain(const TableBox& box, const Extent& chunk, T* values, T absent) const {
    std::vector<TableBox> parts = {box};
    if (!chunk.empty())
      parts = parts_there(box, chunk,
                          [&](const Extent& place) { return chunk_bytes(box_of(place, chunk).first) > 0; });
    const std::vector<hsize_t> size(box.size.begin(), box.size.end());
    if (parts != std::vector{box}) std::fill_n(values, static_cast<std::size_t>(volume(size)), absent);
    const Handle space(check_(H5Dget_space(set_), "cannot be read"), H5Sclose);
    const Handle memory(
        check_(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), "space"), H5Sclose);
    for (const TableBox& part : parts) {
      Extent in_memory = part.first;
      for (std::size_t k = 0; k < in_memory.size(); ++k) in_memory[k] -= box.first[k];
      select(space, part);
      select(memory, {in_memory, part.size});
      check_(H5Dread(set_, type_, memory, space, H5P_DEFAULT, values), "cannot be read");
    }
  }

  void read_filtered(const TableBox& box, const Extent& chunk, std::span<const ChunkFilter> filters,
                     std::uint64_t length, T* values, T absent) const {
    const Handle stored(check_(H5Dget_type(set_), "cannot be read"), H5Tclose);
    static_assert(sizeof(T) == sizeof(std::uint64_t), "no number that is stored is wider");
    std::vector<T> numbers;
    std::fill_n(values, static_cast<std::size_t>(volume({box.size.begin(), box.size.end()})), absent);
    for_each_place(chunks_touched_by(box, chunk), [&](const Extent& place) {
      const TableBox own = box_of(place, chunk);
      unsigned skipped = 0;
      const std::string bytes = filtered(own.first, skipped);
      if (bytes.empty()) return;
      const auto plain = unfiltered(bytes, filters, skipped, length);
      if (!plain)
        refuse(path_, name_,
               fmt::format("is damaged: its chunk at {} is not {} bytes of values",
                           fmt::join(own.first, ", "), length));
      numbers.resize(length / H5Tget_size(stored));
      std::memcpy(numbers.data(), plain->data(), length);
      check_(H5Tconvert(stored, type_, numbers.size(), numbers.data(), nullptr, H5P_DEFAULT),
             "cannot be read");
      copy_shared(own, numbers.data(), box, values);
    });
  }

 private:
  static TableBox box_of(const Extent& place, const Extent& chunk) {
    Extent first = place;
    for (std::size_t k = 0; k < first.size(); ++k) first[k] *= chunk[k];
    return {first, chunk};
  }

  void select(hid_t space, const TableBox& part) const {
    const std::vector<hsize_t> first(part.first.begin(), part.first.end()),
        size(part.size.begin(), part.size.end());
    check_(H5Sselect_hyperslab(space, H5S_SELECT_SET, first.data(), nullptr, size.data(), nullptr),
           "selection");
  }

  /// 0 if the chunk is not there.
  hsize_t chunk_bytes(const Extent& first) const {
    const std::vector<hsize_t> at(first.begin(), first.end());
    hsize_t bytes = 0;
    if (H5Dget_chunk_storage_size(set_, at.data(), &bytes) < 0 &&
        reason() != "chunk storage is not allocated")
      check_(-1, "cannot be read");
    return bytes;
  }

  /// As it is in the file, and which filters it has not been through; empty if it is not there.
  std::string filtered(const Extent& first, unsigned& skipped) const {
    const hsize_t length = chunk_bytes(first);
    if (length == 0) return {};
    std::error_code error;
    if (length > std::filesystem::file_size(path_, error))
      refuse(path_, name_, "is damaged: a chunk is longer than the file");
    std::string bytes(length, '\0');
    const std::vector<hsize_t> at(first.begin(), first.end());
    check_(H5Dread_chunk(set_, H5P_DEFAULT, at.data(), &skipped, bytes.data()), "cannot be read");
    return bytes;
  }

  const std::filesystem::path& path_;
  const std::string& name_;
  hid_t set_, type_;
  Checker check_;
};

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

Hdf5File::Hdf5File(std::filesystem::path path, Access access) : path_(std::move(path)), access_(access) {
  start_library();
  const Checker check(path_, "");
  const Handle how(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // lock the file where the system can, so that it is not changed under a reader
  check(H5Pset_file_locking(how, true, true), "cannot be opened");
  const Handle content = without_times(H5P_FILE_CREATE);
  const std::string name = path_.string();
  switch (access) {
    case Access::create:
      file_ = check(H5Fcreate(name.c_str(), H5F_ACC_TRUNC, content, how), "cannot be made");
      break;
    case Access::append:
      file_ = check(H5Fopen(name.c_str(), H5F_ACC_RDWR, how), "cannot be opened");
      break;
    case Access::read:
      file_ = check(H5Fopen(name.c_str(), H5F_ACC_RDONLY, how), "cannot be read");
      break;
  }
}

Hdf5File::~Hdf5File() {
  if (file_ >= 0) H5Fclose(file_);
}

void Hdf5File::close() {
  const Checker check(path_, "");
  check(H5Fflush(file_, H5F_SCOPE_GLOBAL), "cannot be written");
  check(H5Fclose(std::exchange(file_, -1)), "cannot be written");
}

void Hdf5File::group(const std::string& name) {
  const Handle group(Checker(path_, name)(H5Gcreate2(file_, name.c_str(), makes_groups(),
                                                     without_times(H5P_GROUP_CREATE), H5P_DEFAULT),
                                          "cannot be made"),
                     H5Gclose);
}

void Hdf5File::dataset(const std::string& name, const Layout& layout) {
  const Checker check(path_, name);
  const int rank = static_cast<int>(layout.extent.size());
  const std::vector<hsize_t> now(layout.extent.begin(), layout.extent.end()),
      chunk(layout.chunk.begin(), layout.chunk.end()), no_limit(now.size(), H5S_UNLIMITED);
  const Handle space(check(H5Screate_simple(rank, now.data(), no_limit.data()), "space"), H5Sclose);
  const Handle content = without_times(H5P_DATASET_CREATE);
  check(H5Pset_chunk(content, rank, chunk.data()), "chunk");
  check(H5Pset_fill_value(content, H5T_NATIVE_DOUBLE, &layout.fill), "fill value");
  if (layout.compressed) {
    constexpr unsigned level = 1;  // higher ones gain a hundredth on trajectories
    check(H5Pset_shuffle(content), "shuffle filter");
    check(H5Pset_deflate(content, level), "deflate filter");
  }
  const Handle set(check(H5Dcreate2(file_, name.c_str(), on_disk(layout.number), space, makes_groups(),
                                    content, H5P_DEFAULT),
                         "cannot be made"),
                   H5Dclose);
}

void Hdf5File::text(const std::string& name, const std::string& value) {
  const Checker check(path_, name);
  const Handle type = text_type(std::max<std::size_t>(value.size(), 1)),
               space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle set(check(H5Dcreate2(file_, name.c_str(), type, space, makes_groups(),
                                    without_times(H5P_DATASET_CREATE), H5P_DEFAULT),
                         "cannot be made"),
                   H5Dclose);
  check(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value.c_str()), "cannot be written");
}

void Hdf5File::link(const std::string& existing, const std::string& name) {
  Checker(path_, name)(
      H5Lcreate_hard(file_, existing.c_str(), H5L_SAME_LOC, name.c_str(), makes_groups(), H5P_DEFAULT),
      "cannot be linked");
}

void Hdf5File::attribute(const std::string& object, const std::string& name, const std::string& value) {
  const Checker check(path_, object);
  const Handle type = text_type(std::max<std::size_t>(value.size(), 1)),
               space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle a(check(H5Acreate_by_name(file_, object.c_str(), name.c_str(), type, space, H5P_DEFAULT,
                                         H5P_DEFAULT, H5P_DEFAULT),
                       "attribute"),
                 H5Aclose);
  check(H5Awrite(a, type, value.c_str()), "attribute");
}

void Hdf5File::attribute(const std::string& object, const std::string& name,
                         const std::vector<std::string>& values) {
  const Checker check(path_, object);
  std::size_t longest = 1;
  for (const auto& v : values) longest = std::max(longest, v.size());
  std::string padded;
  for (const auto& v : values) padded += v + std::string(longest - v.size(), '\0');
  const hsize_t count = values.size();
  const Handle type = text_type(longest), space(H5Screate_simple(1, &count, nullptr), H5Sclose);
  const Handle a(check(H5Acreate_by_name(file_, object.c_str(), name.c_str(), type, space, H5P_DEFAULT,
                                         H5P_DEFAULT, H5P_DEFAULT),
                       "attribute"),
                 H5Aclose);
  check(H5Awrite(a, type, padded.data()), "attribute");
}

void Hdf5File::attribute(const std::string& object, const std::string& name, const std::vector<int>& values) {
  const Checker check(path_, object);
  const hsize_t count = values.size();
  const Handle space(values.size() == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr),
                     H5Sclose);
  const Handle a(check(H5Acreate_by_name(file_, object.c_str(), name.c_str(), H5T_STD_I32LE, space,
                                         H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                       "attribute"),
                 H5Aclose);
  check(H5Awrite(a, H5T_NATIVE_INT, values.data()), "attribute");
}

void Hdf5File::word_attribute(const std::string& object, const std::string& name, const std::string& value) {
  const Checker check(path_, object);
  const Handle type = text_type(H5T_VARIABLE, H5T_CSET_ASCII), space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle a(check(H5Acreate_by_name(file_, object.c_str(), name.c_str(), type, space, H5P_DEFAULT,
                                         H5P_DEFAULT, H5P_DEFAULT),
                       "attribute"),
                 H5Aclose);
  const char* const begin = value.c_str();
  check(H5Awrite(a, type, &begin), "attribute");
}

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
  const std::vector<hsize_t> size = size_of(set, check);
  if (size.empty()) refuse(path_, dataset, "is one value, not a table");
  const double value_bytes = static_cast<double>(H5Tget_size(type));
  Stored found;
  if (H5Pget_layout(content) == H5D_CHUNKED) {
    std::vector<hsize_t> chunk(size.size());
    const int rank = static_cast<int>(size.size());
    if (H5Pget_chunk(content, rank, chunk.data()) != rank)
      refuse(path_, dataset, "has chunks of another rank");
    const double bytes = volume(chunk) * value_bytes;
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
  const std::vector<hsize_t> now = size_of(set, Checker(path_, dataset));
  Extent extent(now.begin(), now.end());
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

void Hdf5File::resize(const std::string& dataset, const Extent& extent) {
  const Checker check(path_, dataset);
  const std::vector<hsize_t> now(extent.begin(), extent.end());
  const Handle set(check(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), "cannot be opened"), H5Dclose);
  check(H5Dset_extent(set, now.data()), "cannot grow");
}

void Hdf5File::write(const std::string& dataset, const Box& box, Id type, const void* values) {
  const Checker check(path_, dataset);
  const std::vector<hsize_t> first(box.first.begin(), box.first.end()),
      size(box.size.begin(), box.size.end());
  const Handle set(check(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), "cannot be opened"), H5Dclose);
  const Handle place(check(H5Dget_space(set), "cannot be opened"), H5Sclose);
  const Handle memory(check(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), "space"),
                      H5Sclose);
  check(H5Sselect_hyperslab(place, H5S_SELECT_SET, first.data(), nullptr, size.data(), nullptr), "selection");
  check(H5Dwrite(set, type, memory, place, H5P_DEFAULT, values), "cannot be written");
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

void Hdf5File::write(const std::string& dataset, const Box& box, const double* values) {
  write(dataset, box, H5T_NATIVE_DOUBLE, values);
}
void Hdf5File::write(const std::string& dataset, const Box& box, const std::int64_t* values) {
  write(dataset, box, H5T_NATIVE_INT64, values);
}
void Hdf5File::read(const std::string& dataset, const Box& box, double* values) const {
  read(dataset, box, H5T_NATIVE_DOUBLE, values, std::numeric_limits<double>::quiet_NaN());
}
void Hdf5File::read(const std::string& dataset, const Box& box, std::int64_t* values) const {
  read(dataset, box, H5T_NATIVE_INT64, values, std::int64_t{-1});
}

bool is_hdf5(const std::filesystem::path& path) {
  start_library();
  return H5Fis_hdf5(path.c_str()) > 0;
}

std::string hdf5_version() {
  start_library();
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return fmt::format("{}.{}.{}", major, minor, release);
}

}  // namespace treejet
