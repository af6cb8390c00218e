#include "core/observe/output_xyz.hpp"

#include <fmt/compile.h>

#include <iterator>

#include "core/io/provenance.hpp"

namespace treejet {

template <int D>
void XyzTrajectory<D>::sample(const Jet<D>& jet) {
  const Eigen::Index beads = jet.size() + 1, shown = std::min<Eigen::Index>(beads, setting_.maxnum);
  most_ = std::max(most_, beads);
  fmt::memory_buffer frame;
  auto out = std::back_inserter(frame);
  fmt::format_to(out, "{}\nt = {:.10g} s  beads = {}", setting_.maxnum, jet.t * setting_.scales.time, shown);
  if (jet.t == 0) fmt::format_to(out, "  program=\"{}\" record=\"{}\"", setting_.made_by, run_record_name);
  frame.push_back('\n');
  const double cm = setting_.scales.length * setting_.rescale;
  for (Eigen::Index i = 0; i < shown; ++i) {
    Vec<3> r = Vec<3>::Zero();
    r.template head<D>() = cm * (i < jet.size() ? position<D>(jet.y, i) : setting_.nozzle.position(jet.t));
    fmt::format_to(out, FMT_COMPILE("C {:.9g} {:.9g} {:.9g}\n"), r[0], r[1], r[2]);
  }
  constexpr std::string_view padding = "C 0 0 0\n";
  for (Eigen::Index i = shown; i < setting_.maxnum; ++i) frame.append(padding);
  file_.write({frame.data(), frame.size()});
}

template class XyzTrajectory<1>;
template class XyzTrajectory<3>;

}  // namespace treejet
