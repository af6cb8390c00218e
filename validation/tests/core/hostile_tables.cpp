/// HDF5 files that claim what they do not hold, where the library (1.10) goes by the claim: each is refused,
/// or read by what is there, before the library reads beyond its memory or divides by zero.

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <numeric>

#include "core/base/compression.hpp"
#include "core/base/error.hpp"
#include "core/io/atomic_file.hpp"
#include "core/io/hdf5_file.hpp"
#include "validation/support/scratch_directory.hpp"

using namespace treejet;
using Catch::Matchers::Contains;

namespace {

constexpr std::uint64_t n = 64;

/// A table of n numbers in one chunk, none of which is twice there, so that deflate does not shorten them.
std::string file_of_a_table(const std::filesystem::path& path, bool compressed) {
  Hdf5File file(path, Hdf5File::Access::create);
  std::vector<double> values(n);
  for (std::size_t k = 0; k < n; ++k) values[k] = std::sin(double(k));
  file.dataset("/t", {.extent = {n}, .chunk = {n}, .compressed = compressed});
  file.write("/t", {{0}, {n}}, values.data());
  file.close();
  return read_whole(path);
}

std::vector<double> table_in(const std::filesystem::path& path, const std::string& bytes) {
  write_whole(path, bytes);
  const Hdf5File file(path, Hdf5File::Access::read);
  std::vector<double> values(file.extent("/t").at(0));
  file.read("/t", {{0}, {values.size()}}, values.data());
  return values;
}

/// The file's bytes with others in place of those `after` further than where `mark` begins.
std::string patched(std::string bytes, std::string_view mark, std::ptrdiff_t after, std::string_view with) {
  const std::size_t at = bytes.find(mark);
  REQUIRE(at != std::string::npos);
  REQUIRE(bytes.find(mark, at + 1) == std::string::npos);
  return bytes.replace(at + static_cast<std::size_t>(after), with.size(), with);
}

template <std::size_t size>
std::string_view text(const char (&literal)[size]) {
  return {literal, size - 1};
}

// where things are in the file of a table
constexpr std::string_view extents_of_chunk{"\x40\0\0\0\x08\0\0\0", 8};  // 11 bytes into the layout
constexpr std::string_view tree{"TREE\1\0\1\0", 8};                      // 24 bytes in front of length, mask
constexpr std::string_view begin_of_stream{"\x78\x01", 2};
constexpr std::string_view eight_zeros_deflated{"\x78\x01\x63\x60\x80\0\0\0\x08\0\x01", 11};

}  // namespace

TEST_CASE("A chunk that inflates to less than its extent, or to more, is refused") {
  const ScratchDirectory place;
  const auto path = place.path / "table.h5";
  const std::string whole = file_of_a_table(path, true);
  REQUIRE(table_in(path, whole)[n - 1] == std::sin(double(n - 1)));
  CHECK_THROWS_WITH(table_in(path, patched(whole, begin_of_stream, 0, eight_zeros_deflated)),
                    Contains("its chunk at 0 is not 512 bytes"));
  // five thousand zeros
  const auto more = text(
      "\x78\x01\xed\xd0\x31\x01\0\0\0\xc2\xa0\xf5\x4f\x6d\x0a\x3f\x88\x40\x61\xc0\x80\x01\x03\x06\x0c\x18\x30"
      "\x60\xc0\x80\x01\x03\x06\x0c\x18\x30\x60\xc0\xc0\x7b\x60\x13\x88\0\x01");
  CHECK_THROWS_AS(table_in(path, patched(whole, begin_of_stream, 0, more)), FileError);
  CHECK_THROWS_AS(table_in(path, patched(whole, begin_of_stream, 30, "damaged")), FileError);
}

