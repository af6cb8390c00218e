/// What a run tells at its end, from numbers that it tells elsewhere.

#include <catch2/catch.hpp>
#include <regex>

#include "core/io/output_files.hpp"
#include "integrators/run/simulation.hpp"
#include "validation/support/run.hpp"
#include "validation/support/scratch_directory.hpp"

using namespace treejet;

namespace {

Simulation<3> quiet_simulation(const Deck& deck, Scene<3>& scene, const std::filesystem::path& directory) {
  return Simulation<3>(deck, system(scene),
                       {{directory, OutputFile::Existing::keep, true, false, {}, {}, nullptr},
                        [] { return StopRequest::go_on; },
                        nullptr});
}

}  // namespace

TEST_CASE("The summary's volumes and current are those of the beads that were inserted and have arrived") {
  const ScratchDirectory place;
  const Deck deck = read_deck(TREEJET_SOURCE_DIR "/validation/decks/stream.dat",
                              {"points 60", "final time 5.d-4", "timestep 1.d-6", "integrator heun",
                               "print xyz 1.d-4", "print xyz maxnum 20"});
  Scene<3> scene = compose<3>(deck.parameters, {1});
  Simulation<3> simulation = quiet_simulation(deck, scene, place.path);
  REQUIRE(simulation.finish());
  const std::string text = simulation.summary();
  CAPTURE(text);
  const auto number = [&](const char* pattern) {
    std::smatch found;
    REQUIRE(std::regex_search(text, found, std::regex(pattern)));
    return std::stod(found[1]);
  };
  const double inserted = number("([0-9]+) inserted"), arrived = number("([0-9]+) arrived");
  REQUIRE(arrived > 3);
  REQUIRE(inserted != arrived);
  const Scales s = scales(deck.parameters);
  const double microlitres = 1000 * s.mass / deck.parameters.density_mass;  // of a bead
  constexpr double digits = 1e-3;                                           // four are told
  CHECK(number("([0-9.e+-]+) uL arrived") == Approx(arrived * microlitres).epsilon(digits));
  const double flow = number("in the mean ([0-9.e+-]+) mL/h");  // beads an hour, in mL
  const double statcoulombs = flow / 3600 / (microlitres / 1000) * s.charge;
  CHECK(number("and ([0-9.e+-]+) nA") == Approx(statcoulombs / 2997924580 * 1e9).epsilon(2 * digits));
  CHECK_THAT(text, Catch::Contains("traj.xyz leaves out the beads nearest to the nozzle"));
}

TEST_CASE("The files of a run are as large as its plan says, to a third") {
  const ScratchDirectory place;
  const Deck deck = read_deck(TREEJET_SOURCE_DIR "/validation/decks/stream.dat",
                              {"points 400", "final time 5.d-4", "timestep 1.d-6", "integrator heun",
                               "inserting no", "removing no", "print time 1.d-6", "printstat list t x y z",
                               "print xyz 5.d-6", "print xyz maxnum 500", "print hdf5 1.d-6"});
  Scene<3> scene = compose<3>(deck.parameters, {1});
  Simulation<3> simulation = quiet_simulation(deck, scene, place.path);
  const double points = double(scene.jet.size()) + 1;  // and the nozzle
  REQUIRE(simulation.finish());
  const std::vector<OutputFileKind> files = output_files(deck.parameters);
  REQUIRE(files.size() == 5);
  for (const OutputFileKind& file : files) {
    if (std::string_view(file.name) == run_record_name) continue;  // goes by the deck's own words
    CAPTURE(file.name);
    const auto found = double(std::filesystem::file_size(place.path / file.name));
    // a number takes 3 to 15 places in traj.xyz, and in traj.h5 a third to two thirds of its bytes
    CHECK(found == Approx(file.bytes(deck.parameters, points)).epsilon(1. / 3));
  }
}
