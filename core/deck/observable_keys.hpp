#pragma once
/// The keys of `print list` and `printstat list`: paper, Appendix B, then Treejet's own. Files are in CGS; a
/// scaled quantity has the unit "1". Averaged keys are means over the print interval, the others hold at its
/// end. The farthest bead is the oldest one on the jet, bead 0. Another observable is one row here and its
/// function in core/observe/observables.cpp.

#include <array>
#include <string_view>

namespace treejet {

enum ObservableProperty : unsigned {
  averaged = 1,      ///< a mean over the print interval
  at_arrivals = 2,   ///< over the beads that arrive in it: NaN if none does
  along_path = 4,    ///< integrates over all beads, which costs a pass over them each step
  wall_clock = 8,    ///< differs from run to run
  across_axis = 16,  ///< 0 in system 1
};

struct ObservableKey {
  std::string_view key;
  std::string_view unit;
  std::string_view meaning;
  unsigned properties = 0;  ///< ObservableProperty, or-ed
};

inline constexpr auto observable_keys = std::to_array<ObservableKey>({
    {"t", "s", "time"},
    {"ts", "1", "scaled time"},
    {"x", "cm", "position of the farthest bead along the axis"},
    {"y", "cm", "its position across the axis", across_axis},
    {"z", "cm", "its position across the axis", across_axis},
    {"xs", "1", "scaled x"},
    {"ys", "1", "scaled y", across_axis},
    {"zs", "1", "scaled z", across_axis},
    {"st", "g/(cm s^2)", "stress at the farthest bead"},
    {"sts", "1", "scaled st"},
    {"vx", "cm/s", "velocity of the farthest bead along the axis"},
    {"vy", "cm/s", "its velocity across the axis", across_axis},
    {"vz", "cm/s", "its velocity across the axis", across_axis},
    {"vxs", "1", "scaled vx"},
    {"vys", "1", "scaled vy", across_axis},
    {"vzs", "1", "scaled vz", across_axis},
    {"yz", "cm", "distance of the farthest bead from the axis", across_axis},
    {"yzs", "1", "scaled yz", across_axis},
    {"mass", "g", "mass of the bead inserted last"},
    {"q", "statC", "charge of the bead inserted last"},
    {"cpu", "s", "wall-clock time of the print interval", wall_clock},
    {"cpur", "s", "estimate of the wall-clock time to the end", wall_clock},
    {"cpue", "s", "wall-clock time since the start", wall_clock},
    {"n", "1", "number of beads"},
    {"f", "1", "index of the farthest bead, counted since the start"},
    {"l", "1", "index of the nozzle, counted since the start"},
    {"curn", "statC/s", "current at the nozzle, in whole beads", averaged},
    {"curc", "statC/s", "current at the collector, in whole beads", averaged},
    {"vn", "cm/s", "speed given to the bead released last", averaged},
    {"vc", "cm/s", "speed of the jet at the collector", averaged | at_arrivals},
    {"svc", "1/s", "strain rate at the collector", averaged | at_arrivals},
    {"mfn", "g/s", "mass flux at the nozzle", averaged},
    {"mfc", "g/s", "mass flux at the collector", averaged},
    {"rc", "cm", "radius of the jet at the collector", averaged | at_arrivals},
    {"rrr", "1", "rc over the radius at the nozzle", averaged | at_arrivals},
    {"lp", "cm", "length of the jet along its path", averaged | along_path},
    {"rlp", "1", "lp over the collector distance", averaged | along_path},
    {"vol", "cm^3", "volume of the element of the farthest bead"},
    {"volr", "1", "part of it that has evaporated since the nozzle"},
    {"visc", "g/(cm s)", "viscosity of the jet at the collector", averaged | at_arrivals},
    {"gc", "g/(cm s^2)", "elastic modulus of the jet at the collector", averaged | at_arrivals},
    {"evrc", "1", "part of the jet at the collector that has evaporated", averaged | at_arrivals},
    {"emfc", "g/s", "mass that has evaporated from what reaches the collector", averaged},
    {"angl", "degree", "full opening angle, nozzle to farthest bead", across_axis},
    {"chn", "statC", "charge of the beads placed at the nozzle in the print interval"},
    {"chc", "statC", "charge of the beads taken by the collector in the print interval"},
    {"fcn", "statC/s", "curn with the part of the next bead counted that is drawn out already", averaged},
    {"fcc", "statC/s", "curc with the part of the way counted that the next bead has gone", averaged},
    {"nref", "1", "elements split since the start (dynamic refinement)"},
    {"nmrg", "1", "elements merged with another since the start"},
    {"ferr", "1",
     "relative L2 error of the Coulomb field, as last measured on some beads; 0 with the direct sum"},
    {"ferrmax", "1", "largest error among these beads, over the root mean square of the field"},
});

/// The row of a key, null if there is none.
constexpr const ObservableKey* observable_key(std::string_view key) {
  for (const auto& known : observable_keys)
    if (known.key == key) return &known;
  return nullptr;
}

constexpr bool has(std::string_view key, ObservableProperty property) {
  const ObservableKey* known = observable_key(key);
  return known && (known->properties & property) != 0;
}

}  // namespace treejet
