#include "core/io/frame_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace treejet {

namespace {

using Out = std::back_insert_iterator<std::string>;

/// All columns of a point but the first `skipped`, each with `before` in front.
void put_columns(Out out, const FrameColumns& columns, const Frame& f, std::size_t point, const char* before,
                 std::size_t skipped = 0) {
  for (std::size_t c = skipped; c < columns.size(); ++c) {
    const auto width = static_cast<std::size_t>(columns[c].width);
    for (std::size_t k = 0; k < width; ++k)
      fmt::format_to(out, "{}{}", before, f.columns[c][point * width + k]);
  }
}

const char* species(const Frame& f, std::size_t point) {
  return f.id[point] == 0 ? "X" : "C";
}

class Xyz : public FrameWriter {
 public:
  explicit Xyz(const FrameWriterSetting& s)
      : columns_(s.columns), file_(s.out, s.existing), made_by_(s.made_by), most_points_(s.most_points) {}

  void write(const Frame& f) override {
    std::string text;
    const auto out = std::back_inserter(text);
    const std::size_t lines = std::max(f.points(), padded() ? most_points_ : 0);
    fmt::format_to(out, "{}\n{}\n", lines, comment(f));
    for (std::size_t i = 0; i < f.points(); ++i) {
      put_point(out, f, i);
      text += '\n';
    }
    for (std::size_t i = f.points(); i < lines; ++i) text += "C 0 0 0\n";
    file_.write(text);
    made_by_.clear();
  }

 protected:
  const FrameColumns columns_;

  virtual bool padded() const { return true; }
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
  std::size_t most_points_;
};

class ExtendedXyz final : public Xyz {
 public:
  using Xyz::Xyz;

 private:
  bool padded() const override { return false; }
  std::string comment(const Frame& f) const override {
    std::string properties = "species:S:1";
    for (std::size_t c = 0; c < columns_.size(); ++c)
      properties += fmt::format(":{}:R:{}{}", c < names.size() ? names[c] : columns_[c].name,
                                columns_[c].width, c == 0 ? ":id:I:1" : "");
    return fmt::format("Properties={} Time={} pbc=\"F F F\" units=\"cm g s statC\"{}", properties, f.time,
                       program());
  }
  /// Of the columns of every jet, in their order.
  static constexpr std::array<const char*, 6> names{"pos",         "velo",      "tension",
                                                    "bead_charge", "bead_mass", "jet_radius"};
  void put_point(Out out, const Frame& f, std::size_t i) const override {
    const auto& r = f.columns[0];
    fmt::format_to(out, "{} {} {} {} {}", species(f, i), r[3 * i], r[3 * i + 1], r[3 * i + 2], f.id[i]);
    put_columns(out, columns_, f, i, " ", 1);
  }
};

class Csv final : public FrameWriter {
 public:
  explicit Csv(const FrameWriterSetting& s) : columns_(s.columns), file_(s.out, s.existing) {
    std::string header =
        "frame,t[s],id,x[cm],y[cm],z[cm],vx[cm/s],vy[cm/s],vz[cm/s],stress[g/(cm s^2)],charge[statC],mass[g],"
        "radius[cm]";
    for (std::size_t c = frame_columns().size(); c < columns_.size(); ++c)
      header += fmt::format(",{}[{}]", columns_[c].name, columns_[c].unit);
    file_.write(header + "\n");
  }

  void write(const Frame& f) override {
    std::string text;
    const auto out = std::back_inserter(text);
    for (std::size_t i = 0; i < f.points(); ++i) {
      fmt::format_to(out, "{},{},{}", f.step, f.time, f.id[i]);
      put_columns(out, columns_, f, i, ",");
      text += '\n';
    }
    file_.write(text);
  }

 private:
  FrameColumns columns_;
  OutputFile file_;
};

template <class Writer>
std::unique_ptr<FrameWriter> made(const FrameWriterSetting& s) {
  return std::make_unique<Writer>(s);
}

}  // namespace

const std::array<FrameFormat, 4> frame_formats{
    {{"xyz", ".xyz", "VMD, MDAnalysis", made<Xyz>},
     {"extxyz", ".extxyz", "OVITO, ASE, chemfiles", made<ExtendedXyz>},
     {"csv", ".csv", "pandas, gnuplot", made<Csv>},
     {"vtp", ".pvd", "ParaView", vtp_writer}}};

}  // namespace treejet
