#include "core/deck/foreign.hpp"

namespace treejet {

namespace {

constexpr std::string_view split = "the sum over all pairs is what it approximates; see multirate";
constexpr std::string_view resumed =
    "a run goes on with treejet run --resume DIR, see checkpoint; leave the line out";

// clang-format off
const Foreign table[] = {
    {"system 2", "system 2", "JETSPIN has no working system 2; write system 1 or system 3"},
    {"noise pool", "pool of random numbers", "random numbers are drawn as they are needed", {}, true, true},
    {"cutoff points", "cutoff points",
     "JETSPIN 1.00 took the number for a length in cm; write cutoff and that length, or leave the line out for "
     "the full sum", "1000"},
    {"variable mass", "variable mass", "all beads are released with the same mass; leave the line out", "no"},
    {"variable charge", "variable charge", "all beads are released with the same charge; leave the line out", "no"},
    {"dynamic refinement anchor", "refinement", "elements are halved where they are, none is moved", {}, true},
    {"dynamic refinement capacity", "refinement", "there is no upper bound to the number of beads", {}, true},
    {"restart", "restart", resumed, "no"},
    {"primary cutoff", "multiple step", split, {}, true, true},
    {"maximum displ", "multiple step", split, {}, true, true},
    {"maximum displacement", "multiple step", split, {}, true, true},
    {"multiple step", "multiple step", split, "no", true, true},
    {"lorentz", "magnetic field", "write magnetic field and its three components; leave this line out", "no", false, true},
    {"mirror", "image charges", "the collector has no image charges; leave the line out", "no", false, true},
    {"wall", "wall", "walls are not modelled; leave the line out", "no", false, true},
    {"breakup", "breakup", "jets do not break; leave the line out", "no", false, true},
    {"ultimate strength", "breakup", "jets do not break; leave the line out", {}, false, true},
    {"job time", "time limit", "write --walltime and the time after treejet run", {}, true},
    {"close time", "time limit", "write --walltime and the time after treejet run", {}, true},
    {"print binary", "binary output", "binary files are not written; print hdf5 and printstat list are", {}, true},
    {"printstat binary", "binary output", "binary files are not written; print hdf5 and printstat list are", {}, true},
    {"print pdb", "PDB output", "PDB files are not written; write print xyz or print hdf5 and an interval", {}, true},
    {"print xyz frame", "single frames", "all frames go to one file; write print xyz and an interval", {}, true},
    {"print rescalexyz", "coordinates in units of length", "coordinates are in cm; print xyz rescale is a factor on them",
     {}, true},
};

constexpr ForeignKey keys[] = {
    {"v", "varying potential"}, {"mxst", "largest stress"}, {"mxsx", "largest stress"}, {"nms", "multiple step"},
    {"erms", "multiple step"},
};
// clang-format on

}  // namespace

std::span<const Foreign> foreign_directives() {
  return table;
}
std::span<const ForeignKey> foreign_keys() {
  return keys;
}

}  // namespace treejet
