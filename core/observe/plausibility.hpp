#pragma once
/// Jets that no laboratory has seen: a warning on stderr, once each, when
///   a bead is behind the nozzle, by more than the nozzle's radius,
///   a bead is farther off the axis than the collector is away,
///   a bead is faster than sound in air,
///   the jet has drawn a thousand times what the nozzle's velocity supplies (feed pull).
/// The run goes on. Looked for at the ends of some steps, at fixed numbers of them, and at the end; of a
/// chain held in subdomains in that of the rank that writes.

#include <array>

#include "core/jet/nozzle.hpp"
#include "core/jet/observer.hpp"
#include "core/jet/parameters.hpp"
#include "core/jet/scales.hpp"

namespace treejet {

template <int D>
class Plausibility final : public Observer<D> {
 public:
  Plausibility(const Parameters& p, const Nozzle<D>& nozzle);

  void segment(const Jet<D>& jet, const DenseOutput<D>& segment) override;
  void event(EventKind kind, const Jet<D>&) override { released_ += kind == EventKind::release; }
  void finish(const Jet<D>& jet) override { look(jet, jet.t); }
  void visit(Archive& state) override { state(warned_, released_, steps_); }

 private:
  enum Finding { behind, off_axis, fast, drawn, findings };

  void look(const Jet<D>& jet, double t);
  void warn(Finding finding, double t, const std::string& what);

  Scales unit_;
  double behind_, distance_, supply_;  ///< cm; beads a second, 0: not looked at
  std::array<bool, findings> warned_ = {};
  std::int64_t released_ = 0, steps_ = 0;
};

}  // namespace treejet
