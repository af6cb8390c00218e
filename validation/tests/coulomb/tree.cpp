#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>

#include "core/base/error.hpp"
#include "forces/coulomb/solver/coulomb_solver.hpp"
#include "forces/coulomb/solver/rebuild_policy.hpp"
#include "forces/coulomb/tree/space_order.hpp"
#include "forces/coulomb/tree/traversal.hpp"
#include "validation/support/point_sets.hpp"

using namespace treejet;

namespace {

FieldSet direct_field(const PointSet& set) {
  FieldSet field(set.size());
  coulomb_direct<3>(set.view(), {0, set.size()}, field.view());
  return field;
}

FieldSet solve(CoulombSolver& solver, const PointSet& set, int threads = 1) {
  FieldSet field(set.size());
  solver.field(set.view(), {0, set.size()}, field.view(), {threads});
  return field;
}

CoulombRequest tree_of_accuracy(double accuracy) {
  CoulombRequest request;
  request.method = CoulombMethod::tree;
  request.accuracy = accuracy;
  return request;
}

FieldSet tree_field(const PointSet& set, const TreeShape& shape) {
  TreeField tree;
  tree.arrange(set.view(), shape, {1});
  FieldSet field(set.size());
  tree.evaluate(tree.leaves_of({0, set.size()}), {0, set.size()}, field.view(), {1});
  return field;
}

}  // namespace

TEST_CASE("Every pair of points is near or far exactly once") {
  for (int n : {1, 31, 32, 33, 100, 1000, 1025}) {
    const PointSet set = random_cloud(n);
    Cells cells(n, 16);
    cells.enclose({{set.r[0].data(), set.r[1].data(), set.r[2].data()}, set.q.data(), 0, n},
                  wide_kernels(default_isa()).reach, {1});
    std::vector<int> points_of_cell(static_cast<std::size_t>(cells.size()));
    for (int l = 0; l < cells.levels(); ++l)
      for (int leaf = 0; leaf < cells.leaves(); ++leaf) {
        const int cell = cells.level(l).first + (leaf >> (cells.levels() - 1 - l));
        points_of_cell[static_cast<std::size_t>(cell)] += cells.leaf_points(leaf).size();
      }
    const auto size = [&](int cell) { return points_of_cell[static_cast<std::size_t>(cell)]; };
    const int bottom = cells.level(cells.levels() - 1).first, root[] = {0};
    long pairs = 0;
    Traversal(cells, 0.6)
        .walk(
            0, 0, root, -1, [](int) { return true; },
            [&](int target, std::span<const int> sources) {
              for (int s : sources) pairs += static_cast<long>(size(target)) * size(s);
            },
            [&](int leaf, std::span<const int> near) {
              for (int k : near) pairs += static_cast<long>(size(bottom + leaf)) * size(k);
            },
            [](int, int, std::span<const int>) {});
    CHECK(pairs == static_cast<long>(n) * n);
  }
}

TEST_CASE("A cell of charges of both signs has its centre among them") {
  // weighed with their signs, charges that nearly cancel would have a centre anywhere
  PointSet set;
  for (int i = 0; i < 16; ++i) set.add({0.5 * i, 0, 0}, i % 2 == 0 ? 1 : -0.99);
  Cells cells(16, 16);
  cells.enclose({{set.r[0].data(), set.r[1].data(), set.r[2].data()}, set.q.data(), 0, 16},
                wide_kernels(default_isa()).reach, {1});
  // the mean, weighed by size: neighbours differ by a hundredth
  CHECK(cells.centre(0)[0] == Approx(3.75).margin(0.01));
  CHECK(cells.radius()[0] == Approx(3.75).margin(0.01));
}

