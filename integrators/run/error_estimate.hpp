#pragma once
/// `treejet run --estimate-error`: how far the rows of statdat.dat and their means are off because steps have
/// a length.
///
/// A second run of the deck, in memory, at a tenth of the tolerance (half of a fixed timestep) gives the rows
/// once more. The difference is the error of the first less that of the second: a tenth of it, or up to a
/// half at loose tolerances, where events end most steps of both. Of fixed steps with events seen at their
/// ends it is half of the error.
/// statdat.error.dat holds it row by row, first minus second: the error of a mean over rows is the mean of
/// their differences.

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/io/run_record.hpp"
#include "core/observe/own_observable.hpp"
#include "forces/scene/scene.hpp"

namespace treejet {

constexpr const char* error_table_name = "statdat.error.dat";

/// A table of observables by column; labels are "x[cm]".
struct TableOfRows {
  std::vector<std::string> labels;
  std::vector<std::vector<double>> rows;
};

/// InputError if the deck's run has no rows to estimate.
void expect_estimable(const Parameters& p);

/// The same deck at a tenth of the tolerance, or half the timestep.
Parameters finer(Parameters p);

/// "a run at tolerance 1e-07".
std::string finer_description(const Parameters& p);

/// The rows of statdat.dat. FileError if it cannot be read.
TableOfRows read_rows(const std::filesystem::path& statdat);

/// The same rows of a run to its end, without files, on the first rank; none if told to stop before, between
/// any two steps.
template <int D>
std::optional<TableOfRows> rows_of_run(const Parameters& p, Scene<D>& scene, const OwnObservables<D>& own,
                                       std::function<bool()> stop_here);

/// Row by row first minus second, but for the time, which is kept; columns that tell of the wall clock are
/// left out. As many rows as both have.
TableOfRows difference(const TableOfRows& first, const TableOfRows& second);

/// For each column of the differences but the time: the greatest of a row, and that of the mean that the
/// run's own summary takes, over the same rows (core/observe/steady_mean.hpp). Rows without a value do not
/// count.
std::vector<ErrorOfObservable> errors(const TableOfRows& first, const TableOfRows& differences);

/// As the closing summary shows them.
std::string errors_text(const std::vector<ErrorOfObservable>& errors, const std::string& against);

/// The file.
std::string rows_text(const TableOfRows& table, const std::string& against);

}  // namespace treejet
