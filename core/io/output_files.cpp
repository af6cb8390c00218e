#include "core/io/output_files.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/io/frame.hpp"
#include "core/io/h5md_trajectory.hpp"
#include "core/io/provenance.hpp"

namespace treejet {

namespace {

constexpr double header = 4000;  // a deck of ordinary length

double samples(const Parameters& p, double interval) {
  return std::floor(p.final_time / interval * (1 + 1e-9)) + 1;
}

double statistics_bytes(const Parameters& p, double) {
  const double row = 24 * double(p.printstat_list.size()) + 1;
  return header + row * samples(p, print_interval(p));
}

double xyz_bytes(const Parameters& p, double points) {
  constexpr double line = 38, padding = 8, comment = 40;
  const double shown = std::min(points, double(p.xyz_maxnum));
  return samples(p, *p.print_xyz) * (comment + line * shown + padding * (p.xyz_maxnum - shown));
}

double h5_bytes(const Parameters& p, double points) {
  constexpr double compression = 0.46, describing = 30000;
  const auto point = static_cast<double>(bytes_of_point(frame_columns()));
  return describing + samples(p, *p.print_hdf5) * points * point * compression;
}

/// Not compressed, and with its twin.
double growing_h5_bytes(const Parameters& p, double points) {
  const auto point = static_cast<double>(bytes_of_point(frame_columns()));
  const auto chunk = static_cast<double>(points_of_growing_chunk(static_cast<std::uint64_t>(points)));
  return 2 * samples(p, *p.print_hdf5) * std::ceil(points / chunk) * chunk * point;
}

double xdmf_bytes(const Parameters& p, double) {
  constexpr double grid = 2400;
  return samples(p, *p.print_hdf5) * grid;
}

bool asks_for_h5(const Parameters& p) {
  return p.print_hdf5.has_value();
}

constexpr OutputFileKind table[] = {
    {"statdat.dat", [](const Parameters& p) { return !p.printstat_list.empty(); }, statistics_bytes},
    {"traj.xyz", [](const Parameters& p) { return p.print_xyz.has_value(); }, xyz_bytes},
    {"traj.h5", asks_for_h5, h5_bytes, growing_h5_bytes},
    {"traj.xdmf", asks_for_h5, xdmf_bytes},
    {run_record_name,
     [](const Parameters& p) { return !p.printstat_list.empty() || p.print_xyz || p.print_hdf5; },
     [](const Parameters&, double) { return header; }}};

}  // namespace

std::vector<OutputFileKind> all_output_files() {
  return {std::begin(table), std::end(table)};
}

std::vector<OutputFileKind> output_files(const Parameters& p) {
  std::vector<OutputFileKind> files;
  std::copy_if(std::begin(table), std::end(table), std::back_inserter(files),
               [&](const OutputFileKind& kind) { return kind.asked_for(p); });
  return files;
}

}  // namespace treejet
