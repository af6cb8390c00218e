#include "core/io/xdmf.hpp"

#include <fmt/format.h>

#include <iterator>

#include "core/io/frame.hpp"
#include "core/io/xml_text.hpp"

namespace treejet {

namespace {

struct Place {
  const std::string& file;
  std::uint64_t frame, frames, width;
};

/// The rows of one frame that hold points, out of a dataset of all frames.
std::string selection(const Place& at, std::uint64_t points, const std::string& name, int components,
                      const char* type) {
  const bool vector = components > 1;
  const std::string last = vector ? fmt::format(" {}", components) : "";
  return fmt::format(
      "<DataItem ItemType=\"HyperSlab\" Dimensions=\"{0}{1}\">"
      "<DataItem Dimensions=\"3 {2}\" Format=\"XML\">{3} 0{4} 1 1{5} 1 {0}{1}</DataItem>"
      "<DataItem Dimensions=\"{6} {7}{1}\" {8} Precision=\"8\" Format=\"HDF\">{9}:/particles/jet/{10}/value"
      "</DataItem></DataItem>",
      points, last, vector ? 3 : 2, at.frame, vector ? " 0" : "", vector ? " 1" : "", at.frames, at.width,
      type, xml_text(at.file), xml_text(name));
}

constexpr const char *real = "NumberType=\"Float\"", *integer = "NumberType=\"Int\"";

}  // namespace

std::string Xdmf::text(const std::string& hdf5_name, std::uint64_t width, const FrameColumns& columns) const {
  std::string text =
      "<?xml version=\"1.0\"?>\n<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n<Xdmf Version=\"2.0\">\n<Domain>\n"
      "<Grid Name=\"jet\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
  auto out = std::back_inserter(text);
  Place at{hdf5_name, 0, grids_.size(), width};
  for (const auto& [time, points] : grids_) {
    fmt::format_to(out,
                   "<Grid Name=\"frame {}\">\n<Time Value=\"{}\"/>\n"
                   "<Topology TopologyType=\"Polyline\" NumberOfElements=\"1\" NodesPerElement=\"{}\"/>\n",
                   at.frame, time, points);
    for (const auto& [name, unit, components] : columns) {
      const std::string values = selection(at, points, name, components, real);
      if (name == columns[0].name)
        fmt::format_to(out, "<Geometry GeometryType=\"XYZ\">{}</Geometry>\n", values);
      else
        fmt::format_to(out,
                       "<Attribute Name=\"{} [{}]\" AttributeType=\"{}\" Center=\"Node\">{}</Attribute>\n",
                       xml_text(name), xml_text(unit), components > 1 ? "Vector" : "Scalar", values);
    }
    fmt::format_to(
        out, "<Attribute Name=\"id\" AttributeType=\"Scalar\" Center=\"Node\">{}</Attribute>\n</Grid>\n",
        selection(at, points, "id", 1, integer));
    ++at.frame;
  }
  return text + "</Grid>\n</Domain>\n</Xdmf>\n";
}

}  // namespace treejet
