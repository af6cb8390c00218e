#include "core/restart/origin.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"
#include "core/base/number.hpp"
#include "core/deck/directives.hpp"
#include "core/deck/units.hpp"
#include "core/io/h5md.hpp"
#include "core/jet/material.hpp"
#include "core/jet/nozzle.hpp"
#include "core/jet/saved_chain.hpp"
#include "core/jet/scales.hpp"

namespace treejet {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void refuse(const Origin& o, const std::string& why) {
  throw InputError(fmt::format("--from {}: {}", o.file.string(), why));
}

double seconds(const std::string& text) {
  const std::size_t length = number_length(text);
  const Reading<double> number = real_number(std::string_view(text).substr(0, length));
  const std::optional<Unit> given = length < text.size() ? unit(text.substr(length)) : unit("s");
  if (!number.problem.empty() || !given || given->dimension != unit("s")->dimension)
    throw InputError(fmt::format("--from: expected a time behind the @, as 0.05 or 50ms, found {}",
                                 quoted(std::string_view(text))));
  return converted(number.value, *given, *unit("s"));
}

/// The last frame, or the one at time t.
std::uint64_t frame_number(const H5md& file, const fs::path& path, std::optional<double> t) {
  const std::uint64_t count = file.frames();
  if (count == 0) throw FileError(fmt::format("{}: no frame is in it", path.string()));
  if (!t) return count - 1;
  const std::vector<double> times = file.times();
  const auto after = std::lower_bound(times.begin(), times.end(), *t);
  constexpr double written = 1e-6;  // a time is asked for in fewer digits than it has
  for (auto near : {after, after == times.begin() ? after : after - 1})
    if (near != times.end() && std::abs(*near - *t) <= written * std::max(*near, *t))
      return static_cast<std::uint64_t>(near - times.begin());
  throw InputError(fmt::format(
      "--from: {} has no frame at t = {:.10g} s; the nearest are at {:.10g} and {:.10g} s", path.string(), *t,
      after == times.begin() ? *after : *(after - 1), after == times.end() ? times.back() : *after));
}

Origin from_frame(const fs::path& path, std::optional<double> t) {
  const H5md file(path, Hdf5File::Access::read);
  const Provenance& by = file.content().made_by;
  Origin o{path, parse_deck(by.deck, by.deck_name, by.overrides), 0, {}, {}, file.columns()};
  o.frame = file.frames(frame_number(file, path, t), 1).front();
  o.t = o.frame.time;
  return o;
}

Origin from_checkpoint(const fs::path& path) {
  Origin o{path, {}, 0, read_checkpoint(path), {}, {}};
  const Checkpoint& c = *o.checkpoint;
  o.deck = parse_deck(c.deck_text, c.deck_name, c.overrides);
  o.t = c.t;
  return o;
}

[[noreturn]] void refuse_without(const Origin& o, const Column& c) {
  refuse(o, fmt::format("its beads carry no {}, which those of this deck do", c.name));
}

/// The checkpoint's jet, from wherever its beads are; the state has so many columns.
template <int D>
Jet<D> saved_jet(const Checkpoint& checkpoint, Eigen::Index columns) {
  Jet<D> jet;
  if (checkpoint.records == 0) {
    checkpoint.state.beginning_of_part("march", jet);
    return jet;
  }
  jet.y.resize(0, columns);
  SavedCut<D> cut{jet, columns, {}};
  checkpoint.state.beginning_of_part("march", cut);
  records_of(checkpoint)([](std::int64_t, std::int64_t count) { return count > 0; },
                         [&](const SubdomainRecord& record) {
                           SavedBeads<D> some;
                           Archive archive(record.bytes);
                           archive(some);
                           expect_complete(some, record.count, columns);
                           append(jet, some.jet);
                         });
  if (jet.size() != cut.borders.back()) throw FileError("the checkpoint lacks beads of the jet");
  return jet;
}

/// Volume that the nozzle has given since it last released a bead; none where the jet draws what it pulls.
template <int D>
double fed(const Jet<D>& jet, const Nozzle<D>& nozzle) {
  const Eigen::Index n = jet.size();
  return jet.held && n > 0 ? nozzle.held(jet, position<D>(jet.y, n - 1), jet.t).mass : 0;
}

/// With a given flow a bead is always held, and has what has been fed.
template <int D>
void go_on_feeding(Jet<D>& jet, const Nozzle<D>& nozzle, double volume) {
  const double flow = nozzle.feed().flow();
  if (flow == 0) return;
  jet.held = nozzle.inserting();
  if (fed(jet, nozzle) != volume) jet.last_release = jet.t - volume / flow;
}

/// The checkpoint's jet, whose scales are those of its own deck, in those of another.
template <int D>
Jet<D> rescaled(const Origin& o, const Parameters& p, const Columns& added) {
  std::vector<SavedColumn> saved;
  if (o.checkpoint->state.has(columns_part)) o.checkpoint->state.beginning_of_part(columns_part, saved);
  Jet<D> jet = saved_jet<D>(*o.checkpoint, own_columns<D> + std::ssize(saved));
  if (!complete(jet) || jet.y.cols() != own_columns<D> + std::ssize(saved))
    refuse(o, "its beads lack constants or columns");
  const Parameters& before = o.deck.parameters;
  const Scales from = scales(before), to = scales(p);
  const double volumes = (from.mass / before.density_mass) / (to.mass / p.density_mass);
  const double fed_before = fed(jet, Nozzle<D>(before));
  jet.t *= from.time / to.time;
  jet.last_release *= from.time / to.time;
  jet.y.template leftCols<D>() *= from.length / to.length;
  jet.y.template middleCols<D>(D) *= from.velocity / to.velocity;
  jet.y.col(stress_column<D>) *= from.stress / to.stress;
  jet.mass *= from.mass / to.mass;
  if (to.charge != 0) jet.charge *= from.charge / to.charge;
  jet.volume *= volumes;
  jet.held = jet.held && p.inserting;
  go_on_feeding(jet, Nozzle<D>(p), fed_before * volumes);
  if (!p.refinement) jet.id.resize(0), jet.born = 0;
  const State<D> all = jet.y;
  jet.y.resize(all.rows(), own_columns<D> + static_cast<Eigen::Index>(added.size()));
  jet.y.leftCols(own_columns<D>) = all.leftCols(own_columns<D>);
  for (std::size_t k = 0; k < added.size(); ++k) {
    const auto same = [&](const SavedColumn& c) { return c.name == added[k].name; };
    const auto found = std::find_if(saved.begin(), saved.end(), same);
    if (found == saved.end()) refuse_without(o, added[k]);
    jet.y.col(own_columns<D> + static_cast<Eigen::Index>(k)) =
        all.col(own_columns<D> + (found - saved.begin())) * (found->scale / added[k].scale);
  }
  return jet;
}

/// The columns of a frame's beads.
template <int D>
void set_columns(Jet<D>& jet, const Origin& o, const Columns& added) {
  for (std::size_t k = 0; k < added.size(); ++k) {
    const auto same = [&](const FrameColumn& c) { return c.name == added[k].name; };
    const auto found = std::find_if(o.frame_columns.begin(), o.frame_columns.end(), same);
    if (found == o.frame_columns.end()) refuse_without(o, added[k]);
    const auto& values = o.frame.columns[static_cast<std::size_t>(found - o.frame_columns.begin())];
    jet.y.col(own_columns<D> + static_cast<Eigen::Index>(k)) =
        Eigen::Map<const Eigen::ArrayXd>(values.data(), jet.size()) / added[k].scale;
  }
}

/// A frame's beads, as they were born: it shows them dried, with all of their stress and, where the flow was
/// given, the youngest with what has been fed since its release. Whether a bead is held at the nozzle follows
/// else from the distance of the youngest.
template <int D>
Jet<D> of_frame(const Origin& o, const Parameters& p, const Columns& added) {
  const Parameters& before = o.deck.parameters;
  const Scales s = scales(p), s_before = scales(before);
  const Material material{viscous_stress(before), added, drying(before)};
  const Frame& f = o.frame;
  const auto &position = f.columns[0], &velocity = f.columns[1], &stress = f.columns[2],
             &charge = f.columns[3], &mass = f.columns[4], &radius = f.columns[5];
  const auto is_none = [](std::int64_t id) { return id < 1; };
  if (f.points() == 0 || std::any_of(f.id.begin(), f.id.end() - 1, is_none))
    refuse(o, "its points are not numbered as beads and a nozzle are");
  Jet<D> jet;
  const auto beads = static_cast<Eigen::Index>(f.points()) - 1;
  jet.t = f.time / s.time;
  jet.y.resize(beads, own_columns<D> + static_cast<Eigen::Index>(added.size()));
  for (auto* constants : {&jet.mass, &jet.charge, &jet.volume}) constants->resize(beads);
  jet.removed = *std::min_element(f.id.begin(), f.id.end() - 1) - 1;
  set_columns(jet, o, added);
  const double bead_volume = s.mass / p.density_mass;
  for (Eigen::Index i = 0; i < beads; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Eigen::Map<const Eigen::Array3d> r(&position[3 * k]), upper(&position[3 * k + 3]),
        v(&velocity[3 * k]), upper_velocity(&velocity[3 * k + 3]);
    const double length = (r - upper).matrix().norm(), left = material.remaining<D>(jet.y, i);
    double state = stress[k];
    if (material.viscous.acts()) {
      const double rate = ((v - upper_velocity) * (r - upper)).sum() / (length * length) * s_before.time;
      state -= material.viscosity_ratio<D>(jet.y, i) * material.viscous(rate) * s_before.stress;
    }
    jet.y.row(i).template head<own_columns<D>>() << r.head<D>().transpose() / s.length,
        v.head<D>().transpose() / s.velocity, state / s.stress;
    jet.mass[i] = mass[k] / left / s.mass;
    jet.charge[i] = s.charge != 0 ? charge[k] / s.charge : 1;
    jet.volume[i] = std::numbers::pi * radius[k] * radius[k] * length / left / bead_volume;
  }
  double fed = 0;
  if (before.feed == Feed::flow && beads > 0) {
    const double released = s_before.mass / before.density_mass / bead_volume;
    fed = std::max(0.0, jet.volume[beads - 1] - released);
    jet.volume[beads - 1] -= fed;
  }
  go_on_feeding(jet, Nozzle<D>(p), fed);
  return jet;
}

template <int D>
void expect_sound(const Origin& o, const Parameters& p, const Jet<D>& jet) {
  if (jet.size() == 0) refuse(o, "all beads have left the jet there");
  if (!jet.y.allFinite()) refuse(o, "numbers of its beads are missing");
  const double x = jet.y(0, 0) * scales(p).length;
  if (p.removing && x >= p.collector_distance)
    refuse(
        o,
        fmt::format(
            "its farthest bead, at x = {:.6g} cm, lies beyond the collector distance of this deck, {:g} cm",
            x, p.collector_distance));
}

}  // namespace

