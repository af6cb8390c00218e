#include "integrators/run/error_estimate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "core/base/error.hpp"
#include "core/deck/observable_keys.hpp"
#include "core/jet/scales.hpp"
#include "core/observe/output_table.hpp"
#include "core/observe/steady_mean.hpp"
#include "integrators/run/integration.hpp"

namespace treejet {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

std::string key_of(const std::string& label) {
  return label.substr(0, label.find('['));
}

bool is_time(const std::string& label) {
  const std::string key = key_of(label);
  return key == "t" || key == "ts";
}

bool is_of_wall_clock(const std::string& label) {
  return has(key_of(label), wall_clock);
}

/// Of the rows from `begin` on that have a value.
double mean_from(const TableOfRows& table, std::size_t column, std::size_t begin) {
  double sum = 0, count = 0;
  for (std::size_t row = begin; row < table.rows.size(); ++row) {
    const double value = table.rows[row][column];
    if (std::isfinite(value)) sum += value, ++count;
  }
  return count > 0 ? sum / count : none;
}

/// As the summary of the run takes it (core/observe/steady_mean.hpp), `start` counted in rows of the table.
SteadyMean mean_of_run(const TableOfRows& table, std::size_t column) {
  if (!has_mean(key_of(table.labels[column]))) return {none, none};
  std::vector<double> series;  // the first row, the state at the start, is in no mean
  for (std::size_t row = 1; row < table.rows.size(); ++row) series.push_back(table.rows[row][column]);
  SteadyMean mean = steady_mean(series);
  ++mean.start;
  return mean;
}

double greatest(const TableOfRows& table, std::size_t column) {
  double most = none;
  for (const auto& row : table.rows)
    if (std::isfinite(row[column]))
      most = std::isfinite(most) ? std::max(most, std::abs(row[column])) : std::abs(row[column]);
  return most;
}

}  // namespace

void expect_estimable(const Parameters& p) {
  if (p.printstat_list.empty())
    throw InputError("--estimate-error: the deck has no printstat list, whose rows it is for");
}

Parameters finer(Parameters p) {
  if (p.tolerance) *p.tolerance /= 10;
  if (p.timestep) {
    p.print_time = print_interval(p);  // by default so many steps
    *p.timestep /= 2;
  }
  return p;
}

std::string finer_description(const Parameters& p) {
  const Parameters q = finer(p);
  return q.tolerance ? fmt::format("a run at tolerance {:g}", *q.tolerance)
                     : fmt::format("a run in steps of {:g} s", *q.timestep);
}

TableOfRows read_rows(const std::filesystem::path& statdat) {
  std::ifstream file(statdat);
  TableOfRows table;
  std::string line, word;
  while (std::getline(file, line)) {
    if (line.starts_with("#")) {
      if (table.labels.empty())
        for (std::istringstream words(line.substr(1)); words >> word;) table.labels.push_back(word);
      continue;
    }
    auto& row = table.rows.emplace_back();
    for (std::istringstream words(line); words >> word;) row.push_back(std::strtod(word.c_str(), nullptr));
    if (row.size() != table.labels.size())
      throw FileError(fmt::format("{}: was changed by another program during the run", statdat.string()));
  }
  if (table.rows.empty()) throw FileError(fmt::format("{}: cannot be read", statdat.string()));
  return table;
}

template <int D>
std::optional<TableOfRows> rows_of_run(const Parameters& p, Scene<D>& scene, const OwnObservables<D>& own,
                                       std::function<bool()> stop_here) {
  struct Keep final : RowSink {
    explicit Keep(TableOfRows& to) : table(to) {}
    void row(const std::vector<double>& values) override { table.rows.push_back(values); }
    TableOfRows& table;
  };
  TableOfRows table{labels(p.printstat_list, own), {}};
  Recorder<D> recorder(
      Recorder<D>::setting(p, scene.nozzle, scene.collector, scene.force_error(), scene.columns));
  recorder.sample_all(scene.decomposition());
  recorder.add(p.printstat_list, std::make_unique<Keep>(table), own);
  Integration<D> integration(p, system(scene), {&recorder}, std::move(stop_here));
  if (!integration.march.to(p.final_time / scales(p).time)) return std::nullopt;
  return table;
}

template std::optional<TableOfRows> rows_of_run<1>(const Parameters&, Scene<1>&, const OwnObservables<1>&,
                                                   std::function<bool()>);
template std::optional<TableOfRows> rows_of_run<3>(const Parameters&, Scene<3>&, const OwnObservables<3>&,
                                                   std::function<bool()>);

TableOfRows difference(const TableOfRows& first, const TableOfRows& second) {
  TableOfRows table;
  std::vector<std::size_t> kept;
  for (std::size_t k = 0; k < first.labels.size(); ++k) {
    if (is_of_wall_clock(first.labels[k])) continue;
    kept.push_back(k);
    table.labels.push_back(first.labels[k]);
  }
  // one may end early, when the jet has left
  for (std::size_t row = 0; row < std::min(first.rows.size(), second.rows.size()); ++row) {
    auto& to = table.rows.emplace_back();
    for (const std::size_t k : kept) {
      const double a = first.rows[row][k], b = second.rows[row][k];
      to.push_back(is_time(first.labels[k]) ? a : a - b);
    }
  }
  return table;
}

std::vector<ErrorOfObservable> errors(const TableOfRows& first, const TableOfRows& differences) {
  std::vector<ErrorOfObservable> all;
  for (std::size_t k = 0; k < differences.labels.size(); ++k) {
    const std::string& label = differences.labels[k];
    if (is_time(label)) continue;
    const auto place = std::find(first.labels.begin(), first.labels.end(), label) - first.labels.begin();
    const SteadyMean mean = mean_of_run(first, static_cast<std::size_t>(place));
    const bool any = mean.values > 0;
    all.push_back({label, greatest(differences, k), mean.mean,
                   any ? std::abs(mean_from(differences, k, static_cast<std::size_t>(mean.start))) : none,
                   any ? mean.start : 0, mean.steady});
  }
  return all;
}

std::string errors_text(const std::vector<ErrorOfObservable>& errors, const std::string& against) {
  std::string text = fmt::format("errors, from {}:\n{:>16}{:>16}{:>20}{:>16}\n", against, "",
                                 "of a row, most", "mean", "of that mean");
  for (const ErrorOfObservable& e : errors) {
    text += fmt::format("{:>16}{:>16.2g}", e.label, e.of_a_row);
    if (std::isfinite(e.mean))
      text += fmt::format("{:>20.8g}{:>16.2g}  rows from {} on{}", e.mean, e.of_mean, e.from_row,
                          e.steady ? "" : ", not steady");
    text += "\n";
  }
  return text;
}

std::string rows_text(const TableOfRows& table, const std::string& against) {
  std::string text = "#";
  for (const auto& label : table.labels) text += " " + label;
  text += fmt::format("\n## statdat.dat minus the rows of {}\n", against);
  for (const auto& row : table.rows) text += row_text(row);
  return text;
}

}  // namespace treejet
