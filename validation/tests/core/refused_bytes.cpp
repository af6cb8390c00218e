/// What files and decks may hold, but nobody writes: each the smallest input of a fault that a fuzzer, or a
/// look at a reader for one, has found; and what is taken of a state that is sound.

#include <Eigen/Core>
#include <catch2/catch.hpp>
#include <limits>

#include "core/base/error.hpp"
#include "core/deck/directives.hpp"
#include "core/deck/units.hpp"
#include "core/io/h5md_trajectory.hpp"
#include "core/jet/scales.hpp"
#include "core/restart/origin.hpp"
#include "validation/support/example.hpp"
#include "validation/support/scratch_directory.hpp"

using namespace treejet;

namespace {

template <class... T>
std::string written(T... values) {
  return Archive::bytes_of(values...);
}

/// A checkpoint in a new directory, of a jet as a whipping jet's march begins with it.
std::filesystem::path checkpoint_of(const std::filesystem::path& directory, const Jet<3>& jet) {
  const Deck deck = read_deck(source_tree() + "/examples/pvp/input.dat");
  Checkpoint checkpoint{"program", deck.name, deck.text, {}, 0.1, 0, {}, {}};
  Jet<3> part = jet;
  checkpoint.state.part("march", part);
  Checkpoints(directory, OutputFile::Existing::keep).write(checkpoint);
  return directory / "checkpoint";
}

Jet<3> jet_of_a_checkpoint(const std::filesystem::path& file) {
  return jet_of<3>(origin(file.string()), example("pvp"));
}

std::filesystem::path trajectory_of(const std::filesystem::path& directory,
                                    const std::vector<std::int64_t>& ids) {
  H5md::Content content;
  content.made_by.deck = read_deck(source_tree() + "/examples/pvp/input.dat").text;
  content.keys = {"x"};
  Frame frame;
  frame.id = ids;
  for (const FrameColumn& column : frame_columns())
    frame.columns.emplace_back(ids.size() * static_cast<std::size_t>(column.width), 1.0);
  H5mdTrajectory file(directory / "traj.h5", content, OutputFile::Existing::keep);
  file.append(frame);
  file.finish();
  return directory / "traj.h5";
}

}  // namespace

TEST_CASE("A byte that is neither 0 nor 1 does not become a bool of a state") {
  bool truth = false;
  const std::string one = written(static_cast<unsigned char>(1)),
                    two = written(static_cast<unsigned char>(2));
  Archive{one}(truth);
  CHECK(truth);
  CHECK(one == written(true));
  Archive archive(two);
  CHECK_THROWS_AS(archive(truth), FileError);
}

TEST_CASE("A table of no columns does not have more rows than its state has bytes") {
  Eigen::ArrayXXd table;
  const std::string many = written(std::int64_t(0), std::size_t(1) << 60),
                    three = written(Eigen::ArrayXXd(3, 0));
  Archive archive(many);
  CHECK_THROWS_AS(archive(table), FileError);
  CHECK(table.rows() == 0);
  Archive{three}(table);
  CHECK(table.rows() == 3);
}

TEST_CASE("A list of pieces is not made for more of them than the sizes in front of each would fill") {
  // 24 bytes of state behind the count: three sizes, and nothing in the pieces
  const std::string bytes = written(std::size_t(4)) + std::string(24, '\0');
  std::vector<std::string> pieces;
  Archive archive(bytes);
  CHECK_THROWS_AS(archive(pieces), FileError);
  CHECK(pieces.empty());
}

TEST_CASE("A run does not begin with a checkpoint whose beads lack a mass, an id or a column") {
  const ScratchDirectory place;
  Jet<3> jet;
  append(jet, Bead<3>({1, 0, 0}, {1, 0, 0}));
  append(jet, Bead<3>({0.5, 0, 0}, {1, 0, 0}));
  CHECK(jet_of_a_checkpoint(checkpoint_of(place.path / "whole", jet)).size() == 2);
  Jet<3> without_mass = jet, with_one_id = jet, with_a_column = jet;
  without_mass.mass.conservativeResize(1);
  with_one_id.id.setOnes(1);
  with_a_column.y.conservativeResize(2, own_columns<3> + 1);
  CHECK_THROWS_AS(jet_of_a_checkpoint(checkpoint_of(place.path / "mass", without_mass)), InputError);
  CHECK_THROWS_AS(jet_of_a_checkpoint(checkpoint_of(place.path / "id", with_one_id)), InputError);
  CHECK_THROWS_AS(jet_of_a_checkpoint(checkpoint_of(place.path / "column", with_a_column)), InputError);
}

TEST_CASE("Beads that a run begins with are in CGS what they were, whatever the scales of its deck") {
  const ScratchDirectory place;
  Jet<3> jet;
  append(jet, Bead<3>({1, 0, 0}, {1, 0, 0}, 0.3, 2, 3));
  jet.volume[0] = 1.5;
  const auto file = checkpoint_of(place.path, jet);
  const Parameters before = example("pvp");
  const Parameters after = example("pvp", {"elastic modulus 90000.", "viscosity 7.", "nozzle cross 6.d-3",
                                           "density mass 1.1", "density charge 30000."});
  const Scales from = scales(before), to = scales(after);
  const Jet<3> begun = jet_of<3>(origin(file.string()), after);
  constexpr double rounding = 1e-14;  // a quotient and two products
  CHECK(begun.y(0, 0) * to.length == Approx(from.length).epsilon(rounding));
  CHECK(begun.y(0, velocity_column<3>) * to.velocity == Approx(from.velocity).epsilon(rounding));
  CHECK(begun.y(0, stress_column<3>) * to.stress == Approx(0.3 * from.stress).epsilon(rounding));
  CHECK(begun.mass[0] * to.mass == Approx(2 * from.mass).epsilon(rounding));
  CHECK(begun.charge[0] * to.charge == Approx(3 * from.charge).epsilon(rounding));
  CHECK(begun.volume[0] * to.mass / after.density_mass ==
        Approx(1.5 * from.mass / before.density_mass).epsilon(rounding));
}

TEST_CASE("A run does not begin with a frame without points, or with beads of no number") {
  const ScratchDirectory place;
  const auto begun = [&](const char* name, const std::vector<std::int64_t>& ids) {
    return jet_of<3>(origin(trajectory_of(place.path / name, ids).string()), example("pvp"));
  };
  CHECK(begun("two", {1, 2, 0}).size() == 2);
  CHECK_THROWS_AS(begun("none", {}), InputError);
  CHECK_THROWS_AS(begun("lowest", {std::numeric_limits<std::int64_t>::min(), 0}), InputError);
}

TEST_CASE("Powers beyond nine make no unit, the lowest that there is among them") {
  CHECK_FALSE(unit("m-2147483648"));
  CHECK_FALSE(unit("m-10"));
  CHECK_FALSE(unit("m10"));
  CHECK(unit("m-9"));
}

TEST_CASE("A message about a file in a deck shows its name without commands to the terminal") {
  Parameters p;
  const std::vector<std::string> words{"\x1b[2J", "b"};
  const std::string message = assign(directive("field map"), words, p);
  CHECK(message == "expected nothing after '\\x1b[2J', found 'b'");
}
