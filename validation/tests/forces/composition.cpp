/// A scene holds what its deck names and nothing else.

#include <catch2/catch.hpp>
#include <filesystem>
#include <set>

#include "core/observe/outputs.hpp"
#include "validation/support/run.hpp"

using namespace treejet;

namespace {

using Names = std::set<std::string>;

template <int D>
Names terms(const Scene<D>& scene) {
  Names names;
  for (const auto& term : scene.motion->local_terms()) names.emplace(term->name());
  if (scene.motion->coulomb()) names.emplace(scene.motion->coulomb()->name());
  return names;
}

Names named(const std::vector<Composed>& choices) {
  Names names;
  for (const auto& c : choices) {
    CHECK_FALSE(c.reason.empty());
    CHECK(names.insert(c.term).second);  // told once
  }
  return names;
}

/// Why the scene does without; empty if it does not say.
template <int D>
std::string reason(const Scene<D>& scene, const std::string& term) {
  for (const auto& c : scene.left_out)
    if (c.term == term) return c.reason;
  return "";
}

const std::string viscoelastic = "viscoelastic force", field = "external field", gravity = "gravity",
                  tension = "surface tension", coulomb = "Coulomb sum over all pairs";

}  // namespace

TEST_CASE("The PVP jet is composed of every term") {
  const auto scene = compose<3>(example("pvp"), {1});
  CHECK(terms(scene) == Names{viscoelastic, field, gravity, tension, coulomb});
  CHECK(scene.motion->stress_law().name() == "Maxwell stress");
  CHECK(named(scene.left_out) == Names{"Herschel-Bulkley stress", "slender self-field", "viscous tension",
                                       "bending", "evaporation", "magnetic field", "air drag", "air lift",
                                       "friction", "random force", "splitting and merging of elements"});
}

TEST_CASE("The single bead has neither gravity nor surface tension, events or a circling nozzle") {
  const auto scene = compose<1>(example("single-bead"), {1});
  CHECK(terms(scene) == Names{viscoelastic, field, coulomb});
  CHECK(named(scene.composed) == Names{"Maxwell stress", viscoelastic, field, coulomb});
  CHECK(named(scene.left_out) == Names{"Herschel-Bulkley stress", "viscous tension", "evaporation", gravity,
                                       tension, "bending", "slender self-field", "magnetic field", "air drag",
                                       "air lift", "friction", "random force", "insertion at the nozzle",
                                       "removal at the collector", "circling nozzle", "two rates",
                                       "splitting and merging of elements"});
  CHECK(reason(scene, gravity) == "no gravity yes");
  CHECK(reason(scene, tension) == "a straight jet (system 1) has no curvature");
  CHECK_FALSE(scene.nozzle.inserting());
  CHECK_FALSE(scene.collector.removing());
}

TEST_CASE("The straight jet has insertion and removal on top") {
  const auto scene = compose<1>(example("straight-jet"), {1});
  CHECK(terms(scene) == Names{viscoelastic, field, coulomb});
  CHECK(scene.nozzle.inserting());
  CHECK(scene.collector.removing());
  CHECK(named(scene.composed).count("insertion at the nozzle") == 1);
}

TEST_CASE("Each line that a deck leaves out takes exactly its own term away, and the scene says why") {
  const Names all{viscoelastic, field, gravity, tension, coulomb};
  const auto without = [&](const Names& gone, const std::string& term, const std::string& why, auto change) {
    Parameters p = example("pvp");
    change(p);
    const auto scene = compose<3>(p, {1});
    Names left = all;
    for (const auto& g : gone) left.erase(g);
    CAPTURE(term);
    CHECK(terms(scene) == left);
    CHECK(reason(scene, term) == why);
    const auto whole = compose<3>(example("pvp"), {1});  // what it does without is told, and nothing else
    CHECK(scene.composed.size() + scene.left_out.size() == whole.composed.size() + whole.left_out.size());
  };
  without({gravity}, "gravity", "no gravity yes", [](Parameters& p) { p.gravity = false; });
  without({tension}, "surface tension", "surface tension is 0", [](Parameters& p) { p.surface_tension = 0; });
  without({field}, "external field", "external potential is 0",
          [](Parameters& p) { p.external_potential = 0; });
  without({field, coulomb}, "Coulomb sum", "density charge is 0",
          [](Parameters& p) { p.density_charge = 0; });
  without({field, coulomb}, "external field", "density charge is 0",
          [](Parameters& p) { p.density_charge = 0; });
  without({}, "circling nozzle", "no perturb yes", [](Parameters& p) { p.perturb = false; });
  without({}, "insertion at the nozzle", "no inserting yes", [](Parameters& p) { p.inserting = false; });
  without({}, "removal at the collector", "no removing yes", [](Parameters& p) { p.removing = false; });
}