Origin origin(const std::string& place) {
  std::error_code error;
  fs::path path = place;
  std::optional<double> t;
  if (const std::size_t at = place.rfind('@'); at != std::string::npos && !fs::exists(path, error)) {
    path = place.substr(0, at);
    t = seconds(place.substr(at + 1));
  }
  if (!fs::exists(path, error)) throw FileError(fmt::format("--from: {}: no such directory", path.string()));
  if (!fs::is_directory(path, error)) {
    if (is_hdf5(path)) return from_frame(path, t);
    if (!t) return from_checkpoint(path);
    throw InputError(fmt::format("--from: {}: frames at a time are in traj.h5", path.string()));
  }
  if (!t)
    for (const char* name : checkpoint_names)
      if (fs::exists(path / name, error)) return from_checkpoint(path / name);
  if (fs::exists(path / "traj.h5", error)) return from_frame(path / "traj.h5", t);
  throw FileError(fmt::format(
      "--from: {}: {}", path.string(),
      t ? "no traj.h5 here, which the deck's print hdf5 makes" : "neither a checkpoint nor traj.h5 is here"));
}

namespace {

/// What the two decks say differently of all that concerns the motion, but for who holds its beads.
std::vector<std::string> other_motion(const Origin& o, const Parameters& p) {
  Parameters same_outputs = o.deck.parameters;
  same_outputs.final_time = p.final_time;
  same_outputs.checkpoint = p.checkpoint;
  same_outputs.parallel = p.parallel;
  same_outputs.print_time = p.print_time;
  same_outputs.print_list = p.print_list;
  same_outputs.printstat_list = p.printstat_list;
  same_outputs.print_xyz = p.print_xyz;
  same_outputs.xyz_maxnum = p.xyz_maxnum;
  same_outputs.xyz_rescale = p.xyz_rescale;
  same_outputs.print_hdf5 = p.print_hdf5;
  return differences(p, same_outputs);
}

}  // namespace

