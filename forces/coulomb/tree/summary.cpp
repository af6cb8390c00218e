#include "forces/coulomb/tree/summary.hpp"

#include <algorithm>
#include <cmath>

namespace treejet {

namespace {

/// Of several subdomains: they are seen from farther away than one.
constexpr std::size_t balls_of_several = 16;

/// Neighbours along the chain into one, until there are few enough.
std::vector<Ball> fewer(std::vector<Ball> balls) {
  while (balls.size() > balls_of_several) {
    const std::size_t half = (balls.size() + 1) / 2;
    for (std::size_t k = 0; k < half; ++k)
      balls[k] = 2 * k + 1 < balls.size() ? enclosing(balls[2 * k], balls[2 * k + 1]) : balls[2 * k];
    balls.resize(half);
  }
  return balls;
}

/// M2M from two cells.
std::vector<double> moments_about(const double (&centre)[3], const Summary& a, const Summary& b, int order,
                                  const WideKernels& kernels) {
  const std::size_t stride = a.moments.size();
  std::vector<double> moments(stride), column[3];
  for (const Summary* child : {&a, &b})
    moments.insert(moments.end(), child->moments.begin(), child->moments.end());
  for (int e = 0; e < 3; ++e) column[e] = {centre[e], a.whole.centre[e], b.whole.centre[e]};
  const Expansions cells = {order,
                            static_cast<int>(stride),
                            0,
                            {column[0].data(), column[1].data(), column[2].data()},
                            moments.data(),
                            nullptr,
                            false};
  kernels.m2m(cells, {0, 1}, {1, 3});
  moments.resize(stride);
  return moments;
}

void write_ball(const Ball& ball, std::vector<double>& message) {
  message.insert(message.end(),
                 {ball.centre[0], ball.centre[1], ball.centre[2], ball.radius, ball.leaf_radius});
}

Ball read_ball(const double*& at) {
  const Ball ball = {{at[0], at[1], at[2]}, at[3], at[4]};
  at += 5;
  return ball;
}

}  // namespace

void Summary::write(std::vector<double>& message) const {
  message.push_back(static_cast<double>(balls.size()));
  if (empty()) return;
  for (const Ball& ball : balls) write_ball(ball, message);
  write_ball(whole, message);
  message.push_back(critical_radius);
  message.insert(message.end(), moments.begin(), moments.end());
}

Summary SummaryReader::next() {
  Summary summary;
  summary.balls.resize(static_cast<std::size_t>(*at_++));
  if (summary.empty()) return summary;
  for (Ball& ball : summary.balls) ball = read_ball(at_);
  summary.whole = read_ball(at_);
  summary.critical_radius = *at_++;
  summary.moments.assign(at_, at_ + moments_);
  at_ += moments_;
  return summary;
}

Summary summary(const Tree& tree, int balls) {
  const Cells& cells = tree.cells;
  Summary own;
  own.balls = boundary(cells, balls);
  if (own.empty()) return own;
  own.whole = boundary(cells, 1)[0];
  own.critical_radius = cells.critical_radius()[0];
  own.moments.assign(tree.moments.begin(), tree.moments.begin() + static_cast<long>(tree.moment_stride()));
  return own;
}

Summary joined(const Summary& a, const Summary& b, int order, const WideKernels& kernels) {
  if (a.empty() || b.empty()) return a.empty() ? b : a;
  Summary both;
  both.balls = a.balls;
  both.balls.insert(both.balls.end(), b.balls.begin(), b.balls.end());
  both.balls = fewer(std::move(both.balls));
  both.whole = enclosing(a.whole, b.whole);
  double share = 0;
  for (const Summary* child : {&a, &b})
    if (child->whole.radius > 0) share = std::max(share, child->critical_radius / child->whole.radius);
  both.critical_radius = both.whole.radius * (share > 0 ? share : 1);
  both.moments = moments_about(both.whole.centre, a, b, order, kernels);
  return both;
}

bool are_far(const Summary& a, const BoundaryTree& of_a, const Summary& b, double opening) {
  // most are far as a whole, which takes one ball to see
  if (closes(a.whole, b.whole.centre, b.critical_radius, opening) &&
      closes(b.whole, a.whole.centre, a.critical_radius, opening))
    return true;
  return of_a.closes(b.whole.centre, b.critical_radius) &&
         BoundaryTree(b.balls, opening).closes(a.whole.centre, a.critical_radius);
}

}  // namespace treejet
