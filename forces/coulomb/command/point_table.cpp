#include "forces/coulomb/command/point_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string_view>

#include "core/base/error.hpp"
#include "core/base/lines.hpp"
#include "core/base/number.hpp"
#include "core/base/output_file.hpp"

namespace treejet {

namespace {

std::vector<std::string_view> cells(std::string_view line) {
  std::vector<std::string_view> all;
  while (true) {
    const auto comma = line.find(',');
    std::string_view cell = line.substr(0, comma);
    while (!cell.empty() && (cell.front() == ' ' || cell.front() == '\t')) cell.remove_prefix(1);
    while (!cell.empty() && (cell.back() == ' ' || cell.back() == '\t')) cell.remove_suffix(1);
    all.push_back(cell);
    if (comma == std::string_view::npos) return all;
    line.remove_prefix(comma + 1);
  }
}

/// The places of x, y, z and q in the header.
std::array<std::size_t, 4> columns(const std::string& file, std::string_view header, std::size_t number) {
  const std::vector<std::string_view> names = cells(header);
  std::array<std::size_t, 4> place{};
  for (std::size_t k = 0; k < 4; ++k) {
    const std::string_view wanted = std::string_view("xyzq").substr(k, 1);
    const auto found = std::find(names.begin(), names.end(), wanted);
    if (found == names.end())
      throw InputError(fmt::format("{}: line {} names no column {}; expected x,y,z,q", file, number, wanted));
    if (std::find(found + 1, names.end(), wanted) != names.end())
      throw InputError(fmt::format("{}: line {} names column {} twice", file, number, wanted));
    place[k] = static_cast<std::size_t>(found - names.begin());
  }
  return place;
}

}  // namespace

PointTable read_points(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::error_code error;
  if (!in || std::filesystem::is_directory(file, error)) throw FileError("cannot read " + file);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  PointTable table;
  std::array<std::size_t, 4> place{};
  std::size_t number = 0, width = 0;  // no width: the header is still to come
  for (const std::string_view whole : lines_of(text)) {
    ++number;
    const std::string_view line = whole.substr(0, whole.find('#'));
    if (line.find_first_not_of(" \t") == std::string_view::npos) continue;
    const std::vector<std::string_view> cell = cells(line);
    if (width == 0) {
      place = columns(file, line, number);
      width = cell.size();
      continue;
    }
    if (cell.size() != width)
      throw InputError(
          fmt::format("{}: line {} has {} values, the header names {}; numbers with a decimal comma? "
                      "write them with a point",
                      file, number, cell.size(), width));
    for (std::size_t k = 0; k < 4; ++k) {
      const Reading<double> reading = real_number(cell[place[k]]);
      if (!reading.problem.empty())
        throw InputError(
            fmt::format("{}: line {}: expected a finite number, {}", file, number, reading.problem));
      (k < 3 ? table.r[k] : table.q).push_back(reading.value);
    }
  }
  if (table.size() == 0) throw InputError(file + ": no points");
  return table;
}

void write_field(const std::string& file, OutputFile::Existing existing, const PointTable& points,
                 const FieldArrays<3>& field, const double* potential) {
  OutputFile out(file, existing);
  constexpr std::size_t block = 1 << 16;
  std::string text = "x,y,z,q,ex,ey,ez,potential\n";
  for (std::size_t i = 0; i < points.q.size(); ++i) {
    fmt::format_to(std::back_inserter(text),
                   "{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g}\n", points.r[0][i],
                   points.r[1][i], points.r[2][i], points.q[i], field[0][i], field[1][i], field[2][i],
                   potential[i]);
    if (text.size() < block) continue;
    out.write(text);
    text.clear();
  }
  out.write(text);
}

}  // namespace treejet
