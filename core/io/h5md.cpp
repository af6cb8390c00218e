#include "core/io/h5md.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "core/base/error.hpp"
#include "core/base/lines.hpp"
#include "core/deck/observable_keys.hpp"
#include "core/io/h5md_names.hpp"

namespace treejet {

std::string h5md::element(const char* group, std::string_view name, const char* part) {
  return fmt::format("{}/{}/{}", group, name, part);
}

using namespace h5md;

namespace {

constexpr std::uint64_t times_a_chunk = 1024;

/// A unit in the words of H5MD: factors with signed powers.
std::string h5md_unit(std::string_view key) {
  static const std::map<std::string_view, const char*> words = {{"g/(cm s^2)", "g cm-1 s-2"},
                                                                {"g/(cm s)", "g cm-1 s-1"},
                                                                {"cm/s", "cm s-1"},
                                                                {"statC/s", "statC s-1"},
                                                                {"g/s", "g s-1"},
                                                                {"1/s", "s-1"},
                                                                {"cm^3", "cm3"},
                                                                {"1", ""}};
  const ObservableKey* known = observable_key(key);
  if (!known) return {};
  const auto found = words.find(known->unit);
  return found == words.end() ? std::string(known->unit) : found->second;
}

std::uint64_t length(const Hdf5File& file, const std::string& dataset) {
  return file.has(dataset) ? file.extent(dataset).at(0) : 0;
}

/// Step and time of an element, as links to those of the first one of the group.
void make_times(Hdf5File& file, const char* group, std::string_view name, std::string_view first) {
  for (const char* part : {"step", "time"}) {
    const std::string own = element(group, name, part);
    if (name != first) {
      file.link(element(group, first, part), own);
      continue;
    }
    const bool is_time = part == std::string_view("time");
    file.dataset(own, {is_time ? Hdf5File::Number::real : Hdf5File::Number::integer, {0}, {times_a_chunk}});
    if (is_time) file.word_attribute(own, "unit", "s");
  }
}

}  // namespace

H5md::H5md(const std::filesystem::path& path, const Content& content, const Chunk& chunk)
    : file_(path, Hdf5File::Access::create), content_(content), columns_(frame_columns(content.added)) {
  describe();
  make_elements(chunk);
}

void H5md::describe() {
  file_.group("/h5md/author");
  file_.group("/h5md/creator");
  file_.group("/h5md/modules/units");
  file_.attribute("/h5md", "version", std::vector<int>{1, 1});
  file_.attribute("/h5md/author", "name", "not recorded");
  file_.attribute("/h5md/creator", "name", "treejet");
  file_.attribute("/h5md/creator", "version", content_.made_by.version);
  file_.attribute("/h5md/modules/units", "version", std::vector<int>{1, 0});
  file_.word_attribute("/h5md/modules/units", "system", "CGS");
  const Provenance& p = content_.made_by;
  const auto note = [&](const char* name, const std::string& value) {
    file_.text(fmt::format("{}/{}", parameters, name), value);
  };
  note("version", p.version);
  note("commit", p.commit);
  note("compiler", p.compiler);
  note("build", p.build);
  note("vector_path", p.isa_name);
  note("libraries", p.libraries);
  note("deck_name", p.deck_name);
  note("deck", p.deck);
  note("overrides", fmt::format("{}", fmt::join(p.overrides, "\n")));
  note("observables", fmt::format("{}", fmt::join(content_.keys, " ")));
  note("run_record", run_record_name);
  if (!p.begins_with.empty()) note("begins_with", p.begins_with);
  if (!p.field_map.empty()) note("field_map", p.field_map);
  if (content_.added.empty()) return;
  std::string lines;
  for (const FrameColumn& c : content_.added) lines += fmt::format("{} {}\n", c.name, c.unit);
  note("columns", lines);
}

void H5md::make_elements(const Chunk& chunk) {
  using Number = Hdf5File::Number;
  const auto& [frames, points, compressed] = chunk;
  const std::string box = fmt::format("{}/box", jet);
  file_.group(box);
  file_.attribute(box, "dimension", std::vector<int>{3});
  file_.attribute(box, "boundary", std::vector<std::string>(3, "none"));
  const std::string first = columns_[0].name;
  for (const auto& [name, unit, width] : columns_) {
    const auto w = static_cast<std::uint64_t>(width);
    const std::string value = element(jet, name, "value");
    if (width == 1)
      file_.dataset(value, {Number::real, {0, 0}, {frames, points}, nan, compressed});
    else
      file_.dataset(value, {Number::real, {0, 0, w}, {frames, points, w}, nan, compressed});
    file_.word_attribute(value, "unit", unit);
    make_times(file_, jet, name, first);
  }
  file_.dataset(element(jet, "id", "value"), {Number::integer, {0, 0}, {frames, points}, absent, compressed});
  make_times(file_, jet, "id", first);

  file_.group(observables);
  for (const auto& key : content_.keys) {
    const auto own = content_.units.find(key);
    const std::string value = element(observables, key, "value"),
                      unit = own == content_.units.end() ? h5md_unit(key) : own->second;
    file_.dataset(value, {Number::real, {0}, {times_a_chunk}, nan});
    if (!unit.empty()) file_.word_attribute(value, "unit", unit);
    make_times(file_, observables, key, content_.keys[0]);
  }
}

H5md::H5md(const std::filesystem::path& path, Hdf5File::Access access) : file_(path, access) {
  const char* creator = "/h5md/creator";
  if (!file_.has(creator) || file_.text_attribute(creator, "name") != "treejet")
    throw FileError(fmt::format("{}: an HDF5 file, but no trajectory of treejet", path.string()));
  const auto noted = [&](const char* name) { return file_.text(fmt::format("{}/{}", parameters, name)); };
  content_.made_by = {noted("version"),
                      noted("commit"),
                      noted("compiler"),
                      noted("build"),
                      noted("vector_path"),
                      noted("libraries"),
                      noted("deck_name"),
                      noted("deck"),
                      {},
                      {}};
  const std::string begins_with = fmt::format("{}/begins_with", parameters);
  if (file_.has(begins_with)) content_.made_by.begins_with = file_.text(begins_with);
  const std::string field_map = fmt::format("{}/field_map", parameters);
  if (file_.has(field_map)) content_.made_by.field_map = file_.text(field_map);
  const std::string overrides = noted("overrides");
  for (const auto line : lines_of(overrides)) content_.made_by.overrides.emplace_back(line);
  content_.keys = words_of(noted("observables"));
  read_added_columns();
  const Extent ids = file_.extent(element(jet, "id", "value"));
  frames_ = ids[0];
  points_ = ids.size() > 1 ? ids[1] : 0;
  if (!content_.keys.empty()) rows_ = length(file_, element(observables, content_.keys[0], "value"));
  check_extents();
}

void H5md::read_added_columns() {
  const std::string list = fmt::format("{}/columns", parameters);
  const std::string text = file_.has(list) ? file_.text(list) : "";
  for (const std::string_view line : lines_of(text)) {
    const auto blank = std::min(line.find(' '), line.size());
    const std::string name(line.substr(0, blank));
    if (!is_column_name(name)) throw FileError(fmt::format("{}: `{}` is no name of a column", list, name));
    content_.added.push_back({name, std::string(line.substr(std::min(blank + 1, line.size())))});
  }
  columns_ = frame_columns(content_.added);
}

/// All that is read later has the extent that the ids, or the first observable, have.
void H5md::check_extents() const {
  const auto expect = [&](const std::string& name, const Extent& extent) {
    if (const Extent found = file_.extent(name); found != extent)
      throw FileError(fmt::format("{} has {} values where {} are expected", name, fmt::join(found, " x "),
                                  fmt::join(extent, " x ")));
  };
  expect(element(jet, "id", "value"), {frames_, points_});
  for (const auto& [name, unit, width] : columns_) {
    Extent extent{frames_, points_};
    if (width > 1) extent.push_back(static_cast<std::uint64_t>(width));
    expect(element(jet, name, "value"), extent);
  }
  for (const char* part : {"step", "time"}) {
    expect(element(jet, columns_[0].name, part), {frames_});
    if (rows_ > 0) expect(element(observables, content_.keys[0], part), {rows_});
  }
  for (const auto& key : content_.keys) expect(element(observables, key, "value"), {rows_});
}

}  // namespace treejet
