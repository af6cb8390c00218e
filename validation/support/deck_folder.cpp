#include "validation/support/deck_folder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <set>

#include "core/base/error.hpp"
#include "core/base/lines.hpp"
#include "core/deck/deck.hpp"
#include "validation/support/run.hpp"

namespace treejet {

namespace {

namespace fs = std::filesystem;

const std::vector<std::string> keys = {"n", "vn", "vc", "angl", "lp", "rc"};

std::vector<fs::path> decks_in(const fs::path& directory) {
  std::vector<fs::path> decks;
  std::error_code unreadable;
  for (const auto& file : fs::directory_iterator(directory, unreadable))
    if (file.path().extension() == ".dat") decks.push_back(file.path());
  if (decks.empty()) throw FileError(directory.string() + ": no decks (*.dat) there");
  std::sort(decks.begin(), decks.end());
  return decks;
}

/// What the paper's jet does not have.
template <int D>
std::string needs(const Scene<D>& scene) {
  const std::set<std::string> of_paper = {"Maxwell stress",          "viscoelastic force",
                                          "external field",          "gravity",
                                          "surface tension",         "Coulomb sum over all pairs",
                                          "insertion at the nozzle", "removal at the collector",
                                          "circling nozzle",         "two rates"};
  std::vector<std::string> others;
  for (const auto& part : scene.composed)
    if (!of_paper.contains(part.term)) others.push_back(part.term);
  return fmt::format("{}", fmt::join(others, ", "));
}

/// Without an interval that has the value there is no mean.
double mean_of_second_half(const std::vector<std::vector<double>>& rows, std::size_t key) {
  double sum = 0, count = 0;
  for (std::size_t k = rows.size() / 2; k < rows.size(); ++k)
    if (std::isfinite(rows[k][key])) sum += rows[k][key], ++count;
  return count > 0 ? sum / count : std::nan("");
}

struct Rows final : RowSink {
  explicit Rows(std::vector<std::vector<double>>& to) : kept(to) {}
  void row(const std::vector<double>& values) override { kept.push_back(values); }
  std::vector<std::vector<double>>& kept;
};

template <int D>
void run_deck(const std::string& name, const Parameters& p, double seconds, ResultTable& table) {
  constexpr double windows = 500;
  Run<D> run(p);
  std::vector<std::vector<double>> rows;
  auto setting = Recorder<D>::setting(p, run.scene.nozzle, run.scene.collector, run.scene.force_error(),
                                      run.scene.columns);
  setting.interval = p.final_time / windows / run.unit.time;
  Recorder<D> recorder(setting);
  recorder.add(keys, std::make_unique<Rows>(rows));
  const std::clock_t started = std::clock();
  const auto over = [&] { return double(std::clock() - started) / CLOCKS_PER_SEC > seconds; };
  std::string end;
  Integration<D> integration(p, system(run.scene), {&recorder}, over);
  try {
    integration.march.to(p.final_time / run.unit.time);
  } catch (const NumericalError& e) {
    end = e.what();
  }
  std::vector<Cell> cells = {name, needs(run.scene), run.jet().t * run.unit.time};
  for (std::size_t key = 0; key < keys.size(); ++key) cells.emplace_back(mean_of_second_half(rows, key));
  cells.emplace_back(end);
  table.row(cells);
}

/// The findings without the file's name, one after the other.
std::string reasons(const std::string& message, const std::string& file) {
  std::vector<std::string> all;
  for (const std::string_view line : lines_of(message)) {
    std::string_view reason = line;
    if (reason.starts_with(file)) reason.remove_prefix(reason.find(": ") + 2);
    all.emplace_back(reason);
  }
  return fmt::format("{}", fmt::join(all, "; "));
}

}  // namespace

void run_decks(const DeckFolder& folder, Report& report) {
  const std::vector<fs::path> decks = decks_in(folder.directory);
  auto table = report.table("decks", "Decks of " + folder.directory.string(),
                            {"deck", "needs", "t [s]", "beads", "vn [cm/s]", "vc [cm/s]", "aperture [deg]",
                             "path [cm]", "radius [cm]", "refused or ended"});
  int run = 0;
  for (const fs::path& path : decks) {
    const std::string name = path.stem().string();
    try {
      Parameters p = read_deck(path.string()).parameters;
      if (!folder.as_written) {
        p.integrator = Scheme::automatic;
        p.timestep.reset();
        p.tolerance = 1e-6;
      }
      p.system == 1 ? run_deck<1>(name, p, folder.seconds, table)
                    : run_deck<3>(name, p, folder.seconds, table);
      ++run;
    } catch (const InputError& e) {
      std::vector<Cell> cells = {name, std::string()};
      cells.insert(cells.end(), 7, std::nan(""));
      cells.emplace_back(reasons(e.what(), path.string()));
      table.row(cells);
    }
  }
  fmt::print("{} of {} decks run\n", run, decks.size());
}

}  // namespace treejet
