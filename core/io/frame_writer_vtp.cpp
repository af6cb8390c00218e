/// ParaView's own files: a polyline in a .vtp a frame, and the .pvd that gives each its time.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iterator>
#include <numeric>

#include "core/io/frame_writer.hpp"
#include "core/io/xml_text.hpp"

namespace treejet {

namespace {

namespace fs = std::filesystem;

std::string head(const std::string& made_by) {
  return fmt::format("<?xml version=\"1.0\"?>\n{}\n", xml_comment(made_by));
}

template <class T>
std::string array(const std::string& name, int components, const std::vector<T>& values) {
  return fmt::format(
      "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n{}\n</DataArray>\n",
      std::is_integral_v<T> ? "Int64" : "Float64", xml_text(name), components, fmt::join(values, " "));
}

class Vtp final : public FrameWriter {
 public:
  explicit Vtp(const FrameWriterSetting& s)
      : setting_(s),
        folder_(fs::path(s.out).replace_extension("").string() + "-frames"),
        series_(s.out, s.existing) {}

  void write(const Frame& f) override {
    const std::string name = fmt::format("{:06}.vtp", f.step);
    OutputFile(folder_ / name, setting_.existing).write(text(f));
    entries_ += fmt::format("<DataSet timestep=\"{}\" file=\"{}/{}\"/>\n", f.time,
                            xml_text(folder_.filename().string()), name);
  }

  void finish() override {
    series_.write(fmt::format(
        "{}<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n{}</Collection>\n</VTKFile>\n",
        head(setting_.made_by), entries_));
  }

 private:
  std::string text(const Frame& f) const {
    std::vector<std::int64_t> chain(f.points());
    std::iota(chain.begin(), chain.end(), 0);
    const auto end = static_cast<std::int64_t>(f.points());
    std::string text = head(setting_.made_by);
    const auto out = std::back_inserter(text);
    fmt::format_to(
        out,
        "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
        "<PolyData>\n<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" "
        "format=\"ascii\">{}</DataArray>\n</FieldData>\n"
        "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"1\" NumberOfStrips=\"0\" "
        "NumberOfPolys=\"0\">\n",
        f.time, end);
    fmt::format_to(out, "<PointData>\n{}", array("id", 1, f.id));
    for (std::size_t c = 1; c < f.columns.size(); ++c)
      text += array(setting_.columns[c].name, setting_.columns[c].width, f.columns[c]);
    fmt::format_to(out, "</PointData>\n<Points>\n{}</Points>\n<Lines>\n{}{}</Lines>\n</Piece>\n",
                   array("position", 3, f.columns[0]), array("connectivity", 1, chain),
                   array("offsets", 1, std::vector<std::int64_t>{end}));
    return text + "</PolyData>\n</VTKFile>\n";
  }

  FrameWriterSetting setting_;
  fs::path folder_;
  OutputFile series_;
  std::string entries_;
};

}  // namespace

std::unique_ptr<FrameWriter> vtp_writer(const FrameWriterSetting& setting) {
  return std::make_unique<Vtp>(setting);
}

}  // namespace treejet
