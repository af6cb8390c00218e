#include "forces/vector_path.hpp"

#include <cstdlib>
#include <string>

#include "core/error.hpp"

namespace treejet {

namespace {

constexpr VectorPath widest_first[] = {VectorPath::avx512, VectorPath::avx2, VectorPath::plain};

VectorPath chosen_path() {
  const char* forced = std::getenv("TREEJET_VECTOR_PATH");
  for (VectorPath path : widest_first)
    if (runs_here(path) && (!forced || std::string(forced) == name(path))) return path;
  throw InputError("TREEJET_VECTOR_PATH = " + std::string(forced) + " does not run on this machine");
}

}  // namespace

const char* name(VectorPath path) {
  constexpr const char* names[] = {"plain", "avx2", "avx512"};
  return names[static_cast<int>(path)];
}

VectorPath default_path() {
  static const VectorPath path = chosen_path();
  return path;
}

}  // namespace treejet
