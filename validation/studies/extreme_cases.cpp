#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <sstream>

#include "core/base/error.hpp"
#include "core/jet/field_map.hpp"
#include "core/jet/scales.hpp"
#include "validation/support/experiment.hpp"
#include "validation/support/studies.hpp"

namespace treejet {

namespace {

/// What the program owes: x of the oldest bead at the end, a stop with exit code 2 or 3, or either of the
/// two.
struct Answer {
  double x, allowed;  ///< cm
  bool or_stop = false;
};

struct Extreme {
  std::string name;
  std::string deck;
  std::vector<std::string> overrides;
  std::optional<Answer> answer;  ///< empty: a stop
  std::vector<Alteration> alterations = {};
  std::shared_ptr<const FieldMap> map = {};  ///< in place of the plates
};

std::vector<std::string> printing(std::vector<std::string> overrides) {
  overrides.insert(overrides.end(), {"printstat list t x", "print list t x"});
  return overrides;
}

/// Where no closed answer is known: two schemes agree. core/jet/error_norm.hpp says what the examples'
/// tolerance 1e-6 allows.
Answer as_in_another_scheme(const std::string& deck, const std::vector<std::string>& overrides) {
  const Parameters p = example(deck, overrides);
  const Outcome o = experiment(with(p, {.scheme = Scheme::dopri5, .tolerance = 1e-10}));
  return {o.x(), 1e-5 * p.collector_distance};
}

Answer or_stop(Answer a) {
  a.or_stop = true;
  return a;
}

std::vector<Extreme> extreme_states() {
  const double L = scales(example("single-bead")).length, nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::string> alone = {"integrator auto", "tolerance 1e-6"},
                                 four = {"points 4", "final time 0.001", "print time 1e-5"},
                                 three = {"points 3", "final time 0.01", "print time 1e-3"};
  const double l = groups(example("pvp", four)).L_step,
               l_straight = groups(example("straight-jet", three)).L_step;
  return {{"a single bead", "single-bead", alone, Answer{95.85942443 * L, 1e-4}},
          // it falls freely: V t^2 / 2 = 100, scaled
          {"an element stretched a million times",
           "single-bead",
           alone,
           Answer{(1e6 + 100) * L, 1e-4},
           {{0, 0, 1e6}}},
          {"a stress that is not a number", "pvp", four, {}, {{1, 6, nan}}},
          {"two beads in one place", "pvp", four, {}, {{1, 0, 4 * l}}},
          {"beads in the wrong order", "straight-jet", three, {}, {{0, 0, 1.5 * l_straight}}}};
}

std::vector<Extreme> extreme_decks() {
  using Lines = std::vector<std::string>;
  const Lines uncharged = {"density charge 0", "final time 0.01", "print time 1e-3"},
              no_field = {"external potential 0", "final time 0.05", "print time 1e-2"},
              many = {"initial length 15", "points 3000", "final time 1e-5", "print time 1e-6"},
              // the paper's listing, in JETSPIN with this step
      dense = {"density charge 37607.35",
               "density mass 8.1991e-1",
               "external potential 277.8141",
               "integrator 3",
               "timestep 1e-6",
               "events step",
               "final time 0.01",
               "print time 1e-3"},
              storm = {"airdrag yes", "airdrag model full", "airdrag airvelocity -3.e4", "final time 0.002",
                       "print time 1e-3"},
              hum = {"field wave square", "field frequency 1.e5", "final time 0.002", "print time 1e-3"},
              outrun = {"points 4", "perturb ampl 7e-3", "final time 0.001", "print time 1e-4"};
  return {
      {"no charge", "pvp", uncharged, as_in_another_scheme("pvp", uncharged)},
      {"no viscosity", "pvp", {"viscosity 0"}, {}},
      {"no elastic modulus", "pvp", {"elastic modulus 0"}, {}},
      {"three thousand beads at once", "pvp", many, as_in_another_scheme("pvp", many)},
      {"a jet that never arrives", "straight-jet", no_field, as_in_another_scheme("straight-jet", no_field)},
      {"ten times the charge density", "straight-jet", dense, Answer{40.057, 5e-4}},
      {"tolerance 1e-14, case 1",
       "single-bead",
       {"integrator auto", "tolerance 1e-14"},
       or_stop({95.85942443 * scales(example("single-bead")).length, 1e-8})},
      {"tolerance 1e-14, case 3",
       "pvp",
       {"tolerance 1e-14", "final time 0.005", "print time 1e-3"},
       or_stop({7.692060, 1e-6})},
      {"a thousand times the largest stable timestep, case 2",
       "straight-jet",
       {"integrator 3", "timestep 0.04", "final time 0.2", "print time 0.04"},
       {}},
      {"a thousand times the largest stable timestep, case 3",
       "pvp",
       {"integrator 3", "timestep 5e-3", "final time 0.05", "print time 0.005"},
       {}},
      {"a storm of 300 m/s from the collector", "pvp", storm, as_in_another_scheme("pvp", storm)},
      {"a potential that goes on and off a hundred times a bead", "pvp", hum,
       as_in_another_scheme("pvp", hum)},
      {"insertion due at the start", "pvp", outrun, as_in_another_scheme("pvp", outrun)}};
}

/// Each term that a deck may name, far beyond where one would: stiff, fast, or all but absent.
std::vector<Extreme> extreme_terms() {
  struct Scene {
    const char* name;
    std::vector<std::string> lines;
    bool stops = false;
  };
  const Scene scenes[] = {
      {"slender elements ten thousand times as stiff",
       {"model slender", "flow rate 1.735e-2", "elastic modulus 5e8"}},
      {"a pump that gives a nanolitre a second", {"model slender", "flow rate 1e-6"}},
      {"a rod of 0.4 mm that resists bending", {"bending yes", "nozzle cross 0.02"}},
      {"a fibre of 0.4 um in wind",
       {"airdrag yes", "airdrag model full", "nozzle cross 2e-5", "airdrag airvelocity 100"}},
      {"random pushes to 100 m/s", {"noise yes", "noise variance 1e8", "noise diffusivity 1e12"}},
      {"a jet that dries before it leaves",
       {"evaporation yes", "evaporation polymer frac 0.06", "evaporation diffusivity 1e6"}},
      {"a jet that has next to no polymer, and dries",
       {"evaporation yes", "evaporation model vapour", "evaporation polymer frac 1e-3",
        "evaporation diffusivity 1e3"}},
      {"FENE-P dumbbells that are all but rigid", {"stress law fene-p", "stress law extensibility 1.81"}},
      {"an Oldroyd fluid a hundred times as stiff", {"stress law oldroyd-b", "elastic modulus 5e6"}},
      {"a Giesekus fluid a hundred times as stiff",
       {"stress law giesekus", "stress law mobility 1", "elastic modulus 5e6"}},
      {"a Kelvin-Voigt jet like steel", {"stress law kelvin-voigt", "elastic modulus 5e8"}},
      {"a power-law fluid of index 0.1",
       {"stress law power-law", "hbfluid consistency 1", "hbfluid index 0.1"}},
      {"a yield stress no jet reaches",
       {"stress law herschel-bulkley", "yield stress 1e9", "hbfluid consistency 1", "hbfluid index 0.5"}},
      {"a capacitor that is full at once", {"field wave rc", "field time 1e-9", "field frequency 1e4"}},
      {"a needle sharper than an atom", {"field needle 1e-9"}},
      {"a magnetic field of 100 MT", {"magnetic field 0 0 1e12"}},
      {"a magnetic field beyond all ends", {"magnetic field 0 1e300 0"}, /*stops*/ true},
      {"softened charges of thick beads", {"coulomb law softened", "dragvel no", "nozzle cross 0.02"}}};
  std::vector<Extreme> extremes;
  for (const Scene& s : scenes) {
    std::vector<std::string> lines = s.lines;
    lines.insert(lines.end(), {"final time 0.001", "print time 2e-4"});
    const auto answer = [&] { return as_in_another_scheme("pvp", lines); };
    extremes.push_back({s.name, "pvp", lines, s.stops ? std::nullopt : std::make_optional(answer())});
  }
  return extremes;
}

/// The potential of the plates, statV, and `wave` of it in layers a spacing thick, from behind the nozzle to
/// `end`.
std::shared_ptr<const FieldMap> map_of_plates(const Parameters& p, double wave, double end) {
  FieldMap::Grid grid{{35, 5, 5}, {-1, -20, -20}, {(end + 1) / 34, 10, 10}};
  std::vector<double> potential;
  for (int k = 0; k < 5 * 5 * grid.size[0]; ++k) {
    const int layer = k % grid.size[0];
    const double x = grid.origin[0] + layer * grid.spacing[0];
    potential.push_back(p.external_potential * (1 - x / p.collector_distance + (layer % 2 ? wave : -wave)));
  }
  return std::make_shared<FieldMap>(grid, potential, "map of plates");
}

Parameters mapped(Parameters p, const std::shared_ptr<const FieldMap>& map) {
  if (map) p.field_map = map->name(), p.map = map;
  return p;
}

std::vector<Extreme> extreme_maps() {
  const std::vector<std::string> lines = {"final time 0.002", "print time 1e-3"};
  const Parameters p = example("pvp", lines);
  const auto layers = map_of_plates(p, 10, 17);
  const Outcome among_layers =
      experiment(with(mapped(p, layers), {.scheme = Scheme::dopri5, .tolerance = 1e-10}));
  return {{"a map of plates", "pvp", lines, as_in_another_scheme("pvp", lines), {}, map_of_plates(p, 0, 17)},
          {"a map in layers of ten times the plates' potential",
           "pvp",
           lines,
           Answer{among_layers.x(), 1e-5 * p.collector_distance},
           {},
           layers},
          {"a map that ends before the jet does", "pvp", lines, {}, {}, map_of_plates(p, 0, 0.5)}};
}

/// White noise has steps of a given length, within which nothing is located: a bead is released up to a step
/// late, which at 1e3 cm/s is 2e-5 cm, and 20 are released.
std::vector<Extreme> extreme_noise() {
  using Lines = std::vector<std::string>;
  const Lines to_1_ms = {"final time 0.001", "print time 2e-4"};
  const auto white = [&](const Lines& lines) {
    Lines all = {"integrator sra1", "timestep 2e-8", "noise yes"};
    std::ranges::copy(lines, std::back_inserter(all));
    std::ranges::copy(to_1_ms, std::back_inserter(all));
    return all;
  };
  Answer without_noise = as_in_another_scheme("pvp", to_1_ms);
  without_noise.allowed = 1e-3;
  return {{"white noise fainter than round-off", "pvp", white({"noise diffusivity 1e-30"}), without_noise},
          {"white noise in syrup that stops a bead in a thousandth of a step",
           "pvp",
           white({"noise diffusivity 1e12", "noise variance 20"}),
           {}}};
}

/// What is to be said against the table that a run left, if anything: a broken line, or an end before its
/// time.
std::string fault_of_table(const std::filesystem::path& file, double t_end, double interval) {
  std::ifstream in(file);
  std::string line, header;
  std::getline(in, header);
  double t = 0;
  while (std::getline(in, line)) {
    if (line.starts_with('#')) continue;
    std::istringstream fields(line);
    double x;
    if (in.eof() || !(fields >> t >> x) || !std::isfinite(x)) return "its table has a broken line: " + line;
  }
  if (t_end - t > 1.000001 * interval) return fmt::format("its table ends at {} s", t);
  return "";
}

Outcome outcome(const Extreme& e, const std::filesystem::path& directory) {
  try {
    Setup setup{.alterations = e.alterations, .most_evaluations = 2'000'000, .results = directory};
    return experiment(mapped(example(e.deck, printing(e.overrides)), e.map), setup);
  } catch (const Error& error) {
    Outcome o;
    o.exit_code = error.exit_code();
    o.message = error.what();
    return o;
  }
}

/// "right", "stop", or what is wrong.
std::string verdict(const Extreme& e, const Outcome& o) {
  if (o.done()) {
    if (!e.answer) return "went on as if nothing were wrong";
    if (std::abs(o.x() - e.answer->x) <= e.answer->allowed) return "right answer";
    return fmt::format("wrong answer: {:.6g} instead of {:.6g} cm", o.x(), e.answer->x);
  }
  if (o.exit_code == Outcome::given_up) return "does not end";
  return e.answer && !e.answer->or_stop ? "stopped, though there is an answer" : "clear stop";
}

}  // namespace

void study_extreme_cases(Report& report) {
  report.section({"Extreme cases",
                  "Decks and states at the edge of what can be simulated: a right answer, or a clear stop "
                  "that leaves its files whole.",
                  "treejet-validate stability --out DIR"});
  auto table = report.table("extreme_cases", "Extreme cases",
                            {"case", "what happened", "exit code", "t [s]", "message"});
  auto all = extreme_states();
  std::ranges::move(extreme_decks(), std::back_inserter(all));
  std::ranges::move(extreme_terms(), std::back_inserter(all));
  std::ranges::move(extreme_maps(), std::back_inserter(all));
  std::ranges::move(extreme_noise(), std::back_inserter(all));
  for (std::size_t k = 0; k < all.size(); ++k) {
    report.progress("extreme cases", int(k), int(all.size()));
    const Extreme& e = all[k];
    const auto files = report.directory() / "extreme";
    const Outcome o = outcome(e, files);
    std::string what = verdict(e, o);
    const bool good = what == "right answer" || what == "clear stop";
    std::string fault;
    if (o.exit_code != 2) {
      fault = fault_of_table(files / "statdat.dat", o.t, print_interval(example(e.deck, e.overrides)));
    }
    if (!fault.empty()) what += "; " + fault;
    table.row({e.name, what, std::int64_t(o.exit_code), o.t, o.message});
    report.check(fmt::format("{}: right answer or clear stop, files complete", e.name), good && fault.empty(),
                 1, 1);
  }
}

}  // namespace treejet
