#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <numeric>
#include <random>

#include "core/base/error.hpp"
#include "core/commands/convert.hpp"
#include "core/commands/file_info.hpp"
#include "core/io/atomic_file.hpp"
#include "core/io/h5md_trajectory.hpp"
#include "core/io/hdf5_file.hpp"
#include "integrators/run/integration.hpp"
#include "validation/support/scratch_directory.hpp"

using namespace treejet;
namespace fs = std::filesystem;

namespace {

using Existing = OutputFile::Existing;

/// Points come and go: up to 300 of them, more than a chunk of a growing file holds, in no order of size.
Frame frame_of(int k) {
  std::mt19937_64 random(static_cast<unsigned>(k));
  std::normal_distribution<double> any;
  Frame f;
  f.time = 1e-4 * k;
  const int beads = k * 53 % 300;
  for (int i = 0; i < beads; ++i) f.id.push_back(k + i + 1);
  f.id.push_back(0);
  for (const FrameColumn& column : frame_columns({{"solvent", "g"}})) {
    std::vector<double>& values = f.columns.emplace_back();
    for (std::size_t i = 0; i < f.points() * static_cast<std::size_t>(column.width); ++i)
      values.push_back(any(random));
  }
  return f;
}

Row row_of(int k) {
  return {0, 2e-4 * k, {double(k), 1.0 / (k + 1)}};
}

const H5md::Content content{{"1.2.3",
                             "abc",
                             "GNU",
                             "Release",
                             "avx2",
                             "HDF5",
                             "input.dat",
                             "system 3\nfinish\n",
                             {"tolerance 1.d-5"},
                             {}},
                            {"x", "curn"},
                            {{"solvent", "g"}}};
constexpr int frames = 70;

/// Frames from `first` on, with a row every other one; `after` is told each.
template <class After>
void append(H5mdTrajectory& file, int first, int last, After after) {
  for (int k = first; k < last; ++k) {
    file.append(frame_of(k));
    if (k % 2 == 0) file.append(row_of(k / 2));
    after(k);
  }
}

void nothing(int) {}

std::string written_at_once(const fs::path& path) {
  H5mdTrajectory file(path, content, Existing::keep);
  append(file, 0, frames, nothing);
  file.finish();
  return read_whole(path);
}

void check_same(const Frame& a, const Frame& b) {
  CHECK(a.step == b.step);
  CHECK(a.time == b.time);
  CHECK(a.id == b.id);
  CHECK(a.columns == b.columns);
}

}  // namespace

TEST_CASE("A trajectory read back is the one written, to the bit, and tells what made it") {
  const ScratchDirectory place;
  const fs::path path = place.path / "traj.h5";
  written_at_once(path);
  const H5md file(path, Hdf5File::Access::read);
  REQUIRE(file.frames() == frames);
  REQUIRE(file.rows() == frames / 2);
  const std::vector<Frame> read = file.frames(0, frames);
  for (int k = 0; k < frames; ++k) {
    Frame expected = frame_of(k);
    expected.step = k;
    check_same(read[static_cast<std::size_t>(k)], expected);
  }
  const std::vector<Row> rows = file.rows(0, file.rows());
  CHECK(rows[17].time == row_of(17).time);
  CHECK(rows[17].values == row_of(17).values);
  CHECK(file.content().keys == content.keys);
  CHECK(file.columns().back().name == "solvent");
  CHECK(file.columns().back().unit == "g");
  CHECK(description(file.content().made_by) == description(content.made_by));
}

TEST_CASE("Each frame that ParaView is told of is its own rows of the datasets") {
  Xdmf xdmf;
  xdmf.add({0.5, 3});
  xdmf.add({0.75, 2});
  const std::string text = xdmf.text("traj.h5", 3, frame_columns());
  // first row, strides and size of the selections of position and stress, frame by frame
  CHECK_THAT(text, Catch::Contains("\">0 0 0 1 1 1 1 3 3</DataItem>") &&
                       Catch::Contains("\">0 0 1 1 1 3</DataItem>"));
  CHECK_THAT(text, Catch::Contains("\">1 0 0 1 1 1 1 2 3</DataItem>") &&
                       Catch::Contains("\">1 0 1 1 1 2</DataItem>"));
  CHECK_THAT(text, Catch::Contains("frame 1\">\n<Time Value=\"0.75\"/>"));
}

