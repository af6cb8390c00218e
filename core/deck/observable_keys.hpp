#pragma once
/// The keys of `print list` and `printstat list`: paper, Appendix B, then Treejet's own. Files are in CGS; a
/// scaled quantity has the unit "1". Averaged keys are means over the print interval, the others hold at its
/// end. The farthest bead is the oldest one on the jet, bead 0. The deck checks its lists against this table
/// and the observables compute exactly these.

#include <array>
#include <string_view>

namespace treejet {

struct ObservableKey {
  std::string_view key;
  std::string_view unit;
  std::string_view meaning;
  bool averaged = false;
};

inline constexpr bool averaged = true;

inline constexpr auto observable_keys = std::to_array<ObservableKey>({
    {"t", "s", "time"},
    {"ts", "1", "scaled time"},
    {"x", "cm", "position of the farthest bead along the axis"},
    {"y", "cm", "its position across the axis"},
    {"z", "cm", "its position across the axis"},
    {"xs", "1", "scaled x"},
    {"ys", "1", "scaled y"},
    {"zs", "1", "scaled z"},
    {"st", "g/(cm s^2)", "stress at the farthest bead"},
    {"sts", "1", "scaled st"},
    {"vx", "cm/s", "velocity of the farthest bead along the axis"},
    {"vy", "cm/s", "its velocity across the axis"},
    {"vz", "cm/s", "its velocity across the axis"},
    {"vxs", "1", "scaled vx"},
    {"vys", "1", "scaled vy"},
    {"vzs", "1", "scaled vz"},
    {"yz", "cm", "distance of the farthest bead from the axis"},
    {"yzs", "1", "scaled yz"},
    {"mass", "g", "mass of the bead inserted last"},
    {"q", "statC", "charge of the bead inserted last"},
    {"cpu", "s", "wall-clock time of the print interval"},
    {"cpur", "s", "estimate of the wall-clock time to the end"},
    {"cpue", "s", "wall-clock time since the start"},
    {"n", "1", "number of beads"},
    {"f", "1", "index of the farthest bead, counted since the start"},
    {"l", "1", "index of the nozzle, counted since the start"},
    {"curn", "statC/s", "current at the nozzle, in whole beads", averaged},
    {"curc", "statC/s", "current at the collector, in whole beads", averaged},
    {"vn", "cm/s", "speed given to the bead released last", averaged},
    {"vc", "cm/s", "speed of the jet at the collector", averaged},
    {"svc", "1/s", "strain rate at the collector", averaged},
    {"mfn", "g/s", "mass flux at the nozzle", averaged},
    {"mfc", "g/s", "mass flux at the collector", averaged},
    {"rc", "cm", "radius of the jet at the collector", averaged},
    {"rrr", "1", "rc over the radius at the nozzle", averaged},
    {"lp", "cm", "length of the jet along its path", averaged},
    {"rlp", "1", "lp over the collector distance", averaged},
    {"angl", "degree", "full opening angle, nozzle to farthest bead"},
    {"chn", "statC", "charge of the beads placed at the nozzle in the print interval"},
    {"chc", "statC", "charge of the beads taken by the collector in the print interval"},
    {"fcn", "statC/s", "curn with the part of the next bead counted that is drawn out already", averaged},
    {"fcc", "statC/s", "curc with the part of the way counted that the next bead has gone", averaged},
    {"ferr", "1",
     "relative L2 error of the Coulomb field, as last measured on some beads; 0 with the direct sum"},
    {"ferrmax", "1", "largest error among these beads, over the root mean square of the field"},
});

}  // namespace treejet
