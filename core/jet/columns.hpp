#pragma once
/// Columns that a scene adds to the state of its beads: one number a bead each (the solvent in it, a tensor's
/// component, ...), with a rate of its own (forces/terms/term.hpp).
///
/// They stand behind position, velocity and stress (core/base/vec.hpp), in the order of this list. Everything
/// that goes over the columns of a state takes them along: schemes, the error norm, dense output, history,
/// subdomains, checkpoints and frames. A scene that adds none has none.

#include <optional>
#include <string>
#include <vector>

namespace treejet {

struct Column {
  std::string name;      ///< as files show it
  std::string unit;      ///< CGS, in the words of H5MD: "cm s-1"
  double scale = 1;      ///< what 1 is in that unit
  double at_birth = 0;   ///< scaled value that a bead leaves the nozzle with
  double small = 1;      ///< scaled size below which the error norm does not count relatively
  double volume = 0;     ///< what 1 of it adds to volume and mass, in units of those at the nozzle
  bool of_bead = false;  ///< it belongs to the bead, not to the element above
  /// The value that it falls to and keeps: its rate is 0 at exactly this value, and anywhere else goes on as
  /// if there were none. The march ends a step where a bead gets there (integrators/march/endings.hpp).
  std::optional<double> end = {};
};

using Columns = std::vector<Column>;

}  // namespace treejet
