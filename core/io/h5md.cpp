#include "core/io/h5md.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <map>

#include "core/base/error.hpp"
#include "core/base/lines.hpp"
#include "core/deck/observable_keys.hpp"

namespace treejet {

namespace {

constexpr const char *jet = "/particles/jet", *observables = "/observables", *parameters = "/parameters";
constexpr std::int64_t absent = -1;
constexpr std::uint64_t times_a_chunk = 1024;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A unit in the words of H5MD: factors with signed powers.
std::string h5md_unit(std::string_view key) {
  static const std::map<std::string_view, const char*> words = {{"g/(cm s^2)", "g cm-1 s-2"},
                                                                {"cm/s", "cm s-1"},
                                                                {"statC/s", "statC s-1"},
                                                                {"g/s", "g s-1"},
                                                                {"1/s", "s-1"},
                                                                {"1", ""}};
  for (const auto& known : observable_keys) {
    if (known.key != key) continue;
    const auto found = words.find(known.unit);
    return found == words.end() ? std::string(known.unit) : found->second;
  }
  return {};
}

std::string element(const char* group, std::string_view name, const char* part) {
  return fmt::format("{}/{}/{}", group, name, part);
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

/// Appends a block of this size to an element's values, which get wider if it is.
template <class T>
void H5md::put(const std::string& element, const std::vector<T>& table, Extent size) {
  Hdf5File::Box box{Extent(size.size(), 0), size};
  Extent whole = file_.extent(element);
  box.first[0] = whole[0];
  whole[0] += size[0];
  for (std::size_t k = 1; k < size.size(); ++k) whole[k] = std::max(whole[k], size[k]);
  file_.resize(element, whole);
  file_.write(element, box, table.data());
}

void H5md::append(std::span<const Frame> frames) {
  if (frames.empty()) return;
  for (const Frame& f : frames) points_ = std::max<std::uint64_t>(points_, f.points());
  std::vector<std::int64_t> id, step;
  std::vector<double> time, values;
  for (const Frame& f : frames) {
    step.push_back(f.step);
    time.push_back(f.time);
    id.insert(id.end(), f.id.begin(), f.id.end());
    id.resize(step.size() * points_, absent);
  }
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const auto width = static_cast<std::uint64_t>(columns_[c].width);
    values.clear();
    for (const Frame& f : frames) {
      const std::size_t begin = values.size();
      values.insert(values.end(), f.columns[c].begin(), f.columns[c].end());
      values.resize(begin + points_ * width, nan);
    }
    Extent size{frames.size(), points_};
    if (width > 1) size.push_back(width);
    put(element(jet, columns_[c].name, "value"), values, size);
  }
  put(element(jet, "id", "value"), id, {frames.size(), points_});
  put(element(jet, columns_[0].name, "step"), step, {frames.size()});
  put(element(jet, columns_[0].name, "time"), time, {frames.size()});
  frames_ += frames.size();
}

void H5md::begin_frame(std::int64_t step, double time, std::uint64_t points) {
  points_ = std::max(points_, points);
  for (const auto& [name, unit, width] : columns_) {
    Extent extent{frames_ + 1, points_};
    if (width > 1) extent.push_back(static_cast<std::uint64_t>(width));
    file_.resize(element(jet, name, "value"), extent);
  }
  file_.resize(element(jet, "id", "value"), {frames_ + 1, points_});
  put(element(jet, columns_[0].name, "step"), std::vector<std::int64_t>{step}, {1});
  put(element(jet, columns_[0].name, "time"), std::vector<double>{time}, {1});
  ++frames_;
  filled_ = 0;
}

void H5md::append_part(const Frame& part) {
  const std::uint64_t n = part.points(), frame = frames_ - 1;
  if (n == 0) return;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    Hdf5File::Box box{{frame, filled_}, {1, n}};
    if (const int width = columns_[c].width; width > 1)
      box.first.push_back(0), box.size.push_back(static_cast<std::uint64_t>(width));
    file_.write(element(jet, columns_[c].name, "value"), box, part.columns[c].data());
  }
  file_.write(element(jet, "id", "value"), {{frame, filled_}, {1, n}}, part.id.data());
  filled_ += n;
}

Frame H5md::part(std::uint64_t frame, std::uint64_t first, std::uint64_t count) const {
  Frame f;
  file_.read(element(jet, columns_[0].name, "step"), {{frame}, {1}}, &f.step);
  file_.read(element(jet, columns_[0].name, "time"), {{frame}, {1}}, &f.time);
  count = std::min(count, points_ - std::min(first, points_));
  f.id.resize(count);
  if (count > 0) file_.read(element(jet, "id", "value"), {{frame, first}, {1, count}}, f.id.data());
  f.id.erase(std::find(f.id.begin(), f.id.end(), absent), f.id.end());
  for (const auto& [name, unit, width] : columns_) {
    const auto w = static_cast<std::uint64_t>(width);
    std::vector<double>& values = f.columns.emplace_back(f.points() * w);
    Hdf5File::Box box{{frame, first}, {1, f.points()}};
    if (width > 1) box.first.push_back(0), box.size.push_back(w);
    if (!values.empty()) file_.read(element(jet, name, "value"), box, values.data());
  }
  return f;
}

std::uint64_t H5md::points_of(std::uint64_t frame) const {
  std::vector<std::int64_t> id(points_at_once);
  for (std::uint64_t first = 0; first < points_; first += points_at_once) {
    id.resize(std::min(points_at_once, points_ - first));
    file_.read(element(jet, "id", "value"), {{frame, first}, {1, id.size()}}, id.data());
    const auto end = std::find(id.begin(), id.end(), absent);
    if (end != id.end()) return first + static_cast<std::uint64_t>(end - id.begin());
  }
  return points_;
}

std::pair<double, std::uint64_t> H5md::copy_frame(const H5md& from, std::uint64_t frame) {
  const std::uint64_t points = from.points_of(frame);
  Frame part = from.part(frame, 0, points_at_once);
  const double time = part.time;
  begin_frame(part.step, time, points);
  while (true) {
    append_part(part);
    if (filled_ >= points) return {time, points};
    part = from.part(frame, filled_, points_at_once);
  }
}

void H5md::append(std::span<const Row> rows) {
  if (rows.empty() || content_.keys.empty()) return;
  std::vector<std::int64_t> step;
  std::vector<double> values;
  for (const Row& r : rows) step.push_back(r.step);
  for (std::size_t k = 0; k < content_.keys.size(); ++k) {
    values.clear();
    for (const Row& r : rows) values.push_back(r.values.at(k));
    put(element(observables, content_.keys[k], "value"), values, {rows.size()});
  }
  values.clear();
  for (const Row& r : rows) values.push_back(r.time);
  put(element(observables, content_.keys[0], "step"), step, {rows.size()});
  put(element(observables, content_.keys[0], "time"), values, {rows.size()});
  rows_ += rows.size();
}

std::vector<double> H5md::times() const {
  std::vector<double> times(frames_);
  file_.read(element(jet, columns_[0].name, "time"), {{0}, {frames_}}, times.data());
  return times;
}

std::vector<Frame> H5md::frames(std::uint64_t first, std::uint64_t count) const {
  std::vector<Frame> frames(count);
  if (count == 0) return frames;
  std::vector<std::int64_t> step(count), id(count * points_);
  std::vector<double> time(count), values;
  const std::string& shared = columns_[0].name;
  file_.read(element(jet, shared, "step"), {{first}, {count}}, step.data());
  file_.read(element(jet, shared, "time"), {{first}, {count}}, time.data());
  file_.read(element(jet, "id", "value"), {{first, 0}, {count, points_}}, id.data());
  for (std::size_t i = 0; i < count; ++i) {
    frames[i].step = step[i];
    frames[i].time = time[i];
    const auto begin = id.begin() + static_cast<long>(i * points_), end = begin + static_cast<long>(points_);
    frames[i].id.assign(begin, std::find(begin, end, absent));
  }
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const auto width = static_cast<std::uint64_t>(columns_[c].width);
    values.resize(count * points_ * width);
    Hdf5File::Box box{{first, 0}, {count, points_}};
    if (width > 1) box.first.push_back(0), box.size.push_back(width);
    file_.read(element(jet, columns_[c].name, "value"), box, values.data());
    for (std::size_t i = 0; i < count; ++i) {
      const auto begin = values.begin() + static_cast<long>(i * points_ * width);
      frames[i].columns.emplace_back(begin, begin + static_cast<long>(frames[i].points() * width));
    }
  }
  return frames;
}

std::vector<Row> H5md::rows(std::uint64_t first, std::uint64_t count) const {
  std::vector<Row> rows(count);
  if (count == 0) return rows;
  std::vector<std::int64_t> step(count);
  std::vector<double> values(count);
  file_.read(element(observables, content_.keys[0], "step"), {{first}, {count}}, step.data());
  file_.read(element(observables, content_.keys[0], "time"), {{first}, {count}}, values.data());
  for (std::size_t i = 0; i < count; ++i) rows[i].step = step[i], rows[i].time = values[i];
  for (const auto& key : content_.keys) {
    file_.read(element(observables, key, "value"), {{first}, {count}}, values.data());
    for (std::size_t i = 0; i < count; ++i) rows[i].values.push_back(values[i]);
  }
  return rows;
}

}  // namespace treejet
