#pragma once
/// The two tables of observables.
///
/// statdat.dat: a first line `# key[unit] key[unit] ...`, lines `## ...` that tell what made the file, then
/// one row a print time, numbers with 17 significant digits separated by blanks, `nan` where there is no
/// value. Remarks on the rows that follow are lines that begin with `# `. The terminal table carries the same
/// rows with fewer digits, and a dash for `nan`, under a header of its own.

#include <string>
#include <vector>

#include "core/base/output_file.hpp"
#include "core/io/provenance.hpp"
#include "core/observe/recorder.hpp"

namespace treejet {

/// "key[unit]" of a key of core/deck/observable_keys.hpp.
std::string label(const std::string& key);

/// The heads of the columns, "key[unit]": those of the deck, and behind them a caller's own.
template <int D>
std::vector<std::string> labels(const std::vector<std::string>& keys, const OwnObservables<D>& own) {
  std::vector<std::string> all;
  for (const auto& key : keys) all.push_back(label(key));
  for (const auto& o : own) all.push_back(o.key + "[" + o.unit + "]");
  return all;
}

/// A row of statdat.dat.
std::string row_text(const std::vector<double>& values);

class StatFile final : public RowSink {
 public:
  /// The changes of a deck since the rows that are there already are told where its rows begin.
  StatFile(OutputFile file, const std::vector<std::string>& labels, const Provenance& made_by,
           std::vector<std::string> changes = {});
  void row(const std::vector<double>& values) override;
  void remark(const std::string& text) override;
  void finish() override { file_.sync(); }
  void visit(Archive& state) override;

 private:
  OutputFile file_;
  std::vector<std::string> changes_;
};

class TerminalTable final : public RowSink {
 public:
  explicit TerminalTable(std::vector<std::string> labels) : labels_(std::move(labels)) {}
  void row(const std::vector<double>& values) override;
  void remark(const std::string& text) override;

 private:
  std::vector<std::string> labels_;
  int rows_ = 0;
};

}  // namespace treejet
