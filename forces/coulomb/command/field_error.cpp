#include "forces/coulomb/command/field_error.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace treejet {

namespace {

constexpr int compared_whole = 20000, runs = 128, run_length = 16;

std::vector<Rows> targets(int n) {
  if (n <= compared_whole) return {{0, n}};
  std::mt19937 random(2026);
  std::vector<Rows> sample;
  for (int k = 0; k < runs; ++k) {
    const int first = static_cast<int>(random() % static_cast<unsigned>(n / run_length)) * run_length;
    sample.push_back({first, first + run_length});
  }
  return sample;
}

double root_mean_square(const std::vector<double>& values) {
  double sum = 0;
  for (double v : values) sum += v * v;
  return values.empty() ? 0 : std::sqrt(sum / static_cast<double>(values.size()));
}

std::vector<double> sizes(int n, const FieldArrays<3>& field) {
  std::vector<double> finite;
  for (int i = 0; i < n; ++i) {
    const double size = std::hypot(field[0][i], field[1][i], field[2][i]);
    if (std::isfinite(size)) finite.push_back(size);
  }
  return finite;
}

FieldError::Quantiles quantiles(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto at = [&](double part) {
    return values[std::min(values.size() - 1,
                           static_cast<std::size_t>(part * static_cast<double>(values.size())))];
  };
  return {at(0.5), at(0.9), at(0.99), at(0.999), values.back()};
}

}  // namespace

FieldError field_error(const PointCharges<3>& points, const FieldArrays<3>& field, Threads threads) {
  std::vector<double> direct[3];
  for (auto& values : direct) values.resize(static_cast<std::size_t>(points.n));
  std::vector<double> difference, size;
  for (Rows rows : targets(points.n)) {
    for_each_block(threads, rows, 64, [&](Rows block) {
      coulomb_direct<3>(points, block, {direct[0].data(), direct[1].data(), direct[2].data()});
    });
    for (int i = rows.first; i < rows.last; ++i) {
      double d2 = 0, e2 = 0;
      for (std::size_t e = 0; e < 3; ++e) {
        const double exact = direct[e][static_cast<std::size_t>(i)];
        d2 += (field[e][i] - exact) * (field[e][i] - exact);
        e2 += exact * exact;
      }
      if (!std::isfinite(e2)) continue;  // coincident points have no direct field
      difference.push_back(std::sqrt(d2));
      size.push_back(std::sqrt(e2));
    }
  }
  FieldError error;
  error.targets = static_cast<int>(size.size());
  if (size.empty()) return error;
  const double rms =
      points.n <= compared_whole ? root_mean_square(size) : root_mean_square(sizes(points.n, field));
  const auto relative = [](double d, double s) { return s > 0 ? d / s : d; };
  error.l2 = relative(root_mean_square(difference), rms);
  std::vector<double> own, common;
  for (std::size_t k = 0; k < size.size(); ++k) {
    own.push_back(relative(difference[k], size[k]));
    common.push_back(relative(difference[k], rms));
  }
  error.to_own = quantiles(own);
  error.to_rms = quantiles(common);
  return error;
}

}  // namespace treejet