TEST_CASE("A leaf reaches to its farthest point, however many places of it are empty") {
  for (const Isa isa : {Isa::plain, default_isa()})
    for (int n = 1; n <= 20; ++n) {
      PointSet set;
      for (int i = 0; i < n; ++i) set.add({100 + 0.1 * i, 50, -70}, 1);
      const double centre[3] = {100, 50, -70};
      CAPTURE(n);
      CHECK(wide_kernels(isa).reach({{set.r[0].data(), set.r[1].data(), set.r[2].data()}, set.q.data(), 0, n},
                                    centre) == Approx(0.1 * (n - 1)).margin(1e-12));  // 100 * 2^-52 * a few
    }
}

TEST_CASE("The critical radius of a cell is larger where points crowd") {
  // two leaves of 16 like charges on a line, eight times as far apart in one as in the other
  PointSet set;
  for (int i = 0; i < 16; ++i) set.add({0.5 * i, 0, 0}, 1);
  for (int i = 0; i < 16; ++i) set.add({100 + 4.0 * i, 0, 0}, 1);
  Cells cells(32, 16);
  cells.enclose({{set.r[0].data(), set.r[1].data(), set.r[2].data()}, set.q.data(), 0, 32},
                wide_kernels(default_isa()).reach, {1});
  const double *r = cells.radius(), *R = cells.critical_radius();
  CHECK(r[2] == Approx(8 * r[1]).epsilon(1e-14));
  CHECK(R[1] == r[1]);
  cells.equalise_errors(4, 0.4, cells.spread(), {1});
  // Q / r^2 is 64 times as large: of order 4, to err alike the ratio must be narrower by 64^(1/6) = 2
  CHECK(R[2] / R[1] == Approx(4).epsilon(1e-14));
  CHECK(R[1] * R[2] == Approx(r[1] * r[2]).epsilon(1e-14));
}

TEST_CASE(
    "A last leaf of one point, whose radius is round-off, leaves the critical radii of the others alone") {
  for (int k = 0; k < 50; ++k) {
    PointSet set;
    for (int i = 0; i < 16; ++i) set.add({0.5 * i, 0, 0}, 1);
    set.add({0.1 + 0.37 * k, 0.3, 1.0 / 3}, 1 + 0.4 * std::sin(k));  // q x / q is not always x
    Cells cells(17, 16);
    cells.enclose({{set.r[0].data(), set.r[1].data(), set.r[2].data()}, set.q.data(), 0, 17},
                  wide_kernels(default_isa()).reach, {1});
    cells.equalise_errors(4, 0.4, cells.spread(), {1});
    const int full = cells.size() - cells.leaves();
    CAPTURE(k);
    CHECK(cells.critical_radius()[full] == Approx(cells.radius()[full]).epsilon(1e-14));  // its own mean
  }
}

TEST_CASE(
    "Where points crowd and are strewn, the tree errs no more and does half the work if cells err alike") {
  const PointSet set = uneven_jet(8000);
  const FieldSet exact = direct_field(set);
  double errors[2];
  std::int64_t pairs[2];
  for (bool even : {false, true}) {
    const TreeShape shape = {.order = 6, .opening = even ? 0.6 : 0.4, .leaf = 32, .even = even};
    errors[even] = relative_l2_error(tree_field(set, shape), exact);
    TreeField tree;
    tree.arrange(set.view(), shape, {1});
    pairs[even] = tree.count().pairs;
  }
  CHECK(errors[true] < errors[false]);
  CHECK(pairs[true] < pairs[false] / 2);
}

TEST_CASE("The order in space is a permutation that keeps blocks of the chain together") {
  const PointSet set = random_cloud(1001);
  for (int block : {1, 4, 16}) {
    const std::vector<int> order = space_order(set.view().r.data(), 1001, 32, block, {1});
    CHECK(space_order(set.view().r.data(), 1001, 32, block, {3}) == order);
    std::vector<int> sorted = order;
    std::sort(sorted.begin(), sorted.end());
    for (int i = 0; i < 1001; ++i) REQUIRE(sorted[static_cast<std::size_t>(i)] == i);
    for (std::size_t k = 1; k < order.size(); ++k)
      if (order[k] % block != 0) REQUIRE(order[k] == order[k - 1] + 1);
  }
}

