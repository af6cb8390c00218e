#include <algorithm>

#include "core/io/h5md.hpp"
#include "core/io/h5md_names.hpp"

namespace treejet {

using namespace h5md;

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
