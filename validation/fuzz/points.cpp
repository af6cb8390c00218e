/// Tables of charges for `treejet field`: what has been read is finite, and is written and read back to the
/// bit.

#include <cmath>
#include <vector>

#include "core/io/atomic_file.hpp"
#include "forces/coulomb/command/point_table.hpp"
#include "validation/fuzz/target.hpp"
#include "validation/support/scratch_directory.hpp"

namespace treejet::fuzz {

namespace {

bool same(const PointTable& a, const PointTable& b) {
  return a.r[0] == b.r[0] && a.r[1] == b.r[1] && a.r[2] == b.r[2] && a.q == b.q;
}

void write(const std::filesystem::path& file, const PointTable& points) {
  PointTable field = points;
  const FieldArrays<3> of_field = {field.r[0].data(), field.r[1].data(), field.r[2].data()};
  write_field(file.string(), OutputFile::Existing::replace, points, of_field, field.q.data());
}

}  // namespace

std::vector<std::string> tables_of_points() {
  const ScratchDirectory place;
  PointTable points;
  for (int k = 0; k < 5; ++k) {
    for (auto& r : points.r) r.push_back(std::sqrt(2 + k));
    points.q.push_back(k - 1);
  }
  write(place.path / "field.csv", points);
  return {read_whole(place.path / "field.csv"), "x,y,z,q\n0,0,0,1\n1.d0,-2.5,3E-2,1\n",
          "\xef\xbb\xbf# charges\r\nq, z ,y,name,x\r\n1, 2 , 3 ,a,4 # one\r\n\r\n+1,2.,.3,b,1d-300\r\n",
          "x,y,z,q\r1;2;3;4\r1,5,2,5,3,5,1\r"};
}

void feed_points(std::string_view bytes) {
  const auto& file = as_file(bytes);
  is_read([&] {
    const PointTable points = read_points(file.string());
    const auto n = static_cast<std::size_t>(points.size());
    demand(n > 0 && 8 * n <= bytes.size(), "eight bytes at least make a point");
    for (const auto& values : {points.r[0], points.r[1], points.r[2], points.q}) {
      demand(values.size() == n, "each point has all values");
      for (const double value : values) demand(std::isfinite(value), "values are finite");
    }
    const auto copy = file.parent_path() / "copy.csv";
    write(copy, points);
    demand(same(read_points(copy.string()), points), "what is written is read back to the bit");
  });
}

}  // namespace treejet::fuzz
