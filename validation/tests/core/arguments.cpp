/// Times of the command line, and what a second run for an error estimate is.

#include <catch2/catch.hpp>

#include "core/base/number.hpp"
#include "core/commands/command_line.hpp"
#include "core/deck/directives.hpp"
#include "integrators/run/error_estimate.hpp"
#include "validation/support/example.hpp"

using namespace treejet;

TEST_CASE("A wall time is read as Slurm writes it, or as a number with a unit") {
  CHECK(wall_seconds("1-02:03:04") == 86400 + 2 * 3600 + 3 * 60 + 4);
  CHECK(wall_seconds("2-3") == 2 * 86400 + 3 * 3600);
  CHECK(wall_seconds("26:00:00") == 26 * 3600);
  CHECK(wall_seconds("90:30") == 90 * 60 + 30);
  CHECK(wall_seconds("1800") == 1800);
  CHECK(wall_seconds("30min") == 1800);
  for (const char* wrong : {"1:75:00", "1-24:00:00", "0:00:75", "0", "-5", "1-", "1:2:3:4", "ten", "5cm"}) {
    CAPTURE(wrong);
    CHECK_FALSE(wall_seconds(wrong));
  }
}

TEST_CASE("The second run of an estimate is finer, and has the same rows") {
  Parameters p = example("pvp");
  p.timestep.reset();
  p.tolerance = 1e-5;
  CHECK(finer(p).tolerance.value() == Approx(1e-6).epsilon(1e-14));
  p.tolerance.reset();
  p.timestep = 1e-6;
  p.print_time.reset();
  CHECK(finer(p).timestep.value() == 5e-7);
  CHECK(print_interval(finer(p)) == print_interval(p));  // by default 1000 steps
}

TEST_CASE("The difference of two tables keeps the time and leaves out wall clocks") {
  const TableOfRows first{{"t[s]", "x[cm]", "cpu[s]"}, {{0, 1, 7}, {0.5, 3, 9}}};
  const TableOfRows second{{"t[s]", "x[cm]", "cpu[s]"}, {{0, 1, 8}, {0.5, 2.5, 8}}};
  const TableOfRows d = difference(first, second);
  CHECK(d.labels == std::vector<std::string>{"t[s]", "x[cm]"});
  CHECK(d.rows == std::vector<std::vector<double>>{{0, 0}, {0.5, 0.5}});
}

TEST_CASE("A quantity with a unit is held to the limits of a bare number") {
  Parameters p = example("pvp");
  const auto problem = [&](const char* number, const char* unit) {
    return assign(directive("final time"), std::vector<std::string>{number, unit}, p);
  };
  CHECK(problem("250", "ms").empty());
  CHECK(p.final_time == 0.25);
  CHECK_THAT(problem("-1", "ms"), Catch::Contains("positive"));
  CHECK_THAT(problem("1e-320", "ns"), Catch::Contains("double precision"));  // would be 0
  CHECK_THAT(problem("3", "cm"), Catch::Contains("a length"));
  CHECK_THAT(problem("3", "s^99"), Catch::Contains("no unit"));
  CHECK(p.final_time == 0.25);
  CHECK(real_number("0e5").problem.empty());
}
