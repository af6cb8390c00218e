#include "core/observe/accuracy_warning.hpp"

#include <fmt/format.h>

#include "core/observe/progress.hpp"

namespace treejet {

std::string summary_of(const FieldErrorReport& forces) {
  std::string text = fmt::format("forces: {}", forces.method);
  if (forces.samples == 0) return text;
  text += fmt::format(
      "; error on sampled beads at the most {:.2g} of the mean field (asked for {:g}), of a bead {:.2g}; "
      "99 in 100 beads below {:.2g} of their own field; {} samples",
      forces.worst_l2, forces.asked, forces.worst_max, forces.worst_own, forces.samples);
  if (forces.missed > 0) text += fmt::format("; ACCURACY MISSED in {} of them", forces.missed);
  return text;
}

void warn_of_missed_accuracy(const FieldErrorReport& forces, double t) {
  warn_at(t,
          fmt::format("the error of the Coulomb field on sampled beads was {:.2g}, above the accuracy {:g} "
                      "asked for",
                      forces.worst_l2, forces.asked));
}

}  // namespace treejet
