#include "core/jet/field_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"

namespace treejet {

namespace {

/// Coefficients c_-1 ... c_n of the cubic spline through f_0 ... f_(n-1), (c_(i-1) + 4 c_i + c_(i+1)) / 6 =
/// f_i, with c_-1 - 3 c_0 + 3 c_1 - c_2 = 0 and its mirror image, by elimination.
void solve(std::vector<double>& c) {
  const std::size_t n = c.size() - 2;
  std::vector<double> f(c.begin() + 1, c.end() - 1), diagonal(n, 4), right(n);
  for (std::size_t i = 1; i + 1 < n; ++i) right[i] = 6 * f[i];
  diagonal[1] = diagonal[n - 2] = 5;
  right[1] -= f[0] - f[1];
  right[n - 2] -= f[n - 1] - f[n - 2];
  for (std::size_t i = 2; i + 1 < n; ++i) {
    const double factor = 1 / diagonal[i - 1];
    diagonal[i] -= factor;
    right[i] -= factor * right[i - 1];
  }
  c[n - 1] = right[n - 2] / diagonal[n - 2];
  for (std::size_t i = n - 3; i >= 1; --i) c[i + 1] = (right[i] - c[i + 2]) / diagonal[i];
  c[1] = c[2] + f[0] - f[1];
  c[n] = c[n - 1] + f[n - 1] - f[n - 2];
  c[0] = 3 * c[1] - 3 * c[2] + c[3];
  c[n + 1] = 3 * c[n] - 3 * c[n - 1] + c[n - 2];
}

}  // namespace

FieldMap::FieldMap(const Grid& grid, std::vector<double> potential, std::string name)
    : grid_(grid), padded_(grid.size), name_(std::move(name)) {
  double points = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    if (grid.size[k] < fewest)
      throw InputError(fmt::format("{}: expected at least {} points in each direction, found {}", name_,
                                   fewest, grid.size[k]));
    if (!(grid.spacing[k] > 0) || !std::isfinite(grid.spacing[k]) || !std::isfinite(grid.origin[k]))
      throw InputError(
          fmt::format("{}: expected a positive spacing in each direction, and an origin", name_));
    points *= grid.size[k];
    padded_[k] += 2;
  }
  if (points != double(potential.size()))
    throw InputError(
        fmt::format("{}: expected {} values of the potential, found {}", name_, points, potential.size()));
  if (!std::all_of(potential.begin(), potential.end(), [](double p) { return std::isfinite(p); }))
    throw InputError(name_ + ": the potential has a value that is no number");
  const auto [nx, ny, nz] = grid.size;
  const auto px = static_cast<std::size_t>(padded_[0]), py = static_cast<std::size_t>(padded_[1]);
  coefficient_.assign(px * py * static_cast<std::size_t>(padded_[2]), 0);
  std::size_t next = 0;
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x)
        coefficient_[static_cast<std::size_t>(x + 1) +
                     px * (static_cast<std::size_t>(y + 1) + py * static_cast<std::size_t>(z + 1))] =
            potential[next++];
  for (int direction : {0, 1, 2}) solve_along(direction);
}

/// One direction after the other; the padding of those to come is still zero.
void FieldMap::solve_along(int direction) {
  const std::array<std::size_t, 3> stride = {
      1, static_cast<std::size_t>(padded_[0]),
      static_cast<std::size_t>(padded_[0]) * static_cast<std::size_t>(padded_[1])};
  const int u = (direction + 1) % 3, v = (direction + 2) % 3;
  const auto at = [](const auto& array, int k) { return array[static_cast<std::size_t>(k)]; };
  std::vector<double> line(static_cast<std::size_t>(at(padded_, direction)));
  for (int i = 0; i < at(padded_, u); ++i)
    for (int j = 0; j < at(padded_, v); ++j) {
      double* const first = coefficient_.data() + static_cast<std::size_t>(i) * at(stride, u) +
                            static_cast<std::size_t>(j) * at(stride, v);
      for (std::size_t k = 0; k < line.size(); ++k) line[k] = first[k * at(stride, direction)];
      solve(line);
      for (std::size_t k = 0; k < line.size(); ++k) first[k * at(stride, direction)] = line[k];
    }
}

bool FieldMap::contains(const Vec<3>& r) const {
  for (std::size_t k = 0; k < 3; ++k) {
    const double s = (r[static_cast<Eigen::Index>(k)] - grid_.origin[k]) / grid_.spacing[k];
    if (!(s >= -1 && s <= grid_.size[k])) return false;
  }
  return true;
}

FieldMap::Weights FieldMap::weights(int direction, double r) const {
  const auto k = static_cast<std::size_t>(direction);
  const double s = (r - grid_.origin[k]) / grid_.spacing[k];
  const int cell = std::clamp(static_cast<int>(std::floor(s)), 0, grid_.size[k] - 2);
  const double t = s - cell, u = 1 - t, per = 1 / grid_.spacing[k];
  return {cell,
          {u * u * u / 6, (4 - 6 * t * t + 3 * t * t * t) / 6, (4 - 6 * u * u + 3 * u * u * u) / 6,
           t * t * t / 6},
          {-u * u / 2 * per, (3 * t * t - 4 * t) / 2 * per, (4 * u - 3 * u * u) / 2 * per, t * t / 2 * per}};
}

Vec<3> FieldMap::field(const Vec<3>& r) const {
  const Weights x = weights(0, r[0]), y = weights(1, r[1]), z = weights(2, r[2]);
  Vec<3> gradient = Vec<3>::Zero();
  for (std::size_t c = 0; c < 4; ++c)
    for (std::size_t b = 0; b < 4; ++b) {
      const std::size_t row =
          static_cast<std::size_t>(x.first) +
          static_cast<std::size_t>(padded_[0]) *
              (static_cast<std::size_t>(y.first) + b +
               static_cast<std::size_t>(padded_[1]) * (static_cast<std::size_t>(z.first) + c));
      double value = 0, slope = 0;
      for (std::size_t a = 0; a < 4; ++a) {
        value += x.value[a] * coefficient_[row + a];
        slope += x.slope[a] * coefficient_[row + a];
      }
      gradient[0] += slope * y.value[b] * z.value[c];
      gradient[1] += value * y.slope[b] * z.value[c];
      gradient[2] += value * y.value[b] * z.slope[c];
    }
  return -gradient;
}

double FieldMap::potential(const Vec<3>& r) const {
  const Weights x = weights(0, r[0]), y = weights(1, r[1]), z = weights(2, r[2]);
  double sum = 0;
  for (std::size_t c = 0; c < 4; ++c)
    for (std::size_t b = 0; b < 4; ++b)
      for (std::size_t a = 0; a < 4; ++a)
        sum += x.value[a] * y.value[b] * z.value[c] *
               coefficient_[static_cast<std::size_t>(x.first) + a +
                            static_cast<std::size_t>(padded_[0]) *
                                (static_cast<std::size_t>(y.first) + b +
                                 static_cast<std::size_t>(padded_[1]) *
                                     (static_cast<std::size_t>(z.first) + c))];
  return sum;
}

std::string FieldMap::box() const {
  const auto end = [&](std::size_t k) { return grid_.origin[k] + (grid_.size[k] - 1) * grid_.spacing[k]; };
  return fmt::format("x {:.6g} to {:.6g}, y {:.6g} to {:.6g}, z {:.6g} to {:.6g} cm", grid_.origin[0], end(0),
                     grid_.origin[1], end(1), grid_.origin[2], end(2));
}

}  // namespace treejet
