#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "forces/coulomb/coulomb.hpp"

using namespace treejet;

namespace {

template <int D>
struct Points {
  std::vector<double> r[D], q;

  PointCharges<D> view() const {
    PointCharges<D> p{};
    for (int k = 0; k < D; ++k) p.r[k] = r[k].data();
    p.q = q.data();
    p.n = static_cast<int>(q.size());
    return p;
  }
};

template <int D>
struct Field {
  explicit Field(int n) {
    for (auto& e : component) e.assign(static_cast<std::size_t>(n), -77.0);
  }
  FieldArrays<D> view() {
    FieldArrays<D> f{};
    for (std::size_t k = 0; k < D; ++k) f[k] = component[k].data();
    return f;
  }
  double operator()(int k, int i) const {
    return component[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)];
  }
  std::array<std::vector<double>, D> component;
};

template <int D>
Points<D> random_points(int n, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(-1, 1);
  Points<D> p;
  for (int i = 0; i < n; ++i) {
    for (auto& x : p.r) x.push_back(place(random));
    p.q.push_back(place(random));
  }
  return p;
}

template <int D>
Field<D> direct(const Points<D>& p, Isa path) {
  Field<D> e(p.view().n);
  coulomb_direct<D>(p.view(), {0, p.view().n}, e.view(), path);
  return e;
}

template <int D>
Field<D> mutual(const Points<D>& p, Isa path) {
  Field<D> e(p.view().n);
  coulomb_mutual<D>(p.view(), e.view(), path);
  return e;
}

/// Largest difference from the plain sum, in units of sum_j |q_j| / d^2: the terms whose round-off adds up.
template <int D>
double relative_difference(const Points<D>& p, const Field<D>& wide) {
  const int n = p.view().n;
  Points<D> absolute = p;
  for (double& q : absolute.q) q = std::abs(q);
  Field<D> plain(n);
  coulomb_plain<D>(p.view(), {0, n}, plain.view(), n);
  double worst = 0;
  for (int i = 0; i < n; ++i) {
    double size = 0;
    for (int j = 0; j < n; ++j) {
      double d2 = 0;
      for (const auto& x : p.r)
        d2 += std::pow(x[static_cast<std::size_t>(i)] - x[static_cast<std::size_t>(j)], 2);
      if (j != i) size += absolute.q[static_cast<std::size_t>(j)] / d2;
    }
    for (int k = 0; k < D; ++k)
      if (n > 1) worst = std::max(worst, std::abs(wide(k, i) - plain(k, i)) / size);
  }
  return worst;
}

std::vector<Isa> paths_here() {
  std::vector<Isa> paths;
  for (Isa path : {Isa::plain, Isa::avx2, Isa::avx512})
    if (runs_here(path)) paths.push_back(path);
  return paths;
}

}  // namespace

TEST_CASE("The field of up to four charges is Coulomb's law worked out by hand") {
  for (Isa path : paths_here()) {
    CAPTURE(name(path));
    const Points<3> one{{{0.3}, {0.1}, {-2}}, {5}};
    CHECK(direct(one, path)(0, 0) == 0);

    // charges 2 and 6 at distance 2: 6/4 and 2/4, apart
    const Points<3> two{{{0, 2}, {0, 0}, {0, 0}}, {2, 6}};
    CHECK(direct(two, path)(0, 0) == Approx(-1.5).epsilon(1e-15));
    CHECK(direct(two, path)(0, 1) == Approx(0.5).epsilon(1e-15));

    // 3-4-5 triangle with the target at the right angle: -q/9 along x, -q/16 along y
    const Points<3> three{{{0, 3, 0}, {0, 0, 4}, {1, 1, 1}}, {1, 18, -32}};
    CHECK(direct(three, path)(0, 0) == Approx(-2).epsilon(1e-15));
    CHECK(direct(three, path)(1, 0) == Approx(2).epsilon(1e-15));
    CHECK(direct(three, path)(2, 0) == 0);

    // corners of a square of side 1: outward 1/sqrt(2) + 1/2 along the diagonal
    const Points<3> four{{{0, 1, 1, 0}, {0, 0, 1, 1}, {0, 0, 0, 0}}, {1, 1, 1, 1}};
    const Field<3> e = direct(four, path);
    CHECK(e(0, 2) * std::sqrt(2.0) == Approx(std::sqrt(2.0) + 0.5).epsilon(1e-15));
    CHECK(e(1, 2) == Approx(e(0, 2)).epsilon(1e-15));
  }
}

TEST_CASE("On a line the field points away from a charge on either side, whatever the order of the rows") {
  for (Isa path : paths_here()) {
    CAPTURE(name(path));
    const Points<1> p{{{0, 2, -1}}, {4, 8, 1}};
    const Field<1> e = direct(p, path);
    CHECK(e(0, 0) == Approx(-8. / 4 + 1. / 1).epsilon(1e-15));
    CHECK(e(0, 1) == Approx(4. / 4 + 1. / 9).epsilon(1e-15));
    CHECK(e(0, 2) == Approx(-4. / 1 - 8. / 9).epsilon(1e-15));
  }
}

