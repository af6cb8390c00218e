#include "core/io/hdf5_file.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "core/io/hdf5_handle.hpp"
#include "core/io/hdf5_table.hpp"

namespace treejet {

using namespace hdf5;

namespace {

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
  const Checker check(path_, name);
  Handle made(
      check(H5Gcreate2(file_, name.c_str(), makes_groups(), without_times(H5P_GROUP_CREATE), H5P_DEFAULT),
            "cannot be made"),
      H5Gclose);
  check(made.close(), "cannot be made");
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
    check(H5Pset_shuffle(content), "shuffle filter");
    check(H5Pset_deflate(content, deflate_level), "deflate filter");
  }
  Handle made(check(H5Dcreate2(file_, name.c_str(), on_disk(layout.number), space, makes_groups(), content,
                               H5P_DEFAULT),
                    "cannot be made"),
              H5Dclose);
  check(made.close(), "cannot be made");
}

void Hdf5File::text(const std::string& name, const std::string& value) {
  const Checker check(path_, name);
  const Handle type = text_type(std::max<std::size_t>(value.size(), 1)),
               space(H5Screate(H5S_SCALAR), H5Sclose);
  Handle made(check(H5Dcreate2(file_, name.c_str(), type, space, makes_groups(),
                               without_times(H5P_DATASET_CREATE), H5P_DEFAULT),
                    "cannot be made"),
              H5Dclose);
  check(H5Dwrite(made, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value.c_str()), "cannot be written");
  check(made.close(), "cannot be written");
}

void Hdf5File::link(const std::string& existing, const std::string& name) {
  Checker(path_, name)(
      H5Lcreate_hard(file_, existing.c_str(), H5L_SAME_LOC, name.c_str(), makes_groups(), H5P_DEFAULT),
      "cannot be linked");
}

void Hdf5File::put_attribute(const std::string& object, const std::string& name, const Attribute& a) {
  const Checker check(path_, object);
  Handle made(check(H5Acreate_by_name(file_, object.c_str(), name.c_str(), a.on_disk, a.space, H5P_DEFAULT,
                                      H5P_DEFAULT, H5P_DEFAULT),
                    "attribute"),
              H5Aclose);
  check(H5Awrite(made, a.in_memory, a.values), "attribute");
  check(made.close(), "attribute");
}

void Hdf5File::attribute(const std::string& object, const std::string& name, const std::string& value) {
  const Handle type = text_type(std::max<std::size_t>(value.size(), 1)),
               space(H5Screate(H5S_SCALAR), H5Sclose);
  put_attribute(object, name, {type, space, type, value.c_str()});
}

void Hdf5File::attribute(const std::string& object, const std::string& name,
                         const std::vector<std::string>& values) {
  std::size_t longest = 1;
  for (const auto& v : values) longest = std::max(longest, v.size());
  std::string padded;
  for (const auto& v : values) padded += v + std::string(longest - v.size(), '\0');
  const hsize_t count = values.size();
  const Handle type = text_type(longest), space(H5Screate_simple(1, &count, nullptr), H5Sclose);
  put_attribute(object, name, {type, space, type, padded.data()});
}

void Hdf5File::attribute(const std::string& object, const std::string& name, const std::vector<int>& values) {
  const hsize_t count = values.size();
  const Handle space(values.size() == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr),
                     H5Sclose);
  put_attribute(object, name, {H5T_STD_I32LE, space, H5T_NATIVE_INT, values.data()});
}

void Hdf5File::word_attribute(const std::string& object, const std::string& name, const std::string& value) {
  const Handle type = text_type(H5T_VARIABLE, H5T_CSET_ASCII), space(H5Screate(H5S_SCALAR), H5Sclose);
  const char* const begin = value.c_str();
  put_attribute(object, name, {type, space, type, &begin});
}

void Hdf5File::resize(const std::string& dataset, const Extent& extent) {
  const Checker check(path_, dataset);
  const std::vector<hsize_t> now(extent.begin(), extent.end());
  Handle set(check(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), "cannot be opened"), H5Dclose);
  check(H5Dset_extent(set, now.data()), "cannot grow");
  check(set.close(), "cannot grow");
}

template <class T>
void Hdf5File::write(const std::string& dataset, const Box& box, Id type, const T* values, T absent) {
  const Checker check(path_, dataset);
  Handle set(check(H5Dopen2(file_, dataset.c_str(), H5P_DEFAULT), "cannot be opened"), H5Dclose);
  const Stored& form = stored(dataset, set);
  const TableWriter<T> writer(path_, dataset, set, type);
  if (!form.filters.empty() && is_of_whole_chunks(box, form.chunk, extent_of(set, check)))
    writer.write_filtered(box, form.chunk, form.filters, chunks_shared, values, absent);
  else
    writer.write_plain(box, values);
  check(set.close(), "cannot be written");
}

void Hdf5File::write(const std::string& dataset, const Box& box, const double* values) {
  write(dataset, box, H5T_NATIVE_DOUBLE, values, std::numeric_limits<double>::quiet_NaN());
}
void Hdf5File::write(const std::string& dataset, const Box& box, const std::int64_t* values) {
  write(dataset, box, H5T_NATIVE_INT64, values, std::int64_t{-1});
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
