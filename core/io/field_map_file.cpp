#include "core/io/field_map_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>

#include "core/base/error.hpp"
#include "core/io/hdf5_file.hpp"
#include "core/jet/scales.hpp"

namespace treejet {

namespace {

constexpr double cm_per_m = 100, statv_per_volt = 1 / volt_per_statvolt;
constexpr double most_points = 1e8;

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(std::filesystem::absolute(path).string() + ": cannot be opened");
  std::string bytes((std::istreambuf_iterator<char>(file)), {});
  if (file.bad()) throw FileError(path.string() + ": cannot be read");
  return bytes;
}

/// FNV-1a, 64 bits: tells files apart, no more.
std::uint64_t hash(const std::string& bytes) {
  std::uint64_t h = 14695981039346656037u;
  for (const char c : bytes) h = (h ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return h;
}

struct Raw {
  FieldMap::Grid grid;            ///< m
  std::vector<double> potential;  ///< V
};

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why) {
  throw InputError(fmt::format("field map {}: {}", path.string(), why));
}

Raw from_hdf5(const std::filesystem::path& path) {
  const Hdf5File file(path, Hdf5File::Access::read);
  for (const char* name : {"/potential", "/origin", "/spacing"})
    if (!file.has(name))
      refuse(path, fmt::format("expected datasets potential, origin and spacing; no {}", name));
  const Extent extent = file.extent("/potential"), three = {3};
  if (extent.size() != 3) refuse(path, "expected potential to have three dimensions, [nz][ny][nx]");
  if (file.extent("/origin") != three || file.extent("/spacing") != three)
    refuse(path, "expected three numbers each in origin and spacing, for x, y and z");
  double points = 1;
  for (const auto n : extent) points *= double(n);
  if (points > most_points) refuse(path, fmt::format("expected at most {:.0e} points", most_points));
  Raw raw;
  for (std::size_t k = 0; k < 3; ++k) raw.grid.size[k] = static_cast<int>(extent[2 - k]);
  raw.potential.resize(static_cast<std::size_t>(points));
  file.read("/potential", {{0, 0, 0}, extent}, raw.potential.data());
  file.read("/origin", {{0}, three}, raw.grid.origin.data());
  file.read("/spacing", {{0}, three}, raw.grid.spacing.data());
  return raw;
}

/// The XML of VTK as far as it is needed: attributes of tags, in the order of the file.
class ImageData {
 public:
  ImageData(const std::filesystem::path& path, const std::string& bytes) : path_(path), bytes_(bytes) {}

  Raw read() const {
    const std::string head = tag("VTKFile", 0).value_or("");
    if (attribute(head, "type") != "ImageData")
      refuse(path_, "expected VTK image data (type=\"ImageData\") or HDF5");
    if (!attribute(head, "compressor").empty())
      refuse(path_, "is compressed; write it without (in ParaView: Compressor Type None)");
    const std::string image = tag("ImageData", 0).value_or(""), piece = tag("Piece", 0).value_or("");
    const std::vector<double> extent = numbers(attribute(image, "WholeExtent")),
                              of_piece = numbers(attribute(piece, "Extent")),
                              origin = numbers(attribute(image, "Origin")),
                              spacing = numbers(attribute(image, "Spacing"));
    if (extent.size() != 6 || origin.size() != 3 || spacing.size() != 3)
      refuse(path_, "expected WholeExtent, Origin and Spacing of the image data");
    if (of_piece != extent) refuse(path_, "expected one piece, of the whole extent");
    const std::vector<double> direction = numbers(attribute(image, "Direction"));
    if (!direction.empty() && direction != std::vector<double>{1, 0, 0, 0, 1, 0, 0, 0, 1})
      refuse(path_, "expected a grid along x, y and z, not a turned one");
    Raw raw;
    double points = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const double n = extent[2 * k + 1] - extent[2 * k] + 1;
      if (!(n >= 1 && n < most_points)) refuse(path_, "has an extent that is none");
      raw.grid.size[k] = static_cast<int>(n);
      raw.grid.spacing[k] = spacing[k];
      raw.grid.origin[k] = origin[k] + extent[2 * k] * spacing[k];
      points *= n;
    }
    if (points > most_points) refuse(path_, fmt::format("expected at most {:.0e} points", most_points));
    raw.potential = values(head, static_cast<std::size_t>(points));
    return raw;
  }

