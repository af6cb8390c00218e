/// Field maps from HDF5 and VTK: inside its box a map that is read has a finite field.

#include <cmath>
#include <cstring>

#include "core/io/atomic_file.hpp"
#include "core/io/field_map_file.hpp"
#include "core/io/hdf5_file.hpp"
#include "validation/fuzz/target.hpp"
#include "validation/support/scratch_directory.hpp"

namespace treejet::fuzz {

namespace {

constexpr std::uint64_t n = 4;

std::string in_hdf5() {
  const ScratchDirectory place;
  Hdf5File file(place.path / "map.h5", Hdf5File::Access::create);
  const std::vector<double> volts(n * n * n, 7), three{0.1, 0.2, 0.3};
  file.dataset("/potential", {.extent = {n, n, n}, .chunk = {n, n, n}});
  file.write("/potential", {{0, 0, 0}, {n, n, n}}, volts.data());
  for (const char* name : {"/origin", "/spacing"}) {
    file.dataset(name, {.extent = {3}, .chunk = {3}});
    file.write(name, {{0}, {3}}, three.data());
  }
  file.close();
  return read_whole(place.path / "map.h5");
}

std::string in_vtk(bool ascii) {
  std::string text =
      "<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
      "<ImageData WholeExtent=\"0 3 0 3 0 3\" Origin=\"0 0 0\" Spacing=\"1 1 2\">\n<Piece Extent=\"0 3 0 3 0 "
      "3\">\n"
      "<PointData>\n<DataArray type=\"Float64\" Name=\"potential\" format=";
  if (ascii) {
    text += "\"ascii\">\n";
    for (std::uint64_t k = 0; k < n * n * n; ++k) text += "1.5 ";
    return text + "</DataArray>\n</PointData>\n</Piece>\n</ImageData>\n</VTKFile>\n";
  }
  text +=
      "\"appended\" offset=\"0\"/>\n</PointData>\n</Piece>\n</ImageData>\n<AppendedData encoding=\"raw\">\n_";
  return text + std::string(8 + 8 * n * n * n, '\1') + "\n</AppendedData>\n</VTKFile>\n";
}

}  // namespace

std::vector<std::string> field_maps() {
  return {in_hdf5(), in_vtk(true), in_vtk(false)};
}

void feed_field_map(std::string_view bytes) {
  const auto& file = as_file(bytes);
  is_read([&] {
    const auto map = read_field_map(file);
    demand(!map->box().empty() && !map->name().empty(), "a map has a box and a name");
    const Vec<3> origin = Vec<3>::Zero();
    if (map->contains(origin)) map->field(origin);
  });
}

}  // namespace treejet::fuzz
