#pragma once
/// Sets of charges on which the Coulomb sums are tried: curves of n points, most of them equally spaced in
/// arc length, and a cloud.

#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "forces/coulomb/coulomb.hpp"

namespace treejet {

struct PointSet {
  std::vector<double> r[3], q;

  int size() const { return static_cast<int>(q.size()); }
  PointCharges<3> view() const { return {{r[0].data(), r[1].data(), r[2].data()}, q.data(), size()}; }
  void add(const std::array<double, 3>& place, double charge) {
    for (std::size_t e = 0; e < 3; ++e) r[e].push_back(place[e]);
    q.push_back(charge);
  }
};

struct FieldSet {
  explicit FieldSet(int n) {
    for (auto& values : e) values.assign(static_cast<std::size_t>(n), 0.0);
  }
  FieldArrays<3> view() { return {e[0].data(), e[1].data(), e[2].data()}; }
  std::vector<double> e[3];
};

/// n points of charge 1/n equally spaced along curve(s), 0 <= s <= 1.
inline PointSet along(int n, const std::function<std::array<double, 3>(double)>& curve) {
  const int pieces = 400 * 1000;
  std::vector<double> length = {0};
  std::array<double, 3> last = curve(0);
  for (int k = 1; k <= pieces; ++k) {
    const auto next = curve(static_cast<double>(k) / pieces);
    length.push_back(length.back() + std::hypot(next[0] - last[0], next[1] - last[1], next[2] - last[2]));
    last = next;
  }
  PointSet set;
  std::size_t k = 1;
  for (int i = 0; i < n; ++i) {
    const double at = length.back() * (i + 0.5) / n;
    while (length[k] < at) ++k;
    const double part = (at - length[k - 1]) / (length[k] - length[k - 1]);
    set.add(curve((static_cast<double>(k - 1) + part) / pieces), 1.0 / n);
  }
  return set;
}

inline PointSet straight_line(int n) {
  return along(n, [](double s) { return std::array<double, 3>{3 * s, 2 * s, s}; });
}

/// A coil of radius 1: turns and the pitch from one to the next.
inline PointSet coil(int n, double turns, double pitch) {
  return along(n, [=](double s) {
    const double phi = 2 * std::numbers::pi * turns * s;
    return std::array<double, 3>{pitch * turns * s, std::cos(phi), std::sin(phi)};
  });
}

/// 40 turns that widen along the axis.
inline std::array<double, 3> whipping_curve(double s) {
  const double radius = 5 * std::pow(s, 1.5), phi = 80 * std::numbers::pi * s;
  return {16 * s, radius * std::cos(phi), radius * std::sin(phi)};
}

inline PointSet whipping_jet(int n) {
  return along(n, whipping_curve);
}

/// The same with beads that crowd ten times on the way and are strewn between, by spacings of 1 to 100.
inline PointSet uneven_jet(int n) {
  PointSet set;
  for (int i = 0; i < n; ++i) {
    const double u = (i + 0.5) / n, lumps = 20 * std::numbers::pi;
    set.add(whipping_curve(u + 0.98 / lumps * std::sin(lumps * u)), 1.0 / n);
  }
  return set;
}

/// A uniform cloud in the unit cube, charges of both signs.
inline PointSet random_cloud(int n, unsigned seed = 1) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(0, 1);
  PointSet set;
  for (int i = 0; i < n; ++i) set.add({place(random), place(random), place(random)}, 2 * place(random) - 1);
  return set;
}

inline double relative_l2_error(const FieldSet& field, const FieldSet& exact) {
  double difference = 0, size = 0;
  for (int e = 0; e < 3; ++e)
    for (std::size_t i = 0; i < exact.e[e].size(); ++i) {
      difference += std::pow(field.e[e][i] - exact.e[e][i], 2);
      size += std::pow(exact.e[e][i], 2);
    }
  return size > 0 ? std::sqrt(difference / size) : std::sqrt(difference);
}

}  // namespace treejet