TEST_CASE("The error falls with the order and with the opening, with and without local expansions") {
  const PointSet set = coil(3000, 20, 0.3);
  const FieldSet exact = direct_field(set);
  for (bool local : {true, false})
    for (int block : {0, 1}) {
      CAPTURE(local, block);
      double last = 1;
      for (int order : {2, 4, 6, 8}) {
        const double error = relative_l2_error(tree_field(set, {order, 0.5, 32, block, false, local}), exact);
        CHECK(error < last / 3);  // two more orders at opening 1/2: a factor 4, less the growth of the terms
        last = error;
      }
      CHECK(relative_l2_error(tree_field(set, {4, 0.25, 32, block, false, local}), exact) <
            relative_l2_error(tree_field(set, {4, 0.5, 32, block, false, local}), exact) / 4);
    }
}

TEST_CASE("The promised error is never exceeded", "[slow]") {
  struct Case {
    const char* name;
    PointSet set;
  };
  std::vector<Case> cases;
  for (int n : {1500, 8000}) {
    cases.push_back({"straight line", straight_line(n)});
    cases.push_back({"open helix", coil(n, 10, 1.0)});
    cases.push_back({"coil, pitch like the spacing", coil(n, 30, 0.05)});
    cases.push_back({"coil, pitch below the spacing", coil(n, 60, 0.01)});
    cases.push_back({"whipping jet", whipping_jet(n)});
    cases.push_back({"unevenly spaced jet", uneven_jet(n)});
    cases.push_back({"cloud of both signs", random_cloud(n)});
  }
  for (const Case& c : cases) {
    const FieldSet exact = direct_field(c.set);
    for (double accuracy : {1e-3, 1e-5, 1e-7, 1e-9}) {
      CoulombSolver solver(tree_of_accuracy(accuracy));
      const double error = relative_l2_error(solve(solver, c.set), exact);
      const CoulombReport& report = solver.report();
      CAPTURE(c.name, c.set.size(), accuracy, report.reason, report.shape.order, report.shape.opening);
      CHECK(error <= accuracy);
      if (c.set.size() > 4000)
        CHECK_FALSE(report.direct);  // within reach of a tree, at any of these accuracies
      CHECK(report.expected_error <= accuracy);
    }
  }
}

TEST_CASE(
    "The error that 99 in 100 points stay below, of their own field, is told to a quarter of an octave") {
  const PointSet set = coil(3000, 40, 0.2);
  const FieldSet exact = direct_field(set);
  CoulombSolver solver(tree_of_accuracy(1e-4));
  const FieldSet field = solve(solver, set);
  REQUIRE_FALSE(solver.report().direct);
  std::vector<double> own;
  for (std::size_t i = 0; i < set.q.size(); ++i) {
    double error = 0, size = 0;
    for (int e = 0; e < 3; ++e) {
      error += std::pow(field.e[e][i] - exact.e[e][i], 2);
      size += std::pow(exact.e[e][i], 2);
    }
    own.push_back(std::sqrt(error / size));
  }
  const auto of = [&](double share) {
    const auto at = own.begin() + static_cast<std::ptrdiff_t>(share * double(own.size()));
    std::nth_element(own.begin(), at, own.end());
    return *at;
  };
  // a sample of a thousand points has the quantiles of 98 to 99.7 in 100, and its class is 2^(1/4) wide
  CHECK(solver.report().error.own >= of(0.98));
  CHECK(solver.report().error.own <= of(0.997) * std::exp2(0.25));
}

TEST_CASE("The promise holds while the jet moves and grows, without a new search at every step") {
  CoulombRequest request = tree_of_accuracy(1e-4);
  request.measured_every = 5;
  CoulombSolver solver(request);
  int steps = 0;
  for (int n = 1000; n <= 3000; n += 100, ++steps) {
    const PointSet set = coil(n, 5 + 0.02 * n, 1.5 - 0.0004 * n);  // winds up as it grows
    CHECK(relative_l2_error(solve(solver, set), direct_field(set)) <= 1e-4);
  }
  CHECK(solver.report().error.choices < steps / 2);
}

