#include <dlfcn.h>

#include "validation/tests/catch_runner.hpp"
#include "validation/tests/ranks/ranked.hpp"

/// Parts of MPI stay loaded to the end: the leak sanitizer knows their leaks by their names (leaks.supp).
extern "C" int dlclose(void*) noexcept {
  return 0;
}

namespace {
treejet::Ranks started;
}

const treejet::Ranks& treejet::started_ranks() {
  return started;
}

int main(int argc, char** argv) {
  started = treejet::join_ranks();
  const int failed = treejet::run_tests(argc, argv);
  const int worst = started.greatest(failed);
  started = {};
  return worst > 0 ? 1 : 0;
}
