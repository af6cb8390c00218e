#include "core/observe/observables.hpp"

#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>

namespace treejet {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// Component k of a quantity of the farthest bead; a straight jet has x only.
template <int D>
double component(const State<D>& y, int column, int k) {
  if (y.rows() == 0) return none;
  return k < D ? y(0, column + k) : 0;
}

template <int D>
double stress(const View<D>& v) {
  return v.jet.size() > 0 ? v.material.template stress<D>(v.jet, v.nozzle, 0) : none;
}

/// Of the volume that the element of the farthest bead had at the nozzle.
template <int D>
double left(const View<D>& v) {
  return v.jet.size() > 0 ? v.material.template remaining<D>(v.jet.y, 0) : none;
}

template <int D>
double off_axis(const Jet<D>& jet) {
  return std::hypot(component<D>(jet.y, 0, 1), component<D>(jet.y, 0, 2));
}

template <int D>
double rate(const View<D>& v, double amount) {
  const double w = v.jet.t - v.window.begin;
  return w > 0 ? amount / w : 0;
}

template <int D>
double per_arrival(const View<D>& v, double sum) {
  return v.window.arrivals > 0 ? sum / v.window.weight : none;
}

template <int D>
using Entries = std::map<std::string_view, Observable<D>>;

template <int D>
void add_state(Entries<D>& o) {
  o["t"] = [](auto& v) { return v.jet.t * v.scales.time; };
  o["ts"] = [](auto& v) { return v.jet.t; };
  constexpr std::string_view r[] = {"x", "y", "z"}, rs[] = {"xs", "ys", "zs"};
  constexpr std::string_view u[] = {"vx", "vy", "vz"}, us[] = {"vxs", "vys", "vzs"};
  for (int k = 0; k < 3; ++k) {
    o[r[k]] = [k](auto& v) { return component<D>(v.jet.y, 0, k) * v.scales.length; };
    o[rs[k]] = [k](auto& v) { return component<D>(v.jet.y, 0, k); };
    o[u[k]] = [k](auto& v) { return component<D>(v.jet.y, D, k) * v.scales.velocity; };
    o[us[k]] = [k](auto& v) { return component<D>(v.jet.y, D, k); };
  }
  o["st"] = [](auto& v) { return stress(v) * v.scales.stress; };
  o["sts"] = [](auto& v) { return stress(v); };
  o["yz"] = [](auto& v) { return off_axis<D>(v.jet) * v.scales.length; };
  o["yzs"] = [](auto& v) { return off_axis<D>(v.jet); };
  o["angl"] = [](auto& v) {
    return 2 * std::atan2(off_axis<D>(v.jet), std::abs(component<D>(v.jet.y, 0, 0))) * 180 / std::numbers::pi;
  };
  o["vol"] = [](auto& v) {
    const double at_nozzle =
        std::numbers::pi * v.nozzle_radius * v.nozzle_radius * v.nozzle.l_step() * v.scales.length;
    return v.jet.size() > 0 ? at_nozzle * v.jet.volume[0] * left(v) : none;
  };
  o["volr"] = [](auto& v) { return 1 - left(v); };
  o["mass"] = [](auto& v) { return v.scales.mass; };
  o["q"] = [](auto& v) { return v.scales.charge; };
  o["n"] = [](auto& v) { return double(v.beads + v.jet.held); };
  o["f"] = [](auto& v) { return double(v.jet.removed); };
  o["l"] = [](auto& v) { return double(v.jet.removed + v.beads + v.jet.held); };
}

template <int D>
void add_window(Entries<D>& o) {
  o["curn"] = [](auto& v) { return rate(v, v.window.charge_in) * v.scales.charge / v.scales.time; };
  o["curc"] = [](auto& v) { return rate(v, v.window.charge_out) * v.scales.charge / v.scales.time; };
  o["fcn"] = [](auto& v) { return rate(v, v.fed) * v.scales.charge / v.scales.time; };
  o["fcc"] = [](auto& v) { return rate(v, v.landed) * v.scales.charge / v.scales.time; };
  o["chn"] = [](auto& v) { return v.window.charge_in * v.scales.charge; };
  o["chc"] = [](auto& v) { return v.window.charge_out * v.scales.charge; };
  o["mfn"] = [](auto& v) { return rate(v, v.window.mass_in) * v.scales.mass / v.scales.time; };
  o["mfc"] = [](auto& v) { return rate(v, v.window.mass_out) * v.scales.mass / v.scales.time; };
  o["vn"] = [](auto& v) { return rate(v, v.window.release_speed) * v.scales.velocity; };
  o["vc"] = [](auto& v) { return per_arrival(v, v.window.speed) * v.scales.velocity; };
  o["svc"] = [](auto& v) { return per_arrival(v, v.window.strain_rate) / v.scales.time; };
  o["rc"] = [](auto& v) { return per_arrival(v, v.window.radius) * v.nozzle_radius; };
  o["rrr"] = [](auto& v) { return per_arrival(v, v.window.radius); };
  o["visc"] = [](auto& v) { return per_arrival(v, v.window.viscosity) * v.scales.stress * v.scales.time; };
  o["gc"] = [](auto& v) { return per_arrival(v, v.window.modulus) * v.scales.stress; };
  o["evrc"] = [](auto& v) { return per_arrival(v, v.window.evaporated); };
  o["emfc"] = [](auto& v) { return rate(v, v.window.evaporated) * v.scales.mass / v.scales.time; };
  o["lp"] = [](auto& v) { return v.path * v.scales.length; };
  o["rlp"] = [](auto& v) { return v.path * v.scales.length / v.collector_distance; };
  o["cpu"] = [](auto& v) { return v.timing.interval; };
  o["cpue"] = [](auto& v) { return v.timing.elapsed; };
  o["cpur"] = [](auto& v) { return v.timing.left; };
  o["nref"] = [](auto& v) { return double(v.splits); };
  o["nmrg"] = [](auto& v) { return double(v.merges); };
  o["ferr"] = [](auto& v) { return v.force_error ? v.force_error->l2 : 0; };
  o["ferrmax"] = [](auto& v) { return v.force_error ? v.force_error->max : 0; };
}

}  // namespace

template <int D>
Observable<D> observable(std::string_view key) {
  static const Entries<D> entries = [] {
    Entries<D> o;
    add_state<D>(o);
    add_window<D>(o);
    return o;
  }();
  const auto found = entries.find(key);
  if (found == entries.end()) throw std::logic_error("no observable " + std::string(key));
  return found->second;
}

template Observable<1> observable<1>(std::string_view);
template Observable<3> observable<3>(std::string_view);

}  // namespace treejet
