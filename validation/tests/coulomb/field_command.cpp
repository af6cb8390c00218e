#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/base/error.hpp"
#include "forces/coulomb/command/field_command.hpp"
#include "forces/coulomb/command/field_error.hpp"
#include "forces/coulomb/command/point_table.hpp"
#include "validation/support/point_sets.hpp"

using namespace treejet;

namespace {

std::string file(const std::string& name, const std::string& text) {
  const std::string path = (std::filesystem::temp_directory_path() / name).string();
  std::ofstream(path) << text;
  return path;
}

double root_mean_square(const FieldSet& field) {
  double sum = 0;
  for (const auto& values : field.e)
    for (double e : values) sum += e * e;
  return std::sqrt(sum / static_cast<double>(field.e[0].size()));
}

}  // namespace

TEST_CASE("The field command reads columns in any order and writes the field beside the points") {
  FieldCommand command;
  command.existing = OutputFile::Existing::replace;
  command.points = file("treejet-two.csv", "q,name,z,y,x\n2, a ,0,0,0\n6,b,0,0,2\n");
  command.out = file("treejet-two-field.csv", "");
  std::ostringstream report;
  run(command, report);
  std::ifstream out(command.out);
  std::string line;
  std::getline(out, line);
  CHECK(line == "x,y,z,q,ex,ey,ez,potential");
  std::getline(out, line);
  CHECK(line == "0,0,0,2,-1.5,0,0,3");
}

TEST_CASE("A table that is wrong is refused with its line") {
  CHECK_THROWS_AS(read_points("/nowhere/points.csv"), FileError);
  CHECK_THROWS_WITH(read_points(file("treejet-a.csv", "x,y,z\n1,2,3\n")), Catch::Contains("column q"));
  CHECK_THROWS_WITH(read_points(file("treejet-b.csv", "x,y,z,q\n1,2,3,4\n1,2,3\n")),
                    Catch::Contains("line 3"));
  CHECK_THROWS_WITH(read_points(file("treejet-c.csv", "x,y,z,q\n1,2,3,4x\n")), Catch::Contains("'4x'"));
  CHECK_THROWS_WITH(read_points(file("treejet-d.csv", "x,y,z,q\n")), Catch::Contains("no points"));
  // 1,5 and 2,5 were numbers to whoever wrote this
  CHECK_THROWS_WITH(read_points(file("treejet-e.csv", "x,y,z,q\n1,2,3,4\n1,5,2,5,0,1\n")),
                    Catch::Contains("line 3 has 6 values") && Catch::Contains("decimal comma"));
}

TEST_CASE("A table is read whatever editor wrote it, with numbers as decks have them") {
  const std::string plain = file("treejet-plain.csv", "x,y,z,q\n1,2,3,4\n-0.5,1e-5,0,1\n");
  const PointTable want = read_points(plain);
  for (const char* text :
       {"\xEF\xBB\xBFx,y,z,q\r\n1,2,3,4\r\n-.5,1d-5,0,+1\r\n", "x,y,z,q\r1,2,3,4\r-5.d-1,1.D-5,0,1\r",
        "# made by hand\nx, y, z, q # cm, statC\n\n1,2,3,4 # first\n-0.5,+1e-5,0.,1\n"}) {
    INFO(text);
    const PointTable table = read_points(file("treejet-table.csv", text));
    for (std::size_t k = 0; k < 3; ++k) CHECK(table.r[k] == want.r[k]);
    CHECK(table.q == want.q);
  }
  CHECK_THROWS_WITH(read_points(file("treejet-table.csv", "x,y,z,q\r\n1,2,3,4\r\n1,x1,3,4\r\n")),
                    Catch::Contains("line 3: expected a finite number, found 'x1'"));
}

TEST_CASE("The reported error is the difference from the direct sum") {
  const PointSet set = coil(500, 5, 0.5);
  FieldSet field(500);
  coulomb_direct<3>(set.view(), {0, 500}, field.view());
  CHECK(field_error(set.view(), field.view(), {1}).l2 == 0);
  const double rms = root_mean_square(field);
  field.e[1][17] += 0.01 * rms;
  const FieldError error = field_error(set.view(), field.view(), {1});
  CHECK(error.targets == 500);
  CHECK(error.to_rms.max == Approx(0.01));
  CHECK(error.to_rms.median == 0);
  CHECK(error.l2 == Approx(0.01 / std::sqrt(500.0)));
}

TEST_CASE("Of more than 20,000 points a sample is compared, by the size of the field at all of them") {
  constexpr int n = 20'480;
  PointSet set = coil(n, 50, 0.5);
  for (std::size_t i = n - 100; i < n; ++i) set.q[i] *= 1000;  // a hundred hold nearly all of the field
  FieldSet field(n);
  coulomb_direct<3>(set.view(), {0, n}, field.view());
  const double off = 1e-3 * root_mean_square(field);
  for (double& e : field.e[1]) e += off;
  const FieldError error = field_error(set.view(), field.view(), {2});
  CHECK(error.targets == 2048);
  // the size is that of the wrong field, which differs by a thousandth
  CHECK(error.l2 == Approx(1e-3).epsilon(2e-3));
  CHECK(error.to_rms.median == Approx(error.l2).epsilon(1e-9));
  CHECK(error.to_rms.max == Approx(error.l2).epsilon(1e-9));
}

TEST_CASE("The field command states method, times and an error within the accuracy asked for") {
  const PointSet set = whipping_jet(3000);
  std::ostringstream table;
  table << "x,y,z,q\n";
  table.precision(17);
  for (std::size_t i = 0; i < 3000; ++i)
    table << set.r[0][i] << ',' << set.r[1][i] << ',' << set.r[2][i] << ',' << set.q[i] << '\n';
  FieldCommand command;
  command.existing = OutputFile::Existing::replace;
  command.points = file("treejet-jet.csv", table.str());
  command.request.method = CoulombMethod::tree;
  command.request.accuracy = 1e-4;
  command.compare = command.json = true;
  std::ostringstream report;
  run(command, report);
  const std::string text = report.str();
  for (const char* key :
       {"\"n\":3000", "\"method\":\"tree\"", "\"order\":", "\"error_l2\":", "\"error_median\":",
        "\"error_p99\":", "\"error_max\":", "\"seconds\":", "\"ns_per_point\":", "\"interactions\":"})
    CHECK_THAT(text, Catch::Contains(key));
  const double l2 = std::stod(text.substr(text.find("\"error_l2\":") + 11));
  CHECK(l2 <= 1e-4);
  CHECK(l2 > 1e-8);
}
