#include "core/observe/output_xyz.hpp"

#include <fmt/compile.h>

#include <iterator>

#include "core/io/provenance.hpp"

namespace treejet {

template <int D>
void XyzTrajectory<D>::sample(const Jet<D>& jet) {
  const std::int64_t beads = this->decomposition().beads(jet), points = beads + 1,
                     shown = std::min<std::int64_t>(points, setting_.maxnum);
  most_ = std::max<Eigen::Index>(most_, points);
  fmt::memory_buffer frame;
  auto out = std::back_inserter(frame);
  fmt::format_to(out, "{}\nt = {:.10g} s  beads = {}", setting_.maxnum, jet.t * setting_.scales.time, shown);
  if (jet.t == 0) fmt::format_to(out, "  program=\"{}\" record=\"{}\"", setting_.made_by, run_record_name);
  frame.push_back('\n');
  const double cm = setting_.scales.length * setting_.rescale;
  const auto add = [&](const Vec<D>& point) {
    Vec<3> r = Vec<3>::Zero();
    r.template head<D>() = cm * point;
    fmt::format_to(out, FMT_COMPILE("C {:.9g} {:.9g} {:.9g}\n"), r[0], r[1], r[2]);
  };
  this->decomposition().in_portions(jet, shown, [&](const Jet<D>& some) {
    for (Eigen::Index i = 0; i < some.size(); ++i) add(position<D>(some.y, i));
  });
  if (shown == points) add(setting_.nozzle.position(jet.t));
  constexpr std::string_view padding = "C 0 0 0\n";
  for (std::int64_t i = shown; i < setting_.maxnum; ++i) frame.append(padding);
  file_.write({frame.data(), frame.size()});
}

template class XyzTrajectory<1>;
template class XyzTrajectory<3>;

}  // namespace treejet