TEST_CASE("The slender self-field and the energy of the surface are there if the deck names them") {
  Parameters p = example("pvp");
  p.self_field = SelfField::slender;
  p.surface_model = SurfaceModel::energy;
  CHECK(terms(compose<3>(p, {1})) ==
        Names{viscoelastic, field, gravity, "surface tension as an energy", "slender self-field", coulomb});
  const auto ends_whole = compose<3>(p, {1});
  CHECK(ends_whole.jet.charge[0] == 1);
  p.inserting = false;
  const auto ends_in_half_a_cell = compose<3>(p, {1});
  CHECK(ends_in_half_a_cell.jet.charge[0] == 0.5);
  CHECK(ends_in_half_a_cell.jet.mass[0] == 0.5);
  p.density_charge = 0;
  CHECK(reason(compose<3>(p, {1}), "slender self-field") == "density charge is 0");
}

TEST_CASE("A Herschel-Bulkley fluid takes the place of Maxwell's") {
  Parameters p = example("pvp");
  p.hbfluid = true;
  CHECK(compose<3>(p, {1}).motion->stress_law().name() == "Herschel-Bulkley stress");
  p.hbfluid = false;
  p.yield_stress = 1;
  CHECK(compose<3>(p, {1}).motion->stress_law().name() == "Herschel-Bulkley stress");
}

TEST_CASE("Multirate stays out where the rate of the stress jumps or has a kink as an element turns") {
  Parameters yielding = example("pvp");
  yielding.yield_stress = 1000;
  CHECK(reason(compose<3>(yielding, {1}), "two rates").starts_with("the stress law has a kink"));
  Parameters power = example("pvp");
  power.hbfluid = true;
  power.hb_index = 0.8;
  CHECK(reason(compose<3>(power, {1}), "two rates").starts_with("the stress law has a kink"));
  power.hb_index = 1;
  CHECK(compose<3>(power, {1}).multirate);
}

TEST_CASE("No output is made that the deck does not ask for") {
  namespace fs = std::filesystem;
  const fs::path directory = fs::temp_directory_path() / "treejet-test-composition";
  fs::remove_all(directory);
  Parameters p = example("pvp");
  p.print_list.clear();
  p.printstat_list.clear();
  p.print_xyz.reset();
  const Nozzle<3> nozzle(p);
  const Collector collector(p);
  const auto made = [&](const Parameters& q) {
    const Outputs<3> outputs(q, nozzle, collector,
                             {directory, OutputFile::Existing::replace, /*quiet*/ true});
    Names files;
    if (fs::exists(directory))
      for (const auto& f : fs::directory_iterator(directory)) files.insert(f.path().filename().string());
    fs::remove_all(directory);
    return std::pair{outputs.observers().size(), files};
  };
  // one watcher, without files, looks for jets that no laboratory has seen
  CHECK(made(p) == std::pair{std::size_t(1), Names{}});

  Parameters table = p;
  table.printstat_list = {"t", "x"};
  CHECK(made(table) == std::pair{std::size_t(2), Names{"run.json", "statdat.dat"}});

  Parameters trajectory = p;
  trajectory.print_xyz = 1e-4;
  CHECK(made(trajectory) == std::pair{std::size_t(2), Names{"run.json", "traj.xyz"}});

  Parameters hdf5 = p;
  hdf5.print_hdf5 = 1e-4;
  CHECK(made(hdf5) == std::pair{std::size_t(2), Names{"run.json", "traj.h5"}});

  Parameters terminal = p;  // a table for the terminal, of which --quiet wants nothing
  terminal.print_list = {"t"};
  CHECK(made(terminal) == std::pair{std::size_t(1), Names{}});
}

TEST_CASE("Of a slender jet that nothing is added to the free end is half a bead, in mass and charge") {
  Parameters p = example("pvp", {"points 3"});
  p.self_field = SelfField::slender;
  p.inserting = false;
  const Jet<3> jet = compose<3>(p, {1}).jet;
  CHECK(jet.mass[0] == 0.5);
  CHECK(jet.charge[0] == 0.5);
  CHECK(jet.mass[1] == 1);
  CHECK(jet.charge[1] == 1);
}
