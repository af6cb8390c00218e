/// Linear systems along a chain, whole and cut into subdomains.

#include <Eigen/Dense>
#include <barrier>
#include <catch2/catch.hpp>
#include <thread>

#include "integrators/schemes/cut_block_tridiagonal.hpp"

using namespace treejet;

namespace {

/// A random system, its equations as a dense matrix, and its right side.
template <int B>
struct RandomSystem {
  RandomSystem(int n, unsigned seed) : dense(Eigen::MatrixXd::Zero(n * B, n * B)) {
    std::srand(seed);  // of Eigen's Random
    g = Eigen::VectorXd::Random(n * B);
    for (int i = 0; i < n; ++i) {
      using Block = typename BlockTridiagonal<B>::Block;
      // diagonal blocks dominate as blocks; inside, rows are reversed, which no elimination without pivots
      // survives
      const Block dominant = (Block::Random() + 2 * B * Block::Identity()).colwise().reverse();
      rows.push_back({Block::Random(), dominant, Block::Random()});
      dense.block<B, B>(i * B, i * B) = dominant;
      if (i > 0) dense.block<B, B>(i * B, (i - 1) * B) = rows.back().below;
      if (i + 1 < n) dense.block<B, B>(i * B, (i + 1) * B) = rows.back().above;
    }
  }
  std::vector<Eigen::Matrix<double, B, 1>> right_side(int first, int last) const {
    std::vector<Eigen::Matrix<double, B, 1>> part;
    for (int i = first; i < last; ++i) part.push_back(g.segment<B>(i * B));
    return part;
  }
  double error(const std::vector<Eigen::Matrix<double, B, 1>>& u) const {
    const Eigen::VectorXd expected = dense.partialPivLu().solve(g);
    double worst = 0;
    for (std::size_t i = 0; i < u.size(); ++i)
      worst = std::max(worst, (u[i] - expected.segment<B>(static_cast<int>(i) * B)).cwiseAbs().maxCoeff());
    return worst;
  }

  std::vector<typename BlockTridiagonal<B>::Row> rows;
  Eigen::MatrixXd dense;
  Eigen::VectorXd g;
};

template <int B>
double block_error(int n, unsigned seed) {
  const RandomSystem<B> random(n, seed);
  BlockTridiagonal<B> system;
  system.row = random.rows;
  system.factor();
  auto u = random.right_side(0, n);
  system.solve(u);
  return random.error(u);
}

/// Of subdomains between such borders, each a thread that stands for a process; also how far wrong what a
/// subdomain is told of the unknown that follows.
template <int B>
double cut_error(const std::vector<int>& borders, unsigned seed) {
  const std::size_t places = borders.size() - 1;
  const RandomSystem<B> random(borders.back(), seed);
  std::barrier meeting(static_cast<std::ptrdiff_t>(places));
  std::vector<std::vector<double>> brought(places);
  std::vector<std::vector<Eigen::Matrix<double, B, 1>>> u(places);
  const auto solve = [&](std::size_t place) {
    CutBlockTridiagonal<B> cut(static_cast<int>(place), [&](std::span<const double> own) {
      brought[place].assign(own.begin(), own.end());
      meeting.arrive_and_wait();
      std::vector<double> all;
      for (const auto& some : brought) all.insert(all.end(), some.begin(), some.end());
      meeting.arrive_and_wait();
      return all;
    });
    BlockTridiagonal<B> own;
    own.row = {random.rows.begin() + borders[place], random.rows.begin() + borders[place + 1]};
    cut.factor(own);
    u[place] = random.right_side(borders[place], borders[place + 1]);
    cut.solve(u[place]);
  };
  std::vector<std::thread> processes;
  for (std::size_t place = 0; place < places; ++place) processes.emplace_back(solve, place);
  for (auto& process : processes) process.join();
  std::vector<Eigen::Matrix<double, B, 1>> whole;
  double worst = 0;
  for (const auto& some : u) {
    if (some.empty()) continue;
    if (!whole.empty()) worst = std::max(worst, (whole.back() - some.front()).cwiseAbs().maxCoeff());
    if (!whole.empty()) whole.pop_back();
    whole.insert(whole.end(), some.begin(), some.end());
  }
  worst = std::max(worst, whole.back().cwiseAbs().maxCoeff());  // nothing follows the last one
  whole.pop_back();
  return std::max(worst, random.error(whole));
}

}  // namespace

TEST_CASE("Block tridiagonal systems of any block size are solved as a dense solver does") {
  for (int n : {1, 2, 3, 40}) {
    CAPTURE(n);
    // round-off; the blocks' condition is below 10
    CHECK(block_error<1>(n, 1) < 1e-14);
    CHECK(block_error<3>(n, 2) < 1e-14);
    CHECK(block_error<7>(n, 3) < 1e-14);
  }
}

TEST_CASE("A system cut into subdomains, some without rows, is solved as the whole is") {
  for (const std::vector<int>& borders : std::vector<std::vector<int>>{
           {0, 9}, {0, 4, 9}, {0, 1, 2, 3}, {0, 10, 11, 40, 41}, {0, 3, 3, 8, 8}, {0, 0, 5, 12}}) {
    CAPTURE(borders);
    CHECK(cut_error<1>(borders, 1) < 1e-14);  // round-off, as above
    CHECK(cut_error<3>(borders, 2) < 1e-14);
  }
}

TEST_CASE("A system in one subdomain has the bits of the whole") {
  const RandomSystem<3> random(20, 5);
  BlockTridiagonal<3> whole, own;
  whole.row = own.row = random.rows;
  CutBlockTridiagonal<3> cut(
      0, [](std::span<const double> mine) { return std::vector(mine.begin(), mine.end()); });
  whole.factor();
  cut.factor(own);
  auto u = random.right_side(0, 20), v = u;
  whole.solve(u);
  cut.solve(v);
  v.pop_back();
  CHECK(u == v);
}
