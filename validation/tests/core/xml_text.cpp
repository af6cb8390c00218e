/// Names from a deck or a state in the files that ParaView reads.

#include "core/io/xml_text.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <filesystem>

#include "core/io/atomic_file.hpp"
#include "core/io/frame_writer.hpp"
#include "core/io/xdmf.hpp"
#include "validation/support/scratch_directory.hpp"

using namespace treejet;

namespace {

constexpr const char* hostile = "<&\">'";
constexpr const char* harmless = "&lt;&amp;&quot;&gt;&apos;";

FrameColumns hostile_columns() {
  FrameColumns columns = frame_columns();
  columns.push_back({hostile, hostile, 1});
  return columns;
}

}  // namespace

TEST_CASE("Any text stands in XML as itself: markup as entities, control characters and bytes as letters") {
  CHECK(xml_text("E [g/(cm s^2)]") == "E [g/(cm s^2)]");
  CHECK(xml_text(hostile) == harmless);
  CHECK(xml_text(std::string_view("a\0b\x1b\tc", 6)) == "a\uFFFDb\uFFFD\tc");
  CHECK(xml_text("\xB5m") == "\u00b5m");  // Latin-1
  CHECK(xml_comment("a --> <b> --- c-") == "<!-- a -> <b> - c- -->");
}

TEST_CASE("A column whose name is markup leaves the description for ParaView readable") {
  Xdmf xdmf;
  xdmf.add({0.5, 3});
  const std::string text = xdmf.text("<&\">'.h5", 3, hostile_columns());
  const std::string title = fmt::format("Name=\"{0} [{0}]\"", harmless);
  const std::string place = fmt::format(">{0}.h5:/particles/jet/{0}/value<", harmless);
  CHECK_THAT(text, Catch::Contains(title) && Catch::Contains(place) && !Catch::Contains(hostile));
}

TEST_CASE("A column whose name is markup leaves ParaView's own files readable") {
  const ScratchDirectory place;
  FrameWriterSetting setting;
  setting.out = (place.path / "a&b.pvd").string();
  setting.columns = hostile_columns();
  setting.made_by = "--> <evil/>";
  Frame frame;
  frame.id = {1, 0};
  for (const FrameColumn& c : setting.columns) frame.columns.emplace_back(std::size_t(2 * c.width), 0.5);
  const auto writer = frame_formats[3].writer(setting);
  writer->write(frame);
  writer->finish();
  CHECK_THAT(read_whole(place.path / "a&b.pvd"),
             Catch::Contains("file=\"a&amp;b-frames/000000.vtp\"") && Catch::Contains("<!-- -> <evil/> -->"));
  CHECK_THAT(read_whole(place.path / "a&b-frames" / "000000.vtp"),
             Catch::Contains(fmt::format("Name=\"{}\"", harmless)) && !Catch::Contains(hostile));
}