TEST_CASE("A chunk is refused if it is said to have gone through other filters than make up its extent") {
  const ScratchDirectory place;
  const auto path = place.path / "table.h5";
  const std::string whole = file_of_a_table(path, true);
  for (const char* skipped : {"\1", "\2", "\3"}) {
    CAPTURE(int(*skipped));
    if (*skipped == 1)  // shuffle alone: the right length, though other numbers
      CHECK_NOTHROW(table_in(path, patched(whole, tree, 28, skipped)));
    else
      CHECK_THROWS_AS(table_in(path, patched(whole, tree, 28, skipped)), FileError);
  }
  constexpr std::string_view name{"deflate\0", 8};
  CHECK_THROWS_WITH(table_in(path, patched(whole, name, -8, "\4")), Contains("otherwise than by shuffle"));
}

TEST_CASE("An uncompressed chunk is read by its extent, whatever length it is said to have") {
  const ScratchDirectory place;
  const auto path = place.path / "table.h5";
  const std::string whole = file_of_a_table(path, false);
  const std::vector<double> values = table_in(path, whole);
  for (const std::string_view length : {text("\x08\0\0\0"), text("\0\0\0\x7f")})
    CHECK(table_in(path, patched(whole, tree, 24, length)) == values);
}

TEST_CASE("Chunks of no extent, or of more or fewer extents than their table has, are refused") {
  const ScratchDirectory place;
  const auto path = place.path / "table.h5";
  const std::string whole = file_of_a_table(path, true);
  const auto with = [&](std::ptrdiff_t after, std::string_view bytes) {
    return patched(whole, extents_of_chunk, after, bytes);
  };
  CHECK_THROWS_WITH(table_in(path, with(0, text("\0"))), Contains("chunks without extent"));
  CHECK_THROWS_WITH(table_in(path, with(4, text("\0"))), Contains("chunks without extent"));
  CHECK_THROWS_WITH(table_in(path, with(-9, "\1")), Contains("its header or what it leads to"));
  CHECK_THROWS_AS(table_in(path, with(-9, "\3")), FileError);
  // chunks of 2^30 and 2^31 numbers
  CHECK_THROWS_AS(table_in(path, with(0, text("\0\0\0\x40"))), FileError);
  CHECK_THROWS_AS(table_in(path, with(0, text("\0\0\0\x80"))), FileError);
}

TEST_CASE("Numbers are read by the size of their type, not by the one that chunks are said to have") {
  const ScratchDirectory place;
  const auto path = place.path / "table.h5";
  for (const bool compressed : {false, true}) {
    const std::string whole = file_of_a_table(path, compressed);
    const std::vector<double> values = table_in(path, whole);
    for (const char* size : {"\4", "\x10"})
      CHECK(table_in(path, patched(whole, extents_of_chunk, 4, size)) == values);
  }
}

TEST_CASE("Layouts of other versions, and of other files, are refused before the library opens them") {
  const ScratchDirectory place;
  const auto path = place.path / "table.h5";
  const std::string whole = file_of_a_table(path, true);
  for (const char* version : {"\1", "\2", "\4"})
    CHECK_THROWS_WITH(table_in(path, patched(whole, extents_of_chunk, -11, version)), Contains("h5repack"));
  CHECK_THROWS_WITH(table_in(path, patched(whole, extents_of_chunk, -11, "\4\3")), Contains("another file"));
}

TEST_CASE("Names and chunks whose tree or heap is nowhere, or a tree in a circle, are refused") {
  const ScratchDirectory place;
  const auto path = place.path / "table.h5";
  const std::string whole = file_of_a_table(path, true);
  const auto nowhere = text("\xff\xff\xff\xff\xff\xff\xff\xff");
  constexpr std::string_view heap{"HEAP", 4}, names{"TREE\0\0\1\0", 8};
  CHECK_THROWS_AS(table_in(path, patched(whole, heap, 24, nowhere)), FileError);
  CHECK_THROWS_AS(table_in(path, patched(whole, names, 32, nowhere)), FileError);
  // a node of names that leads to itself, as one of the level above the leaves
  const std::size_t at = whole.find(names);
  std::string circle = patched(whole, names, 5, "\1");
  std::memcpy(circle.data() + at + 32, &at, sizeof at);
  CHECK_THROWS_AS(table_in(path, circle), FileError);
  // of the tree of chunks, and of the one thing behind its first key, of 24 bytes
  CHECK_THROWS_AS(table_in(path, patched(patched(whole, tree, 24 + 24, nowhere), tree, 5, "\1")), FileError);
}

