#pragma once
/// A table of charges in a file of comma-separated values (format: forces/coulomb/command/field_command.hpp).

#include <string>
#include <vector>

#include "core/base/output_file.hpp"
#include "forces/coulomb/coulomb.hpp"

namespace treejet {

struct PointTable {
  std::vector<double> r[3], q;

  int size() const { return static_cast<int>(q.size()); }
  PointCharges<3> view() const { return {{r[0].data(), r[1].data(), r[2].data()}, q.data(), size()}; }
};

/// FileError if the file cannot be read; InputError, with the line, if a column is missing or a number is not
/// one.
PointTable read_points(const std::string& file);

/// Writes points, field and potential; FileError if that fails.
void write_field(const std::string& file, OutputFile::Existing existing, const PointTable& points,
                 const FieldArrays<3>& field, const double* potential);

}  // namespace treejet