TEST_CASE("The field has the same bits on any number of threads and for any share of rows") {
  for (bool local : {true, false})
    for (int kind : {0, 1, 2}) {
      const int n = local ? 3000 : 1000;  // the plain path is slow
      const PointSet set = kind == 0   ? whipping_jet(n)
                           : kind == 1 ? random_cloud(n)
                                       : coil(n, 0.02 * n, 0.01);
      CoulombRequest request = tree_of_accuracy(1e-3);
      request.local_expansions = local;
      if (!local) {  // no search: it is slow by this plain path
        request.order = 3;
        request.opening = 0.4;
        request.space = false;
      }
      CoulombSolver one(request);
      const FieldSet whole = solve(one, set, 1);
      for (int threads : {2, 3}) {
        CoulombSolver many(request);
        CHECK(solve(many, set, threads).e[0] == whole.e[0]);
        if (threads != 2) continue;
        FieldSet shares(set.size());
        for (Rows rows : {Rows{0, 434}, Rows{434, 435}, Rows{435, n}}) {
          CoulombSolver rank(request);
          rank.field(set.view(), rows, shares.view(), {threads});
        }
        for (int e = 0; e < 3; ++e) CHECK(shares.e[e] == whole.e[e]);
      }
    }
}

TEST_CASE("Small, empty and degenerate sets of charges have their right field") {
  SECTION("one point feels nothing") {
    PointSet one;
    one.add({1, 2, 3}, 4);
    CoulombSolver solver(tree_of_accuracy(1e-3));
    CHECK(solve(solver, one).e[0][0] == 0);
  }
  SECTION("two points repel") {
    PointSet two;
    two.add({0, 0, 0}, 1);
    two.add({0, 2, 0}, 1);
    CoulombSolver solver(tree_of_accuracy(1e-3));
    CHECK(solve(solver, two).e[1][1] == Approx(0.25).epsilon(1e-15));
  }
  SECTION("charges that are all zero make no field") {
    PointSet set = whipping_jet(1000);
    std::fill(set.q.begin(), set.q.end(), 0.0);
    CoulombSolver solver(tree_of_accuracy(1e-6));
    const FieldSet field = solve(solver, set);
    for (const auto& values : field.e)
      CHECK(std::all_of(values.begin(), values.end(), [](double x) { return x == 0; }));
  }
  SECTION("coordinates that span twelve decades") {
    PointSet set;
    for (int i = 0; i < 3000; ++i) {
      const double size = std::pow(10.0, -6 + 12.0 * i / 2999);
      set.add({size, size * std::sin(i), size * std::cos(i)}, size);
    }
    const FieldSet exact = direct_field(set);
    for (double accuracy : {1e-3, 1e-6, 1e-9}) {
      CoulombSolver solver(tree_of_accuracy(accuracy));
      CHECK(relative_l2_error(solve(solver, set), exact) <= accuracy);
    }
  }
  SECTION("two jets a million of their lengths apart, one of them collinear") {
    PointSet set = straight_line(1500);
    const PointSet other = coil(1500, 20, 0.1);
    for (std::size_t i = 0; i < 1500; ++i)
      set.add({other.r[0][i] + 1e6, other.r[1][i] - 2e6, other.r[2][i]}, other.q[i]);
    const FieldSet exact = direct_field(set);
    CoulombSolver solver(tree_of_accuracy(1e-7));
    CHECK(relative_l2_error(solve(solver, set), exact) <= 1e-7);
    CHECK_FALSE(solver.report().direct);
  }
  SECTION("a pair of points at one place is left out, and reported") {
    const PointSet clean = coil(2000, 10, 0.2);
    PointSet set = clean;
    set.add({set.r[0][700], set.r[1][700], set.r[2][700]}, 1.0 / 2000);
    const FieldSet exact = direct_field(clean);
    for (CoulombMethod method : {CoulombMethod::direct, CoulombMethod::tree}) {
      CoulombRequest request = tree_of_accuracy(1e-6);
      request.method = method;
      CoulombSolver solver(request);
      const FieldSet field = solve(solver, set);
      CHECK(solver.report().coincident == 2);
      for (int e = 0; e < 3; ++e) {
        CHECK(field.e[e][700] == Approx(exact.e[e][700]).epsilon(1e-9).margin(1e-9));
        CHECK(field.e[e][2000] == Approx(exact.e[e][700]).epsilon(1e-9).margin(1e-9));
      }
    }
  }
  SECTION("the potential at such a pair is that of all other points") {
    PointSet set = coil(300, 10, 0.2);
    set.add({set.r[0][100], set.r[1][100], set.r[2][100]}, 7);
    double expected = 0;
    for (std::size_t j = 0; j < 300; ++j)
      if (j != 100)
        expected += set.q[j] / std::hypot(set.r[0][100] - set.r[0][j], set.r[1][100] - set.r[1][j],
                                          set.r[2][100] - set.r[2][j]);
    FieldSet field(301);
    std::vector<double> potential(301);
    CoulombSolver direct({.method = CoulombMethod::direct});
    direct.field(set.view(), {0, 301}, field.view(), {1}, potential.data());
    for (const std::size_t i : {100, 300})
      CHECK(potential[i] == Approx(expected).epsilon(1e-13));  // round-off
  }
  SECTION("points all at one place") {
    PointSet set;
    for (int i = 0; i < 100; ++i) set.add({1, 1, 1}, 1);
    CoulombSolver solver(tree_of_accuracy(1e-6));
    CHECK(solve(solver, set).e[0][50] == 0);
    CHECK(solver.report().coincident == 100);
  }
}