TEST_CASE("The bytes of a finished trajectory do not depend on how often it was flushed") {
  const ScratchDirectory place;
  const std::string expected = written_at_once(place.path / "once" / "traj.h5");
  const fs::path path = place.path / "often" / "traj.h5";
  H5mdTrajectory file(path, content, Existing::keep);
  append(file, 0, frames, [&](int k) { k % 3 == 0 ? file.sync() : file.flush(); });
  file.finish();
  CHECK(read_whole(path) == expected);
  CHECK(read_whole(place.path / "often" / "traj.xdmf") == read_whole(place.path / "once" / "traj.xdmf"));
  CHECK(std::distance(fs::directory_iterator(place.path / "often"), {}) == 2);
}

TEST_CASE(
    "Whoever compresses whole chunks the bytes are the same, and HDF5 makes the same values of the rest") {
  const ScratchDirectory place;
  constexpr std::uint64_t rows = 5, columns = 7, grown = 9;
  std::vector<double> values(rows * columns);
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = std::sin(double(k));
  const auto written = [&](const char* name, const RowSharing& chunks_shared, std::uint64_t at_once) {
    const fs::path path = place.path / name;
    Hdf5File file(path, Hdf5File::Access::create);
    file.chunks_shared = chunks_shared;
    file.dataset("/t", {.extent = {rows, columns}, .chunk = {2, 3}, .fill = std::nan("")});
    for (std::uint64_t first = 0; first < rows; first += at_once)
      file.write("/t", {{first, 0}, {std::min(at_once, rows - first), columns}},
                 values.data() + first * columns);
    file.write("/t", {{0, 0}, {1, columns}}, values.data());  // once more, which leaves the row below
    file.resize("/t", {rows, grown});  // shows what the last chunks hold beyond the table that there was
    file.close();
    return path;
  };
  const fs::path alone = written("alone.h5", all_at_once, rows);
  CHECK(read_whole(written("shared.h5", tasks_shared({3}), rows)) == read_whole(alone));
  // rows one by one, or three at once, are parts of chunks, which HDF5 puts together
  for (const fs::path& path :
       {alone, written("rows.h5", all_at_once, 1), written("some.h5", all_at_once, 3)}) {
    CAPTURE(path);
    std::vector<double> found(rows * grown);
    Hdf5File(path, Hdf5File::Access::read).read("/t", {{0, 0}, {rows, grown}}, found.data());
    for (std::uint64_t k = 0; k < found.size(); ++k)
      if (k % grown < columns)
        CHECK(found[k] == values[k / grown * columns + k % grown]);
      else
        CHECK(std::isnan(found[k]));
  }
}

TEST_CASE("A frame that comes in parts is the frame, wherever the file is cut off and continued") {
  const ScratchDirectory place;
  constexpr int last = 9;
  // every third one comes in parts, of which none is as long as the frame
  const auto appended = [](H5mdTrajectory& file, int first, int end) {
    for (int k = first; k < end; ++k) {
      const Frame all = frame_of(k);
      file.append(row_of(k));
      if (k % 3 != 1) {
        file.append(all);
        continue;
      }
      file.append(all.time, all.points(), [&](const auto& take) {
        constexpr std::size_t at_once = 40;
        for (std::size_t begin = 0; begin < all.points(); begin += at_once) {
          const std::size_t n = std::min(at_once, all.points() - begin);
          Frame part;
          part.id.assign(all.id.begin() + long(begin), all.id.begin() + long(begin + n));
          for (const auto& values : all.columns) {
            const std::size_t width = values.size() / all.points();
            part.columns.emplace_back(values.begin() + long(begin * width),
                                      values.begin() + long((begin + n) * width));
          }
          take(part);
        }
      });
    }
  };
  std::string expected;
  for (const int kept : {last, 2, 5}) {
    CAPTURE(kept);
    const fs::path path = place.path / fmt::format("kept-{}", kept) / "traj.h5";
    {
      H5mdTrajectory killed(path, content, Existing::keep);
      appended(killed, 0, last);
    }
    H5mdTrajectory file(path, content, Existing::resume);
    file.continue_from(static_cast<std::uint64_t>(kept), static_cast<std::uint64_t>(kept));
    appended(file, kept, last);
    file.finish();
    const H5md read(path, Hdf5File::Access::read);
    REQUIRE(read.frames() == last);
    for (int k = 0; k < last; ++k) {
      Frame frame = frame_of(k);
      frame.step = k;
      check_same(read.frames(static_cast<std::uint64_t>(k), 1).front(), frame);
      if (frame.points() > 7) CHECK(read.part(static_cast<std::uint64_t>(k), 5, 2).id[1] == frame.id[6]);
    }
    if (expected.empty()) expected = read_whole(path);
    CHECK(read_whole(path) == expected);
  }
}

