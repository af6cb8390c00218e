#include "core/observe/output_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/deck/observable_keys.hpp"
#include "core/observe/progress.hpp"

namespace treejet {

std::string label(const std::string& key) {
  const ObservableKey* known = observable_key(key);
  return known ? fmt::format("{}[{}]", key, known->unit) : key;
}

namespace {
/// A terminal that has gone does not end the run; the front door tells of the failure in the end.
void put(const std::string& text) {
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}
}  // namespace

StatFile::StatFile(OutputFile file, const std::vector<std::string>& labels, const Provenance& made_by,
                   std::vector<std::string> changes)
    : file_(std::move(file)), changes_(std::move(changes)) {
  if (!file_.is_new()) return;
  std::string header = "#";
  for (std::string word : labels) {
    std::replace(word.begin(), word.end(), ' ', '*');  // one word a column for readers that split at blanks
    header += " " + word;
  }
  file_.write(
      fmt::format("{}\n{}## circumstances: {}\n", header, commented(made_by, "## "), run_record_name));
}

void StatFile::visit(Archive& state) {
  file_.visit(state);
  if (!state.reading()) return;
  for (const std::string& line : changes_) file_.write(fmt::format("## from here on --set \"{}\"\n", line));
}

std::string row_text(const std::vector<double>& values) {
  std::string line;
  for (double v : values) line += fmt::format("{:>24.16e}", v);
  return line + "\n";
}

void StatFile::row(const std::vector<double>& values) {
  file_.write(row_text(values));
}

void StatFile::remark(const std::string& text) {
  file_.write(fmt::format("# {}\n", text));
}

void TerminalTable::remark(const std::string& text) {
  if (stderr_is_interactive()) fmt::print(stderr, "{}", clear_line);
  put(fmt::format("# {}\n", text));
}

void TerminalTable::row(const std::vector<double>& values) {
  constexpr int rows_a_header = 50;
  std::string text;
  if (rows_++ % rows_a_header == 0) {
    for (const auto& label : labels_) text += fmt::format("{:>16}", label);
    text += "\n";
  }
  for (double v : values) text += std::isnan(v) ? fmt::format("{:>16}", "-") : fmt::format("{:>16.8g}", v);
  if (stderr_is_interactive()) fmt::print(stderr, "{}", clear_line);
  put(text + "\n");
}

}  // namespace treejet
