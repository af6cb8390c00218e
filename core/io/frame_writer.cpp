#include "core/io/frame_writer.hpp"

#include <fmt/format.h>

#include <iterator>

namespace treejet {

namespace {

using Out = std::back_insert_iterator<std::string>;

/// All columns of a point but the first `skipped`, each with `before` in front.
void put_columns(Out out, const Frame& f, std::size_t point, const char* before, std::size_t skipped = 0) {
  for (std::size_t c = skipped; c < frame_columns.size(); ++c) {
    const auto width = static_cast<std::size_t>(frame_columns[c].width);
    for (std::size_t k = 0; k < width; ++k)
      fmt::format_to(out, "{}{}", before, f.columns[c][point * width + k]);
  }
}

const char* species(const Frame& f, std::size_t point) {
  return f.id[point] == 0 ? "X" : "C";
}

class Xyz : public FrameWriter {
 public:
  explicit Xyz(const FrameWriterSetting& s) : file_(s.out, s.existing), made_by_(s.made_by) {}

  void write(const Frame& f) override {
    std::string text;
    const auto out = std::back_inserter(text);
    fmt::format_to(out, "{}\n{}\n", f.points(), comment(f));
    for (std::size_t i = 0; i < f.points(); ++i) {
      put_point(out, f, i);
      text += '\n';
    }
    file_.write(text);
    made_by_.clear();
  }

 protected:
  virtual std::string comment(const Frame& f) const {
    return fmt::format("t = {} s  beads = {}{}", f.time, f.points(), program());
  }
  virtual void put_point(Out out, const Frame& f, std::size_t i) const {
    const auto& r = f.columns[0];
    fmt::format_to(out, "C {} {} {}", r[3 * i], r[3 * i + 1], r[3 * i + 2]);
  }
  /// Told once.
  std::string program() const { return made_by_.empty() ? "" : fmt::format(" program=\"{}\"", made_by_); }

 private:
  OutputFile file_;
  std::string made_by_;
};

class ExtendedXyz final : public Xyz {
 public:
  using Xyz::Xyz;

 private:
  std::string comment(const Frame& f) const override {
    std::string properties = "id:I:1:species:S:1:pos:R:3";
    for (std::size_t c = 1; c < frame_columns.size(); ++c)
      properties += fmt::format(":{}:R:{}", frame_columns[c].name, frame_columns[c].width);
    return fmt::format("Properties={} Time={} pbc=\"F F F\" units=\"cm g s statC\"{}", properties, f.time,
                       program());
  }
  void put_point(Out out, const Frame& f, std::size_t i) const override {
    fmt::format_to(out, "{} {}", f.id[i], species(f, i));
    put_columns(out, f, i, " ");
  }
};

class Csv final : public FrameWriter {
 public:
  explicit Csv(const FrameWriterSetting& s) : file_(s.out, s.existing) {
    file_.write(
        "frame,t[s],id,x[cm],y[cm],z[cm],vx[cm/s],vy[cm/s],vz[cm/s],stress[g/(cm s^2)],charge[statC],mass[g],"
        "radius[cm]\n");
  }

  void write(const Frame& f) override {
    std::string text;
    const auto out = std::back_inserter(text);
    for (std::size_t i = 0; i < f.points(); ++i) {
      fmt::format_to(out, "{},{},{}", f.step, f.time, f.id[i]);
      put_columns(out, f, i, ",");
      text += '\n';
    }
    file_.write(text);
  }

 private:
  OutputFile file_;
};

template <class Writer>
std::unique_ptr<FrameWriter> made(const FrameWriterSetting& s) {
  return std::make_unique<Writer>(s);
}

}  // namespace

const std::array<FrameFormat, 4> frame_formats{{{"xyz", ".xyz", "VMD", made<Xyz>},
                                                {"extxyz", ".extxyz", "OVITO, ASE", made<ExtendedXyz>},
                                                {"csv", ".csv", "pandas, gnuplot", made<Csv>},
                                                {"vtp", ".pvd", "ParaView", vtp_writer}}};

}  // namespace treejet