TEST_CASE(
    "A file that is made anew for a long first frame keeps the rows before it, and is whole at any time") {
  const ScratchDirectory place;
  Frame long_one = frame_of(1);
  const std::size_t points = points_at_once + 1'000;
  long_one.id.resize(points);
  std::iota(long_one.id.begin(), long_one.id.end(), 1);
  for (auto& values : long_one.columns) {
    const std::size_t width = &values - &long_one.columns[0] < 2 ? 3 : 1;  // position and velocity
    values.resize(points * width, 0.5);
  }
  std::string expected;
  for (const bool in_parts : {false, true}) {
    CAPTURE(in_parts);
    const fs::path path = place.path / (in_parts ? "parts" : "whole") / "traj.h5";
    H5mdTrajectory file(path, content, Existing::keep);
    file.append(row_of(0));
    file.flush();
    file.append(row_of(1));
    if (in_parts)
      file.append(long_one.time, points, [&](const auto& take) { take(long_one); });
    else
      file.append(long_one);
    file.flush();
    const H5md read(path, Hdf5File::Access::read);
    REQUIRE(read.rows() == 2);
    CHECK(read.rows(1, 1).front().values == row_of(1).values);
    REQUIRE(read.frames() == 1);
    check_same(read.frames(0, 1).front(), long_one);
    file.append(frame_of(2));
    file.finish();
    if (expected.empty()) expected = read_whole(path);
    CHECK(read_whole(path) == expected);
  }
}

TEST_CASE("A trajectory continued from an earlier frame has the bytes of one that was never interrupted") {
  const ScratchDirectory place;
  const std::string expected = written_at_once(place.path / "once" / "traj.h5");
  for (const int kept : {0, 1, 33, 34, frames}) {
    CAPTURE(kept);
    const fs::path path = place.path / fmt::format("resumed-{}", kept) / "traj.h5";
    {
      H5mdTrajectory killed(path, content, Existing::keep);
      append(killed, 0, frames, [&](int k) {
        if (k % 20 == 0) killed.flush();
      });
      killed.flush();
      if (kept == 33) killed.finish();  // killed after the last word, before the checkpoint was removed
    }
    H5mdTrajectory file(path, content, Existing::resume);
    file.continue_from(static_cast<std::uint64_t>(kept), static_cast<std::uint64_t>((kept + 1) / 2));
    append(file, kept, frames, nothing);
    file.finish();
    CHECK(read_whole(path) == expected);
    CHECK(read_whole(path.parent_path() / "traj.xdmf") == read_whole(place.path / "once" / "traj.xdmf"));
  }
  H5mdTrajectory file(place.path / "once" / "traj.h5", content, Existing::resume);
  CHECK_THROWS_WITH(file.continue_from(frames + 1, 0), Catch::Contains("traj.h5: expected 71 frames"));
}

TEST_CASE("After each flush a trajectory is whole, and whoever reads it keeps what he has opened") {
  const ScratchDirectory place;
  const fs::path path = place.path / "traj.h5";
  H5mdTrajectory file(path, content, Existing::keep);
  std::vector<std::unique_ptr<H5md>> readers;
  append(file, 0, 12, [&](int k) {
    file.flush();
    readers.push_back(std::make_unique<H5md>(path, Hdf5File::Access::read));
    CHECK(readers.back()->frames() == static_cast<std::uint64_t>(k + 1));
  });
  for (std::size_t k = 0; k < readers.size(); ++k) {
    Frame expected = frame_of(static_cast<int>(k));
    expected.step = static_cast<std::int64_t>(k);
    check_same(readers[k]->frames(k, 1).front(), expected);
  }
}

TEST_CASE("A trajectory that is removed, or already there, is an error that names it") {
  const ScratchDirectory place;
  const fs::path path = place.path / "traj.h5";
  H5mdTrajectory file(path, content, Existing::keep);
  append(file, 0, 3, nothing);
  file.flush();
  CHECK_THROWS_WITH(H5mdTrajectory(path, content, Existing::keep),
                    Catch::Contains("traj.h5: exists already"));
  fs::remove(path);
  const auto go_on = [&] {
    file.append(frame_of(3));
    file.sync();
  };
  CHECK_THROWS_WITH(go_on(), Catch::Contains("traj.h5: has been removed"));
}

TEST_CASE("A trajectory cut short anywhere is refused, never read in part") {
  const ScratchDirectory place;
  const fs::path path = place.path / "traj.h5", cut = place.path / "cut.h5";
  const std::string whole = written_at_once(path);
  for (std::size_t length = 0; length < whole.size(); length += whole.size() / 97) {
    std::ofstream(cut, std::ios::binary) << whole.substr(0, length);
    CHECK_THROWS_AS(file_info(cut), FileError);
    CHECK_THROWS_AS(convert({cut, "csv", place.path / "never.csv"}), FileError);
  }
  CHECK_FALSE(fs::exists(place.path / "never.csv"));
}