TEST_CASE("Every wide path agrees with the plain sum to round-off for any number of points") {
  // Each term carries a few units of round-off (2.2e-16), the accumulation sqrt(n) of them: 2e-15 covers n <=
  // 1000.
  for (Isa path : paths_here()) {
    CAPTURE(name(path));
    for (int n = 1; n <= 70; ++n) {
      const Points<3> p = random_points<3>(n, 100u + static_cast<unsigned>(n));
      const Points<1> line = random_points<1>(n, 200u + static_cast<unsigned>(n));
      CHECK(relative_difference(p, direct(p, path)) < 2e-15);
      CHECK(relative_difference(line, direct(line, path)) < 2e-15);
    }
    const Points<3> many = random_points<3>(1000, 1);
    CHECK(relative_difference(many, direct(many, path)) < 2e-15);
  }
}

TEST_CASE("By Newton's third law the field is the same to round-off for any number of points") {
  for (Isa path : paths_here()) {
    CAPTURE(name(path));
    for (int n : {1, 2, 7, 8, 9, 15, 16, 17, 31, 33, 64, 150, 511, few_points}) {
      const Points<3> p = random_points<3>(n, 300u + static_cast<unsigned>(n));
      const Points<1> line = random_points<1>(n, 400u + static_cast<unsigned>(n));
      CAPTURE(n);
      CHECK(relative_difference(p, mutual(p, path)) < 2e-15);  // as above
      // on a line a close pair outweighs the hundreds of terms added to it, each rounded at its size: against
      // long double both sums, the plain one too, are off by up to 4e-15
      CHECK(relative_difference(line, mutual(line, path)) < 1e-14);
    }
    Points<3> meeting = random_points<3>(40, 5);
    for (auto& x : meeting.r) x[35] = x[3];
    CHECK_FALSE(std::isfinite(mutual(meeting, path)(0, 3)));
    CHECK_FALSE(std::isfinite(mutual(meeting, path)(2, 35)));
  }
}

TEST_CASE("A row has the same bits whoever shares the rows, and other rows are left alone") {
  const Points<3> p = random_points<3>(67, 7);
  for (Isa path : paths_here()) {
    CAPTURE(name(path));
    const Field<3> whole = direct(p, path);
    for (Rows rows : {Rows{0, 1}, Rows{3, 19}, Rows{15, 17}, Rows{16, 32}, Rows{17, 67}, Rows{66, 67}}) {
      Field<3> part(67);
      coulomb_direct<3>(p.view(), rows, part.view(), path);
      for (int i = 0; i < 67; ++i)
        for (int k = 0; k < 3; ++k)
          CHECK(part(k, i) == (i >= rows.first && i < rows.last ? whole(k, i) : -77.0));
    }
  }
}

TEST_CASE("The net force of the charges on each other vanishes") {
  const Points<3> p = random_points<3>(500, 3);
  for (Isa path : paths_here()) {
    const Field<3> e = direct(p, path);
    for (int k = 0; k < 3; ++k) {
      double net = 0, size = 0;
      for (int i = 0; i < 500; ++i) {
        net += p.q[static_cast<std::size_t>(i)] * e(k, i);
        size += std::abs(p.q[static_cast<std::size_t>(i)] * e(k, i));
      }
      CHECK(std::abs(net) < 1e-14 * size);  // 250,000 terms of random round-off, each 1e-16 of its size
    }
  }
}

TEST_CASE("Distances from 1e-60 to 1e60 keep full precision") {
  // Beyond the range of float, where a float start for the root must not be trusted.
  for (Isa path : paths_here())
    for (double scale : {1e-60, 1e-25, 1e-18, 1e18, 1e25, 1e60}) {
      CAPTURE(name(path), scale);
      const Points<3> p{{{0, 3 * scale}, {0, 4 * scale}, {0, 0}}, {scale, scale}};
      CHECK(direct(p, path)(0, 1) * scale == Approx(3. / 125).epsilon(1e-15));
    }
}

TEST_CASE("Distinct points at one place give a field that is not finite") {
  for (Isa path : paths_here())
    for (int other : {1, 15, 16, 39}) {
      CAPTURE(name(path), other);
      Points<3> p = random_points<3>(40, 5);
      for (auto& x : p.r) x[static_cast<std::size_t>(other)] = x[0];
      const Field<3> e = direct(p, path);
      CHECK_FALSE(std::isfinite(e(0, 0)));
      CHECK_FALSE(std::isfinite(e(2, other)));
      CHECK(std::isfinite(e(0, 2)));
    }
}