TEST_CASE("Gaps of a heap in a circle, or across its end, are refused before the library fills its memory") {
  const ScratchDirectory place;
  const auto path = place.path / "table.h5";
  const std::string whole = file_of_a_table(path, true);
  const std::size_t heap = whole.find("HEAP");
  std::uint64_t length = 0, gap = 0, data = 0;
  std::memcpy(&length, whole.data() + heap + 8, sizeof length);
  std::memcpy(&gap, whole.data() + heap + 16, sizeof gap);
  std::memcpy(&data, whole.data() + heap + 24, sizeof data);
  REQUIRE(gap + 16 <= length);
  std::string circle = whole;
  std::memcpy(circle.data() + data + gap, &gap, sizeof gap);
  CHECK_THROWS_AS(table_in(path, circle), FileError);
  // the last place of a whole gap, and one byte more
  for (const std::uint64_t last : {length - 16, length - 15}) {
    std::string moved = whole;
    const std::uint64_t no_more = 1, size = 16;
    std::memcpy(moved.data() + heap + 16, &last, sizeof last);
    std::memcpy(moved.data() + data + last, &no_more, sizeof no_more);
    if (last == length - 16) {
      std::memcpy(moved.data() + data + last + 8, &size, sizeof size);
      CHECK(table_in(path, moved).size() == n);
    } else {
      CHECK_THROWS_AS(table_in(path, moved), FileError);
    }
  }
}

TEST_CASE("What has never been written is no number, or number -1, whatever the file would fill in") {
  const ScratchDirectory place;
  const auto path = place.path / "table.h5";
  {
    Hdf5File file(path, Hdf5File::Access::create);
    const std::array<double, 4> row{1, 2, 3, 4};
    const std::array<std::int64_t, 2> number{7, 8};
    file.dataset("/t", {.extent = {3, 6}, .chunk = {1, 2}, .fill = 5});
    file.write("/t", {{0, 0}, {1, 4}}, row.data());
    file.write("/t", {{2, 1}, {1, 1}}, row.data());
    file.dataset("/i", {.number = Hdf5File::Number::integer, .extent = {4}, .chunk = {2}, .fill = 5});
    file.write("/i", {{2}, {2}}, number.data());
    file.close();
  }
  const Hdf5File file(path, Hdf5File::Access::read);
  std::vector<double> values(15);
  file.read("/t", {{0, 1}, {3, 5}}, values.data());
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  // of the chunk that was written in part the rest is the file's own 5, which is there
  const std::vector<double> expected{2,    3,    4, none, none, none, none, none,
                                     none, none, 1, none, none, none, none};
  for (std::size_t k = 0; k < values.size(); ++k) {
    CAPTURE(k);
    CHECK((values[k] == expected[k] || (std::isnan(values[k]) && std::isnan(expected[k]))));
  }
  std::vector<std::int64_t> numbers(4);
  file.read("/i", {{0}, {4}}, numbers.data());
  CHECK(numbers == std::vector<std::int64_t>{-1, -1, 7, 8});
}

