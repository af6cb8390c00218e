/// The recipe "an output" of docs/recipes.md.

#include <catch2/catch.hpp>

#include <fstream>

#include "core/base/output_file.hpp"
#include "core/observe/sampling.hpp"
#include "validation/support/scenes.hpp"
#include "validation/support/scratch_directory.hpp"

using namespace treejet;

namespace {

/// A file with the position of the farthest bead, a line each interval.
class TipTrack final : public Sampling<3> {
 public:
  TipTrack(double interval, OutputFile file) : Sampling<3>(interval), file_(std::move(file)) {}

 private:
  void sample(const Jet<3>& jet) override {
    if (jet.size() > 0)
      file_.write(
          fmt::format("{:.17g} {:.17g} {:.17g} {:.17g}\n", jet.t, jet.y(0, 0), jet.y(0, 1), jet.y(0, 2)));
  }

  OutputFile file_;
};

}  // namespace

TEST_CASE("The track of a bead that moves freely is a straight line, at the times asked for") {
  const ScratchDirectory scratch;
  const auto path = scratch.path / "tip.dat";
  {
    Parameters p = plain_parameters();
    p.integrator = Scheme::heun;
    p.timestep = 0.3 * scales(p).time;  // does not divide the interval
    auto f = equations<3>(p);
    auto jet = jet_of<3>({{Vec<3>(1, 2, 3), Vec<3>(0.5, 0.25, -1)}});
    TipTrack tip(0.5, OutputFile(path, OutputFile::Existing::keep));
    const Nozzle<3> nozzle(p);
    const Collector collector(p);
    Integration<3>(p, {jet, f, nozzle, collector}, {&tip}).march.to(2);
  }
  std::ifstream file(path);
  double t, x, y, z;
  int lines = 0;
  for (; file >> t >> x >> y >> z; ++lines) {
    CHECK(t == Approx(0.5 * lines).margin(1e-12));  // round-off of times and steps, here and below
    CHECK(x == Approx(1 + 0.5 * t).epsilon(1e-12));
    CHECK(y == Approx(2 + 0.25 * t).epsilon(1e-12));
    CHECK(z == Approx(3 - t).margin(1e-12));
  }
  CHECK(lines == 5);
}
