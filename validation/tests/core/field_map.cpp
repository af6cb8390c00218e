/// Field maps: what a file says of a field is the field, to the order of its grid.

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <fstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/error.hpp"
#include "core/io/field_map_file.hpp"
#include "core/io/hdf5_file.hpp"
#include "forces/terms/external_field.hpp"
#include "validation/support/run.hpp"
#include "validation/support/scratch_directory.hpp"

using namespace treejet;

namespace {

constexpr double statv_per_volt = 1 / volt_per_statvolt;

struct Sampled {
  FieldMap::Grid grid;  ///< as in the file: m
  std::vector<double> volts;
};

/// f of cm, statV, sampled with n points along x and half of it across.
template <class F>
Sampled sample(int n, const F& f) {
  Sampled s;
  s.grid.size = {n, n / 2, n / 2 + 1};
  const double length = 0.18, width = 0.04;
  s.grid.origin = {-0.01, -width / 2, -width / 2};
  s.grid.spacing = {length / (n - 1), width / (n / 2 - 1), width / (n / 2)};
  for (int z = 0; z < s.grid.size[2]; ++z)
    for (int y = 0; y < s.grid.size[1]; ++y)
      for (int x = 0; x < s.grid.size[0]; ++x)
        s.volts.push_back(f(Vec<3>(100 * (s.grid.origin[0] + x * s.grid.spacing[0]),
                                   100 * (s.grid.origin[1] + y * s.grid.spacing[1]),
                                   100 * (s.grid.origin[2] + z * s.grid.spacing[2]))) /
                          statv_per_volt);
  return s;
}

void write_hdf5(const std::string& path, const Sampled& s) {
  Hdf5File file(path, Hdf5File::Access::create);
  const auto size = [&](int k) { return static_cast<std::uint64_t>(s.grid.size[std::size_t(k)]); };
  const Extent all = {size(2), size(1), size(0)};
  file.dataset("/potential", {.extent = all, .chunk = all});
  file.write("/potential", {{0, 0, 0}, all}, s.volts.data());
  for (const auto& [name, numbers] : {std::pair{"/origin", s.grid.origin}, {"/spacing", s.grid.spacing}}) {
    file.dataset(name, {.extent = {3}, .chunk = {3}});
    file.write(name, {{0}, {3}}, numbers.data());
  }
  file.close();
}

std::string vti(const Sampled& s, bool ascii) {
  const auto& g = s.grid;
  const std::string extent = fmt::format("0 {} 0 {} 0 {}", g.size[0] - 1, g.size[1] - 1, g.size[2] - 1);
  std::string text = fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<ImageData WholeExtent=\"{}\" Origin=\"{} {} {}\" Spacing=\"{} {} {}\">\n"
      "<Piece Extent=\"{}\">\n<PointData Scalars=\"potential\">\n"
      "<DataArray type=\"Float64\" Name=\"potential\" format=\"{}\"",
      extent, g.origin[0], g.origin[1], g.origin[2], g.spacing[0], g.spacing[1], g.spacing[2], extent,
      ascii ? "ascii" : "appended");
  const std::string end = "</PointData>\n</Piece>\n</ImageData>\n";
  if (ascii) return text + fmt::format(">\n{}\n</DataArray>\n{}</VTKFile>\n", fmt::join(s.volts, " "), end);
  text += " offset=\"0\"/>\n" + end + "<AppendedData encoding=\"raw\">\n_";
  const std::uint64_t bytes = 8 * s.volts.size();
  std::string raw(8 + bytes, '\0');
  std::memcpy(raw.data(), &bytes, 8);
  std::memcpy(raw.data() + 8, s.volts.data(), bytes);
  return text + raw + "\n</AppendedData>\n</VTKFile>\n";
}

void write(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// 1/r fields of two charges off the box, and a field along x.
double smooth(const Vec<3>& r) {
  return 40 / (r - Vec<3>(-6, 3, 1)).norm() - 30 / (r - Vec<3>(24, -2, 4)).norm() - 2 * r[0];
}

Vec<3> field_of_smooth(const Vec<3>& r) {
  const Vec<3> a = r - Vec<3>(-6, 3, 1), b = r - Vec<3>(24, -2, 4);
  return 40 * a / std::pow(a.norm(), 3) - 30 * b / std::pow(b.norm(), 3) + Vec<3>(2, 0, 0);
}

std::shared_ptr<const FieldMap> map_of(const Sampled& s) {
  static const ScratchDirectory scratch;
  write_hdf5((scratch.path / "map.h5").string(), s);
  return read_field_map((scratch.path / "map.h5").string());
}

}  // namespace

TEST_CASE("The field of a map has an error of third order inside and of second order at the border") {
  const auto error = [](int n, bool inside) {
    const auto map = map_of(sample(n, smooth));
    double worst = 0;
    for (double x = inside ? 2 : -1; x <= (inside ? 14 : 17); x += 0.37)
      for (double y = inside ? -1 : -2; y <= (inside ? 1 : 2); y += 0.23)
        for (double z = inside ? -1 : -2; z <= (inside ? 1 : 2); z += 0.19)
          worst = std::max(worst, (map->field({x, y, z}) - field_of_smooth({x, y, z})).norm());
    return worst;
  };
  // halving the spacing divides the error by 2^order; the points lie at other places of their cells
  CHECK(std::log2(error(24, true) / error(48, true)) > 2.7);
  CHECK(std::log2(error(24, false) / error(48, false)) > 1.7);
}

