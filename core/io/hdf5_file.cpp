#include "core/io/hdf5_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <hdf5.h>

#include <utility>

#include "core/base/error.hpp"
#include "core/io/division_guard.hpp"

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

/// A dataset whose values are in this very file. Soft and external links, external raw data and virtual
/// datasets lead elsewhere, as far as any file that the user may read, and Treejet writes none.
Handle own_dataset(hid_t file, const std::filesystem::path& path, const std::string& name) {
  const Checker check(path, name);
  for (auto end = name.find('/', 1);; end = name.find('/', end + 1)) {
    H5L_info_t link;
    check(H5Lget_info(file, name.substr(0, end).c_str(), &link, H5P_DEFAULT), "cannot be read");
    if (link.type != H5L_TYPE_HARD) refuse(path, name, "is a link that may lead out of the file");
    if (end == std::string::npos) break;
  }
  const DivisionGuard guard(path);
  Handle set(check(H5Dopen2(file, name.c_str(), H5P_DEFAULT), "cannot be read"), H5Dclose);
  const Handle content(check(H5Dget_create_plist(set), "cannot be read"), H5Pclose);
  if (H5Pget_external_count(content) != 0 || H5Pget_layout(content) == H5D_VIRTUAL)
    refuse(path, name, "has its values in another file");
  return set;
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

Hdf5File::Hdf5File(std::filesystem::path path, Access access) : path_(std::move(path)) {
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

bool Hdf5File::has(const std::string& name) const {
  for (auto end = name.find('/', 1);; end = name.find('/', end + 1)) {
    if (H5Lexists(file_, name.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
    if (end == std::string::npos) return true;
  }
}

Extent Hdf5File::extent(const std::string& dataset) const {
  const Checker check(path_, dataset);
  const Handle set = own_dataset(file_, path_, dataset);
  const Handle type(check(H5Dget_type(set), "cannot be read"), H5Tclose);
  if (H5Tget_class(type) != H5T_FLOAT && H5Tget_class(type) != H5T_INTEGER)
    refuse(path_, dataset, "does not hold numbers");
  const Handle space(check(H5Dget_space(set), "cannot be read"), H5Sclose);
  std::vector<hsize_t> now(
      static_cast<std::size_t>(check(H5Sget_simple_extent_ndims(space), "cannot be read")));
  if (now.empty()) refuse(path_, dataset, "is one value, not a table");
  check(H5Sget_simple_extent_dims(space, now.data(), nullptr), "cannot be read");
  Extent extent(now.begin(), now.end());
  if (const hsize_t stored = H5Dget_storage_size(set); !plausible(extent, stored))
    refuse(path_, dataset,
           fmt::format("claims {} values, but {} bytes are stored", fmt::join(extent, " x "), stored));
  return extent;
}

std::string Hdf5File::text(const std::string& dataset) const {
  const Checker check(path_, dataset);
  const Handle set = own_dataset(file_, path_, dataset);
  const Handle type(check(H5Dget_type(set), "cannot be read"), H5Tclose),
      space(check(H5Dget_space(set), "cannot be read"), H5Sclose);
  std::string value(text_size(type, space, H5Dget_storage_size(set), path_, dataset), '\0');
  check(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data()), "cannot be read");
  return without_padding(value);
}

std::string Hdf5File::text_attribute(const std::string& object, const std::string& name) const {
  const Checker check(path_, object);
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

void Hdf5File::transfer(const std::string& dataset, const Box& box, bool writes, Id memory_type,
                        void* values) const {
  const Checker check(path_, dataset);
  const std::vector<hsize_t> first(box.first.begin(), box.first.end()),
      size(box.size.begin(), box.size.end());
  const Handle set = own_dataset(file_, path_, dataset);
  const Handle place(check(H5Dget_space(set), "cannot be opened"), H5Sclose);
  const Handle memory(check(H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), "space"),
                      H5Sclose);
  check(H5Sselect_hyperslab(place, H5S_SELECT_SET, first.data(), nullptr, size.data(), nullptr), "selection");
  if (writes)
    check(H5Dwrite(set, memory_type, memory, place, H5P_DEFAULT, values), "cannot be written");
  else
    check(H5Dread(set, memory_type, memory, place, H5P_DEFAULT, values), "cannot be read");
}

void Hdf5File::write(const std::string& dataset, const Box& box, const double* values) {
  transfer(dataset, box, true, H5T_NATIVE_DOUBLE, const_cast<double*>(values));
}
void Hdf5File::write(const std::string& dataset, const Box& box, const std::int64_t* values) {
  transfer(dataset, box, true, H5T_NATIVE_INT64, const_cast<std::int64_t*>(values));
}
void Hdf5File::read(const std::string& dataset, const Box& box, double* values) const {
  transfer(dataset, box, false, H5T_NATIVE_DOUBLE, values);
}
void Hdf5File::read(const std::string& dataset, const Box& box, std::int64_t* values) const {
  transfer(dataset, box, false, H5T_NATIVE_INT64, values);
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