TEST_CASE("The potential comes with the field, as accurate by direct sum, tree and Barnes-Hut") {
  const PointSet set = random_cloud(3000);
  std::vector<double> exact(3000), potential(3000);
  for (std::size_t i = 0; i < 3000; ++i)
    for (std::size_t j = 0; j < 3000; ++j)
      if (i != j)
        exact[i] += set.q[j] / std::hypot(set.r[0][i] - set.r[0][j], set.r[1][i] - set.r[1][j],
                                          set.r[2][i] - set.r[2][j]);
  const auto error = [&] {
    double difference = 0, size = 0;
    for (std::size_t i = 0; i < 3000; ++i) {
      difference += std::pow(potential[i] - exact[i], 2);
      size += exact[i] * exact[i];
    }
    return std::sqrt(difference / size);
  };
  FieldSet field(3000);
  CoulombSolver direct({.method = CoulombMethod::direct});
  direct.field(set.view(), {0, 3000}, field.view(), {1}, potential.data());
  CHECK(error() < 1e-13);  // round-off of sums of 3000 terms
  CHECK(field.e[0] == direct_field(set).e[0]);

  double last = 1;
  for (int order : {3, 6, 9})
    for (bool local : {true, false}) {
      TreeField tree;
      tree.arrange(set.view(), {order, 0.4, 32, 1, false, local}, {1});
      tree.evaluate(tree.leaves_of({0, 3000}), {0, 3000}, field.view(), {1}, potential.data());
      CHECK(relative_l2_error(field, tree_field(set, {order, 0.4, 32, 1, false, local})) == 0);
      CHECK(error() < last);
      if (!local)
        last = error() / 8;  // three orders at an opening of 0.4: 1/16, less the growth of the terms
    }
}

