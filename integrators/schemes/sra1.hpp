#pragma once
/// Roessler's scheme SRA1 for additive noise, dy = f(t, y) dt + b dW, of strong order 1.5; without noise it
/// has order 2:
///
///     Y  = y + 3/4 h f(t, y) + 3/2 b Z / h ,
///     y' = y + h (1/3 f(t, y) + 2/3 f(t + 3/4 h, Y)) + b dW ,
///     Z  = integral of W over the step = h / 2 (dW + U / sqrt 3) ,
///
/// dW and U independent, normal, of variance h. Noise moves the velocities only (core/jet/noise.hpp); the
/// positions get b Z through the stage. JETSPIN's `integrator 4`, Platen's scheme with one sign for the
/// support points of all beads, has this order for beads that do not act on each other; here beads may.
/// Source: A. Roessler, SIAM J. Numer. Anal. 48 (2010) 922.

#include <bit>
#include <functional>

#include "core/base/philox.hpp"
#include "core/jet/decomposition.hpp"
#include "core/jet/noise.hpp"
#include "integrators/schemes/stepper.hpp"

namespace treejet {

/// dW and Z of a component of the velocity of a bead, by its number, over the step of length h from t. Of a
/// long table it is asked by several threads at once.
using WienerPath = std::function<std::array<double, 2>(std::int64_t bead, int component, double t, double h)>;

/// Drawn for the bead and the time alone.
inline WienerPath wiener_path(int seed) {
  return [seed](std::int64_t bead, int component, double t, double h) -> std::array<double, 2> {
    const auto [u1, u2] =
        normal_pair(seed, static_cast<std::uint32_t>(component), bead, std::bit_cast<std::uint64_t>(t));
    const double root = std::sqrt(h);
    return {root * u1, h * root / 2 * (u1 + u2 / std::numbers::sqrt3)};
  };
}

template <int D>
class Sra1 final : public Stepper<D> {
 public:
  /// `all`: who holds which beads.
  Sra1(const Noise& noise, WienerPath path, const Decomposition<D>& all = undivided<D>)
      : noise_(noise), path_(std::move(path)), all_(all) {}
  int order() const override { return 2; }
  int evaluations() const override { return 1; }

  void step(RightHandSide<D>& f, const Jet<D>& jet, const SolutionPoint<D>& from, double h,
            State<D>& next) override {
    draw(jet, from.t, h);
    const auto& k1 = from.slope;
    this->set(stage_, from.y + 3 * h / 4 * k1);
    add(3 / (2 * h), Z_, stage_);
    f(jet, from.t + 3 * h / 4, stage_, k2_);
    this->set(next, from.y + h / 3 * (k1 + 2 * k2_));
    add(1, dW_, next);
  }

 private:
  using Velocities = Eigen::Array<double, Eigen::Dynamic, D>;

  /// b dW and b Z.
  void draw(const Jet<D>& jet, double t, double h) {
    dW_.setZero(jet.size(), D);
    Z_.setZero(jet.size(), D);
    const IdColumn number = all_.numbers(jet);
    for_each_stretch(this->rows_shared, jet.size(), [&](Eigen::Index first, Eigen::Index count) {
      for (Eigen::Index i = first; i < first + count; ++i) {
        const double b = std::sqrt(noise_.squared_amplitude(1 / jet.mass[i]));
        for (int k = 0; k < D && b > 0; ++k) {
          const auto [dW, Z] = path_(number[i], k, t, h);
          dW_(i, k) = b * dW;
          Z_(i, k) = b * Z;
        }
      }
    });
  }

  void add(double weight, const Velocities& change, State<D>& y) const {
    this->share(y.rows(), [&](const auto& rows) {
      rows(y).template middleCols<D>(velocity_column<D>) += weight * rows(change);
    });
  }

  Noise noise_;
  WienerPath path_;
  const Decomposition<D>& all_;
  Velocities dW_, Z_;
  State<D> stage_, k2_;
};

}  // namespace treejet
