#pragma once
/// The command `treejet field POINTS.csv`: the Coulomb field of charges read from a file, at the charges,
/// with the time it took and, if wanted, its error against direct summation.
///
/// POINTS.csv has a header line naming the columns x, y, z and q (in any order, others are ignored) and one
/// point a line. FIELD.csv gets x,y,z,q,ex,ey,ez,potential with 17 digits. Units are the caller's: charge /
/// length^2, charge / length.

#include <iosfwd>
#include <string>

#include "core/base/output_file.hpp"
#include "forces/coulomb/solver/coulomb_solver.hpp"

namespace treejet {

struct FieldCommand {
  std::string points;  ///< file to read
  std::string out;     ///< file to write the field to, or empty
  OutputFile::Existing existing = OutputFile::Existing::keep;
  CoulombRequest request;
  Threads threads = {};
  Ranks ranks = {};
  int repeat = 1;
  bool compare = false;  ///< with direct summation: all points up to 20,000, else a sample of them
  bool json = false;     ///< one object instead of text
};

/// FileError for files that cannot be read or written, InputError for a wrong table or request.
void run(const FieldCommand& command, std::ostream& report);

}  // namespace treejet
