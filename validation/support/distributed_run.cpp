#include "validation/support/distributed_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <sstream>

#include "forces/coulomb/solver/coulomb_solver.hpp"
#include "validation/support/machine.hpp"
#include "validation/support/rank_volume.hpp"

namespace treejet {

namespace {

constexpr int samples = 1024;
constexpr int steps = 200'000;  ///< in which the length of a curve is measured

std::array<double, 3> jet(double s) {
  const double radius = 5 * std::pow(s, 1.5), phi = 80 * std::numbers::pi * s;
  return {16 * s, radius * std::cos(phi), radius * std::sin(phi)};
}

std::array<double, 3> dense_coil(double s) {
  const double phi = 2000 * std::numbers::pi * s;
  return {10 * s, std::cos(phi), std::sin(phi)};
}

/// Relative L2 at points that are spread over the whole chain, against exact sums.
double error(int n, Rows rows, const PointSet& own, const FieldSet& field, const Ranks& ranks) {
  constexpr std::size_t columns = 3;
  std::vector<double> place(samples * columns), exact = place, found = place;
  const auto at = [&](int k) {
    const double jitter = 0.618033988749895 * k;  // golden ratio: in step with no turn
    return static_cast<int>((k + jitter - std::floor(jitter)) * n / samples);
  };
  for (std::size_t k = 0; k < samples; ++k) {
    const int i = at(static_cast<int>(k)) - rows.first;
    for (std::size_t e = 0; e < columns && i >= 0 && i < rows.size(); ++e) {
      place[columns * k + e] = own.r[e][static_cast<std::size_t>(i)];
      found[columns * k + e] = field.e[e][static_cast<std::size_t>(i)];
    }
  }
  ranks.sum(place);  // one rank has each, the others 0
  ranks.sum(found);
  for (std::size_t k = 0; k < samples; ++k)
    for (std::size_t j = 0; j < own.q.size(); ++j) {
      if (rows.first + static_cast<int>(j) == at(static_cast<int>(k))) continue;
      const double x = place[3 * k] - own.r[0][j], y = place[3 * k + 1] - own.r[1][j],
                   z = place[3 * k + 2] - own.r[2][j], d2 = x * x + y * y + z * z;
      const double w = own.q[j] / (d2 * std::sqrt(d2));
      exact[3 * k] += w * x, exact[3 * k + 1] += w * y, exact[3 * k + 2] += w * z;
    }
  ranks.sum(exact);
  double difference = 0, size = 0;
  for (std::size_t k = 0; k < exact.size(); ++k) {
    difference += std::pow(found[k] - exact[k], 2);
    size += std::pow(exact[k], 2);
  }
  return std::sqrt(difference / size);
}

/// Whether what this rank sent in an evaluation is what the model says.
bool as_modelled(const RankTraffic& counted, const LongChain& chain, const std::vector<int>& borders,
                 const TreeShape& shape, const Ranks& ranks) {
  if (ranks.size() == 1) return counted == RankTraffic();
  const auto of = [&](int k) {
    return chain.points(borders.back(), {borders[index(k)], borders[index(k + 1)]});
  };
  return counted == traffic_of(ranks.size(), of, shape)[index(ranks.rank())];
}

}  // namespace

LongChain::LongChain(const std::string& kind) : curve_(kind == "coil" ? dense_coil : jet), length_{0} {
  auto last = curve_(0);
  for (int k = 1; k <= steps; ++k) {
    const auto next = curve_(double(k) / steps);
    length_.push_back(length_.back() + std::hypot(next[0] - last[0], next[1] - last[1], next[2] - last[2]));
    last = next;
  }
}

PointSet LongChain::points(int n, Rows rows, int stride, int run) const {
  PointSet set;
  for (int i = rows.first; i < rows.last; ++i) {
    if ((i - rows.first) / run % stride != 0) continue;
    const double at = length_.back() * (i + 0.5) / n;
    const auto k =
        static_cast<std::size_t>(std::upper_bound(length_.begin(), length_.end(), at) - length_.begin());
    const double part = (at - length_[k - 1]) / (length_[k] - length_[k - 1]);
    set.add(curve_((static_cast<double>(k - 1) + part) / steps), 1.0 / n);
  }
  return set;
}

DistributedMeasurement measure(const DistributedRun& run, const Ranks& ranks) {
  const std::vector<int> borders = ranks.borders({0, run.points}, 1);
  const auto me = static_cast<std::size_t>(ranks.rank());
  const Rows rows = {borders[me], borders[me + 1]};
  const LongChain chain(run.chain);
  const PointSet own = chain.points(run.points, rows);
  FieldSet field(own.size());
  const double before = peak_bytes();
  CoulombSolver solver({.method = CoulombMethod::tree, .accuracy = run.accuracy, .measured_every = 1'000'000},
                       default_isa(), {.subdomains = ranks});
  solver.field(own.view(), {0, own.size()}, field.view(), {run.threads});  // chooses the shape
  double seconds = 1e300;
  RankTraffic counted;
  for (int k = 0; k < run.evaluations; ++k) {
    const RankTraffic sent_before = ranks.traffic();
    const auto begin = std::chrono::steady_clock::now();
    solver.field(own.view(), {0, own.size()}, field.view(), {run.threads});
    seconds =
        std::min(seconds, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    counted = ranks.traffic() - sent_before;
  }
  DistributedMeasurement m;
  m.points = run.points, m.ranks = ranks.size(), m.shape = solver.report().shape;
  m.process = ranks.greatest(peak_bytes());
  m.expected = solver.report().expected_error;
  m.error = error(run.points, rows, own, field, ranks);
  const EssentialTree::Traffic& traffic = solver.tree().traffic();
  const auto most = [&](auto number) { return ranks.greatest(static_cast<double>(number)); };
  m.seconds = most(seconds), m.before = most(before), m.held = most(solver.tree().bytes());
  m.sent = most(traffic.sent), m.received = most(traffic.received);
  m.cells = most(traffic.cells), m.grafted = most(traffic.points), m.partners = most(traffic.partners);
  m.work = solver.report().work;
  double unlike[] = {as_modelled(counted, chain, borders, m.shape, ranks) ? 0.0 : 1.0};
  ranks.sum(unlike);
  m.unlike_model = unlike[0];
  return m;
}

std::string text(const DistributedMeasurement& m) {
  return fmt::format("measured {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {} {}\n", m.points, m.ranks,
                     m.seconds, m.error, m.expected, m.sent, m.received, m.cells, m.grafted, m.partners,
                     m.held, m.before, m.process, m.work, m.shape.order, m.shape.opening, m.shape.leaf,
                     m.shape.block, m.unlike_model);
}

DistributedMeasurement distributed_measurement(const std::string& text) {
  DistributedMeasurement m;
  std::string word;
  std::istringstream(text) >> word >> m.points >> m.ranks >> m.seconds >> m.error >> m.expected >> m.sent >>
      m.received >> m.cells >> m.grafted >> m.partners >> m.held >> m.before >> m.process >> m.work >>
      m.shape.order >> m.shape.opening >> m.shape.leaf >> m.shape.block >> m.unlike_model;
  return m;
}

}  // namespace treejet