TEST_CASE("Measuring the error takes a bounded part of the work, and a miss is counted") {
  CoulombRequest pinned = tree_of_accuracy(1e-6);
  pinned.order = 3;
  pinned.opening = 0.5;
  CoulombSolver solver(pinned);
  const PointSet set = coil(4000, 30, 0.2);
  const FieldSet exact = direct_field(set);
  FieldSet field(4000);
  constexpr int evaluations = 300;
  for (int k = 0; k < evaluations; ++k) field = solve(solver, set);
  const FieldErrorReport& error = solver.report().error;
  // after the first one this share of the work, and each takes more than an evaluation
  CHECK(error.samples >= 2);
  CHECK(error.samples <= 1 + measuring_share * evaluations);
  CHECK(error.missed == error.samples);
  CHECK(error.choices == 1);
  // 1024 of 4000 points are sampled
  CHECK(error.l2 == Approx(relative_l2_error(field, exact)).epsilon(0.3));
  CHECK(error.max > error.l2);
  CHECK(error.method.find("order 3") != std::string::npos);
}

TEST_CASE("What cannot be promised is summed directly, and said") {
  const PointSet set = whipping_jet(1000);
  CoulombSolver beyond(tree_of_accuracy(1e-17));
  const FieldSet field = solve(beyond, set);
  CHECK(beyond.report().direct);
  CHECK(beyond.report().reason == "no tree is as accurate as asked for");
  CHECK(field.e[0] == direct_field(set).e[0]);

  CoulombRequest automatic;
  CoulombSolver small(automatic);
  solve(small, whipping_jet(200));
  CHECK(small.report().direct);
}

TEST_CASE("A tree read back goes on as it was; one of no order or of no shape is refused") {
  const PointSet set = random_cloud(500);
  TreeField tree;
  tree.arrange(set.view(), {.order = 4, .opening = 0.5, .leaf = 16, .block = 1}, {1});
  const std::string bytes = Archive::bytes_of(tree);
  const auto read = [](const std::string& from) {
    TreeField other;
    Archive reading(from);
    reading(other);
    reading.expect_end();
    return other;
  };
  // moved a little, the points would be sorted otherwise
  PointSet moved = set;
  for (std::size_t i = 0; i < 500; ++i) moved.r[i % 3][i] *= 1.01;
  FieldSet field(500), expected(500);
  TreeField other = read(bytes);
  for (const auto& [from, to] : {std::pair{&other, &field}, std::pair{&tree, &expected}}) {
    from->arrange(moved.view(), tree.shape(), {1}, /*keep_order*/ true);
    from->evaluate(from->leaves_of({0, 500}), {0, 500}, to->view(), {1});
  }
  CHECK(field.e[0] == expected.e[0]);

  std::string twice = bytes;  // the order stands last
  twice.replace(twice.size() - sizeof(int), sizeof(int), twice, twice.size() - 2 * sizeof(int), sizeof(int));
  CHECK_THROWS_AS(read(twice), FileError);
  std::string of_no_order = bytes;  // behind its size
  of_no_order[sizeof(std::size_t)] = 100;
  CHECK_THROWS_AS(read(of_no_order), FileError);
}

TEST_CASE("Pinned values are kept, and values out of range refused") {
  CoulombRequest request = tree_of_accuracy(1e-4);
  request.order = 5;
  request.opening = 0.31;
  request.leaf = 48;
  request.space = true;
  CoulombSolver solver(request);
  solve(solver, whipping_jet(2000));
  const TreeShape& shape = solver.report().shape;
  CHECK(shape.order == 5);
  CHECK(shape.opening == 0.31);
  CHECK(shape.leaf == 48);
  CHECK(shape.block > 0);

  // no whole registers; more than a sample of leaves could hold; beyond the products of 32 bits
  for (int leaf : {20, 0, -16, 2048, 65536, 2147483632}) {
    request.leaf = leaf;
    CHECK_THROWS_AS(CoulombSolver(request), InputError);
  }
  request.leaf = 32;
  request.order = 15;
  CHECK_THROWS_AS(CoulombSolver(request), InputError);
  CHECK_THROWS_AS(CoulombSolver(tree_of_accuracy(0)), InputError);
}