std::string description(const Origin& o, const Parameters& p) {
  std::string text = fmt::format("{}, t = {:.10g} s", o.file.string(), o.t);
  const auto others = other_motion(o, p);
  if (!others.empty()) text += fmt::format("; {}", fmt::join(others, "; "));
  return text;
}

Checkpoint* steps_of(Origin& o, const Parameters& p) {
  const bool alike = o.checkpoint && (o.checkpoint->records > 0) == (p.parallel == ParallelData::distributed);
  return alike && other_motion(o, p).empty() ? &*o.checkpoint : nullptr;
}

template <int D>
Jet<D> jet_of(const Origin& o, const Parameters& p, const Columns& added) {
  const Parameters& before = o.deck.parameters;
  if (before.system != p.system)
    refuse(o, fmt::format("it is of system {}, the deck of system {}", before.system, p.system));
  if ((scales(before).charge == 0) != (scales(p).charge == 0))
    refuse(o, "one of the two jets has no charge, so that their lengths have no common scale");
  if (p.final_time <= o.t)
    refuse(o, fmt::format("it is at t = {:.10g} s; expected a final time beyond, found {:g} s", o.t,
                          p.final_time));
  const Jet<D> jet = o.checkpoint ? rescaled<D>(o, p, added) : of_frame<D>(o, p, added);
  expect_sound(o, p, jet);
  return jet;
}

template Jet<1> jet_of<1>(const Origin&, const Parameters&, const Columns&);
template Jet<3> jet_of<3>(const Origin&, const Parameters&, const Columns&);

}  // namespace treejet
