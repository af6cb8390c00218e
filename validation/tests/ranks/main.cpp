#include "validation/tests/catch_runner.hpp"
#include "validation/tests/ranks/ranked.hpp"

/// The leak sanitizer's, where there is one.
extern "C" [[gnu::weak]] void __lsan_do_leak_check();

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
  // while the parts of MPI are loaded, by whose names validation/tests/ranks/leaks.supp knows their leaks
  if (__lsan_do_leak_check) __lsan_do_leak_check();
  started = {};
  return worst > 0 ? 1 : 0;
}
