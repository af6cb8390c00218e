#include "validation/support/report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/observe/progress.hpp"

namespace treejet {

namespace {

std::string quoted(std::string text) {
  std::replace(text.begin(), text.end(), '"', '\'');
  std::replace(text.begin(), text.end(), '\n', ' ');
  return fmt::format("\"{}\"", text);
}

std::string header(const std::vector<std::string>& columns) {
  std::vector<std::string> names;
  for (const auto& c : columns) names.push_back(c.find(',') == c.npos ? c : quoted(c));
  return fmt::format("{}\n", fmt::join(names, ","));
}

std::size_t width(const std::string& column) {
  return std::max<std::size_t>(column.size(), 11);
}

}  // namespace

Cell::Cell(double v)
    : shown(std::isnan(v) ? "-" : fmt::format("{:.4g}", v)),
      written(std::isfinite(v) ? fmt::format("{}", v) : "") {}
Cell::Cell(std::int64_t v) : shown(fmt::format("{}", v)), written(shown) {}
Cell::Cell(const std::string& text) : shown(text), written(quoted(text)) {}

ResultTable::ResultTable(const std::filesystem::path& directory, const std::string& name,
                         const std::string& title, std::vector<std::string> columns)
    : shown_(!title.empty()), columns_(std::move(columns)) {
  const auto path = directory / (name + ".csv");
  file_.open(path);
  file_ << header(columns_);
  if (!file_) throw FileError(path.string() + ": cannot be written");
  if (!shown_) return;
  fmt::print("\n{}\n", title);
  for (const auto& c : columns_) fmt::print("  {:<{}}", c, width(c));
  fmt::print("\n");
}

void ResultTable::row(const std::vector<Cell>& cells) {
  std::vector<std::string> fields;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (shown_) fmt::print("  {:<{}}", cells[k].shown, width(columns_[k]));
    fields.push_back(cells[k].written);
  }
  if (shown_) fmt::print("\n");
  std::fflush(stdout);
  file_ << fmt::format("{}\n", fmt::join(fields, ",")) << std::flush;
}

Report::Report(std::filesystem::path directory, bool quick_study)
    : quick(quick_study), directory_(std::move(directory)) {
  std::error_code error;
  std::filesystem::create_directories(directory_, error);
  if (error) throw FileError(fmt::format("{}: {}", directory_.string(), error.message()));
}

void Report::section(const ReportSection& section) {
  sections_.push_back(section);
  fmt::print("\n=== {}\n", section.title);
}

ResultTable Report::table(const std::string& name, const std::string& title,
                          std::vector<std::string> columns) {
  tables_.push_back({sections_.empty() ? "" : sections_.back().title, name, title});
  return ResultTable(directory_, name, title, std::move(columns));
}

void Report::check(const std::string& claim, double found, double low, double high) {
  add({"", claim, found, low, high, std::nan(""), "", false});
}

void Report::compare(const std::string& claim, double found, const Elsewhere& e) {
  add({"", claim, found, e.value - e.allowed, e.value + e.allowed, e.value, e.source, false});
}

void Report::compare(const std::string& claim, double found, const ClosedAnswer& a) {
  add({"", claim, found, a.low, a.high, a.value, a.theory, false});
}

void Report::differs(const std::string& claim, double found, const Difference& d) {
  add({"", claim, found, d.low, d.high, d.elsewhere, d.explanation, true});
}

void Report::not_judged(const std::string& claim, const std::string& why) {
  const double nothing = std::nan("");
  add({"", claim, nothing, nothing, nothing, nothing, why, false, /*judged*/ false});
}

void Report::add(Claim claim) {
  if (!sections_.empty()) claim.section = sections_.back().title;
  claims_.push_back(std::move(claim));
}

void Report::progress(const std::string& study, int done, int runs) {
  const auto now = Clock::now();
  if (done == 0) begin_ = last_ = now;
  if (now - last_ < std::chrono::seconds(10)) return;
  last_ = now;
  const double since = std::chrono::duration<double>(now - begin_).count();
  fmt::print(stderr, "{}: {} of {} runs done, about {} left\n", study, done, runs,
             duration_text(since * (runs - done) / std::max(done, 1)));
}

int Report::conclude() {
  ResultTable contents(directory_, "sections", "", {"section", "asked", "reproduce"});
  for (const ReportSection& s : sections_) contents.row({s.title, s.asked, s.reproduce});
  ResultTable tables(directory_, "tables", "", {"section", "table", "title"});
  for (const Entry& e : tables_) tables.row({e.section, e.table, e.title});
  ResultTable checks(directory_, "checks", "",
                     {"section", "verdict", "claim", "found", "elsewhere", "at least", "at most", "remark"});
  fmt::print("\n=== Claims: verdict, what was found, where it must be\n");
  for (const Claim& c : claims_) {
    checks.row({c.section, c.verdict(), c.text, c.found, c.elsewhere, c.low, c.high, c.remark});
    if (!c.judged) {
      fmt::print("  {:<18}  {}: {}\n", c.verdict(), c.text, c.remark);
      continue;
    }
    fmt::print("  {:<18}  {:>10.4g} in [{:.4g}, {:.4g}]  {}\n", c.verdict(), c.found, c.low, c.high, c.text);
    if (c.explained) fmt::print("{:>20}  elsewhere {:.4g}: {}\n", "", c.elsewhere, c.remark);
  }
  return static_cast<int>(std::count_if(claims_.begin(), claims_.end(), [](auto& c) { return !c.holds(); }));
}

}  // namespace treejet
