#include "forces/coulomb/simd/isa.hpp"

#include <cstdlib>
#include <string>

#include "core/base/error.hpp"

namespace treejet {

namespace {

constexpr Isa widest_first[] = {Isa::avx512, Isa::avx2, Isa::plain};

Isa chosen_isa() {
  const char* forced = std::getenv("TREEJET_VECTOR_PATH");
  for (Isa isa : widest_first)
    if (runs_here(isa) && (!forced || std::string(forced) == name(isa))) return isa;
  throw InputError("TREEJET_VECTOR_PATH = " + std::string(forced) + " does not run on this machine");
}

}  // namespace

const char* name(Isa isa) {
  constexpr const char* names[] = {"plain", "avx2", "avx512"};
  return names[static_cast<int>(isa)];
}

Isa default_isa() {
  static const Isa isa = chosen_isa();
  return isa;
}

}  // namespace treejet