TEST_CASE("The field of a map is the gradient of its potential, with continuous slopes across its points") {
  const auto map = map_of(sample(12, smooth));
  const Vec<3> r(5.3, 0.4, -0.7);
  constexpr double h = 1e-4;
  for (int k = 0; k < 3; ++k) {
    Vec<3> d = Vec<3>::Zero();
    d[k] = h;
    // central differences of a cubic: h^2 phi''' / 6, below 1e-8
    CHECK(map->field(r)[k] ==
          Approx((map->potential(r - d) - map->potential(r + d)) / (2 * h)).epsilon(1e-6));
  }
  const double point = -1 + 18. / 11 * 4;  // of the grid
  const auto slope = [&](double x) {
    return (map->field({x + h, 0, 0})[0] - map->field({x - h, 0, 0})[0]) / (2 * h);
  };
  // the second derivative goes on; h times the third is 1e-5 of it
  CHECK(slope(point - 2 * h) == Approx(slope(point + 2 * h)).epsilon(1e-3));
}

TEST_CASE("HDF5 and VTK image data, in text or raw, give the same map") {
  const ScratchDirectory scratch;
  const Sampled s = sample(10, smooth);
  write_hdf5((scratch.path / "map.h5").string(), s);
  write((scratch.path / "text.vti").string(), vti(s, true));
  write((scratch.path / "raw.vti").string(), vti(s, false));
  const Vec<3> r(7.7, 0.3, 1.1);
  const Vec<3> field = read_field_map((scratch.path / "map.h5").string())->field(r);
  CHECK(read_field_map((scratch.path / "text.vti").string())->field(r) == field);
  CHECK(read_field_map((scratch.path / "raw.vti").string())->field(r) == field);
  const std::string name = read_field_map((scratch.path / "raw.vti").string())->name();
  CHECK(name.starts_with("field map raw.vti ("));
  CHECK(name.find("bytes, fnv1a ") != std::string::npos);
}

TEST_CASE("A file that is no map is refused with what it should hold") {
  const ScratchDirectory scratch;
  const std::string good = vti(sample(10, smooth), false), path = (scratch.path / "map.vti").string();
  const auto said = [&](const std::string& bytes) -> std::string {
    write(path, bytes);
    try {
      read_field_map(path);
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  };
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  CHECK(said(good) == "");
  CHECK(said("hello").find("expected VTK image data") != std::string::npos);
  CHECK(said(good.substr(0, good.size() - 200)).find("cut short") != std::string::npos);
  CHECK(said(changed("LittleEndian", "BigEndian")).find("expected byte_order LittleEndian") !=
        std::string::npos);
  CHECK(said(changed("Float64", "Int64")).find("expected type Float32 or Float64") != std::string::npos);
  CHECK(
      said(changed("version=\"1.0\" byte", "compressor=\"vtkZLibDataCompressor\" byte")).find("compressed") !=
      std::string::npos);
  CHECK(said(changed("0 9 0 4", "0 9 0 1")).find("one piece") != std::string::npos);
  write_hdf5((scratch.path / "map.h5").string(),
             {{{3, 9, 9}, {0, 0, 0}, {1, 1, 1}}, std::vector<double>(243, 1.0)});
  CHECK_THROWS_WITH(read_field_map((scratch.path / "map.h5").string()),
                    Catch::Matchers::Contains("at least 4 points"));
  CHECK_THROWS_AS(read_field_map((scratch.path / "none.h5").string()), FileError);
}

TEST_CASE("A uniform field from a map moves the PVP jet as the external potential does") {
  Parameters p = with_tolerance(example("pvp"), 1e-8);
  const double E = p.external_potential / p.collector_distance;
  Run<3> direct(p);
  p.external_potential = 0;
  p.field_map = "uniform";
  p.map = map_of(sample(8, [&](const Vec<3>& r) { return -E * r[0]; }));
  Run<3> mapped(p);
  direct.to(1e-3);
  mapped.to(1e-3);
  REQUIRE(mapped.jet().size() == direct.jet().size());
  // a straight line is a spline: round-off of the field, 1e-14, and of the steps that it changes
  CHECK((mapped.jet().y - direct.jet().y).abs().maxCoeff() < 1e-9);
}

TEST_CASE(
    "A map of needle and plate gives the needle's trajectory, nearer with each halving of its spacing") {
  Parameters p = with_tolerance(example("pvp"), 1e-10);
  p.inserting = p.removing = p.perturb = false;
  p.initial_length = 3;  // away from the tip, where no grid resolves the field
  p.field_needle = 0.5;
  p.final_time = 2e-3;
  Run<3> exact(p);
  exact.to(p.final_time);
  const double V = p.external_potential;
  const NeedleField needle(0.5, p.collector_distance);
  p.field_needle.reset();
  p.external_potential = 0;
  p.field_map = "needle";
  const auto off = [&](int n) {
    // the box begins behind the tip: inside of the needle the potential is cut off far from the bead
    p.map = map_of(sample(n, [&](const Vec<3>& r) {
      return V * needle.potential({std::max(r[0], 0.5), r[1], r[2]});
    }));
    Run<3> run(p);
    run.to(p.final_time);
    return std::abs(run.x() - exact.x());
  };
  const double coarse = off(24), fine = off(48);
  CHECK(fine < 1e-4);
  CHECK(std::log2(coarse / fine) > 2);  // third order, but for where the points lie along the way
}

TEST_CASE("A bead that leaves the map stops the run and is named with the box") {
  Parameters p = with_tolerance(example("pvp"), 1e-6);
  p.external_potential = 0;
  p.field_map = "small";
  Sampled s = sample(10, smooth);
  for (double& spacing : s.grid.spacing) spacing /= 10;
  s.grid.origin = {-0.005, -0.002, -0.002};
  p.map = map_of(s);
  Run<3> run(p);
  CHECK_THROWS_WITH(run.to(0.01), Catch::Matchers::Contains("off the field map map.h5") &&
                                      Catch::Matchers::Contains("x -0.5 to 1.3"));
}