TEST_CASE("The parts of a box that are there make it up, each chunk asked once") {
  const TableBox box{{3, 1, 0}, {5, 7, 4}};
  const Extent chunk{2, 3, 5};
  for (unsigned seed : {1u, 5u, 11u}) {
    int asked = 0;
    const auto there = [&](const Extent& place) {
      return (place[0] * 5 + place[1] * 3 + place[2] + seed) % seed != 1;
    };
    const auto parts = parts_there(box, chunk, [&](const Extent& place) { return ++asked, there(place); });
    CHECK(asked == 3 * 3);  // rows 3 to 7 lie in chunks 1 to 3, columns 1 to 7 in 0 to 2
    std::vector<int> covered(8 * 8 * 4);
    const auto at = [&](std::uint64_t i, std::uint64_t j, std::uint64_t k) -> int& {
      return covered[(i * 8 + j) * 4 + k];
    };
    for (const TableBox& part : parts)
      for (std::uint64_t i = 0; i < part.size[0]; ++i)
        for (std::uint64_t j = 0; j < part.size[1]; ++j)
          for (std::uint64_t k = 0; k < part.size[2]; ++k)
            ++at(part.first[0] + i, part.first[1] + j, part.first[2] + k);
    for (std::uint64_t i = 0; i < 8; ++i)
      for (std::uint64_t j = 0; j < 8; ++j)
        for (std::uint64_t k = 0; k < 4; ++k)
          CHECK(at(i, j, k) == (i >= 3 && j >= 1 && there({i / 2, j / 3, 0}) ? 1 : 0));
  }
  CHECK(parts_there(box, chunk, [](const Extent&) { return true; }) == std::vector{box});
}

TEST_CASE(
    "The filters of a chunk are undone the last one first, and what is not its length or its sum is none") {
  constexpr ChunkFilter deflate{ChunkFilter::Kind::deflate}, sum{ChunkFilter::Kind::fletcher32},
      pairs{ChunkFilter::Kind::shuffle, 2};
  const std::string eight{eight_zeros_deflated}, zeros(8, '\0');
  const auto plain = [](const std::string& bytes, const std::vector<ChunkFilter>& filters,
                        unsigned skipped = 0,
                        std::uint64_t length = 8) { return unfiltered(bytes, filters, skipped, length); };
  CHECK(inflated(eight, 8) == zeros);
  CHECK_FALSE(inflated(eight, 7));
  CHECK_FALSE(inflated(eight.substr(0, 10), 8));
  CHECK(plain(eight, {pairs, deflate}) == zeros);
  CHECK(plain(eight + "behind its end", {deflate}) == zeros);
  CHECK(plain("acegbdfh", {pairs}) == "abcdefgh");
  CHECK(plain("acebdf7", {pairs}, 0, 7) == "abcdef7");
  CHECK(plain("abcdefgh", {deflate}, 1) == "abcdefgh");
  CHECK_FALSE(plain("abcdefghi", {deflate}, 1));
  CHECK_FALSE(plain("abcdefgh", {{ChunkFilter::Kind::shuffle, 0}}));
  // 0x6162 + 0x6364 + 0x6500, and 3 * 0x6162 + 2 * 0x6364 + 0x6500, both modulo 65535
  const std::string with_sum = "abcde\xc7\x29\xf0\x4f";
  CHECK(plain(with_sum, {sum}, 0, 5) == "abcde");
  CHECK_FALSE(plain("abcdf" + with_sum.substr(5), {sum}, 0, 5));
  CHECK_FALSE(plain("cdabe" + with_sum.substr(5), {sum}, 0, 5));  // the first sum is the same
  CHECK_FALSE(plain("123", {sum}, 0, 0));
}

TEST_CASE("What two boxes share is copied to its place, and nothing else") {
  const TableBox from{{2, 0, 3}, {3, 2, 4}}, to{{0, 1, 4}, {4, 3, 2}}, apart{{7, 0, 0}, {1, 1, 1}};
  std::vector<int> source(24), copy(24, -1);
  std::iota(source.begin(), source.end(), 0);
  copy_shared(from, source.data(), to, copy.data());
  for (std::uint64_t i = 0; i < 4; ++i)
    for (std::uint64_t j = 1; j < 4; ++j)
      for (std::uint64_t k = 4; k < 6; ++k) {
        const bool shared = i >= 2 && j < 2;
        CHECK(copy[(i * 3 + j - 1) * 2 + k - 4] == (shared ? int(((i - 2) * 2 + j) * 4 + k - 3) : -1));
      }
  const std::vector<int> before = copy;
  copy_shared(apart, source.data(), to, copy.data());
  CHECK(copy == before);
}
