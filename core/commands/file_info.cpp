#include "core/commands/file_info.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/lines.hpp"
#include "core/io/h5md.hpp"
#include "core/io/run_record.hpp"
#include "core/restart/checkpoint.hpp"

namespace treejet {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void cut_short(const fs::path& path, const std::string& where) {
  throw FileError(fmt::format("{}: cut short: {}", path.string(), where));
}

std::string trajectory(const fs::path& path) {
  const H5md file(path, Hdf5File::Access::read);
  const std::uint64_t frames = file.frames(), rows = file.rows();
  std::string text = fmt::format("H5MD trajectory: {} frames", frames);
  if (frames > 0) {
    const Frame first = file.frames(0, 1).front(), last = file.frames(frames - 1, 1).front();
    text += fmt::format(", t = {:.10g} to {:.10g} s, up to {} points, {} in the last frame", first.time,
                        last.time, file.points(), last.points());
  }
  std::vector<std::string> columns{"id"};
  for (const auto& c : file.columns()) columns.push_back(fmt::format("{} [{}]", c.name, c.unit));
  text += fmt::format("\npoints  {}\n", fmt::join(columns, ", "));
  text += fmt::format("observables  {} rows of: {}\n", rows, fmt::join(file.content().keys, " "));
  return text + description(file.content().made_by);
}

std::string checkpoint(const fs::path& path) {
  const Checkpoint c = read_checkpoint(path);
  std::string text =
      fmt::format("checkpoint at t = {:.10g} s; to go on: treejet run --resume {}\n{}\n", c.t,
                  for_shell(path.has_parent_path() ? path.parent_path().string() : "."), c.program);
  return text + deck_description(c.deck_name, c.deck_text, c.overrides);
}

bool is_label(const std::string& word) {
  return word.find('[') != std::string::npos && word.back() == ']';
}

/// Units hold blanks: "st[g/(cm s^2)]" is one label.
std::vector<std::string> labels(const std::string& header) {
  std::vector<std::string> all;
  std::istringstream words(header.substr(1));
  for (std::string word; words >> word;) {
    const bool continues =
        !all.empty() && all.back().find('[') != std::string::npos && all.back().back() != ']';
    if (continues)
      all.back() += fmt::format(" {}", word);
    else
      all.push_back(word);
  }
  return all;
}

std::string statistics(const fs::path& path) {
  std::ifstream file(path);
  std::string line, made_by, first, last;
  std::getline(file, line);
  const std::vector<std::string> columns = labels(line);
  std::uint64_t rows = 0;
  while (std::getline(file, line)) {
    if (file.eof()) cut_short(path, "the last line has no end");
    if (line.starts_with("#")) {
      made_by += fmt::format("{}\n", line.substr(std::min(line.find_first_not_of("# "), line.size())));
      continue;
    }
    ++rows;
    std::istringstream values(line);
    std::uint64_t count = 0;
    for (std::string value; values >> value; ++count)
      if (count == 0) (rows == 1 ? first : last) = value;
    if (count != columns.size())
      cut_short(path, fmt::format("row {} has {} of {} values", rows, count, columns.size()));
  }
  std::string text = fmt::format("statistics: {} rows of {}\n", rows, fmt::join(columns, ", "));
  if (rows > 1) text += fmt::format("{} from {} to {}\n", columns[0], first, last);
  return text + made_by;
}

std::string xyz(const fs::path& path) {
  std::ifstream file(path);
  std::string line, comment, first, last;
  std::uint64_t frames = 0, most = 0;
  while (std::getline(file, line)) {
    std::uint64_t points = 0;
    if (std::from_chars(line.data(), line.data() + line.size(), points).ec != std::errc{})
      throw FileError(
          fmt::format("{}: frame {}: expected a number of points, found {}", path.string(), frames, line));
    most = std::max(most, points);
    std::getline(file, comment);
    (frames == 0 ? first : last) = comment;
    for (std::uint64_t i = 0; i < points; ++i)
      if (!std::getline(file, line) || file.eof())
        cut_short(path, fmt::format("frame {} has {} of {} points", frames, i, points));
    ++frames;
  }
  return fmt::format("XYZ trajectory: {} frames of up to {} points\nfirst  {}\nlast   {}\n", frames, most,
                     first, last);
}

std::string csv(const fs::path& path) {
  std::ifstream file(path);
  std::string header, line;
  std::getline(file, header);
  std::uint64_t rows = 0;
  while (std::getline(file, line)) {
    if (file.eof() ||
        std::count(line.begin(), line.end(), ',') != std::count(header.begin(), header.end(), ','))
      cut_short(path, fmt::format("row {}", rows));
    ++rows;
  }
  return fmt::format("points of a trajectory: {} rows of {}\n", rows, header);
}

std::string xml(const fs::path& path, const std::string& kind) {
  std::ifstream file(path);
  std::string line, made_by;
  std::uint64_t grids = 0;
  std::string last;
  while (std::getline(file, line)) {
    if (line.starts_with("<!-- treejet")) made_by = line.substr(5, line.size() - 9);
    grids += line.starts_with("<Grid Name=\"frame") || line.starts_with("<DataSet");
    last = line;
  }
  if (last != (kind == "XDMF" ? "</Xdmf>" : "</VTKFile>")) cut_short(path, "the closing tag is missing");
  return fmt::format("{} for ParaView{}\n{}\n", kind, grids > 0 ? fmt::format(": {} frames", grids) : "",
                     made_by);
}

/// What tells a text file: how its first two lines begin.
struct Recogniser {
  bool (*knows)(const std::string& first, const std::string& second);
  std::string (*tells)(const fs::path& path);
};

using Line = const std::string&;
constexpr Recogniser text_files[] = {
    {[](Line first, Line) { return first.starts_with("{"); }, run_record_text},
    {[](Line first, Line) { return first.starts_with("treejet checkpoint"); }, checkpoint},
    {[](Line first, Line) {
       if (!first.starts_with("# ")) return false;
       const auto columns = labels(first);
       return !columns.empty() && std::all_of(columns.begin(), columns.end(), is_label);
     },
     statistics},
    {[](Line, Line second) {
       return second.starts_with("t = ") || second.starts_with("Properties=species:S:1:pos");
     },
     xyz},
    {[](Line first, Line) { return first.starts_with("frame,t[s],id,"); }, csv},
    {[](Line, Line second) { return second.starts_with("<!DOCTYPE Xdmf"); },
     [](const fs::path& path) { return xml(path, "XDMF"); }},
    {[](Line first, Line second) { return first.starts_with("<?xml") && second.starts_with("<!-- treejet"); },
     [](const fs::path& path) { return xml(path, "VTK"); }}};

std::string text_file(const fs::path& path) {
  std::ifstream file(path);
  std::string first, second;
  std::getline(file, first);
  std::getline(file, second);
  for (const auto& [knows, tells] : text_files)
    if (knows(first, second)) return tells(path);
  throw FileError(fmt::format("{}: no file that treejet has written", path.string()));
}

}  // namespace

std::string file_info(const fs::path& path) {
  std::error_code error;
  if (fs::is_directory(path, error))
    throw FileError(fmt::format("{}: is a directory; name a file in it", path.string()));
  if (fs::exists(path, error) && !fs::is_regular_file(path, error))
    throw FileError(fmt::format("{}: not a regular file", path.string()));
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError(fmt::format("{}: cannot be read", path.string()));
  if (file.peek() == std::ifstream::traits_type::eof())
    throw FileError(fmt::format("{}: empty", path.string()));
  return printable(is_hdf5(path) ? trajectory(path) : text_file(path));
}

}  // namespace treejet
