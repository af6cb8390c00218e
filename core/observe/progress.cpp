#include "core/observe/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>

namespace treejet {

ProgressLine::ProgressLine(double end_in_seconds, bool interactive)
    : end_(end_in_seconds), interactive_(interactive) {}

void ProgressLine::show(double t, Eigen::Index beads) {
  const auto now = Clock::now();
  const double since = std::chrono::duration<double>(now - last_).count();
  if (since < (interactive_ ? 0.3 : 10.0)) return;
  const double left = t > last_t_ ? since * (end_ - t) / (t - last_t_) : 0;
  last_ = now;
  last_t_ = t;
  fmt::print(stderr, "{}{:5.1f} %  t = {:.6g} of {:g} s  {} beads  {} left{}", interactive_ ? clear_line : "",
             100 * t / end_, t, end_, beads, duration_text(left), interactive_ ? "" : "\n");
  std::fflush(stderr);
}

void ProgressLine::clear() const {
  if (interactive_) fmt::print(stderr, "{}", clear_line);
}

bool stderr_is_interactive() {
  return isatty(fileno(stderr)) != 0;
}

void warn_at(double t, const std::string& what) {
  fmt::print(stderr, "{}treejet: warning: at t = {:.6g} s {}\n", stderr_is_interactive() ? clear_line : "", t,
             what);
}

std::string duration_text(double seconds) {
  const auto s = std::llround(seconds);
  if (s < 60) return fmt::format("{} s", s);
  if (s < 3600) return fmt::format("{} min {} s", s / 60, s % 60);
  return fmt::format("{} h {} min", s / 3600, s / 60 % 60);
}

}  // namespace treejet
