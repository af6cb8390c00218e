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

class StatFile final : public RowSink {
 public:
  StatFile(OutputFile file, const std::vector<std::string>& keys, const Provenance& made_by);
  void row(const std::vector<double>& values) override;
  void remark(const std::string& text) override;
  void finish() override { file_.sync(); }
  void visit(Archive& state) override { file_.visit(state); }

 private:
  OutputFile file_;
};

class TerminalTable final : public RowSink {
 public:
  explicit TerminalTable(std::vector<std::string> keys) : keys_(std::move(keys)) {}
  void row(const std::vector<double>& values) override;
  void remark(const std::string& text) override;

 private:
  std::vector<std::string> keys_;
  int rows_ = 0;
};

}  // namespace treejet
