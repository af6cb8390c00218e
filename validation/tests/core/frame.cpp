/// What a bead is in files, against CGS values worked out by hand: material, frame and the bytes of a plan.

#include "core/io/frame.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/io/atomic_file.hpp"
#include "core/io/frame_writer.hpp"
#include "core/io/output_files.hpp"
#include "validation/support/run.hpp"
#include "validation/support/scenes.hpp"
#include "validation/support/scratch_directory.hpp"

using namespace treejet;

namespace {

constexpr double round_off = 1e-14;  // of products of a few factors

/// Two beads on the axis, 0.75 and 0.25 elements of 0.1 cm from the nozzle, three having left before them.
Jet<3> two_beads(const Parameters& p) {
  const double l = groups(p).L_step;
  Jet<3> jet =
      jet_of<3>({Bead<3>({0.75 * l, 0, 0}, {3, 4, 5}, 2, 0.5, 1.5), Bead<3>({0.25 * l, 0, 0}, {1, 0, 0})});
  jet.volume << 0.8, 1;
  jet.removed = 3;
  return jet;
}

Parameters deck() {
  Parameters p = example("pvp");
  p.perturb = false;
  p.nozzle_velocity = 0;
  return p;
}

}  // namespace

TEST_CASE("A frame has the beads in CGS units, numbered since the start, and the nozzle as number 0") {
  const Parameters p = deck();
  const Scales s = scales(p);
  const Frame f = frame<3>(two_beads(p), Nozzle<3>(p), s, p.nozzle_cross);
  CHECK(f.id == std::vector<std::int64_t>{4, 5, 0});
  const auto &position = f.columns[0], &velocity = f.columns[1], &stress = f.columns[2],
             &charge = f.columns[3], &mass = f.columns[4], &radius = f.columns[5];
  REQUIRE(position.size() == 9);
  CHECK(position[0] == Approx(0.75 * s.l_step).epsilon(round_off));
  for (std::size_t k : {0u, 1u, 2u})
    CHECK(velocity[k] == Approx((3. + double(k)) * s.velocity).epsilon(round_off));
  CHECK(stress[0] == Approx(2 * p.elastic_modulus).epsilon(round_off));
  CHECK(charge[0] == Approx(1.5 * s.charge).epsilon(round_off));
  CHECK(mass[0] == Approx(0.5 * s.mass).epsilon(round_off));
  // pi a^2 l = pi a_0^2 l_step V: elements of half and of a quarter of l_step
  CHECK(radius[0] == Approx(p.nozzle_cross * std::sqrt(0.8 / 0.5)).epsilon(round_off));
  CHECK(radius[1] == Approx(p.nozzle_cross * std::sqrt(1 / 0.25)).epsilon(round_off));
  CHECK(position[6] == 0);
  CHECK(mass[2] == 0);
  CHECK(radius[2] == p.nozzle_cross);
}

TEST_CASE("Added columns are in their own unit, and what has left a bead is missing in its mass and radius") {
  const Parameters p = deck();
  Jet<3> jet = two_beads(p);
  const State<3> y = jet.y;
  jet.y = State<3>(2, own_columns<3> + 1);
  jet.y.leftCols<own_columns<3>>() = y;
  jet.y.col(own_columns<3>) << 0.4, 0.9;
  const Material material{
      {}, {Column{.name = "solvent", .unit = "g", .scale = 2.5, .at_birth = 0.9, .volume = 1}}};
  CHECK(material.remaining<3>(jet.y, 0) == Approx(0.5).epsilon(round_off));
  CHECK(material.remaining<3>(jet.y, 1) == 1);
  const Frame f = frame<3>(jet, Nozzle<3>(p), scales(p), p.nozzle_cross, material);
  REQUIRE(f.columns.size() == 7);
  CHECK(f.columns[6][0] == Approx(0.4 * 2.5).epsilon(round_off));
  CHECK(f.columns[6][2] == Approx(0.9 * 2.5).epsilon(round_off));
  CHECK(f.columns[4][0] == Approx(0.5 * 0.5 * scales(p).mass).epsilon(round_off));
  CHECK(f.columns[5][0] == Approx(p.nozzle_cross * std::sqrt(0.8 * 0.5 / 0.5)).epsilon(round_off));
}

TEST_CASE("While a bead is fed the youngest element in a frame has its volume, too") {
  Parameters p = deck();
  p.inserting = true;
  p.feed = Feed::flow;
  p.flow_rate = 1;
  Jet<3> jet = two_beads(p);
  jet.held = true;
  const Nozzle<3> nozzle(p);
  jet.t = 0.25 / nozzle.feed().flow();  // a quarter of a bead
  const Frame f = frame<3>(jet, nozzle, scales(p), p.nozzle_cross);
  CHECK(f.columns[5][1] == Approx(p.nozzle_cross * std::sqrt(1.25 / 0.25)).epsilon(round_off));
  CHECK(f.columns[5][0] == Approx(p.nozzle_cross * std::sqrt(0.8 / 0.5)).epsilon(round_off));
}

TEST_CASE("The stress in outputs has its viscous part, by the strain rate against the moving nozzle") {
  Parameters p = deck();
  p.nozzle_velocity = 3 * scales(p).velocity;
  const Nozzle<1> nozzle(p);
  Jet<1> jet = jet_of<1>({bead_at(2, 5, 0.7)});
  CHECK(strain_rate<1>(jet, nozzle, 0) == Approx((5. - 3) / 2).epsilon(round_off));
  const Material material{ViscousStress{.consistency = 0.5}};
  CHECK(material.stress<1>(jet, nozzle, 0) == Approx(0.7 + 0.5).epsilon(round_off));
}

TEST_CASE("The plan of a table grows by a row for each sample, the first and the last included") {
  Parameters p = deck();
  p.printstat_list = {"t", "x"};
  p.final_time = 1;
  const auto bytes = [&](double interval) {
    p.print_time = interval;
    return output_files(p).front().bytes(p, 10);
  };
  const double row = 2 * 24 + 1;  // of two numbers in 24 places each
  CHECK(bytes(0.25) - bytes(1) == Approx(3 * row));
  CHECK(bytes(1) - output_files(p).back().bytes(p, 10) == Approx(2 * row));  // besides the deck
}

TEST_CASE("The sign of the charge turns forces, not lengths") {
  Parameters p = deck();
  const Scales plus = scales(p);
  p.density_charge *= -1;
  const Scales minus = scales(p);
  CHECK(minus.length == plus.length);
  CHECK(minus.charge == -plus.charge);
  CHECK(groups(p).H > 0);
}

TEST_CASE("Only the first frame of an XYZ file names the program, and all have as many lines") {
  const ScratchDirectory place;
  const Parameters p = deck();
  const auto written = [&](const FrameFormat& format) {
    const auto file = place.path / format.name;
    const auto writer = format.writer({file, OutputFile::Existing::keep, "treejet 1", 5});
    for (int k = 0; k < 3; ++k) {
      Frame f = frame<3>(two_beads(p), Nozzle<3>(p), scales(p), p.nozzle_cross);
      f.step = k;
      writer->write(f);
    }
    writer->finish();
    return read_whole(file);
  };
  const auto count = [](const std::string& text, const std::string& word) {
    int found = 0;
    for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
    return found;
  };
  const std::string xyz = written(frame_formats[0]), csv = written(frame_formats[2]);
  CHECK(count(xyz, "program=") == 1);
  CHECK(count(xyz, "\n") == 3 * (2 + 5));
  CHECK(csv.find("\n2,") != std::string::npos);  // the third frame
  CHECK(count(csv, ",0,") >= 3);                 // the nozzle's id behind the time
}