 private:
  /// The first tag of that name from `from` on.
  std::optional<std::string> tag(const std::string& name, std::size_t from) const {
    const std::size_t at = bytes_.find("<" + name, from), end = bytes_.find('>', at);
    if (at == std::string::npos || end == std::string::npos) return std::nullopt;
    return bytes_.substr(at, end - at);
  }

  static std::string attribute(const std::string& tag, const std::string& name) {
    const std::string begin = " " + name + "=\"";
    const std::size_t at = tag.find(begin);
    if (at == std::string::npos) return "";
    const std::size_t first = at + begin.size();
    return tag.substr(first, tag.find('"', first) - first);
  }

  static std::vector<double> numbers(const std::string& text) {
    std::istringstream in(text);
    return {std::istream_iterator<double>(in), {}};
  }

  std::vector<double> values(const std::string& head, std::size_t points) const {
    const std::size_t begin = bytes_.find("<PointData"), end = bytes_.find("</PointData>");
    if (begin == std::string::npos || end == std::string::npos) refuse(path_, "has no point data");
    std::size_t at = std::string::npos;
    int arrays = 0;
    for (std::size_t k = bytes_.find("<DataArray", begin); k < end; k = bytes_.find("<DataArray", k + 1)) {
      if (arrays++ == 0 || attribute(*tag("DataArray", k), "Name") == "potential") at = k;
      if (attribute(*tag("DataArray", k), "Name") == "potential") arrays = 1;
    }
    if (arrays != 1) refuse(path_, "expected point data of one array, or one named potential");
    const std::string array = *tag("DataArray", at), components = attribute(array, "NumberOfComponents");
    if (!components.empty() && components != "1") refuse(path_, "expected one number a point, the potential");
    if (attribute(array, "format") == "ascii") {
      const std::size_t first = bytes_.find('>', at) + 1;
      return numbers(bytes_.substr(first, bytes_.find('<', first) - first));
    }
    if (attribute(array, "format") != "appended") refuse(path_, "expected format ascii or appended");
    return appended(head, array, points);
  }

  std::vector<double> appended(const std::string& head, const std::string& array, std::size_t points) const {
    const std::size_t block = bytes_.find("<AppendedData");
    if (attribute(tag("AppendedData", 0).value_or(""), "encoding") != "raw")
      refuse(path_, "expected appended data in encoding raw");
    if (attribute(head, "byte_order") != "LittleEndian") refuse(path_, "expected byte_order LittleEndian");
    const std::size_t data = bytes_.find('_', bytes_.find('>', block)) + 1;
    const std::vector<double> offset = numbers(attribute(array, "offset"));
    const std::size_t count = attribute(head, "header_type") == "UInt64" ? 8 : 4;
    const std::string type = attribute(array, "type");
    const std::size_t width = type == "Float64" ? 8 : type == "Float32" ? 4 : 0;
    if (width == 0) refuse(path_, "expected type Float32 or Float64");
    if (offset.size() != 1 || !(offset[0] >= 0) || offset[0] > double(bytes_.size()) ||
        data + static_cast<std::size_t>(offset[0]) + count + points * width > bytes_.size())
      throw FileError(path_.string() + ": cut short");
    const char* from = bytes_.data() + data + static_cast<std::size_t>(offset[0]) + count;
    std::vector<double> all(points);
    for (double& value : all) {
      float single = 0;
      if (width == 8)
        std::memcpy(&value, from, 8);
      else
        std::memcpy(&single, from, 4), value = single;
      from += width;
    }
    return all;
  }

  const std::filesystem::path& path_;
  const std::string& bytes_;
};

}  // namespace

std::shared_ptr<const FieldMap> read_field_map(const std::filesystem::path& path) {
  const std::string bytes = bytes_of(path);
  Raw raw = is_hdf5(path) ? from_hdf5(path) : ImageData(path, bytes).read();
  for (std::size_t k = 0; k < 3; ++k) raw.grid.origin[k] *= cm_per_m, raw.grid.spacing[k] *= cm_per_m;
  for (double& p : raw.potential) p *= statv_per_volt;
  return std::make_shared<FieldMap>(raw.grid, std::move(raw.potential),
                                    fmt::format("field map {} ({} bytes, fnv1a {:016x})",
                                                path.filename().string(), bytes.size(), hash(bytes)));
}

void read_field_map_of(Deck& deck) {
  if (!deck.parameters.field_map.empty()) deck.parameters.map = read_field_map(deck.parameters.field_map);
}

}  // namespace treejet
