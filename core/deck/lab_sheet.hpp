#pragma once
/// A deck in the words and units of the laboratory, with what is absurd pointed out: `treejet check` prints
/// it.
///
/// Line charge lambda = rho_q pi a^2, Gaussian units. Corona: air breaks down at the surface of a wire of
/// radius a where its field 2 lambda/a exceeds Peek's 30 kV/cm (1 + 0.301/sqrt(a/cm)) (F. W. Peek, Dielectric
/// Phenomena in High Voltage Engineering, 1929; dry air at 1 atm and 25 C). A deck beyond it is still run:
/// nothing here models the discharge.

#include <optional>
#include <string>
#include <vector>

#include "core/jet/parameters.hpp"

namespace treejet {

/// A jet that draws more times the volume that the nozzle's velocity supplies is called absurd.
constexpr double most_draw = 1000;
constexpr double speed_of_sound = 34300;  ///< cm/s, in air at 20 C

/// What a trial run knows besides.
struct Draw {
  double flow;   ///< volume that leaves the nozzle, cm^3/s
  double speed;  ///< of the foremost bead, cm/s
};

struct SheetRow {
  std::string key;   ///< as in JSON, "field"
  std::string name;  ///< for people
  double value;
  std::string unit;          ///< empty: a number
  std::string meaning = {};  ///< half a sentence
  std::string warning = {};  ///< why it is absurd
};

std::vector<SheetRow> lab_sheet(const Parameters& parameters, const std::optional<Draw>& draw = {});

/// One line a row.
std::string lab_sheet_text(const std::vector<SheetRow>& rows);

}  // namespace treejet
