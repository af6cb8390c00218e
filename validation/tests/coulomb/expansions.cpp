#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "forces/coulomb/simd/kernels.hpp"
#include "forces/coulomb/tree/multipole.hpp"

using namespace treejet;

namespace {

Vector3 operator-(const Vector3& a, const Vector3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
double norm(const Vector3& a) {
  return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

/// Cells in a row of distinct centres, each with its own points: n of them in a ball of radius 0.4.
struct Cells {
  Cells(int order, int cells, int points) : order(order) {
    std::mt19937_64 random(static_cast<unsigned>(order));
    std::uniform_real_distribution<double> place(-0.2, 0.2);
    for (int k = 0; k < cells; ++k) {
      for (std::size_t e = 0; e < 3; ++e) centre[e].push_back(place(random) + (e == 0 ? 1.7 * k : 0.3 * k));
      for (int j = 0; j < points; ++j) {
        for (std::size_t e = 0; e < 3; ++e) r[e].push_back(centre[e].back() + place(random));
        q.push_back(place(random));
      }
    }
    x.order = order;
    x.moment_stride = (Series::terms(order - 1) + 7) / 8 * 8;
    x.local_stride = (Series::terms(order) + 7) / 8 * 8;
    for (std::size_t e = 0; e < 3; ++e) x.centre[e] = centre[e].data();
    moments.assign(static_cast<std::size_t>(cells * x.moment_stride), 0.0);
    locals.assign(static_cast<std::size_t>(cells * x.local_stride), 0.0);
    x.moments = moments.data();
    x.locals = locals.data();
  }
  Vector3 at(int cell) const {
    const auto k = static_cast<std::size_t>(cell);
    return {centre[0][k], centre[1][k], centre[2][k]};
  }
  Vector3 point(int j) const {
    const auto k = static_cast<std::size_t>(j);
    return {r[0][k], r[1][k], r[2][k]};
  }
  CellPoints points(int first, int count) const {
    return {{r[0].data(), r[1].data(), r[2].data()}, q.data(), first, count};
  }
  /// Random series in the memory of all cells.
  void fill(std::vector<double>& terms) {
    std::mt19937_64 random(5);
    for (double& t : terms) t = std::uniform_real_distribution<double>(-1, 1)(random);
  }

  int order;
  std::vector<double> centre[3], r[3], q, moments, locals;
  Expansions x{};
};

Series series_at(int degree, const double* term) {
  Series s(degree);
  std::copy(term, term + Series::terms(degree), s.data());
  return s;
}

/// Equal to a tolerance of the largest term, from term `first` on.
void check_same(const Series& plain, const double* wide, double tolerance, int first = 0) {
  double size = 0, difference = 0;
  for (int k = first; k < Series::terms(plain.degree()); ++k) {
    size = std::max(size, std::abs(plain.data()[k]));
    difference = std::max(difference, std::abs(plain.data()[k] - wide[k]));
  }
  CHECK(difference <= tolerance * size);
}

template <class F>
void on_every_path(F&& f) {
  for (Isa path : {Isa::plain, Isa::avx2, Isa::avx512})
    if (runs_here(path)) {
      CAPTURE(name(path));
      f(wide_kernels(path));
    }
}

}  // namespace

TEST_CASE("D_a is the derivative of 1/R, and P_a its partner in the Taylor series") {
  const Vector3 R = {0.7, -0.4, 0.5};
  const Series D = derivatives(3, R);
  const double R2 = 0.9, R1 = std::sqrt(R2);
  CHECK(D(0, 0, 0) == Approx(1 / R1));
  CHECK(D(1, 0, 0) == Approx(-0.7 / (R2 * R1)));
  CHECK(D(1, 1, 0) == Approx(3 * 0.7 * -0.4 / (R2 * R2 * R1)));
  const Series& same = D;
  CHECK(same(0, 0, 2) == Approx((3 * 0.25 - R2) / (R2 * R2 * R1)));
  CHECK(D(1, 1, 1) == Approx(-15 * 0.7 * -0.4 * 0.5 / (R2 * R2 * R2 * R1)));

  // 1/|R + d| = sum_a P_a(d) D_a(R): with |d|/|R| = 0.1, degree 14 leaves 1e-15
  const Vector3 d = {0.06, 0.05, -0.0551};
  const Series P = polynomials(14, d), all = derivatives(14, R);
  double sum = 0;
  for (int k = 0; k < Series::terms(14); ++k) sum += P.data()[k] * all.data()[k];
  CHECK(sum == Approx(1 / norm({R[0] + d[0], R[1] + d[1], R[2] + d[2]})).epsilon(1e-14));
}

TEST_CASE("Moments moved up, across and down give the field to the order of the expansion") {
  const Vector3 charge = {0.11, -0.05, 0.08}, child = {0.1, 0, 0}, parent = {0, 0, 0};
  const Vector3 far_parent = {2.9, 0.4, 0.3}, far_child = {3, 0.5, 0.3}, target = {3.05, 0.45, 0.38};
  const Vector3 d = target - charge;
  double previous = 1;
  for (int p : {2, 4, 6, 8, 10}) {
    Series Mc(p - 1), M(p - 1), Lp(p), L(p);
    p2m(child - charge, 2.0, Mc);
    m2m(Mc, parent - child, M);
    m2l(M, far_parent - parent, Lp);
    l2l(Lp, far_child - far_parent, L);
    const Vector3 E = l2p(L, target - far_child), direct = m2p(M, target - parent);
    const Vector3 exact = {2 * d[0] / std::pow(norm(d), 3), 2 * d[1] / std::pow(norm(d), 3),
                           2 * d[2] / std::pow(norm(d), 3)};
    const double error = norm(E - exact) / norm(exact);
    CAPTURE(p, error);
    CHECK(error < previous / 20);  // (0.14 + 0.22) / 2.9 = 1/8 a degree at worst, two degrees more each time
    CHECK(norm(direct - exact) / norm(exact) < previous / 20);
    CHECK(l2p_potential(L, target - far_child) == Approx(2 / norm(d)).epsilon(previous / 20));
    CHECK(m2p_potential(M, target - parent) == Approx(2 / norm(d)).epsilon(previous / 20));
    previous = error;
  }
}

TEST_CASE("Every wide operator is the plain one, to round-off") {
  // Sums of up to 3000 products of both signs: 1e-12 of the largest term leaves room for their cancellation.
  const double tolerance = 1e-12;
  on_every_path([&](const WideKernels& kernels) {
    for (const auto& [p, potential] : std::vector<std::pair<int, bool>>{
             {2, true}, {3, false}, {4, true}, {6, false}, {9, true}, {10, false}, {14, true}, {14, false}}) {
      CAPTURE(p, potential);
      Cells cells(p, 15, 21);
      cells.x.potential = potential;
      const int first = potential ? 0 : 1;  // term 0 of a local series serves the potential only

      kernels.p2m(cells.x, 2, cells.points(42, 21));
      Series M(p - 1);
      for (int j = 42; j < 63; ++j)
        p2m(cells.at(2) - cells.point(j), cells.q[static_cast<std::size_t>(j)], M);
      check_same(M, cells.x.moments + 2 * cells.x.moment_stride, tolerance);

      // parents 0..2 have the children 3..7: the last has one child only
      cells.fill(cells.moments);
      kernels.m2m(cells.x, {0, 3}, {3, 8});
      for (int parent = 0; parent < 3; ++parent) {
        Series sum(p - 1);
        for (int child = 3 + 2 * parent; child < std::min(8, 5 + 2 * parent); ++child)
          m2m(series_at(p - 1, cells.x.moments + child * cells.x.moment_stride),
              cells.at(parent) - cells.at(child), sum);
        check_same(sum, cells.x.moments + parent * cells.x.moment_stride, tolerance);
      }

      const int sources[] = {3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 14};
      kernels.m2l(cells.x, 0, sources, 11);
      Series L(p);
      for (int s : sources)
        m2l(series_at(p - 1, cells.x.moments + s * cells.x.moment_stride), cells.at(0) - cells.at(s), L);
      check_same(L, cells.x.locals, tolerance, first);

      cells.fill(cells.locals);
      Series child = series_at(p, cells.x.locals + 4 * cells.x.local_stride);
      kernels.l2l(cells.x, {0, 3}, {3, 8});
      l2l(series_at(p, cells.x.locals), cells.at(4) - cells.at(0), child);
      check_same(child, cells.x.locals + 4 * cells.x.local_stride, tolerance, first);

      std::vector<double> field[4];
      for (auto& e : field) e.assign(cells.q.size(), 1.0);
      double* const E[4] = {field[0].data(), field[1].data(), field[2].data(), field[3].data()};
      kernels.l2p(cells.x, 1, cells.points(21, 21), E);
      const Series local = series_at(p, cells.x.locals + cells.x.local_stride);
      for (int j = 21; j < 42; ++j) {
        const Vector3 plain = l2p(local, cells.point(j) - cells.at(1));
        for (std::size_t e = 0; e < 3; ++e)
          CHECK(field[e][static_cast<std::size_t>(j)] - 1 ==
                Approx(plain[e]).epsilon(tolerance).margin(tolerance));
        if (potential)
          CHECK(field[3][static_cast<std::size_t>(j)] - 1 ==
                Approx(l2p_potential(local, cells.point(j) - cells.at(1)))
                    .epsilon(tolerance)
                    .margin(tolerance));
      }
    }
  });
}

TEST_CASE("The near field of a cell in single precision is that of the rounded places") {
  on_every_path([&](const WideKernels& kernels) {
    for (int size : {16, 21, 32, 48, 64}) {
      Cells cells(3, 12, size);
      std::vector<double> single[3], twice[3];
      for (auto& e : single) e.assign(cells.q.size(), -77.0);
      for (auto& e : twice) e.assign(cells.q.size(), -77.0);
      double* const S[3] = {single[0].data(), single[1].data(), single[2].data()};
      double* const E[3] = {twice[0].data(), twice[1].data(), twice[2].data()};
      const CellRange sources[] = {{0, 7}, {9, 12 * size}};
      const Vector3 centre = cells.at(1);
      kernels.p2p(cells.points(size, size), sources, 2, E);
      kernels.p2p_single(cells.points(size, size), sources, 2, {{centre[0], centre[1], centre[2]}, 0.3, 0.1},
                         S);
      double size2 = 0, error2 = 0;
      for (std::size_t i = 0; i < cells.q.size(); ++i)
        for (int e = 0; e < 3; ++e) {
          size2 += twice[e][i] * twice[e][i];
          error2 += std::pow(single[e][i] - twice[e][i], 2);
        }
      CHECK(std::sqrt(error2 / size2) <
            3e-5);  // 1e-7 of 20 cells' lengths, over neighbours at a tenth of one
      CHECK(single[0][static_cast<std::size_t>(size) - 1] == -77.0);
      CHECK(single[0][static_cast<std::size_t>(2 * size)] == -77.0);
    }
  });
}

TEST_CASE("The near field of a cell is the direct sum over its ranges of sources") {
  on_every_path([&](const WideKernels& kernels) {
    Cells cells(3, 3, 21);
    std::vector<double> field[4], same[3];
    for (auto& e : field) e.assign(64, -77.0);
    for (auto& e : same) e.assign(64, -77.0);
    double* const E[4] = {field[0].data(), field[1].data(), field[2].data(), field[3].data()};
    double* const S[3] = {same[0].data(), same[1].data(), same[2].data()};
    const CellRange sources[] = {{3, 30}, {40, 63}};
    kernels.p2p_with_potential(cells.points(21, 21), sources, 2, E);
    kernels.p2p(cells.points(21, 21), sources, 2, S);
    for (int e = 0; e < 3; ++e) CHECK(same[e] == field[e]);
    CHECK(field[0][20] == -77.0);
    CHECK(field[0][42] == -77.0);
    for (int i = 21; i < 42; ++i) {
      Vector3 sum{};
      double potential = 0;
      for (int j = 0; j < 63; ++j) {
        const bool source = (j >= 3 && j < 30) || j >= 40;
        const Vector3 d = cells.point(i) - cells.point(j);
        for (std::size_t e = 0; e < 3; ++e)
          if (source && j != i) sum[e] += cells.q[static_cast<std::size_t>(j)] * d[e] / std::pow(norm(d), 3);
        if (source && j != i) potential += cells.q[static_cast<std::size_t>(j)] / norm(d);
      }
      for (std::size_t e = 0; e < 3; ++e)
        CHECK(field[e][static_cast<std::size_t>(i)] == Approx(sum[e]).epsilon(1e-12));
      CHECK(field[3][static_cast<std::size_t>(i)] == Approx(potential).epsilon(1e-12).margin(1e-14));
    }
  });
}
